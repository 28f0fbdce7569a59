//! What one step is going to do, decided before any cell moves: the same list for every backend.

mod layered;

use std::ops::Range;

use crate::interaction::distance_map::DistanceMapHead;
use crate::interaction::reaction::Sums;
use crate::interaction::solid::Solids;
use crate::interaction::{Contact, ContactEdge, Footprint, Pose};
use crate::state::{Awake, NONE, PatchKey, StandState, Summary, TILE};
use crate::wind::WindField;
use crate::wind::fluid::FluidPlan;
pub use layered::{Brush, LayeredPlan, TouchPlan};

/// One step, planned.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Steps done before this one.
    pub step: u64,
    /// One entry per stand.
    pub stands: Vec<StandPlan>,
    /// One entry per stand of meshes.
    pub layered: Vec<LayeredPlan>,
    /// Bodies whose maps must be drawn anew before, with the seconds since each appeared.
    pub maps: Vec<(u32, f64)>,
    /// What pushes each plane of air, which flows on when all stands have read it.
    pub fluids: Vec<FluidPlan>,
}

/// What one stand does in a step.
#[derive(Clone, Debug)]
pub struct StandPlan {
    /// The wind of this step on the stand's nodes.
    pub wind: WindField,
    /// The same wind with every gust a whole number of times in a patch, for the patch that is tiled.
    pub tile_wind: WindField,
    /// Awake patches in key order.
    pub patches: Vec<PatchPlan>,
    /// Swept footprints.
    pub contacts: Vec<Contact>,
    /// Edges of all footprints.
    pub edges: Vec<ContactEdge>,
    /// Which footprints reach which patch, patch by patch.
    pub pairs: Vec<ContactPair>,
    /// Bodies as solids, patch by patch; of stands that move blade by blade.
    pub solids: Solids,
    /// Who feels what plants do: one for each of `contacts`, of `solids.heads` or of `sheets.heads`.
    pub touchers: Vec<Toucher>,
    /// Billboards with a sheet of their own.
    pub sheets: SheetPlan,
    /// Plants that swing by themselves did so by other numbers till now (`OscillatorModel::former`): before anything else their motions become those of
    /// the new ones.
    pub rebase: bool,
}

/// A body, and the point of it about which moments are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Toucher {
    /// Index of the body.
    pub body: u32,
    /// From the body's base to that point, m.
    pub arm: [f32; 3],
}

impl Toucher {
    /// A point `at` (x, y, z) \[m\] of a body with such a pose.
    pub fn new(body: u32, pose: Option<&Pose>, at: [f64; 3]) -> Self {
        let base = pose.map_or(at, |pose| [pose.ground[0], pose.height, pose.ground[1]]);
        Self { body, arm: [0, 1, 2].map(|axis| (at[axis] - base[axis]) as f32) }
    }
}

/// What a backend reports of one stand after a step.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// What activation wants to know of each awake patch, in key order.
    pub summaries: Vec<(PatchKey, Summary)>,
    /// What bodies feel of its plants: for each of [`StandPlan::touchers`].
    pub felt: Vec<(Toucher, Sums)>,
}

impl Report {
    /// Of a stand that did what `touchers` felt.
    pub fn new(summaries: Vec<(PatchKey, Summary)>, touchers: &[Toucher], sums: Vec<Sums>) -> Self {
        let felt = touchers.iter().copied().zip(sums).filter(|(_, sums)| *sums != Sums::default());
        Self { summaries, felt: felt.collect() }
    }
}

/// What a step does to deformed billboards.
#[derive(Clone, Debug, Default)]
pub struct SheetPlan {
    /// Those that have a sheet, in order.
    pub active: Vec<ActiveSheet>,
    /// Where the maps of bodies are, patch by patch, moment by moment.
    pub heads: Vec<DistanceMapHead>,
    /// Patches in which billboards have got or given back sheets, or that wake: their places have changed.
    pub changed: Vec<PatchKey>,
    /// Blocks of 8 × 8 cells that bodies may touch, and others in which billboards recover.
    pub nodes: [u32; 2],
}

/// A billboard with a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct ActiveSheet {
    /// Index of its patch in the plan.
    pub patch: u32,
    /// Number of its cell.
    pub cell: u32,
    /// Where its sheet is stored.
    pub place: u32,
    /// It has just got it.
    pub fresh: bool,
    /// Steps by which it recovers faster, since its patch must go.
    pub hurry: u32,
    /// Its bodies in [`SheetPlan::heads`].
    pub heads: Range<u32>,
    /// Where a column falls that stands upright under a body: its way, unit (x, z).
    pub heading: [f32; 2],
}

/// A footprint that reaches a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPair {
    /// Index into the step's contacts.
    pub contact: u32,
    /// Cell of the footprint's corner, counted from the patch's corner.
    pub corner: [i32; 2],
}

/// One awake patch in a step.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchPlan {
    /// Which patch.
    pub patch: PatchKey,
    /// Where its cells are.
    pub slot: u32,
    /// Where its upper segments are, or [`NONE`].
    pub lag: u32,
    /// Slots of the neighbours along −x, +x, −z, +z, or [`NONE`].
    pub neighbours: [u32; 4],
    /// Share of its deviation from rest it keeps.
    pub keep: f32,
    /// It must be set to rest first.
    pub woken: bool,
    /// The tilt of its plants in the wind begins as the wind has it.
    pub aired: bool,
    /// The ground under it has changed and must be sampled again.
    pub edited: bool,
    /// Its upper segments must be set to β first.
    pub lag_woken: bool,
    /// Its footprints in [`StandPlan::pairs`].
    pub pairs: Range<usize>,
    /// Slots of the 3×3 patches around it, or [`NONE`].
    pub around: [u32; 9],
    /// How far its own state rules over the wind's rest at its corners: see [`weights`].
    pub weights: [f32; 4],
    /// Its solids in [`StandPlan::solids`].
    pub solids: Range<usize>,
    /// Pixels of a metre, in a picture of 1080 rows, where the nearest focus is.
    pub pixels: f32,
    /// Its blades are handed back, settled or not.
    pub handing: bool,
}

impl PatchPlan {
    /// Slot of a neighbour, if it is awake.
    pub fn neighbour(&self, side: usize) -> Option<usize> {
        (self.neighbours[side] != NONE).then_some(self.neighbours[side] as usize)
    }
}

/// Slots of the 3×3 patches around one, or [`NONE`]: where a patch sleeps, the tiled one stands in if there is one; its cells wrap around.
pub fn around(state: &StandState, patch: PatchKey, pick: fn(&Awake) -> u32) -> [u32; 9] {
    let mut found = [NONE; 9];
    for (k, slot) in found.iter_mut().enumerate() {
        let key = if patch == TILE { TILE } else { [patch[0].wrapping_add(k as i32 % 3 - 1), patch[1].wrapping_add(k as i32 / 3 - 1)] };
        *slot = state.awake.get(&key).or_else(|| state.awake.get(&TILE)).map_or(NONE, pick);
    }
    found
}

/// Weights at a patch's corners (−−, +−, −+, ++): one that only the wind keeps awake gives way to its rest towards sleeping neighbours.
pub fn weights(state: &StandState, patch: PatchKey) -> [f32; 4] {
    if !state.awake.get(&patch).is_some_and(|awake| awake.wind_only) || patch == TILE {
        return [1.0; 4];
    }
    [[-1, -1], [0, -1], [-1, 0], [0, 0]].map(|[x, z]| {
        let all = [[0, 0], [1, 0], [0, 1], [1, 1]].iter().all(|[dx, dz]| {
            let key = [patch[0].wrapping_add(x + dx), patch[1].wrapping_add(z + dz)];
            state.awake.contains_key(&key)
        });
        if all { 1.0 } else { 0.0 }
    })
}

/// Patches under a footprint grown by `margin` cells.
pub(crate) fn patches_under(footprint: &Footprint, side: i64, margin: i64) -> impl Iterator<Item = PatchKey> {
    let range = |axis: usize| {
        let low = (footprint.corner[axis] - margin).div_euclid(side);
        let high = (footprint.corner[axis] + i64::from(footprint.contact.size[axis]) - 1 + margin).div_euclid(side);
        low as i32..=high as i32
    };
    let (xs, zs) = (range(0), range(1));
    zs.flat_map(move |z| xs.clone().map(move |x| [x, z]))
}
