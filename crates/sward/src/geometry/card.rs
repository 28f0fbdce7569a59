//! Crossed cards along a spine: where a card's corners stand, and which way it faces. Twin: `card.wgsl`.

use glam::Vec3;

use crate::math;

/// Cards in WGSL.
pub const WGSL: &str = include_str!("card.wgsl");

/// Across a card at one joint: its corners stand at `middle` ± 0.5 `width` `across`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CardRung {
    /// Between the two corners, m.
    pub middle: Vec3,
    /// Along the card, unit.
    pub across: Vec3,
    /// Out of the card, unit.
    pub facing: Vec3,
    /// Between the corners, m.
    pub width: f32,
    /// How much the card lies down, 0..=1.
    pub lying: f32,
}

impl CardRung {
    /// The corner on a side, -1 or 1, m.
    pub fn corner(&self, side: f32) -> Vec3 {
        self.middle + self.across * (0.5 * self.width * side)
    }
}

/// The rung at joint `here` of a spine that begins at `base`, between the joints `low` and `high`, m. `turn`: heading of the card, rad.
/// `lift`: cards that lie are stacked, in steps of 18 mm. `keep`: share of its size that a fading plant keeps.
pub fn rung([base, here, low, high]: [Vec3; 4], turn: f32, width: f32, lift: f32, keep: f32) -> CardRung {
    let tangent = (high - low + Vec3::new(0.0, 1e-5, 0.0)).normalize();
    let (sine, cosine) = math::sin_cos(turn);
    let flat_side = Vec3::new(cosine, 0.0, sine);
    // Turn the side with the stem, then let lying cards spread on the ground instead of standing on edge.
    let carried = flat_side - flat_side.dot(tangent) / (1.0 + tangent.y).max(0.1) * (tangent + Vec3::Y);
    let level = (Vec3::new(-tangent.z, 0.0, tangent.x) + Vec3::new(1e-4, 0.0, 0.0)).normalize();
    let spread = if carried.dot(level) > 0.0 { level } else { -level };
    let lying = math::smoothstep(0.35, 0.95, 1.0 - tangent.y);
    let across = carried.lerp(spread + 0.25 * carried * Vec3::new(1.0, 0.0, 1.0), lying).normalize();
    let middle = base + (here - base) * keep + Vec3::new(0.0, lying * 0.018 * lift, 0.0);
    CardRung { middle, across, facing: across.cross(tangent).normalize(), width: width * (1.0 + 0.35 * lying) * keep, lying }
}
