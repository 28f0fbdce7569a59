//! The outputs of bodies.

use sward::geometry::mesh::Vertex;

use super::super::bodies::{BodyPass, MOST, PARTS, VERTICES};
use super::super::{PipelineParts, Slot, aov_pipeline, layout, shader};
use super::{Before, WGSL, buffers};
use crate::gpu::Gpu;

/// Files of the shader, after the common ones.
pub(super) fn parts() -> Vec<&'static str> {
    [&PARTS[..], &[WGSL, include_str!("bodies_aov.wgsl")]].concat()
}

/// Where a corner was in its body: the position of a [`Vertex`].
const THEN: wgpu::VertexBufferLayout<'_> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Vertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![4 => Float32x3],
};

/// `BodyThen` of `bodies_aov.wgsl`.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct BodyThen {
    transform: glam::Mat4,
    number: [u32; 4],
}

pub(super) struct Bodies {
    pipeline: wgpu::RenderPipeline,
    bindings: wgpu::BindGroup,
    then: wgpu::Buffer,
}

impl Bodies {
    pub(super) fn new(gpu: &Gpu, frame: &wgpu::Buffer, uniform: &wgpu::Buffer, instances: &wgpu::Buffer) -> Self {
        let device = &gpu.device;
        let module = shader(device, "bodies, outputs", &parts());
        let slots = [(0, Slot::Uniform), (4, Slot::Storage), (9, Slot::Uniform), (10, Slot::Storage)];
        let layout = layout(device, "bodies, outputs", &slots);
        let pipeline = aov_pipeline(
            device,
            &PipelineParts {
                label: "bodies, outputs",
                module: &module,
                layout: &layout,
                vertex: "bodies_aov_vertex",
                buffers: &[VERTICES, THEN],
                fragment: Some("aov_fragment"),
                coverage: false,
                depth_write: true,
            },
        );
        let then = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("bodies before"),
            size: (MOST * size_of::<BodyThen>()) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bindings = buffers(device, "bodies, outputs", &layout, &[(0, frame), (4, instances), (9, uniform), (10, &then)]);
        Self { pipeline, bindings, then }
    }

    /// Puts the bodies where they were; the answer is the vertices of meshes that moved in themselves, by number.
    pub(super) fn place(&self, gpu: &Gpu, before: &Before<'_>) -> Vec<(usize, wgpu::Buffer)> {
        let then = before.bodies.iter().take(MOST);
        let then: Vec<BodyThen> = then.map(|body| BodyThen { transform: body.transform, number: [body.number, 0, 0, 0] }).collect();
        gpu.queue.write_buffer(&self.then, 0, bytemuck::cast_slice(&then));
        let vertices = |contents: &[u8]| gpu.filled("mesh before", contents, wgpu::BufferUsages::VERTEX);
        before.meshes.iter().map(|(mesh, moved)| (*mesh, vertices(bytemuck::cast_slice(&moved.vertices)))).collect()
    }

    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, bodies: &BodyPass, moved: &[(usize, wgpu::Buffer)]) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bindings, &[]);
        for &(index, instance) in &bodies.drawn {
            let mesh = &bodies.meshes[index];
            if mesh.count == 0 {
                continue;
            }
            // A mesh of another size is not this one.
            let then = moved.iter().find(|(moved, buffer)| *moved == index && buffer.size() == mesh.vertices.size());
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_vertex_buffer(1, then.map_or(&mesh.vertices, |(_, buffer)| buffer).slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..mesh.count, 0, instance..instance + 1);
        }
    }
}
