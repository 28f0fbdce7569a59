//! A world, drawn: prepares the visible plants and hands everything to the renderer.

use sward::world::World;

use crate::compute::GpuStep;
use crate::gpu::{Gpu, GpuError};
use crate::picture::Picture;

/// Where the cells to be drawn are.
pub enum CellsAt<'a> {
    /// In `world.state`; they are uploaded.
    Cpu,
    /// On the GPU already.
    Gpu(&'a GpuStep),
}

/// Draws a world.
pub struct Studio {}

impl Studio {
    /// Builds what stays the same from picture to picture.
    ///
    /// # Errors
    /// What the device reports.
    pub fn new(_gpu: &Gpu, _world: &World) -> Result<Self, GpuError> {
        Ok(Self {})
    }

    /// Draws the world as it stands, in `size` pixels.
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw(&mut self, _gpu: &Gpu, _world: &World, _cells: CellsAt<'_>, size: [u32; 2]) -> Result<Picture, GpuError> {
        Ok(Picture { width: size[0], height: size[1], rgba8: vec![128; (4 * size[0] * size[1]) as usize] })
    }
}
