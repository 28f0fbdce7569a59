//! Where the ground is bare, for the ground's shader: exclusions and masks near the camera.

use std::sync::Arc;

use sward::growth::{GrowthBlock, GrowthRecord, MOST_RECORDS, MaskImage, Near};

use crate::gpu::Gpu;

/// Buffers of what [`Near`] says.
pub(crate) struct BareGround {
    /// The records.
    pub(crate) block: wgpu::Buffer,
    /// Shades of masks, then edges.
    pub(crate) words: wgpu::Buffer,
    /// Masks that are stored, with the number of their first texel.
    masks: Vec<(Arc<MaskImage>, u32)>,
    /// Words they take.
    shades: u64,
}

fn words(gpu: &Gpu, count: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("shades and edges of bare ground"),
        size: 16 * count.max(1),
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

impl BareGround {
    /// Nothing is bare.
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let block = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("bare ground"),
            size: size_of::<GrowthBlock>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { block, words: words(gpu, 1), masks: Vec::new(), shades: 0 }
    }

    /// Uploads the limits of a picture; shades only when a mask comes into sight. True if a buffer was replaced.
    pub(crate) fn write(&mut self, gpu: &Gpu, growth: &Near) -> bool {
        let images: Vec<&Arc<MaskImage>> = growth.images().iter().flatten().collect();
        let known = |image: &Arc<MaskImage>| self.masks.iter().any(|(stored, _)| Arc::ptr_eq(stored, image));
        let fresh = !images.iter().all(|image| known(image));
        if fresh {
            (self.masks, self.shades) = (Vec::new(), 0);
            for image in images {
                self.masks.push((Arc::clone(image), (16 * self.shades) as u32));
                self.shades += (image.shades.len() as u64).div_ceil(16);
            }
        }
        let needed = 16 * (self.shades + growth.edges.len() as u64);
        let replaced = needed > self.words.size();
        if replaced {
            self.words = words(gpu, needed.next_power_of_two() / 16);
        }
        if fresh || replaced {
            for (image, first) in &self.masks {
                let mut shades = image.shades.clone();
                shades.resize(shades.len().next_multiple_of(16), 0);
                gpu.queue.write_buffer(&self.words, u64::from(*first), &shades);
            }
        }
        gpu.queue.write_buffer(&self.words, 16 * self.shades, bytemuck::cast_slice(&growth.edges));
        gpu.queue.write_buffer(&self.block, 0, bytemuck::bytes_of(&self.block_of(growth)));
        replaced
    }

    fn block_of(&self, growth: &Near) -> GrowthBlock {
        let mut records = [GrowthRecord::default(); MOST_RECORDS];
        for ((to, record), image) in records.iter_mut().zip(&growth.records).zip(growth.images()) {
            *to = *record;
            if let Some(image) = image {
                to.first = self.masks.iter().find(|(stored, _)| Arc::ptr_eq(stored, image)).map_or(0, |(_, first)| *first);
            }
        }
        let count = growth.records.len().min(MOST_RECORDS) as u32;
        GrowthBlock { count, first_edge: self.shades as u32, unused: [0; 2], records }
    }
}
