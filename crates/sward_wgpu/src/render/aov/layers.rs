//! The outputs of plants cut into layers.

use sward::geometry::layers::{LayerDraw, NONE};

use super::super::layers::{LayerPass, PARTS, ReadyLayers, WaveBuffers};
use super::super::{PipelineParts, Slot, aov_pipeline, layout, shader};
use super::{Before, Drawn, WGSL};
use crate::gpu::Gpu;

/// Files of the shader, after the common ones.
pub(super) fn parts() -> Vec<&'static str> {
    [&PARTS[..], &[WGSL, include_str!("layers_aov.wgsl")]].concat()
}

pub(super) struct Layers {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl Layers {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let module = shader(device, "layers, outputs", &parts());
        let slots = [
            (0, Slot::Uniform),
            (4, Slot::Storage),
            (5, Slot::Storage),
            (6, Slot::Storage),
            (7, Slot::Picture),
            (8, Slot::Picture),
            (9, Slot::Uniform),
            (11, Slot::Filtering),
        ];
        let layout = layout(device, "layers, outputs", &slots);
        let pipeline = aov_pipeline(
            device,
            &PipelineParts {
                label: "layers, outputs",
                module: &module,
                layout: &layout,
                vertex: "layers_aov_vertex",
                buffers: &[],
                fragment: Some("layers_aov_fragment"),
                coverage: false,
                depth_write: true,
            },
        );
        Self { pipeline, layout }
    }

    /// Binds the camera's cuts; waves and draws of the picture before follow those of this one.
    pub(super) fn ready(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        uniform: &wgpu::Buffer,
        (pass, ready): (&LayerPass, &ReadyLayers),
        drawn: &Drawn<'_>,
        before: &Before<'_>,
    ) -> Vec<wgpu::BindGroup> {
        let waves: Vec<WaveBuffers> =
            ready.waves.iter().zip(before.waves).map(|(now, then)| WaveBuffers::joined(gpu, encoder, now, then)).collect();
        let mut then = Vec::new();
        for (cut, layers) in ready.cuts().iter().zip(before.layers) {
            let behind =
                ready.waves.get(cut.stand).map_or([0; 2], |now| [now.notes.size() / 8, now.touches.size() / 8].map(|cells| cells as u32));
            then.extend(layers.iter().map(|draw| {
                let [younger, older, touch, side] = draw.notes;
                let touch = if touch == NONE { NONE } else { touch + behind[1] };
                LayerDraw { notes: [younger + behind[0], older + behind[0], touch, side], ..*draw }
            }));
        }
        let draws: Vec<LayerDraw> = ready.draws.iter().take(then.len()).chain(&then).copied().collect();
        let draws = gpu.filled("layers, now and then", bytemuck::cast_slice(&draws), wgpu::BufferUsages::STORAGE);
        let group = |cut: &super::super::layers::ReadyCut| {
            let waves = waves.get(cut.stand)?;
            Some(pass.bind_with(gpu, &self.layout, drawn.frame, &draws, waves, cut.key, &[(9, uniform)]))
        };
        ready.cuts().iter().filter_map(group).flatten().collect()
    }

    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, layers: &ReadyLayers, groups: &[wgpu::BindGroup]) {
        pass.set_pipeline(&self.pipeline);
        for (cut, group) in layers.cuts().iter().zip(groups) {
            pass.set_bind_group(0, group, &[]);
            pass.draw(0..cut.vertices, cut.layers.clone());
        }
    }
}
