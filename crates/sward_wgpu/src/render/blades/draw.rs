//! The passes that draw blades: strips of triangles, many blades an instance.

use std::collections::HashMap;

use sward::picture::blade_plan::{BLADES_PER_INSTANCE, LEVELS};

use super::BladeDraw;
use crate::gpu::Gpu;
use crate::render::shadow::ShadowMap;
use crate::render::{PipelineParts, Slot, Surroundings, entries, layout, lit_shader, main_pipeline, shadow_pipeline, slots};

/// Files of the passes' shader, after the common ones and [`super::constants`].
pub(crate) const PARTS: [&str; 4] =
    [sward::geometry::blade::WGSL, crate::render::SHADOWS_WGSL, include_str!("strip.wgsl"), include_str!("draw.wgsl")];

/// Blades of one stand with one number of pieces, made ready for this frame.
pub(crate) struct Level<'a> {
    /// Records, numbers found, draw arguments.
    pub(crate) filled: &'a [wgpu::Buffer; 3],
    pub(crate) style: wgpu::Buffer,
    /// Number of pieces' place in the arguments.
    number: usize,
    pieces: u32,
    main: wgpu::BindGroup,
    shadow: wgpu::BindGroup,
}

/// Near to far.
#[derive(Default)]
pub(crate) struct ReadyBlades<'a>(pub(crate) Vec<Level<'a>>);

pub(crate) struct BladePass {
    main: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
    main_layout: wgpu::BindGroupLayout,
    shadow_layout: wgpu::BindGroupLayout,
    surroundings: Option<Surroundings>,
    /// By number of pieces.
    indices: HashMap<u32, wgpu::Buffer>,
}

impl BladePass {
    pub(crate) fn new(gpu: &Gpu, surroundings: Option<&Surroundings>) -> Self {
        let device = &gpu.device;
        let constants = super::constants();
        let module = lit_shader(device, "blades", &[&[constants.as_str()], &PARTS[..]].concat(), surroundings);
        let own = [(0, Slot::Uniform), (4, Slot::Storage), (5, Slot::Storage), (6, Slot::Uniform)];
        let shadow_layout = layout(device, "blade shadows", &own);
        let main_layout =
            layout(device, "blades", &[&own[..], &[(2, Slot::ShadowMap), (3, Slot::Comparison)], slots(surroundings)].concat());
        let parts = |label, layout, vertex, fragment, coverage| PipelineParts {
            label,
            module: &module,
            layout,
            vertex,
            buffers: &[],
            fragment,
            coverage,
            depth_write: true,
        };
        let main = main_pipeline(device, &parts("blades", &main_layout, "blades_vertex", Some("blades_fragment"), true));
        let shadow = shadow_pipeline(device, &parts("blade shadows", &shadow_layout, "blades_shadow_vertex", None, false));
        Self { main, shadow, main_layout, shadow_layout, surroundings: surroundings.cloned(), indices: HashMap::new() }
    }

    /// Makes what the stands need.
    pub(crate) fn ready<'a>(&mut self, gpu: &Gpu, frame: &wgpu::Buffer, map: &ShadowMap, draws: &[BladeDraw<'a>]) -> ReadyBlades<'a> {
        let mut levels = Vec::new();
        for level in 0..LEVELS {
            for draw in draws {
                let Some(filled) = &draw.buffers.filled else { continue };
                let pieces = draw.styles[level].shape[0];
                self.indices.entry(pieces).or_insert_with(|| index_buffer(gpu, pieces));
                let style = gpu.filled("blade style", bytemuck::bytes_of(&draw.styles[level]), wgpu::BufferUsages::UNIFORM);
                let [records, found, _] = filled;
                let own = [(0, frame), (4, records), (5, found), (6, &style)]
                    .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() });
                let bound = |label: &str, layout: &wgpu::BindGroupLayout, entries: &[wgpu::BindGroupEntry<'_>]| {
                    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries })
                };
                let shadow = bound("blade shadows", &self.shadow_layout, &own);
                let map = [
                    wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&map.view) },
                    wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::Sampler(&map.sampler) },
                ];
                let main = bound("blades", &self.main_layout, &[&own[..], &map, &entries(self.surroundings.as_ref())].concat());
                levels.push(Level { filled, style, number: level, pieces, main, shadow });
            }
        }
        ReadyBlades(levels)
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, ready: &ReadyBlades<'_>) {
        pass.set_pipeline(&self.main);
        for level in &ready.0 {
            pass.set_bind_group(0, &level.main, &[]);
            self.draw_level(pass, level);
        }
    }

    pub(crate) fn draw_shadow(&self, pass: &mut wgpu::RenderPass<'_>, ready: &ReadyBlades<'_>) {
        pass.set_pipeline(&self.shadow);
        for level in &ready.0 {
            pass.set_bind_group(0, &level.shadow, &[]);
            self.draw_level(pass, level);
        }
    }

    /// Draws with whatever pipeline is set.
    pub(crate) fn draw_level(&self, pass: &mut wgpu::RenderPass<'_>, level: &Level<'_>) {
        if let Some(indices) = self.indices.get(&level.pieces) {
            pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint16);
            pass.draw_indexed_indirect(&level.filled[2], 20 * level.number as u64);
        }
    }
}

/// Triangles of an instance's strips: two for each piece, one for the last.
fn index_buffer(gpu: &Gpu, pieces: u32) -> wgpu::Buffer {
    let corners = 2 * pieces + 1;
    let firsts = (0..BLADES_PER_INSTANCE).flat_map(|blade| (0..2 * pieces - 1).map(move |at| blade * corners + at));
    let indices: Vec<u16> = firsts.flat_map(|at| [at, at + 1, at + 2]).map(|index| index as u16).collect();
    gpu.filled("blade indices", bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX)
}
