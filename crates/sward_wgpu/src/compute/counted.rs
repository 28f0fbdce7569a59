//! What the passes of a step do, counted from its plan: no device is needed for it, and the counts are those of [`super::Work`].

use sward::plan::{LayeredPlan, Plan, StandPlan};
use sward::response::chain::{self, ChainModel, Obstacles};
use sward::response::harmonic::TOUCH_SIDE;
use sward::response::oscillator::{Blocks, OscillatorModel, is_census};
use sward::response::springs::SpringsModel;
use sward::response::{StandModel, harmonic::HarmonicModel};
use sward::scene::Precision;
use sward::state::{Cells, NONE, Root};
use sward::world::World;

use super::distance_maps::Drawing;
use super::entries::StandUniform;
use super::fluid;
use super::sheets::{self, MOST_AT_ONCE};
use super::swings::ROW;
use super::traffic::{self, Patches, Traffic};

/// All passes there are, in alphabetical order.
pub const PASSES: [&str; 25] = [
    "advect_pass",
    "air_pass",
    "blades_pass",
    "busy_pass",
    "columns_pass",
    "contact_pass",
    "draw_pass",
    "end_pass",
    "fade_pass",
    "force_pass",
    "lag_pass",
    "large_pass",
    "plane_pass",
    "plant_pass",
    "project_pass",
    "rest_pass",
    "rows_pass",
    "sheet_resolve_pass",
    "sheet_touch_pass",
    "spread_pass",
    "touch_pass",
    "virtual_pass",
    "wake_pass",
    "wave_pass",
    "write_pass",
];

/// What one pass of a step does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PassWork {
    /// Its entry point.
    pub pass: &'static str,
    /// Of whom: index of the stand, or none of what all share.
    pub stand: Option<usize>,
    /// Dispatches.
    pub dispatches: u64,
    /// Invocations.
    pub invocations: u64,
    /// Bytes read and written at least: see [`traffic`].
    pub bytes: u64,
}

/// Passes in the order they are recorded.
#[derive(Default)]
struct Counted {
    passes: Vec<PassWork>,
    stand: Option<usize>,
}

impl Counted {
    /// A pass of so many workgroups of 64; none of it where its third number is 0.
    fn add(&mut self, pass: &'static str, groups: [u32; 3], bytes: u64) {
        if groups[2] > 0 {
            let invocations = 64 * groups.map(u64::from).iter().product::<u64>();
            self.passes.push(PassWork { pass, stand: self.stand, dispatches: 1, invocations, bytes });
        }
    }
}

/// What each pass of a step on the GPU does: `plan` is the world's own of the coming step, and the world's cells are those before it. Of blades,
/// whose dispatch the device works out itself, it needs those cells; all else is decided by the plan.
pub fn passes(world: &World, plan: &Plan) -> Vec<PassWork> {
    let mut counted = Counted::default();
    maps(&mut counted, world, plan);
    for (index, stand) in plan.stands.iter().enumerate() {
        let (model, cells) = (&world.model.stands[index], &world.state.stands[index].cells);
        counted.stand = Some(index);
        if let Some(chain) = &model.chain {
            blades(&mut counted, world, (model, chain), stand, cells);
        } else if let Some(springs) = &model.springs {
            billboards(&mut counted, world, (index, springs), stand);
        } else if let Some(oscillator) = &model.oscillator {
            swings(&mut counted, (model, oscillator), stand, plan.step);
        } else {
            continuum(&mut counted, world, model, stand, plan.step);
        }
    }
    counted.stand = None;
    for (stand, own) in world.model.layered.iter().zip(&plan.layered) {
        layers(&mut counted, &stand.harmonic, own);
    }
    for flowing in world.model.fluids.iter().zip(&plan.fluids).map(|(flowing, _)| flowing) {
        for pass in fluid::PASSES {
            counted.add(pass, [flowing.model.side as u32, 1, 1], traffic::air(pass, flowing.texels() as u64));
        }
    }
    counted.passes
}

fn maps(counted: &mut Counted, world: &World, plan: &Plan) {
    if world.model.stands.iter().all(|stand| stand.springs.is_none()) {
        return;
    }
    let posed = sheets::posed(world, &plan.maps);
    let drawing = Drawing::of(&sheets::map_inputs(world, &posed));
    let [draw, large, write] = drawing.groups();
    counted.add("draw_pass", draw, traffic::drawn_maps(drawing.triangles.len() as u64, drawing.points.len() as u64));
    counted.add("large_pass", large, 0);
    counted.add("write_pass", write, traffic::written_maps(u64::from(drawing.winners)));
}

fn continuum(counted: &mut Counted, world: &World, stand: &StandModel, plan: &StandPlan, step: u64) {
    let count = |keep: fn(&sward::plan::PatchPlan) -> bool| plan.patches.iter().filter(|patch| keep(patch)).count();
    let [awake, woken, touched, lagged] =
        [plan.patches.len(), count(|patch| patch.woken), count(|patch| !patch.pairs.is_empty()), count(|patch| patch.lag != NONE)];
    let patches = Patches { awake: awake as u64, woken: woken as u64, touched: touched as u64, lagged: lagged as u64 };
    let gusty = StandUniform::new(world, stand, plan, step).gusty != 0;
    let cell = if world.scene.budget.precision == Precision::Half { 8 } else { 16 };
    let bytes = Traffic::new(stand, &patches, gusty, cell, stand.stores_ground(&world.model.terrain));
    let (side, nodes) = (stand.cells / 8, (stand.cells / 2 + 3).div_ceil(8));
    if gusty {
        counted.add("rest_pass", [nodes, nodes, awake as u32], bytes.rest);
    }
    counted.add("wake_pass", [side, side, woken as u32], bytes.wake);
    counted.add("contact_pass", [side, side, touched as u32], bytes.contact);
    for _ in 0..stand.substeps {
        counted.add("wave_pass", [side, side, awake as u32], bytes.wave);
    }
    if stand.lag.segments > 1 {
        counted.add("lag_pass", [side, side, lagged as u32], bytes.lag);
    }
}

fn blades(counted: &mut Counted, world: &World, (stand, chain): (&StandModel, &ChainModel), plan: &StandPlan, cells: &Cells) {
    let (side, awake, each) = (chain.virtual_side / 8, plan.patches.len(), chain.blades_of_patch(stand.cells));
    counted.add("virtual_pass", [side, side, awake as u32], traffic::virtual_blades(chain, awake as u64));
    let with_room = plan.patches.iter().filter(|patch| patch.lag != NONE).count() as u32;
    if with_room > 0 {
        counted.add("busy_pass", [each.div_ceil(64), with_room, 1], traffic::looked_at(u64::from(with_room) * u64::from(each)));
        let busy = busy(world, (stand, chain), plan, cells);
        let (stand, invocations) = (counted.stand, 64 * busy.div_ceil(64));
        let bytes = traffic::held_blades(chain, busy);
        counted.passes.push(PassWork { pass: "blades_pass", stand, dispatches: 1, invocations, bytes });
    }
}

/// Blades that are held or that bodies are near: those that `busy_pass` lists.
fn busy(world: &World, (stand, chain): (&StandModel, &ChainModel), plan: &StandPlan, cells: &Cells) -> u64 {
    let segments = chain.coefficients.segments as usize;
    let mut busy = 0;
    for patch in plan.patches.iter().filter(|patch| patch.lag != NONE) {
        let obstacles = Obstacles { heads: &plan.solids.heads[patch.solids.clone()], planes: &plan.solids.planes };
        let stored = cells.roots.get(patch.lag as usize).filter(|roots| !roots.is_empty() && !patch.lag_woken && !patch.edited);
        let made: Box<[Root]>;
        let roots = match stored {
            Some(roots) => roots,
            None => {
                made = chain::roots(&world.model.terrain, stand, chain, patch.patch);
                &made
            }
        };
        let values = cells.lag.get(patch.lag as usize).filter(|_| !patch.lag_woken);
        let hold = |plane: usize, blade: usize| values.and_then(|values| values.get((6 * segments + plane) * roots.len() + blade));
        let idle = |blade: usize| !chain.all && [0, 1].iter().all(|plane| hold(*plane, blade).is_none_or(|hold| *hold <= 0.0));
        let is_busy = |(blade, root): &(usize, &Root)| root.length > 0.0 && (!idle(*blade) || obstacles.reach(root));
        busy += roots.iter().enumerate().filter(is_busy).count() as u64;
    }
    busy
}

fn billboards(counted: &mut Counted, world: &World, (index, model): (usize, &SpringsModel), plan: &StandPlan) {
    let all = sheets::entries(world, (index, model), plan);
    for some in all.chunks(MOST_AT_ONCE) {
        let near = some.iter().filter(|entry| entry.count > 0).count();
        let groups = |count: usize| [count.div_ceil(64) as u32, 1, u32::from(count > 0)];
        counted.add("sheet_touch_pass", groups(some.len()), traffic::touched_sheets(model, some.len() as u64));
        counted.add("sheet_resolve_pass", groups(near), traffic::resolved_sheets(model, near as u64));
    }
}

fn swings(counted: &mut Counted, (stand, oscillator): (&StandModel, &OscillatorModel), plan: &StandPlan, before: u64) {
    let now = (before as u32).wrapping_add(1);
    let all = plan.patches.len() as u32;
    let fading = plan.patches.iter().filter(|patch| patch.keep < 1.0 || is_census(now)).count() as u32;
    let count = Blocks::of(plan, stand.cells).blocks.len() as u32;
    let (texels, side) = (oscillator.coefficients.texels / 8, stand.cells / 8);
    if texels > 0 {
        let each = u64::from(oscillator.coefficients.texels) * u64::from(oscillator.coefficients.texels);
        counted.add("air_pass", [texels, texels, all], traffic::texels(u64::from(all) * each));
    }
    counted.add("fade_pass", [side, side, fading], traffic::records(u64::from(fading) * u64::from(side * side)));
    counted.add("touch_pass", [count.min(ROW), count.div_ceil(ROW), u32::from(count > 0)], traffic::records(u64::from(count)));
}

fn layers(counted: &mut Counted, model: &HarmonicModel, plan: &LayeredPlan) {
    let (groups, each) = (model.cells.div_ceil(8), TOUCH_SIDE / 8);
    counted.add("plane_pass", [groups, groups, 1], traffic::plane(u64::from(model.cells) * u64::from(model.cells)));
    counted.add("plant_pass", [each, each, plan.touched.len() as u32], traffic::plants(plan.touched.len() as u64));
}
