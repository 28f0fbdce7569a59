//! A pixel of a plant's card: its mip level, coverage and light. Twin: `foliage.wgsl`.

use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};

use super::grass::{grass, leaf};
use super::look::Style;
use super::sky::Light;
use crate::math::{exp, sin_cos, smoothstep};

/// Share of the sun that neighbours leave to a leaf, on average: holds where the shadow map does not reach.
pub const MEAN_LIT: f32 = 0.62;

/// A place on a card.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Card {
    /// Along the card, unit.
    pub across: Vec3,
    /// Out of the card, unit.
    pub facing: Vec3,
    /// 0 root ..= 1 tip.
    pub along: f32,
    /// How much it lies down, 0..=1.
    pub lying: f32,
    /// [`super::common::patchwork`] at the plant's root.
    pub patchwork: Vec3,
    /// The plant's chance number, 0..1.
    pub tint: f32,
}

/// Mip level for a pixel, from how far texel coordinates move `across` and `down` one pixel.
///
/// A pixel's print on a slanted card is long and narrow; its longer side alone would blur all blades into one, so the level follows the
/// print's area and stays within two of the longer side's.
#[inline]
pub fn level(across: Vec2, down: Vec2) -> f32 {
    let area = across.perp_dot(down).abs().max(1e-6);
    let longer = across.length_squared().max(down.length_squared()).max(1e-6);
    // One logarithm: the greater of ½ log₂ area and ½ log₂ longer − 2.
    (0.5 * area.max(longer * 0.0625).log2() - 0.35).max(0.0)
}

/// Cards that are nearly seen on edge are let go: factor on alpha.
#[inline]
pub fn on_edge(facing: Vec3, view: Vec3) -> f32 {
    0.35 + 0.65 * smoothstep(0.03, 0.20, facing.dot(view).abs())
}

/// A rim one pixel wide, whatever the mip level: alpha becomes coverage of the four samples. `change`: of alpha over a pixel.
#[inline]
pub fn rim(alpha: f32, change: f32, gone: f32, distance: f32) -> f32 {
    let fading = 1.0 - smoothstep(0.65 * gone, 0.95 * gone, distance);
    fading * ((alpha - 0.5) / change.max(0.02) + 0.5).clamp(0.0, 1.0)
}

/// What of a leaf does not depend on how the sky lights it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// What it sends back of light, linear RGB.
    pub albedo: Vec3,
    /// Towards the viewer, unit.
    pub normal: Vec3,
    /// How far away it is, 0..=1 where plants melt into the canopy.
    pub far: f32,
    /// Share of the sky that neighbours leave.
    pub open: f32,
    /// Share of the sun that they leave.
    pub reached: f32,
}

/// The leaf that `texel` shows (shade, dryness, facing, 0..=1).
pub fn surface(style: &Style, card: &Card, texel: Vec3, view: Vec3, distance: f32, light: &Light) -> Surface {
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let (root, tip) = (Vec4::from(style.root), Vec4::from(style.tip));
    let [sky_at_root, fade, _, gone] = style.mean;
    // Far off only the tops of plants are seen, whatever part of a card covers the pixel: they melt into the canopy's colour.
    let far = smoothstep(0.25 * gone, 0.7 * gone, distance);
    // Where a pixel's centre lies outside its triangle, the place is extrapolated: below the root there is no square root.
    let along = card.along.clamp(0.0, 1.0);
    let (sine, cosine) = sin_cos((texel.z - 0.5) * 2.6);
    let mut normal = (card.facing * cosine + card.across * sine + Vec3::new(0.0, 0.18, 0.0)).normalize_or_zero();
    if normal.dot(view) <= 0.0 {
        normal = -normal;
    }
    let dry = texel.y + root.w + 0.55 * card.patchwork.y + 0.3 * (card.tint - 0.75).max(0.0);
    let shade = texel.x * (0.86 + 0.28 * card.tint);
    let albedo = leaf(root.xyz(), tip.xyz(), mix(along, 0.6, far), dry, card.patchwork, shade);
    // Neighbours hide the sky and, with a low sun, the sun from all but the tips.
    let open = mix(mix(mix(sky_at_root, 1.0, along * along.sqrt()), 0.9, card.lying), 0.7, far);
    let reach = 1.0 - along;
    let reached = mix(mix(exp(-fade * reach * reach / (0.25 + light.sun.y)), 0.9, card.lying), 0.6, far);
    Surface { albedo, normal, far, open, reached }
}

/// Radiance of the leaf that `texel` shows (shade, dryness, facing, 0..=1). `lit`: share of the sun that arrives at the plant.
pub fn foliage(style: &Style, card: &Card, texel: Vec3, view: Vec3, distance: f32, light: &Light, lit: f32) -> Vec3 {
    let leaf = surface(style, card, texel, view, distance, light);
    grass(leaf.albedo, leaf.normal, view, light, lit * leaf.reached, leaf.open, style.tip[3])
}
