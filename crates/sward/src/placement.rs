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
    pub(super) const LEAN_X: u32 = 9;
    pub(super) const LEAN_Z: u32 = 10;
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
    /// Tilt of a plant that nothing moves, rad along x and z.
    pub lean: [f32; 2],
    /// How far each leans some way of its own, 0 to 1.
    pub messiness: f32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: f32,
}

/// Most that a plant leans by itself, rad.
pub const MOST_LEAN: f32 = 1.2;
/// Where messiness is 1 a plant leans up to so much some way of its own, along x and along z, rad.
const MESSY: f32 = 0.6;

/// What a growth map says of one cell's plant; the same four bytes in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Growing {
    /// 0 nothing grows, 255 all does, between them it is lower.
    pub share: u8,
    /// Not 0: it leans as the map says.
    pub combed: u8,
    /// How, hundredths of a radian along x and z.
    pub lean: [i8; 2],
}

impl Growing {
    /// Only how much of it grows, 0 to 255.
    pub fn of_share(share: u8) -> Self {
        Self { share, ..Self::default() }
    }
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
    /// Tilt when nothing moves it, rad along x and z.
    pub lean: [f32; 2],
}

/// A corner of the clump lattice of a patch, 0 to 1; one on the far border is the first of the next patch.
fn clump_corner(p: &PlacementParameters, patch: [i32; 2], [ci, cj]: [u32; 2]) -> f32 {
    let (over_x, over_z) = (ci / p.clumps, cj / p.clumps);
    let at = (cj - over_z * p.clumps) * p.clumps + (ci - over_x * p.clumps);
    let (x, z) = (patch[0].wrapping_add(over_x as i32), patch[1].wrapping_add(over_z as i32));
    math::unit(math::hash(p.seed, x, z, at, purpose::CLUMP))
}

/// Smooth value noise over the clump lattice, 0 to 1, continuous across patches; `corner` gives those of the patch.
#[inline(always)]
fn clump_of(p: &PlacementParameters, cell: [u32; 2], corner: impl Fn([u32; 2]) -> f32) -> f32 {
    let scale = p.clumps as f32 / p.cells as f32;
    let (x, z) = ((cell[0] as f32 + 0.5) * scale, (cell[1] as f32 + 0.5) * scale);
    let (i, j) = (x as u32, z as u32);
    let (fx, fz) = (x - i as f32, z - j as f32);
    let (sx, sz) = (fx * fx * (3.0 - 2.0 * fx), fz * fz * (3.0 - 2.0 * fz));
    let low = corner([i, j]) + (corner([i + 1, j]) - corner([i, j])) * sx;
    let high = corner([i, j + 1]) + (corner([i + 1, j + 1]) - corner([i, j + 1])) * sx;
    low + (high - low) * sz
}

fn clump(p: &PlacementParameters, patch: [i32; 2], cell: [u32; 2]) -> f32 {
    clump_of(p, cell, |corner| clump_corner(p, patch, corner))
}

/// The clumps of one patch, for whoever asks about many of its plants.
pub struct Clumps(Box<[f32]>);

impl Clumps {
    /// Those of a patch.
    pub fn of(p: &PlacementParameters, patch: [i32; 2]) -> Self {
        let side = p.clumps + 1;
        Self((0..side * side).map(|at| clump_corner(p, patch, [at % side, at / side])).collect())
    }

    /// The plant of a cell: [`plant`], to the bit.
    pub fn plant(&self, p: &PlacementParameters, patch: [i32; 2], cell: [u32; 2]) -> Option<Plant> {
        let clump = clump_of(p, cell, |[i, j]| self.0[(j * (p.clumps + 1) + i) as usize]);
        plant_in(p, patch, cell, clump)
    }
}

/// Share of cells that carry a plant where the clump noise is `clump`.
fn cover(p: &PlacementParameters, clump: f32) -> f32 {
    p.cover * (1.0 - p.clumping * (1.0 - clump))
}

/// The plant of a cell, if there is one. `patch` is counted from the scene's origin patch, `cell` = (i, j) below `cells`.
pub fn plant(p: &PlacementParameters, patch: [i32; 2], cell: [u32; 2]) -> Option<Plant> {
    plant_in(p, patch, cell, clump(p, patch, cell))
}

/// The same where the clump noise is known.
fn plant_in(p: &PlacementParameters, patch: [i32; 2], cell: [u32; 2], clump: f32) -> Option<Plant> {
    let index = cell[1] * p.cells + cell[0];
    let random = |purpose: u32| math::unit(math::hash(p.seed, patch[0], patch[1], index, purpose));
    if random(purpose::PRESENT) >= cover(p, clump) {
        return None;
    }
    let lean = if p.messiness > 0.0 { scattered(p, patch, index, p.lean, p.messiness) } else { p.lean };
    let share = random(purpose::HEIGHT) * (1.0 - p.clumping) + clump * p.clumping;
    Some(Plant {
        root: [(cell[0] as f32 + random(purpose::PLACE_X)) * p.spacing, (cell[1] as f32 + random(purpose::PLACE_Z)) * p.spacing],
        height: p.height[0] + (p.height[1] - p.height[0]) * share,
        yaw: random(purpose::YAW) * std::f32::consts::TAU,
        tint: random(purpose::TINT),
        lean,
    })
}

/// How the plant of cell number `index` leans where all lean by `lean` \[rad\], and some way of their own by `messiness`, 0 to 1.
///
/// Orthmann et al. 2009, §4: direction and messiness.
pub fn scattered(p: &PlacementParameters, patch: [i32; 2], index: u32, lean: [f32; 2], messiness: f32) -> [f32; 2] {
    let random = |purpose: u32| math::unit(math::hash(p.seed, patch[0], patch[1], index, purpose));
    let own = [random(purpose::LEAN_X), random(purpose::LEAN_Z)].map(|chance| messiness * MESSY * (2.0 * chance - 1.0));
    let [x, z] = [lean[0] + own[0], lean[1] + own[1]];
    let length = (x * x + z * z).sqrt();
    let kept = if length > MOST_LEAN { MOST_LEAN / length } else { 1.0 };
    [x * kept, z * kept]
}

/// The plant of a cell as the growth map has it.
pub fn grown(plant: Plant, growing: Growing) -> Option<Plant> {
    let lean = if growing.combed > 0 { growing.lean.map(|part| f32::from(part) * 0.01) } else { plant.lean };
    (growing.share > 0).then(|| Plant { height: plant.height * (f32::from(growing.share) / 255.0), lean, ..plant })
}

/// Where a blade leans, rad from +x towards +z, and by how much, whose plant leans besides.
pub fn combed(yaw: f32, lean: f32, plant: [f32; 2]) -> (f32, f32) {
    if plant == [0.0; 2] {
        return (yaw, lean);
    }
    let (sine, cosine) = math::sin_cos(yaw);
    let [x, z] = [lean * cosine + plant[0], lean * sine + plant[1]];
    (math::atan2(z, x), math::lower((x * x + z * z).sqrt(), MOST_LEAN))
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
