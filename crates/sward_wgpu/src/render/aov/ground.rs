//! The ground's outputs.

use super::super::ground::{GroundPass, PARTS, VERTICES};
use super::super::{PipelineParts, Slot, aov_pipeline, layout, shader};
use super::{WGSL, buffers};
use crate::gpu::Gpu;

/// Files of the shader, after the common ones.
pub(super) fn parts() -> Vec<&'static str> {
    [&PARTS[..], &[WGSL, include_str!("ground_aov.wgsl")]].concat()
}

pub(super) struct Ground {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    frame: wgpu::Buffer,
    uniform: wgpu::Buffer,
}

impl Ground {
    pub(super) fn new(gpu: &Gpu, frame: &wgpu::Buffer, uniform: &wgpu::Buffer) -> Self {
        let device = &gpu.device;
        let module = shader(device, "ground, outputs", &parts());
        let layout = layout(device, "ground, outputs", &[(0, Slot::Uniform), (1, Slot::Storage), (9, Slot::Uniform)]);
        let pipeline = aov_pipeline(
            device,
            &PipelineParts {
                label: "ground, outputs",
                module: &module,
                layout: &layout,
                vertex: "ground_aov_vertex",
                buffers: &[VERTICES],
                fragment: Some("aov_fragment"),
                coverage: false,
                depth_write: true,
            },
        );
        Self { pipeline, layout, frame: frame.clone(), uniform: uniform.clone() }
    }

    pub(super) fn draw(&self, gpu: &Gpu, pass: &mut wgpu::RenderPass<'_>, ground: &GroundPass) {
        // The samples move to another buffer when the ground is edited.
        let bound = [(0, &self.frame), (1, &ground.heights.buffer), (9, &self.uniform)];
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &buffers(&gpu.device, "ground, outputs", &self.layout, &bound), &[]);
        ground.draw_grid(pass);
    }
}
