//! All that a step changes. Types only; every stage may read what the previous step left.

mod layers;
mod reactions;
mod sheets;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

use serde::{Deserialize, Serialize};

use crate::placement::Growing;
use crate::scene::Response;
use crate::wind::fluid::FluidState;

pub use layers::{Cut, Cuts, LayeredPlant, LayeredState, PlantKey, Waves};
pub use reactions::{Among, Event, Happening, Reaction};
pub use sheets::{Billboard, SheetPool, Sheets};

/// No slot.
pub const NONE: u32 = u32::MAX;

/// Key of the one patch whose wind is tiled over sleeping patches (`budget.beyond: Tiled`); no place on the ground.
pub const TILE: PatchKey = [i32::MIN, i32::MIN];

/// Patch coordinates, counted from the scene's origin patch (x, z).
pub type PatchKey = [i32; 2];

/// Whether a patch belongs to a field from its first patch to one past its last; an endless one has all.
pub(crate) fn in_field(field: Option<[[i32; 2]; 2]>, patch: PatchKey) -> bool {
    field.is_none_or(|[low, high]| (0..2).all(|axis| patch[axis] >= low[axis] && patch[axis] < high[axis]))
}

/// What a whole simulation holds.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// Steps done.
    pub step: u64,
    /// One entry per interactor of the scene, in its order.
    pub bodies: Vec<BodyState>,
    /// What plants did to each body in the step that was last heard of.
    pub reactions: Vec<Reaction>,
    /// Bodies that are among plants, with the number of the stand in the scene.
    pub among: BTreeMap<(u32, u32), Among>,
    /// One entry per stand, in the scene's order.
    pub stands: Vec<StandState>,
    /// One entry per stand of meshes, in the scene's order.
    pub layered: Vec<LayeredState>,
    /// One entry per source of wind of the scene, in its order.
    pub winds: Vec<WindState>,
    /// Places of bodies that were removed, which the next ones take.
    pub vacant: BTreeSet<u32>,
    /// The flow of each plane of air, in the scene's order; where a GPU steps, as of the last download.
    pub fluids: Vec<FluidState>,
    /// Points the last step cared about, m (x, z): the camera's, unless some are pinned.
    pub focuses: Vec<[f64; 2]>,
    /// Points set from code to be cared about instead of the camera's, m (x, z): for servers, replays and several players.
    pub pinned: Vec<[f64; 2]>,
    /// Responses that glide to other numbers, in the order in which they were asked to.
    pub tunings: Vec<Tuning>,
    /// What grows again.
    pub regrowing: Vec<Regrowth>,
    /// Steps whose edits by the scene are in the ground: `step`, and one more between planning a step and its end. A step that is
    /// planned again, because a backend could not take it, edits nothing twice.
    pub edited_steps: u64,
    /// Patches whose ground has changed since a step was last planned.
    pub edited: BTreeSet<PatchKey>,
    /// Patches whose ground the step being taken samples again; empty between steps.
    pub resampled: BTreeSet<PatchKey>,
    /// Wall-clock seconds handed in and not yet stepped.
    pub pending_seconds: f64,
    /// Steps that `advance` dropped because the caller came too late.
    pub dropped_steps: u64,
}

impl State {
    /// A fingerprint (FNV-1a) of the step, of the bits of both time levels of every awake patch on the CPU, stand by stand in key
    /// order, of the air that flows, and of how plants are cut. Where a patch is stored does not matter. Equal states have equal fingerprints on every machine.
    pub fn hash(&self) -> u64 {
        let mut hash = Fingerprint(0xcbf2_9ce4_8422_2325);
        hash.add(self.step as u32);
        hash.add((self.step >> 32) as u32);
        for stand in &self.stands {
            hash.add(stand.awake.len() as u32);
            stand.cells.sheets.iter().for_each(|word| hash.add(*word));
            for (patch, awake) in &stand.awake {
                patch.iter().for_each(|along| hash.add(*along as u32));
                let slot = awake.slot as usize;
                let levels = stand.cells.now.get(slot).into_iter().chain(stand.cells.old.get(slot));
                levels.flat_map(|level| level.iter()).for_each(|value| hash.add(value.to_bits()));
                if let Some(blades) = stand.cells.blades(awake.lag) {
                    blades.iter().for_each(|value| hash.add(value.to_bits()));
                }
            }
        }
        for stand in &self.layered {
            let planes = [&stand.waves].into_iter().chain(stand.pool.taken().filter_map(|(_, place)| stand.touches.get(place as usize)));
            let cells = planes.flat_map(|waves| waves.now.iter().chain(&waves.old));
            cells.flatten().chain(&stand.drift).for_each(|value| hash.add(value.to_bits()));
            for (plant, cuts) in &stand.cuts {
                let (patch, number) = plant;
                [patch[0] as u32, patch[1] as u32, *number, cuts.now.step as u32].into_iter().for_each(|word| hash.add(word));
                cuts.now.forward.iter().chain(&cuts.now.window).for_each(|value| hash.add(value.to_bits()));
            }
        }
        for flow in self.fluids.iter().flat_map(|fluid| [&fluid.now, &fluid.before]) {
            flow.iter().flatten().for_each(|value| hash.add(value.to_bits()));
        }
        hash.0
    }
}

/// FNV-1a over words of 32 bits.
struct Fingerprint(u64);

impl Fingerprint {
    fn add(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x0100_0000_01b3);
    }
}

/// A body now and one step ago.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyState {
    /// Pose after the last step; `None` while the body is away.
    pub pose: Option<crate::interaction::Pose>,
    /// Pose before it; equal to `pose` where the body appeared or jumped.
    pub before: Option<crate::interaction::Pose>,
    /// Seconds since it appeared, at `before` and at `pose`: where the clip of a mesh is. Equal where the body appeared or jumped.
    pub clock: [f64; 2],
    /// Set from code: (ground m, yaw rad, clearance m), used at the next step by bodies on a driven path.
    pub driven: Option<([f64; 2], f64, f64)>,
    /// It has been put somewhere else: the next step sweeps nothing of it.
    pub jumps: bool,
}

impl BodyState {
    /// Where it has gone in the last step, m (x, z).
    pub fn way(&self) -> [f64; 2] {
        match (&self.before, &self.pose) {
            (Some(before), Some(pose)) => [0, 1].map(|axis: usize| pose.ground[axis] - before.ground[axis]),
            _ => [0.0; 2],
        }
    }
}

/// A stand whose response glides from some numbers to those of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuning {
    /// Its number in the scene.
    pub stand: usize,
    /// What it was, all said.
    pub from: Response,
    /// Steps done when it begins.
    pub begin: u64,
    /// Steps it takes.
    pub steps: u64,
}

/// Ground on which something grows again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Regrowth {
    /// Middle, m (x, z).
    pub at: [f64; 2],
    /// Radius, m.
    pub radius: f32,
    /// Names of the stands; none named: all but shrubs and trees.
    pub stands: Vec<String>,
    /// Times that it still grows.
    pub ticks: u64,
}

/// A source of wind: how strong it is when.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WindState {
    /// Another number for every source that ever blew: its gusts are those of this number.
    pub number: u32,
    /// Its strength, 0 to 1, when it begins to change, and when that is over.
    pub levels: [f32; 2],
    /// Steps done when it begins to change.
    pub begin: u64,
    /// Steps that takes.
    pub steps: u64,
    /// It is gone, and the next one may have its place.
    pub vacant: bool,
}

impl WindState {
    /// Its strength after so many steps, 0 to 1.
    pub fn level(&self, step: f64) -> f32 {
        let [from, to] = self.levels;
        if self.vacant {
            return 0.0;
        }
        let share = (step - self.begin as f64) / (self.steps.max(1) as f64);
        if self.steps == 0 || share >= 1.0 {
            return to;
        }
        let share = if share > 0.0 { share as f32 } else { 0.0 };
        from + (to - from) * share * share * (3.0 - 2.0 * share)
    }
}

/// Patches of one stand.
#[derive(Clone, Debug, Default)]
pub struct StandState {
    /// Awake patches, in key order: the order of every list and hash.
    pub awake: BTreeMap<PatchKey, Awake>,
    /// Slots that no patch uses, lowest first.
    pub free: BTreeSet<u32>,
    /// Lag slots that no patch uses, lowest first.
    pub lag_free: BTreeSet<u32>,
    /// Summaries of past steps, with the step's number, that activation has not read yet; oldest first.
    pub summaries: VecDeque<(u64, Vec<(PatchKey, Summary)>)>,
    /// Cells of each slot; empty where a GPU holds them.
    pub cells: Cells,
    /// Who has a sheet, where bodies deform billboards.
    pub sheets: Sheets,
    /// Counters since the start.
    pub counters: Counters,
}

/// One awake patch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Awake {
    /// Where its cells are stored.
    pub slot: u32,
    /// Where its upper segments are stored, or [`NONE`].
    pub lag: u32,
    /// Steps in a row at rest.
    pub rest: u32,
    /// Steps left until it sleeps; 0 = it does not fade.
    pub fading: u32,
    /// It woke in the step being taken and must be set to rest first.
    pub woken: bool,
    /// Its lag slot is new and must be set from β.
    pub lag_woken: bool,
    /// Only the focus keeps it awake: no body or neighbour has pushed it.
    pub wind_only: bool,
    /// Blades with a state of their own, as last heard; more than any number until then.
    pub held: u32,
    /// Steps for which what is heard of them may be older than the last touch; of plants that swing by themselves, until all have come to rest.
    pub touched: u32,
    /// Its blades are handed back, settled or not: their place is needed, or is farther off than others.
    pub handing: bool,
}

impl Default for Awake {
    fn default() -> Self {
        let (woken, lag_woken, wind_only, handing) = (false, false, false, false);
        Self { slot: 0, lag: NONE, rest: 0, fading: 0, woken, lag_woken, wind_only, held: 0, touched: 0, handing }
    }
}

/// Cells on the CPU. Planar per patch: βx, βz, ωx, ωz, each cells², row-major. Of a stand that moves blade by blade: its virtual blades, and blades
/// with a state.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// Time level n, per slot; 4·cells² values or empty. Of plants that swing by themselves:
    /// [`crate::response::oscillator::Record`]s. Of deformed billboards: cells² places of sheets, as bits, or [`NONE`]. Blade by blade: the moments of virtual blades \[N·m\], x and y of each segment.
    pub now: Vec<Box<[f32]>>,
    /// Time level n−1 (before the step) or n+1 (after it), likewise. Of plants that swing by themselves: their tilt in the wind
    /// ([`crate::response::oscillator::AirStep`]).
    pub old: Vec<Box<[f32]>>,
    /// Upper segments per lag slot: β_1x, β_1z, β_2x, … each cells². Blade by blade, per lag slot: of each segment ψx, ψy, ωx, ωy; of each ψx, ψy a step
    /// before; hold and the hold before ([`crate::response::chain::HeldBlade`]); a value for every blade of the patch.
    pub lag: Vec<Box<[f32]>>,
    /// Past β for the `history` lag, per lag slot: ring of [βx, βz] pairs of planes.
    pub history: Vec<Box<[f32]>>,
    /// States of virtual blades per slot, where a stand moves blade by blade: of each segment ψx, ψy, ωx, ωy.
    pub virtual_states: Vec<Box<[f32]>>,
    /// Where the blades of each lag slot stand; derived, kept while they have one.
    pub roots: Vec<Box<[Root]>>,
    /// Sheets of deformed billboards, place by place: see [`crate::response::springs::pool::store`].
    pub sheets: Vec<u32>,
    /// Growth maps of patches in which bodies deform billboards; derived.
    pub grown: BTreeMap<PatchKey, Box<[Growing]>>,
    /// Ground under each slot's cells; derived, kept while the patch is awake.
    pub ground: Vec<Ground>,
}

impl Cells {
    /// The blades of a lag slot, where they have states of their own.
    pub fn blades(&self, lag: u32) -> Option<&[f32]> {
        self.roots.get(lag as usize).filter(|roots| !roots.is_empty())?;
        self.lag.get(lag as usize).map(|blades| &blades[..])
    }
}

/// The ground under the cells of a patch, sampled once when it wakes: ∂height/∂x, ∂height/∂z and height \[m\], planes of cells²
/// values; none where all ground is level. Where nothing grows the height is [`crate::growth::BARE`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    /// 3·cells² values or none.
    pub values: Box<[f32]>,
    /// Steepest slope of them.
    pub steepest: f32,
    /// Height where `values` is empty, m.
    pub level: f32,
    /// How far the plant of each cell has grown, 255 of it at most: see [`crate::growth::Growth::map`]. Empty where all have, and of stands that
    /// move as a whole.
    pub grown: Box<[u8]>,
}

impl Ground {
    /// All 3·`area` values, also of level ground.
    pub fn planes(&self, area: usize) -> Cow<'_, [f32]> {
        match self.values.is_empty() {
            true => [vec![0.0; 2 * area], vec![self.level; area]].concat().into(),
            false => Cow::Borrowed(&self.values),
        }
    }

    /// Slope at a cell.
    pub fn slope(&self, cells: usize, cell: usize) -> [f32; 2] {
        if self.values.is_empty() { [0.0, 0.0] } else { [self.values[cell], self.values[cells * cells + cell]] }
    }

    /// Height at a cell, m.
    pub fn height(&self, cells: usize, cell: usize) -> f32 {
        if self.values.is_empty() { self.level } else { self.values[2 * cells * cells + cell] }
    }

    /// Slopes of a row, or empty on level ground.
    pub fn slope_row(&self, cells: usize, j: usize) -> [&[f32]; 2] {
        if self.values.is_empty() {
            return [&[], &[]];
        }
        let area = cells * cells;
        [&self.values[j * cells..][..cells], &self.values[area + j * cells..][..cells]]
    }
}

/// Where a blade with a state stands, and how it does by itself. The same bytes as in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Root {
    /// m from the patch's corner; y is absolute.
    pub at: [f32; 3],
    /// Length, m; 0 where none grows.
    pub length: f32,
    /// Where it leans, rad from +x towards +z.
    pub yaw: f32,
    /// Lean at the root, rad.
    pub lean: f32,
    /// How much farther the tip leans, rad.
    pub curl: f32,
    /// 0.
    pub unused: f32,
    /// Gradient of the ground, along x and z.
    pub slope: [f32; 2],
    /// 0.
    pub more_unused: [f32; 2],
}

/// What activation needs to know of a patch after a step: squared deviations max(|β − β_eq|², |ω|²).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Largest in the patch.
    pub largest: f32,
    /// Largest in the bands along −x, +x, −z, +z.
    pub borders: [f32; 4],
    /// Cells scaled back by the limits.
    pub clamped: u32,
    /// Blades with a state of their own.
    pub held: u32,
}

/// What happened so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Patches woken.
    pub woken: u64,
    /// Patches put to sleep at rest.
    pub slept: u64,
    /// Patches released because the budget was full.
    pub released: u64,
    /// Requests refused because the budget was full of nearer patches.
    pub denied: u64,
    /// Cell updates scaled back by the limits.
    pub clamped: u64,
    /// Patch updates.
    pub patch_steps: u64,
    /// Awake patches whose ground was sampled again after an edit.
    pub resampled: u64,
}
