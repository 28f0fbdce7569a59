//! Worlds in which bodies deform billboards: who has a sheet, what it costs, and that it is given back.

#[path = "../common/mod.rs"]
mod common;

#[path = "../figures/glb.rs"]
#[allow(dead_code)] // Only its walker is used.
mod glb;

mod asked;
mod costs;
mod figures;
mod passes;
mod pools;
mod stored;

use sward::response::springs::{Sheet, SheetRoot, SpringsModel, pool, root_of, target_of};
use sward::state::Billboard;
use sward::world::World;

/// A world with one such stand.
pub(crate) fn meadow(response: &str, rest: &str) -> World {
    common::world(&format!(
        "field: (patch_side: 16), stands: [(species: Meadow, cells: 32, height: (0.4, 0.4), response: Springs({response}))], {rest}"
    ))
}

/// The model of the first stand.
pub(crate) fn model(world: &World) -> &SpringsModel {
    world.model.stands[0].springs.as_ref().expect("bodies deform it")
}

/// A billboard with a sheet.
pub(crate) struct Deformed {
    pub(crate) billboard: Billboard,
    pub(crate) root: SheetRoot,
    pub(crate) target: Sheet,
    pub(crate) shown: Sheet,
}

/// All of them, in order.
pub(crate) fn deformed(world: &World) -> Vec<Deformed> {
    let (stand, state, model) = (&world.model.stands[0], &world.state.stands[0], model(world));
    let words = pool::words(&model.coefficients);
    let wind = world.wind(stand);
    let taken = state.sheets.pool.taken().map(|((patch, cell), place)| {
        let grown = state.cells.grown.get(&patch).map(|map| &map[..]);
        let root = root_of(&world.model.terrain, stand, model, grown, patch, cell).expect("it grows");
        let held = pool::load(&model.coefficients, &root, &state.cells.sheets[place as usize * words..][..words]);
        let target = target_of(model, &root, &wind, &wind.patch_phases(patch, stand.cells / 2));
        let shown = held.shown(&model.coefficients, &root, &target);
        Deformed { billboard: (patch, cell), root, target, shown }
    });
    taken.collect()
}
