//! Noise, air and tone curve shared by all shading. Twin: `common.wgsl`.

use glam::{Vec2, Vec3};

use crate::math::{exp, floored, smoothstep};

/// The pattern of the ground repeats after this many metres; hosts hand in positions modulo this.
pub const PERIOD: f64 = 1024.0;

/// A random number of 0..1 for a lattice point.
#[inline]
pub fn hash(x: i32, z: i32, salt: u32) -> f32 {
    let mut h = (x as u32)
        .wrapping_mul(0x8da6_b343)
        .wrapping_add((z as u32).wrapping_mul(0xd816_3841))
        .wrapping_add(salt.wrapping_mul(0xcb1a_b31f));
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    h ^= h >> 15;
    (h >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// Value noise, 0..1, one lattice cell per unit of `p`. Cells wrap after `cells` (a power of two).
#[inline]
pub fn noise(p: Vec2, cells: i32, salt: u32) -> f32 {
    let (x, z) = (floored(p.x), floored(p.y));
    let f = p - Vec2::new(x as f32, z as f32);
    let w = f * f * (3.0 - 2.0 * f);
    let [ax, az] = [x & (cells - 1), z & (cells - 1)];
    let [bx, bz] = [(ax + 1) & (cells - 1), (az + 1) & (cells - 1)];
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let low = mix(hash(ax, az, salt), hash(bx, az, salt), w.x);
    let high = mix(hash(ax, bz, salt), hash(bx, bz, salt), w.x);
    mix(low, high, w.y)
}

/// How a meadow varies over space at `p` (metres modulo [`PERIOD`]): x = hue, -1 (bluish) ..= 1 (yellowish); y = extra dryness, 0..=1;
/// z = vigour (brightness), 0.7..=1.3.
pub fn patchwork(p: Vec2) -> Vec3 {
    let broad = noise(p / 32.0, 32, 11);
    let middle = noise(p / 8.0, 128, 12);
    let small = noise(p / 2.0, 512, 13);
    let dry = noise(p / 16.0, 64, 14) * 0.6 + middle * 0.25 + small * 0.15;
    Vec3::new(
        1.1 * (broad - 0.5) + 0.7 * (middle - 0.5) + 0.3 * (small - 0.5),
        smoothstep(0.44, 0.78, dry),
        0.72 + 0.36 * middle + 0.20 * small,
    )
}

/// What is left of light after `distance` metres of air of a `density`, 1/m.
#[inline]
pub fn fog(distance: f32, density: f32) -> f32 {
    exp(-density * distance)
}

/// e to the power of each component.
#[inline]
pub(super) fn exp3(v: Vec3) -> Vec3 {
    Vec3::new(exp(v.x), exp(v.y), exp(v.z))
}

/// Film-like curve: linear radiance times exposure to display value 0..=1, still linear.
#[inline]
pub fn tone(radiance: Vec3) -> Vec3 {
    let luminance = radiance.dot(Vec3::new(0.2126, 0.7152, 0.0722));
    // Very bright colours wash out, as they do on film.
    let grey = Vec3::splat(luminance);
    let vivid = grey.lerp(radiance, 1.15).max(Vec3::ZERO);
    let washed = vivid.lerp(grey, luminance / (luminance + 14.0));
    let shoulder = Vec3::ONE - exp3(-washed);
    let toe = washed / (washed + 0.055);
    (shoulder * toe.lerp(Vec3::ONE, 0.5)).clamp(Vec3::ZERO, Vec3::ONE)
}

/// Linear display value to sRGB code value, both 0..=1.
#[inline]
pub fn encode(linear: Vec3) -> Vec3 {
    let channel = |value: f32| if value <= 0.003_130_8 { value * 12.92 } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 };
    Vec3::new(channel(linear.x), channel(linear.y), channel(linear.z))
}
