//! What draws the picture: a graphics adapter, or the CPU.

use std::sync::Arc;

use sward::picture::Picture;
use sward::world::World;
use sward_wgpu::gpu::{Gpu, GpuError};

use crate::arguments::{Draw, Where};
use crate::backend::Backend;
use crate::cache::Cache;
use crate::console::Console;
use crate::failure::Failure;

/// What draws.
pub(crate) enum Artist<'a> {
    /// This machine's processor.
    Cpu(Box<sward_raster::Studio>),
    /// A graphics adapter.
    Gpu(&'a Gpu, Box<sward_wgpu::studio::Studio>),
}

/// The adapter, where one is needed, or there is one and it may be used. That there is none is said once.
pub(crate) fn adapter(draw: Draw, on: Where, console: &Console) -> Result<Option<Gpu>, Failure> {
    adapter_by(Gpu::new, draw, on, console)
}

/// As [`adapter`], opened in a way of the caller's.
pub(crate) fn adapter_by(open: fn() -> Result<Gpu, GpuError>, draw: Draw, on: Where, console: &Console) -> Result<Option<Gpu>, Failure> {
    if draw == Draw::Gpu || on == Where::Gpu {
        return Ok(Some(open()?));
    }
    if draw == Draw::Cpu {
        return Ok(None);
    }
    let why = match open() {
        Ok(gpu) => return Ok(Some(gpu)),
        Err(GpuError::NoAdapter) => "no graphics adapter found".to_owned(),
        Err(error @ GpuError::NoDevice { .. }) => error.to_string(),
        Err(error) => return Err(error.into()),
    };
    console.note(&format!("{why}; the picture is drawn on the CPU"));
    Ok(None)
}

impl<'a> Artist<'a> {
    /// The adapter if there is one and the CPU was not asked for. Fails for pictures it cannot draw.
    pub(crate) fn choose(
        draw: Draw,
        gpu: Option<&'a Gpu>,
        world: &World,
        size: [u32; 2],
        (cache, console): (&Cache, &Console),
    ) -> Result<Self, Failure> {
        let lighting = || cache.lighting(world, console).map(Arc::new);
        let Some(gpu) = gpu.filter(|_| draw != Draw::Cpu) else {
            return Ok(Self::Cpu(Box::new(sward_raster::Studio::lit(world, lighting()))));
        };
        let largest = gpu.device.limits().max_texture_dimension_2d;
        if size.iter().any(|side| *side > largest) {
            let adapter = &gpu.adapter_info.name;
            let help = format!("type a --size of at most {largest}x{largest}, or --draw cpu");
            return Err(Failure::input(format!("{}x{} is too large for {adapter}", size[0], size[1]), help));
        }
        Ok(Self::Gpu(gpu, Box::new(sward_wgpu::studio::Studio::lit(gpu, world, lighting())?)))
    }

    /// Draws the moment `behind` steps before the world's state.
    pub(crate) fn draw(&mut self, world: &mut World, backend: &mut Backend<'_>, behind: f64, size: [u32; 2]) -> Result<Picture, Failure> {
        match self {
            Self::Cpu(studio) => {
                backend.fetch(world)?;
                Ok(studio.draw_before(world, behind, size))
            }
            Self::Gpu(gpu, studio) => Ok(studio.draw_before(gpu, world, backend.cells(), behind, size)?),
        }
    }

    /// What to call it.
    pub(crate) fn name(&self) -> &str {
        match self {
            Self::Cpu(_) => "the CPU",
            Self::Gpu(gpu, _) => &gpu.adapter_info.name,
        }
    }
}
