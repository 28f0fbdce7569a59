//! Light under water. Twin of what pixels need: `water.wgsl`.
//!
//! Tuned for a believable pond or shallow sea; absorption as of clear coastal water (Jerlov 1976, type I to II at 650, 550 and 450 nm).

use glam::Vec3;

use super::common::exp3;
use super::sky::Light;

/// The functions of this file in WGSL.
pub const WGSL: &str = include_str!("water.wgsl");

/// Share of light lost per metre, 1/m.
const ABSORPTION: Vec3 = Vec3::new(0.38, 0.075, 0.060);
/// What water scatters back of the light in it.
const SCATTERED: Vec3 = Vec3::new(0.020, 0.125, 0.150);
/// Refractive index of water.
const INDEX: f32 = 1.33;

/// A light above the surface as it arrives `depth` m below: the sun stands steeper (Snell), and red goes first.
pub fn sunk(light: &Light, depth: f32) -> Light {
    let level = Vec3::new(light.sun.x, 0.0, light.sun.z) / INDEX;
    let sun = level + Vec3::Y * (1.0 - level.length_squared()).max(0.0).sqrt();
    let left = exp3(-ABSORPTION * depth);
    // Sky light comes in from all sides of the window above: a longer way.
    let sky = light.sky * exp3(-ABSORPTION * (1.2 * depth));
    Light { sun, sun_colour: light.sun_colour * exp3(-ABSORPTION * (depth / sun.y.max(0.1))), sky, ground: light.ground * left }
}

/// Radiance of endless water seen along the unit vector `ray`, under the light that has come down to the eye.
pub fn water(ray: Vec3, light: &Light) -> Vec3 {
    let up = 0.5 + 0.5 * ray.y;
    let arrived = light.sky + light.sun_colour * (0.20 * light.sun.y);
    arrived * SCATTERED * (0.35 + 1.3 * up * up)
}
