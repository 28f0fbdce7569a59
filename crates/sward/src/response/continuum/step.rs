//! One step of a stand on the CPU. Patches are independent of each other, so threads do not change the result.

use super::coefficients::{Coefficients, safe_limit};
use super::lag::{LagCoefficients, cascade, from_history, look_up_offset};
use super::patch::{Scratch, Wave, step_patch, wake_patch};
use super::resistance::Resistance;
use super::rest::Rest;
use super::touch::{PatchContacts, Touched, touch_patch};
use crate::growth::{BARE, WHOLE};
use crate::interaction::reaction::Sums;
use crate::lanes::{Lanes, Simd, Work};
use crate::plan::{PatchPlan, StandPlan};
use crate::response::each::{each, each_with};
use crate::response::{Stage, StandModel};
use crate::state::{Cells, Ground, NONE, PatchKey, Summary, TILE};
use crate::terrain::Terrain;
use crate::{math, placement};

/// One awake patch at work.
struct Task<'a> {
    plan: &'a PatchPlan,
    rest: Rest,
    /// Cells that bodies hold, in order.
    held: Vec<u32>,
}

/// Pairs each task with the two time levels of its slot.
fn with_levels<'a, 'b>(
    tasks: &'a mut [Task<'b>],
    cells: &'a mut Cells,
) -> Vec<(&'a mut Task<'b>, &'a mut [f32], &'a mut [f32], &'a mut Ground)> {
    let mut order: Vec<&mut Task> = tasks.iter_mut().collect();
    order.sort_by_key(|task| task.plan.slot);
    let mut order = order.into_iter().peekable();
    let levels = cells.now.iter_mut().zip(&mut cells.old).zip(&mut cells.ground).enumerate();
    let mut paired = Vec::new();
    for (slot, ((now, old), ground)) in levels {
        if order.peek().is_some_and(|task| task.plan.slot as usize == slot)
            && let Some(task) = order.next()
        {
            paired.push((task, &mut now[..], &mut old[..], ground));
        }
    }
    paired
}

/// The ground under the cells of a patch: the numbers every backend uses for limits and contact. Where nothing grows it lies far below; where plants are
/// cut it lies lower by what they lack, so that bodies pass over them as high as they do.
pub fn ground_of(terrain: &Terrain, stand: &StandModel, patch: PatchKey) -> Ground {
    let mut ground = shape_of(terrain, stand, patch);
    let bare = if patch == TILE { None } else { stand.growth.bare(stand.cells, terrain, patch, stand.patch_side) };
    if let Some(bare) = bare {
        let area = bare.len();
        ground.values = ground.planes(area).into();
        for (height, _) in ground.values[2 * area..].iter_mut().zip(&bare).filter(|(_, bare)| **bare) {
            *height = BARE;
        }
    }
    if let Some(shares) = stand.growth.tended.map(patch).filter(|_| patch != TILE) {
        let area = shares.len();
        ground.values = ground.planes(area).into();
        let usual = stand.coefficients.plant_height;
        for (index, (height, share)) in
            ground.values[2 * area..].iter_mut().zip(shares).enumerate().filter(|(_, (_, share))| **share < WHOLE)
        {
            let cell = [index as u32 % stand.cells, index as u32 / stand.cells];
            let whole = placement::plant(&stand.placement, patch, cell).map_or(usual, |plant| plant.height);
            *height -= math::upper(usual - whole * (f32::from(*share) / 255.0), 0.0);
        }
    }
    ground
}

/// The same without regard to what grows there.
pub(crate) fn shape_of(terrain: &Terrain, stand: &StandModel, patch: PatchKey) -> Ground {
    if patch == TILE || terrain.is_flat() {
        let anchor = terrain.anchor(patch.map(|p| f64::from(p) * stand.patch_side));
        return Ground { level: terrain.height(anchor, [0.0, 0.0]), ..Ground::default() };
    }
    let cells = stand.cells as usize;
    let area = cells * cells;
    let mut values = vec![0.0; 3 * area].into_boxed_slice();
    let mut steepest = 0.0_f32;
    for cell in 0..area {
        // Each cell by its own number in the field: so the same cell of another patch size has the same ground, to the bit.
        let within = [cell % cells, cell / cells];
        let centre = [0, 1].map(|axis| ((i64::from(patch[axis]) * cells as i64 + within[axis] as i64) as f64 + 0.5) * stand.spacing);
        let (height, [x, z]) = terrain.height_and_gradient(terrain.anchor(centre), [0.0; 2]);
        (values[cell], values[area + cell], values[2 * area + cell]) = (x, z, height);
        let steep = (x * x + z * z).sqrt();
        steepest = if steep > steepest { steep } else { steepest };
    }
    Ground { values, steepest, ..Ground::default() }
}

/// Contact of one patch.
struct TouchWork<'a> {
    stand: &'a StandModel,
    by: PatchContacts<'a>,
    ground: &'a Ground,
    rest: &'a Rest,
    now: &'a mut [f32],
    touched: &'a mut Touched,
}

impl Work for TouchWork<'_> {
    type Output = Vec<u32>;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> Vec<u32> {
        touch_patch(&self.stand.coefficients, self.stand.cells as usize, &self.by, self.ground, self.rest, self.now, self.touched)
    }
}

/// Makes room for the slots a plan names.
fn reserve(cells: &mut Cells, plan: &StandPlan, area: usize) {
    let empty = || vec![0.0; 4 * area].into_boxed_slice();
    for patch in &plan.patches {
        while cells.now.len() <= patch.slot as usize {
            cells.now.push(empty());
            cells.old.push(empty());
            cells.ground.push(Ground::default());
        }
    }
}

/// The wave of one patch.
struct PatchWork<'a> {
    co: &'a Coefficients,
    side: usize,
    wave: &'a Wave<'a>,
    old: &'a mut [f32],
    scratch: &'a mut Scratch,
}

impl Work for PatchWork<'_> {
    type Output = Summary;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Summary {
        step_patch(simd, self.co, self.side, self.wave, self.old, self.scratch)
    }
}

/// The cascade of one patch.
struct CascadeWork<'a> {
    lag: &'a LagCoefficients,
    bend: [&'a [f32]; 2],
    upper: &'a mut [f32],
}

impl Work for CascadeWork<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        cascade(self.lag, self.bend, self.upper);
    }
}

/// rest → contact → wave and limits of one stand; returns what activation wants to know of each patch, and what is felt under each contact. `cells.now` is one step on
/// afterwards. `ended` hears of each stage that has just ended.
pub fn step(
    terrain: &Terrain,
    stand: &StandModel,
    plan: &StandPlan,
    cells: &mut Cells,
    lanes: Lanes,
    ended: &mut dyn FnMut(Stage),
) -> (Vec<(PatchKey, Summary)>, Vec<Sums>) {
    let side = stand.cells as usize;
    reserve(cells, plan, side * side);
    let mut tasks = rest(stand, plan);
    ended(Stage::Rest);
    let resistance = Resistance { inertia: stand.cell_inertia(), kappa: stand.species.continuum.kappa };
    let felt = each_with(with_levels(&mut tasks, cells), Touched::default, |touched, (task, now, old, ground)| {
        if task.plan.woken {
            wake_patch(side, &task.rest, now, old);
        }
        if task.plan.woken || task.plan.edited {
            *ground = ground_of(terrain, stand, task.plan.patch);
        }
        if task.plan.pairs.is_empty() {
            return (0..0, Vec::new());
        }
        let pairs = &plan.pairs[task.plan.pairs.clone()];
        let by = PatchContacts { pairs, contacts: &plan.contacts, edges: &plan.edges, resistance };
        task.held = lanes.run(TouchWork { stand, by, ground, rest: &task.rest, now, touched });
        (task.plan.pairs.clone(), std::mem::take(&mut touched.felt))
    });
    let mut sums = vec![Sums::default(); plan.contacts.len()];
    for (pairs, felt) in felt {
        plan.pairs[pairs].iter().zip(&felt).for_each(|(pair, felt)| sums[pair.contact as usize].merge(felt));
    }
    ended(Stage::Contact);
    let mut summaries = Vec::new();
    for substep in 0..stand.substeps {
        summaries = wave(stand, &tasks, cells, lanes, substep + 1 == stand.substeps);
        std::mem::swap(&mut cells.now, &mut cells.old);
    }
    ended(Stage::Wave);
    (summaries, sums)
}

/// Where plants would rest in the wind of this step, patch by patch.
fn rest<'a>(stand: &StandModel, plan: &'a StandPlan) -> Vec<Task<'a>> {
    let k_w = stand.species.continuum.wind;
    each(plan.patches.iter().collect(), |patch| Task {
        plan: patch,
        rest: Rest::of(if patch.patch == TILE { &plan.tile_wind } else { &plan.wind }, patch.patch, stand.cells, k_w),
        held: Vec::new(),
    })
}

/// One substep of all patches; `cells.old` receives the future.
fn wave(stand: &StandModel, tasks: &[Task], cells: &mut Cells, lanes: Lanes, last: bool) -> Vec<(PatchKey, Summary)> {
    let (now, ground) = (&cells.now, &cells.ground);
    let mut olds: Vec<Option<&mut Box<[f32]>>> = cells.old.iter_mut().map(Some).collect();
    let work: Vec<(&Task, &mut Box<[f32]>)> =
        tasks.iter().filter_map(|task| olds[task.plan.slot as usize].take().map(|old| (task, old))).collect();
    each_with(work, Scratch::default, |scratch, (task, old)| {
        let slot = task.plan.slot as usize;
        let wave = Wave {
            now: &now[slot],
            neighbours: [0, 1, 2, 3].map(|side| task.plan.neighbour(side).map(|slot| &now[slot][..])),
            rest: &task.rest,
            ground: &ground[slot],
            safe_limit: safe_limit(ground[slot].steepest),
            held: &task.held,
            keep: if last { task.plan.keep } else { 1.0 },
        };
        let summary = lanes.run(PatchWork { co: &stand.coefficients, side: stand.cells as usize, wave: &wave, old, scratch });
        (task.plan.patch, summary)
    })
}

/// The upper segments and the past of one lag slot.
type Lagging<'a> = (&'a mut Box<[f32]>, &'a mut Box<[f32]>);

/// Planes of upper segments, and of the past that `history` keeps, in one lag slot.
pub fn lag_planes(lag: &LagCoefficients) -> [usize; 2] {
    let upper = 2 * (lag.segments.max(1) as usize - 1);
    [upper, if lag.kind == 1 && upper > 0 { 2 * lag.ring as usize } else { 0 }]
}

/// Upper segments of the patches that keep them, after [`step`]. `index` counts steps, for the ring of `history`.
pub fn lags(stand: &StandModel, plan: &StandPlan, cells: &mut Cells, index: u64, lanes: Lanes) {
    let lag = &stand.lag;
    if lag.segments < 2 {
        return;
    }
    let area = (stand.cells * stand.cells) as usize;
    let [upper, ring] = lag_planes(lag).map(|planes| planes * area);
    for patch in plan.patches.iter().filter(|patch| patch.lag != NONE) {
        while cells.lag.len() <= patch.lag as usize {
            cells.lag.push(vec![0.0; upper].into_boxed_slice());
            cells.history.push(vec![0.0; ring].into_boxed_slice());
        }
    }
    let now = &cells.now;
    let mut slots: Vec<Option<Lagging>> = cells.lag.iter_mut().zip(&mut cells.history).map(Some).collect();
    let work: Vec<_> = plan
        .patches
        .iter()
        .filter(|patch| patch.lag != NONE)
        .filter_map(|patch| slots[patch.lag as usize].take().map(|(upper, history)| (patch, upper, history)))
        .collect();
    each(work, |(patch, upper, history)| {
        let bend = [&now[patch.slot as usize][..area], &now[patch.slot as usize][area..2 * area]];
        if patch.lag_woken {
            upper.chunks_exact_mut(area).enumerate().for_each(|(plane, out)| out.copy_from_slice(bend[plane % 2]));
            history.chunks_exact_mut(area).enumerate().for_each(|(plane, out)| out.copy_from_slice(bend[plane % 2]));
        }
        match lag.kind {
            0 => lanes.run(CascadeWork { lag, bend, upper }),
            1 => remember(stand, bend, upper, history, index),
            _ => look_up(stand, patch, now, upper),
        }
    });
}

fn remember(stand: &StandModel, bend: [&[f32]; 2], upper: &mut [f32], history: &mut [f32], index: u64) {
    let (area, ring) = (bend[0].len(), u64::from(stand.lag.ring));
    let frame = |back: u64| ((index + ring - back % ring) % ring) as usize * 2 * area;
    history[frame(0)..][..area].copy_from_slice(bend[0]);
    history[frame(0) + area..][..area].copy_from_slice(bend[1]);
    for segment in 1..stand.lag.segments {
        let plane = (segment as usize - 1) * 2 * area;
        for cell in 0..area {
            let past = |back: u32| [history[frame(u64::from(back)) + cell], history[frame(u64::from(back)) + area + cell]];
            [upper[plane + cell], upper[plane + area + cell]] = from_history(&stand.lag, segment, past);
        }
    }
}

/// β of a cell that may lie in a neighbour; beyond awake neighbours the patch's own border stands in.
fn bend_at(patch: &PatchPlan, now: &[Box<[f32]>], side: i32, i: i32, j: i32) -> [f32; 2] {
    let step = |k: i32| if k < 0 { -1 } else { i32::from(k >= side) };
    let (dx, dz) = (step(i), step(j));
    let neighbour = match (dx, dz) {
        (-1, 0) => patch.neighbour(0),
        (1, 0) => patch.neighbour(1),
        (0, -1) => patch.neighbour(2),
        (0, 1) => patch.neighbour(3),
        _ => None,
    };
    let (slot, i, j) = match neighbour {
        Some(slot) => (slot, i - dx * side, j - dz * side),
        None => (patch.slot as usize, i, j),
    };
    let cell = (j.clamp(0, side - 1) * side + i.clamp(0, side - 1)) as usize;
    [now[slot][cell], now[slot][(side * side) as usize + cell]]
}

fn look_up(stand: &StandModel, patch: &PatchPlan, now: &[Box<[f32]>], upper: &mut [f32]) {
    let (side, area) = (stand.cells as i32, (stand.cells * stand.cells) as usize);
    let cells = &now[patch.slot as usize];
    for cell in 0..area {
        let [bend, rate] = [0, 2].map(|plane| [cells[plane * area + cell], cells[(plane + 1) * area + cell]]);
        let speed = stand.coefficients.wave_speed(rate[0] * rate[0] + rate[1] * rate[1]);
        for segment in 1..stand.lag.segments {
            let offset = look_up_offset(&stand.lag, segment, bend, rate, speed).map(|metres| metres / stand.spacing as f32);
            let at = [cell as i32 % side, cell as i32 / side];
            let whole = offset.map(|cells| cells.floor());
            let [fx, fz] = [offset[0] - whole[0], offset[1] - whole[1]];
            let corner = |dx: i32, dz: i32| bend_at(patch, now, side, at[0] + whole[0] as i32 + dx, at[1] + whole[1] as i32 + dz);
            let (a, b, c, d) = (corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1));
            for axis in 0..2 {
                let (low, high) = (a[axis] + (b[axis] - a[axis]) * fx, c[axis] + (d[axis] - c[axis]) * fx);
                upper[((segment as usize - 1) * 2 + axis) * area + cell] = low + (high - low) * fz;
            }
        }
    }
}
