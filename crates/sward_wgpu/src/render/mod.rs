//! The passes of a picture, one file each. Each assembles its shader by joining the library texts with its own.

pub mod aov;
mod bare;
pub mod blades;
pub mod bodies;
pub mod clump_texture;
pub mod ground;
pub mod growth_maps;
pub(crate) mod height_samples;
pub mod layers;
mod pipeline;
pub mod plant_pass;
pub mod plants;
pub mod prepare;
pub(crate) mod prepare_pipelines;
pub mod shadow;
pub mod sky;
mod surroundings;
pub mod targets;

pub(crate) use pipeline::{PipelineParts, Slot, aov_pipeline, layout, main_pipeline, shadow_pipeline};
pub(crate) use surroundings::{Surroundings, entries, slots};
use sward::geometry::{card, relief, sheet};
use sward::shading;

/// Bindings and structs every drawing pass begins with.
pub const FRAME_WGSL: &str = include_str!("frame.wgsl");
/// Ground height in frame space; goes after [`relief::WGSL`].
pub const HEIGHTS_WGSL: &str = include_str!("heights.wgsl");
/// Light as the scene's settings give it.
const PLAIN_WGSL: &str = include_str!("plain.wgsl");
/// Light of a picture of the surroundings.
const SURROUNDINGS_WGSL: &str = include_str!("surroundings.wgsl");
/// Reading the shadow map.
pub const SHADOWS_WGSL: &str = include_str!("shadows.wgsl");

/// The full text of a drawing shader: our mathematics (drivers' own sines differ in the fourth digit), shading library, frame, then the pass's own files.
pub fn assemble(parts: &[&str]) -> String {
    assemble_in(PLAIN_WGSL, parts)
}

/// The same in surroundings: with light from a picture of them.
pub fn assemble_lit(parts: &[&str]) -> String {
    assemble_in(SURROUNDINGS_WGSL, parts)
}

fn assemble_in(light: &str, parts: &[&str]) -> String {
    let mut text = sward::math::WGSL.to_owned();
    for part in shading::WGSL {
        text.push_str(part);
    }
    for part in [FRAME_WGSL, light].iter().chain(parts) {
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
        ("cut", assemble(&layers::CUT_PARTS)),
        ("layers", assemble(&layers::PARTS)),
        ("sky", assemble(&sky::PARTS)),
        ("resolve", assemble(&targets::PARTS)),
        ("resolve, OpenGL", assemble(&targets::MEAN_PARTS)),
    ];
    texts.extend([
        ("bodies in surroundings", assemble_lit(&bodies::PARTS)),
        ("ground in surroundings", assemble_lit(&ground::PARTS)),
        ("plants in surroundings", assemble_lit(&plant_pass::PARTS)),
        ("sheets in surroundings", assemble_lit(&plant_pass::SHEET_PARTS)),
        ("blades in surroundings", assemble_lit(&[&[blades::constants().as_str()], &blades::PARTS[..]].concat())),
        ("cut in surroundings", assemble_lit(&layers::CUT_PARTS)),
        ("layers in surroundings", assemble_lit(&layers::PARTS)),
        ("sky in surroundings", assemble_lit(&sky::PARTS)),
    ]);
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
    module(device, label, assemble(parts))
}

/// The shader of a pass that light falls on, in surroundings or without.
pub(crate) fn lit_shader(device: &wgpu::Device, label: &str, parts: &[&str], surroundings: Option<&Surroundings>) -> wgpu::ShaderModule {
    module(device, label, if surroundings.is_some() { assemble_lit(parts) } else { assemble(parts) })
}

fn module(device: &wgpu::Device, label: &str, text: String) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(label), source: wgpu::ShaderSource::Wgsl(text.into()) })
}
