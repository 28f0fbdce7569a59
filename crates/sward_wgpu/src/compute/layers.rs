//! Stands of meshes on the GPU: the waves of their planes, and of plants that are touched.

use bytemuck::{Pod, Zeroable};
use sward::interaction::reaction;
use sward::plan::LayeredPlan;
use sward::response::harmonic::{self, HarmonicCoefficients, HarmonicModel, TOUCH_SIDE};
use sward::state::{LayeredState, Waves};

use super::Work;
use super::air::AirTexels;
use super::download::Arriving;
use super::passes::{Groups, Pass};
use super::traffic;
use crate::gpu::{Gpu, GpuError, Program};
use crate::render::layers::WaveBuffers;
use crate::stopwatch::Stopwatch;

/// Bytes of a touched plant's plane.
const PLANT: u64 = 8 * (TOUCH_SIDE * TOUCH_SIDE) as u64;

/// `PlaneStep` of `layers.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct PlaneStep {
    /// Kernel numbers of the plane.
    pub co: HarmonicCoefficients,
    /// Of touched plants.
    pub touch: HarmonicCoefficients,
    /// Cells along a side.
    pub side: u32,
    /// First cell of the present's note.
    pub note: u32,
    /// Step, s.
    pub dt: f32,
    /// 0.
    pub unused: u32,
}

/// `Touched` of `layers.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Touched {
    /// Where its plane is.
    pub slot: u32,
    /// 1: it has just been touched.
    pub fresh: u32,
    /// Local wind along the plane, m/s.
    pub wind: [f32; 2],
    /// Its bodies: the first, and one past the last.
    pub brushes: [u32; 2],
    /// Mass of the leaves of a cell, kg.
    pub cell_mass: f32,
    /// 0.
    pub unused: u32,
}

/// The full text of the compute shader.
pub fn assembled() -> String {
    let parts = [
        sward::math::WGSL,
        sward::wind::WGSL,
        reaction::WGSL,
        reaction::SUMS_WGSL,
        harmonic::WGSL,
        include_str!("layers.wgsl"),
        sward::wind::SUM_WGSL,
    ];
    parts.join("\n")
}

/// The passes.
pub struct LayerPasses {
    plane: Pass,
    plant: Pass,
}

/// The waves of one stand.
pub struct LayeredBuffers {
    now: wgpu::Buffer,
    old: wgpu::Buffer,
    notes: wgpu::Buffer,
    touch_now: wgpu::Buffer,
    touch_old: wgpu::Buffer,
}

fn storage(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

impl LayeredBuffers {
    /// The waves that the CPU holds.
    pub fn new(gpu: &Gpu, state: &LayeredState) -> Self {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let waves = |cells: &[[f32; 2]]| gpu.filled("waves", bytemuck::cast_slice(cells), usage);
        let notes = gpu.filled("notes of waves", bytemuck::cast_slice(&state.notes.concat()), usage);
        let size = PLANT * state.touches.len().max(1) as u64;
        let (touch_now, touch_old) = (storage(gpu, "touched plants", size), storage(gpu, "touched plants", size));
        for (slot, own) in state.touches.iter().enumerate().filter(|(_, own)| !own.now.is_empty()) {
            gpu.queue.write_buffer(&touch_now, PLANT * slot as u64, bytemuck::cast_slice(&own.now));
            gpu.queue.write_buffer(&touch_old, PLANT * slot as u64, bytemuck::cast_slice(&own.old));
        }
        Self { now: waves(&state.waves.now), old: waves(&state.waves.old), notes, touch_now, touch_old }
    }

    /// What pictures read.
    pub fn waves(&self) -> WaveBuffers {
        WaveBuffers { notes: self.notes.clone(), touches: self.touch_now.clone() }
    }

    /// Room for the planes of touched plants.
    fn reserve(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, slots: u32) {
        let wanted = PLANT * u64::from(slots.next_power_of_two());
        if self.touch_now.size() < wanted {
            for buffer in [&mut self.touch_now, &mut self.touch_old] {
                let wider = storage(gpu, "touched plants", wanted);
                encoder.copy_buffer_to_buffer(buffer, 0, &wider, 0, Some(buffer.size()));
                *buffer = wider;
            }
        }
    }

    /// What is copied to read the waves back.
    pub(crate) fn copied(&self) -> Vec<(&wgpu::Buffer, u64)> {
        let buffers = [&self.now, &self.old, &self.notes, &self.touch_now, &self.touch_old];
        buffers.map(|buffer| (buffer, buffer.size())).to_vec()
    }

    /// Takes the waves over.
    ///
    /// # Errors
    /// What the device reports.
    pub(crate) fn arrive(
        &self,
        gpu: &Gpu,
        arriving: &mut Arriving,
        model: &HarmonicModel,
        state: &mut LayeredState,
    ) -> Result<(), GpuError> {
        let mut read = || arriving.next::<[f32; 2]>(gpu);
        let area = (model.cells * model.cells) as usize;
        (state.waves.now, state.waves.old) = (read()?, read()?);
        state.notes = read()?.chunks_exact(area).map(<[_]>::to_vec).collect();
        let (now, old) = (read()?, read()?);
        let plant = (TOUCH_SIDE * TOUCH_SIDE) as usize;
        let used = state.pool.used() as usize;
        state.touches = (0..used)
            .map(|slot| {
                let cells = |all: &[[f32; 2]]| all.get(slot * plant..(slot + 1) * plant).map(<[_]>::to_vec);
                match (cells(&now), cells(&old)) {
                    (Some(now), Some(old)) => {
                        let mut waves = Waves::new(TOUCH_SIDE as usize);
                        (waves.now, waves.old) = (now, old);
                        waves
                    }
                    _ => Waves::default(),
                }
            })
            .collect();
        Ok(())
    }
}

impl LayerPasses {
    /// Builds the pipelines.
    pub fn new(gpu: &Gpu) -> Self {
        let program = Program::new("waves of meshes", assembled());
        Self {
            plane: Pass::plain(gpu, &program, "plane_pass", &[0, 1, 2, 3, 4, 8]),
            plant: Pass::plain(gpu, &program, "plant_pass", &[0, 5, 6, 7, 9, 10]),
        }
    }

    /// Records the step after `step` of them. Returns the sums of what brushes feel.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        model: &HarmonicModel,
        (plan, step): (&LayeredPlan, u64),
        air: &AirTexels,
        buffers: &mut LayeredBuffers,
        work: &mut Work,
        mut stopwatch: Option<&mut Stopwatch>,
    ) -> wgpu::Buffer {
        let slots = plan.touched.iter().map(|touched| touched.slot + 1).max().unwrap_or(1);
        buffers.reserve(gpu, encoder, slots);
        let area = model.cells * model.cells;
        let numbers = PlaneStep {
            co: model.coefficients,
            touch: model.touch_coefficients,
            side: model.cells,
            note: model.ring.present(step + 1) * area,
            dt: model.dt,
            unused: 0,
        };
        let touched: Vec<Touched> = plan
            .touched
            .iter()
            .map(|one| Touched {
                slot: one.slot,
                fresh: u32::from(one.fresh),
                wind: one.wind,
                brushes: [one.brushes.start, one.brushes.end],
                cell_mass: one.cell_mass,
                unused: 0,
            })
            .collect();
        let mut filled = |label: &str, bytes: &[u8], usage| {
            work.uploaded += bytes.len() as u64;
            gpu.filled(label, if bytes.is_empty() { &[0; 32] } else { bytes }, usage)
        };
        let numbers = filled("step of waves", bytemuck::bytes_of(&numbers), wgpu::BufferUsages::UNIFORM);
        let wind = filled("wind", bytemuck::bytes_of(&plan.wind.block(model.cells)), wgpu::BufferUsages::UNIFORM);
        let touched_of = filled("touched plants", bytemuck::cast_slice(&touched), wgpu::BufferUsages::STORAGE);
        let brushes = filled("bodies on plants", bytemuck::cast_slice(&plan.brushes), wgpu::BufferUsages::STORAGE);
        let felt = storage(gpu, "what bodies feel", 4 * (reaction::WORDS * plan.brushes.len()).max(4) as u64);
        let bound = [
            (0, &numbers),
            (1, &wind),
            (2, &buffers.now),
            (3, &buffers.old),
            (4, &buffers.notes),
            (5, &touched_of),
            (6, &brushes),
            (7, &buffers.touch_now),
            (8, &air.buffer),
            (9, &buffers.touch_old),
            (10, &felt),
        ];
        let groups = model.cells.div_ceil(8);
        work.add(&self.plane.run(gpu, encoder, &bound, Groups::Direct([groups, groups, 1]), stopwatch.as_deref_mut()));
        let each = TOUCH_SIDE / 8;
        work.add(&self.plant.run(gpu, encoder, &bound, Groups::Direct([each, each, touched.len() as u32]), stopwatch));
        work.traffic += traffic::plane(u64::from(area)) + traffic::plants(touched.len() as u64);
        std::mem::swap(&mut buffers.now, &mut buffers.old);
        std::mem::swap(&mut buffers.touch_now, &mut buffers.touch_old);
        felt
    }
}
