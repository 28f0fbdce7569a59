//! Light on bodies: lacquer, rubber, glass and chrome. Twin: `body.wgsl`.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::sky::{Light, sky};
use crate::math::smoothstep;

/// What a mirror facing `direction` would see.
pub fn mirrored(direction: Vec3, roughness: f32, light: &Light, haze: f32) -> Vec3 {
    let level = Vec3::new(direction.x, direction.y.max(0.02), direction.z).normalize();
    let above = sky(level, light.sun, haze).lerp(light.sky, roughness);
    (light.ground * 0.8).lerp(above, smoothstep(-0.08 - 0.4 * roughness, 0.06 + 0.4 * roughness, direction.y))
}

/// Radiance of a body of `colour`. `surface`: roughness, gloss, openness to the sky. `normal` faces the viewer; `lit`: share of the sun
/// that arrives.
pub fn body(colour: Vec3, surface: Vec3, normal: Vec3, view: Vec3, light: &Light, haze: f32, lit: f32) -> Vec3 {
    let [roughness, gloss, open] = surface.to_array();
    let lit = lit * normal.dot(light.sun).max(0.0);
    let half_way = (light.sun + view).normalize_or_zero();
    let grazing = (1.0 - normal.dot(view).max(0.0)).powi(5);
    let fresnel = gloss + (1.0 - gloss) * grazing * (1.0 - roughness) * (1.0 - roughness);
    let sharp = 2.0 / (roughness * roughness * roughness * roughness).max(1e-4);
    let lobe = ((sharp + 8.0) * 0.0398).min(60.0) * normal.dot(half_way).max(0.0).powf(sharp);
    let sky = light.ground.lerp(light.sky, 0.5 + 0.5 * normal.y) * open;
    let diffuse = colour * (1.0 - fresnel) * (light.sun_colour * (lit * FRAC_1_PI) + sky);
    let mirror = mirrored(-view - 2.0 * normal.dot(-view) * normal, roughness, light, haze) * fresnel * open;
    let tinted = if gloss >= 0.3 { colour * 1.6 } else { Vec3::ONE };
    diffuse + tinted * (mirror + light.sun_colour * (lit * lobe * gloss))
}
