//! Worlds of such plants, and where each of them is.

use sward::placement;
use sward::response::oscillator::{OscillatorCoefficients, Own, Record};
use sward::state::PatchKey;
use sward::world::World;

/// A world with one such stand: `stand` are its settings after the species, `rest` the rest of the scene.
pub(crate) fn field(stand: &str, rest: &str) -> World {
    crate::common::world(&format!("field: (patch_side: 16), stands: [(species: Meadow, cells: 64, {stand})], {rest}"))
}

/// The numbers of the first stand.
pub(crate) fn coefficients(world: &World) -> OscillatorCoefficients {
    world.model.stands[0].oscillator.as_ref().expect("it swings").coefficients
}

/// A plant that stands in an awake patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    /// Root, m.
    pub(crate) root: [f64; 2],
    /// How it swings.
    pub(crate) own: Own,
    /// How it was last left.
    pub(crate) record: Record,
}

impl Found {
    /// Whether a body holds it.
    pub(crate) fn is_held(&self, world: &World) -> bool {
        self.record.is_held() && self.record.steps_to(world.state.step as u32) == 0
    }

    /// Deviation `behind` steps before the state, rad.
    pub(crate) fn at(&self, world: &World, behind: f32) -> [f32; 2] {
        self.record.at(&coefficients(world), &self.own, world.state.step as u32, behind)
    }
}

/// Every plant of the first stand's awake patches that bodies have ever touched, in order, with the number of its patch and cell.
pub(crate) fn touched(world: &World) -> Vec<((PatchKey, u32), Found)> {
    let (stand, state) = (&world.model.stands[0], &world.state.stands[0]);
    let area = stand.cells * stand.cells;
    let mut found = Vec::new();
    for (patch, awake) in &state.awake {
        for cell in 0..area {
            let record = Record::load(&state.cells.now[awake.slot as usize], area as usize, cell as usize);
            if record == Record::default() {
                continue;
            }
            let plant =
                placement::plant(&stand.placement, *patch, [cell % stand.cells, cell / stand.cells]).expect("only plants are touched");
            let own = Own::of(&coefficients(world), placement::variety(&stand.placement, *patch, cell), plant.height);
            let root = [0, 1].map(|axis| f64::from(patch[axis]) * stand.patch_side + f64::from(plant.root[axis]));
            found.push(((*patch, cell), Found { root, own, record }));
        }
    }
    found
}

/// |v|.
pub(crate) fn length(v: [f32; 2]) -> f32 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}
