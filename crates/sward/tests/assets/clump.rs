//! A mask: a clump with a ragged, soft edge, white inside and black outside.

use std::f64::consts::PI;

use sward::math::{atan2_f64, sin_cos_f64};

/// Pixels along a side.
pub(crate) const SIDE: u32 = 64;

/// How much grows at a place of the square from −1 to 1, 0 to 1.
fn shade(x: f64, z: f64) -> f64 {
    let angle = atan2_f64(z, x);
    let wave = |times: f64, phase: f64| sin_cos_f64(times * angle + phase * PI).0;
    let edge = 0.74 + 0.1 * wave(2.0, 0.2) + 0.07 * wave(3.0, 0.64) + 0.05 * wave(7.0, 0.0);
    let t = ((edge - x.hypot(z)) / 0.28).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The picture, row by row.
pub(crate) fn clump() -> Vec<u8> {
    let place = |index: u32| 2.0 * (f64::from(index) + 0.5) / f64::from(SIDE) - 1.0;
    (0..SIDE * SIDE).map(|pixel| (255.0 * shade(place(pixel % SIDE), place(pixel / SIDE)) + 0.5) as u8).collect()
}
