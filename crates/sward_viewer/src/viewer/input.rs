//! Keys and mouse.

use eframe::egui;
use sward::terrain::Terrain;

use super::Viewer;
use super::files::Purpose;
use crate::camera::Kind;
use crate::drive::Asked;
use crate::hand::{Hand, below};
use crate::panels::tools::Wish;
use crate::sight::Sight;

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
        if pressed(egui::Key::M) {
            self.curves[0] = !self.curves[0];
        }
        if pressed(egui::Key::T) {
            self.curves[1] = !self.curves[1];
        }
        if context.input(|input| input.modifiers.command && input.key_pressed(egui::Key::Z)) {
            wishes.push(Wish::Undo);
        }
        if context.input(|input| input.modifiers.command && input.key_pressed(egui::Key::S)) {
            self.ask_for(Purpose::SaveScene);
        }
        if pressed(egui::Key::F9) {
            wishes.push(Wish::Record);
        }
        if pressed(egui::Key::O) {
            self.ask_for(Purpose::OpenScene);
        }
        let bodies = self.stage.as_ref().map_or(0, |stage| stage.world.scene.interactors.len());
        if pressed(egui::Key::Tab) && bodies > 0 {
            wishes.push(Wish::Choose(self.chosen.map_or(0, |body| (body + 1) % bodies)));
        }
    }

    /// What held keys ask for.
    pub(super) fn asked(&self, context: &egui::Context) -> Asked {
        let keys = Self::held(context);
        #[cfg(any(feature = "gamepad", not(target_os = "linux")))]
        let keys = self.gamepad.as_ref().map_or(keys, |gamepad| gamepad.asked(keys));
        keys
    }

    fn held(context: &egui::Context) -> Asked {
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

    /// What buttons of a gamepad ask for, and how its right stick turns the camera.
    #[cfg(any(feature = "gamepad", not(target_os = "linux")))]
    pub(super) fn buttons(&mut self, context: &egui::Context, wishes: &mut Vec<Wish>) {
        let Some(gamepad) = &mut self.gamepad else { return };
        let (pressed, [right, up]) = (gamepad.pressed(), gamepad.look());
        let bodies = self.stage.as_ref().map_or(0, |stage| stage.world.scene.interactors.len());
        if pressed.wheel {
            wishes.push(Wish::Wheel);
        }
        if pressed.camera {
            wishes.push(Wish::Camera(self.camera.kind.next()));
        }
        if pressed.body && bodies > 0 {
            wishes.push(Wish::Choose(self.chosen.map_or(0, |body| (body + 1) % bodies)));
        }
        self.clock.paused ^= pressed.pause;
        if right != 0.0 || up != 0.0 {
            let seconds = f64::from(context.input(|input| input.stable_dt)).min(0.1);
            self.take_camera();
            self.camera.turn(2.0 * right * seconds, 1.4 * up * seconds);
        }
    }

    /// The mouse over the picture drags a body, or turns, moves and zooms the camera; one that is the scene's becomes one that circles. A click puts the
    /// probe.
    pub(super) fn mouse(&mut self, response: &egui::Response, half: egui::Rect) {
        let two = response.ctx.multi_touch();
        if self.touch.holds() || two.is_some() {
            return self.turn_by_fingers(two, half);
        }
        let wheel = if response.hovered() { response.ctx.input(|input| input.smooth_scroll_delta.y) } else { 0.0 };
        let pinch = if response.hovered() { response.ctx.input(egui::InputState::zoom_delta) } else { 1.0 };
        if self.took(response, half) {
            return;
        }
        let moved = response.drag_delta();
        if moved == egui::Vec2::ZERO && wheel == 0.0 && pinch == 1.0 {
            return;
        }
        self.take_camera();
        let (x, y) = (f64::from(moved.x), f64::from(moved.y));
        if response.dragged_by(egui::PointerButton::Primary) {
            self.camera.turn(0.005 * x, -0.005 * y);
        } else {
            let metres = self.camera.metres(half.height());
            self.camera.slide(-x * metres, y * metres, 0.0);
        }
        if wheel != 0.0 || pinch != 1.0 {
            self.camera.zoom(f64::from(pinch) * (0.003 * f64::from(wheel)).exp());
        }
    }

    /// A camera that is the scene's becomes one that circles.
    fn take_camera(&mut self) {
        if let Some(stage) = self.stage.as_ref().filter(|_| self.camera.kind == Kind::Scene) {
            let view = stage.world.camera();
            self.camera.take(Kind::Orbit, &view);
        }
    }

    /// Two fingers move the camera and pinch; one turns it while another drives.
    fn turn_by_fingers(&mut self, two: Option<egui::MultiTouchInfo>, half: egui::Rect) {
        let turned = self.touch.turned();
        // What the first finger may have taken before the second came.
        self.hand = None;
        if self.touch.holds() {
            if turned != egui::Vec2::ZERO {
                self.take_camera();
                self.camera.turn(0.005 * f64::from(turned.x), -0.005 * f64::from(turned.y));
            }
        } else if let Some(two) = two {
            self.take_camera();
            let metres = self.camera.metres(half.height());
            self.camera.slide(-f64::from(two.translation_delta.x) * metres, f64::from(two.translation_delta.y) * metres, 0.0);
            self.camera.zoom(f64::from(two.zoom_delta));
        }
    }

    /// Whether the mouse has a body in its hand; where it clicks, the probe goes.
    fn took(&mut self, response: &egui::Response, half: egui::Rect) -> bool {
        let Some(stage) = &mut self.stage else { return false };
        let sight = Sight::new(&stage.world.camera(), half);
        // In the other half the same places are as far to the right.
        let into = |at: egui::Pos2| if at.x > half.right() { at - egui::vec2(half.width() + 2.0, 0.0) } else { at };
        let ground = |at: egui::Pos2, terrain: &Terrain| sight.ground(terrain, into(at));
        if response.clicked()
            && self.curves[1]
            && let Some(at) = response.interact_pointer_pos().and_then(|at| ground(at, &stage.world.model.terrain))
        {
            self.probe.put(at);
        }
        if response.drag_started_by(egui::PointerButton::Primary)
            && let Some(press) = response.ctx.input(|input| input.pointer.press_origin())
            && let Some(body) = below(&stage.world, &sight, into(press))
            && self.drive.is_none_or(|drive| drive.body != body)
            && let Some(at) = ground(press, &stage.world.model.terrain)
        {
            (self.hand, self.chosen) = (Hand::take(&mut stage.world, body, at), Some(body));
        }
        let Some(hand) = &mut self.hand else { return false };
        if !response.dragged_by(egui::PointerButton::Primary) {
            // It is put down where the mouse was let go.
            self.hand = None;
            return false;
        }
        if let Some(at) = response.interact_pointer_pos().and_then(|at| ground(at, &stage.world.model.terrain)) {
            hand.point(at);
        }
        true
    }
}
