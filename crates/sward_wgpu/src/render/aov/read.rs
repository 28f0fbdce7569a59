//! Reading the outputs back.

use sward::picture::aov::Aov;

use super::{AovPass, FORMATS};
use crate::gpu::{Gpu, GpuError};

/// Bytes read at once: far less than the largest buffer that WebGPU grants.
const BAND: u32 = 64 << 20;

impl AovPass {
    /// The last outputs; empty ones if nothing was drawn.
    ///
    /// # Errors
    /// What the device reports.
    pub(crate) fn read(&self, gpu: &Gpu) -> Result<Aov, GpuError> {
        let Some(targets) = &self.targets else { return Ok(Aov::default()) };
        let [width, height] = targets.size;
        let words = |index: usize| words(gpu, &targets.outputs[index], FORMATS[index], targets.size);
        let float = |word: u32| f32::from_bits(word);
        // No surface is at the eye: what nothing was drawn on is the sky.
        let depth = words(0)?.into_iter().map(float).map(|depth| if depth > 0.0 { depth } else { f32::INFINITY }).collect();
        let motion = words(1)?.as_chunks::<2>().0.iter().map(|pair| pair.map(float)).collect();
        Ok(Aov { width, height, depth, motion, plant: words(2)? })
    }
}

/// A texture, row by row, in words of 4 bytes.
fn words(gpu: &Gpu, texture: &wgpu::Texture, format: wgpu::TextureFormat, [width, height]: [u32; 2]) -> Result<Vec<u32>, GpuError> {
    let used = format.block_copy_size(None).unwrap_or(4) * width;
    let row = used.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let rows = (BAND / row).max(1);
    let mut words = Vec::new();
    for first in (0..height).step_by(rows as usize) {
        let rows = rows.min(height - first);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back of outputs"),
            size: u64::from(row) * u64::from(rows),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo { origin: wgpu::Origin3d { x: 0, y: first, z: 0 }, ..texture.as_image_copy() },
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
            },
            wgpu::Extent3d { width, height: rows, depth_or_array_layers: 1 },
        );
        let submission = gpu.queue.submit([encoder.finish()]);
        gpu.mapped(&buffer, buffer.size(), Some(submission), |mapped| {
            for line in mapped.chunks_exact(row as usize) {
                words.extend(line[..used as usize].as_chunks::<4>().0.iter().map(|word| u32::from_le_bytes(*word)));
            }
        })?;
    }
    Ok(words)
}
