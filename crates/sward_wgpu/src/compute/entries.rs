//! A plan as the compute passes read it.

use bytemuck::{Pod, Zeroable};
use sward::plan::{PatchPlan, StandPlan};
use sward::response::StandModel;
use sward::response::continuum::{Coefficients, LagCoefficients, NODE_CELLS, half, safe_limit};
use sward::state::{NONE, TILE};
use sward::wind::equilibrium;
use sward::world::World;

use super::traffic::Patches;

/// `Stand` of `step.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct StandUniform {
    /// Kernel numbers.
    pub coefficients: Coefficients,
    /// Kernel numbers of upper segments.
    pub lag: LagCoefficients,
    /// Cells per patch side.
    pub cells: u32,
    /// Wind nodes a row.
    pub nodes: u32,
    /// 1: β_eq comes from nodes.
    pub gusty: u32,
    /// 1: all ground is level.
    pub level: u32,
    /// β_eq where it is the same everywhere, rad.
    pub rest: [f32; 2],
    /// k_w.
    pub wind_response: f32,
    /// Height of level ground, m.
    pub height: f32,
    /// Place of this step in the ring of `history`.
    pub frame: u32,
    /// Cell side, m.
    pub spacing: f32,
    /// Moment of inertia of what stands in a cell, kg·m².
    pub inertia: f32,
    /// κ, 1/s².
    pub kappa: f32,
    /// First word of what contacts feel behind the summaries.
    pub reactions: u32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: [u32; 3],
}

impl StandUniform {
    /// Numbers of one stand in one step.
    pub fn new(world: &World, stand: &StandModel, plan: &StandPlan, step: u64) -> Self {
        let k_w = stand.species.continuum.wind;
        let gusty = plan.wind.varies() && k_w != 0.0;
        Self {
            coefficients: stand.coefficients,
            lag: stand.lag,
            cells: stand.cells,
            nodes: stand.cells / NODE_CELLS + 3,
            gusty: u32::from(gusty),
            level: u32::from(stand.is_level(&world.model.terrain)),
            rest: equilibrium(plan.wind.mean, k_w),
            wind_response: k_w,
            height: world.model.terrain.height_at(0.0, 0.0) as f32,
            frame: (step % u64::from(stand.lag.ring)) as u32,
            spacing: stand.spacing as f32,
            inertia: stand.cell_inertia(),
            kappa: stand.species.continuum.kappa,
            reactions: super::SUMMARY_WORDS * plan.patches.len() as u32,
            unused: [0; 3],
        }
    }
}

/// `AwakePatch` of `step.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct AwakePatch {
    /// Where its cells are.
    pub slot: u32,
    /// Where its upper segments are, or none.
    pub lag: u32,
    /// Index of its held mask, or none.
    pub held: u32,
    /// 1: its upper segments are new; 2: it is the tiled wind patch.
    pub flags: u32,
    /// Slots of the neighbours along −x, +x, −z, +z, or none.
    pub neighbours: [u32; 4],
    /// Which patch.
    pub patch: [i32; 2],
    /// First word of its pairs.
    pub pair_first: u32,
    /// Number of its pairs.
    pub pair_count: u32,
    /// Share of its deviation it keeps.
    pub keep: f32,
    /// Number of the patch and the step from which cells at half precision are dithered.
    pub dither: u32,
    /// |β| below which the ground limits nothing, rad.
    pub safe: f32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: u32,
}

/// The patches of each pass.
pub struct Entries {
    /// All awake patches.
    pub awake: Vec<AwakePatch>,
    /// Those that wake in this step.
    pub woken: Vec<AwakePatch>,
    /// Those under footprints.
    pub touched: Vec<AwakePatch>,
    /// Those that keep upper segments.
    pub lagged: Vec<AwakePatch>,
}

impl Entries {
    /// The lists of a plan of step number `step`; `steepest` is the steepest slope under a slot's cells.
    pub fn of(plan: &StandPlan, step: u64, steepest: impl Fn(u32) -> f32) -> Self {
        let pairs = 2 * plan.edges.len();
        let mut held = 0;
        let entry = |patch: &PatchPlan| {
            let touched = !patch.pairs.is_empty();
            held += u32::from(touched);
            AwakePatch {
                slot: patch.slot,
                lag: patch.lag,
                held: if touched { held - 1 } else { NONE },
                flags: u32::from(patch.lag_woken) | if patch.patch == TILE { 2 } else { 0 },
                neighbours: patch.neighbours,
                patch: patch.patch,
                pair_first: (pairs + patch.pairs.start) as u32,
                pair_count: patch.pairs.len() as u32,
                keep: patch.keep,
                dither: half::patch_dither(patch.patch, step),
                safe: safe_limit(steepest(patch.slot)),
                unused: 0,
            }
        };
        let awake: Vec<AwakePatch> = plan.patches.iter().map(entry).collect();
        let pick = |keep: &dyn Fn(&PatchPlan) -> bool| {
            plan.patches.iter().zip(&awake).filter(|(patch, _)| keep(patch)).map(|(_, entry)| *entry).collect()
        };
        Self {
            woken: pick(&|patch| patch.woken),
            touched: pick(&|patch| !patch.pairs.is_empty()),
            lagged: pick(&|patch| patch.lag != NONE),
            awake,
        }
    }

    /// How many they are.
    pub fn patches(&self) -> Patches {
        let [awake, woken, touched, lagged] = [&self.awake, &self.woken, &self.touched, &self.lagged].map(|list| list.len() as u64);
        Patches { awake, woken, touched, lagged }
    }
}
