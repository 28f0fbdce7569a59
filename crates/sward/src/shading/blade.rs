//! A pixel of a blade: two-sided light that fails towards the root, and a rim of light where the ground is seen at a flat angle.
//!
//! Belyaev et al. 2011, §2.3; methods §3.7. Twin: `blade.wgsl`.
//! Differs from the paper: the highlight is (1 − N_t·V)¹⁰, of silhouettes; exponents are settings (docs/papers.md).

use std::f32::consts::FRAC_1_PI;

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4, Vec4Swizzles};

use super::grass::leaf;
use super::look::Look;
use super::sky::Light;
use crate::math::{self, smoothstep};
use crate::scene::Blade;

/// Blades' light in WGSL; needs `common` and `grass` before it.
pub const WGSL: &str = include_str!("blade.wgsl");

/// `BladeStyle` of `blade.wgsl`: how a stand's blades are coloured and lit, and how one number of pieces is drawn.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct BladeStyle {
    /// Colour at the root; w = dryness.
    pub root: [f32; 4],
    /// Colour at the tip; w = translucency C.
    pub tip: [f32; 4],
    /// Exponent of the sun's falloff, light of the sky at the root, silhouette K_s, distance where plants end \[m\].
    pub light: [f32; 4],
    /// Pieces, `vec4`s of a record, `vec4` of the first record, number of the pieces' level.
    pub shape: [u32; 4],
}

impl BladeStyle {
    /// Of a stand; `shape` as in the field.
    pub fn new(blade: &Blade, look: &Look, shape: [u32; 4]) -> Self {
        let with = |colour: [f32; 3], last: f32| [colour[0], colour[1], colour[2], last];
        Self {
            root: with(blade.colour_root, blade.dryness),
            tip: with(blade.colour_tip, blade.translucency),
            light: [blade.sun_falloff, blade.ambient_root, blade.silhouette, look.fade[1]],
            shape,
        }
    }
}

/// A place on a blade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Normal of the strip there, unit, either way round.
    pub facing: Vec3,
    /// Along the strip's width, unit.
    pub across: Vec3,
    /// From −1 at one edge to 1 at the other.
    pub side: f32,
    /// 0 root ..= 1 tip.
    pub along: f32,
    /// Normal of the ground at the root, unit.
    pub ground: Vec3,
    /// [`super::common::patchwork`] at the root.
    pub patchwork: Vec3,
    /// The blade's chance number, 0..1.
    pub tint: f32,
}

/// What of a blade does not depend on light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// What it sends back of light, linear RGB.
    pub albedo: Vec3,
    /// Towards the viewer, unit.
    pub normal: Vec3,
    /// 0 root ..= 1 tip.
    pub along: f32,
    /// How far away it is, 0..=1 where blades melt into the canopy.
    pub far: f32,
    /// Share of the sky that neighbours leave.
    pub open: f32,
}

/// Colour and normal of a blade at a place.
pub fn surface(style: &BladeStyle, spot: &Spot, view: Vec3, distance: f32) -> Surface {
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let [_, ambient_root, _, gone] = style.light;
    // Far off only tips are seen: they melt into the canopy's colour.
    let far = smoothstep(0.25 * gone, 0.7 * gone, distance);
    let along = math::clamped(spot.along, 0.0, 1.0);
    // A blade is a shallow gutter: its normal turns from edge to edge.
    let mut normal = (spot.facing + spot.across * (0.55 * spot.side)).normalize_or(Vec3::Y);
    if normal.dot(view) < 0.0 {
        normal = -normal;
    }
    let dry = style.root[3] + 0.55 * spot.patchwork.y + 0.9 * math::upper(spot.tint - 0.86, 0.0) / 0.14 * style.root[3].sqrt();
    let albedo = leaf(
        Vec4::from(style.root).xyz(),
        Vec4::from(style.tip).xyz(),
        mix(along, 0.6, far),
        dry,
        spot.patchwork,
        0.80 + 0.40 * (spot.tint * 7.0).fract(),
    );
    let open = mix(ambient_root + along * (1.0 - ambient_root), 0.75, far);
    Surface { albedo, normal, along, far, open }
}

/// Radiance of a blade. `lit`: share of the sun that bodies and plants nearer to it leave.
pub fn blade(style: &BladeStyle, spot: &Spot, view: Vec3, distance: f32, light: &Light, lit: f32) -> Vec3 {
    shine(style, spot, &surface(style, spot, view, distance), view, light, lit)
}

/// Radiance of a blade of which the surface is known.
pub fn shine(style: &BladeStyle, spot: &Spot, surface: &Surface, view: Vec3, light: &Light, lit: f32) -> Vec3 {
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let [falloff, _, silhouette, _] = style.light;
    let Surface { albedo, normal, along, far, open } = *surface;
    let sun = light.sun_colour * (lit * mix(along.powf(falloff), 0.6, far));
    let facing = normal.dot(light.sun);
    let (front, back) = (math::upper(facing, 0.0), math::upper(-facing, 0.0));
    let sky = light.ground.lerp(light.sky, 0.5 + 0.5 * normal.y);
    let passed = albedo * Vec3::new(1.15, 1.35, 0.40) * style.tip[3];
    // Wax: a narrow sheen of the sun along the blade.
    let half_way = (light.sun + view).normalize_or_zero();
    let squared = |x: f32| x * x;
    let shine = squared(squared(squared(squared(math::upper(normal.dot(half_way), 0.0))))) * front;
    let rim = 1.0 - math::upper(spot.ground.dot(view), 0.0);
    let rim = squared(squared(rim) * squared(rim)) * squared(rim);
    let sixth = squared(along * along * along);
    let silhouette = (0.35 * light.sky + light.sun_colour * (0.08 * lit)) * (silhouette * sixth * rim * (1.0 - far));
    albedo * (sun * (front * FRAC_1_PI) + sky * open) + passed * sun * (back * FRAC_1_PI) + sun * (0.04 * shine) + silhouette
}

/// Share of a pixel that a blade covers where it is narrower than a pixel: it is drawn a pixel wide. `width` at the place and height of a
/// pixel there, m. A little chance, so that blades before each other do not all cover the same samples.
pub fn coverage(width: f32, pixel: f32, tint: f32) -> f32 {
    let share = width / math::upper(pixel, 1e-9);
    let chance = (tint * 61.7).fract() - 0.5;
    math::clamped(share + if share < 1.0 { 0.24 * chance } else { 0.0 }, 0.0, 1.0)
}
