//! The step of a stand of plants that swing by themselves. Patches are independent of each other, so threads do not change the result.

use super::air::{Air, AirStep};
use super::blocks::{BLOCK, Block, Blocks};
use super::instigator::push;
use super::model::{OscillatorCoefficients, OscillatorModel};
use super::rebase::rebase;
use super::swing::{Own, Record};
use super::touch::{Plant, touch};
use crate::interaction::reaction::{Felt, Sums};
use crate::math;
use crate::placement::{self, Growing};
use crate::plan::{ContactPair, PatchPlan, StandPlan};
use crate::response::continuum::{self, NODE_CELLS};
use crate::response::each::each;
use crate::response::{Stage, StandModel};
use crate::state::{Cells, Ground, PatchKey, Summary, TILE};
use crate::terrain::Terrain;
use crate::wind::{Phases, WindField};

/// Values of a slot: records, and the tilt in the wind.
pub fn sizes(model: &OscillatorModel, cells: u32) -> [usize; 2] {
    let [cells, texels] = [cells, model.coefficients.texels].map(|side| side as usize);
    [4 * cells * cells, 4 * texels * texels]
}

/// The ground under the cells of a patch, and how far each one's plant has grown.
pub fn ground_of(terrain: &Terrain, stand: &StandModel, patch: PatchKey) -> Ground {
    let grown = if patch == TILE { None } else { stand.growth_map(terrain, patch) };
    Ground {
        grown: grown.iter().flat_map(|map| map.iter().map(|growing| growing.share)).collect(),
        ..continuum::shape_of(terrain, stand, patch)
    }
}

/// Makes room for the slots a plan names.
fn reserve(cells: &mut Cells, plan: &StandPlan, [records, air]: [usize; 2]) {
    for patch in &plan.patches {
        while cells.now.len() <= patch.slot as usize {
            cells.now.push(vec![0.0; records].into_boxed_slice());
            cells.old.push(vec![0.0; air].into_boxed_slice());
            cells.ground.push(Ground::default());
        }
        // Wind that varies has come to a stand that knew none.
        if let Some(planes) = cells.old.get_mut(patch.slot as usize).filter(|planes| planes.len() != air) {
            *planes = vec![0.0; air].into_boxed_slice();
        }
    }
}

/// The wind over a patch, and where its gusts are.
fn wind_of<'a>(stand: &StandModel, plan: &'a StandPlan, patch: PatchKey) -> (&'a WindField, Phases) {
    let wind = if patch == TILE { &plan.tile_wind } else { &plan.wind };
    (wind, wind.patch_phases(patch, stand.cells / NODE_CELLS))
}

/// wind → contact; returns what activation wants to know of each patch, and what is felt under each contact. `before` counts the steps done before this one. `ended` hears of each stage
/// that has just ended. Only cells in reach of bodies are looked at.
pub fn step(
    terrain: &Terrain,
    stand: &StandModel,
    model: &OscillatorModel,
    plan: &StandPlan,
    cells: &mut Cells,
    before: u64,
    ended: &mut dyn FnMut(Stage),
) -> (Vec<(PatchKey, Summary)>, Vec<Sums>) {
    let co = &model.coefficients;
    reserve(cells, plan, sizes(model, stand.cells));
    if let Some(former) = model.former.as_ref().filter(|_| plan.rebase) {
        rebase_all(terrain, stand, former, plan, cells, before as u32);
    }
    let mut slots: Vec<Option<&mut Box<[f32]>>> = cells.old.iter_mut().map(Some).collect();
    let work: Vec<_> = plan.patches.iter().filter_map(|patch| slots[patch.slot as usize].take().map(|planes| (patch, planes))).collect();
    let summaries = each(work, |(patch, planes)| {
        let (wind, phases) = wind_of(stand, plan, patch.patch);
        let mut air = AirStep { co, patch_side: stand.patch_side as f32, planes };
        let largest = air.step(wind, &phases, patch.woken || patch.aired, patch.keep);
        (patch.patch, Summary { largest, ..Summary::default() })
    });
    ended(Stage::Rest);
    let felt = contact(terrain, stand, model, plan, cells, (before as u32).wrapping_add(1));
    ended(Stage::Contact);
    (summaries, felt)
}

/// The motions of all awake plants go on by other numbers than the former ones.
fn rebase_all(terrain: &Terrain, stand: &StandModel, former: &OscillatorCoefficients, plan: &StandPlan, cells: &mut Cells, now: u32) {
    let mut slots: Vec<_> = cells.now.iter_mut().zip(&mut cells.ground).map(Some).collect();
    let work: Vec<_> = plan.patches.iter().filter_map(|patch| Some((patch, slots[patch.slot as usize].take()?))).collect();
    each(work, |(patch, (records, ground))| {
        if patch.edited {
            *ground = ground_of(terrain, stand, patch.patch);
        }
        rebase(former, &stand.placement, patch.patch, &ground.grown, records, now);
    });
}

/// Patches that wake, fade, or lie in reach of bodies; `now` counts the steps done after this one. Returns what is felt under each contact.
fn contact(terrain: &Terrain, stand: &StandModel, model: &OscillatorModel, plan: &StandPlan, cells: &mut Cells, now: u32) -> Vec<Sums> {
    let co = &model.coefficients;
    let blocks = Blocks::of(plan, stand.cells);
    let Cells { now: records, old: air, ground, .. } = cells;
    let mut slots: Vec<_> = records.iter_mut().zip(ground).map(Some).collect();
    let mut rest = &blocks.blocks[..];
    let mut work = Vec::new();
    for (index, patch) in plan.patches.iter().enumerate() {
        let (own, others) = rest.split_at(rest.iter().take_while(|block| block.patch as usize == index).count());
        rest = others;
        work.extend(slots[patch.slot as usize].take().map(|slot| (patch, own, slot)));
    }
    let felt = each(work, |(patch, own, (records, ground))| {
        if patch.woken {
            records.fill(0.0);
        }
        if patch.woken || patch.edited {
            *ground = ground_of(terrain, stand, patch.patch);
        }
        if patch.keep < 1.0 || is_census(now) {
            fade(co, records, patch.keep, now);
        }
        let (wind, phases) = wind_of(stand, plan, patch.patch);
        let air = Air { co, levels: air, around: patch.around, weights: patch.weights, patch_side: stand.patch_side as f32 };
        let touching = Touching { stand, co, plan, pairs: &blocks, patch, ground, air: &air, wind, phases: &phases, now };
        let mut felt = Vec::new();
        own.iter().for_each(|block| touching.block(block, records, &mut felt));
        felt
    });
    let mut sums = vec![Sums::default(); plan.contacts.len()];
    felt.into_iter().flatten().for_each(|(contact, felt)| sums[contact as usize].merge(&felt));
    sums
}

/// Steps in which all awake patches drop the records of plants long at rest: far apart, and often enough that no count of steps wraps.
pub fn is_census(now: u32) -> bool {
    now & ((1 << 21) - 1) == 0
}

/// All plants of a patch keep a share of their motion; those at rest forget it.
fn fade(co: &OscillatorCoefficients, records: &mut [f32], keep: f32, now: u32) {
    let area = records.len() / 4;
    for cell in 0..area {
        let record = Record::load(records, area, cell);
        let [x, z] = record.deviation;
        let faded = Record { deviation: [keep * x, keep * z], rate: keep * record.rate, ..record };
        let next = if record.is_aged(co, now) { Record::default() } else { faded };
        next.store(records, area, cell);
    }
}

/// A patch in reach of bodies.
struct Touching<'a> {
    stand: &'a StandModel,
    co: &'a OscillatorCoefficients,
    plan: &'a StandPlan,
    pairs: &'a Blocks,
    patch: &'a PatchPlan,
    ground: &'a Ground,
    air: &'a Air<'a>,
    wind: &'a WindField,
    phases: &'a Phases,
    now: u32,
}

impl Touching<'_> {
    fn block(&self, block: &Block, records: &mut [f32], felt: &mut Vec<(u32, Sums)>) {
        let (side, area) = (self.stand.cells, (self.stand.cells * self.stand.cells) as usize);
        let pairs = &self.pairs.pairs[block.first as usize..][..block.count as usize];
        let first = felt.len();
        felt.extend(pairs.iter().map(|pair| (pair.contact, Sums::default())));
        for k in 0..BLOCK * BLOCK {
            let cell = [block.corner[0] + k % BLOCK, block.corner[1] + k / BLOCK];
            let index = (cell[1] * side + cell[0]) as usize;
            if let Some((next, felt_there)) = self.cell(pairs, cell, index, records, area) {
                next.store(records, area, index);
                felt_there.into_iter().for_each(|(number, of_plant)| felt[first + number as usize].1.add(&of_plant));
            }
        }
    }

    /// The record of a cell's plant if bodies change it, and what which of them feels.
    fn cell(
        &self,
        pairs: &[ContactPair],
        cell: [u32; 2],
        index: usize,
        records: &[f32],
        area: usize,
    ) -> Option<(Record, Option<(u32, Felt)>)> {
        let over =
            |corner: [i32; 2], size: [i32; 2]| (0..2).all(|axis| (0..size[axis]).contains(&(cell[axis] as i32).wrapping_sub(corner[axis])));
        if !pairs.iter().any(|pair| over(pair.corner, self.plan.contacts[pair.contact as usize].size)) {
            return None;
        }
        let (placement, side) = (&self.stand.placement, self.stand.cells as usize);
        let plant = placement::plant(placement, self.patch.patch, cell)?;
        let plant = self.ground.grown.get(index).map_or(Some(plant), |growth| placement::grown(plant, Growing::of_share(*growth)))?;
        let spacing = placement.spacing;
        let slope = self.ground.slope(side, index);
        let off = [0, 1].map(|axis: usize| plant.root[axis] - (cell[axis] as f32 + 0.5) * spacing);
        let ground = self.ground.height(side, index) + slope[0] * off[0] + slope[1] * off[1];
        let (sine, cosine) = math::sin_cos(plant.yaw);
        let from_corner = |pair: &ContactPair| [0, 1].map(|axis: usize| plant.root[axis] - pair.corner[axis] as f32 * spacing);
        let pushes = pairs.iter().enumerate().filter_map(|(number, pair)| {
            let contact = &self.plan.contacts[pair.contact as usize];
            let at = from_corner(pair);
            let edges = self.plan.edges[contact.edge_first as usize..][..contact.edge_count as usize].iter().copied();
            let found = over(pair.corner, contact.size).then(|| push(self.co, contact, edges, at, ground, plant.height, [cosine, sine]));
            Some((number as u32, found??, contact.stays))
        });
        let record = Record::load(records, area, index);
        let own = Own::of(self.co, placement::variety(placement, self.patch.patch, index as u32), plant.height);
        let wind = self.air.at(plant.root, 0.0, || self.wind.velocity_local(self.phases, plant.root));
        let inertia = self.stand.inertia * plant.height * plant.height * plant.height;
        let touched = touch(self.co, &Plant { own, record, wind, inertia, length: plant.height }, pushes, self.now)?;
        let felt = touched.leaning.map(|(number, leaning)| {
            let pair = &pairs[number as usize];
            let contact = &self.plan.contacts[pair.contact as usize];
            let [x, z] = from_corner(pair);
            (number, leaning.felt([x - contact.centre[0], ground - contact.end[2], z - contact.centre[1]]))
        });
        Some((touched.record, felt))
    }
}
