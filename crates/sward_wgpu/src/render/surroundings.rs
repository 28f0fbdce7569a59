//! The picture of the surroundings and the volume of light on the GPU: what all drawing passes bind where a scene has them.

use half::f16;
use sward::picture::volume::{AmbientUniform, Lighting};
use sward::shading::volume::FACE_COUNT;

use super::Slot;
use crate::gpu::Gpu;

/// Bindings of `surroundings.wgsl`.
const SLOTS: [(u32, Slot); 5] =
    [(12, Slot::Uniform), (13, Slot::Volume), (14, Slot::Filtering), (15, Slot::Picture), (16, Slot::Filtering)];

/// What is bound.
#[derive(Clone)]
pub(crate) struct Surroundings {
    uniform: wgpu::Buffer,
    volume: wgpu::TextureView,
    between: wgpu::Sampler,
    picture: wgpu::TextureView,
    round: wgpu::Sampler,
}

/// Bindings beside a pass's own.
pub(crate) fn slots(surroundings: Option<&Surroundings>) -> &'static [(u32, Slot)] {
    if surroundings.is_some() { &SLOTS } else { &[] }
}

/// What is bound there.
pub(crate) fn entries(surroundings: Option<&Surroundings>) -> Vec<wgpu::BindGroupEntry<'_>> {
    let Some(own) = surroundings else { return Vec::new() };
    let resources = [
        own.uniform.as_entire_binding(),
        wgpu::BindingResource::TextureView(&own.volume),
        wgpu::BindingResource::Sampler(&own.between),
        wgpu::BindingResource::TextureView(&own.picture),
        wgpu::BindingResource::Sampler(&own.round),
    ];
    let entry = |((binding, _), resource)| wgpu::BindGroupEntry { binding, resource };
    SLOTS.into_iter().zip(resources).map(entry).collect()
}

/// A texture of half-precision numbers, filled.
fn texture(gpu: &Gpu, label: &str, size: [u32; 3], dimension: wgpu::TextureDimension, texels: &[[f16; 4]]) -> wgpu::TextureView {
    let [width, height, depth_or_array_layers] = size;
    let extent = wgpu::Extent3d { width, height, depth_or_array_layers };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: extent,
        mip_level_count: 1,
        sample_count: 1,
        dimension,
        format: wgpu::TextureFormat::Rgba16Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    gpu.queue.write_texture(
        texture.as_image_copy(),
        bytemuck::cast_slice(texels),
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(8 * width), rows_per_image: Some(height) },
        extent,
    );
    texture.create_view(&Default::default())
}

impl Surroundings {
    /// Uploads the light of a scene.
    pub(crate) fn new(gpu: &Gpu, lighting: &Lighting) -> Self {
        let Lighting { environment, volume } = lighting;
        let [columns, rows, layers] = volume.size;
        let pixel = |[r, g, b]: &[f32; 3]| [*r, *g, *b, 1.0].map(f16::from_f32);
        let pixels: Vec<[f16; 4]> = environment.radiance.iter().map(pixel).collect();
        let sampler = |label, address_mode_u| {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some(label),
                address_mode_u,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            })
        };
        Self {
            uniform: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("surroundings"),
                size: size_of::<AmbientUniform>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            volume: texture(gpu, "volume of light", [columns, rows, layers * FACE_COUNT], wgpu::TextureDimension::D3, &volume.texels),
            between: sampler("between voxels", wgpu::AddressMode::ClampToEdge),
            picture: texture(gpu, "surroundings", [environment.columns, environment.rows, 1], wgpu::TextureDimension::D2, &pixels),
            round: sampler("round the horizon", wgpu::AddressMode::Repeat),
        }
    }

    /// Follows a frame.
    pub(crate) fn write(&self, gpu: &Gpu, uniform: &AmbientUniform) {
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(uniform));
    }
}
