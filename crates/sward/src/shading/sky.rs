//! Colour of sun and sky, for what the CPU must know: the light that falls on a scene.
//!
//! Twin of the colour part of `sky.wgsl`: single scattering in a thin shell with hand-fitted air masses. Not a measured model;
//! it is tuned for a believable low sun.

use glam::Vec3;

/// Radiance scale of the sun: irradiance outside the air, in the renderer's own unit.
const SUN: f32 = 20.0;
/// Optical depth of clean air towards the zenith at 680, 550 and 440 nm.
const RAYLEIGH: Vec3 = Vec3::new(0.049, 0.115, 0.281);

fn air_mass(up: f32) -> f32 {
    let y = up.max(0.0);
    1.0 / (y + 0.028 * (-9.0 * y).exp())
}

fn mie(haze: f32) -> f32 {
    0.012 + 0.075 * haze
}

fn fade(depth: Vec3) -> Vec3 {
    Vec3::new((-depth.x).exp(), (-depth.y).exp(), (-depth.z).exp())
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
