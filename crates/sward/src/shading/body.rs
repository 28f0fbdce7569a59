//! Light on bodies: lacquer, rubber, glass and chrome. Twin: `body.wgsl`.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::sky::{Light, sky};
use crate::math::smoothstep;

/// What a mirror facing `direction` would see.
pub fn mirrored(direction: Vec3, roughness: f32, light: &Light, haze: f32) -> Vec3 {
    reflected(direction, roughness, light, sky(level(direction), light.sun, haze))
}

/// Where a mirror looks in the sky: never below the horizon.
pub fn level(direction: Vec3) -> Vec3 {
    Vec3::new(direction.x, direction.y.max(0.02), direction.z).normalize()
}

/// What a mirror facing `direction` would see of a sky that has the radiance `seen` in [`level`]'s direction.
pub fn reflected(direction: Vec3, roughness: f32, light: &Light, seen: Vec3) -> Vec3 {
    let above = seen.lerp(light.sky, roughness);
    (light.ground * 0.8).lerp(above, smoothstep(-0.08 - 0.4 * roughness, 0.06 + 0.4 * roughness, direction.y))
}

/// Radiance of a body of `colour`. `surface`: roughness, gloss, openness to the sky. `normal` faces the viewer; `lit`: share of the sun
/// that arrives.
pub fn body(colour: Vec3, surface: Vec3, normal: Vec3, view: Vec3, light: &Light, haze: f32, lit: f32) -> Vec3 {
    let mirrored = mirrored(mirror(normal, view), surface.x, light, haze);
    body_seeing(colour, surface, normal, view, light, lit, mirrored)
}

/// Where a surface mirrors the eye's ray to.
pub fn mirror(normal: Vec3, view: Vec3) -> Vec3 {
    -view - 2.0 * normal.dot(-view) * normal
}

/// As [`body`]; `mirrored`: what a mirror there would see.
pub fn body_seeing(colour: Vec3, surface: Vec3, normal: Vec3, view: Vec3, light: &Light, lit: f32, mirrored: Vec3) -> Vec3 {
    let [roughness, gloss, open] = surface.to_array();
    let lit = lit * normal.dot(light.sun).max(0.0);
    let half_way = (light.sun + view).normalize_or_zero();
    let grazing = (1.0 - normal.dot(view).max(0.0)).powi(5);
    let fresnel = gloss + (1.0 - gloss) * grazing * (1.0 - roughness) * (1.0 - roughness);
    let sharp = 2.0 / (roughness * roughness * roughness * roughness).max(1e-4);
    let lobe = ((sharp + 8.0) * 0.0398).min(60.0) * normal.dot(half_way).max(0.0).powf(sharp);
    let sky = light.ground.lerp(light.sky, 0.5 + 0.5 * normal.y) * open;
    let diffuse = colour * (1.0 - fresnel) * (light.sun_colour * (lit * FRAC_1_PI) + sky);
    let mirror = mirrored * fresnel * open;
    let tinted = if gloss >= 0.3 { colour * 1.6 } else { Vec3::ONE };
    diffuse + tinted * (mirror + light.sun_colour * (lit * lobe * gloss))
}
