//! One response from another: the numbers with which it moves a plant the same way.
//!
//! Frequency and damping ratio come from both motions after a release. What the continuum needs besides is what Chen & Johan 2010 leave to future work,
//! "the optimal values of the parameters (c, λ and γ values) based on the botanical property of the grass": λ follows from the damping ratio, c from
//! height and distance of stems ([`reach`]), γ from how late the tip of a blade follows its foot ([`trails`]).

use super::experiment::{ExperimentError, blade_of, let_go};
use super::reach::reach;
use super::swing::Swing;
use crate::math::exp_f64;
use crate::response::chain::{Trail, trails};
use crate::response::continuum::{LagCoefficients, cascade};
use crate::scene::{Continuum, ContinuumOverrides, Response, SpeciesModel, Stand};

/// Times that frequency and damping ratio are corrected.
const CORRECTIONS: usize = 6;
/// Shares by which frequency and damping ratio may be off in the end.
const MISSED: [f64; 2] = [0.01, 0.03];
/// Digits that are kept of what is found.
const DIGITS: usize = 4;
/// Halvings of the search for γ, from 0 to 1 s.
const HALVINGS: usize = 20;
/// Least and greatest c that a scene may have, m/s.
const SPEEDS: [f64; 2] = [0.1, 10.0];
/// The same of λ.
const LOSSES: [f64; 2] = [0.01, 0.95];

/// A response whose numbers come from another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Translation {
    /// How the plants swing as they are.
    pub from: Swing,
    /// How they swing with the response found.
    pub to: Swing,
    /// That response, as a scene has it.
    pub response: Response,
    /// R²: the share of the motion after a release that the response found explains.
    pub r_squared: f64,
    /// What of it is no number of the response that it comes from, and where it is from instead.
    pub notes: Vec<String>,
}

impl Translation {
    /// The response of a stand, as another `kind` of response would have it; patches are `patch_side` \[m\] wide. What `kind` already says besides
    /// stays.
    ///
    /// # Errors
    /// One of the two does not swing, or needs numbers that a scene may not have.
    pub fn of(stand: &Stand, kind: &Response, patch_side: f32) -> Result<Self, ExperimentError> {
        let before = let_go(stand)?;
        let from = before.swing();
        let mut notes = Vec::new();
        let mut base = kind.clone();
        if let Response::Continuum(overrides) = &mut base {
            *overrides = spreading(stand, &from, patch_side, overrides, &mut notes)?;
        }
        if let (Response::Harmonic(overrides), None | Some(Response::Continuum(_))) = (&mut base, &stand.response) {
            overrides.speed = overrides.speed.or(Some(stand.resolve()?.continuum.c0));
            notes.push("speed: that of the wave".to_owned());
        }
        let with = |frequency: f64, damping: f64| Stand { response: Some(set(&base, frequency, damping)), ..stand.clone() };
        let (mut frequency, mut damping) = (from.frequency, from.damping_ratio);
        for _ in 0..CORRECTIONS {
            let swing = let_go(&with(frequency, damping))?.swing();
            frequency *= from.frequency / swing.frequency;
            damping *= from.damping_ratio / swing.damping_ratio;
        }
        let found = with(frequency, damping);
        let after = let_go(&found)?;
        let (response, to) = (found.response.unwrap_or_else(|| kind.clone()), after.swing());
        let off = |to: f64, from: f64| (to / from - 1.0).abs();
        if off(to.frequency, from.frequency) > MISSED[0] || off(to.damping_ratio, from.damping_ratio) > MISSED[1] {
            notes.push("this response cannot swing so: compare both lines above".to_owned());
        }
        Ok(Self { from, to, response, r_squared: before.explained_by(&after), notes })
    }
}

/// A kind of response that swings as was measured, as a scene has it: with that frequency and damping ratio, to four digits. One that has neither
/// stays as it is.
#[must_use]
pub fn response_of(kind: &Response, swing: &Swing) -> Response {
    set(kind, swing.frequency, swing.damping_ratio)
}

/// The same for a frequency \[Hz\] and a damping ratio.
fn set(response: &Response, frequency: f64, damping: f64) -> Response {
    let (frequency, damping) = (rounded(frequency), rounded(damping));
    let mut response = response.clone();
    match &mut response {
        Response::Continuum(overrides) => {
            (overrides.frequency, overrides.kappa) = (Some(frequency), None);
            (overrides.damping, overrides.lambda_theta) = (Some(damping), None);
        }
        Response::Oscillator(overrides) => {
            (overrides.frequency, overrides.stiffness) = (Some(frequency), None);
            (overrides.damping, overrides.damping_coefficient) = (Some(damping), None);
        }
        Response::Chain(overrides) | Response::VirtualInertia(overrides) => {
            (overrides.frequency, overrides.damping) = (Some(frequency), Some(damping));
        }
        Response::Harmonic(overrides) => (overrides.frequency, overrides.damping) = (Some(frequency), Some(damping)),
        Response::Springs(_) => {}
    }
    response
}

/// Four digits of a number.
fn rounded(value: f64) -> f32 {
    let text = format!("{value:.*e}", DIGITS - 1);
    text.parse().unwrap_or(value as f32)
}

/// What the continuum needs besides frequency and damping ratio, where `asked` does not give it.
fn spreading(
    stand: &Stand,
    from: &Swing,
    patch_side: f32,
    asked: &ContinuumOverrides,
    notes: &mut Vec<String>,
) -> Result<ContinuumOverrides, ExperimentError> {
    let species = stand.resolve()?;
    let mut found = asked.clone();
    let height = 0.5 * f64::from(species.height[0] + species.height[1]);
    let distance = stem_distance(stand, &species, patch_side);
    let reach = reach(height, distance);
    let speed = (std::f64::consts::TAU * from.frequency * reach).clamp(SPEEDS[0], SPEEDS[1]);
    notes.push(format!(
        "c0 and c_omega: in plants {height:.3} m high whose stems stand {distance:.3} m apart a press reaches {reach:.3} m; times 2π frequency, {} to {} m/s",
        SPEEDS[0], SPEEDS[1]
    ));
    found.c0 = asked.c0.or(Some(rounded(speed)));
    found.c_omega = asked.c_omega.or(found.c0);
    let lambda = 1.0 - exp_f64(-from.damping_ratio * std::f64::consts::TAU * from.frequency / 30.0);
    found.lambda_omega = asked.lambda_omega.or(Some(rounded(lambda.clamp(LOSSES[0], LOSSES[1]))));
    notes.push("lambda_omega: the bending velocity dies away as the bend does".to_owned());
    let trails = blade_of(&species).map(|blade| trails(&blade)).transpose()?.flatten();
    let Some([bending, recovering]) = trails else {
        let rigid = species.oscillator.is_some();
        if rigid {
            (found.gamma_top, found.gamma_recover) = (asked.gamma_top.or(Some(0.0)), asked.gamma_recover.or(Some(0.0)));
        }
        let why = if rigid {
            "are 0: the tip of a rigid rod does not trail"
        } else {
            "stay as the species has them: no chain says how its tip trails"
        };
        notes.push(format!("gamma_top and gamma_recover {why}"));
        return Ok(found);
    };
    notes.push(format!(
        "gamma_top and gamma_recover: the tip of the full chain follows its foot {:.3} s later when that is turned over, {:.3} s when it is let go",
        bending.lag, recovering.lag
    ));
    let delay = |trail: &Trail| Some(rounded(delay_of(trail, species.segments())));
    found.gamma_top = asked.gamma_top.or_else(|| delay(&bending));
    found.gamma_recover = asked.gamma_recover.or_else(|| delay(&recovering));
    Ok(found)
}

/// Mean distance of stems, m: a plant of a cell is as many blades as it would be drawn with.
fn stem_distance(stand: &Stand, species: &SpeciesModel, patch_side: f32) -> f64 {
    let cell = f64::from(patch_side) / f64::from(species.cells);
    let blades = species.blade.as_ref().map_or(stand.species.blade().blades, |blade| blade.blades);
    cell / (f64::from(blades) * f64::from(stand.cover)).sqrt()
}

/// γ \[s\] with which the cascade of so many segments is as late as a blade whose foot moves in the same way; 0 to 1.
fn delay_of(trail: &Trail, segments: u32) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        (low, high) = if cascade_lag(trail, segments, middle) < trail.lag { (middle, high) } else { (low, middle) };
    }
    0.5 * (low + high)
}

/// How much later than the foot the cascade's tip is half-way, s.
fn cascade_lag(trail: &Trail, segments: u32, gamma: f64) -> f64 {
    let continuum = Continuum { gamma_top: gamma as f32, gamma_recover: gamma as f32, ..Continuum::default() };
    let lag = LagCoefficients::new(&continuum, segments, trail.dt);
    let (from, held) = (trail.foot[0], 0.5);
    let mut upper = vec![from as f32; 2 * (segments as usize - 1)];
    let tip = upper.len() - 2;
    let mut passed = [None; 2];
    for (step, foot) in trail.foot.iter().enumerate() {
        cascade(&lag, [&[*foot as f32], &[*foot as f32]], &mut upper);
        for (passed, place) in passed.iter_mut().zip([*foot, f64::from(upper[tip])]) {
            if passed.is_none() && (place - held) * (from - held) <= 0.0 {
                *passed = Some(step as f64 * trail.dt);
            }
        }
    }
    // What has not come half-way is later than all that can be measured.
    match passed {
        [Some(foot), Some(tip)] => tip - foot,
        _ => f64::INFINITY,
    }
}
