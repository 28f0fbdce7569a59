//! Bind group layouts and pipelines: what all passes have in common.

use super::{COLOUR, DEPTH, SAMPLES};

/// One binding's kind.
#[derive(Clone, Copy)]
pub(crate) enum Slot {
    Uniform,
    Storage,
    ShadowMap,
    Comparison,
    Pictures,
    Picture,
    Volume,
    Filtering,
    Samples,
    Mean,
}

pub(crate) fn layout(device: &wgpu::Device, label: &str, slots: &[(u32, Slot)]) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = slots
        .iter()
        .map(|&(binding, slot)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: binding_type(slot),
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

fn binding_type(slot: Slot) -> wgpu::BindingType {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let texture = |sample_type, view_dimension, multisampled| wgpu::BindingType::Texture { sample_type, view_dimension, multisampled };
    let (flat, array) = (wgpu::TextureViewDimension::D2, wgpu::TextureViewDimension::D2Array);
    match slot {
        Slot::Uniform => buffer(wgpu::BufferBindingType::Uniform),
        Slot::Storage => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
        Slot::ShadowMap => texture(wgpu::TextureSampleType::Depth, flat, false),
        Slot::Comparison => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
        Slot::Pictures => texture(wgpu::TextureSampleType::Float { filterable: true }, array, false),
        Slot::Picture => texture(wgpu::TextureSampleType::Float { filterable: true }, flat, false),
        Slot::Volume => texture(wgpu::TextureSampleType::Float { filterable: true }, wgpu::TextureViewDimension::D3, false),
        Slot::Filtering => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        Slot::Samples => texture(wgpu::TextureSampleType::Float { filterable: false }, flat, true),
        Slot::Mean => texture(wgpu::TextureSampleType::Float { filterable: false }, flat, false),
    }
}

/// What differs between the pipelines of the passes.
pub(crate) struct PipelineParts<'a> {
    pub(crate) label: &'a str,
    pub(crate) module: &'a wgpu::ShaderModule,
    pub(crate) layout: &'a wgpu::BindGroupLayout,
    pub(crate) vertex: &'a str,
    pub(crate) buffers: &'a [wgpu::VertexBufferLayout<'a>],
    pub(crate) fragment: Option<&'a str>,
    pub(crate) coverage: bool,
    pub(crate) depth_write: bool,
}

fn pipeline_layout(device: &wgpu::Device, parts: &PipelineParts<'_>) -> wgpu::PipelineLayout {
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(parts.label),
        bind_group_layouts: &[Some(parts.layout)],
        immediate_size: 0,
    })
}

/// A pipeline of the main pass.
pub(crate) fn main_pipeline(device: &wgpu::Device, parts: &PipelineParts<'_>) -> wgpu::RenderPipeline {
    drawing_pipeline(device, parts, SAMPLES, &[COLOUR])
}

/// A pipeline of the pass of outputs beside the picture: one sample a pixel.
pub(crate) fn aov_pipeline(device: &wgpu::Device, parts: &PipelineParts<'_>) -> wgpu::RenderPipeline {
    drawing_pipeline(device, parts, 1, &super::aov::FORMATS)
}

fn drawing_pipeline(
    device: &wgpu::Device,
    parts: &PipelineParts<'_>,
    samples: u32,
    formats: &[wgpu::TextureFormat],
) -> wgpu::RenderPipeline {
    let targets: Vec<_> = formats.iter().map(|format| Some(wgpu::ColorTargetState::from(*format))).collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(parts.label),
        layout: Some(&pipeline_layout(device, parts)),
        vertex: wgpu::VertexState {
            module: parts.module,
            entry_point: Some(parts.vertex),
            compilation_options: Default::default(),
            buffers: parts.buffers,
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(parts.depth_write),
            depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState { count: samples, mask: !0, alpha_to_coverage_enabled: parts.coverage },
        fragment: Some(wgpu::FragmentState {
            module: parts.module,
            entry_point: parts.fragment,
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A pipeline of the shadow pass: depth only.
pub(crate) fn shadow_pipeline(device: &wgpu::Device, parts: &PipelineParts<'_>) -> wgpu::RenderPipeline {
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(parts.label),
        layout: Some(&pipeline_layout(device, parts)),
        vertex: wgpu::VertexState {
            module: parts.module,
            entry_point: Some(parts.vertex),
            compilation_options: Default::default(),
            buffers: parts.buffers,
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::LessEqual),
            stencil: Default::default(),
            bias: wgpu::DepthBiasState { constant: 0, slope_scale: 1.5, clamp: 0.0 },
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: parts.fragment.map(|entry| wgpu::FragmentState {
            module: parts.module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}
