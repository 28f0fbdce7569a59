//! The outputs of blades.

use super::super::blades::{BladePass, Level, PARTS, ReadyBlades, constants};
use super::super::{PipelineParts, Slot, aov_pipeline, layout, shader};
use super::{Drawn, WGSL, buffers};
use crate::gpu::Gpu;

/// Files of the shader, after the common ones and the constants.
pub(super) fn parts() -> Vec<&'static str> {
    [&PARTS[..], &[WGSL, include_str!("blades_aov.wgsl")]].concat()
}

pub(super) struct Blades {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl Blades {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let constants = constants();
        let module = shader(device, "blades, outputs", &[&[constants.as_str()], &parts()[..]].concat());
        let slots = [(0, Slot::Uniform), (4, Slot::Storage), (5, Slot::Storage), (6, Slot::Uniform), (9, Slot::Uniform)];
        let layout = layout(device, "blades, outputs", &slots);
        let pipeline = aov_pipeline(
            device,
            &PipelineParts {
                label: "blades, outputs",
                module: &module,
                layout: &layout,
                vertex: "blades_aov_vertex",
                buffers: &[],
                fragment: Some("blades_aov_fragment"),
                coverage: false,
                depth_write: true,
            },
        );
        Self { pipeline, layout }
    }

    pub(super) fn ready(&self, gpu: &Gpu, uniform: &wgpu::Buffer, drawn: &Drawn<'_>) -> Vec<wgpu::BindGroup> {
        let group = |level: &Level<'_>| {
            let [records, found, _] = level.filled;
            let bound = [(0, drawn.frame), (4, records), (5, found), (6, &level.style), (9, uniform)];
            buffers(&gpu.device, "blades, outputs", &self.layout, &bound)
        };
        drawn.ready_blades.0.iter().map(group).collect()
    }

    pub(super) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        (blades, levels): (&BladePass, &ReadyBlades<'_>),
        ready: &[wgpu::BindGroup],
    ) {
        pass.set_pipeline(&self.pipeline);
        for (level, group) in levels.0.iter().zip(ready) {
            pass.set_bind_group(0, group, &[]);
            blades.draw_level(pass, level);
        }
    }
}
