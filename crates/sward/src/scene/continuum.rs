//! Settings of the continuum response: bending spreads through the stand as a wave.
//!
//! Chen & Johan 2010, §4.3–4.4. People tune frequency and damping ratio; the equations use κ and λ:
//! κ = (2πf)², λ = 1 − e^(−ζ√κ/30), for steps of 1/60 s.

use super::error::{Problem, Trail};
use super::parameters::{choices, parameters, parameters_with_overrides};

choices! {
    /// How the upper segments of a plant trail behind the lower ones.
    pub enum Lag {
        /// Each segment follows the one below it through a low-pass filter.
        Cascade,
        /// Each segment shows the bend of some time ago (eq. 7).
        History,
        /// Each segment shows the bend of a place upstream (eq. 8 and 9); for comparison.
        Lookup,
    }
}

parameters_with_overrides! {
    /// How bending spreads, sways and fades.
    pub struct Continuum, ContinuumOverrides {
        /// Speed of the bending wave in still grass: how fast a push reaches the neighbours.
        c0: f32 = 2.0, "m/s" in 0.1..=10.0;
        /// How much faster the wave runs where the grass moves: added speed is mu times the bending velocity.
        mu: f32 = 0.06, "m/rad" in 0.0..=1.5;
        /// Speed at which bending velocity spreads.
        c_omega: f32 = 2.0, "m/s" in 0.1..=10.0;
        /// Share of the bend's change that is lost in 1/60 s: more is calmer and leaves a longer track.
        lambda_theta: f32 = 0.12, "" in 0.01..=0.95;
        /// Share of the bending velocity's change that is lost in 1/60 s.
        lambda_omega: f32 = 0.20, "" in 0.01..=0.95;
        /// Restoring strength: more recovers faster; 0 never stands up again.
        kappa: f32 = 114.0, "1/s²" in 0.0..=4000.0;
        /// Restoring strength of the bending velocity. Where kappa or frequency is given, it follows them.
        kappa_omega: f32 = 114.0, "1/s²" in 0.0..=4000.0;
        /// How far wind holds the plants: the tilt is atan(wind · speed^(4/3)), speed in m/s.
        wind: f32 = 0.0356, "" in 0.0..=1.0;
        /// How upper segments trail.
        lag: Lag = Lag::Cascade, "";
        /// Delay of the tip while bending goes on.
        gamma_top: f32 = 0.12, "s" in 0.0..=1.0;
        /// Delay of the tip while standing up.
        gamma_recover: f32 = 0.06, "s" in 0.0..=1.0;
    }
    extra {
        /// Frequency of swaying, instead of kappa.
        frequency: f32, "Hz" in 0.0..=10.0;
        /// Damping ratio of swaying, instead of lambda_theta: below 1 sways, above 1 creeps back.
        damping: f32, "" in 0.0..=10.0;
    }
}

impl Continuum {
    /// These values changed by `overrides`, with frequency and damping ratio turned into κ and λ.
    ///
    /// # Errors
    /// Both of two ways to say the same thing are given, or the damping ratio gives a λ outside its range.
    pub(super) fn tuned(&self, overrides: &ContinuumOverrides, trail: &Trail) -> Result<Self, Problem> {
        let both = |name, instead: &str| {
            let message = format!("both `{name}` and `{instead}` are given, and they mean the same");
            Err(Problem::at(trail.clone().key(name), message).help(format!("keep `{name}` or `{instead}`")))
        };
        if overrides.frequency.is_some() && overrides.kappa.is_some() {
            return both("frequency", "kappa");
        }
        if overrides.damping.is_some() && overrides.lambda_theta.is_some() {
            return both("damping", "lambda_theta");
        }
        let mut tuned = self.with(overrides);
        if let Some(frequency) = overrides.frequency {
            tuned.kappa = kappa_of(frequency);
        }
        let follows = overrides.frequency.is_some() || overrides.kappa.is_some();
        if follows && overrides.kappa_omega.is_none() {
            tuned.kappa_omega = tuned.kappa;
        }
        if let Some(damping) = overrides.damping {
            tuned.lambda_theta = lambda_of(damping, tuned.kappa);
            // Not left to the range check: the author wrote `damping`, so that is the word to complain about.
            if !(tuned.lambda_theta >= 0.01 && tuned.lambda_theta <= 0.95) {
                return Err(out_of_reach(damping, &tuned, trail));
            }
        }
        Ok(tuned)
    }

    /// Frequency of small swaying, √κ/2π in Hz.
    #[must_use]
    pub fn frequency(&self) -> f32 {
        self.kappa.sqrt() / std::f32::consts::TAU
    }
}

fn out_of_reach(damping: f32, tuned: &Continuum, trail: &Trail) -> Problem {
    let (frequency, lambda) = (tuned.frequency(), tuned.lambda_theta);
    let message = format!("`damping` {damping} at {frequency:.2} Hz needs lambda_theta {lambda:.3}, allowed 0.01 to 0.95");
    let change = if lambda < 0.5 { "raise `damping` or the frequency" } else { "lower `damping` or the frequency" };
    Problem::at(trail.clone().key("damping"), message).help(format!("{change}, or give `lambda_theta`"))
}

/// κ = (2πf)² in 1/s² of a frequency in Hz.
fn kappa_of(frequency: f32) -> f32 {
    let rate = std::f64::consts::TAU * f64::from(frequency);
    (rate * rate) as f32
}

/// λ = 1 − e^(−ζ√κ/30) of a damping ratio and κ in 1/s².
fn lambda_of(damping: f32, kappa: f32) -> f32 {
    (1.0 - decay(f64::from(damping) * f64::from(kappa).sqrt() / 30.0)) as f32
}

/// e^(−x) for 0 ≤ x ≤ 32, by halving, series and squaring: the same bits on every machine, which std does not promise.
fn decay(x: f64) -> f64 {
    let small = -x / 256.0;
    let series = (1..=12).rev().fold(1.0, |sum, order| 1.0 + sum * small / f64::from(order));
    (0..8).fold(series, |power, _| power * power)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Species;

    #[test]
    fn decay_is_the_exponential() {
        for step in 0..=320 {
            let x = f64::from(step) / 10.0;
            assert!((decay(x) / (-x).exp() - 1.0).abs() < 1e-12, "at {x}");
        }
    }

    /// The second row of numbers in the presets says the same as the first, in hertz and damping ratio.
    #[test]
    fn frequency_and_damping_give_the_species_back() {
        let rows =
            [(Species::Lawn, 1.33, 2.49), (Species::Meadow, 1.70, 0.36), (Species::Reed, 1.04, 0.43), (Species::Tussock, 3.18, 0.67)];
        for (species, frequency, damping) in rows {
            let preset = species.continuum();
            let overrides = ContinuumOverrides { frequency: Some(frequency), damping: Some(damping), ..Default::default() };
            let tuned = preset.tuned(&overrides, &Trail::default()).unwrap();
            assert!((tuned.kappa / preset.kappa - 1.0).abs() < 0.015, "{species:?} {tuned:?}");
            assert!((tuned.lambda_theta - preset.lambda_theta).abs() < 0.003, "{species:?} {tuned:?}");
            assert_eq!(tuned.kappa_omega, tuned.kappa);
            assert!((preset.frequency() - frequency).abs() < 0.01);
        }
    }

    #[test]
    fn nothing_overridden_is_the_species() {
        let preset = Species::Reed.continuum();
        assert_eq!(preset.tuned(&ContinuumOverrides::default(), &Trail::default()), Ok(preset));
    }
}
