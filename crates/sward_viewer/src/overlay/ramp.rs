//! Colours of numbers.

use eframe::egui::{Color32, Painter, Rect, Stroke, pos2};

use super::{Kind, patches};

/// From nothing (0) to much (1): blue, green, yellow, red.
const STOPS: [[f32; 3]; 5] = [[70.0, 110.0, 235.0], [40.0, 190.0, 215.0], [90.0, 215.0, 90.0], [245.0, 215.0, 60.0], [250.0, 70.0, 50.0]];

/// The colour of a share, 0 to 1.
pub(super) fn colour(share: f64) -> Color32 {
    let at = (share.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64) as f32;
    let low = (at as usize).min(STOPS.len() - 2);
    let part = at - low as f32;
    let mixed = [0, 1, 2].map(|k| (STOPS[low][k] + (STOPS[low + 1][k] - STOPS[low][k]) * part) as u8);
    Color32::from_rgb(mixed[0], mixed[1], mixed[2])
}

/// A bar of what colours mean.
pub(super) fn bar(painter: &Painter, area: Rect, kind: Kind) {
    if kind == Kind::Patches {
        return patches::bar(painter, area);
    }
    let parts = 24;
    let width = area.width() / parts as f32;
    for part in 0..parts {
        let left = area.left() + width * part as f32;
        let room = Rect::from_min_max(pos2(left, area.top()), pos2(left + width + 0.5, area.bottom()));
        painter.rect_filled(room, 0.0, colour(f64::from(part) / f64::from(parts - 1)));
    }
    painter.rect_stroke(area, 0.0, Stroke::new(1.0, Color32::from_white_alpha(90)), eframe::egui::StrokeKind::Outside);
}
