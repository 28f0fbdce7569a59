//! The outputs of plants.

use super::super::plant_pass::{PARTS, Ready, SHEET_PARTS};
use super::super::{PipelineParts, Slot, aov_pipeline, layout, shader};
use super::{Drawn, WGSL};
use crate::gpu::Gpu;

/// Files of the shader for cards, after the common ones.
pub(super) fn parts() -> Vec<&'static str> {
    [&PARTS[..], &[WGSL, include_str!("plants_aov.wgsl"), include_str!("cards_then.wgsl")]].concat()
}

/// The same for sheets.
pub(super) fn sheet_parts() -> Vec<&'static str> {
    [&SHEET_PARTS[..], &[WGSL, include_str!("plants_aov.wgsl"), include_str!("sheets_then.wgsl")]].concat()
}

pub(super) struct Plants {
    cards: wgpu::RenderPipeline,
    /// Made when there are sheets.
    sheets: Option<wgpu::RenderPipeline>,
    layout: wgpu::BindGroupLayout,
}

impl Plants {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let slots = [
            (0, Slot::Uniform),
            (4, Slot::Storage),
            (5, Slot::Storage),
            (6, Slot::Uniform),
            (7, Slot::Pictures),
            (8, Slot::Filtering),
            (9, Slot::Uniform),
            (10, Slot::Storage),
            (11, Slot::Storage),
        ];
        let layout = layout(device, "plants, outputs", &slots);
        Self { cards: pipeline(gpu, &layout, &parts()), sheets: None, layout }
    }

    /// Makes what the batches need; `before` holds plants and joints of each as they were. `None` for a batch that has none.
    pub(super) fn ready(
        &mut self,
        gpu: &Gpu,
        uniform: &wgpu::Buffer,
        drawn: &Drawn<'_>,
        before: &[[&wgpu::Buffer; 2]],
    ) -> Vec<Option<wgpu::BindGroup>> {
        if self.sheets.is_none() && drawn.ready.0.iter().any(|ready| ready.batch.is_sheet()) {
            self.sheets = Some(pipeline(gpu, &self.layout, &sheet_parts()));
        }
        drawn.ready.0.iter().map(|ready| self.bind(gpu, uniform, drawn, ready, before.get(ready.number)?)).collect()
    }

    fn bind(
        &self,
        gpu: &Gpu,
        uniform: &wgpu::Buffer,
        drawn: &Drawn<'_>,
        ready: &Ready<'_>,
        [plants_then, joints_then]: &[&wgpu::Buffer; 2],
    ) -> Option<wgpu::BindGroup> {
        let (batch, clumps) = (&ready.batch, &drawn.plants.clumps);
        let buffers = [
            (0, drawn.frame),
            (4, batch.plants),
            (5, batch.joints),
            (6, drawn.plants.style(batch)?),
            (9, uniform),
            (10, plants_then),
            (11, joints_then),
        ];
        let mut entries = buffers.map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() }).to_vec();
        entries.push(wgpu::BindGroupEntry { binding: 7, resource: wgpu::BindingResource::TextureView(&clumps.view) });
        entries.push(wgpu::BindGroupEntry { binding: 8, resource: wgpu::BindingResource::Sampler(&clumps.sampler) });
        let label = Some("plants, outputs");
        Some(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label, layout: &self.layout, entries: &entries }))
    }

    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, drawn: &Drawn<'_>, ready: &[Option<wgpu::BindGroup>]) {
        for (batch, bindings) in drawn.ready.0.iter().map(|ready| &ready.batch).zip(ready) {
            if let Some(bindings) = bindings {
                pass.set_pipeline(self.sheets.as_ref().filter(|_| batch.is_sheet()).unwrap_or(&self.cards));
                pass.set_bind_group(0, bindings, &[]);
                drawn.plants.draw_batch(pass, batch);
            }
        }
    }
}

fn pipeline(gpu: &Gpu, layout: &wgpu::BindGroupLayout, parts: &[&str]) -> wgpu::RenderPipeline {
    let module = shader(&gpu.device, "plants, outputs", parts);
    aov_pipeline(
        &gpu.device,
        &PipelineParts {
            label: "plants, outputs",
            module: &module,
            layout,
            vertex: "plants_aov_vertex",
            buffers: &[],
            fragment: Some("plants_aov_fragment"),
            coverage: false,
            depth_write: true,
        },
    )
}
