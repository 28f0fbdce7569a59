//! What bodies sweep.

use eframe::egui::{Align2, Color32, FontId, Painter, Shape, Stroke};
use sward::world::World;

use crate::sight::Sight;

const COLOUR: Color32 = Color32::from_rgb(255, 90, 70);

/// Outlines on the ground of what bodies swept in the last step.
pub(super) fn swept(painter: &Painter, sight: &Sight, world: &World) -> String {
    let (prints, mut named) = (world.swept_now(), None);
    for (body, outline) in &prints {
        let ring: Vec<[f64; 3]> = outline.iter().map(|[x, z]| [*x, world.model.terrain.height_at(*x, *z) + 0.02, *z]).collect();
        let seen: Vec<_> = ring.iter().filter_map(|point| sight.at(*point)).collect();
        if seen.len() == ring.len() && seen.len() > 2 {
            if named != Some(*body) {
                let name = world.model.bodies.get(*body).map_or("", |body| &body.name);
                painter.text(seen[0], Align2::LEFT_BOTTOM, name, FontId::proportional(12.0), COLOUR);
                named = Some(*body);
            }
            painter.add(Shape::convex_polygon(seen, COLOUR.gamma_multiply(0.25), Stroke::NONE));
        }
        for (k, from) in ring.iter().enumerate() {
            if let Some(line) = sight.line(*from, ring[(k + 1) % ring.len()]) {
                painter.line_segment(line, Stroke::new(1.5, COLOUR));
            }
        }
    }
    format!("{} convex pieces", prints.len())
}
