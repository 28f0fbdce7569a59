//! Settings of the response that lets each plant swing by itself: a rigid rod on a spring joint that bodies push aside.
//!
//! Grass interaction by instigators (article); methods §2. People tune frequency and damping ratio; the equations use k, b and l₀:
//! k = g + (2πf)² l₀, b = 2ζ(2πf) l₀.

use super::error::{Problem, Trail};
use super::parameters::{parameters, parameters_with_overrides};

parameters_with_overrides! {
    /// How a plant of average height swings, and how the others differ.
    pub struct Oscillator, OscillatorOverrides {
        /// Frequency of swinging. Taller plants swing slower, shorter ones faster.
        frequency: f32 = 1.7, "Hz" in 0.05..=50.0;
        /// Damping ratio: below 1 sways, 1 returns soonest without swaying, above 1 creeps back.
        damping: f32 = 0.18, "" in 0.005..=100.0;
        /// How much the stiffness k differs from plant to plant, as a share up and down.
        spread_stiffness: f32 = 0.15, "" in 0.0..=0.9;
        /// How much the damping b differs from plant to plant, as a share up and down.
        spread_damping: f32 = 0.20, "" in 0.0..=0.9;
        /// Acceleration by which air of 1 m/s pushes a plant; grows with speed^(4/3).
        wind: f32 = 1.61, "m/s²" in 0.0..=1000.0;
        /// How far a bent plant curves: 0 is a straight rod, 1 hangs over at the tip. Upright and flattened plants are straight.
        curve: f32 = 0.4, "" in 0.0..=1.0;
    }
    extra {
        /// Stiffness k of the spring, instead of frequency; its rest above g = 9.81 m/s² brings the plant back.
        stiffness: f32, "m/s²/rad" in 0.0..=1000000.0;
        /// Damping b, instead of the ratio.
        damping_coefficient: f32, "m/s" in 0.0..=100000.0;
        /// Length l₀ of the rod of a plant of average height; without it that height.
        length: f32, "m" in 0.005..=20.0;
    }
}

/// How a stand of plants that swing by themselves is given, with every default filled in.
#[derive(Clone, Debug, PartialEq)]
pub struct Swinging {
    /// Frequency, damping ratio and the rest.
    pub oscillator: Oscillator,
    /// k \[m/s² per rad\], where it is given instead of the frequency.
    pub stiffness: Option<f32>,
    /// b \[m/s\], where it is given instead of the damping ratio.
    pub damping_coefficient: Option<f32>,
    /// l₀ \[m\], where it is not the mean height.
    pub length: Option<f32>,
}

impl Oscillator {
    /// These values changed by `overrides`.
    ///
    /// # Errors
    /// Both of two ways to say the same thing are given.
    pub(super) fn tuned(&self, overrides: &OscillatorOverrides, trail: &Trail) -> Result<Swinging, Problem> {
        let both = |name: &'static str, instead: &str| {
            let message = format!("both `{name}` and `{instead}` are given, and they mean the same");
            Err(Problem::at(trail.clone().key(name), message).help(format!("keep `{name}` or `{instead}`")))
        };
        if overrides.frequency.is_some() && overrides.stiffness.is_some() {
            return both("frequency", "stiffness");
        }
        if overrides.damping.is_some() && overrides.damping_coefficient.is_some() {
            return both("damping", "damping_coefficient");
        }
        Ok(Swinging {
            oscillator: self.with(overrides),
            stiffness: overrides.stiffness,
            damping_coefficient: overrides.damping_coefficient,
            length: overrides.length,
        })
    }
}
