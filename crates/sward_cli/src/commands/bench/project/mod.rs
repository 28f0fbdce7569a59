//! `sward bench SCENE --project`: what the stages of a step would take on GPUs that are not here, worked out from what is counted.
//!
//! The formula and what it leaves out are in docs/projection.md.

mod devices;
mod operations;

use std::fmt::Write;

use serde::Serialize;
use sward::scene::Precision;
use sward::world::World;
use sward_wgpu::compute::counted;

use super::{quoted, write_figures};
use crate::arguments;
use crate::cache::Cache;
use crate::console::Console;
use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;
use crate::scenes;
use devices::{DEVICES, Device};

/// What a device takes to drain one pass and begin the next, s. No maker publishes it: an assumption, of the size that is usually seen.
const DISPATCH: f64 = 5e-6;
/// Clocks from one operation to the next that needs its result: what a GPU hides where it has so many invocations a lane.
const LATENCY: f64 = 4.0;

/// What limits a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Limit {
    /// Bytes through memory.
    Bytes,
    /// Operations of all invocations.
    Operations,
    /// Operations of one invocation, where there are too few to fill the device.
    Latency,
    /// Passes that are handed over.
    Dispatches,
}

/// What a stage does in an average step, and the least it takes on each device.
#[derive(Debug, Default, Serialize)]
struct Row {
    pass: &'static str,
    dispatches: f64,
    invocations: f64,
    bytes: f64,
    /// Of an invocation.
    operations: f64,
    /// ms on each device.
    milliseconds: [f64; DEVICES.len()],
    /// What takes longest on each.
    limits: [Option<Limit>; DEVICES.len()],
}

/// A scene's projection.
#[derive(Debug, Serialize)]
struct Report {
    sward: &'static str,
    scene: String,
    /// So that nobody takes it for figures that were measured.
    what: &'static str,
    warm_up: u32,
    steps: u32,
    precision: &'static str,
    devices: [Device; DEVICES.len()],
    dispatch_us: f64,
    stages: Vec<Row>,
    total_ms: [f64; DEVICES.len()],
}

/// Seconds of a stage: the longest of bytes, operations and latency, and what its dispatches cost besides.
fn seconds(device: &Device, row: &Row) -> (f64, Limit) {
    let alone = row.operations * LATENCY / device.clock();
    let ways = [
        (row.bytes / device.bandwidth(), Limit::Bytes),
        (row.invocations * row.operations / device.rate(), Limit::Operations),
        (row.dispatches * alone, Limit::Latency),
    ];
    let (work, limit) = ways.into_iter().fold((0.0, Limit::Dispatches), |most, way| if way.0 > most.0 { way } else { most });
    let dispatches = row.dispatches * DISPATCH;
    (work + dispatches, if dispatches > work { Limit::Dispatches } else { limit })
}

impl Row {
    fn project(&mut self) {
        for (at, device) in DEVICES.iter().enumerate() {
            let (seconds, limit) = seconds(device, self);
            (self.milliseconds[at], self.limits[at]) = (1e3 * seconds, Some(limit));
        }
    }
}

/// Steps a world on the CPU and counts what a GPU would do.
fn count(world: &mut World, (warm_up, steps): (u32, u32), progress: &mut Progress) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for number in 0..warm_up + steps {
        let plan = world.plan();
        for pass in if number >= warm_up { counted::passes(world, &plan) } else { Vec::new() } {
            let at = rows.iter().position(|row| row.pass == pass.pass).unwrap_or_else(|| {
                rows.push(Row { pass: pass.pass, ..Row::default() });
                rows.len() - 1
            });
            let share = |count: u64| count as f64 / f64::from(steps);
            rows[at].dispatches += share(pass.dispatches);
            rows[at].invocations += share(pass.invocations);
            rows[at].bytes += share(pass.bytes);
        }
        let reports = world.respond(&plan);
        world.finish(reports);
        progress.advance();
    }
    rows
}

/// Operations of an invocation of each stage, and what it takes.
fn weigh(rows: &mut [Row]) -> Result<(), Failure> {
    for row in rows {
        let known = operations::of(row.pass);
        row.operations = known.ok_or_else(|| Failure::failed(format!("nobody knows how many operations {} takes", row.pass)))?;
        row.project();
    }
    Ok(())
}

/// Counts what a scene does and projects it.
pub(crate) fn run(scene: &str, arguments: &arguments::Bench, console: &Console) -> Result<(), Failure> {
    let opened = scenes::open(scene)?;
    if let Some(folder) = &arguments.output {
        output::folder(folder, false)?;
    }
    let mut world = opened.world(&Cache::new(&arguments.caching), console)?;
    if let Some(precision) = arguments.precision {
        world.scene.budget.precision = precision.into();
    }
    if let Some(folder) = &arguments.output {
        output::make_folder(folder)?;
    }
    let (warm_up, steps) = (arguments.warm_up, arguments.steps);
    let mut progress = Progress::new(u64::from(warm_up) + u64::from(steps), "steps", console);
    let mut stages = count(&mut world, (warm_up, steps), &mut progress);
    drop(progress);
    weigh(&mut stages)?;
    let total_ms = [0, 1, 2].map(|device: usize| stages.iter().map(|row| row.milliseconds[device]).sum());
    let report = Report {
        sward: env!("CARGO_PKG_VERSION"),
        scene: opened.name.clone(),
        what: "projection, not a measurement",
        warm_up,
        steps,
        precision: if world.scene.budget.precision == Precision::Half { "half" } else { "full" },
        devices: DEVICES,
        dispatch_us: 1e6 * DISPATCH,
        stages,
        total_ms,
    };
    console.answer(&report.table())?;
    arguments.output.as_ref().map_or(Ok(()), |folder| write_figures(folder, "projection", &report, &report.csv()))
}

impl Report {
    /// For a reader.
    fn table(&self) -> String {
        let Self { scene, steps, warm_up, precision, dispatch_us, .. } = self;
        let mut text = format!(
            "PROJECTION, not a measurement: a step of {scene} at {precision} precision, counted over {steps} steps after {warm_up}, and the least it\n\
             would take by max(bytes / bandwidth, invocations × ops / rate, {LATENCY} ops / clock) + dispatches × {dispatch_us} µs (docs/projection.md).\n\n"
        );
        // Writing to a string cannot fail.
        for device in &self.devices {
            let (rate, bandwidth) = (device.rate() / 1e12, device.bandwidth_gb_per_s);
            let _ = writeln!(text, "{:36} {rate:6.2} T operations/s, {bandwidth:5.1} GB/s", device.name);
        }
        let _ = write!(text, "\n{:20} {:>10} {:>11} {:>10} {:>6}", "stage, in a step", "dispatches", "invocations", "kB", "ops");
        self.devices.iter().for_each(|device| write!(text, " {:>14}", device.short).unwrap_or_default());
        let _ = writeln!(text);
        for row in &self.stages {
            let [dispatches, invocations, kilobytes] = [row.dispatches, row.invocations, row.bytes / 1e3];
            let _ = write!(text, "{:20} {dispatches:10.2} {invocations:11.0} {kilobytes:10.1} {:6.0}", row.pass, row.operations);
            for (milliseconds, limit) in row.milliseconds.iter().zip(row.limits) {
                let letter = match limit {
                    Some(Limit::Bytes) => 'b',
                    Some(Limit::Operations) => 'o',
                    Some(Limit::Latency) => 'l',
                    _ => 'd',
                };
                let _ = write!(text, " {milliseconds:9.4} ms {letter}");
            }
            let _ = writeln!(text);
        }
        let _ = write!(text, "{:61}", "all stages");
        self.total_ms.iter().for_each(|total| write!(text, " {total:9.4} ms  ").unwrap_or_default());
        let _ = writeln!(
            text,
            "\n\nWhat takes longest: b bytes, o operations, l those of one invocation where there are few, d dispatches. Planning on the CPU and\n\
             pictures are not in it."
        );
        text
    }

    /// For a spreadsheet.
    fn csv(&self) -> String {
        let mut text = String::from("scene,stage,dispatches,invocations,bytes,operations,device,milliseconds\n");
        for row in &self.stages {
            for (device, milliseconds) in self.devices.iter().zip(row.milliseconds) {
                let [scene, stage, device] = [&self.scene, row.pass, device.name].map(quoted);
                let Row { dispatches, invocations, bytes, operations, .. } = row;
                let _ = writeln!(text, "{scene},{stage},{dispatches},{invocations},{bytes},{operations},{device},{milliseconds:.6}");
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn device() -> Device {
        Device { name: "a device", short: "it", lanes: 1000.0, clock_ghz: 1.0, bandwidth_gb_per_s: 100.0 }
    }

    fn row(invocations: f64, bytes: f64, operations: f64) -> Row {
        Row { dispatches: 1.0, invocations, bytes, operations, ..Row::default() }
    }

    #[test]
    fn what_takes_longest_counts_and_dispatches_besides() {
        let took = |row: &Row| seconds(&device(), row);
        let near = |(found, limit): (f64, Limit), expected: f64, by: Limit| (found / expected - 1.0).abs() < 1e-9 && limit == by;
        // 10 MB at 100 GB/s; 10^8 operations at 10^12 a second; 10^5 of them one after the other, 4 ns each.
        assert!(near(took(&row(1e5, 1e7, 100.0)), 1e-4 + DISPATCH, Limit::Bytes));
        assert!(near(took(&row(1e6, 1e6, 100.0)), 1e-4 + DISPATCH, Limit::Operations));
        assert!(near(took(&row(10.0, 1e3, 1e5)), 4e-4 + DISPATCH, Limit::Latency));
        assert!(near(took(&row(64.0, 64.0, 1.0)), DISPATCH + 4e-9, Limit::Dispatches));
        // Control: no more bytes, but at half the bandwidth.
        let slow = Device { bandwidth_gb_per_s: 50.0, ..device() };
        assert!(near(seconds(&slow, &row(1e5, 1e7, 100.0)), 2e-4 + DISPATCH, Limit::Bytes));
    }

    /// The worked example is what the formula gives, with the numbers the page says.
    #[test]
    fn the_example_in_the_documents_is_right() {
        let text = include_str!("../../../../../../docs/projection.md");
        let mut example = row(172_800.0, 8_733_000.0, operations::of("wave_pass").expect("known"));
        example.project();
        for (device, milliseconds) in DEVICES.iter().zip(example.milliseconds) {
            let [lanes, clock, bandwidth] = [device.lanes, device.clock_ghz, device.bandwidth_gb_per_s];
            let lines: Vec<&str> = text.lines().filter(|line| line.starts_with(&format!("| {} |", device.name))).collect();
            let says = |start: &str, end: &str| lines.iter().any(|line| line.contains(start) && line.ends_with(end));
            assert!(says(&format!("| {lanes} | {clock} GHz |"), &format!(" {bandwidth} GB/s |")), "{device:?}: {lines:?}");
            assert!(says("", &format!(" {milliseconds:.3} ms |")), "{milliseconds:.3} ms: {lines:?}");
            assert!(!says("", &format!(" {:.3} ms |", 1.1 * milliseconds)), "control");
        }
    }
}
