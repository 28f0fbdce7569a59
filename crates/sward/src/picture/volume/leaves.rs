//! How dense the leaves are: every plant of the scene, as large as it is drawn, as a haze.

use super::room::Room;
use crate::growth::Growth;
use crate::placement::{Growing, grown, plant};
use crate::response::StandModel;
use crate::scene::{Billboard, Blade};
use crate::shading::clump::{Clump, SIDE, paint};
use crate::shading::look::Look;
use crate::state::in_field;
use crate::terrain::Terrain;
use crate::world::World;

/// Parts of a plant's height.
const PARTS: usize = 16;
/// Mean area of a leaf across a ray, as a share of its own, where leaves lie every way.
const ACROSS: f32 = 0.5;
/// A blade is this wide on average, as a share of its width.
const MEAN_WIDTH: f32 = 0.7;

/// Leaves of one plant of a stand.
struct Leaves {
    /// Area for each metre of height, m.
    width: f32,
    /// Share of it in each part of the height, from the root up.
    parts: [f32; PARTS],
}

impl Leaves {
    /// Of crossed cards: as much as their picture covers, where it does.
    fn of_cards(billboard: &Billboard, look: &Look) -> Self {
        let Clump { rgba } = paint(look.kind, 0);
        let mut parts = [0.0; PARTS];
        let rows = SIDE / PARTS;
        for (at, line) in rgba.chunks_exact(SIDE).enumerate() {
            let covered: u32 = line.iter().map(|texel| u32::from(texel[3])).sum();
            parts[(PARTS - 1).saturating_sub(at / rows)] += covered as f32 / (255.0 * (SIDE * SIDE) as f32);
        }
        Self::shared(billboard.width * billboard.cards as f32, parts)
    }

    /// Of blades: fewer and fewer reach up.
    fn of_blades(blade: &Blade) -> Self {
        let shortest = blade.shortest.min(0.99);
        let part = |part: usize| {
            let up = (part as f32 + 0.5) / PARTS as f32;
            ((1.0 - up) / (1.0 - shortest)).clamp(0.0, 1.0) / PARTS as f32
        };
        Self::shared(blade.blades as f32 * blade.width * MEAN_WIDTH, std::array::from_fn(part))
    }

    fn shared(width: f32, parts: [f32; PARTS]) -> Self {
        let all: f32 = parts.iter().sum();
        Self { width: width * all, parts: parts.map(|part| part / all.max(1e-9)) }
    }

    fn of(stand: &StandModel, look: &Look) -> Self {
        match &stand.species.blade {
            Some(blade) => Self::of_blades(blade),
            None => Self::of_cards(&stand.species.billboard, look),
        }
    }
}

/// Share of light lost per metre in levels of even height, and the mean colour of the leaves.
pub(super) struct Haze {
    /// 1/m, level by level from the ground, row by row.
    pub(super) lost: Vec<f32>,
    /// 1/m in each level where everything grows.
    pub(super) open: Vec<f32>,
    /// What leaves send on of the light that meets them, linear RGB.
    pub(super) albedo: [f32; 3],
}

/// Adds a plant's leaves, `area` \[m²\] over `height` \[m\], to levels of a column.
fn pile(leaves: &Leaves, height: f32, level: f32, levels: usize, mut add: impl FnMut(usize, f32)) {
    for (part, share) in leaves.parts.iter().enumerate() {
        let up = (part as f32 + 0.5) / PARTS as f32 * height;
        add(((up / level) as usize).min(levels - 1), share * leaves.width * height);
    }
}

/// Patches under a box, first and last.
fn patches(room: &Room, side: f64) -> [[i32; 2]; 2] {
    let extent = room.extent();
    let at = |axis: usize, metres: f64| ((room.corner[axis] + metres) / side).floor() as i32;
    [[at(0, 0.0), at(1, 0.0)], [at(0, extent[0]), at(1, extent[1])]]
}

/// The plants of a stand over a box: root in voxels from its corner, and height \[m\].
fn plants(room: &Room, stand: &StandModel, terrain: &Terrain, field: Option<[[i32; 2]; 2]>, mut each: impl FnMut([f32; 2], f32)) {
    let side = stand.patch_side;
    let [low, high] = patches(room, side);
    for z in low[1]..=high[1] {
        for x in low[0]..=high[0] {
            if !in_field(field, [x, z]) {
                continue;
            }
            let corner = [f64::from(x) * side - room.corner[0], f64::from(z) * side - room.corner[1]];
            let growth = map(&stand.growth, stand, terrain, [x, z]);
            for index in 0..stand.cells * stand.cells {
                let cell = [index % stand.cells, index / stand.cells];
                let inside = (0..2).all(|axis| {
                    let at = (corner[axis] + f64::from(cell[axis]) * stand.spacing) / room.voxel[axis];
                    at > -2.0 && at < f64::from(room.size[axis]) + 1.0
                });
                let Some(grown) = inside
                    .then(|| plant(&stand.placement, [x, z], cell))
                    .flatten()
                    .and_then(|plant| grown(plant, growth.as_ref().map_or(Growing::of_share(255), |map| map[index as usize])))
                else {
                    continue;
                };
                let at = [0, 1].map(|axis| ((corner[axis] + f64::from(grown.root[axis])) / room.voxel[axis]) as f32);
                each(at, grown.height);
            }
        }
    }
}

fn map(growth: &Growth, stand: &StandModel, terrain: &Terrain, patch: [i32; 2]) -> Option<Box<[Growing]>> {
    growth.map(&stand.placement, terrain, patch, stand.patch_side)
}

impl Haze {
    /// Of all plants over the box, in `levels` levels.
    pub(super) fn of(world: &World, looks: &[Look], room: &Room, levels: usize) -> Self {
        let columns = room.columns();
        let (mut lost, mut open) = (vec![0.0; levels * columns], vec![0.0; levels]);
        let (mut colour, mut weight) = (glam::Vec3::ZERO, 0.0);
        let level = room.height / levels as f32;
        let cell = ACROSS / ((room.voxel[0] * room.voxel[1]) as f32 * level);
        for (stand, look) in world.model.stands.iter().zip(looks) {
            let leaves = Leaves::of(stand, look);
            plants(room, stand, &world.model.terrain, world.model.field, |at, height| {
                let (corners, shares) = around(at, room.size);
                pile(&leaves, height, level, levels, |up, area| {
                    for (column, share) in corners.iter().zip(shares) {
                        lost[up * columns + column] += area * share * cell;
                    }
                });
            });
            // The mean over the first patch, as if nothing kept anything away.
            let mut all = 0.0;
            for index in 0..stand.cells * stand.cells {
                let Some(plant) = plant(&stand.placement, [0, 0], [index % stand.cells, index / stand.cells]) else { continue };
                all += leaves.width * plant.height;
                let ground = (stand.patch_side * stand.patch_side) as f32;
                pile(&leaves, plant.height, level, levels, |up, area| open[up] += area * ACROSS / (ground * level));
            }
            let mean = 0.5 * (glam::Vec3::from(look.root) + glam::Vec3::from(look.tip));
            colour += all * (mean + mean * glam::Vec3::new(1.15, 1.35, 0.40) * look.through);
            weight += all;
        }
        let albedo = (colour / f32::max(weight, 1e-9)).clamp(glam::Vec3::ZERO, glam::Vec3::splat(0.95));
        Self { lost, open, albedo: albedo.to_array() }
    }
}

/// The four columns round a place, in voxels from the corner, and their shares.
fn around(at: [f32; 2], size: [u32; 3]) -> ([usize; 4], [f32; 4]) {
    let low = at.map(|at| crate::math::floored(at - 0.5));
    let part = [0, 1].map(|axis| at[axis] - 0.5 - low[axis] as f32);
    let clamped = |axis: usize, more: i32| (low[axis] + more).clamp(0, size[axis] as i32 - 1) as usize;
    let outside = |axis: usize, more: i32| low[axis] + more < 0 || low[axis] + more >= size[axis] as i32;
    let corner = |k: i32| clamped(1, k >> 1) * size[0] as usize + clamped(0, k & 1);
    let share = |k: i32| {
        let along = |axis: usize, more: i32| {
            let own = if more == 0 { 1.0 - part[axis] } else { part[axis] };
            if outside(axis, more) { 0.0 } else { own }
        };
        along(0, k & 1) * along(1, k >> 1)
    };
    ([0, 1, 2, 3].map(corner), [0, 1, 2, 3].map(share))
}
