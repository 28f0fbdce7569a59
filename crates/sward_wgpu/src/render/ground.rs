//! Terrain: a grid of rings displaced by the height field, coloured as turf and distant canopy.

use sward::geometry::relief::Relief;
use sward::geometry::rings;
use sward::growth::Near;
use sward::shading::look::Turf;
use sward::terrain::Terrain;

use super::bare::BareGround;
use super::height_samples::HeightSamples;
use super::{PipelineParts, Slot, Surroundings, entries, layout, lit_shader, main_pipeline, slots};
use crate::gpu::Gpu;

/// Files of the pass's shader, after the common ones.
pub const PARTS: [&str; 6] = [
    sward::terrain::DETAIL_WGSL,
    super::relief::WGSL,
    super::HEIGHTS_WGSL,
    super::SHADOWS_WGSL,
    sward::growth::WGSL,
    include_str!("ground.wgsl"),
];

/// x, z in frame space, and the grid's spacing.
pub(crate) const VERTICES: wgpu::VertexBufferLayout<'_> = wgpu::VertexBufferLayout {
    array_stride: 12,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3],
};

/// The ground's pass.
pub(crate) struct GroundPass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    /// Always bound: frame, shadow map, turf.
    frame: wgpu::Buffer,
    shadow: (wgpu::TextureView, wgpu::Sampler),
    turf: wgpu::Buffer,
    surroundings: Option<Surroundings>,
    /// The terrain's samples.
    pub(crate) heights: HeightSamples,
    bare: BareGround,
    /// Made anew when a buffer has been replaced.
    bindings: Option<wgpu::BindGroup>,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    count: u32,
}

impl GroundPass {
    pub(crate) fn new(
        gpu: &Gpu,
        frame: &wgpu::Buffer,
        shadow: &super::shadow::ShadowMap,
        surroundings: Option<&Surroundings>,
        relief: &Relief,
        turf: Turf,
    ) -> Self {
        let device = &gpu.device;
        let module = lit_shader(device, "ground", &PARTS, surroundings);
        let own = [
            (0, Slot::Uniform),
            (1, Slot::Storage),
            (2, Slot::ShadowMap),
            (3, Slot::Comparison),
            (4, Slot::Uniform),
            (5, Slot::Uniform),
            (6, Slot::Storage),
        ];
        let layout = layout(device, "ground", &[&own, slots(surroundings)].concat());
        let pipeline = main_pipeline(
            device,
            &PipelineParts {
                label: "ground",
                module: &module,
                layout: &layout,
                vertex: "ground_vertex",
                buffers: &[VERTICES],
                fragment: Some("ground_fragment"),
                coverage: false,
                depth_write: true,
            },
        );
        let init = |label, contents, usage| gpu.filled(label, contents, usage);
        let heights = HeightSamples::new(gpu, &relief.heights, &Default::default());
        let turf = init("turf", bytemuck::bytes_of(&turf), wgpu::BufferUsages::UNIFORM);
        // All grids have the same number of vertices; holes never make the index list longer than the first.
        let grid = rings::build([0.0; 2], [0.0; 2]);
        let vertices =
            init("ground vertices", bytemuck::cast_slice(&grid.vertices), wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST);
        let indices = init("ground indices", bytemuck::cast_slice(&grid.indices), wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST);
        Self {
            pipeline,
            layout,
            frame: frame.clone(),
            shadow: (shadow.view.clone(), shadow.sampler.clone()),
            turf,
            surroundings: surroundings.cloned(),
            heights,
            bare: BareGround::new(gpu),
            bindings: None,
            vertices,
            indices,
            count: grid.indices.len() as u32,
        }
    }

    /// Follows what was added to the ground, and says where it is bare.
    pub(crate) fn lay(&mut self, gpu: &Gpu, terrain: &Terrain, growth: &Near) {
        let replaced = self.heights.follow(gpu, terrain);
        if self.bare.write(gpu, growth) || replaced || self.bindings.is_none() {
            self.bindings = Some(self.bind(gpu));
        }
    }

    fn bind(&self, gpu: &Gpu) -> wgpu::BindGroup {
        let texture = wgpu::BindingResource::TextureView(&self.shadow.0);
        let resources = [
            self.frame.as_entire_binding(),
            self.heights.buffer.as_entire_binding(),
            texture,
            wgpu::BindingResource::Sampler(&self.shadow.1),
            self.turf.as_entire_binding(),
            self.bare.block.as_entire_binding(),
            self.bare.words.as_entire_binding(),
        ];
        let entry = |(binding, resource)| wgpu::BindGroupEntry { binding: binding as u32, resource };
        let entries: Vec<_> = resources.into_iter().enumerate().map(entry).chain(entries(self.surroundings.as_ref())).collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("ground"), layout: &self.layout, entries: &entries })
    }

    /// Moves the grid under the camera.
    pub(crate) fn place(&mut self, gpu: &Gpu, camera: [f32; 2], origin: [f64; 2]) {
        let phase = [origin[0].rem_euclid(1024.0) as f32, origin[1].rem_euclid(1024.0) as f32];
        let grid = rings::build(camera, phase);
        gpu.queue.write_buffer(&self.vertices, 0, bytemuck::cast_slice(&grid.vertices));
        let fits = grid.indices.len().min(self.indices.size() as usize / 4);
        gpu.queue.write_buffer(&self.indices, 0, bytemuck::cast_slice(&grid.indices[..fits]));
        self.count = fits as u32;
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(bindings) = &self.bindings else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, bindings, &[]);
        self.draw_grid(pass);
    }

    /// Draws the grid with whatever pipeline is set.
    pub(crate) fn draw_grid(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.count, 0, 0..1);
    }
}
