//! A stand of plants that swing by themselves, compiled.
//!
//! Methods §2: `k = g + (2πf)² l₀`, `b = 2ζ(2πf) l₀`, `γ = b/(2 l₀)`, `ω₀² = (k − g)/l₀`; k, b and l₀ differ from plant to plant.

use bytemuck::{Pod, Zeroable};

use crate::math::{exp_f64, ln_f64};
use crate::scene::SpeciesModel;

/// m/s².
pub const GRAVITY: f64 = 9.81;
/// Deviation that counts as rest, rad.
const REST: f64 = 1e-3;
/// Largest deviation a plant starts from, and more: rad.
const LARGEST: f64 = 16.0;
/// How fast a bent plant turns towards where a body pushes it, rad/s; and how fast a body that does not move may bend it.
const PACE: f64 = 12.0;
/// Distance of the texels at which the wind's tilt is kept, m; less if cells are larger.
const TEXEL: f64 = 0.7;
/// Most steps until rest: records count 2²³.
const LONGEST: u32 = 1 << 21;
/// Most texels along a patch side.
const MOST_TEXELS: u32 = 256;

/// What is wrong with an oscillator.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OscillatorError {
    /// Gravity wins.
    #[error(
        "the blade cannot stand: its spring brings it back with k = {weakest:.2} m/s² per rad where the weakest plant is, gravity turns it over with \
         9.81; raise the frequency to {frequency:.2} Hz, `stiffness` to {stiffness:.1}, or lower `spread_stiffness`"
    )]
    CannotStand {
        /// k of the weakest plant.
        weakest: f64,
        /// Frequency that would do, Hz.
        frequency: f64,
        /// k that would do.
        stiffness: f64,
    },
}

/// Numbers that a step and a picture read. The same bytes are a uniform in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct OscillatorCoefficients {
    /// k of an average plant, m/s² per rad.
    pub stiffness: f32,
    /// b of an average plant, m/s.
    pub damping: f32,
    /// l₀ over a plant's height.
    pub scale: f32,
    /// How far a bent plant curves, 0 to 1.
    pub curve: f32,
    /// How far k and b differ from plant to plant, as shares.
    pub spreads: [f32; 2],
    /// Step, s.
    pub dt: f32,
    /// k_w/(k − g): the tilt in the wind is atan of it times speed^(4/3).
    pub wind: f32,
    /// Share of its way that the tilt in the wind goes in a step: 1 − e^(−ω₀Δt).
    pub follow: f32,
    /// Most turn of a bent plant in a step, and most bend that a body which does not move adds, rad.
    pub pace: f32,
    /// Steps after which a plant let go is at rest.
    pub settle: u32,
    /// Texels of the wind along a patch side; 0 where it is the same everywhere and for ever.
    pub texels: u32,
}

/// A stand, compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct OscillatorModel {
    /// Kernel numbers.
    pub coefficients: OscillatorCoefficients,
    /// Frequency of an average plant, Hz.
    pub frequency: f64,
    /// Its damping ratio.
    pub damping_ratio: f64,
    /// The numbers before they changed in the step being taken.
    pub former: Option<OscillatorCoefficients>,
    /// Wind that varies has just come.
    pub aired: bool,
}

impl OscillatorModel {
    /// Of a species; `None` if it does not swing by itself. `dt` s a step, patches of `patch_side` m; `varies`: the wind is not the same
    /// everywhere and for ever.
    ///
    /// # Errors
    /// A plant that cannot stand.
    pub fn of(species: &SpeciesModel, dt: f64, patch_side: f64, varies: bool) -> Option<Result<Self, OscillatorError>> {
        let given = species.oscillator.as_ref()?;
        let oscillator = &given.oscillator;
        let mean = 0.5 * f64::from(species.height[0] + species.height[1]);
        let length = given.length.map_or(mean, f64::from);
        let angular = std::f64::consts::TAU * f64::from(oscillator.frequency);
        let stiffness = given.stiffness.map_or(GRAVITY + angular * angular * length, f64::from);
        let [spread_k, spread_b] = [oscillator.spread_stiffness, oscillator.spread_damping].map(f64::from);
        let weakest = stiffness * (1.0 - spread_k);
        if weakest <= GRAVITY {
            let enough = 1.01 * GRAVITY / (1.0 - spread_k);
            let frequency = ((enough - GRAVITY) / length).sqrt() / std::f64::consts::TAU;
            return Some(Err(OscillatorError::CannotStand { weakest, frequency, stiffness: enough }));
        }
        let own = ((stiffness - GRAVITY) / length).sqrt();
        let damping = given.damping_coefficient.map_or(2.0 * f64::from(oscillator.damping) * own * length, f64::from);
        // The plants that take longest to come to rest are among the extreme ones.
        let mut slowest = f64::MAX;
        for height in species.height {
            let l = length * f64::from(height) / mean;
            for k in [stiffness * (1.0 - spread_k), stiffness * (1.0 + spread_k)] {
                for b in [damping * (1.0 - spread_b), damping * (1.0 + spread_b)] {
                    let rate = slow_rate(b / (2.0 * l), (k - GRAVITY) / l);
                    slowest = if rate < slowest { rate } else { slowest };
                }
            }
        }
        let settle = ln_f64(LARGEST / REST) / slowest / dt;
        let coefficients = OscillatorCoefficients {
            stiffness: stiffness as f32,
            damping: damping as f32,
            scale: (length / mean) as f32,
            curve: oscillator.curve,
            spreads: [spread_k as f32, spread_b as f32],
            dt: dt as f32,
            wind: (f64::from(oscillator.wind) / (stiffness - GRAVITY)) as f32,
            follow: (1.0 - exp_f64(-own * dt)) as f32,
            pace: (PACE * dt) as f32,
            settle: (settle.ceil() as u32).clamp(1, LONGEST),
            texels: 0,
        };
        let (frequency, damping_ratio) = (own / std::f64::consts::TAU, damping / (2.0 * own * length));
        let mut model = Self { coefficients, frequency, damping_ratio, former: None, aired: false };
        if varies {
            model.heed_places(patch_side);
            model.aired = false;
        }
        Some(Ok(model))
    }

    /// From now on the wind may not be the same everywhere and for ever: its tilt is kept at texels.
    pub(crate) fn heed_places(&mut self, patch_side: f64) {
        if self.coefficients.wind > 0.0 && self.coefficients.texels == 0 {
            self.aired = true;
            self.coefficients.texels = ((patch_side / TEXEL).ceil() as u32).next_multiple_of(8).min(MOST_TEXELS);
        }
    }
}

/// Height \[m\] below which the weakest plant of a stand falls over that swings at `frequency` \[Hz\] on average, where k differs by `spread` as a share up
/// and down: (1 − spread)(g + (2πf)² l₀) = g.
pub fn least_height(frequency: f64, spread: f64) -> f64 {
    let angular = std::f64::consts::TAU * frequency;
    GRAVITY * spread / ((1.0 - spread) * angular * angular)
}

/// How fast the slower part of the motion dies away, 1/s.
fn slow_rate(gamma: f64, omega_squared: f64) -> f64 {
    let over = gamma * gamma - omega_squared;
    if over > 0.0 { omega_squared / (gamma + over.sqrt()) } else { gamma }
}
