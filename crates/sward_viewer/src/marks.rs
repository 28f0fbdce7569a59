//! Where things are in the window, for scripts that click on them as a person would.

use std::collections::BTreeMap;

use eframe::egui::{self, Id, Rect};

/// Left, top, width and height of each thing, pixels of the window.
pub type Marks = BTreeMap<String, [f32; 4]>;

fn place() -> Id {
    Id::new("sward marks")
}

/// From now on it is noted where things are.
pub fn begin(context: &egui::Context) {
    context.data_mut(|data| data.insert_temp(place(), Marks::new()));
}

/// Notes where something is, if anybody wants to know; nothing that is scrolled out of sight.
pub fn mark(ui: &egui::Ui, name: &str, rect: Rect) {
    let seen = rect.intersect(ui.clip_rect());
    if !seen.is_positive() || seen.height() < 0.6 * rect.height() {
        return;
    }
    let scale = ui.ctx().pixels_per_point();
    ui.ctx().data_mut(|data| {
        if let Some(mut marks) = data.get_temp::<Marks>(place()) {
            let [left, top, width, height] = [rect.left(), rect.top(), rect.width(), rect.height()].map(|points| points * scale);
            marks.insert(name.to_owned(), [left, top, width, height]);
            data.insert_temp(place(), marks);
        }
    });
}

/// What was noted since the last call.
pub fn taken(context: &egui::Context) -> Marks {
    context.data_mut(|data| {
        let marks = data.get_temp::<Marks>(place()).unwrap_or_default();
        if data.get_temp::<Marks>(place()).is_some() {
            data.insert_temp(place(), Marks::new());
        }
        marks
    })
}
