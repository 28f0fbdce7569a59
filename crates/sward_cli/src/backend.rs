//! Where the simulation runs.

use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::CellsAt;

use crate::arguments::Where;
use crate::failure::Failure;

/// What moves the cells.
pub(crate) enum Backend<'a> {
    /// This machine's processor.
    Cpu,
    /// A graphics adapter.
    Gpu(&'a Gpu, Box<GpuStep>),
}

impl<'a> Backend<'a> {
    /// The GPU for `Where::Gpu`, or for `Where::Auto` where it is hardware; the CPU where there is none.
    pub(crate) fn choose(on: Where, gpu: Option<&'a Gpu>, world: &World) -> Result<Self, Failure> {
        let hardware = |gpu: &&Gpu| gpu.adapter_info.device_type != wgpu::DeviceType::Cpu;
        match gpu.filter(|gpu| on == Where::Gpu || (on == Where::Auto && hardware(gpu))) {
            Some(gpu) => Self::on_gpu(gpu, world),
            None => Ok(Self::Cpu),
        }
    }

    /// The GPU, from the world's present state on.
    pub(crate) fn on_gpu(gpu: &'a Gpu, world: &World) -> Result<Self, Failure> {
        Ok(Self::Gpu(gpu, Box::new(GpuStep::new(gpu, world)?)))
    }

    /// One fixed step.
    pub(crate) fn step(&mut self, world: &mut World) -> Result<(), Failure> {
        match self {
            Self::Cpu => world.step(),
            Self::Gpu(gpu, step) => step.step(gpu, world)?,
        }
        Ok(())
    }

    /// Waits until all steps are done.
    pub(crate) fn wait(&mut self, world: &mut World) -> Result<(), Failure> {
        if let Self::Gpu(gpu, step) = self {
            step.wait(gpu, world)?;
        }
        Ok(())
    }

    /// Brings the cells into `world.state`.
    pub(crate) fn fetch(&mut self, world: &mut World) -> Result<(), Failure> {
        if let Self::Gpu(gpu, step) = self {
            step.download(gpu, world)?;
        }
        Ok(())
    }

    /// Where the cells are, for drawing.
    pub(crate) fn cells(&self) -> CellsAt<'_> {
        match self {
            Self::Cpu => CellsAt::Cpu,
            Self::Gpu(_, step) => CellsAt::Gpu(step),
        }
    }

    /// The name of the place.
    pub(crate) fn name(&self) -> &str {
        match self {
            Self::Cpu => "the CPU",
            Self::Gpu(gpu, _) => &gpu.adapter_info.name,
        }
    }
}
