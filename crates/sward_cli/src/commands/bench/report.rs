//! The figures: as a table, as JSON, as CSV.

use std::fmt::Write;

use serde::Serialize;
use sward::response::StandModel;
use sward::scene::Precision;
use sward::state::PatchKey;
use sward::world::World;
use sward_wgpu::gpu::Gpu;

use super::measure::{Interval, Ratio, Row};
use super::quoted;
use crate::backend::Backend;

/// Everything measured.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Report {
    pub(crate) sward: &'static str,
    pub(crate) scene: String,
    /// Where the simulation ran.
    pub(crate) on: String,
    pub(crate) drawn_on: String,
    /// How cells are stored there: `full` or `half`.
    pub(crate) precision: &'static str,
    pub(crate) system: String,
    /// Model name of the processor, where the system tells it.
    pub(crate) processor: Option<String>,
    /// Of the step and of the triad.
    pub(crate) threads: usize,
    pub(crate) adapter: Option<String>,
    pub(crate) driver: Option<String>,
    pub(crate) warm_up: u32,
    pub(crate) steps: u32,
    /// Pixels of the pictures.
    pub(crate) size: [u32; 2],
    /// Speed of memory, GB/s.
    #[serde(rename = "triad_gb_per_s")]
    pub(crate) triad: f64,
    pub(crate) stages: Vec<Row>,
    /// Whole steps, waited for, per cell; none where no cell was touched.
    pub(crate) ns_per_cell: Option<f64>,
    /// Passes by the device's own clock; none where it has no clock or was not used.
    pub(crate) device_stages: Vec<Row>,
    /// Time of a step at half precision over that at full, on the GPU.
    pub(crate) half_to_full: Option<Interval>,
    pub(crate) counters: Counters,
    pub(crate) memory: Memory,
    /// The response's cells at 48 bytes against the triad; on the CPU only.
    pub(crate) ratio: Option<Ratio>,
}

/// What was done in the timed steps: the same on every machine.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Counters {
    /// Updates of a patch.
    pub(crate) patch_steps: u64,
    /// Updates of a cell.
    pub(crate) cell_steps: u64,
    pub(crate) patches_woken: u64,
    pub(crate) cells_limited: u64,
    /// Of the GPU.
    pub(crate) dispatches: u64,
    pub(crate) invocations: u64,
    pub(crate) bytes_uploaded: u64,
    /// What the passes read and write at least, without upper segments.
    pub(crate) bytes_moved: u64,
    /// The same for upper segments.
    pub(crate) upper_bytes_moved: u64,
}

/// Bytes of the state as it stands.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Memory {
    pub(crate) patches_awake: u64,
    pub(crate) cells_awake: u64,
    /// β and ω at two times.
    pub(crate) state: u64,
    /// What the GPU's buffers have room for, of that.
    pub(crate) state_allocated: u64,
    /// Slopes and heights under them.
    pub(crate) ground: u64,
    /// Upper segments near cameras.
    pub(crate) upper_segments: u64,
    /// Plants in those patches; they take no memory.
    pub(crate) plants: u64,
}

/// Cells awake.
pub(crate) fn cells(world: &World) -> u64 {
    let stands = world.model.stands.iter().zip(&world.state.stands);
    stands.map(|(model, state)| state.awake.len() as u64 * u64::from(model.cells) * u64::from(model.cells)).sum()
}

/// How the cells that step are stored. The CPU's are whole, whatever the scene says.
pub(crate) fn precision(world: &World, backend: &Backend<'_>) -> &'static str {
    match (backend, &world.scene.budget.precision) {
        (Backend::Gpu(..), Precision::Half) => "half",
        _ => "full",
    }
}

/// Model name of the processor, as Linux tells it.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let (_, name) = text.lines().find(|line| line.starts_with("model name"))?.split_once(':')?;
    Some(name.trim().to_owned())
}

impl Counters {
    /// Since the start.
    pub(crate) fn of(world: &World, backend: &Backend<'_>) -> Self {
        let mut counters = Self::default();
        for (model, state) in world.model.stands.iter().zip(&world.state.stands) {
            counters.patch_steps += state.counters.patch_steps;
            counters.cell_steps += state.counters.patch_steps * u64::from(model.cells) * u64::from(model.cells);
            counters.patches_woken += state.counters.woken;
            counters.cells_limited += state.counters.clamped;
        }
        if let Backend::Gpu(_, step) = backend {
            let work = step.work;
            (counters.dispatches, counters.invocations) = (work.dispatches, work.invocations);
            (counters.bytes_uploaded, counters.bytes_moved) = (work.uploaded, work.traffic);
            counters.upper_bytes_moved = work.upper_traffic;
        }
        counters
    }

    /// Since another moment.
    pub(crate) fn since(&self, before: &Self) -> Self {
        Self {
            patch_steps: self.patch_steps - before.patch_steps,
            cell_steps: self.cell_steps - before.cell_steps,
            patches_woken: self.patches_woken - before.patches_woken,
            cells_limited: self.cells_limited - before.cells_limited,
            dispatches: self.dispatches - before.dispatches,
            invocations: self.invocations - before.invocations,
            bytes_uploaded: self.bytes_uploaded - before.bytes_uploaded,
            bytes_moved: self.bytes_moved - before.bytes_moved,
            upper_bytes_moved: self.upper_bytes_moved - before.upper_bytes_moved,
        }
    }
}

/// Plants of a patch: those of its growth map, or the share of its cells that carry one.
fn plants(world: &World, stand: &StandModel, patch: PatchKey) -> u64 {
    match stand.growth_map(&world.model.terrain, patch) {
        Some(map) => map.iter().filter(|growth| growth.share > 0).count() as u64,
        None => (f64::from(stand.cells) * f64::from(stand.cells) * f64::from(stand.placement.cover)) as u64,
    }
}

impl Memory {
    /// Of the awake patches.
    pub(crate) fn of(world: &World, backend: &Backend<'_>) -> Self {
        let mut memory = Self::default();
        for (index, (model, state)) in world.model.stands.iter().zip(&world.state.stands).enumerate() {
            let on_gpu = if let Backend::Gpu(_, step) = backend { step.cells(index) } else { None };
            memory.state_allocated += on_gpu.map_or(0, |cells| cells.state_bytes());
            let area = u64::from(model.cells) * u64::from(model.cells);
            let patches = state.awake.len() as u64;
            let lagged = state.awake.values().filter(|awake| awake.lag != sward::state::NONE).count() as u64;
            memory.patches_awake += patches;
            memory.cells_awake += patches * area;
            memory.state += patches * area * on_gpu.map_or(32, |cells| 2 * cells.cell_bytes());
            memory.ground += if model.is_level(&world.model.terrain) { 0 } else { patches * area * 12 };
            memory.upper_segments += lagged * area * 8 * u64::from(model.lag.segments.saturating_sub(1));
            memory.plants += state.awake.keys().map(|patch| plants(world, model, *patch)).sum::<u64>();
        }
        memory
    }
}

impl Report {
    /// What is known of the machine.
    pub(crate) fn of_machine(gpu: Option<&Gpu>) -> Self {
        Self {
            sward: env!("CARGO_PKG_VERSION"),
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            processor: processor(),
            threads: rayon::current_num_threads(),
            adapter: gpu.map(|gpu| gpu.adapter_info.name.clone()),
            driver: gpu.map(|gpu| gpu.adapter_info.driver_info.clone()),
            ..Self::default()
        }
    }

    /// For a reader.
    pub(crate) fn table(&self) -> String {
        let mut text = String::new();
        let [width, height] = self.size;
        // Writing to a string cannot fail.
        let Self { scene, steps, on, precision, drawn_on, system, threads, triad, .. } = self;
        let _ = writeln!(text, "{scene}: {steps} steps on {on} at {precision} precision, pictures of {width}x{height} on {drawn_on}");
        let processor = self.processor.as_ref().map_or_else(String::new, |name| format!("{name}, "));
        let _ = writeln!(text, "{processor}{system}, {threads} threads, memory {triad:.1} GB/s (triad)\n");
        let _ = writeln!(text, "{:32} {:>10} {:>10} {:>8}", "stage", "p50 ms", "p95 ms", "samples");
        for row in &self.stages {
            let _ = writeln!(text, "{:32} {:10.3} {:10.3} {:8}", row.stage, row.p50_ms, row.p95_ms, row.samples);
        }
        if self.adapter.is_some() && self.device_stages.is_empty() {
            let _ = writeln!(text, "\nThe graphics adapter was not used, or has no clock: nothing is known of its passes.");
        } else if !self.device_stages.is_empty() {
            let _ = writeln!(text, "\n{:32} {:>10} {:>10} {:>8}", "pass, by the device's clock", "p50 ms", "p95 ms", "samples");
        }
        for row in &self.device_stages {
            let _ = writeln!(text, "{:32} {:10.3} {:10.3} {:8}", row.stage, row.p50_ms, row.p95_ms, row.samples);
        }
        let (counters, memory) = (&self.counters, &self.memory);
        let _ = writeln!(text, "\n{} patches awake, {} cells, {} plants", memory.patches_awake, memory.cells_awake, memory.plants);
        let _ = writeln!(
            text,
            "{:.1} MB of state, {:.1} MB of ground, {:.1} MB of upper segments",
            memory.state as f64 / 1e6,
            memory.ground as f64 / 1e6,
            memory.upper_segments as f64 / 1e6
        );
        let _ = writeln!(
            text,
            "{} patch steps, {} cell steps, {} patches woken",
            counters.patch_steps, counters.cell_steps, counters.patches_woken
        );
        if counters.dispatches > 0 {
            let _ = writeln!(
                text,
                "{} dispatches, {} invocations, {:.1} MB uploaded, {:.1} bytes moved a cell and step at least, {:.1} more by upper segments",
                counters.dispatches,
                counters.invocations,
                counters.bytes_uploaded as f64 / 1e6,
                counters.bytes_moved as f64 / counters.cell_steps.max(1) as f64,
                counters.upper_bytes_moved as f64 / counters.cell_steps.max(1) as f64
            );
        }
        if let Some(nanoseconds) = self.ns_per_cell {
            let _ = writeln!(text, "a step takes {nanoseconds:.1} ns a cell");
        }
        if let Some(Interval { median, low, high, pairs }) = self.half_to_full {
            let _ = writeln!(text, "a step at half precision takes {median:.2} of one at full ({low:.2} to {high:.2}, {pairs} pairs)");
        }
        if let Some(ratio) = self.ratio.filter(|ratio| ratio.step_gb_per_s > 0.0) {
            let _ = writeln!(
                text,
                "response: {:.1} M cells/s; at 48 bytes a cell {:.2} of the triad ({:.2} to {:.2}, {} pairs)",
                ratio.step_gb_per_s * 1e3 / 48.0,
                ratio.median,
                ratio.low,
                ratio.high,
                ratio.pairs
            );
        }
        text
    }

    /// For a spreadsheet.
    pub(crate) fn csv(&self) -> String {
        let mut text = String::from("scene,on,stage,p50_ms,p95_ms,samples\n");
        for row in self.stages.iter().chain(&self.device_stages) {
            let [scene, on, stage] = [&self.scene, &self.on, row.stage].map(quoted);
            let _ = writeln!(text, "{scene},{on},{stage},{:.6},{:.6},{}", row.p50_ms, row.p95_ms, row.samples);
        }
        text
    }
}
