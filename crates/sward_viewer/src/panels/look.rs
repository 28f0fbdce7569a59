//! Looking inside: what is drawn over the picture.

use eframe::egui;

use crate::marks::mark;
use crate::overlay::{Kind, Overlays};

/// What can be drawn over the picture, and which curves are shown.
pub fn show(ui: &mut egui::Ui, overlays: &mut Overlays, [times, probe]: [&mut bool; 2]) {
    ui.horizontal_wrapped(|ui| {
        for (kind, name, about) in Kind::ALL {
            let button = ui.selectable_label(overlays.shows(kind), name).on_hover_text(about);
            mark(ui, &format!("look {name}"), button.rect);
            if button.clicked() {
                overlays.toggle(kind);
            }
        }
    });
    ui.horizontal_wrapped(|ui| {
        let button = ui.toggle_value(times, "milliseconds").on_hover_text("How long each stage takes (M)");
        mark(ui, "milliseconds", button.rect);
        let button = ui.toggle_value(probe, "probe").on_hover_text("How the plants of a place lean: click it in the picture (T)");
        mark(ui, "probe", button.rect);
    });
}
