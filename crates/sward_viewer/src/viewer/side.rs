//! What lies to the left of the picture.

use eframe::egui;

use super::Viewer;
use super::files::Purpose;
use crate::marks::mark;
use crate::panels::tools::{self, Wish};
use crate::panels::{look, plots, scenes};
use crate::stage::Stage;

impl Viewer {
    pub(super) fn side(&mut self, ui: &mut egui::Ui, wishes: &mut Vec<Wish>) {
        let context = ui.ctx().clone();
        egui::ScrollArea::vertical().show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.heading("sward");
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    if ui.button("?").on_hover_text("Keys (F1)").clicked() {
                        self.help = !self.help;
                    }
                    if ui.button("open…").on_hover_text("A scene file of your own (O); or drop it on the window").clicked() {
                        self.ask_for(Purpose::OpenScene);
                    }
                });
            });
            ui.separator();
            if let Some(source) = scenes::show(ui, self.stage.as_ref().map(|stage| &stage.source)) {
                self.open(&context, source);
            }
            ui.separator();
            tools::time(ui, &mut self.clock, self.recording.is_some(), wishes);
            ui.separator();
            ui.strong("camera");
            tools::camera(ui, self.camera.kind, wishes);
            ui.separator();
            ui.strong("bodies");
            let names: Vec<String> = self.names();
            tools::wheel(ui, &names, self.chosen, self.drive.as_ref(), wishes);
            ui.separator();
            ui.strong("look inside");
            let [times, probe] = &mut self.curves;
            look::show(ui, &mut self.overlays, [times, probe]);
            ui.separator();
            ui.strong("compare");
            tools::compare(ui, self.beside.response, wishes);
            ui.separator();
            let backend = self.stage.as_ref().map_or(self.backend, Stage::backend);
            tools::machine(ui, backend, [&mut self.fineness, &mut self.near], &self.means, wishes);
        });
    }

    pub(super) fn names(&self) -> Vec<String> {
        let bodies = self.stage.iter().flat_map(|stage| stage.world.scene.interactors.iter().enumerate());
        bodies.map(|(index, body)| if body.name.is_empty() { format!("body {}", index + 1) } else { body.name.clone() }).collect()
    }

    /// What went well or is wrong, below the picture.
    pub(super) fn said(&mut self, ui: &mut egui::Ui) {
        if let Some(notice) = self.notice.clone() {
            egui::Panel::bottom("notice").show(ui, |ui| {
                ui.horizontal(|ui| {
                    if ui.button("×").on_hover_text("I have seen it").clicked() {
                        self.notice = None;
                    }
                    ui.add(egui::Label::new(notice).wrap());
                });
            });
        }
        let Some(problem) = self.problem.clone() else { return };
        egui::Panel::bottom("problem").show(ui, |ui| {
            ui.horizontal(|ui| {
                let seen = ui.button("×").on_hover_text("I have seen it");
                mark(ui, "problem", seen.rect);
                if seen.clicked() {
                    self.problem = None;
                }
                let words = egui::RichText::new(problem).monospace().color(egui::Color32::from_rgb(255, 140, 110));
                ui.add(egui::Label::new(words).wrap());
            });
        });
    }

    /// Curves, below the picture.
    pub(super) fn plots(&mut self, ui: &mut egui::Ui) {
        self.times.with_device = self.curves[0];
        let shown = self.curves.iter().filter(|shown| **shown).count();
        if shown == 0 {
            return;
        }
        let world = self.stage.as_ref().map(|stage| &stage.world);
        egui::Panel::bottom("curves").resizable(true).default_size(190.0).min_size(110.0).show(ui, |ui| {
            ui.columns(shown, |columns| {
                let mut columns = columns.iter_mut();
                if self.curves[0]
                    && let Some(ui) = columns.next()
                {
                    plots::times(ui, &self.times);
                }
                if self.curves[1]
                    && let Some(ui) = columns.next()
                {
                    plots::probe(ui, &mut self.probe, world);
                }
            });
        });
    }
}
