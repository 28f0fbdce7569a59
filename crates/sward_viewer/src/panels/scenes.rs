//! The menu of scenes.

use eframe::egui::{self, Align2, Color32, FontId, Rect, Sense, Stroke, pos2, vec2};
use sward_scenes::{SHIPPED, Shipped};

use crate::marks::mark;
use crate::source::Source;
use crate::thumbnails;

/// Height of the menu, points.
const HEIGHT: f32 = 236.0;

/// What a scene's own first lines say of it.
fn about(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix("//")).map(str::trim);
    lines.collect::<Vec<_>>().join(" ")
}

/// Shows all scenes; the answer is one that was chosen.
pub fn show(ui: &mut egui::Ui, now: Option<&Source>) -> Option<Source> {
    let mut chosen = None;
    let current = now.map(Source::name);
    let width = (ui.available_width() - 2.0 * ui.spacing().item_spacing.x - 6.0) / 3.0;
    egui::ScrollArea::vertical().id_salt("scenes").max_height(HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
        for row in SHIPPED.chunks(3) {
            ui.horizontal(|ui| {
                for shipped in row {
                    if tile(ui, shipped, width, current.as_deref() == Some(shipped.name)) {
                        chosen = Some(Source::Shipped(shipped));
                    }
                }
            });
        }
    });
    chosen
}

/// One scene: its picture and its name. Whether it was chosen.
fn tile(ui: &mut egui::Ui, shipped: &Shipped, width: f32, current: bool) -> bool {
    let (area, response) = ui.allocate_exact_size(vec2(width, width * 0.5625), Sense::click());
    mark(ui, &format!("scene {}", shipped.name), area);
    let painter = ui.painter_at(area);
    if let Some(picture) = thumbnails::of(ui.ctx(), shipped.name) {
        painter.image(picture.id(), area, Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0)), Color32::WHITE);
    }
    let foot = Rect::from_min_max(pos2(area.left(), area.bottom() - 15.0), area.max);
    painter.rect_filled(foot, 0.0, Color32::from_black_alpha(140));
    painter.text(foot.center(), Align2::CENTER_CENTER, shipped.name, FontId::proportional(11.5), Color32::WHITE);
    let edge = match (current, response.hovered()) {
        (true, _) => Stroke::new(2.0, ui.visuals().selection.stroke.color),
        (false, true) => Stroke::new(1.0, Color32::WHITE),
        _ => Stroke::new(1.0, Color32::from_white_alpha(30)),
    };
    painter.rect_stroke(area, 0.0, edge, egui::StrokeKind::Inside);
    response.on_hover_text(about(shipped.text)).clicked()
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_scene_says_what_it_is() {
        for shipped in sward_scenes::SHIPPED {
            assert!(super::about(shipped.text).len() > 20, "{}", shipped.name);
        }
    }
}
