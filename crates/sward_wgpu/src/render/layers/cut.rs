//! The pass that cuts a plant into layers: every triangle drawn once, into the part of a texture that its leaf's layer has.

use sward::picture::layers::CutUniform;

use super::mesh::{MeshOnGpu, VERTICES};
use crate::gpu::Gpu;
use crate::render::{COLOUR, DEPTH, SAMPLES, Slot, Surroundings, entries, layout, lit_shader, slots};

/// Files of the shader, after the common ones.
pub const PARTS: [&str; 1] = [include_str!("cut.wgsl")];

/// Light of the sky and the share that is left uncovered, and light of the sun and depth, of all layers of a cut.
pub(super) struct CutTexture {
    pub(super) sky: wgpu::TextureView,
    pub(super) sun: wgpu::TextureView,
    pub(super) size: [u32; 2],
}

pub(super) struct CutPass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    surroundings: Option<Surroundings>,
}

impl CutPass {
    pub(super) fn new(gpu: &Gpu, surroundings: Option<&Surroundings>) -> Self {
        let device = &gpu.device;
        let module = lit_shader(device, "cut", &PARTS, surroundings);
        let own = [(0, Slot::Uniform), (4, Slot::Uniform), (5, Slot::Uniform), (6, Slot::Picture), (7, Slot::Filtering)];
        let layout = layout(device, "cut", &[&own, slots(surroundings)].concat());
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("cut"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        // Alpha says which samples are covered, and is no longer what they hold: nothing, where all others hold 1.
        let covered = wgpu::BlendComponent { dst_factor: wgpu::BlendFactor::Zero, ..wgpu::BlendComponent::REPLACE };
        let alpha = wgpu::BlendComponent { src_factor: wgpu::BlendFactor::Zero, ..covered };
        let sky = wgpu::ColorTargetState { blend: Some(wgpu::BlendState { color: covered, alpha }), ..COLOUR.into() };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("cut"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("layers_cut_vertex"),
                compilation_options: Default::default(),
                buffers: &[VERTICES],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState { count: SAMPLES, mask: !0, alpha_to_coverage_enabled: true },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("layers_cut_fragment"),
                compilation_options: Default::default(),
                targets: &[Some(sky), Some(COLOUR.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("leaf pictures"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Self { pipeline, layout, sampler, surroundings: surroundings.cloned() }
    }

    /// Cuts a plant.
    pub(super) fn cut(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame: &wgpu::Buffer,
        mesh: &MeshOnGpu,
        uniform: &CutUniform,
        size: [u32; 2],
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> CutTexture {
        let texture = |label, format, samples, usage| {
            let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: samples,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            });
            texture.create_view(&Default::default())
        };
        let (none, read) = (wgpu::TextureUsages::empty(), wgpu::TextureUsages::TEXTURE_BINDING);
        let [sky, sun] = ["layers, sky", "layers, sun"].map(|label| texture(label, COLOUR, 1, read));
        let samples = [texture("samples of layers", COLOUR, SAMPLES, none), texture("samples of layers", COLOUR, SAMPLES, none)];
        let depth = texture("depth of layers", DEPTH, SAMPLES, none);
        let uniform = gpu.filled("cut", bytemuck::bytes_of(uniform), wgpu::BufferUsages::UNIFORM);
        let attachment = |view, resolve_target, clear| {
            let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store: wgpu::StoreOp::Discard };
            Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: Some(resolve_target), ops })
        };
        let (uncovered, nothing) = (wgpu::Color::BLACK, wgpu::Color::TRANSPARENT);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("cut"),
            color_attachments: &[attachment(&samples[0], &sky, uncovered), attachment(&samples[1], &sun, nothing)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            timestamp_writes,
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        let groups: Vec<wgpu::BindGroup> = mesh
            .finishes
            .iter()
            .map(|finish| {
                let own = [
                    wgpu::BindGroupEntry { binding: 0, resource: frame.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 4, resource: uniform.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 5, resource: finish.uniform.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 6, resource: wgpu::BindingResource::TextureView(&finish.picture) },
                    wgpu::BindGroupEntry { binding: 7, resource: wgpu::BindingResource::Sampler(&self.sampler) },
                ];
                gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("cut"),
                    layout: &self.layout,
                    entries: &[&own, &entries(self.surroundings.as_ref())[..]].concat(),
                })
            })
            .collect();
        for chunk in &mesh.chunks {
            let Some(group) = groups.get(chunk.finish) else { continue };
            pass.set_bind_group(0, group, &[]);
            pass.set_vertex_buffer(0, chunk.vertices.slice(..));
            pass.set_index_buffer(chunk.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..chunk.count, 0, 0..1);
        }
        drop(pass);
        CutTexture { sky, sun, size }
    }
}
