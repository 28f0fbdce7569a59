//! `sward compare`: the same scene on the CPU and on the GPU, side by side.

use std::collections::BTreeSet;

use sward::response::springs::{SpringsModel, pool};
use sward::scene::Precision;
use sward::state::NONE;
use sward::world::World;
use sward_wgpu::compare::{Deviation, Tolerance};
use sward_wgpu::gpu::Gpu;

use crate::arguments;
use crate::arguments::Caching;
use crate::backend::Backend;
use crate::cache::Cache;
use crate::commands::reference;
use crate::console::Console;
use crate::failure::Failure;
use crate::progress::Progress;
use crate::scenes;

/// Looks at the state this often, evenly spread over the run.
const CHECKPOINTS: u32 = 4;

/// Agreement of bends, rad. Rounding differs from backend to backend; a cell that a border of a footprint just misses may not.
const BEND: Tolerance = Tolerance { p999: 2e-5, rms: 2e-5, outlier: 0.01, share: 1e-4 };
/// Agreement of upper segments, rad. They switch between bending and recovering, where rounding may decide.
const UPPER: Tolerance = Tolerance { p999: 1e-3, rms: 5e-3, outlier: 0.05, share: 5e-4 };
/// Agreement of bending velocities, rad/s.
const RATE: Tolerance = Tolerance { p999: 2e-4, rms: 2e-4, outlier: 0.1, share: 1e-4 };

/// What counts as agreement.
struct Agreement {
    bend: Tolerance,
    upper: Tolerance,
    rate: Tolerance,
    /// Patches that may be awake in one run only, or otherwise, as a share of those awake.
    patches: f64,
}

/// Of two runs at full precision.
const FULL: Agreement = Agreement { bend: BEND, upper: UPPER, rate: RATE, patches: 0.0 };
/// Of half precision with full. Rounding moves the moment a patch comes to rest by some steps.
const HALF: Agreement = Agreement {
    bend: Tolerance { p999: 1e-3, rms: 1.5e-4, outlier: 0.02, share: 1e-4 },
    upper: Tolerance { p999: 1e-2, rms: 5e-3, outlier: 0.1, share: 5e-4 },
    rate: Tolerance { p999: 0.1, rms: 2e-2, outlier: 1.0, share: 1e-4 },
    patches: 0.1,
};

/// One line of the table.
struct Row {
    step: u64,
    stand: String,
    stage: &'static str,
    unit: &'static str,
    /// `None` for activation, which agrees or does not.
    deviation: Option<Deviation>,
    note: String,
    agrees: bool,
}

/// Runs both and prints the table.
pub(crate) fn run(arguments: &arguments::Compare, console: &Console) -> Result<(), Failure> {
    let Some(scene) = &arguments.scene else { return reference::run(console) };
    let opened = scenes::open(scene)?;
    let mut cpu = opened.world(&Cache::new(&Caching::default()), console)?;
    let mut other = opened.world(&Cache::new(&Caching::default()), console)?;
    if let Some(precision) = arguments.precision {
        other.scene.budget.precision = precision.into();
    }
    let half = other.scene.budget.precision == Precision::Half;
    let agreement = if half { &HALF } else { &FULL };
    let gpu = Gpu::new()?;
    let mut backend = Backend::on_gpu(&gpu, &other)?;
    let mut progress = Progress::new(u64::from(arguments.steps), "steps", console);
    let mut rows = Vec::new();
    let every = arguments.steps.div_ceil(CHECKPOINTS);
    for step in 1..=arguments.steps {
        cpu.step();
        backend.step(&mut other)?;
        if step % every == 0 || step == arguments.steps {
            backend.fetch(&mut other)?;
            rows.extend(compared(&cpu, &other, agreement));
        }
        progress.advance();
    }
    drop(progress);
    let precision = if half { " at half precision" } else { "" };
    console.answer(&format!("{}: the CPU against {}{precision}\n\n{}", opened.name, backend.name(), table(&rows, agreement)))?;
    verdict(&rows)
}

fn verdict(rows: &[Row]) -> Result<(), Failure> {
    let wrong = rows.iter().filter(|row| !row.agrees).count();
    if wrong == 0 && rows.iter().all(|row| row.deviation.is_none()) {
        let help = "run more --steps, or a scene in which something moves";
        return Err(Failure::failed("no cell was awake at any checkpoint, so nothing was compared").help(help));
    }
    if wrong > 0 {
        return Err(Failure::failed(format!("{wrong} of {} rows are over the tolerance", rows.len())));
    }
    Ok(())
}

/// All stages of all stands at one checkpoint.
fn compared(cpu: &World, gpu: &World, agreement: &Agreement) -> Vec<Row> {
    let mut rows = Vec::new();
    for (index, model) in cpu.model.stands.iter().enumerate() {
        let (a, b) = (&cpu.state.stands[index], &gpu.state.stands[index]);
        let row = |stage, unit, deviation: Deviation, tolerance: &Tolerance| Row {
            step: cpu.state.step,
            stand: model.name.clone(),
            stage,
            unit,
            agrees: deviation.within(tolerance),
            deviation: Some(deviation),
            note: String::new(),
        };
        rows.push(activation(cpu, gpu, index, agreement.patches));
        let both: Vec<_> = a.awake.iter().filter_map(|(patch, cells)| Some((cells, b.awake.get(patch)?))).collect();
        let half = 2 * (model.cells * model.cells) as usize;
        let cells = |world: &World, slot: u32, upper_half: bool| -> Vec<f32> {
            if let Some(chain) = &model.chain {
                // Of virtual blades: ψ or ω of each segment.
                let states = world.state.stands[index].cells.virtual_states.get(slot as usize);
                let area = 2 * (chain.virtual_side * chain.virtual_side) as usize;
                let parts = states.map_or(&[][..], |states| states).chunks_exact(area).skip(usize::from(upper_half)).step_by(2);
                return parts.flatten().copied().collect();
            }
            if let Some(springs) = &model.springs {
                // Of deformed billboards: vertices, the same list whatever the slot; they have no rate.
                let first = both.first().is_some_and(|(a, b)| a.slot == slot || b.slot == slot);
                return if upper_half || !first { Vec::new() } else { vertices(world, index, springs) };
            }
            let cells = world.state.stands[index].cells.now.get(slot as usize);
            // The last plane of plants that swing by themselves counts steps.
            let end = if model.oscillator.is_some() { half + half / 2 } else { 2 * half };
            let range = if upper_half { half..end } else { 0..half };
            cells.and_then(|cells| cells.get(range)).unwrap_or_default().to_vec()
        };
        for (stage, unit, upper_half, tolerance) in [("bend", "rad", false, agreement.bend), ("rate", "rad/s", true, agreement.rate)] {
            let gather = |world: &World, first: bool| -> Vec<f32> {
                both.iter().flat_map(|(a, b)| cells(world, if first { a.slot } else { b.slot }, upper_half)).collect()
            };
            if !both.is_empty() {
                rows.push(row(stage, unit, Deviation::of(&gather(cpu, true), &gather(gpu, false), tolerance.outlier), &tolerance));
            }
        }
        let upper = |world: &World, first: bool| -> Vec<f32> {
            let with_lag = both.iter().filter(|(a, b)| a.lag != NONE && b.lag != NONE);
            let lag = &world.state.stands[index].cells.lag;
            with_lag
                .flat_map(|(a, b)| lag.get((if first { a.lag } else { b.lag }) as usize).map_or(&[][..], |upper| upper))
                .copied()
                .collect()
        };
        if both.iter().any(|(a, b)| a.lag != NONE && b.lag != NONE) {
            let tolerance = &agreement.upper;
            let stage = if model.chain.is_some() { "blades" } else { "upper segments" };
            rows.push(row(stage, "rad", Deviation::of(&upper(cpu, true), &upper(gpu, false), tolerance.outlier), tolerance));
        }
    }
    rows
}

/// Vertices of all deformed billboards of a stand, m.
fn vertices(world: &World, stand: usize, springs: &SpringsModel) -> Vec<f32> {
    let (state, words) = (&world.state.stands[stand], pool::words(&springs.coefficients));
    let (columns, rows) = springs.coefficients.sides();
    let sheet = |place: u32| state.cells.sheets.get(place as usize * words..).unwrap_or_default();
    let taken = state.sheets.pool.taken();
    taken.flat_map(|(_, place)| sheet(place).iter().take(3 * columns * (rows - 1)).map(|word| f32::from_bits(*word))).collect()
}

/// The same patches must be awake, and for the same reasons: it is decided in whole numbers. `most` may not, as a share.
fn activation(cpu: &World, gpu: &World, stand: usize, most: f64) -> Row {
    let awake = |world: &World| -> BTreeSet<_> {
        world.state.stands[stand].awake.iter().map(|(patch, awake)| (*patch, awake.fading, awake.lag != NONE)).collect()
    };
    let (a, b) = (awake(cpu), awake(gpu));
    let differing = a.symmetric_difference(&b).map(|(patch, ..)| *patch).collect::<BTreeSet<_>>().len();
    Row {
        step: cpu.state.step,
        stand: cpu.model.stands[stand].name.clone(),
        stage: "activation",
        unit: "",
        deviation: None,
        note: format!("{} patches awake, {differing} differ", a.len()),
        agrees: differing as f64 <= (most * a.len() as f64).ceil(),
    }
}

fn table(rows: &[Row], agreement: &Agreement) -> String {
    let heading = ["step", "stand", "stage", "values", "p99.9", "rms", "max", "outliers", "unit"];
    let [step, stand, stage, values, p999, rms, max, outliers, unit] = heading;
    let mut text = format!("{step:>6} {stand:<12} {stage:<15} {values:>9} {p999:>9} {rms:>9} {max:>9} {outliers:>9} {unit:<6}\n");
    for row in rows {
        let (step, stand, stage, unit) = (row.step, &row.stand, row.stage, row.unit);
        let numbers = match &row.deviation {
            Some(Deviation { count, p999, rms, max, outliers }) => {
                format!("{count:>9} {p999:>9.2e} {rms:>9.2e} {max:>9.2e} {outliers:>9} {unit:<6}")
            }
            None => format!("{:<57}", row.note),
        };
        let mark = if row.agrees { "" } else { "  over the tolerance" };
        text += &format!("{step:>6} {stand:<12} {stage:<15} {numbers}{mark}\n");
    }
    for (stage, unit, tolerance) in
        [("bend", "rad", agreement.bend), ("rate", "rad/s", agreement.rate), ("upper segments", "rad", agreement.upper)]
    {
        let Tolerance { p999, rms, outlier, share } = tolerance;
        text += &format!(
            "\nTolerance, {stage}: p99.9 {p999} and rms {rms} {unit}, at most {share} of the values off by more than {outlier} {unit}"
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use sward::model::NoAssets;
    use sward::scene::Scene;

    fn world() -> World {
        let text = "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 16)],
            interactors: [(shape: Sphere(radius: 1), path: Circle(radius: 3, speed: 4))])";
        let mut world = World::new(Scene::parse(text, "test.ron").unwrap(), &NoAssets).unwrap();
        (0..30).for_each(|_| world.step());
        world
    }

    #[test]
    fn a_world_agrees_with_itself() {
        let world = world();
        let rows = compared(&world, &world, &FULL);
        assert_eq!(rows.len(), 4);
        assert!(rows.iter().all(|row| row.agrees && row.deviation.is_none_or(|deviation| deviation.count > 0)));
        assert!(verdict(&rows).is_ok());
    }

    #[test]
    fn a_wrong_value_in_each_stage_is_found() {
        let right = world();
        type Spoil = fn(&mut World);
        let spoils: [(&str, Spoil); 4] = [
            ("activation", |world| world.state.stands[0].awake.retain(|patch, _| *patch != [0, 0])),
            ("bend", |world| world.state.stands[0].cells.now.iter_mut().for_each(|cells| cells[40] += 1.0)),
            ("rate", |world| world.state.stands[0].cells.now.iter_mut().for_each(|cells| cells[600] = f32::NAN)),
            ("upper segments", |world| world.state.stands[0].cells.lag.iter_mut().for_each(|upper| upper[3] += 1.0)),
        ];
        for (stage, spoil) in spoils {
            let mut wrong = right.clone();
            spoil(&mut wrong);
            let rows = compared(&right, &wrong, &FULL);
            let over: Vec<_> = rows.iter().filter(|row| !row.agrees).map(|row| row.stage).collect();
            assert_eq!(over, [stage]);
            assert!(verdict(&rows).is_err());
        }
    }

    #[test]
    fn cells_that_were_not_copied_back_are_found() {
        let right = world();
        let mut wrong = right.clone();
        wrong.state.stands[0].cells.now.clear();
        assert!(verdict(&compared(&right, &wrong, &FULL)).is_err());
    }

    #[test]
    fn comparing_nothing_is_no_success() {
        assert!(verdict(&[]).is_err());
        let text = "(version: 1, stands: [(species: Meadow)])";
        let world = World::new(Scene::parse(text, "test.ron").unwrap(), &NoAssets).unwrap();
        assert!(verdict(&compared(&world, &world, &FULL)).is_err());
    }
}
