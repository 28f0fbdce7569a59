//! `sward compare --reference`: blades as simplified chains, and without a state, against the chain with nothing left out.

use std::fmt::Write;

use sward::math::{hash, unit};
use sward::response::chain::{
    Blade, ChainCoefficients, ChainError, ChainState, Frame, FullChain, UPRIGHT, calibrate, first_mode, joints, moments, planted, pose,
    step, turned,
};
use sward::scene::Species;
use sward::wind::{Source, WindField};

use crate::console::Console;
use crate::failure::Failure;
use crate::progress::Progress;

/// Step, s.
const STEP: f64 = 1.0 / 60.0;
/// Steps that settle, and steps that count: a minute.
const SETTLING: u64 = 120;
const COUNTED: u64 = 3600;
/// Blades of each species, planted any way round; the first one upright.
const BLADES: u32 = 4;
/// Most tilt of the others, rad.
const TILT: f32 = 0.3;
/// Wind, m/s along x, and turbulence.
const WIND: (f32, f32) = (4.0, 0.25);

/// How far tips are from those of the full chain, in lengths of the blade.
#[derive(Default)]
struct Off(Vec<f64>);

impl Off {
    /// Root mean square and 95th percentile, %.
    fn summed(mut self) -> [f64; 2] {
        let rms = (self.0.iter().map(|off| off * off).sum::<f64>() / self.0.len().max(1) as f64).sqrt();
        self.0.sort_by(f64::total_cmp);
        let p95 = self.0.get(self.0.len() * 95 / 100).copied().unwrap_or(0.0);
        [100.0 * rms, 100.0 * p95]
    }
}

/// Runs all species and prints a table.
pub(crate) fn run(console: &Console) -> Result<(), Failure> {
    let species = [Species::Lawn, Species::Meadow, Species::Reed, Species::Tussock];
    let mut progress = Progress::new(species.len() as u64 * u64::from(BLADES), "blades", console);
    let mut text = format!(
        "Tips against those of the full chain over a gusty minute: {} m/s, {} % turbulence, steps of 1/60 s; % of a blade's length.\n\
         {BLADES} blades of each species, planted any way round with up to {TILT} rad of tilt.\n\n\
         {:10} {:>10} {:>24} {:>24}\n{:10} {:>10} {:>14} {:>9} {:>14} {:>9}\n",
        WIND.0,
        100.0 * WIND.1,
        "species",
        "sways, Hz",
        "simplified chain",
        "virtual inertia",
        "",
        "",
        "rms",
        "p95",
        "rms",
        "p95"
    );
    for species in species {
        let blade = Blade::of(&species);
        let sways = first_mode(&blade).map_or(0.0, |mode| mode.frequency);
        let [simplified, shown] = measured(&blade, &mut progress).map_err(|error| Failure::failed(error.to_string()))?;
        let name = format!("{species:?}").to_lowercase();
        let ([a, a95], [b, b95]) = (simplified.summed(), shown.summed());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:10} {sways:10.2} {a:14.2} {a95:9.2} {b:14.2} {b95:9.2}");
    }
    drop(progress);
    console.answer(&text)
}

/// The wind at one place, step by step.
fn wind(number: u64) -> [f32; 3] {
    let source = Source::Natural { velocity: [WIND.0, 0.0], turbulence: WIND.1 };
    let field = WindField::at(&[source], number, STEP, 0.5);
    let [x, z] = field.velocity(&field.patch_phases([0, 0], 64), [0, 0]);
    [x, 0.0, z]
}

/// Both models of one species against the full chain.
fn measured(blade: &Blade, progress: &mut Progress) -> Result<[Off; 2], ChainError> {
    let co = calibrate(blade)?;
    let mut off = [Off::default(), Off::default()];
    for number in 0..BLADES {
        let chance = |purpose: u32| unit(hash(7, 0, 0, number, purpose));
        let tilt = if number == 0 { 0.0 } else { chance(2) * TILT };
        let base = planted(chance(1) * std::f32::consts::TAU, tilt);
        let mut full = FullChain::new(blade, &base)?;
        let (mut own, mut virtual_blade) = (ChainState::default(), ChainState::default());
        for number in 0..SETTLING + COUNTED {
            let wind = wind(number);
            full.step(wind.map(f64::from), STEP);
            own = step(&co, &base, 0.0, wind, STEP as f32, &own);
            virtual_blade = step(&co, &UPRIGHT, 0.0, wind, STEP as f32, &virtual_blade);
            if number >= SETTLING {
                let exact = full.joints()[blade.segments as usize];
                let held = moments(&co, &UPRIGHT, &virtual_blade.bends()).map(|moment| turned(&base, &UPRIGHT, moment));
                for (off, bends) in off.iter_mut().zip([own.bends(), pose(&co, &base, 0.0, &held)]) {
                    off.0.push(apart(&co, &base, &bends, exact) / blade.length());
                }
            }
        }
        progress.advance();
    }
    Ok(off)
}

/// Distance of a blade's tip from a place, m.
fn apart(co: &ChainCoefficients, base: &Frame, bends: &[[f32; 2]; 8], exact: [f64; 3]) -> f64 {
    let tip = joints(base, 0.0, co, bends)[co.segments as usize];
    (0..3).map(|axis| (f64::from(tip[axis]) - exact[axis]).powi(2)).sum::<f64>().sqrt()
}
