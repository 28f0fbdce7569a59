//! The step of a stand whose billboards are deformed: only those that have a sheet, each by itself.

use super::model::SpringsModel;
use super::pool::{load, store, words};
use super::pressed::felt;
use super::push::Maps;
use super::sheet::{Sheet, SheetRoot};
use super::step::{HeldSheet, step};
use super::wind::pose;
use crate::interaction::reaction::{Felt, Sums};
use crate::placement::{self, Growing};
use crate::plan::{ActiveSheet, StandPlan};
use crate::response::continuum::NODE_CELLS;
use crate::response::each::each;
use crate::response::{Stage, StandModel};
use crate::state::{Cells, PatchKey, Summary};
use crate::terrain::Terrain;
use crate::wind::{Phases, WindField, equilibrium};

/// The billboard of a cell: where it stands; `None` where none grows. `grown` is the patch's growth map, if it has one.
pub fn root_of(
    terrain: &Terrain,
    stand: &StandModel,
    model: &SpringsModel,
    grown: Option<&[Growing]>,
    patch: PatchKey,
    cell: u32,
) -> Option<SheetRoot> {
    let plant = placement::plant(&stand.placement, patch, [cell % stand.cells, cell / stand.cells])?;
    let plant = grown.and_then(|grown| grown.get(cell as usize)).map_or(Some(plant), |growth| placement::grown(plant, *growth))?;
    let anchor = terrain.anchor(patch.map(|along| f64::from(along) * stand.patch_side));
    let (height, slope) = terrain.height_and_gradient(anchor, plant.root);
    Some(model.root(&plant, height, slope))
}

/// How a billboard stands in the wind where nothing touches it.
pub fn target_of(model: &SpringsModel, root: &SheetRoot, wind: &WindField, phases: &Phases) -> Sheet {
    let end = |sign: f32| [root.at[0] + sign * root.half_width[0], root.at[2] + sign * root.half_width[1]];
    let bend = |sign: f32| equilibrium(wind.velocity_local(phases, end(sign)), model.wind);
    pose(&model.coefficients, root, [bend(-1.0), bend(1.0)])
}

/// A sheet after a step, and which of its bodies feels what.
type Moved = (HeldSheet, Option<(u32, Felt)>);

/// One step of all sheets: `texels` are of all maps. Returns what activation wants to know of each patch, and what each of `plan.sheets.heads` feels. `ended` hears
/// of the stage that has just ended.
pub fn step_stand(
    terrain: &Terrain,
    stand: &StandModel,
    model: &SpringsModel,
    plan: &StandPlan,
    texels: &[[f32; 4]],
    cells: &mut Cells,
    ended: &mut dyn FnMut(Stage),
) -> (Vec<(PatchKey, Summary)>, Vec<Sums>) {
    let co = &model.coefficients;
    let each_words = words(co);
    let places = plan.sheets.active.iter().map(|sheet| sheet.place as usize + 1).max().unwrap_or(0);
    if cells.sheets.len() < places * each_words {
        cells.sheets.resize(places * each_words, 0);
    }
    let (stored, grown) = (&cells.sheets, &cells.grown);
    let moved: Vec<Option<Moved>> = each(plan.sheets.active.iter().collect(), |sheet: &ActiveSheet| {
        let patch = &plan.patches[sheet.patch as usize];
        let root = root_of(terrain, stand, model, grown.get(&patch.patch).map(|map| &map[..]), patch.patch, sheet.cell)?;
        let phases = plan.wind.patch_phases(patch.patch, stand.cells / NODE_CELLS);
        let target = target_of(model, &root, &plan.wind, &phases);
        let mut held = match sheet.fresh {
            true => HeldSheet::new(&target),
            false => load(co, &root, &stored[sheet.place as usize * each_words..][..each_words]),
        };
        let maps = Maps { heads: &plan.sheets.heads[sheet.heads.start as usize..sheet.heads.end as usize], texels };
        let before = held.shown(co, &root, &target);
        step(co, &root, &maps, &target, sheet.heading, &mut held);
        let stiffness = stand.inertia * root.length * root.length * root.length * stand.species.continuum.kappa;
        let touched = held.steps == 0 && !maps.heads.is_empty();
        let felt = if touched { felt(co, &root, &maps, [&before, &held.stored, &target], &held.faces, stiffness) } else { None };
        held.steps = held.steps.saturating_add(sheet.hurry);
        Some((held, felt))
    });
    let mut sums = vec![Sums::default(); plan.sheets.heads.len()];
    for (sheet, held) in plan.sheets.active.iter().zip(moved) {
        if let Some((held, felt)) = held {
            felt.iter().for_each(|(head, felt)| sums[(sheet.heads.start + head) as usize].add(felt));
            store(co, &held, &mut cells.sheets[sheet.place as usize * each_words..][..each_words]);
        }
    }
    ended(Stage::Contact);
    (plan.patches.iter().map(|patch| (patch.patch, Summary::default())).collect(), sums)
}
