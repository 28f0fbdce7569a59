//! Keys and mouse.

use eframe::egui;

use super::Viewer;
use crate::camera::Kind;
use crate::drive::Asked;
use crate::panels::tools::Wish;

impl Viewer {
    /// Keys that do one thing once.
    pub(super) fn keys(&mut self, context: &egui::Context, wishes: &mut Vec<Wish>) {
        if context.egui_wants_keyboard_input() {
            return;
        }
        let pressed = |key| context.input(|input| input.key_pressed(key));
        if pressed(egui::Key::P) {
            self.clock.paused = !self.clock.paused;
        }
        if pressed(egui::Key::Period) {
            self.clock.paused = true;
            self.clock.single += 1;
        }
        if pressed(egui::Key::Comma) {
            self.clock.pace = if self.clock.pace < 0.9 { 1.0 } else { 0.2 };
        }
        if pressed(egui::Key::F1) {
            self.help = !self.help;
        }
        if pressed(egui::Key::R) {
            wishes.push(Wish::Restart);
        }
        if pressed(egui::Key::C) {
            wishes.push(Wish::Camera(self.camera.kind.next()));
        }
        if pressed(egui::Key::E) {
            wishes.push(Wish::Wheel);
        }
        if pressed(egui::Key::O) {
            self.ask_for_file();
        }
        let bodies = self.stage.as_ref().map_or(0, |stage| stage.world.scene.interactors.len());
        if pressed(egui::Key::Tab) && bodies > 0 {
            wishes.push(Wish::Choose(self.chosen.map_or(0, |body| (body + 1) % bodies)));
        }
    }

    /// What held keys ask for.
    pub(super) fn asked(context: &egui::Context) -> Asked {
        if context.egui_wants_keyboard_input() {
            return Asked::default();
        }
        context.input(|input| {
            let down = |keys: &[egui::Key]| f64::from(u8::from(keys.iter().any(|key| input.key_down(*key))));
            Asked {
                ahead: down(&[egui::Key::W, egui::Key::ArrowUp]) - down(&[egui::Key::S, egui::Key::ArrowDown]),
                right: down(&[egui::Key::D, egui::Key::ArrowRight]) - down(&[egui::Key::A, egui::Key::ArrowLeft]),
                up: down(&[egui::Key::Space]) - f64::from(u8::from(input.modifiers.shift)),
                brake: input.key_down(egui::Key::Space),
            }
        })
    }

    /// The mouse over the picture turns, moves and zooms the camera; one that is the scene's becomes one that circles.
    pub(super) fn mouse(&mut self, response: &egui::Response, rows: f32) {
        let moved = response.drag_delta();
        let wheel = if response.hovered() { response.ctx.input(|input| input.smooth_scroll_delta.y) } else { 0.0 };
        let pinch = if response.hovered() { response.ctx.input(egui::InputState::zoom_delta) } else { 1.0 };
        if moved == egui::Vec2::ZERO && wheel == 0.0 && pinch == 1.0 {
            return;
        }
        if let Some(stage) = self.stage.as_ref().filter(|_| self.camera.kind == Kind::Scene) {
            let view = stage.world.camera();
            self.camera.take(Kind::Orbit, &view);
        }
        let (x, y) = (f64::from(moved.x), f64::from(moved.y));
        if response.dragged_by(egui::PointerButton::Primary) {
            self.camera.turn(0.005 * x, -0.005 * y);
        } else {
            let metres = self.camera.metres(rows);
            self.camera.slide(-x * metres, y * metres, 0.0);
        }
        if wheel != 0.0 || pinch != 1.0 {
            self.camera.zoom(f64::from(pinch) * (0.003 * f64::from(wheel)).exp());
        }
    }
}
