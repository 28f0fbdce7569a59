//! Places on the ground, spread evenly over the picture and yet fixed in the world: nothing swims when the camera moves.

use std::collections::BTreeSet;

use eframe::egui::pos2;
use sward::terrain::Terrain;

use crate::sight::Sight;

/// Points of the window from place to place.
const APART: f32 = 26.0;
/// No place is farther off, m.
const FARTHEST: f64 = 160.0;
/// Finest lattice, m.
const FINEST: f64 = 0.25;

/// A place: how coarse the lattice is there, and which of it.
pub(super) type Key = (i32, [i64; 2]);

/// Side of a lattice, m.
pub(super) fn side(level: i32) -> f64 {
    FINEST * f64::from(1_u32 << level)
}

/// Where a place is, m (x, z).
pub(super) fn middle((level, place): Key) -> [f64; 2] {
    place.map(|along| (along as f64 + 0.5) * side(level))
}

/// The places in sight, in order.
pub(super) fn places(sight: &Sight, terrain: &Terrain) -> Vec<Key> {
    let area = sight.area();
    let mut found = BTreeSet::new();
    let (columns, rows) = ((area.width() / APART) as usize, (area.height() / APART) as usize);
    for row in 0..=rows {
        for column in 0..=columns {
            let at = area.min + pos2(column as f32 * APART, row as f32 * APART).to_vec2();
            let Some(ground) = sight.ground(terrain, at) else { continue };
            let height = terrain.height_at(ground[0], ground[1]);
            let point = [ground[0], height, ground[1]];
            let away = (0..3).map(|axis| (point[axis] - sight.eye()[axis]).powi(2)).sum::<f64>().sqrt();
            if away > FARTHEST {
                continue;
            }
            let wanted = sight.metres(point) * f64::from(APART);
            let level = (wanted / FINEST).log2().ceil().clamp(0.0, 12.0) as i32;
            found.insert((level, ground.map(|metres| (metres / side(level)).floor() as i64)));
        }
    }
    found.into_iter().collect()
}
