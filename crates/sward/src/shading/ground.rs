//! Ground: bare turf near by, and the mean of a whole canopy further away. Twin: `ground.wgsl`.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::{Vec2, Vec3, Vec4Swizzles};

use super::common::{noise, patchwork};
use super::grass::leaf;
use super::look::Turf;
use super::sky::Light;
use crate::math::smoothstep;

fn flat(v: Vec3) -> Vec2 {
    (Vec2::new(v.x, v.z) + Vec2::new(1e-5, 0.0)).normalize_or_zero()
}

/// Share of the sun that upright leaves of random heading send to the viewer: x reflected, y let through.
///
/// For leaf normals spread evenly over the half turn that faces the viewer, weighted by what is seen of them: with p the angle between
/// the two horizontal directions, ((π − p) cos p + sin p) / 4 and (sin p − p cos p) / 4.
pub fn canopy_split(view: Vec3, sun: Vec3) -> Vec2 {
    let cosine = flat(view).dot(flat(sun)).clamp(-1.0, 1.0);
    let angle = cosine.acos();
    let sine = (1.0 - cosine * cosine).sqrt();
    let level = (1.0 - sun.y * sun.y).max(0.0).sqrt();
    level * 0.25 * Vec2::new((PI - angle) * cosine + sine, sine - angle * cosine)
}

/// Radiance of a canopy seen from so far away that single leaves vanish. `albedo` is the leaves' mean colour.
pub fn canopy(albedo: Vec3, normal: Vec3, view: Vec3, light: &Light, lit: f32, through: f32) -> Vec3 {
    let split = canopy_split(view, light.sun);
    let top = normal.dot(light.sun).max(0.0);
    let front = 0.75 * split.x + 0.25 * top;
    // Looking down, one sees the shaded depth between the tips.
    let depth = 1.0 - 0.45 * normal.dot(view).max(0.0);
    let passed = albedo * Vec3::new(1.15, 1.35, 0.40) * (through * 0.64 * split.y);
    let sky = light.ground.lerp(light.sky, 0.62);
    (light.sun_colour * (lit * FRAC_1_PI * 0.33) * (albedo * front + passed) + albedo * sky * 0.45) * depth
}

/// Brightness pattern of turf, about 1; waves shorter than `footprint` metres (one pixel on the ground) are left out.
pub fn turf(p: Vec2, footprint: f32) -> f32 {
    let waves = [
        (Vec2::splat(0.5), 512, 21, 0.25, [0.5, 2.0]),
        (Vec2::splat(2.0), 2048, 22, 0.40, [0.12, 0.5]),
        (Vec2::splat(8.0), 8192, 23, 0.50, [0.03, 0.12]),
        (Vec2::splat(32.0), 32768, 24, 0.60, [0.008, 0.03]),
        (Vec2::new(128.0, 64.0), 65536, 25, 0.9, [0.003, 0.012]),
    ];
    let mut sum = 0.0;
    for (scale, cells, salt, height, [low, high]) in waves {
        let share = 1.0 - smoothstep(low, high, footprint);
        if share > 0.0 {
            sum += (noise(p * scale, cells, salt) - 0.5) * height * share;
        }
    }
    (1.0 + sum).max(0.15)
}

/// Radiance of the ground at `p` (metres modulo the pattern's period), seen along `view` from `distance` metres. `pixel`: height of one
/// pixel at distance 1; `lit`: share of the sun that arrives.
pub fn ground(turf_of: &Turf, p: Vec2, normal: Vec3, view: Vec3, distance: f32, pixel: f32, light: &Light, lit: f32) -> Vec3 {
    ground_under(turf_of, p, normal, view, distance, pixel, light, lit, light.sky * 0.20)
}

/// As [`ground`]; `floor`: what white ground between the plants would send back of the sky's light.
pub fn ground_under(
    turf_of: &Turf,
    p: Vec2,
    normal: Vec3,
    view: Vec3,
    distance: f32,
    pixel: f32,
    light: &Light,
    lit: f32,
    floor: Vec3,
) -> Vec3 {
    let patchwork = patchwork(p);
    let (root, tip) = (glam::Vec4::from(turf_of.root), glam::Vec4::from(turf_of.tip));
    let [shade, cover, end, _] = turf_of.mean;
    // The longer side of a pixel's print on the ground.
    let footprint = distance * pixel / normal.dot(view).max(0.03);
    let grain = turf(p, footprint);
    let dry = root.w + 0.55 * patchwork.y * (1.0 - root.w);
    let leaf = leaf(root.xyz(), tip.xyz(), 0.72, dry, patchwork, shade);
    // Under near plants lies litter and shade; from afar only the canopy's mean is seen.
    let bare = 1.0 - smoothstep(0.35 * end, 0.9 * end, distance);
    let canopy = canopy(leaf, normal, view, light, lit, tip.w) * (1.0 + (grain - 1.0) * 0.6);
    let litter = Vec3::new(0.060, 0.046, 0.022).lerp(leaf * 0.7, 0.55) * grain;
    let shaded = litter * (light.sun_colour * (lit * 0.12 * normal.dot(light.sun).max(0.0)) + floor);
    (canopy * (1.5 - 0.5 * cover)).lerp(shaded, bare * cover)
}

/// Radiance of bare earth: `colour` is what it sends back of light. The rest as in [`ground`].
pub fn earth(colour: Vec3, p: Vec2, normal: Vec3, view: Vec3, distance: f32, pixel: f32, light: &Light, lit: f32) -> Vec3 {
    earth_under(colour, p, normal, view, distance, pixel, light, lit, light.sky.lerp(light.ground, 0.25) * 0.85)
}

/// As [`earth`]; `floor`: what white ground would send back of the sky's light.
pub fn earth_under(
    colour: Vec3,
    p: Vec2,
    normal: Vec3,
    view: Vec3,
    distance: f32,
    pixel: f32,
    light: &Light,
    lit: f32,
    floor: Vec3,
) -> Vec3 {
    let footprint = distance * pixel / normal.dot(view).max(0.03);
    let grain = turf(p, footprint);
    let broad = 0.80 + 0.40 * noise(p * 0.25, 256, 31);
    let albedo = colour * (broad * (0.45 + 0.55 * grain));
    albedo * (light.sun_colour * (lit * FRAC_1_PI * normal.dot(light.sun).max(0.0)) + floor)
}

/// How far the rim of bare ground strays at `p`, m: no road has an edge like a ruler's.
pub fn stray(p: Vec2) -> Vec2 {
    let along = |salt: u32| 0.30 * (noise(p, 1024, salt) - 0.5) + 0.22 * (noise(p * 4.0, 4096, salt + 2) - 0.5);
    Vec2::new(along(32), along(33))
}
