//! What one step is going to do, decided before any cell moves: the same list for every backend.

use std::ops::Range;

use crate::interaction::{Contact, ContactEdge, Footprint};
use crate::state::{NONE, PatchKey};
use crate::wind::WindField;

/// One step, planned.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Steps done before this one.
    pub step: u64,
    /// One entry per stand.
    pub stands: Vec<StandPlan>,
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
    /// The ground under it has changed and must be sampled again.
    pub edited: bool,
    /// Its upper segments must be set to β first.
    pub lag_woken: bool,
    /// Its footprints in [`StandPlan::pairs`].
    pub pairs: Range<usize>,
}

impl PatchPlan {
    /// Slot of a neighbour, if it is awake.
    pub fn neighbour(&self, side: usize) -> Option<usize> {
        (self.neighbours[side] != NONE).then_some(self.neighbours[side] as usize)
    }
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
