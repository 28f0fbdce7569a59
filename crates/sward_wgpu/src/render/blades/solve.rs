//! The passes that solve blades, and the buffers they fill.

use std::sync::OnceLock;

use sward::picture::blade_plan::{BLADES_PER_INSTANCE, BladePlan, BladeUniform, GROUP, LEVELS};
use sward::picture::prepare::PrepareUniform;
use sward::response::continuum::NODE_CELLS;
use sward::scene::Precision;
use sward::wind::WindField;

use crate::compute::CELLS_WGSL;
use crate::compute::air::AirTexels;
use crate::compute::buffers::CellBuffers;
use crate::gpu::{Gpu, Program};
use crate::render::prepare::{Bending, Shared};
use crate::stopwatch::Stopwatch;

/// The passes: finding blades, solving them, and solving them once more as they were in the picture before.
const ENTRIES: [&str; 3] = ["blades_find", "blades_solve", "blades_then"];
const FIND: usize = 0;
const SOLVE: usize = 1;
const THEN: usize = 2;
/// Most workgroups along an axis of a dispatch.
const MOST_GROUPS: u32 = 65535;

/// The full text of the shader that solves blades.
pub(super) fn assembled(bending: Bending) -> String {
    let constants = super::constants();
    let before = [
        sward::math::WGSL,
        sward::wind::WGSL,
        sward::terrain::WGSL,
        sward::placement::WGSL,
        sward::geometry::billboard::WGSL,
        sward::geometry::blade::WGSL,
        sward::response::continuum::HALF_WGSL,
        CELLS_WGSL,
        &constants,
    ];
    [&before[..], &bending.parts(), &[include_str!("solve.wgsl"), include_str!("passes.wgsl")]].concat().join("\n")
}

/// The text of the shader that makes draw arguments.
pub(super) fn finish() -> String {
    [&super::constants(), include_str!("finish.wgsl")].join("\n")
}

/// Blades of one stand, kept from picture to picture.
#[derive(Default)]
pub struct BladeBuffers {
    /// Records, numbers found (per number of pieces, and those there was no room for), draw arguments; none before the first picture.
    pub filled: Option<[wgpu::Buffer; 3]>,
    /// What the last picture decided.
    pub numbers: Option<BladeUniform>,
}

impl BladeBuffers {
    fn reserve(&mut self, gpu: &Gpu, numbers: &BladeUniform) {
        let bytes = u64::from(numbers.records()).max(16) * 16;
        self.numbers = Some(*numbers);
        if self.filled.as_ref().is_some_and(|[records, ..]| records.size() >= bytes) {
            return;
        }
        let make = |label: &str, size: u64, usage: wgpu::BufferUsages| {
            let usage = usage | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
            gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        // Some room to spare, so that a moving camera does not ask for a new one every time.
        let bytes = (bytes + bytes / 4).min(gpu.device.limits().max_storage_buffer_binding_size).max(bytes);
        self.filled = Some([
            make("blades", bytes, wgpu::BufferUsages::empty()),
            make("blades found", 16, wgpu::BufferUsages::COPY_DST),
            make("blades to draw", 64, wgpu::BufferUsages::INDIRECT),
        ]);
    }
}

/// The pipelines.
pub struct SolvePass {
    /// Of each [`Bending`]. Made when first asked for, as are the pipelines.
    programs: [OnceLock<Program>; 4],
    /// Of all passes that solve, likewise.
    layouts: [(wgpu::BindGroupLayout, wgpu::PipelineLayout); 2],
    /// Each of [`ENTRIES`], of a continuum at full and at half precision, then of each other [`Bending`].
    solve: [[OnceLock<wgpu::ComputePipeline>; 3]; 5],
    finish: wgpu::ComputePipeline,
}

/// What one stand's blades are solved from.
pub struct Solving<'a> {
    /// Bends.
    pub prepare: PrepareUniform,
    /// The wind on the stand's nodes.
    pub wind: &'a WindField,
    /// What it is read from.
    pub air: &'a AirTexels,
    /// Its cells.
    pub cells: &'a CellBuffers,
    /// Where it grows.
    pub growth: &'a wgpu::TextureView,
}

impl SolvePass {
    /// Builds the pipelines.
    pub fn new(gpu: &Gpu) -> Self {
        let finish = Program::new("blades, counted", finish()).pipeline(gpu, None, "blades_finish", &[]);
        let layouts = [12, 13].map(|bindings| {
            let layout = solving_layout(gpu, bindings);
            let pipelines = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("blades"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            (layout, pipelines)
        });
        Self { programs: Default::default(), layouts, solve: Default::default(), finish }
    }

    /// Solves what a picture shows of a stand.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        shared: &Shared,
        of: &Solving<'_>,
        plan: &BladePlan,
        buffers: &mut BladeBuffers,
        stopwatch: Option<&mut Stopwatch>,
    ) {
        buffers.reserve(gpu, &plan.uniform);
        let Some([records, found, arguments]) = &buffers.filled else { return };
        encoder.clear_buffer(found, 0, None);
        let rooms: u32 = plan.uniform.rooms[..LEVELS].iter().sum();
        let mut stopwatch = stopwatch;
        for (entry, workgroups) in [(FIND, plan.workgroups), (SOLVE, rooms.div_ceil(GROUP))] {
            if plan.workgroups > 0 {
                let timing = stopwatch.as_mut().and_then(|stopwatch| stopwatch.compute(ENTRIES[entry]));
                self.dispatch(gpu, encoder, shared, of, (plan, entry, workgroups), [records, found], timing);
            }
        }
        let pieces = [0, 1, 2].map(|level: usize| plan.uniform.pieces[level]);
        let [near, middle, far] = pieces.map(|pieces| 3 * (2 * pieces - 1) * BLADES_PER_INSTANCE);
        let [a, b, c, _] = plan.uniform.rooms;
        let counts = gpu.filled("blades", bytemuck::cast_slice(&[a, b, c, 0, near, middle, far, 0]), wgpu::BufferUsages::UNIFORM);
        let group = group(gpu, &self.finish.get_bind_group_layout(0), &[(0, found), (1, arguments), (2, &counts)], None);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("blades, counted"), timestamp_writes: None });
        pass.set_pipeline(&self.finish);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(1, 1, 1);
    }

    /// Solves the blades of the picture once more, as they were in the one before: `then` is its plan of [`sward::picture::past::Past::blades`].
    pub fn record_past(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        shared: &Shared,
        of: &Solving<'_>,
        then: &BladePlan,
        buffers: &BladeBuffers,
    ) {
        let Some([records, found, _]) = &buffers.filled else { return };
        let rooms: u32 = then.uniform.rooms[..LEVELS].iter().sum();
        if rooms > 0 && !then.draws.is_empty() {
            self.dispatch(gpu, encoder, shared, of, (then, THEN, rooms.div_ceil(GROUP)), [records, found], None);
        }
    }

    fn dispatch(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        shared: &Shared,
        of: &Solving<'_>,
        (plan, which, workgroups): (&BladePlan, usize, u32),
        [records, found]: [&wgpu::Buffer; 2],
        timing: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let half = usize::from(of.cells.precision == Precision::Half);
        let bending = Bending::of_cells(of.cells);
        let (layout, pipelines) = &self.layouts[usize::from(of.cells.numbers.is_some())];
        // Continuum at full and at half precision, then the others.
        let kind = if bending == Bending::Continuum { half } else { 1 + bending as usize };
        let make = || {
            let program = self.programs[bending as usize].get_or_init(|| Program::new("blades", assembled(bending)));
            program.pipeline(gpu, Some(pipelines), ENTRIES[which], &[("half_precision", half as f64)])
        };
        let pipeline = self.solve[kind][which].get_or_init(make);
        let wind = of.wind.block(of.prepare.placement.cells / NODE_CELLS);
        let prepare = gpu.filled("prepare", bytemuck::bytes_of(&of.prepare), wgpu::BufferUsages::UNIFORM);
        let wind = gpu.filled("wind", bytemuck::bytes_of(&wind), wgpu::BufferUsages::UNIFORM);
        let draws = gpu.filled("patches to draw", bytemuck::cast_slice(&plan.draws), wgpu::BufferUsages::STORAGE);
        let numbers = gpu.filled("blades", bytemuck::bytes_of(&plan.uniform), wgpu::BufferUsages::UNIFORM);
        let cells = of.cells;
        let mut bound = vec![
            (0, &prepare),
            (1, &wind),
            (2, &draws),
            (3, &cells.now),
            (4, if bending == Bending::Sheet { &cells.sheets } else { &cells.upper }),
            (5, shared.heights()),
            (6, &of.air.buffer),
            (7, records),
            (8, found),
            (9, &cells.old),
            (11, &numbers),
        ];
        bound.extend(cells.numbers.iter().map(|numbers| (12, numbers.buffer())));
        let group = group(gpu, layout, &bound, Some((10, of.growth)));
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("blades"), timestamp_writes: timing });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        let across = workgroups.min(MOST_GROUPS);
        pass.dispatch_workgroups(across, workgroups.div_ceil(across), 1);
    }
}

/// The first bindings of [`assembled`]: passes that use few of them take the same groups as those that use all.
fn solving_layout(gpu: &Gpu, bindings: u32) -> wgpu::BindGroupLayout {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let kind = |binding: u32| match binding {
        0 | 1 | 11 | 12 => buffer(wgpu::BufferBindingType::Uniform),
        10 => wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Uint,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        _ => buffer(wgpu::BufferBindingType::Storage { read_only: !matches!(binding, 7 | 8) }),
    };
    let entry = |binding| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::COMPUTE, ty: kind(binding), count: None };
    let entries: Vec<_> = (0..bindings).map(entry).collect();
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("blades"), entries: &entries })
}

fn group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    buffers: &[(u32, &wgpu::Buffer)],
    texture: Option<(u32, &wgpu::TextureView)>,
) -> wgpu::BindGroup {
    let bound = buffers.iter();
    let mut entries: Vec<wgpu::BindGroupEntry> =
        bound.map(|(binding, buffer)| wgpu::BindGroupEntry { binding: *binding, resource: buffer.as_entire_binding() }).collect();
    if let Some((binding, view)) = texture {
        entries.push(wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(view) });
    }
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("blades"), layout, entries: &entries })
}
