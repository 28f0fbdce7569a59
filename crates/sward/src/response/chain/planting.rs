//! Where the blades of a patch stand: worked out when bodies reach it, on the CPU, so that all backends push the same blades.

use super::model::Stances;
use crate::placement::{self, Growing, PlacementParameters};
use crate::state::{PatchKey, Root};
use crate::terrain::Terrain;

/// All blades of a patch: those of the first of each plant cell by cell, then the second ones, and so on. Length 0 where none grows.
pub fn roots(
    stances: &Stances,
    placement: &PlacementParameters,
    terrain: &Terrain,
    growth: Option<&[Growing]>,
    patch: PatchKey,
    patch_side: f64,
) -> Box<[Root]> {
    let anchor = terrain.anchor(patch.map(|p| f64::from(p) * patch_side));
    let area = placement.cells * placement.cells;
    let mut roots = vec![Root::default(); (stances.blades * area) as usize].into_boxed_slice();
    for index in 0..area {
        let cell = [index % placement.cells, index / placement.cells];
        let Some(plant) = placement::plant(placement, patch, cell) else { continue };
        let Some(plant) = growth.map_or(Some(plant), |growth| placement::grown(plant, growth[index as usize])) else { continue };
        for which in 0..stances.blades {
            let random = |question: u32| placement::of_blade(placement, patch, cell, which, question);
            let local = [0, 1].map(|axis: usize| {
                let anywhere = (cell[axis] as f32 + random(axis as u32)) * placement.spacing;
                anywhere + (plant.root[axis] - anywhere) * stances.tuft
            });
            let (height, slope) = terrain.height_and_gradient(anchor, local);
            let (yaw, lean) = placement::combed(random(4) * stances.turn, stances.lean * random(7), plant.lean);
            roots[(which * area + index) as usize] = Root {
                at: [local[0], height, local[1]],
                length: plant.height * (stances.shortest + (1.0 - stances.shortest) * random(3)),
                yaw,
                lean,
                curl: stances.curl * random(8),
                unused: 0.0,
                slope,
                more_unused: [0.0; 2],
            };
        }
    }
    roots
}
