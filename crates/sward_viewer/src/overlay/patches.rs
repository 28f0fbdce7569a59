//! Which patches are awake, and why.

use eframe::egui::{Align2, Color32, FontId, Painter, Rect, Shape, Stroke, pos2};
use sward::state::{Awake, TILE};
use sward::world::World;

use crate::sight::Sight;

/// Reasons, and their colours.
const REASONS: [(&str, Color32); 4] = [
    ("pushed", Color32::from_rgb(255, 150, 50)),
    ("by the wind", Color32::from_rgb(90, 160, 255)),
    ("fading", Color32::from_rgb(190, 120, 255)),
    ("handing back", Color32::from_rgb(160, 160, 160)),
];
/// Parts of a side that follow the ground.
const PARTS: u32 = 6;

fn reason(awake: &Awake) -> usize {
    match awake {
        _ if awake.handing => 3,
        _ if awake.fading > 0 => 2,
        _ if awake.wind_only => 1,
        _ => 0,
    }
}

/// Fills and outlines awake patches.
pub(super) fn draw(painter: &Painter, sight: &Sight, world: &World) -> String {
    let side = world.model.patch_side;
    let mut counts = [0_usize; REASONS.len()];
    for (index, stand) in world.state.stands.iter().enumerate() {
        for (patch, awake) in stand.awake.iter().filter(|(patch, _)| **patch != TILE) {
            let why = reason(awake);
            counts[why] += 1;
            // Stands lie over each other: each a little further in than the one before.
            let inset = (0.02 + 0.05 * index as f64) * side;
            let low = patch.map(|along| f64::from(along) * side + inset);
            outline(painter, sight, world, low, side - 2.0 * inset, REASONS[why].1);
        }
    }
    let said: Vec<String> = REASONS.iter().zip(counts).map(|((name, _), count)| format!("{count} {name}")).collect();
    said.join(", ")
}

fn outline(painter: &Painter, sight: &Sight, world: &World, low: [f64; 2], side: f64, colour: Color32) {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut ring = Vec::new();
    for (k, from) in corners.iter().enumerate() {
        let to = corners[(k + 1) % 4];
        for part in 0..PARTS {
            let share = f64::from(part) / f64::from(PARTS);
            let [x, z] = [0, 1].map(|axis: usize| low[axis] + side * (from[axis] + (to[axis] - from[axis]) * share));
            ring.push([x, world.model.terrain.height_at(x, z) + 0.03, z]);
        }
    }
    let seen: Vec<_> = ring.iter().filter_map(|point| sight.at(*point)).collect();
    if seen.len() == ring.len() {
        painter.add(Shape::convex_polygon(seen, colour.gamma_multiply(0.13), Stroke::NONE));
    }
    for (k, from) in ring.iter().enumerate() {
        if let Some(line) = sight.line(*from, ring[(k + 1) % ring.len()]) {
            painter.line_segment(line, Stroke::new(1.3, colour));
        }
    }
}

/// What the colours mean.
pub(super) fn bar(painter: &Painter, area: Rect) {
    let width = area.width() / REASONS.len() as f32;
    for (k, (name, colour)) in REASONS.iter().enumerate() {
        let room = Rect::from_min_size(pos2(area.left() + width * k as f32, area.top()), eframe::egui::vec2(width, area.height()));
        painter.rect_filled(room, 0.0, *colour);
        painter.text(room.center(), Align2::CENTER_CENTER, &name[..1], FontId::proportional(9.0), Color32::BLACK);
    }
}
