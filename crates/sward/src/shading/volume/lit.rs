//! Leaves, blades and ground in the light of a volume. Twin: `lit.wgsl`.
//!
//! Orthmann et al. 2009, §6.1: the colour of a plant's picture times "the incident two-sided light": what falls on the side that is seen,
//! and what shines through from behind.

use glam::{Vec2, Vec3, Vec4Swizzles};

use super::{Faces, facing};
use crate::math;
use crate::shading::blade::{self, BladeStyle};
use crate::shading::look::Turf;
use crate::shading::sky::Light;
use crate::shading::{grass, ground};

/// Light in WGSL; needs all other shading text before it.
pub const WGSL: &str = include_str!("lit.wgsl");

/// Far off plants show their upper parts: this share of the volume's height.
const TOPS: f32 = 0.7;
/// Plants that lie stand among others that lie too: their light is that of this share of the volume's height.
const LYING: f32 = 0.55;
/// Light that leaves let through is yellower than what they send back.
const PASSED: Vec3 = Vec3::new(1.15, 1.35, 0.40);

/// Share of the volume's height at which a leaf is lit: its own, `up`, but for plants that are far away or lie, both 0..=1.
pub fn rise(up: f32, far: f32, lying: f32) -> f32 {
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    mix(mix(up, math::upper(up, LYING), lying), math::upper(up, TOPS), far)
}

/// Radiance of a leaf as [`grass::grass`], under light from all sides.
pub fn leaf(albedo: Vec3, normal: Vec3, view: Vec3, light: &Light, lit: f32, faces: &Faces, through: f32) -> Vec3 {
    let (front, back) = (facing(faces, normal), facing(faces, -normal));
    // The volume gives what the sky gives there; sun, sheen and mirrored sun stay as they are.
    let dark = Light { sky: Vec3::ZERO, ground: Vec3::ZERO, ..*light };
    let sun = grass::grass(albedo, normal, view, &dark, lit, front.w, through);
    let flat_angle = 1.0 - math::upper(normal.dot(view), 0.0);
    let mirror = 0.45 * 0.07 * (math::upper(normal.y, 0.0) * flat_angle * flat_angle * flat_angle);
    sun + front.xyz() * (albedo + mirror) + albedo * PASSED * through * back.xyz()
}

/// Radiance of a blade as [`blade::blade`], under light from all sides.
pub fn blade(style: &BladeStyle, spot: &blade::Spot, surface: &blade::Surface, view: Vec3, light: &Light, lit: f32, faces: &Faces) -> Vec3 {
    let (front, back) = (facing(faces, surface.normal), facing(faces, -surface.normal));
    let sun = blade::shine(style, spot, &blade::Surface { open: 0.0, ..*surface }, view, light, lit);
    sun + surface.albedo * front.xyz() + surface.albedo * PASSED * style.tip[3] * back.xyz()
}

/// Radiance of the ground as [`ground::ground`]; `floor`: light between the plants on the ground, `tops`: light on them.
pub fn ground(
    turf: &Turf,
    p: Vec2,
    normal: Vec3,
    view: Vec3,
    distance: f32,
    pixel: f32,
    light: &Light,
    lit: f32,
    (floor, tops): (&Faces, &Faces),
) -> Vec3 {
    let above = Light { sky: facing(tops, normal).xyz(), ground: facing(tops, -normal).xyz(), ..*light };
    ground::ground_under(turf, p, normal, view, distance, pixel, &above, lit, facing(floor, normal).xyz())
}

/// Radiance of bare earth as [`ground::earth`].
pub fn earth(colour: Vec3, p: Vec2, normal: Vec3, view: Vec3, distance: f32, pixel: f32, light: &Light, lit: f32, floor: &Faces) -> Vec3 {
    ground::earth_under(colour, p, normal, view, distance, pixel, light, lit, facing(floor, normal).xyz())
}
