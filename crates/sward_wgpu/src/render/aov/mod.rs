//! The pass of outputs beside the picture: depth, motion and plants of each pixel, of one sample. Nothing of it exists until it is asked
//! for.

mod blades;
mod bodies;
mod ground;
mod layers;
mod plants;
mod read;
mod sky;

use sward::geometry::layers::LayerDraw;
use sward::geometry::mesh::Mesh;
use sward::picture::aov::AovUniform;
use sward::picture::frame::BodyDraw;

use super::blades::{BladePass, ReadyBlades};
use super::bodies::BodyPass;
use super::ground::GroundPass;
use super::layers::{LayerPass, ReadyLayers, WaveBuffers};
use super::plant_pass::{PlantPass, ReadyPlants};
use super::{DEPTH, assemble};
use crate::gpu::Gpu;

/// Depth, motion, plant: 16 of the 32 bytes a sample that WebGPU grants.
pub const FORMATS: [wgpu::TextureFormat; 3] = [wgpu::TextureFormat::R32Float, wgpu::TextureFormat::Rg32Float, wgpu::TextureFormat::R32Uint];

/// What all shaders of the pass share.
const WGSL: &str = include_str!("aov.wgsl");

/// Every assembled text with its name, for validation.
pub fn assembled() -> [(&'static str, String); 7] {
    [
        ("blades, outputs", assemble(&[&[super::blades::constants().as_str()], &blades::parts()[..]].concat())),
        ("bodies, outputs", assemble(&bodies::parts())),
        ("ground, outputs", assemble(&ground::parts())),
        ("layers, outputs", assemble(&layers::parts())),
        ("plants, outputs", assemble(&plants::parts())),
        ("sheets, outputs", assemble(&plants::sheet_parts())),
        ("sky, outputs", assemble(&sky::parts())),
    ]
}

/// Where everything was in the picture before.
pub struct Before<'a> {
    /// The camera.
    pub camera: AovUniform,
    /// The bodies of the picture, in its order, as they were.
    pub bodies: &'a [BodyDraw],
    /// Meshes whose vertices were elsewhere in their bodies, by number.
    pub meshes: &'a [(usize, Mesh)],
    /// For each batch of the picture, in its order, buffers of the same plants and joints as they were; `layer` is the plant's number.
    pub plants: &'a [[&'a wgpu::Buffer; 2]],
    /// For each of the camera's cuts of plants, in the picture's order, its layers as they were.
    pub layers: &'a [Vec<LayerDraw>],
    /// The waves that moved them, of each stand of meshes.
    pub waves: &'a [WaveBuffers],
}

/// The passes of a picture that were drawn already, with their buffers.
pub(crate) struct Drawn<'a> {
    pub(crate) frame: &'a wgpu::Buffer,
    pub(crate) ground: &'a GroundPass,
    pub(crate) bodies: &'a BodyPass,
    pub(crate) plants: &'a PlantPass,
    pub(crate) ready: &'a ReadyPlants<'a>,
    pub(crate) blades: Option<&'a BladePass>,
    pub(crate) ready_blades: &'a ReadyBlades<'a>,
    pub(crate) layers: Option<(&'a LayerPass, &'a ReadyLayers)>,
}

pub(crate) struct AovPass {
    uniform: wgpu::Buffer,
    bodies: bodies::Bodies,
    ground: ground::Ground,
    plants: plants::Plants,
    /// Made when there are blades.
    blades: Option<blades::Blades>,
    /// Made when there are stands of meshes.
    layers: Option<layers::Layers>,
    sky: sky::Sky,
    targets: Option<Targets>,
}

/// Textures of one picture size.
struct Targets {
    size: [u32; 2],
    outputs: [wgpu::Texture; 3],
    depth: wgpu::TextureView,
}

impl Targets {
    fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let texture = |label, format, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let depth = texture("depth of outputs", DEPTH, wgpu::TextureUsages::empty()).create_view(&Default::default());
        Self { size, outputs: FORMATS.map(|format| texture("outputs", format, wgpu::TextureUsages::COPY_SRC)), depth }
    }

    fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        let views = self.outputs.each_ref().map(|texture| texture.create_view(&Default::default()));
        let attachments = views.each_ref().map(|view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
            })
        });
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("outputs"),
            color_attachments: &attachments,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }
}

impl AovPass {
    pub(crate) fn new(gpu: &Gpu, frame: &wgpu::Buffer, bodies: &BodyPass) -> Self {
        let uniform = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture before"),
            size: size_of::<AovUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self {
            bodies: bodies::Bodies::new(gpu, frame, &uniform, &bodies.instances),
            ground: ground::Ground::new(gpu, frame, &uniform),
            plants: plants::Plants::new(gpu),
            blades: None,
            layers: None,
            sky: sky::Sky::new(gpu, frame, &uniform),
            targets: None,
            uniform,
        }
    }

    /// Draws the outputs of a picture that was drawn already.
    pub(crate) fn draw(&mut self, gpu: &Gpu, drawn: &Drawn<'_>, before: &Before<'_>, size: [u32; 2]) {
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&before.camera));
        let ready = self.plants.ready(gpu, &self.uniform, drawn, before.plants);
        let moved = self.bodies.place(gpu, before);
        let blades = drawn.blades.map(|pass| {
            let outputs = self.blades.get_or_insert_with(|| blades::Blades::new(gpu));
            (pass, outputs.ready(gpu, &self.uniform, drawn))
        });
        let targets = self.targets.take().filter(|targets| targets.size == size).unwrap_or_else(|| Targets::new(gpu, size));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let cut = drawn.layers.map(|of| {
            let outputs = self.layers.get_or_insert_with(|| layers::Layers::new(gpu));
            (of.1, outputs.ready(gpu, &mut encoder, &self.uniform, of, drawn, before))
        });
        {
            let mut pass = targets.begin(&mut encoder);
            self.bodies.draw(&mut pass, drawn.bodies, &moved);
            self.plants.draw(&mut pass, drawn, &ready);
            if let (Some((blade_pass, ready)), Some(outputs)) = (&blades, &self.blades) {
                outputs.draw(&mut pass, (blade_pass, drawn.ready_blades), ready);
            }
            if let (Some((ready, groups)), Some(outputs)) = (&cut, &self.layers) {
                outputs.draw(&mut pass, ready, groups);
            }
            self.ground.draw(gpu, &mut pass, drawn.ground);
            self.sky.draw(&mut pass);
        }
        gpu.queue.submit([encoder.finish()]);
        self.targets = Some(targets);
    }
}

/// A bind group of buffers at the places of their layout.
fn buffers(device: &wgpu::Device, label: &str, layout: &wgpu::BindGroupLayout, bound: &[(u32, &wgpu::Buffer)]) -> wgpu::BindGroup {
    let entries: Vec<_> =
        bound.iter().map(|(binding, buffer)| wgpu::BindGroupEntry { binding: *binding, resource: buffer.as_entire_binding() }).collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}
