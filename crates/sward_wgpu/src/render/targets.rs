//! What the main pass draws into, and the last pass from there to a display picture.

use super::{COLOUR, DEPTH, SAMPLES, Slot, layout, shader};
use crate::gpu::Gpu;

/// Files of the resolving shader, after the common ones.
pub const PARTS: [&str; 2] = [include_str!("resolve_samples.wgsl"), include_str!("resolve.wgsl")];
/// The same for OpenGL: wgpu makes no multisampled texture there that a shader could read, so the device averages the samples first.
pub const MEAN_PARTS: [&str; 2] = [include_str!("resolve_mean.wgsl"), include_str!("resolve.wgsl")];

/// Format of finished pictures: sRGB code values.
pub const DISPLAY: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Textures of one picture size.
pub(crate) struct Targets {
    pub(crate) size: [u32; 2],
    colour: wgpu::TextureView,
    /// Where the device averages samples; `None` where the resolving shader does.
    mean: Option<wgpu::TextureView>,
    depth: wgpu::TextureView,
    bindings: wgpu::BindGroup,
    /// The finished picture, for reading back.
    pub(crate) display: wgpu::Texture,
}

/// The resolving pass.
pub(crate) struct Resolve {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl Resolve {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let (parts, slot) = if averages(gpu) { (&MEAN_PARTS, Slot::Mean) } else { (&PARTS, Slot::Samples) };
        let module = shader(device, "resolve", parts);
        let layout = layout(device, "resolve", &[(0, Slot::Uniform), (1, slot)]);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("resolve"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("resolve"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("resolve_vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("resolve_fragment"),
                compilation_options: Default::default(),
                targets: &[Some(DISPLAY.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { pipeline, layout }
    }

    /// Makes the textures for a size.
    pub(crate) fn targets(&self, gpu: &Gpu, frame: &wgpu::Buffer, size: [u32; 2]) -> Targets {
        let texture = |label, format, sample_count, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let view = |texture: &wgpu::Texture| texture.create_view(&Default::default());
        let read = wgpu::TextureUsages::TEXTURE_BINDING;
        let mean = averages(gpu).then(|| view(&texture("mean", COLOUR, 1, read)));
        let colour = view(&texture("colour", COLOUR, SAMPLES, if mean.is_some() { wgpu::TextureUsages::empty() } else { read }));
        let depth = view(&texture("depth", DEPTH, SAMPLES, wgpu::TextureUsages::empty()));
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("resolve"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: frame.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(mean.as_ref().unwrap_or(&colour)) },
            ],
        });
        Targets {
            size,
            colour,
            mean,
            depth,
            bindings,
            display: texture("picture", DISPLAY, 1, wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::TEXTURE_BINDING),
        }
    }

    pub(crate) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        to: &wgpu::TextureView,
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("resolve"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: to,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            timestamp_writes,
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &targets.bindings, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// Whether the device averages samples instead of the shader.
fn averages(gpu: &Gpu) -> bool {
    gpu.adapter_info.backend == wgpu::Backend::Gl
}

impl Targets {
    pub(crate) fn begin<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'a> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("main"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.colour,
                depth_slice: None,
                resolve_target: self.mean.as_ref(),
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            timestamp_writes,
            ..Default::default()
        })
    }
}
