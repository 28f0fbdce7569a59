//! Sky, sun and clouds: single scattering in a thin shell with hand-fitted air masses. Twin: `sky.wgsl`.
//!
//! Not a measured model; it is tuned for a believable low sun.

use glam::{Vec2, Vec3};

use super::common::{exp3, noise};
use crate::math::{atan2, exp, smoothstep};

/// Radiance scale of the sun: irradiance outside the air, in the renderer's own unit.
const SUN: f32 = 20.0;
/// Optical depth of clean air towards the zenith at 680, 550 and 440 nm.
const RAYLEIGH: Vec3 = Vec3::new(0.049, 0.115, 0.281);

fn air_mass(up: f32) -> f32 {
    let y = up.max(0.0);
    1.0 / (y + 0.028 * exp(-9.0 * y))
}

fn mie(haze: f32) -> f32 {
    0.012 + 0.075 * haze
}

fn fade(depth: Vec3) -> Vec3 {
    exp3(-depth)
}

/// Share of the sun's light that arrives through `share` (0..=1) of the air, for a sun whose direction has height `sun_up`.
pub fn sun_share(sun_up: f32, haze: f32, share: f32) -> Vec3 {
    fade((RAYLEIGH + Vec3::splat(mie(haze))) * (share * air_mass(sun_up)))
}

/// Radiance of clear air towards the unit vector `direction`; `sun` is the unit vector towards the sun, `haze` 0..=1.
pub fn sky(direction: Vec3, sun: Vec3, haze: f32) -> Vec3 {
    let mie = mie(haze);
    let cosine = direction.dot(sun);
    let up = direction.y.clamp(0.0, 1.0);
    let depth = RAYLEIGH + Vec3::splat(mie);
    let opacity = Vec3::ONE - fade(depth * air_mass(direction.y));
    let rayleigh = 0.0597 * (1.0 + cosine * cosine);
    let g = 0.70;
    let forward = 0.0796 * (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine).powf(1.5);
    let phase = (RAYLEIGH * rayleigh + Vec3::splat(mie * forward)) / depth;
    let share = 1.55 + (0.18 - 1.55) * up.sqrt();
    let direct = phase * sun_share(sun.y, haze, share);
    let diffuse = Vec3::new(0.026, 0.030, 0.038) * (Vec3::splat(0.35) + 0.65 * sun_share(sun.y, haze, 0.5));
    SUN * opacity * (direct + diffuse * (1.0 - 0.5 * up))
}

/// Colour that the air adds between the eye and far away, by direction of the ray.
pub fn air(ray: Vec3, sun: Vec3, haze: f32) -> Vec3 {
    let air = sky(Vec3::new(ray.x, ray.y.max(0.0) + 0.03, ray.z).normalize(), sun, haze);
    // Near the sun the glow of near air is softer than that of the whole sky behind it.
    air * (0.80 / (1.0 + 0.10 * air.dot(Vec3::new(0.3, 0.6, 0.1))))
}

/// The disc and its glare.
pub fn sun_disc(direction: Vec3, sun: Vec3, haze: f32) -> Vec3 {
    let cosine = direction.dot(sun);
    let disc = smoothstep(0.99988, 0.99996, cosine);
    let glare = 0.06 * exp(-(1.0 - cosine) * 1200.0) + 0.008 * exp(-(1.0 - cosine) * 80.0);
    SUN * sun_share(sun.y, haze, 1.2) * (6.0 * disc + glare * (1.0 + haze))
}

fn cloud_density(p: Vec2) -> f32 {
    let (mut sum, mut weight, mut q) = (0.0, 0.5, p);
    for octave in 0..5 {
        sum += weight * noise(q, 256, 40 + octave);
        weight *= 0.5;
        q = Vec2::new(0.8 * q.x - 0.6 * q.y, 0.6 * q.x + 0.8 * q.y) * 2.03 + 7.3;
    }
    sum
}

/// Clouds over clear air: colour, and how much of the air behind is hidden.
pub fn clouds(direction: Vec3, sun: Vec3, haze: f32, cover: f32, drift: Vec2) -> (Vec3, f32) {
    let flat = |v: Vec3| Vec2::new(v.x, v.z);
    let up = direction.y.max(0.0);
    let density = cloud_density(flat(direction) / (up + 0.10) * 0.9 + drift);
    let threshold = 0.68 + (0.30 - 0.68) * cover;
    let body = smoothstep(threshold, threshold + 0.22, density);
    // Far clouds sink into the haze of the horizon.
    let near = smoothstep(0.015, 0.22, up);
    if body * near <= 0.0 {
        return (Vec3::ZERO, 0.0);
    }
    let toward = flat(direction) + flat(sun) * 0.06;
    let lit = cloud_density((toward / (up + 0.10)) * 0.9 + drift);
    let depth = ((lit - threshold) * 3.2).clamp(0.0, 1.0);
    let cosine = direction.dot(sun);
    let silver = 0.10 + 0.55 * (0.5 + 0.5 * cosine).max(0.0).powi(9);
    let light = SUN * 1.5 * sun_share(sun.y, haze, 1.2) * silver * exp(-2.2 * depth);
    let level = Vec3::new(direction.x, 0.05, direction.z).normalize();
    let shade = sky(Vec3::Y, sun, haze) * 1.1 + 0.25 * sky(level, sun, haze);
    (light + shade, body * near * (0.92 - 0.3 * (1.0 - depth)))
}

/// Ridges at the edge of the world: elevation of the skyline as the tangent of its angle, for a ridge of `salt`.
fn ridge(direction: Vec3, salt: u32, base: f32, relief: f32) -> f32 {
    let turn = atan2(direction.z, direction.x) * (64.0 / std::f32::consts::TAU) + 32.0;
    let p = Vec2::new(turn, 0.5);
    let shape = 0.55 * noise(p * 0.5, 32, salt)
        + 0.28 * noise(p, 64, salt + 1)
        + 0.12 * noise(p * 4.0, 256, salt + 2)
        + 0.05 * noise(p * 16.0, 1024, salt + 3);
    base + relief * shape
}

/// The whole backdrop: air, sun, clouds and two blue ridges.
pub fn backdrop(direction: Vec3, sun: Vec3, haze: f32, cover: f32, drift: Vec2) -> Vec3 {
    let air = sky(direction, sun, haze);
    let (cloud, hidden) = clouds(direction, sun, haze, cover, drift);
    let colour = (air + sun_disc(direction, sun, haze)).lerp(cloud, hidden);
    let slope = direction.y / Vec2::new(direction.x, direction.z).length().max(1e-4);
    let soft = 0.0012;
    let far = smoothstep(-soft, soft, ridge(direction, 71, 0.012, 0.055) - slope);
    let near = smoothstep(-soft, soft, ridge(direction, 91, -0.006, 0.045) - slope);
    if far <= 0.0 && near <= 0.0 {
        return colour;
    }
    let level = sky(Vec3::new(direction.x, 0.02, direction.z).normalize(), sun, haze);
    colour.lerp(level * Vec3::new(0.66, 0.72, 0.84), far).lerp(level * Vec3::new(0.50, 0.57, 0.64), near)
}

/// The light that falls on a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Unit vector towards the sun.
    pub sun: Vec3,
    /// Irradiance of a surface that faces the sun, linear RGB.
    pub sun_colour: Vec3,
    /// Mean radiance of the sky, weighted for level ground, linear RGB.
    pub sky: Vec3,
    /// Mean radiance that comes up from the ground, linear RGB.
    pub ground: Vec3,
}

impl Light {
    /// Light of a sun at `azimuth` (0 = +x, towards +z) and `elevation`, both radians, through `haze` 0..=1.
    ///
    /// `strength` scales the sun; clouds (0..=1) take some of it away and give a part back as sky light.
    pub fn new(azimuth: f32, elevation: f32, strength: f32, haze: f32, clouds: f32) -> Self {
        let (sine, cosine) = elevation.sin_cos();
        let sun = Vec3::new(cosine * azimuth.cos(), sine, cosine * azimuth.sin());
        let sun_colour = SUN * 1.45 * strength * (1.0 - 0.35 * clouds) * sun_share(sun.y, haze, 1.25);
        let mut sum = Vec3::ZERO;
        let mut weights = 0.0;
        for ring in 0..4 {
            let up = (ring as f32 + 0.5) / 4.0;
            let level = (1.0 - up * up).sqrt();
            for step in 0..8 {
                let turn = step as f32 * std::f32::consts::FRAC_PI_4 + azimuth + 0.3;
                let direction = Vec3::new(level * turn.cos(), up, level * turn.sin());
                sum += up * sky(direction, sun, haze);
                weights += up;
            }
        }
        // Clouds and all that single scattering leaves out brighten the shade.
        let sky = sum / weights * strength * (1.55 + 0.4 * clouds);
        let ground = Vec3::new(0.10, 0.12, 0.05) * (sky + sun_colour * (sun.y.max(0.0) / std::f32::consts::PI));
        Self { sun, sun_colour, sky, ground }
    }
}
