//! Drawing pictures with outputs beside them.

use sward::picture::Picture;
use sward::picture::aov::Aov;
use sward::picture::past::Past;
use sward::world::World;

use crate::artist::Artist;
use crate::backend::Backend;
use crate::failure::Failure;

/// The picture before, where the CPU draws; a graphics adapter keeps its own.
#[derive(Default)]
pub(crate) struct Memory(Option<Past>);

impl Artist<'_> {
    /// Takes the moment `behind` steps before the world's state for that of the picture before.
    pub(crate) fn remember(
        &mut self,
        memory: &mut Memory,
        world: &mut World,
        backend: &mut Backend<'_>,
        behind: f64,
    ) -> Result<(), Failure> {
        match self {
            Self::Cpu(_) => {
                backend.fetch(world)?;
                memory.0 = Some(Past::of(world, behind));
            }
            Self::Gpu(gpu, studio) => studio.remember(gpu, world, backend.cells(), behind)?,
        }
        Ok(())
    }

    /// Draws the moment `behind` steps before the world's state, with its outputs; it is then the picture before.
    pub(crate) fn draw_aov(
        &mut self,
        memory: &mut Memory,
        world: &mut World,
        backend: &mut Backend<'_>,
        behind: f64,
        size: [u32; 2],
    ) -> Result<(Picture, Aov), Failure> {
        match self {
            Self::Cpu(studio) => {
                backend.fetch(world)?;
                let now = Past::of(world, behind);
                let images = studio.draw_aov(world, memory.0.as_ref().unwrap_or(&now), behind, size);
                memory.0 = Some(now);
                Ok(images)
            }
            Self::Gpu(gpu, studio) => Ok(studio.draw_aov(gpu, world, backend.cells(), behind, size)?),
        }
    }
}
