//! `sward bench`: what a scene costs on this machine, stage by stage.

mod device;
mod measure;
mod papers;
mod project;
mod recovery;
mod report;

use std::io::Write;
use std::path::Path;
use std::time::Instant;

use serde::Serialize;
use sward::response::StandModel;
use sward::world::World;
use sward_wgpu::gpu::Gpu;

use crate::arguments::{self, Machine, Where};
use crate::artist::{self, Artist};
use crate::backend::Backend;
use crate::cache::Cache;
use crate::console::Console;
use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;
use crate::scenes;
use measure::{Stages, Triad, ratio};
use report::{Counters, Memory, Report};

/// Pairs of a step and a triad, in ABBA order.
const PAIRS: usize = 24;
/// Pictures drawn.
const PICTURES: u32 = 5;

/// Measures what was asked for.
pub(crate) fn run(arguments: &arguments::Bench, console: &Console) -> Result<(), Failure> {
    match (&arguments.scene, arguments.papers) {
        (Some(scene), _) if arguments.project => project::run(scene, arguments, console),
        (Some(scene), _) => run_scene(scene, arguments, console),
        (None, Some(paper)) => papers::run(paper, arguments, console),
        (None, None) => recovery::run(arguments, console),
    }
}

/// Measures a scene.
fn run_scene(scene: &str, arguments: &arguments::Bench, console: &Console) -> Result<(), Failure> {
    let opened = scenes::open(scene)?;
    if let Some(folder) = &arguments.output {
        output::folder(folder, false)?;
    }
    let on = if arguments.on == Some(Machine::Gpu) { Where::Gpu } else { Where::Cpu };
    let mut world = opened.world(&Cache::new(&arguments.caching), console)?;
    if let Some(precision) = arguments.precision {
        world.scene.budget.precision = precision.into();
    }
    let gpu = artist::adapter_by(Gpu::with_clock, arguments.draw, on, console)?;
    let mut artist = Artist::choose(arguments.draw, gpu.as_ref(), &world, arguments.size, (&Cache::new(&arguments.caching), console))?;
    let mut backend = Backend::choose(on, gpu.as_ref(), &world)?;
    if let Some(folder) = &arguments.output {
        output::make_folder(folder)?;
    }
    let mut progress = Progress::new(length(arguments, &backend, &artist), "steps, pictures and pairs", console);
    for _ in 0..arguments.warm_up {
        backend.step(&mut world)?;
        progress.advance();
    }
    let before = Counters::of(&world, &backend);
    let mut stages = Stages::default();
    let begun = Instant::now();
    for _ in 0..arguments.steps {
        step(&mut world, &mut backend, &mut stages)?;
        progress.advance();
    }
    let stepped = begun.elapsed();
    let counters = Counters::of(&world, &backend).since(&before);
    for _ in 0..PICTURES {
        stages.time("picture", || artist.draw(&mut world, &mut backend, 0.0, arguments.size))?;
        progress.advance();
    }
    let mut by_device = Stages::default();
    device::time_steps(&mut world, &mut backend, arguments.steps, &mut by_device, &mut progress)?;
    device::time_pictures(&mut world, &mut backend, &mut artist, (PICTURES, arguments.size), &mut by_device, &mut progress)?;
    let half_to_full = device::half_to_full(&mut world, &mut backend, &mut progress)?;
    let mut triad = Triad::new();
    let mut measured = Vec::new();
    // Blades, and plants that swing by themselves, have no cells of which every one is read.
    if on == Where::Cpu && world.model.stands.iter().all(|stand| stand.chain.is_none() && stand.settle().is_none()) {
        for pair in 0..PAIRS {
            measured.push(pair_of(&mut world, &mut triad, pair % 2 == 0));
            progress.advance();
        }
    }
    drop(progress);
    let report = Report {
        scene: opened.name.clone(),
        on: backend.name().to_owned(),
        precision: report::precision(&world, &backend),
        drawn_on: artist.name().to_owned(),
        steps: arguments.steps,
        warm_up: arguments.warm_up,
        size: arguments.size,
        triad: triad.speed(),
        stages: stages.rows(),
        counters,
        memory: Memory::of(&world, &backend),
        device_stages: by_device.rows(),
        ns_per_cell: (counters.cell_steps > 0).then(|| 1e9 * stepped.as_secs_f64() / counters.cell_steps as f64),
        half_to_full,
        ratio: ratio(&measured),
        ..Report::of_machine(gpu.as_ref())
    };
    // First: what was measured is told even where it cannot be written.
    console.answer(&report.table())?;
    arguments.output.as_ref().map_or(Ok(()), |folder| write_figures(folder, "bench", &report, &report.csv()))
}

/// All that is waited for: on the CPU pairs of step and triad, on a GPU what its own clock tells and pairs of precisions.
fn length(arguments: &arguments::Bench, backend: &Backend<'_>, artist: &Artist<'_>) -> u64 {
    let again = if matches!(backend, Backend::Gpu(..)) { arguments.steps } else { 0 };
    let pictures = if matches!(artist, Artist::Gpu(..)) { 2 * PICTURES } else { PICTURES };
    [arguments.warm_up, arguments.steps, again, pictures].map(u64::from).iter().sum::<u64>() + PAIRS as u64
}

/// One step, stage by stage where they can be told apart.
fn step(world: &mut World, backend: &mut Backend<'_>, stages: &mut Stages) -> Result<(), Failure> {
    if !matches!(backend, Backend::Cpu) {
        // Handing a step over is not doing it.
        return stages.time("step", || backend.step(world).and_then(|()| backend.wait(world)));
    }
    let plan = stages.time("plan: bodies, wind, activation", || world.plan());
    // Of all stands together.
    let names = ["rest", "contact", "wave", "upper segments", "virtual blades", "blades with a state", "waves of meshes", "air that flows"];
    let is_there = |kind: fn(&StandModel) -> bool| world.model.stands.iter().any(kind);
    let by_blade = is_there(|stand| stand.chain.is_some());
    let swinging = is_there(|stand| stand.oscillator.is_some());
    let deformed = is_there(|stand| stand.springs.is_some());
    let nothing = world.model.stands.is_empty() && world.model.layered.is_empty();
    let continuum = is_there(|stand| stand.chain.is_none() && stand.settle().is_none()) || nothing;
    let felt = continuum || swinging;
    let [meshes, flows] = [!world.model.layered.is_empty(), !world.model.fluids.is_empty()];
    let shown = [felt, felt || deformed, continuum, continuum, by_blade, by_blade, meshes, flows];
    let (mut spent, mut begun) = ([0.0; 8], Instant::now());
    let reports = world.respond_in_stages(&plan, &mut |stage| {
        spent[stage as usize] += 1e3 * begun.elapsed().as_secs_f64();
        begun = Instant::now();
    });
    for ((name, has), milliseconds) in names.into_iter().zip(shown).zip(spent) {
        if has {
            stages.add(name, milliseconds);
        }
    }
    stages.time("file reports", || world.finish(reports));
    Ok(())
}

/// Bytes a second of two steps' responses and of two triads, in ABBA or BAAB order.
fn pair_of(world: &mut World, triad: &mut Triad, step_first: bool) -> [f64; 2] {
    let mut response = || {
        let plan = world.plan();
        let bytes = 48.0 * report::cells(world) as f64;
        let (seconds, reports) = measure::seconds(|| world.respond(&plan));
        world.finish(reports);
        bytes / seconds
    };
    let mut bare = || triad.run();
    let [a, b, c, d] = if step_first { [response(), bare(), bare(), response()] } else { [bare(), response(), response(), bare()] };
    if step_first { [0.5 * (a + d), 0.5 * (b + c)] } else { [0.5 * (b + c), 0.5 * (a + d)] }
}

/// Writes figures as NAME.json and NAME.csv.
fn write_figures(folder: &Path, name: &str, figures: &impl Serialize, csv: &str) -> Result<(), Failure> {
    let json = serde_json::to_string_pretty(figures).map_err(|error| Failure::failed(format!("cannot write the figures: {error}")))?;
    output::write_whole(&folder.join(format!("{name}.json")), |writer| writeln!(writer, "{json}"))?;
    output::write_whole(&folder.join(format!("{name}.csv")), |writer| writer.write_all(csv.as_bytes()))
}

/// A field of a CSV file.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}
