//! The sun in a picture of the surroundings: found, measured, and taken out.

use glam::Vec3;

use super::{Environment, angle};

/// The sun and its glare reach no farther from its middle, rad.
const REACH: f64 = 0.044;
/// Less than this share of all light of the sky is no sun.
const LEAST: f64 = 0.04;
/// Lowest sine of its height: a light near the horizon may be a lamp.
const LOWEST: f64 = 0.02;
/// Radius of the disc that is drawn, as a cosine: half a degree, twice the true one, so that small pictures show it.
pub(super) const DISC: f32 = 0.999_962;
/// Brightest disc: what a picture holds.
const BRIGHTEST: f32 = 30_000.0;

/// A sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Towards it, unit.
    pub direction: Vec3,
    /// Irradiance of a surface that faces it, linear RGB.
    pub irradiance: Vec3,
}

impl Sun {
    /// Radiance of the disc that is drawn, times `strength`: all of the sun's light, where that can be stored.
    pub fn disc(&self, strength: f32) -> Vec3 {
        let solid = std::f32::consts::TAU * (1.0 - DISC);
        let disc = self.irradiance * (strength / solid);
        disc * (BRIGHTEST / disc.max_element().max(BRIGHTEST))
    }
}

fn luminance(colour: [f32; 3]) -> f64 {
    0.2126 * f64::from(colour[0]) + 0.7152 * f64::from(colour[1]) + 0.0722 * f64::from(colour[2])
}

/// What is brighter around a direction than the sky farther around it.
struct Glow {
    /// Mean radiance of that sky.
    ring: [f64; 3],
    /// Irradiance of a surface that faces it.
    irradiance: [f64; 3],
    /// Sum of directions, by luminance.
    towards: [f64; 3],
}

impl Glow {
    /// Within `reach` \[rad\] of a direction; the sky is looked at twice as far.
    fn around(environment: &Environment, middle: [f64; 3], reach: f64) -> Self {
        let (mut ring, mut weight) = ([0.0; 3], 0.0);
        environment.pixels(|direction, solid, at| {
            if (reach..2.0 * reach).contains(&angle(direction, middle)) {
                (0..3).for_each(|channel| ring[channel] += f64::from(environment.radiance[at][channel]) * solid);
                weight += solid;
            }
        });
        let mut glow = Self { ring: ring.map(|sum| sum / f64::max(weight, 1e-12)), irradiance: [0.0; 3], towards: [0.0; 3] };
        environment.pixels(|direction, solid, at| {
            if angle(direction, middle) < reach {
                let over = |channel: usize| (f64::from(environment.radiance[at][channel]) - glow.ring[channel]).max(0.0) * solid;
                let own = [0, 1, 2].map(over);
                let weight = 0.2126 * own[0] + 0.7152 * own[1] + 0.0722 * own[2];
                for k in 0..3 {
                    glow.irradiance[k] += own[k];
                    glow.towards[k] += weight * direction[k];
                }
            }
        });
        glow
    }

    /// Its middle, unit; `None` where nothing is brighter.
    fn middle(&self) -> Option<[f64; 3]> {
        let length = self.towards.iter().map(|part| part * part).sum::<f64>().sqrt();
        (length > 0.0).then(|| self.towards.map(|part| part / length))
    }
}

/// Takes the sun out of the picture, if there is one: what is brighter near the brightest pixel than the sky around it.
pub(super) fn take(environment: &mut Environment) {
    let (mut peak, mut brightest, mut all) = ([0.0, 1.0, 0.0], 0.0, 0.0);
    environment.pixels(|direction, solid, at| {
        let bright = luminance(environment.radiance[at]);
        all += if direction[1] > 0.0 { bright * solid } else { 0.0 };
        if bright > brightest {
            (peak, brightest) = (direction, bright);
        }
    });
    // A sun of few pixels fills them to their corners.
    let reach = REACH.max(1.5 * std::f64::consts::TAU / f64::from(environment.columns));
    // The brightest place may be a corner of the sun: its middle is looked for from there.
    let Some(middle) = Glow::around(environment, peak, reach).middle() else { return };
    let glow = Glow::around(environment, middle, reach);
    let strong = luminance(glow.irradiance.map(|value| value as f32)) > LEAST * all;
    let Some(direction) = glow.middle().filter(|middle| strong && middle[1] > LOWEST) else { return };
    let [direction, irradiance] = [direction, glow.irradiance].map(|value| Vec3::from(value.map(|value| value as f32)));
    environment.sun = Some(Sun { direction: direction.normalize_or(Vec3::Y), irradiance });
    let mut inside = Vec::new();
    environment.pixels(|direction, _, at| inside.extend((angle(direction, middle) < reach).then_some(at)));
    for at in inside {
        for (value, ring) in environment.radiance[at].iter_mut().zip(glow.ring) {
            *value = value.min(ring as f32);
        }
    }
}
