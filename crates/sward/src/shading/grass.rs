//! Light on leaves: reflected, let through, and lost between the stems. Twin: `grass.wgsl`.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3, Vec3Swizzles};

use super::sky::Light;

const STRAW: Vec3 = Vec3::new(0.36, 0.29, 0.14);

/// Colour of a leaf. `along` 0 root ..= 1 tip, `dry` 0..=1, `patchwork` from [`super::common::patchwork`], `shade` of the blade.
#[inline]
pub fn leaf(root: Vec3, tip: Vec3, along: f32, dry: f32, patchwork: Vec3, shade: f32) -> Vec3 {
    let yellow = Vec3::new(1.0 + 0.34 * patchwork.x, 1.0 + 0.08 * patchwork.x, 1.0 - 0.30 * patchwork.x);
    let green = root.lerp(tip, along) * yellow;
    let straw = STRAW * (0.55 + 0.45 * along);
    green.lerp(straw, dry.clamp(0.0, 1.0)) * (shade * patchwork.z)
}

/// Radiance of a leaf. `normal` faces the viewer; `lit` is the share of sunlight that reaches it, `open` the share of sky, `through`
/// what it lets through. Leaves let through yellower light than they reflect, and more of it than any wall would.
#[inline]
pub fn grass(albedo: Vec3, normal: Vec3, view: Vec3, light: &Light, lit: f32, open: f32, through: f32) -> Vec3 {
    let facing = normal.dot(light.sun);
    let (front, back) = (facing.max(0.0), (-facing).max(0.0));
    let passed = albedo * Vec3::new(1.15, 1.35, 0.40) * through;
    let half_way = (light.sun + view).normalize_or_zero();
    let shine = normal.dot(half_way).max(0.0).powi(18) * front;
    let sky = light.ground.lerp(light.sky, 0.5 + 0.5 * normal.y);
    // Lying leaves seen at a flat angle mirror the sky, more of it towards the sun: that is what makes a track shine.
    let flat_angle = 1.0 - normal.dot(view).max(0.0);
    let level = |at: Vec3| (at.xz() + Vec2::new(1e-6, 0.0)).normalize();
    let towards = level(light.sun).dot(level(-view)).max(0.0);
    let mirrored = 0.45 * light.sky + light.sun_colour * (0.012 + 0.028 * towards * towards);
    let mirror = mirrored * (0.07 * open * normal.y.max(0.0) * flat_angle * flat_angle * flat_angle);
    let diffuse = albedo * (light.sun_colour * (lit * front * FRAC_1_PI) + sky * open);
    diffuse + passed * light.sun_colour * (lit * back * FRAC_1_PI) + light.sun_colour * (lit * shine * 0.035) + mirror
}
