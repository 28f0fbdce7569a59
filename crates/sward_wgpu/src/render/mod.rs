//! The passes of a picture, one file each. Each assembles its shader by joining the library texts with its own.

pub mod aov;
mod bare;
pub mod blades;
pub mod bodies;
pub mod clump_texture;
pub mod ground;
pub mod growth_maps;
mod height_samples;
mod pipeline;
pub mod plant_pass;
pub mod plants;
pub mod prepare;
mod prepare_pipelines;
pub mod shadow;
pub mod sky;
pub mod targets;

pub(crate) use pipeline::{PipelineParts, Slot, aov_pipeline, layout, main_pipeline, shadow_pipeline};
use sward::geometry::{card, relief, sheet};
use sward::shading;

/// Bindings and structs every drawing pass begins with.
pub const FRAME_WGSL: &str = include_str!("frame.wgsl");
/// Ground height in frame space; goes after [`relief::WGSL`].
pub const HEIGHTS_WGSL: &str = include_str!("heights.wgsl");
/// Reading the shadow map.
pub const SHADOWS_WGSL: &str = include_str!("shadows.wgsl");

/// The full text of a drawing shader: our mathematics (drivers' own sines differ in the fourth digit), shading library, frame, then the pass's own files.
pub fn assemble(parts: &[&str]) -> String {
    let mut text = sward::math::WGSL.to_owned();
    for part in shading::WGSL {
        text.push_str(part);
    }
    for part in [FRAME_WGSL].iter().chain(parts) {
        text.push('\n');
        text.push_str(part);
    }
    text
}

/// Every assembled text with its name, for validation.
pub fn assembled() -> Vec<(&'static str, String)> {
    let mut texts = vec![
        ("bodies", assemble(&bodies::PARTS)),
        ("ground", assemble(&ground::PARTS)),
        ("plants", assemble(&plant_pass::PARTS)),
        ("sheets", assemble(&plant_pass::SHEET_PARTS)),
        ("blades", assemble(&[&[blades::constants().as_str()], &blades::PARTS[..]].concat())),
        ("sky", assemble(&sky::PARTS)),
        ("resolve", assemble(&targets::PARTS)),
        ("resolve, OpenGL", assemble(&targets::MEAN_PARTS)),
    ];
    texts.extend(blades::assembled());
    texts.extend(aov::assembled());
    texts
}

/// Samples per pixel of the main pass.
pub const SAMPLES: u32 = 4;
/// Colour format of the main pass.
pub const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Depth format of all passes. The main pass counts backwards: 1 at the near plane, 0 at infinity.
pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

pub(crate) fn shader(device: &wgpu::Device, label: &str, parts: &[&str]) -> wgpu::ShaderModule {
    device
        .create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(label), source: wgpu::ShaderSource::Wgsl(assemble(parts).into()) })
}
