//! Menus of presets: those that come with sward, and one's own.

use std::collections::BTreeMap;

use eframe::egui;
use sward::scene::Scene;

use crate::marks::mark;
use crate::presets::{PRESETS, Part};

/// Shows menus; the answer is a scene to change to.
pub fn show(ui: &mut egui::Ui, scene: &Scene, own: &mut BTreeMap<String, String>, name: &mut String) -> Option<Scene> {
    let mut chosen = None;
    ui.horizontal_wrapped(|ui| {
        for (part, title) in Part::ALL {
            let menu = ui.menu_button(format!("{title} ⏷"), |ui| {
                for preset in PRESETS.iter().filter(|preset| preset.part == part) {
                    let button = ui.button(preset.name).on_hover_text(preset.about);
                    mark(ui, &format!("preset {}", preset.name), button.rect);
                    if button.clicked() {
                        chosen = preset.put(scene);
                        ui.close();
                    }
                }
            });
            mark(ui, &format!("presets {title}"), menu.response.rect);
        }
        ui.menu_button("mine ⏷", |ui| {
            let mut gone = None;
            for (name, text) in own.iter() {
                ui.horizontal(|ui| {
                    if ui.button(name).on_hover_text("All parameters as they were kept").clicked() {
                        chosen = Scene::parse(text, name).ok();
                        ui.close();
                    }
                    if ui.small_button("×").on_hover_text("Forget it").clicked() {
                        gone = Some(name.clone());
                    }
                });
            }
            if let Some(name) = gone {
                own.remove(&name);
            }
            ui.horizontal(|ui| {
                ui.add(egui::TextEdit::singleline(name).hint_text("a name").desired_width(110.0));
                if ui
                    .add_enabled(!name.trim().is_empty(), egui::Button::new("keep"))
                    .on_hover_text("Keep all parameters under this name")
                    .clicked()
                {
                    own.insert(name.trim().to_owned(), scene.to_ron());
                    name.clear();
                }
            });
        });
    });
    chosen
}
