//! Plants of a place as they stand: what a picture shows of each when the eye is near, as points in the world.
//!
//! For looking inside: how long a plant is now, and how deep it is in a body. Reads cells and wind; where a GPU steps, download its cells first.

use super::blade_plan;
use super::blades::Blades;
use super::plan::{Seen, bits, draw};
use super::plants::Plant;
use super::prepare::{PrepareUniform, Preparing};
use super::subject;
use crate::interaction::solid::WorldSolid;
use crate::response::continuum::NODE_CELLS;
use crate::state::{PatchKey, in_field};
use crate::view::View;
use crate::world::World;

/// Farther than anything, m.
const FAR: f32 = 1e9;

/// A plant, or one of its blades, as it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct StandingPlant {
    /// From the root up, m; y is absolute. Of a sheet: its middle column.
    pub points: Vec<[f64; 3]>,
    /// Its own length, m.
    pub length: f32,
}

impl StandingPlant {
    /// How long it is now over how long it is by itself, 1 when all is well; less only where the ground holds it up.
    pub fn stretch(&self) -> f64 {
        let pieces = self.points.windows(2).map(|pair| pair[0].iter().zip(pair[1]).map(|(a, b)| (b - a) * (b - a)).sum::<f64>().sqrt());
        pieces.sum::<f64>() / f64::from(self.length)
    }

    /// How deep its deepest point is in a body, m; 0 for one that is in none.
    pub fn depth(&self, bodies: &[WorldSolid]) -> f64 {
        // Its root stays where it is, whatever stands on it.
        let points = self.points.iter().skip(1);
        points.flat_map(|point| bodies.iter().map(|body| body.depth(*point))).fold(0.0, f64::max)
    }

    /// How far its tip leans, rad along x and z from upright.
    pub fn lean(&self) -> [f64; 2] {
        let (Some(root), Some(tip)) = (self.points.first(), self.points.last()) else { return [0.0; 2] };
        let [x, y, z] = [0, 1, 2].map(|axis| tip[axis] - root[axis]);
        let level = x.hypot(z);
        let angle = level.atan2(y);
        if level > 0.0 { [x, z].map(|part| part / level * angle) } else { [0.0; 2] }
    }
}

/// Plants of stand number `stand` whose patch touches the ground from `low` to `high` \[m\], those outside of it left out; at most `most`, evenly
/// chosen. Empty for an unknown stand.
pub fn standing(world: &World, stand: usize, [low, high]: [[f64; 2]; 2], most: usize) -> Vec<StandingPlant> {
    if stand >= world.model.stands.len() {
        return Vec::new();
    }
    let side = world.model.patch_side;
    let patch = |at: [f64; 2]| at.map(|metres| (metres / side).floor() as i32);
    let ([left, near], [right, far]) = (patch(low), patch(high));
    let inside = |at: &[f64; 3]| (low[0]..=high[0]).contains(&at[0]) && (low[1]..=high[1]).contains(&at[2]);
    let mut found = Vec::new();
    // A place as large as a country has too many patches to look at all of them.
    for z in near..=far.min(near.saturating_add(64)) {
        for x in left..=right.min(left.saturating_add(64)) {
            if in_field(world.model.field, [x, z]) {
                found.extend(of_patch(world, stand, [x, z]).into_iter().filter(|plant| inside(&plant.points[0])));
            }
        }
    }
    let step = found.len().div_ceil(most.max(1)).max(1);
    found.into_iter().step_by(step).collect()
}

/// All plants of a patch.
fn of_patch(world: &World, index: usize, patch: PatchKey) -> Vec<StandingPlant> {
    let (stand, state) = (&world.model.stands[index], &world.state.stands[index]);
    let middle = patch.map(|along| (f64::from(along) + 0.5) * world.model.patch_side);
    // So near that nothing is left out, and from above, where nothing hides.
    let view = View { eye: [middle[0], 0.0, middle[1]], target: [middle[0], 1.0, middle[1]], field_of_view: 1.0 };
    let seen = Seen { view: &view, origin: patch, fullness: 1.0, near: 1.0, behind: 0.0 };
    let look = &subject::looks(world)[index];
    let wind = world.wind(stand);
    let uniform = PrepareUniform { full: FAR, gone: FAR, plain: 0.0, ..PrepareUniform::new(world, stand, false, &seen, look) };
    let preparing =
        Preparing { uniform, cells: &state.cells, terrain: &world.model.terrain, stand, wind: &wind, intervals: stand.cells / NODE_CELLS };
    let places = 1_u32 << (2 * bits(stand.cells));
    let corner = patch.map(|along| f64::from(along) * world.model.patch_side);
    let world_of = |at: [f32; 3]| [corner[0] + f64::from(at[0]), f64::from(at[1]), corner[1] + f64::from(at[2])];
    let mut found = Vec::new();
    if let Some(blade) = &stand.species.blade {
        let draw = draw(world, state, patch, patch, 0, places * blade.blades);
        Blades { preparing, uniform: blade_plan::everywhere(blade, look) }.all_of_patch(&draw, |blade, points| {
            found.push(StandingPlant { points: points.iter().map(|at| world_of(at.to_array())).collect(), length: blade.height });
        });
        return found;
    }
    let draw = draw(world, state, patch, patch, 0, places);
    let joints = uniform.joints() as usize;
    let (mut plants, mut all) = (vec![Plant::default(); places as usize], vec![[0.0; 4]; places as usize * joints]);
    preparing.prepare_patch(&draw, &mut plants, &mut all);
    let side = uniform.drawn as usize + 1;
    for (plant, joints) in plants.iter().zip(all.chunks_exact(joints)).filter(|(plant, _)| plant.height > 0.0) {
        let column = |row: &[[f32; 4]]| {
            let (a, b) = (row[(row.len() - 1) / 2], row[row.len() / 2]);
            [0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis]))
        };
        let points = match uniform.is_sheet() {
            true => joints.chunks_exact(side).map(|row| world_of(column(row))).collect(),
            false => joints.iter().map(|[x, y, z, _]| world_of([*x, *y, *z])).collect(),
        };
        found.push(StandingPlant { points, length: plant.height });
    }
    found
}
