//! Changing the scene that runs: every parameter, with its way back.

use eframe::egui;

use super::Viewer;
use crate::loading::{Loading, What};
use crate::panels::parameters;

impl Viewer {
    /// Changes the scene: at once where that can be, else beside the one that runs, which waits for it.
    pub(super) fn change(&mut self, context: &egui::Context, scene: sward::scene::Scene) {
        let Some(stage) = &mut self.stage else { return };
        if self.loading.as_ref().is_some_and(|loading| loading.changed) {
            stage.edited = scene.clone();
            self.queued = Some(scene);
            return;
        }
        match stage.adopt(&scene) {
            Ok(true) => {
                self.problem = None;
                self.follow_beside(context);
            }
            Ok(false) => {
                let (wake, source) = (context.clone(), stage.source.clone());
                // What the panel shows is what was asked for; the world follows when it is ready.
                stage.edited = scene.clone();
                match stage.copied() {
                    Ok(world) => {
                        let what = What::Changed(Box::new((scene, world)));
                        self.loading = Some(Loading::begin(&self.gpu, source, what, self.backend, move || wake.request_repaint()));
                    }
                    Err(problem) => self.problem = Some(problem),
                }
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
        ui.horizontal(|ui| {
            ui.strong("parameters");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.small_button("copy as RON").on_hover_text("The whole scene as text, into the clipboard").clicked() {
                    ui.ctx().copy_text(before.to_ron());
                }
                if ui.add_enabled(before != opened, egui::Button::new("reset").small()).on_hover_text("As it was opened").clicked() {
                    wanted = Some(opened.clone());
                }
                if ui.add_enabled(!self.history.is_empty(), egui::Button::new("undo").small()).clicked() {
                    wanted = self.history.pop();
                }
            });
        });
        let undone = wanted.is_some();
        egui::ScrollArea::vertical().id_salt("parameters").auto_shrink([false, false]).show(ui, |ui| {
            if parameters::show(ui, &mut scene) && !undone {
                wanted = Some(scene);
            }
        });
        let context = ui.ctx().clone();
        if let Some(scene) = wanted.filter(|scene| *scene != before) {
            // One entry for a whole drag of a slider.
            if !undone && (self.history.is_empty() || !context.input(|input| input.pointer.is_decidedly_dragging())) {
                self.history.push(before);
            }
            self.change(&context, scene);
        }
    }
}
