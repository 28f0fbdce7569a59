//! The sky's outputs: its motion.

use super::super::sky::PARTS;
use super::super::{PipelineParts, Slot, aov_pipeline, layout, shader};
use super::{WGSL, buffers};
use crate::gpu::Gpu;

/// Files of the shader, after the common ones.
pub(super) fn parts() -> Vec<&'static str> {
    [&PARTS[..], &[WGSL, include_str!("sky_aov.wgsl")]].concat()
}

pub(super) struct Sky {
    pipeline: wgpu::RenderPipeline,
    bindings: wgpu::BindGroup,
}

impl Sky {
    pub(super) fn new(gpu: &Gpu, frame: &wgpu::Buffer, uniform: &wgpu::Buffer) -> Self {
        let device = &gpu.device;
        let module = shader(device, "sky, outputs", &parts());
        let layout = layout(device, "sky, outputs", &[(0, Slot::Uniform), (9, Slot::Uniform)]);
        let pipeline = aov_pipeline(
            device,
            &PipelineParts {
                label: "sky, outputs",
                module: &module,
                layout: &layout,
                vertex: "sky_aov_vertex",
                buffers: &[],
                fragment: Some("sky_aov_fragment"),
                coverage: false,
                depth_write: false,
            },
        );
        let bindings = buffers(device, "sky, outputs", &layout, &[(0, frame), (9, uniform)]);
        Self { pipeline, bindings }
    }

    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bindings, &[]);
        pass.draw(0..3, 0..1);
    }
}
