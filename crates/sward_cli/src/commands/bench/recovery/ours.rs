//! How long plants of ours take to stand up after a body is gone, at any rate of frames, and how long their frequency and damping ratio say they take.

use sward::model::NoAssets;
use sward::placement;
use sward::response::oscillator::{Own, Record};
use sward::scene::Scene;
use sward::world::World;

use super::laws::{LEFT, recovered};
use crate::failure::Failure;

/// When the body vanishes, s: just after a step at every rate. A continuum feels bodies at its steps, and lets go at [`LAST_FELT`].
const GONE: f64 = 1.0005;
const LAST_FELT: f64 = 1.0;
/// Longest recovery that is waited for, s.
const WATCHED: f64 = 2.5;
/// What plants are tuned to: Hz, damping ratio.
const FREQUENCY: f64 = 1.7;
const DAMPING: f64 = 0.36;
/// The plant that is looked at stands here, m.
const PLACE: [f64; 2] = [16.5, 15.5];

/// How plants of ours recover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ours {
    /// A continuum behind [`World::advance`]: 60 fixed steps a second, whatever the frames.
    FixedSteps,
    /// A continuum that takes one step a frame.
    StepAFrame,
    /// Plants that swing by themselves: pose as a function of time.
    FunctionOfTime,
}

impl Ours {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::FixedSteps, Self::StepAFrame, Self::FunctionOfTime];

    /// For a reader.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::FixedSteps => "continuum, 60 fixed steps a second",
            Self::StepAFrame => "continuum, a step a frame",
            Self::FunctionOfTime => "oscillator, a function of time",
        }
    }

    /// Seconds it takes at a rate of frames \[1/s\], of what is shown: the moment between two steps that belongs to the frame.
    pub(crate) fn recovery(self, frames_per_second: u32) -> Result<f64, Failure> {
        let mut world = self.world(frames_per_second)?;
        let mut bends = Vec::new();
        for _ in 0..((GONE + WATCHED) * f64::from(frames_per_second)) as u64 {
            world.advance(1.0 / f64::from(frames_per_second));
            let behind = world.behind();
            bends.push((world.time() - behind * world.model.dt, self.bend(&world, behind)?));
        }
        let let_go = if self == Self::FunctionOfTime { GONE } else { LAST_FELT };
        let Some((_, first)) = bends.iter().rev().find(|(time, _)| *time <= LAST_FELT + 1e-9).copied() else { return Ok(f64::INFINITY) };
        let along = |bend: [f64; 2]| (bend[0] * first[0] + bend[1] * first[1]) / (first[0] * first[0] + first[1] * first[1]);
        let curve = bends.iter().filter(|(time, _)| *time >= LAST_FELT - 1e-9).map(|(time, bend)| (time - let_go, along(*bend)));
        Ok(recovered(curve, LEFT))
    }

    /// A wide body stands on grass that is tuned, and vanishes.
    fn world(self, frames_per_second: u32) -> Result<World, Failure> {
        let tuned = format!("frequency: {FREQUENCY}, damping: {DAMPING}");
        // Waves from the rim of the box are not there before the grass has recovered.
        let (response, shape, steps) = match self {
            Self::FixedSteps => (format!("Continuum({tuned})"), "Box(size: (24, 1, 24))", 60),
            Self::StepAFrame => (format!("Continuum({tuned})"), "Box(size: (24, 1, 24))", frames_per_second),
            Self::FunctionOfTime => (format!("Oscillator({tuned}, spread_stiffness: 0, spread_damping: 0)"), "Sphere(radius: 3)", 60),
        };
        let text = format!(
            "(version: 1, steps_per_second: {steps}, stands: [(species: Meadow, cells: 32, height: (0.4, 0.4), clumping: 0, cover: 1, response: {response})],
            interactors: [(shape: {shape}, path: Keyframes(keys: [(time: 0, at: (16, 15)), (time: 0.5, at: (16, 16))]), until: {GONE})])"
        );
        Ok(World::new(Scene::parse(&text, "recovery.ron")?, &NoAssets)?)
    }

    /// How far the plant leans that is looked at, `behind` steps before the state, rad.
    fn bend(self, world: &World, behind: f64) -> Result<[f64; 2], Failure> {
        let lost = || Failure::failed("the plant whose recovery is measured is not there");
        let (stand, state) = world.model.stands.first().zip(world.state.stands.first()).ok_or_else(lost)?;
        let cell = PLACE.map(|metres| (metres / stand.spacing) as u32);
        let at = (cell[1] * stand.cells + cell[0]) as usize;
        // A patch that sleeps is at rest.
        let Some(slot) = state.awake.get(&[0, 0]).map(|awake| awake.slot as usize) else { return Ok([0.0; 2]) };
        let (now, old) = state.cells.now.get(slot).zip(state.cells.old.get(slot)).ok_or_else(lost)?;
        let area = (stand.cells * stand.cells) as usize;
        if let Some(oscillator) = &stand.oscillator {
            let co = &oscillator.coefficients;
            let plant = placement::plant(&stand.placement, [0, 0], cell).ok_or_else(lost)?;
            let own = Own::of(co, placement::variety(&stand.placement, [0, 0], at as u32), plant.height);
            return Ok(Record::load(now, area, at).at(co, &own, world.state.step as u32, behind as f32).map(f64::from));
        }
        let mixed = |axis: usize| {
            let (now, before) = (f64::from(now[axis * area + at]), f64::from(old[axis * area + at]));
            now + behind * (before - now)
        };
        Ok([mixed(0), mixed(1)])
    }
}

/// Seconds that frequency and damping ratio say: of β'' = −ω²β − 2ζωβ', let go at rest.
pub(crate) fn meant() -> f64 {
    let rate = std::f64::consts::TAU * FREQUENCY;
    let (decay, turn) = (DAMPING * rate, rate * (1.0 - DAMPING * DAMPING).sqrt());
    let left = |time: f64| (-decay * time).exp() * ((turn * time).cos() + decay / turn * (turn * time).sin());
    recovered((0..=100_000).map(|k| f64::from(k) * WATCHED / 1e5).map(|time| (time, left(time))), LEFT)
}
