//! Light on leaves and wood of shrubs and trees; that of the sun apart, since shadows move over it. Twin: `crown.wgsl`.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::sky::Light;

/// Crowns in WGSL.
pub const WGSL: &str = include_str!("crown.wgsl");

/// Colour of light that leaves let through.
const PASSED: Vec3 = Vec3::new(1.15, 1.35, 0.40);
/// Share of light that leaves of crowns let through; wood none.
pub const THROUGH: f32 = 0.6;

/// Normal of a leaf as light sees it: its own, turned towards where its part of the crown faces; facing the viewer. All unit.
pub fn normal(own: Vec3, outwards: Vec3, view: Vec3) -> Vec3 {
    let facing = if own.dot(view) > 0.0 { own } else { -own };
    (facing + 0.7 * outwards + Vec3::new(0.0, 1e-4, 0.0)).normalize_or(Vec3::Y)
}

/// Colour of a leaf that differs from leaf to leaf by `chance` and from plant to plant by `tint`, 0 to 1; less of it deep in the crown, where `open` is 0.
pub fn colour(colour: Vec3, chance: f32, tint: f32, open: f32) -> Vec3 {
    let warm = 0.22 * (chance - 0.5) + 0.16 * (tint - 0.5);
    let bright = (0.82 + 0.36 * chance) * (0.72 + 0.28 * open);
    colour * bright * Vec3::new(1.0 + 1.3 * warm, 1.0 + 0.3 * warm, 1.0 - 0.9 * warm)
}

/// Radiance in full sun; `through`: share of light let through, 0 for wood.
pub fn sun(albedo: Vec3, normal: Vec3, view: Vec3, light: &Light, through: f32) -> Vec3 {
    let facing = normal.dot(light.sun);
    let (front, back) = (facing.max(0.0), (-facing).max(0.0));
    let passed = albedo * PASSED * through;
    let half_way = (light.sun + view).normalize_or_zero();
    let shine = normal.dot(half_way).max(0.0).powi(14) * front * through;
    light.sun_colour * ((albedo * front + passed * back) * FRAC_1_PI + shine * 0.05)
}

/// Radiance by the sky: `front` and `back` what it would make of white surfaces facing either way, `open` the share of it seen.
pub fn sky(albedo: Vec3, front: Vec3, back: Vec3, open: f32, through: f32) -> Vec3 {
    // What leaves throw at each other is green.
    let around = (albedo * 2.2).lerp(Vec3::ONE, open);
    albedo * (front + back * PASSED * (0.5 * through)) * (open + 0.10 * (1.0 - open)) * around
}
