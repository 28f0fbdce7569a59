//! All clump pictures as one texture array with mip levels.

use sward::shading::clump::{KINDS, LEVELS, SIDE, VARIANTS, first_layer, painted};
use sward::shading::look::Look;

use crate::gpu::Gpu;

/// The pictures, and how they are read.
pub(crate) struct ClumpTexture {
    pub(crate) view: wgpu::TextureView,
    pub(crate) sampler: wgpu::Sampler,
}

impl ClumpTexture {
    /// With the pictures of the kinds that some looks have.
    pub(crate) fn new(gpu: &Gpu, looks: &[Look]) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("clumps"),
            size: extent(0, KINDS.len() as u32 * VARIANTS),
            mip_level_count: LEVELS as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for kind in KINDS.into_iter().filter(|kind| looks.iter().any(|look| look.kind == *kind)) {
            for variant in 0..VARIANTS {
                for (level, bytes) in painted(kind, variant).levels.iter().enumerate() {
                    upload(gpu, &texture, first_layer(kind) + variant, level as u32, bytes);
                }
            }
        }
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("clumps"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let view = texture
            .create_view(&wgpu::TextureViewDescriptor { dimension: Some(wgpu::TextureViewDimension::D2Array), ..Default::default() });
        Self { view, sampler }
    }
}

fn extent(level: u32, layers: u32) -> wgpu::Extent3d {
    let side = (SIDE as u32 >> level).max(1);
    wgpu::Extent3d { width: side, height: side, depth_or_array_layers: layers }
}

fn upload(gpu: &Gpu, texture: &wgpu::Texture, layer: u32, level: u32, bytes: &[u8]) {
    let size = extent(level, 1);
    gpu.queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: level,
            origin: wgpu::Origin3d { x: 0, y: 0, z: layer },
            aspect: wgpu::TextureAspect::All,
        },
        bytes,
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * size.width), rows_per_image: Some(size.height) },
        size,
    );
}
