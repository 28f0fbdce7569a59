//! The terrain's samples on the GPU, and after them what has been added to the ground since.

use sward::terrain::{Edits, Terrain};

use crate::gpu::Gpu;

/// One buffer of heights, m.
pub(crate) struct HeightSamples {
    pub(crate) buffer: wgpu::Buffer,
    /// Samples of the terrain itself.
    base: u64,
    /// Changes of the ground that have been followed.
    changes: u64,
}

fn filled(gpu: &Gpu, base: &[f32], edits: &Edits) -> wgpu::Buffer {
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("heights"),
        size: 4 * (base.len() + edits.heights().len()).max(1) as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    gpu.queue.write_buffer(&buffer, 0, bytemuck::cast_slice(base));
    gpu.queue.write_buffer(&buffer, 4 * base.len() as u64, bytemuck::cast_slice(edits.heights()));
    buffer
}

impl HeightSamples {
    /// Uploads everything.
    pub(crate) fn new(gpu: &Gpu, base: &[f32], edits: &Edits) -> Self {
        // A buffer is never empty.
        let base = if base.is_empty() { &[0.0] } else { base };
        Self { buffer: filled(gpu, base, edits), base: base.len() as u64, changes: edits.changes() }
    }

    /// Follows changes of the ground: rows of the rectangles edited, or everything where the grid has become another. True if the buffer
    /// was replaced.
    pub(crate) fn follow(&mut self, gpu: &Gpu, terrain: &Terrain) -> bool {
        let edits = terrain.edits();
        if edits.changes() == self.changes {
            return false;
        }
        let recent = edits.since(self.changes);
        self.changes = edits.changes();
        let Some(recent) = recent else {
            self.buffer = filled(gpu, terrain.heights(), edits);
            return true;
        };
        let columns = edits.size()[0] as usize;
        for [column, row, wide, high] in recent.iter().map(|patch| patch.map(|along| along as usize)) {
            for row in row..row + high {
                let start = row * columns + column;
                let bytes = bytemuck::cast_slice(&edits.heights()[start..start + wide]);
                gpu.queue.write_buffer(&self.buffer, 4 * (self.base + start as u64), bytes);
            }
        }
        false
    }
}
