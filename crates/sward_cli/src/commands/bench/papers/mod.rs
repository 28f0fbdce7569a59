//! `sward bench --papers`: the scenes of the papers, with their sizes, counts and resolutions, and their printed figures beside ours.

mod billboards;
mod continuum;
mod film;
mod grassland;
mod instigator;
mod layers;
mod table;

use serde::Serialize;
use sward_wgpu::gpu::Gpu;

use super::write_figures;
use crate::arguments::{self, Paper, Where};
use crate::artist;
use crate::cache::Cache;
use crate::console::Console;
use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;
use film::Machine;
use table::Table;

/// Pairs of frames behind a ratio, on hardware and where a frame takes seconds.
const PAIRS: [u32; 2] = [24, 4];

/// All tables.
#[derive(Debug, Serialize)]
struct Report {
    sward: &'static str,
    adapter: Option<String>,
    driver: Option<String>,
    system: String,
    /// Share of the papers' counts and pixels.
    scale: f64,
    pairs: u32,
    tables: Vec<Table>,
}

/// Runs the papers' scenes.
pub(crate) fn run(paper: Paper, arguments: &arguments::Bench, console: &Console) -> Result<(), Failure> {
    if let Some(folder) = &arguments.output {
        output::folder(folder, false)?;
    }
    let on = match arguments.on {
        None => Where::Auto,
        Some(arguments::Machine::Cpu) => Where::Cpu,
        Some(arguments::Machine::Gpu) => Where::Gpu,
    };
    let gpu = if paper == Paper::Instigator { None } else { artist::adapter(arguments.draw, on, console)? };
    if let Some(folder) = &arguments.output {
        output::make_folder(folder)?;
    }
    let hardware = gpu.as_ref().is_some_and(|gpu| gpu.adapter_info.device_type != wgpu::DeviceType::Cpu);
    let pairs = arguments.pairs.unwrap_or(if hardware { PAIRS[0] } else { PAIRS[1] });
    let (cache, scale) = (Cache::new(&arguments.caching), arguments.scale.unwrap_or(1.0));
    let machine = Machine { gpu: gpu.as_ref(), on, draw: arguments.draw, cache: &cache, console, pairs, scale };
    let mut tables = Vec::new();
    for paper in all(paper) {
        let table = one(paper, &machine)?;
        // Each as soon as it is there: the next may take minutes.
        let begin = if tables.is_empty() { "" } else { "\n" };
        console.answer(&format!("{begin}{}", table.text()))?;
        tables.push(table);
    }
    if scale < 1.0 {
        console.answer(&format!("\nAt {scale} of the papers' counts and pixels: not to be compared."))?;
    }
    let report = Report {
        sward: env!("CARGO_PKG_VERSION"),
        adapter: gpu.as_ref().map(|gpu| gpu.adapter_info.name.clone()),
        driver: gpu.as_ref().map(|gpu: &Gpu| gpu.adapter_info.driver_info.clone()),
        system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        scale,
        pairs,
        tables,
    };
    let csv = report.tables.iter().map(Table::csv).fold(table::CSV_HEAD.to_owned(), |all, one| all + &one);
    arguments.output.as_ref().map_or(Ok(()), |folder| write_figures(folder, "papers", &report, &csv))
}

/// The papers that were asked for.
fn all(paper: Paper) -> Vec<Paper> {
    match paper {
        Paper::All => vec![Paper::Continuum, Paper::Grassland, Paper::Billboards, Paper::Layers, Paper::Instigator],
        one => vec![one],
    }
}

/// Runs one of them. How many frames that is, its scene decides; about so many are expected.
fn one(paper: Paper, machine: &Machine<'_>) -> Result<Table, Failure> {
    let pairs = u64::from(machine.pairs);
    let frames = match paper {
        Paper::Continuum => 6 * pairs,
        Paper::Grassland => 8 * pairs,
        Paper::Billboards => 4 * pairs + 1,
        Paper::Layers => 8 * pairs + 8 * pairs.min(2),
        Paper::All | Paper::Instigator => 0,
    };
    let mut bar = Progress::new(frames, "frames", machine.console);
    let mut progress = || bar.advance();
    match paper {
        Paper::Continuum => continuum::run(machine, &mut progress),
        Paper::Grassland => grassland::run(machine, &mut progress),
        Paper::Billboards => billboards::run(machine, &mut progress),
        Paper::Layers => layers::run(machine, &mut progress),
        Paper::All | Paper::Instigator => Ok(instigator::run()),
    }
}
