//! The chain response against the chain with nothing left out. Every comparison has a control that fails.

mod closed_form;
mod finite;
mod full;
mod lean_and_sway;
mod pendulum;
mod planted;
mod twin;
mod work;

use sward::response::chain::{Blade, ChainCoefficients, ChainState, DragLaw, Frame, calibrate, joints, step};
use sward::scene::Species;
use sward::wind::{Source, WindField};

/// Step of the scenes, s.
const STEP: f64 = 1.0 / 60.0;

fn blade(segments: u32, half_length: f64, mass: f64, [root, tip]: [f64; 2], damping_ratio: f64, drag: f64) -> Blade {
    let law = DragLaw::FourThirds;
    Blade { segments, half_length, mass, stiffness_root: root, stiffness_tip: tip, damping_ratio, drag, law, frequency: None }
}

/// The four species, by name.
fn species() -> [(&'static str, Blade); 4] {
    [
        ("lawn", Blade::of(&Species::Lawn)),
        ("meadow", Blade::of(&Species::Meadow)),
        ("reed", Blade::of(&Species::Reed)),
        ("tussock", Blade::of(&Species::Tussock)),
    ]
}

fn coefficients(blade: &Blade) -> ChainCoefficients {
    calibrate(blade).unwrap_or_else(|error| panic!("{error}"))
}

/// The chain as the paper prints it: springs as they are, inertia of a rod about its joint.
fn as_printed(blade: &Blade) -> ChainCoefficients {
    let mut co = coefficients(blade);
    let inertia = 4.0 / 3.0 * blade.mass * blade.half_length * blade.half_length;
    for (i, joint) in co.joints[..blade.segments as usize].iter_mut().enumerate() {
        joint.stiffness = blade.stiffness(i) as f32;
        joint.inertia = inertia as f32;
        joint.reach = 1.0;
        joint.damping = (2.0 * blade.damping_ratio * (blade.stiffness(i) * inertia).sqrt()) as f32;
    }
    co
}

/// The tip of a simplified chain, m from its root.
fn tip(co: &ChainCoefficients, base: &Frame, state: &ChainState) -> [f64; 3] {
    joints(base, 0.0, co, &state.bends())[co.segments as usize].map(f64::from)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt()
}

/// Wind of 4 m/s and 25 % turbulence at one place, a number for each step of `seconds`.
fn gusty(seconds: u64) -> Vec<[f32; 3]> {
    let source = Source::Natural { velocity: [4.0, 0.0], turbulence: 0.25 };
    let at = |number: u64| {
        let field = WindField::at(&[source], number, STEP, 0.5);
        let [x, z] = field.velocity(&field.patch_phases([0, 0], 64), [0, 0]);
        [x, 0.0, z]
    };
    (0..seconds * 60).map(at).collect()
}

/// A simplified chain after `steps` in the same wind.
fn settled(co: &ChainCoefficients, base: &Frame, wind: [f32; 3], dt: f32, steps: u32) -> ChainState {
    (0..steps).fold(ChainState::default(), |state, _| step(co, base, 0.0, wind, dt, &state))
}

/// Root mean square and 95th percentile.
fn spread(mut values: Vec<f64>) -> (f64, f64) {
    assert!(!values.is_empty());
    let rms = (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt();
    values.sort_by(f64::total_cmp);
    (rms, values[(values.len() * 95 / 100).min(values.len() - 1)])
}
