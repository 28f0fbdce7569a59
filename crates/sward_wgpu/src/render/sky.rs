//! The backdrop: air, sun, clouds and the ridges at the edge of the world.

use super::{PipelineParts, Slot, layout, main_pipeline, shader};
use crate::gpu::Gpu;

/// Files of the pass's shader, after the common ones.
pub const PARTS: [&str; 1] = [include_str!("sky.wgsl")];

pub(crate) struct SkyPass {
    pipeline: wgpu::RenderPipeline,
    bindings: wgpu::BindGroup,
}

impl SkyPass {
    pub(crate) fn new(gpu: &Gpu, frame: &wgpu::Buffer) -> Self {
        let device = &gpu.device;
        let module = shader(device, "sky", &PARTS);
        let layout = layout(device, "sky", &[(0, Slot::Uniform)]);
        let pipeline = main_pipeline(
            device,
            &PipelineParts {
                label: "sky",
                module: &module,
                layout: &layout,
                vertex: "sky_vertex",
                buffers: &[],
                fragment: Some("sky_fragment"),
                coverage: false,
                depth_write: false,
            },
        );
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("sky"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: frame.as_entire_binding(),
            }],
        });
        Self { pipeline, bindings }
    }

    /// Drawn last: only pixels nothing else covers are shaded.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bindings, &[]);
        pass.draw(0..3, 0..1);
    }
}
