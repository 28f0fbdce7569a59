//! The compute pipelines and the buffers that live for one step.

use sward::plan::StandPlan;
use sward::response::StandModel;
use sward::scene::Precision;

use super::Work;
use super::air::AirTexels;
use super::blades::SUMMARY_WORDS;
use super::buffers::CellBuffers;
use super::entries::{AwakePatch, Entries, StandUniform};
use super::traffic::Traffic;
use crate::gpu::{Gpu, Program};
use crate::stopwatch::Stopwatch;

/// Files of the compute shader, after the libraries.
const PARTS: [&str; 6] = [
    sward::response::continuum::HALF_WGSL,
    super::CELLS_WGSL,
    include_str!("stand.wgsl"),
    sward::wind::TILED_SUM_WGSL,
    include_str!("step.wgsl"),
    include_str!("lags.wgsl"),
];

/// The full text of the compute shader.
pub fn assembled() -> String {
    let band = format!("const SUMMARY_BAND: u32 = {}u;\nconst SUMMARY_WORDS: u32 = {SUMMARY_WORDS}u;", sward::activation::BAND);
    let mut parts = vec![sward::math::WGSL.to_owned()];
    parts.push(sward::wind::WGSL.to_owned());
    parts.push(sward::interaction::WGSL.to_owned());
    parts.extend(sward::response::continuum::WGSL.iter().map(|part| (*part).to_owned()));
    parts.push(sward::interaction::reaction::SUMS_WGSL.to_owned());
    parts.push(band);
    parts.extend(PARTS.map(str::to_owned));
    parts.join("\n")
}

/// What is fixed when a pipeline is made.
#[derive(Clone, Copy)]
struct Switches {
    last_substep: bool,
    half: bool,
}

/// One pipeline and the bindings its entry point uses.
pub(super) struct Pass {
    label: &'static str,
    pipeline: wgpu::ComputePipeline,
    bindings: &'static [u32],
}

impl Pass {
    fn new(gpu: &Gpu, program: &Program, entry: &'static str, switches: Switches, bindings: &'static [u32]) -> Self {
        let switch = |on: bool| f64::from(u8::from(on));
        let constants = [("last_substep", switch(switches.last_substep)), ("half_precision", switch(switches.half))];
        Self { label: entry, pipeline: program.pipeline(gpu, None, entry, &constants), bindings }
    }

    /// One without switches.
    pub(super) fn plain(gpu: &Gpu, program: &Program, entry: &'static str, bindings: &'static [u32]) -> Self {
        Self { label: entry, pipeline: program.pipeline(gpu, None, entry, &[]), bindings }
    }

    pub(super) fn run(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        bound: &[(u32, &wgpu::Buffer)],
        groups: Groups<'_>,
        stopwatch: Option<&mut Stopwatch>,
    ) -> Work {
        if matches!(groups, Groups::Direct([_, _, 0])) {
            return Work::default();
        }
        let entries: Vec<wgpu::BindGroupEntry> = bound
            .iter()
            .filter(|(binding, _)| self.bindings.contains(binding))
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding: *binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.label),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(self.label),
            timestamp_writes: stopwatch.and_then(|stopwatch| stopwatch.compute(self.label)),
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        match groups {
            Groups::Direct([x, y, z]) => pass.dispatch_workgroups(x, y, z),
            Groups::Indirect(buffer) => pass.dispatch_workgroups_indirect(buffer, 0),
        }
        Work { dispatches: 1, invocations: groups.invocations(), ..Work::default() }
    }
}

/// Workgroups of a pass.
#[derive(Clone, Copy)]
pub(super) enum Groups<'a> {
    /// Known.
    Direct([u32; 3]),
    /// Counted by a pass before.
    Indirect(&'a wgpu::Buffer),
}

impl Groups<'_> {
    /// Those that are known.
    fn invocations(self) -> u64 {
        match self {
            Self::Direct(groups) => 64 * groups.map(u64::from).iter().product::<u64>(),
            Self::Indirect(_) => 0,
        }
    }
}

/// All passes of a step.
pub struct Passes {
    rest: Pass,
    wake: Pass,
    contact: Pass,
    wave: Pass,
    last_wave: Pass,
    lag: Pass,
    tile: wgpu::Buffer,
}

impl Passes {
    /// Reads the wind from other texels.
    pub fn heed(&mut self, air: &AirTexels) {
        self.tile = air.buffer.clone();
    }

    /// Builds the pipelines for cells of some precision; wind is read from `air`.
    pub fn new(gpu: &Gpu, air: &AirTexels, precision: &Precision) -> Self {
        let program = Program::new("step", assembled());
        let half = *precision == Precision::Half;
        let pass = |entry, bindings| Pass::new(gpu, &program, entry, Switches { last_substep: true, half }, bindings);
        let wave_bindings = &[0, 2, 3, 4, 5, 6, 7, 11];
        Self {
            rest: pass("rest_pass", &[0, 1, 2, 7, 8, 14]),
            wake: pass("wake_pass", &[0, 2, 3, 4, 7]),
            contact: pass("contact_pass", &[0, 2, 3, 5, 6, 7, 9, 10, 11]),
            wave: Pass::new(gpu, &program, "wave_pass", Switches { last_substep: false, half }, wave_bindings),
            last_wave: pass("wave_pass", wave_bindings),
            lag: pass("lag_pass", &[0, 2, 3, 12, 13]),
            tile: air.buffer.clone(),
        }
    }

    /// Records one step of a stand; `cells.now` is one step on when it has run.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        stand: &StandModel,
        entries: &Entries,
        step: &StepBuffers,
        cells: &mut CellBuffers,
        work: &mut Work,
        mut stopwatch: Option<&mut Stopwatch>,
    ) {
        let traffic = Traffic::new(stand, &entries.patches(), step.gusty, cells.cell_bytes(), cells.has_ground());
        work.traffic += traffic.rest + traffic.wake + traffic.contact + u64::from(stand.substeps) * traffic.wave;
        work.upper_traffic += traffic.lag;
        let side = stand.cells / 8;
        let nodes = (stand.cells / 2 + 3).div_ceil(8);
        let count = |list: &[AwakePatch]| list.len() as u32;
        let mut run = |pass: &Pass, patches: &wgpu::Buffer, cells: &CellBuffers, groups: [u32; 3]| {
            let bound = [
                (0, &step.stand),
                (1, &step.wind),
                (2, patches),
                (3, &cells.now),
                (4, &cells.old),
                (5, &cells.ground),
                (6, &step.held),
                (7, &cells.nodes),
                (8, &self.tile),
                (9, &step.contacts),
                (10, &step.words),
                (11, &step.summary),
                (12, &cells.upper),
                (13, &cells.past),
                (14, &step.tile_wind),
            ];
            work.add(&pass.run(gpu, encoder, &bound, Groups::Direct(groups), stopwatch.as_deref_mut()));
        };
        if step.gusty {
            run(&self.rest, &step.awake, cells, [nodes, nodes, count(&entries.awake)]);
        }
        run(&self.wake, &step.woken, cells, [side, side, count(&entries.woken)]);
        run(&self.contact, &step.touched, cells, [side, side, count(&entries.touched)]);
        for substep in 0..stand.substeps {
            let last = substep + 1 == stand.substeps;
            run(if last { &self.last_wave } else { &self.wave }, &step.awake, cells, [side, side, count(&entries.awake)]);
            cells.swap();
        }
        if stand.lag.segments > 1 {
            run(&self.lag, &step.lagged, cells, [side, side, count(&entries.lagged)]);
        }
    }
}

/// What one step hands to the GPU.
pub struct StepBuffers {
    stand: wgpu::Buffer,
    wind: wgpu::Buffer,
    tile_wind: wgpu::Buffer,
    awake: wgpu::Buffer,
    woken: wgpu::Buffer,
    touched: wgpu::Buffer,
    lagged: wgpu::Buffer,
    held: wgpu::Buffer,
    contacts: wgpu::Buffer,
    words: wgpu::Buffer,
    gusty: bool,
    /// [`SUMMARY_WORDS`] a patch, then the sums of what contacts feel.
    pub summary: wgpu::Buffer,
}

impl StepBuffers {
    /// Uploads a plan.
    pub fn new(gpu: &Gpu, stand: &StandModel, plan: &StandPlan, entries: &Entries, uniform: &StandUniform, work: &mut Work) -> Self {
        let mut filled = |label: &str, bytes: &[u8], usage: wgpu::BufferUsages| {
            work.uploaded += bytes.len() as u64;
            let padding = [0; 96];
            let contents = if bytes.is_empty() { &padding } else { bytes };
            gpu.filled(label, contents, usage)
        };
        let storage = wgpu::BufferUsages::STORAGE;
        let mut words: Vec<u8> = bytemuck::cast_slice(&plan.edges).to_vec();
        for pair in &plan.pairs {
            words.extend_from_slice(bytemuck::bytes_of(&[pair.contact as i32, pair.corner[0], pair.corner[1], 0]));
        }
        let empty = |label: &str, values: u64| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: values.max(4) * 4,
                usage: storage | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let area = u64::from(stand.cells) * u64::from(stand.cells);
        let intervals = stand.cells / sward::response::continuum::NODE_CELLS;
        let (wind, tile_wind) = (plan.wind.block(intervals), plan.tile_wind.block(intervals));
        Self {
            stand: filled("stand", bytemuck::bytes_of(uniform), wgpu::BufferUsages::UNIFORM),
            tile_wind: filled("tiled wind", bytemuck::bytes_of(&tile_wind), wgpu::BufferUsages::UNIFORM),
            wind: filled("wind", bytemuck::bytes_of(&wind), wgpu::BufferUsages::UNIFORM),
            awake: filled("awake patches", bytemuck::cast_slice(&entries.awake), storage),
            woken: filled("waking patches", bytemuck::cast_slice(&entries.woken), storage),
            touched: filled("touched patches", bytemuck::cast_slice(&entries.touched), storage),
            lagged: filled("patches with upper segments", bytemuck::cast_slice(&entries.lagged), storage),
            contacts: filled("contacts", bytemuck::cast_slice(&plan.contacts), storage),
            words: filled("edges and pairs", &words, storage),
            held: empty("held cells", entries.touched.len() as u64 * area),
            summary: empty("summaries", super::report_words(plan)),
            gusty: uniform.gusty != 0,
        }
    }
}
