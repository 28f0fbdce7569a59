//! One step of a stand that moves blade by blade, on the CPU. Patches are independent of each other, so threads do not change the result.

use super::blade::MOST_SEGMENTS;
use super::held::{HeldBlade, Holding};
use super::joint::count;
use super::model::ChainModel;
use super::planting;
use super::push::Obstacles;
use super::standing::Standing;
use super::virtual_blades::VirtualBlades;
use crate::interaction::reaction::Sums;
use crate::plan::{PatchPlan, StandPlan};
use crate::response::each::each;
use crate::response::{Stage, StandModel};
use crate::state::{Cells, NONE, PatchKey, Root, Summary, TILE};
use crate::terrain::Terrain;
use crate::wind::{Phases, WindField};

/// Deviation of a patch with blades that bodies have touched: far beyond any rest.
pub const RESTLESS: f32 = 1e30;

/// Planes of the moments, of the states and of the blades of a patch.
pub fn sizes(chain: &ChainModel, cells: u32) -> [usize; 3] {
    let (n, area) = (count(&chain.coefficients), (chain.virtual_side * chain.virtual_side) as usize);
    [2 * n * area, 4 * n * area, chain.planes() * chain.blades_of_patch(cells) as usize]
}

/// Where the blades of a patch stand: see [`planting::roots`].
pub fn roots(terrain: &Terrain, stand: &StandModel, chain: &ChainModel, patch: PatchKey) -> Box<[Root]> {
    let growth = stand.growth_map(terrain, patch);
    planting::roots(&chain.stances, &stand.placement, terrain, growth.as_deref(), patch, stand.patch_side)
}

/// Makes room for the slots a plan names.
fn reserve(cells: &mut Cells, plan: &StandPlan, [moments, states, blades]: [usize; 3]) {
    let room = |slots: &mut Vec<Box<[f32]>>, slot: u32, length: usize| {
        while slots.len() <= slot as usize {
            slots.push(vec![0.0; length].into_boxed_slice());
        }
    };
    for patch in &plan.patches {
        room(&mut cells.now, patch.slot, moments);
        room(&mut cells.old, patch.slot, moments);
        room(&mut cells.virtual_states, patch.slot, states);
        if patch.lag != NONE {
            room(&mut cells.lag, patch.lag, blades);
            cells.roots.resize(cells.lag.len(), Box::default());
        }
    }
}

/// The wind over a patch, and where its gusts are.
fn wind_of<'a>(stand: &StandModel, plan: &'a StandPlan, patch: PatchKey) -> (&'a WindField, Phases) {
    let wind = if patch == TILE { &plan.tile_wind } else { &plan.wind };
    (wind, wind.patch_phases(patch, stand.cells / crate::response::continuum::NODE_CELLS))
}

/// Virtual blades → blades with a state; returns what activation wants to know of each patch, and what each of `plan.solids.heads` feels. `cells.now` is one step on afterwards.
/// `ended` hears of each stage that has just ended.
pub fn step(
    terrain: &Terrain,
    stand: &StandModel,
    chain: &ChainModel,
    plan: &StandPlan,
    cells: &mut Cells,
    dt: f32,
    ended: &mut dyn FnMut(Stage),
) -> (Vec<(PatchKey, Summary)>, Vec<Sums>) {
    reserve(cells, plan, sizes(chain, stand.cells));
    let mut summaries = virtual_blades(stand, chain, plan, cells, dt);
    std::mem::swap(&mut cells.now, &mut cells.old);
    ended(Stage::Virtual);
    let held = blades(terrain, stand, chain, plan, cells, dt);
    let mut sums = vec![Sums::default(); plan.solids.heads.len()];
    for Held { patch, first, count, fastest, felt } in held {
        felt.iter().enumerate().for_each(|(number, felt)| sums[first + number].merge(felt));
        let Ok(index) = summaries.binary_search_by(|(key, _)| key.cmp(&patch)) else { continue };
        let summary = &mut summaries[index].1;
        summary.held = count;
        // Blades that bodies have touched are no rest; where all have a state, they rest as they stop.
        let restless = if chain.all { fastest } else { RESTLESS };
        summary.largest = if count > 0 && restless > summary.largest { restless } else { summary.largest };
    }
    ended(Stage::Blades);
    (summaries, sums)
}

/// The blades of a patch after a step.
struct Held {
    patch: PatchKey,
    /// How many are held.
    count: u32,
    /// The largest |ω|² of them.
    fastest: f32,
    /// First of the patch's solids.
    first: usize,
    /// What each of them feels.
    felt: Vec<Sums>,
}

/// `cells.old` receives the moments of the future.
fn virtual_blades(stand: &StandModel, chain: &ChainModel, plan: &StandPlan, cells: &mut Cells, dt: f32) -> Vec<(PatchKey, Summary)> {
    type Slot<'a> = ((&'a mut Box<[f32]>, &'a mut Box<[f32]>), &'a mut Box<[f32]>);
    let mut slots: Vec<Option<Slot>> = cells.now.iter_mut().zip(&mut cells.old).zip(&mut cells.virtual_states).map(Some).collect();
    let work: Vec<(&PatchPlan, Slot)> =
        plan.patches.iter().filter_map(|patch| slots[patch.slot as usize].take().map(|slot| (patch, slot))).collect();
    each(work, |(patch, ((now, old), state))| {
        let (wind, phases) = wind_of(stand, plan, patch.patch);
        let mut virtual_ = VirtualBlades { chain, patch_side: stand.patch_side as f32, state, moments: old };
        if patch.woken {
            virtual_.wake(wind, &phases);
            now.copy_from_slice(virtual_.moments);
        }
        let largest = virtual_.step(wind, &phases, dt, patch.keep);
        (patch.patch, Summary { largest, ..Summary::default() })
    })
}

/// Blades of the patches that have room for them.
fn blades(terrain: &Terrain, stand: &StandModel, chain: &ChainModel, plan: &StandPlan, cells: &mut Cells, dt: f32) -> Vec<Held> {
    let (now, old) = (&cells.now, &cells.old);
    type Slot<'a> = (&'a mut Box<[f32]>, &'a mut Box<[Root]>);
    let mut slots: Vec<Option<Slot>> = cells.lag.iter_mut().zip(&mut cells.roots).map(Some).collect();
    let with_room = plan.patches.iter().filter(|patch| patch.lag != NONE);
    let work: Vec<_> = with_room.filter_map(|patch| slots[patch.lag as usize].take().map(|slot| (patch, slot))).collect();
    each(work, |(patch, (values, roots))| {
        if patch.lag_woken || roots.is_empty() {
            values.fill(0.0);
        }
        if patch.lag_woken || patch.edited || roots.is_empty() {
            *roots = self::roots(terrain, stand, chain, patch.patch);
        }
        let (wind, phases) = wind_of(stand, plan, patch.patch);
        let standing = Standing { chain, around: patch.around, weights: patch.weights, patch_side: stand.patch_side as f32 };
        let holding = Holding {
            co: &chain.coefficients,
            obstacles: Obstacles { heads: &plan.solids.heads[patch.solids.clone()], planes: &plan.solids.planes },
            dt,
            keep: patch.keep,
            pixels: patch.pixels,
            all: chain.all,
            handing: patch.handing,
        };
        let (mut held, mut fastest) = (0, 0.0);
        let mut felt = vec![Sums::default(); patch.solids.len()];
        for (index, root) in roots.iter().enumerate() {
            // Most are neither held nor within reach of a body.
            let hold = |plane: usize| values[(6 * count(&chain.coefficients) + plane) * roots.len() + index];
            let idle = hold(0) <= 0.0 && hold(1) <= 0.0 && !chain.all;
            if root.length <= 0.0 || (idle && !holding.obstacles.reach(root)) {
                continue;
            }
            let local = [root.at[0], root.at[2]];
            let air = || wind.velocity_local(&phases, local);
            let mut blade = loaded(values, roots.len(), index, count(&chain.coefficients));
            let by = holding.step(
                root,
                &mut blade,
                |base, before| standing.pose(base, root.curl, &standing.moments(if before { old } else { now }, local, air)),
                air,
            );
            if let Some((solid, of_blade)) = by {
                felt[solid as usize].add(&of_blade);
            }
            store(values, roots.len(), index, count(&chain.coefficients), &blade);
            if blade.hold > 0.0 {
                held += 1;
                let rates = blade.state.joints.iter().map(|[_, _, x, y]| x * x + y * y);
                fastest = rates.fold(fastest, |most: f32, rate| if rate > most { rate } else { most });
            }
        }
        Held { patch: patch.patch, count: held, fastest, first: patch.solids.start, felt }
    })
}

/// Blade `index` of the planes of `total` blades of `n` segments.
pub fn loaded(values: &[f32], total: usize, index: usize, n: usize) -> HeldBlade {
    let at = |plane: usize| values[plane * total + index];
    let mut blade = HeldBlade { hold: at(6 * n), hold_before: at(6 * n + 1), ..HeldBlade::default() };
    for i in 0..if n < MOST_SEGMENTS { n } else { MOST_SEGMENTS } {
        blade.state.joints[i] = [at(4 * i), at(4 * i + 1), at(4 * i + 2), at(4 * i + 3)];
        blade.before[i] = [at(4 * n + 2 * i), at(4 * n + 2 * i + 1)];
    }
    blade
}

fn store(values: &mut [f32], total: usize, index: usize, n: usize, blade: &HeldBlade) {
    let mut put = |plane: usize, value: f32| values[plane * total + index] = value;
    for i in 0..if n < MOST_SEGMENTS { n } else { MOST_SEGMENTS } {
        (0..4).for_each(|part| put(4 * i + part, blade.state.joints[i][part]));
        (0..2).for_each(|part| put(4 * n + 2 * i + part, blade.before[i][part]));
    }
    put(6 * n, blade.hold);
    put(6 * n + 1, blade.hold_before);
}
