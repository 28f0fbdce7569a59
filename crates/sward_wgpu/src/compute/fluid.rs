//! Air that flows, on the GPU: once a step for all stands. Eight passes a plane, each a workgroup a row.

use bytemuck::{Pod, Zeroable};
use sward::wind::fluid::{self, FASTEST, FluidPlan, FluidSource};

use super::Work;
use super::air::AirTexels;
use super::passes::{Groups, Pass};
use super::traffic;
use crate::gpu::{Gpu, Program};
use crate::stopwatch::Stopwatch;

/// The passes of a plane in a step, in order.
pub(super) const PASSES: [&str; 8] =
    ["force_pass", "columns_pass", "spread_pass", "rows_pass", "advect_pass", "columns_pass", "project_pass", "end_pass"];

/// `FluidStep` of `fluid.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct FluidStep {
    /// Cells along a side.
    pub side: u32,
    /// Texel of the flow.
    pub now: u32,
    /// Texel of the flow after the step.
    pub next: u32,
    /// How many gusts push it.
    pub gusts: u32,
    /// How many bodies drag it.
    pub drags: u32,
    /// Side of a cell, m.
    pub cell: f32,
    /// Side of the plane, m.
    pub width: f32,
    /// Cells a step for every m/s.
    pub reach: f32,
    /// What is left after the step.
    pub lasts: f32,
    /// m/s.
    pub fastest: f32,
    /// 1 over the number of cells.
    pub share: f32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: f32,
}

/// The full text of the compute shader.
pub fn assembled() -> String {
    [&[sward::math::WGSL], &fluid::WGSL[..], &[include_str!("fluid.wgsl")]].concat().join("\n")
}

/// What a plane needs besides its flow.
struct Plane {
    table: wgpu::Buffer,
    waves: wgpu::Buffer,
    cells: wgpu::Buffer,
}

/// The passes.
pub struct FluidPasses {
    force: Pass,
    columns: Pass,
    spread: Pass,
    rows: Pass,
    advect: Pass,
    project: Pass,
    end: Pass,
    planes: Vec<Plane>,
    /// Which they are.
    numbers: Vec<u32>,
}

impl FluidPasses {
    /// Builds the pipelines, and the room for each plane.
    pub fn new(gpu: &Gpu, fluids: &[FluidSource]) -> Self {
        let program = Program::new("air that flows", assembled());
        let plane = |fluid: &FluidSource| {
            let spectrum = &fluid.model.spectrum;
            let waves = (0..fluid.model.side).map(|m| {
                let [cosine, sine] = spectrum.fft.turns.get(m).copied().unwrap_or_default();
                [cosine, sine, spectrum.slopes[m], spectrum.lasts[m]]
            });
            let room = |label: &str| {
                let (size, usage) = (4 * fluid.texels() as u64, wgpu::BufferUsages::STORAGE);
                gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
            };
            let table = gpu.filled("waves of air", bytemuck::cast_slice(&waves.collect::<Vec<_>>()), wgpu::BufferUsages::STORAGE);
            Plane { table, waves: room("waves of air"), cells: room("cells of air") }
        };
        Self {
            force: Pass::plain(gpu, &program, "force_pass", &[0, 1, 2, 3, 4, 5]),
            columns: Pass::plain(gpu, &program, "columns_pass", &[0, 1, 5]),
            spread: Pass::plain(gpu, &program, "spread_pass", &[0, 1, 5, 6]),
            rows: Pass::plain(gpu, &program, "rows_pass", &[0, 1, 6]),
            advect: Pass::plain(gpu, &program, "advect_pass", &[0, 1, 5, 6]),
            project: Pass::plain(gpu, &program, "project_pass", &[0, 1, 5, 6]),
            end: Pass::plain(gpu, &program, "end_pass", &[0, 1, 4, 6]),
            planes: fluids.iter().map(plane).collect(),
            numbers: fluids.iter().map(|fluid| fluid.number).collect(),
        }
    }

    /// Whether it is these planes that there is room for.
    pub fn fits(&self, fluids: &[FluidSource]) -> bool {
        fluids.iter().map(|fluid| fluid.number).eq(self.numbers.iter().copied())
    }

    /// Records the step after `step` of them.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        fluids: &[FluidSource],
        (plans, step): (&[FluidPlan], u64),
        air: &AirTexels,
        work: &mut Work,
        mut stopwatch: Option<&mut Stopwatch>,
    ) {
        for ((fluid, plane), plan) in fluids.iter().zip(&self.planes).zip(plans) {
            let model = &fluid.model;
            let numbers = FluidStep {
                side: model.side as u32,
                now: fluid.texel(step),
                next: fluid.texel(step + 1),
                gusts: plan.gusts.len() as u32,
                drags: plan.drags.len() as u32,
                cell: model.cell,
                width: model.side as f32 * model.cell,
                reach: model.reach,
                lasts: model.lasts,
                fastest: FASTEST,
                share: 1.0 / (model.side * model.side) as f32,
                unused: 0.0,
            };
            let mut filled = |label: &str, bytes: &[u8]| {
                work.uploaded += bytes.len() as u64;
                gpu.filled(label, if bytes.is_empty() { &[0; 48] } else { bytes }, wgpu::BufferUsages::STORAGE)
            };
            let numbers = filled("step of air", bytemuck::bytes_of(&numbers));
            let gusts = filled("gusts", bytemuck::cast_slice(&plan.gusts));
            let drags = filled("bodies in air", bytemuck::cast_slice(&plan.drags));
            let bound =
                [(0, &numbers), (1, &plane.table), (2, &gusts), (3, &drags), (4, &air.buffer), (5, &plane.waves), (6, &plane.cells)];
            let passes = [&self.force, &self.columns, &self.spread, &self.rows, &self.advect, &self.columns, &self.project, &self.end];
            for pass in passes {
                let groups = Groups::Direct([model.side as u32, 1, 1]);
                work.add(&pass.run(gpu, encoder, &bound, groups, stopwatch.as_deref_mut()));
            }
            work.traffic += PASSES.iter().map(|pass| traffic::air(pass, fluid.texels() as u64)).sum::<u64>();
        }
    }
}
