//! What kernels read the wind from, on the GPU: the noise, images of footprints, and the flow of planes of air, now and a step before.

use std::sync::Arc;

use sward::wind::fluid::FluidState;
use sward::world::World;

use super::download::Arriving;
use crate::gpu::{Gpu, GpuError};

/// Bytes of a texel.
const TEXEL: u64 = 8;

/// The texels of the wind, as [`sward::model::Model::wind_texels`] lays them.
pub struct AirTexels {
    /// All of them.
    pub buffer: wgpu::Buffer,
    /// First byte of the flows, which go to the end.
    flows: u64,
    /// Number of each plane that flows, its first texel and how many it has.
    planes: Vec<[u32; 3]>,
}

/// The planes of a world.
fn planes(world: &World) -> Vec<[u32; 3]> {
    world.model.fluids.iter().map(|fluid| [fluid.number, fluid.first, fluid.texels() as u32]).collect()
}

impl AirTexels {
    /// Those of a world, with the flows that the CPU holds.
    pub fn new(gpu: &Gpu, world: &World) -> Self {
        let texels = world.model.wind_texels();
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let buffer = gpu.filled("wind tile", bytemuck::cast_slice(&texels), usage);
        let first = world.model.fluids.first().map_or(texels.len() as u64, |fluid| u64::from(fluid.first));
        let air = Self { buffer, flows: TEXEL * first, planes: planes(world) };
        air.upload(gpu, world);
        air
    }

    /// Follows sources of wind that come and go: planes that were there before flow on. Returns whether there is another buffer.
    pub fn follow(&mut self, gpu: &Gpu, world: &World) -> bool {
        let texels = world.model.wind_texels();
        if self.buffer.size() == TEXEL * texels.len() as u64 && self.planes == planes(world) {
            return false;
        }
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let buffer = gpu.filled("wind tile", bytemuck::cast_slice(&texels), usage);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for [number, first, count] in planes(world) {
            if let Some([_, old, _]) = self.planes.iter().find(|[known, _, size]| (*known, *size) == (number, count)) {
                let [from, to, bytes] = [*old, first, count].map(|texels| TEXEL * u64::from(texels));
                encoder.copy_buffer_to_buffer(&self.buffer, from, &buffer, to, Some(bytes));
            }
        }
        gpu.queue.submit([encoder.finish()]);
        let first = world.model.fluids.first().map_or(texels.len() as u64, |fluid| u64::from(fluid.first));
        *self = Self { buffer, flows: TEXEL * first, planes: planes(world) };
        true
    }

    /// Writes the flows that the CPU holds.
    pub fn upload(&self, gpu: &Gpu, world: &World) {
        let step = world.state.step;
        for (fluid, flow) in world.model.fluids.iter().zip(&world.state.fluids) {
            for (texel, cells) in [(fluid.texel(step), &flow.now), (fluid.texel(step + 1), &flow.before)] {
                gpu.queue.write_buffer(&self.buffer, TEXEL * u64::from(texel), bytemuck::cast_slice(cells));
            }
        }
    }

    /// Copies the flows of others of the same scene.
    pub fn copy_from(&self, encoder: &mut wgpu::CommandEncoder, other: &Self) {
        let bytes = self.buffer.size() - self.flows;
        if bytes > 0 && bytes == other.buffer.size() - other.flows {
            encoder.copy_buffer_to_buffer(&other.buffer, other.flows, &self.buffer, self.flows, Some(bytes));
        }
    }

    /// What is copied to read the flows back: nothing where no air flows.
    pub(crate) fn copied(&self, world: &World) -> Vec<(&wgpu::Buffer, u64)> {
        if world.model.fluids.is_empty() { Vec::new() } else { vec![(&self.buffer, self.buffer.size())] }
    }

    /// Takes the flows over into the state of a world that has done as many steps.
    ///
    /// # Errors
    /// What the device reports.
    pub(crate) fn arrive(&self, gpu: &Gpu, arriving: &mut Arriving, world: &mut World) -> Result<(), GpuError> {
        if world.model.fluids.is_empty() {
            return Ok(());
        }
        let texels: Vec<[f32; 2]> = arriving.next(gpu)?;
        let step = world.state.step;
        for (fluid, flow) in world.model.fluids.iter().zip(&mut world.state.fluids) {
            let cells = |texel: u32| texels.get(texel as usize..).and_then(|rest| rest.get(..fluid.texels() / 2));
            if let (Some(now), Some(before)) = (cells(fluid.texel(step)), cells(fluid.texel(step + 1))) {
                *flow = FluidState { now: Arc::new(now.to_vec()), before: Arc::new(before.to_vec()) };
            }
        }
        Ok(())
    }
}
