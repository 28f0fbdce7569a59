//! Which plants stand where: a pure function of (seed, patch, cell), so a field of 10¹² plants costs no memory.
//!
//! Chen & Johan 2010, §3: one cluster of grass at a random place in each cell, with a random height. Twin: `placement.wgsl`.

use bytemuck::{Pod, Zeroable};

use crate::math;

/// Placement in WGSL; needs `math` before it.
pub const WGSL: &str = include_str!("placement.wgsl");

/// What each hash is for; a plant asks the same question everywhere.
mod purpose {
    pub(super) const PRESENT: u32 = 1;
    pub(super) const PLACE_X: u32 = 2;
    pub(super) const PLACE_Z: u32 = 3;
    pub(super) const HEIGHT: u32 = 4;
    pub(super) const YAW: u32 = 5;
    pub(super) const TINT: u32 = 6;
    pub(super) const CLUMP: u32 = 7;
    pub(super) const VARIETY: u32 = 8;
    /// The first of those about blades.
    pub(super) const BLADE: u32 = 16;
}

/// How one stand is placed. The same bytes are a uniform of the WGSL twin.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PlacementParameters {
    /// Seed of the stand.
    pub seed: u32,
    /// Cells per patch side.
    pub cells: u32,
    /// Cell side, m.
    pub spacing: f32,
    /// Share of cells that carry a plant, 0 to 1.
    pub cover: f32,
    /// Shortest and tallest plant, m.
    pub height: [f32; 2],
    /// How much cover and height vary from clump to clump, 0 to 1.
    pub clumping: f32,
    /// Clump lattices per patch side: the whole number nearest to patch side / clump size, at least 1.
    pub clumps: u32,
}

/// One plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plant {
    /// Root, m from the corner of its patch (x, z); inside its own cell.
    pub root: [f32; 2],
    /// Height, m.
    pub height: f32,
    /// Turn about +Y, rad, 0 to 2π.
    pub yaw: f32,
    /// Colour variation, 0 to 1.
    pub tint: f32,
}

/// Smooth value noise over the clump lattice, 0 to 1, continuous across patches.
fn clump(p: &PlacementParameters, patch: [i32; 2], cell: [u32; 2]) -> f32 {
    let scale = p.clumps as f32 / p.cells as f32;
    let (x, z) = ((cell[0] as f32 + 0.5) * scale, (cell[1] as f32 + 0.5) * scale);
    let (i, j) = (x as u32, z as u32);
    let (fx, fz) = (x - i as f32, z - j as f32);
    let corner = |di: u32, dj: u32| {
        // A corner on the far border is the first corner of the next patch.
        let (ci, cj) = (i + di, j + dj);
        let (over_x, over_z) = (ci / p.clumps, cj / p.clumps);
        let at = (cj - over_z * p.clumps) * p.clumps + (ci - over_x * p.clumps);
        let (x, z) = (patch[0].wrapping_add(over_x as i32), patch[1].wrapping_add(over_z as i32));
        math::unit(math::hash(p.seed, x, z, at, purpose::CLUMP))
    };
    let (sx, sz) = (fx * fx * (3.0 - 2.0 * fx), fz * fz * (3.0 - 2.0 * fz));
    let low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * sx;
    let high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * sx;
    low + (high - low) * sz
}

/// Share of cells that carry a plant where the clump noise is `clump`.
fn cover(p: &PlacementParameters, clump: f32) -> f32 {
    p.cover * (1.0 - p.clumping * (1.0 - clump))
}

/// The plant of a cell, if there is one. `patch` is counted from the scene's origin patch, `cell` = (i, j) below `cells`.
pub fn plant(p: &PlacementParameters, patch: [i32; 2], cell: [u32; 2]) -> Option<Plant> {
    let index = cell[1] * p.cells + cell[0];
    let random = |purpose: u32| math::unit(math::hash(p.seed, patch[0], patch[1], index, purpose));
    let clump = clump(p, patch, cell);
    if random(purpose::PRESENT) >= cover(p, clump) {
        return None;
    }
    let share = random(purpose::HEIGHT) * (1.0 - p.clumping) + clump * p.clumping;
    Some(Plant {
        root: [(cell[0] as f32 + random(purpose::PLACE_X)) * p.spacing, (cell[1] as f32 + random(purpose::PLACE_Z)) * p.spacing],
        height: p.height[0] + (p.height[1] - p.height[0]) * share,
        yaw: random(purpose::YAW) * std::f32::consts::TAU,
        tint: random(purpose::TINT),
    })
}

/// The plant of a cell of which the growth map says `growth`: 0 nothing grows, 255 all does, between them it is lower.
pub fn grown(plant: Plant, growth: u8) -> Option<Plant> {
    (growth > 0).then(|| Plant { height: plant.height * (f32::from(growth) / 255.0), ..plant })
}

/// 32 chance bits of the plant in a cell: how it differs from others of its kind.
#[inline(always)]
pub fn variety(p: &PlacementParameters, patch: [i32; 2], cell: u32) -> u32 {
    math::hash(p.seed, patch[0], patch[1], cell, purpose::VARIETY)
}

/// A chance number, 0 to 1, about blade number `blade` of the plant in a cell; `question` is below 16.
pub fn of_blade(p: &PlacementParameters, patch: [i32; 2], cell: [u32; 2], blade: u32, question: u32) -> f32 {
    let index = cell[1] * p.cells + cell[0];
    math::unit(math::hash(p.seed, patch[0], patch[1], index, purpose::BLADE * (blade + 1) + question))
}

/// Whether the plant of a cell is still there where only `share` of them are.
pub fn stays(p: &PlacementParameters, patch: [i32; 2], cell: [u32; 2], share: f32) -> bool {
    let index = cell[1] * p.cells + cell[0];
    math::unit(math::hash(p.seed, patch[0], patch[1], index, purpose::PRESENT)) < cover(p, clump(p, patch, cell)) * share
}
