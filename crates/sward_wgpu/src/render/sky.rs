//! The backdrop: air, sun, clouds and the ridges at the edge of the world.

use super::{PipelineParts, Slot, Surroundings, entries, layout, lit_shader, main_pipeline, slots};
use crate::gpu::Gpu;

/// Files of the pass's shader, after the common ones.
pub const PARTS: [&str; 1] = [include_str!("sky.wgsl")];

pub(crate) struct SkyPass {
    pipeline: wgpu::RenderPipeline,
    bindings: wgpu::BindGroup,
}

impl SkyPass {
    pub(crate) fn new(gpu: &Gpu, frame: &wgpu::Buffer, surroundings: Option<&Surroundings>) -> Self {
        let device = &gpu.device;
        let module = lit_shader(device, "sky", &PARTS, surroundings);
        let layout = layout(device, "sky", &[&[(0, Slot::Uniform)], slots(surroundings)].concat());
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
            entries: &[&[wgpu::BindGroupEntry { binding: 0, resource: frame.as_entire_binding() }], &entries(surroundings)[..]].concat(),
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
