//! Bodies: opaque meshes, one instance per body.

use sward::geometry::mesh::{Mesh, Vertex};
use sward::picture::frame::BodyDraw;

use super::shadow::ShadowMap;
use super::{PipelineParts, Slot, Surroundings, entries, layout, lit_shader, main_pipeline, shadow_pipeline, slots};
use crate::gpu::Gpu;

/// Files of the pass's shader, after the common ones.
pub const PARTS: [&str; 2] = [super::SHADOWS_WGSL, include_str!("bodies.wgsl")];

/// Most bodies in one picture; further ones are not drawn.
pub const MOST: usize = 1024;

/// [`Vertex`].
pub(crate) const VERTICES: wgpu::VertexBufferLayout<'_> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Vertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Float32x2],
};

/// `Body` of `bodies.wgsl`.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct BodyInstance {
    transform: glam::Mat4,
    paint: [f32; 4],
}

pub(crate) struct MeshBuffers {
    pub(crate) vertices: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
    pub(crate) count: u32,
}

pub(crate) struct BodyPass {
    main: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
    main_bindings: wgpu::BindGroup,
    shadow_bindings: wgpu::BindGroup,
    /// `bodies` of `bodies.wgsl`.
    pub(crate) instances: wgpu::Buffer,
    pub(crate) meshes: Vec<MeshBuffers>,
    /// Mesh and instance of every body of this frame.
    pub(crate) drawn: Vec<(usize, u32)>,
}

impl BodyPass {
    pub(crate) fn new(gpu: &Gpu, frame: &wgpu::Buffer, map: &ShadowMap, surroundings: Option<&Surroundings>) -> Self {
        let device = &gpu.device;
        let module = lit_shader(device, "bodies", &PARTS, surroundings);
        let own = [(0, Slot::Uniform), (2, Slot::ShadowMap), (3, Slot::Comparison), (4, Slot::Storage)];
        let main_layout = layout(device, "bodies", &[&own, slots(surroundings)].concat());
        let shadow_layout = layout(device, "body shadows", &[(0, Slot::Uniform), (4, Slot::Storage)]);
        let buffers = [VERTICES];
        let main = main_pipeline(
            device,
            &PipelineParts {
                label: "bodies",
                module: &module,
                layout: &main_layout,
                vertex: "bodies_vertex",
                buffers: &buffers,
                fragment: Some("bodies_fragment"),
                coverage: false,
                depth_write: true,
            },
        );
        let shadow = shadow_pipeline(
            device,
            &PipelineParts {
                label: "body shadows",
                module: &module,
                layout: &shadow_layout,
                vertex: "bodies_shadow_vertex",
                buffers: &buffers,
                fragment: None,
                coverage: false,
                depth_write: true,
            },
        );
        let instances = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("bodies"),
            size: (MOST * size_of::<BodyInstance>()) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let own = [
            wgpu::BindGroupEntry { binding: 0, resource: frame.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&map.view) },
            wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::Sampler(&map.sampler) },
            wgpu::BindGroupEntry { binding: 4, resource: instances.as_entire_binding() },
        ];
        let main_bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("bodies"),
            layout: &main_layout,
            entries: &[&own, &entries(surroundings)[..]].concat(),
        });
        let shadow_bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("body shadows"),
            layout: &shadow_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: frame.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 4, resource: instances.as_entire_binding() },
            ],
        });
        Self { main, shadow, main_bindings, shadow_bindings, instances, meshes: Vec::new(), drawn: Vec::new() }
    }

    pub(crate) fn add_mesh(&mut self, gpu: &Gpu, mesh: &Mesh) -> usize {
        self.put_mesh(gpu, self.meshes.len(), mesh);
        self.meshes.len() - 1
    }

    /// Puts a mesh in place of another, or behind the last one.
    pub(crate) fn put_mesh(&mut self, gpu: &Gpu, index: usize, mesh: &Mesh) {
        let init = |label, contents, usage| gpu.filled(label, contents, usage);
        let buffers = MeshBuffers {
            vertices: init(
                "mesh vertices",
                bytemuck::cast_slice(&mesh.vertices),
                wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            ),
            indices: init("mesh indices", bytemuck::cast_slice(&mesh.indices), wgpu::BufferUsages::INDEX),
            count: mesh.indices.len() as u32,
        };
        match self.meshes.get_mut(index) {
            Some(place) => *place = buffers,
            None => self.meshes.push(buffers),
        }
    }

    /// Moves the vertices of a mesh; a mesh of another size is left alone.
    pub(crate) fn move_mesh(&self, gpu: &Gpu, index: usize, mesh: &Mesh) {
        let bytes: &[u8] = bytemuck::cast_slice(&mesh.vertices);
        if let Some(buffers) = self.meshes.get(index).filter(|buffers| buffers.vertices.size() == bytes.len() as u64) {
            gpu.queue.write_buffer(&buffers.vertices, 0, bytes);
        }
    }

    pub(crate) fn place(&mut self, gpu: &Gpu, bodies: &[BodyDraw]) {
        let known = bodies.iter().filter(|body| body.mesh < self.meshes.len()).take(MOST);
        let (mut instances, mut drawn) = (Vec::new(), Vec::new());
        for body in known {
            drawn.push((body.mesh, instances.len() as u32));
            let [r, g, b] = body.paint;
            instances.push(BodyInstance { transform: body.transform, paint: [r, g, b, body.ground] });
        }
        gpu.queue.write_buffer(&self.instances, 0, bytemuck::cast_slice(&instances));
        self.drawn = drawn;
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.main);
        pass.set_bind_group(0, &self.main_bindings, &[]);
        self.draw_all(pass);
    }

    pub(crate) fn draw_shadow(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.shadow);
        pass.set_bind_group(0, &self.shadow_bindings, &[]);
        self.draw_all(pass);
    }

    fn draw_all(&self, pass: &mut wgpu::RenderPass<'_>) {
        for &(mesh, instance) in &self.drawn {
            let mesh = &self.meshes[mesh];
            if mesh.count > 0 {
                pass.set_vertex_buffer(0, mesh.vertices.slice(..));
                pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..mesh.count, 0, instance..instance + 1);
            }
        }
    }
}
