//! What lies around the picture can be folded away; on a narrow screen there is room for one side at a time.

use eframe::egui;

use super::Viewer;
use crate::marks::mark;
use crate::panels::tools::Wish;

/// A screen that is narrower, points, has no room for both sides.
const NARROW: f32 = 760.0;

/// What is shown around the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Around {
    /// As much as there is room for: both sides, or nothing.
    #[default]
    Usual,
    Nothing,
    Tools,
    Parameters,
}

impl Around {
    /// What is really shown.
    fn on(self, narrow: bool) -> Self {
        if narrow && self == Self::Usual { Self::Nothing } else { self }
    }

    /// The next one.
    fn next(self, narrow: bool) -> Self {
        match (self.on(narrow), narrow) {
            (Self::Nothing, true) => Self::Tools,
            (Self::Tools, true) => Self::Parameters,
            (Self::Nothing, false) => Self::Usual,
            _ => Self::Nothing,
        }
    }
}

fn narrow(context: &egui::Context) -> bool {
    context.content_rect().width() < NARROW
}

impl Viewer {
    /// The sides.
    pub(super) fn sides(&mut self, ui: &mut egui::Ui, wishes: &mut Vec<Wish>) {
        // Laid out for the first time, each side takes long: one comes with each of the first pictures.
        let around = self.around.on(narrow(ui.ctx()));
        if self.pictures == 0 {
            return;
        }
        if matches!(around, Around::Usual | Around::Tools) {
            egui::Panel::left("tools").resizable(true).default_size(290.0).show(ui, |ui| self.side(ui, wishes));
        }
        if matches!(around, Around::Usual | Around::Parameters) && self.pictures > 1 {
            egui::Panel::right("parameters").resizable(true).default_size(330.0).show(ui, |ui| self.parameters(ui));
        }
    }

    /// The button that folds them.
    pub(super) fn fold(&mut self, ui: &mut egui::Ui, half: egui::Rect) {
        let place = egui::Rect::from_min_size(half.left_top() + egui::vec2(8.0, 8.0), egui::vec2(34.0, 30.0));
        let button = ui.put(place, egui::Button::new(egui::RichText::new("☰").size(18.0)).fill(egui::Color32::from_black_alpha(110)));
        mark(ui, "fold", button.rect);
        if button.on_hover_text("What lies around the picture").clicked() {
            self.around = self.around.next(narrow(ui.ctx()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_can_be_reached() {
        let turns = |narrow: bool, count: usize| {
            std::iter::successors(Some(Around::default()), |around| Some(around.next(narrow)))
                .map(|around| around.on(narrow))
                .take(count)
                .collect::<Vec<_>>()
        };
        assert_eq!(turns(false, 3), [Around::Usual, Around::Nothing, Around::Usual]);
        assert_eq!(turns(true, 4), [Around::Nothing, Around::Tools, Around::Parameters, Around::Nothing]);
    }
}
