//! Random numbers without a state that others share: a key for each branch, a count within it.

use glam::Vec3;

use crate::math::{mixed, sin_cos, unit};

/// The choices of one branch.
#[derive(Clone, Copy)]
pub(super) struct Chance {
    key: u32,
    count: u32,
}

impl Chance {
    pub(super) fn new(key: u32) -> Self {
        Self { key: mixed(key ^ 0x5bd1_e995), count: 0 }
    }

    /// The key of child `number`.
    pub(super) fn child(&self, number: u32) -> u32 {
        mixed(self.key.wrapping_add(mixed(number ^ 0x85eb_ca6b)))
    }

    /// The next number, 0..1.
    pub(super) fn next(&mut self) -> f32 {
        self.count += 1;
        unit(mixed(self.key ^ mixed(self.count)))
    }

    /// The next number, within two.
    pub(super) fn within(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.next()
    }

    /// Any angle, rad.
    pub(super) fn turn(&mut self) -> f32 {
        self.within(0.0, std::f32::consts::TAU)
    }

    /// A vector with parts in −1..1.
    pub(super) fn vector(&mut self) -> Vec3 {
        let x = self.within(-1.0, 1.0);
        let y = self.within(-1.0, 1.0);
        Vec3::new(x, y, self.within(-1.0, 1.0))
    }
}

/// The golden angle, rad: what grows at it is nowhere above another.
pub(super) const GOLDEN: f32 = 2.399_963_2;

/// A direction at an angle from `forward`, round it by `around`; `side` is square to `forward`.
pub(super) fn leaning(forward: Vec3, side: Vec3, around: f32, angle: f32) -> Vec3 {
    let (sine, cosine) = sin_cos(angle);
    forward * cosine + ring(forward, side, around) * sine
}

/// A direction square to `forward`.
pub(super) fn ring(forward: Vec3, side: Vec3, around: f32) -> Vec3 {
    // Many turns lose digits: whole ones are taken off.
    let turns = crate::math::floored(around / std::f32::consts::TAU) as f32;
    let (sine, cosine) = sin_cos(around - turns * std::f32::consts::TAU);
    side * cosine + forward.cross(side) * sine
}

/// Some unit vector square to another.
pub(super) fn square_to(forward: Vec3) -> Vec3 {
    let other = if forward.y * forward.y < 0.8 { Vec3::Y } else { Vec3::X };
    forward.cross(other).normalize_or(Vec3::X)
}
