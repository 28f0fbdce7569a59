//! The growth map: where nothing grows, or less and lower, and how it leans. Exclusions, masks and the steepness of the ground make it.
//!
//! Nothing is baked ahead: a patch that something limits gets its map (four bytes a cell) when it is first seen or wakes, others cost
//! nothing. Limits are kept in f64; whoever asks gets them as `f32` near a place of its own ([`Near`]). The shape functions have a
//! twin for the colour of bare ground: `growth.wgsl`.

mod area;
mod comb;
mod image;
mod near;
mod tended;

use std::sync::Arc;

pub use area::Outline;
pub use comb::{Comb, DirectionImage};
pub use image::MaskImage;
pub use near::{GrowthBlock, GrowthRecord, MOST_RECORDS, Near, cover_at};
pub use tended::{Tended, WHOLE};

use crate::placement::{self, Growing, PlacementParameters};
use crate::terrain::Terrain;

/// Shapes in WGSL. The host declares `growth_edge(index: u32) -> vec4<f32>` and `growth_texel(index: u32) -> f32`.
pub const WGSL: &str = include_str!("../growth.wgsl");

/// An exclusion or a mask, compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Where.
    pub outline: Outline,
    /// Width of the margin, m.
    pub soft: f32,
    /// Plants lower than this grow all the same, m.
    pub above: f32,
    /// How far height follows cover, 0 to 1.
    pub height: f32,
    /// Cover outside the outline: 1 but for masks.
    pub outside: f32,
    /// Linear RGB of bare ground.
    pub colour: [f32; 3],
    /// Share of all plants that it keeps away, 0 to 1: how bare its ground looks.
    pub share: f32,
}

/// How steep the ground may be where a stand grows, rise over run.
pub type Slopes = [f32; 2];

/// What limits the growth of one stand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Growth {
    /// Exclusions, then masks, in the scene's order.
    pub limits: Vec<Arc<Limit>>,
    /// Least and greatest steepness.
    pub slopes: Option<Slopes>,
    /// How it lies; of two that say something of a place the latter holds.
    pub combs: Vec<Arc<Comb>>,
    /// What was cut, burnt or has grown again.
    pub tended: Tended,
}

/// Height in [`crate::state::Ground`] of a cell where nothing grows, m: far below every body, so none finds plants to push.
pub const BARE: f32 = -1e9;

impl Growth {
    /// It grows everywhere.
    pub fn is_free(&self) -> bool {
        self.limits.is_empty() && self.slopes.is_none() && self.combs.is_empty() && self.tended.changes() == 0
    }

    /// What of it concerns a square of `side` \[m\] whose corner is at `corner` \[m\]; `None` where it grows freely.
    fn near(&self, corner: [f64; 2], side: f64) -> Option<Near> {
        let near = Near::of(self.limits.iter().map(|limit| &**limit), corner, [[0.0; 2], [side; 2]]);
        (!near.is_empty() || self.slopes.is_some()).then_some(near)
    }

    fn too_steep(&self, terrain: &Terrain, ground: [f64; 2]) -> bool {
        self.slopes.is_some_and(|[low, high]| {
            let [x, z] = terrain.gradient(terrain.anchor(ground), [0.0; 2]);
            let steep = (x * x + z * z).sqrt();
            steep < low || steep > high
        })
    }

    /// How plants at a place \[m\] lean, and how messy they are, where pictures say so of either.
    fn combed(&self, combs: &[&Comb], placement: &PlacementParameters, ground: [f64; 2]) -> Option<([f32; 2], f32)> {
        let said: Vec<_> = combs.iter().filter_map(|comb| comb.at(ground)).collect();
        let lean = said.iter().rev().find_map(|(lean, _)| *lean);
        let messiness = said.iter().rev().find_map(|(_, messiness)| *messiness);
        (lean.is_some() || messiness.is_some()).then(|| (lean.unwrap_or(placement.lean), messiness.unwrap_or(placement.messiness)))
    }

    /// What of it concerns a patch; `None` where all plants do as they would by themselves.
    pub fn in_patch(&self, patch: [i32; 2], patch_side: f64) -> Option<PatchGrowth<'_>> {
        let corner = patch.map(|along| f64::from(along) * patch_side);
        let near = self.near(corner, patch_side);
        let combs: Vec<&Comb> = self.combs.iter().map(|comb| &**comb).filter(|comb| comb.touches(corner, patch_side)).collect();
        let tended = self.tended.map(patch);
        let by_itself = near.is_none() && combs.is_empty();
        (!by_itself || tended.is_some()).then(|| PatchGrowth {
            growth: self,
            patch,
            corner,
            near: near.unwrap_or_default(),
            combs,
            by_itself,
            tended,
        })
    }

    /// How each cell's own plant grows, row by row. `None` where all do as they would by themselves.
    pub fn map(&self, placement: &PlacementParameters, terrain: &Terrain, patch: [i32; 2], patch_side: f64) -> Option<Box<[Growing]>> {
        let own = self.in_patch(patch, patch_side)?;
        Some((0..placement.cells * placement.cells).map(|index| own.cell(placement, terrain, index)).collect())
    }

    /// Whether nothing at all grows at the middle of each cell, row by row; `None` where there is no such cell.
    pub fn bare(&self, cells: u32, terrain: &Terrain, patch: [i32; 2], patch_side: f64) -> Option<Box<[bool]>> {
        let corner = patch.map(|along| f64::from(along) * patch_side);
        let (near, tended) = (self.near(corner, patch_side), self.tended.map(patch));
        if near.is_none() && tended.is_none() {
            return None;
        }
        let near = near.unwrap_or_default();
        let spacing = patch_side / f64::from(cells);
        let bare = |index: u32| {
            if tended.is_some_and(|shares| shares[index as usize] == 0) {
                return true;
            }
            let local = [index % cells, index / cells].map(|at| (f64::from(at) + 0.5) * spacing);
            // A plant of no height passes below everything that has an underside.
            near.growth_at(local.map(|metres| metres as f32), 0.0)[0] <= 0.0
                || self.too_steep(terrain, [corner[0] + local[0], corner[1] + local[1]])
        };
        let bare: Box<[bool]> = (0..cells * cells).map(bare).collect();
        bare.contains(&true).then_some(bare)
    }
}

/// What limits the growth of one stand in one patch.
pub struct PatchGrowth<'a> {
    growth: &'a Growth,
    patch: [i32; 2],
    corner: [f64; 2],
    near: Near,
    combs: Vec<&'a Comb>,
    /// But for what was tended, plants do as they would by themselves.
    by_itself: bool,
    tended: Option<&'a [u8]>,
}

impl PatchGrowth<'_> {
    /// How the plant of cell number `index` grows.
    pub fn cell(&self, placement: &PlacementParameters, terrain: &Terrain, index: u32) -> Growing {
        let share = self.tended.map_or(WHOLE, |shares| shares[index as usize]);
        // What says nothing more of a plant than its share.
        if self.by_itself {
            return Growing::of_share(share);
        }
        let growing = self.untended(placement, terrain, index);
        if share == WHOLE { growing } else { tended::left(growing, share) }
    }

    fn untended(&self, placement: &PlacementParameters, terrain: &Terrain, index: u32) -> Growing {
        let cell = [index % placement.cells, index / placement.cells];
        let Some(plant) = placement::plant(placement, self.patch, cell) else { return Growing::default() };
        let [cover, height] = self.near.growth_at(plant.root, plant.height);
        let gone = cover <= 0.0 || (cover < 1.0 && !placement::stays(placement, self.patch, cell, cover));
        let ground = [0, 1].map(|axis| self.corner[axis] + f64::from(plant.root[axis]));
        if gone || self.growth.too_steep(terrain, ground) {
            return Growing::default();
        }
        // At least 1: what grows is not nothing.
        let share = (height * 254.0) as u8 + 1;
        match self.growth.combed(&self.combs, placement, ground) {
            None => Growing { share, ..Growing::default() },
            Some((lean, messiness)) => {
                let lean = placement::scattered(placement, self.patch, index, lean, messiness);
                Growing { share, lean: comb::hundredths(lean), combed: 1 }
            }
        }
    }
}
