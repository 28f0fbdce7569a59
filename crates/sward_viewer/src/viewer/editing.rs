//! Changing the scene that runs: every parameter, with its way back.

use eframe::egui;
use sward::scene::Scene;

use super::Viewer;
use super::files::Purpose;
use crate::loading::{Loading, What};
use crate::marks::mark;
use crate::panels::{parameters, presets};

/// Changes that can be taken back.
const HISTORY: usize = 200;

impl Viewer {
    /// Changes the scene: at once where that can be, else beside the one that runs, which waits for it.
    pub(super) fn change(&mut self, context: &egui::Context, scene: Scene) {
        let Some(stage) = &mut self.stage else { return };
        if self.loading.as_ref().is_some_and(|loading| loading.changed) {
            stage.edited = scene.clone();
            self.queued = Some(scene);
            return;
        }
        match stage.bring() {
            Ok(true) => {}
            // Its cells are on their way.
            Ok(false) => {
                stage.edited = scene.clone();
                return self.queued = Some(scene);
            }
            Err(problem) => return self.problem = Some(problem),
        }
        match stage.adopt(&scene) {
            Ok(true) => {
                self.problem = None;
                self.follow_beside(context);
            }
            Ok(false) => {
                let (wake, from) = (context.clone(), (stage.source.clone(), stage.painted.clone()));
                // What the panel shows is what was asked for; the world follows when it is ready.
                stage.edited = scene.clone();
                let running = stage.shown().map(|scene| Box::new(scene.clone()));
                let what = What::Changed(Box::new((scene, stage.world.clone())), running);
                self.loading = Some(Loading::begin(&self.means, from, what, self.backend, move || wake.request_repaint()));
            }
            Err(problem) => self.problem = Some(problem),
        }
    }

    /// All parameters, and what can be done with them.
    pub(super) fn parameters(&mut self, ui: &mut egui::Ui) {
        let Some(stage) = &self.stage else { return };
        let (mut scene, opened) = (stage.edited.clone(), stage.opened.clone());
        let before = scene.clone();
        let mut wanted = None;
        let undone = self.above(ui, &before, &opened, &mut wanted);
        egui::ScrollArea::vertical().id_salt("parameters").auto_shrink([false, false]).show(ui, |ui| {
            if parameters::show(ui, &mut scene) && wanted.is_none() {
                wanted = Some(scene);
            }
        });
        let context = ui.ctx().clone();
        if let Some(scene) = wanted.filter(|scene| *scene != before) {
            // One entry for a whole drag of a slider.
            if !undone && !self.mid_drag {
                if self.history.len() == HISTORY {
                    self.history.remove(0);
                }
                self.history.push(before);
            }
            self.mid_drag = true;
            self.change(&context, scene);
        }
        self.mid_drag &= context.input(|input| input.pointer.any_down());
    }

    /// Buttons above the parameters; whether what is wanted now is what was.
    fn above(&mut self, ui: &mut egui::Ui, now: &Scene, opened: &Scene, wanted: &mut Option<Scene>) -> bool {
        let mut undone = false;
        ui.horizontal(|ui| {
            ui.strong("parameters");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let copy = ui.small_button("copy as RON").on_hover_text("The whole scene as text, into the clipboard");
                mark(ui, "copy", copy.rect);
                if copy.clicked() {
                    ui.ctx().copy_text(now.to_ron());
                }
                let save = ui.small_button("save…").on_hover_text("The whole scene as a file (Ctrl S)");
                mark(ui, "save", save.rect);
                if save.clicked() {
                    self.ask_for(Purpose::SaveScene);
                }
            });
        });
        ui.horizontal_wrapped(|ui| {
            let reset = ui.add_enabled(now != opened, egui::Button::new("reset").small()).on_hover_text("As it was opened");
            mark(ui, "reset", reset.rect);
            if reset.clicked() {
                *wanted = Some(opened.clone());
            }
            let undo = ui.add_enabled(!self.history.is_empty(), egui::Button::new("undo").small()).on_hover_text("Ctrl Z");
            mark(ui, "undo", undo.rect);
            if undo.clicked() {
                *wanted = self.history.pop();
                undone = true;
            }
            let paint = ui.toggle_value(&mut self.canvas.open, "paint wind").on_hover_text("Draw the wind of a place with the mouse");
            mark(ui, "paint wind", paint.rect);
        });
        ui.horizontal_wrapped(|ui| {
            if let Some(scene) = presets::show(ui, now, &mut self.presets, &mut self.preset_name) {
                *wanted = Some(scene);
            }
        });
        undone
    }
}
