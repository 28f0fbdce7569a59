//! The mesh of a stand on the GPU: triangles by finish, and their pictures.

use sward::specimen::{Kind, Picture, Specimen, SpecimenVertex};

use crate::gpu::Gpu;

/// Most bytes of one vertex buffer.
const MOST_BYTES: usize = 96 << 20;

/// How vertices lie in their buffer.
pub(super) const VERTICES: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<SpecimenVertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Snorm8x4, 2 => Float16x2, 3 => Float32x3],
};

/// `Finish` of `cut.wgsl`.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct FinishUniform {
    /// rgb; w: alpha below which nothing is.
    pub colour: [f32; 4],
    /// 1 wood; 1 seen from both sides; 1 with a picture; share of light let through.
    pub kind: [f32; 4],
}

/// Triangles of one finish.
pub(super) struct Chunk {
    pub(super) vertices: wgpu::Buffer,
    pub(super) indices: wgpu::Buffer,
    pub(super) count: u32,
    pub(super) finish: usize,
}

/// What a finish binds.
pub(super) struct FinishBound {
    pub(super) uniform: wgpu::Buffer,
    pub(super) picture: wgpu::TextureView,
}

/// A mesh.
pub(super) struct MeshOnGpu {
    pub(super) chunks: Vec<Chunk>,
    pub(super) finishes: Vec<FinishBound>,
}

impl MeshOnGpu {
    pub(super) fn new(gpu: &Gpu, specimen: &Specimen) -> Self {
        let pictures: Vec<wgpu::TextureView> = specimen.pictures.iter().map(|picture| texture(gpu, picture)).collect();
        let white = texture(gpu, &Picture { size: [1, 1], texels: vec![[255; 4]] });
        let finishes = specimen.finishes.iter().map(|finish| {
            let wood = finish.kind == Kind::Wood;
            let picture = finish.picture.and_then(|picture| pictures.get(picture));
            let flag = |on: bool| f32::from(u8::from(on));
            let [r, g, b] = finish.colour;
            let through = if wood { 0.0 } else { sward::shading::crown::THROUGH };
            let uniform = FinishUniform {
                colour: [r, g, b, finish.cutoff],
                kind: [flag(wood), flag(finish.two_sided), flag(picture.is_some()), through],
            };
            let uniform = gpu.filled("finish", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
            FinishBound { uniform, picture: picture.unwrap_or(&white).clone() }
        });
        Self { finishes: finishes.collect(), chunks: chunks(gpu, specimen) }
    }
}

/// The triangles, in buffers no larger than a device has.
fn chunks(gpu: &Gpu, specimen: &Specimen) -> Vec<Chunk> {
    let most = MOST_BYTES / size_of::<SpecimenVertex>();
    let mut chunks = Vec::new();
    // Where each vertex lies in the chunk under way.
    let mut local = vec![u32::MAX; specimen.vertices.len()];
    for part in &specimen.parts {
        let all = &specimen.triangles[part.triangles.start as usize..part.triangles.end as usize];
        let (mut vertices, mut used, mut indices): (Vec<SpecimenVertex>, Vec<u32>, Vec<u32>) = Default::default();
        let mut close = |vertices: &mut Vec<SpecimenVertex>, indices: &mut Vec<u32>| {
            if !indices.is_empty() {
                chunks.push(Chunk {
                    vertices: gpu.filled("plant vertices", bytemuck::cast_slice(vertices), wgpu::BufferUsages::VERTEX),
                    indices: gpu.filled("plant indices", bytemuck::cast_slice(indices), wgpu::BufferUsages::INDEX),
                    count: indices.len() as u32,
                    finish: part.finish,
                });
            }
            vertices.clear();
            indices.clear();
        };
        for triangle in all {
            if vertices.len() + 3 > most || indices.len() * 4 + 12 > MOST_BYTES {
                close(&mut vertices, &mut indices);
                used.drain(..).for_each(|vertex| local[vertex as usize] = u32::MAX);
            }
            for vertex in triangle {
                let place = &mut local[*vertex as usize];
                if *place == u32::MAX {
                    *place = vertices.len() as u32;
                    vertices.push(specimen.vertices[*vertex as usize]);
                    used.push(*vertex);
                }
                indices.push(*place);
            }
        }
        close(&mut vertices, &mut indices);
        used.drain(..).for_each(|vertex| local[vertex as usize] = u32::MAX);
    }
    chunks
}

/// A picture with its levels.
fn texture(gpu: &Gpu, picture: &Picture) -> wgpu::TextureView {
    let levels = sward::specimen::levels(picture);
    let extent = |size: [u32; 2]| wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("leaf picture"),
        size: extent(picture.size),
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (level, picture) in levels.iter().enumerate() {
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo { mip_level: level as u32, ..texture.as_image_copy() },
            picture.texels.as_flattened(),
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * picture.size[0]), rows_per_image: Some(picture.size[1]) },
            extent(picture.size),
        );
    }
    texture.create_view(&Default::default())
}
