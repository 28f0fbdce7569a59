//! The passes of a picture, one file each. Each assembles its shader by joining the library texts with its own.

pub mod bodies;
pub mod clump_texture;
pub mod frame;
pub mod grid;
pub mod ground;
pub mod plants;
pub mod shadow;
pub mod sky;
pub mod targets;

use sward::shading;

/// Bindings and structs every drawing pass begins with.
pub const FRAME_WGSL: &str = include_str!("frame.wgsl");
/// Ground height in frame space.
pub const HEIGHTS_WGSL: &str = include_str!("heights.wgsl");
/// Reading the shadow map.
pub const SHADOWS_WGSL: &str = include_str!("shadows.wgsl");

/// The full text of a drawing shader: shading library, frame, then the pass's own files.
pub fn assemble(parts: &[&str]) -> String {
    let mut text = shading::WGSL.join("\n");
    for part in [FRAME_WGSL].iter().chain(parts) {
        text.push('\n');
        text.push_str(part);
    }
    text
}

/// Every assembled text with its name, for validation.
pub fn assembled() -> Vec<(&'static str, String)> {
    vec![
        ("bodies", assemble(&bodies::PARTS)),
        ("ground", assemble(&ground::PARTS)),
        ("plants", assemble(&plants::PARTS)),
        ("sky", assemble(&sky::PARTS)),
        ("resolve", assemble(&targets::PARTS)),
    ]
}

/// Samples per pixel of the main pass.
pub const SAMPLES: u32 = 4;
/// Colour format of the main pass.
pub const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Depth format of all passes. The main pass counts backwards: 1 at the near plane, 0 at infinity.
pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

pub(crate) fn shader(device: &wgpu::Device, label: &str, parts: &[&str]) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(assemble(parts).into()),
    })
}

/// One binding's kind.
#[derive(Clone, Copy)]
pub(crate) enum Slot {
    Uniform,
    Storage,
    ShadowMap,
    Comparison,
    Pictures,
    Filtering,
    Samples,
}

pub(crate) fn layout(
    device: &wgpu::Device,
    label: &str,
    slots: &[(u32, Slot)],
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = slots
        .iter()
        .map(|&(binding, slot)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: binding_type(slot),
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

fn binding_type(slot: Slot) -> wgpu::BindingType {
    let buffer = |ty| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let texture = |sample_type, view_dimension, multisampled| wgpu::BindingType::Texture {
        sample_type,
        view_dimension,
        multisampled,
    };
    let (flat, array) = (
        wgpu::TextureViewDimension::D2,
        wgpu::TextureViewDimension::D2Array,
    );
    match slot {
        Slot::Uniform => buffer(wgpu::BufferBindingType::Uniform),
        Slot::Storage => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
        Slot::ShadowMap => texture(wgpu::TextureSampleType::Depth, flat, false),
        Slot::Comparison => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
        Slot::Pictures => texture(
            wgpu::TextureSampleType::Float { filterable: true },
            array,
            false,
        ),
        Slot::Filtering => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        Slot::Samples => texture(
            wgpu::TextureSampleType::Float { filterable: false },
            flat,
            true,
        ),
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
pub(crate) fn main_pipeline(
    device: &wgpu::Device,
    parts: &PipelineParts<'_>,
) -> wgpu::RenderPipeline {
    let target = Some(wgpu::ColorTargetState::from(COLOUR));
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
        multisample: wgpu::MultisampleState {
            count: SAMPLES,
            mask: !0,
            alpha_to_coverage_enabled: parts.coverage,
        },
        fragment: Some(wgpu::FragmentState {
            module: parts.module,
            entry_point: parts.fragment,
            compilation_options: Default::default(),
            targets: &[target],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A pipeline of the shadow pass: depth only.
pub(crate) fn shadow_pipeline(
    device: &wgpu::Device,
    parts: &PipelineParts<'_>,
) -> wgpu::RenderPipeline {
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
            bias: wgpu::DepthBiasState {
                constant: 0,
                slope_scale: 1.5,
                clamp: 0.0,
            },
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
