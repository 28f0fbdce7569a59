//! What several test programs need: worlds from scene text, and a patch that is its own neighbour.
#![allow(dead_code)] // Each program uses its own part.

use sward::interaction::solid::Solids;
use sward::lanes::Lanes;
use sward::model::{Model, NoAssets, StandModel};
use sward::plan::{PatchPlan, Plan, StandPlan};
use sward::response::continuum::{self, half};
use sward::scene::Scene;
use sward::state::{Cells, Ground, NONE, Summary};
use sward::world::World;

/// A world on flat ground from the text of a scene without its first line.
pub(crate) fn world(text: &str) -> World {
    let text = format!("(version: 1, {text})");
    let scene = Scene::parse(&text, "test.ron").unwrap_or_else(|error| panic!("{error}\n{text}"));
    World::new(scene, &NoAssets).unwrap_or_else(|error| panic!("{error}"))
}

/// Rounds the cells that a step of the CPU left as a GPU at half precision stores them.
pub(crate) fn halve(world: &mut World, plan: &Plan) {
    round(world, plan, |cells, patch| half::unpack_patch(&half::pack_patch(cells, patch)));
}

/// Rounds the cells of a step in some way; it is given the planes of a patch and the number its dither comes from.
pub(crate) fn round(world: &mut World, plan: &Plan, rounding: fn(&[f32], u32) -> Vec<f32>) {
    for (plan_of, state) in plan.stands.iter().zip(&mut world.state.stands) {
        for patch in &plan_of.patches {
            let number = half::patch_dither(patch.patch, plan.step);
            for level in [&mut state.cells.now, &mut state.cells.old] {
                let cells = &mut level[patch.slot as usize];
                *cells = rounding(cells, number).into();
            }
        }
    }
}

/// A small, fast, repeatable source of numbers in 0..1.
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    /// The next number.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }

    /// The next number between two others.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// One patch without an end: it is its own neighbour on all sides, so plane waves fit it exactly.
pub(crate) struct Torus {
    pub(crate) model: Model,
    pub(crate) stand: StandModel,
    pub(crate) cells: Cells,
    pub(crate) plan: StandPlan,
    pub(crate) side: usize,
}

impl Torus {
    /// The first stand of a scene, at zero.
    pub(crate) fn new(text: &str) -> Self {
        let world = world(text);
        let stand = world.model.stands[0].clone();
        let side = stand.cells as usize;
        let patch = PatchPlan {
            patch: [0, 0],
            slot: 0,
            lag: NONE,
            neighbours: [0; 4],
            keep: 1.0,
            aired: false,
            woken: false,
            edited: false,
            lag_woken: false,
            pairs: 0..0,
            around: [0; 9],
            weights: [1.0; 4],
            solids: 0..0,
            pixels: 0.0,
            handing: false,
        };
        let wind = world.wind(&stand);
        let plan = StandPlan {
            tile_wind: wind.clone(),
            wind,
            patches: vec![patch],
            contacts: Vec::new(),
            edges: Vec::new(),
            pairs: Vec::new(),
            solids: Solids::default(),
            touchers: Vec::new(),
            sheets: Default::default(),
            rebase: false,
        };
        let level = || vec![vec![0.0_f32; 4 * side * side].into_boxed_slice()];
        let cells = Cells { now: level(), old: level(), ground: vec![Ground::default()], ..Cells::default() };
        Self { model: world.model, stand, cells, plan, side }
    }

    /// Sets all planes of both time levels: `value(level, plane, i, j)`, level 0 is now and 1 one step before.
    pub(crate) fn fill(&mut self, value: impl Fn(usize, usize, usize, usize) -> f32) {
        let side = self.side;
        for (level, planes) in [&mut self.cells.now[0], &mut self.cells.old[0]].into_iter().enumerate() {
            for (at, cell) in planes.iter_mut().enumerate() {
                let (plane, within) = (at / (side * side), at % (side * side));
                *cell = value(level, plane, within % side, within / side);
            }
        }
    }

    /// One step.
    pub(crate) fn step(&mut self) -> Summary {
        continuum::step(&self.model.terrain, &self.stand, &self.plan, &mut self.cells, Lanes::default(), &mut |_| ()).0[0].1
    }

    /// One plane of the present.
    pub(crate) fn plane(&self, plane: usize) -> &[f32] {
        let area = self.side * self.side;
        &self.cells.now[0][plane * area..][..area]
    }

    /// The largest number of the present, or infinity if one is not a number.
    pub(crate) fn largest(&self) -> f32 {
        self.cells.now[0].iter().fold(0.0, |most, value| if value.is_nan() { f32::INFINITY } else { most.max(value.abs()) })
    }
}
