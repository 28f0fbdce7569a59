//! Plants: crossed cards bent along their joints, many plants per draw.

use std::collections::HashMap;

use sward::shading::clump::{Kind, VARIANTS, first_layer};
use wgpu::util::DeviceExt;

use super::clump_texture::ClumpTexture;
use super::shadow::ShadowMap;
use super::{PipelineParts, Slot, layout, main_pipeline, shader, shadow_pipeline};
use crate::gpu::Gpu;

/// Files of the pass's shader, after the common ones.
pub const PARTS: [&str; 2] = [super::SHADOWS_WGSL, include_str!("plants.wgsl")];

/// Plants drawn by one instance. Buffers are filled up to a multiple of this with plants of height 0.
pub const PLANTS_PER_INSTANCE: u32 = 64;
/// Most segments of a card.
pub const MOST_SEGMENTS: u32 = 8;
/// Most crossed cards of a plant.
pub const MOST_CARDS: u32 = 3;

/// One plant as the drawing side reads it (`Plant` of `plants.wgsl`), 32 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Plant {
    /// Metres relative to the frame origin.
    pub root: [f32; 3],
    /// Metres; 0 = no plant.
    pub height: f32,
    /// Radians.
    pub yaw: f32,
    /// Width of a card, metres.
    pub width: f32,
    /// Chance number in 0..1 for colour and variety.
    pub tint: f32,
    /// Layer of the clump pictures.
    pub layer: u32,
}

/// How a species looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Which pictures.
    pub kind: Kind,
    /// Linear RGB albedo at the root.
    pub root: [f32; 3],
    /// Linear RGB albedo at the tip.
    pub tip: [f32; 3],
    /// Share of straw added to every leaf, 0..=1.
    pub dryness: f32,
    /// Share of light that leaves let through, 0..=1.
    pub through: f32,
    /// Distances at which plants begin to shrink and are gone, metres.
    pub fade: [f32; 2],
}

impl Look {
    /// Good values for a kind of plant.
    pub fn of(kind: Kind) -> Self {
        let (root, tip, dryness, through) = match kind {
            Kind::Lawn => ([0.026, 0.075, 0.012], [0.075, 0.205, 0.028], 0.0, 0.75),
            Kind::Meadow => ([0.024, 0.066, 0.011], [0.085, 0.200, 0.030], 0.05, 0.80),
            Kind::Reed => ([0.030, 0.060, 0.014], [0.080, 0.165, 0.038], 0.06, 0.60),
            Kind::Tussock => ([0.045, 0.060, 0.016], [0.140, 0.170, 0.048], 0.24, 0.65),
        };
        Self {
            kind,
            root,
            tip,
            dryness,
            through,
            fade: [70.0, 110.0],
        }
    }

    /// The picture layer for a chance number in 0..1.
    pub fn layer(&self, chance: f32) -> u32 {
        first_layer(self.kind) + ((chance * VARIANTS as f32) as u32).min(VARIANTS - 1)
    }

    /// How much of the ground near the camera lies in the shade of these plants, 0..=1. Lawn is too short to shade it.
    pub(crate) fn cover(&self) -> f32 {
        match self.kind {
            Kind::Lawn => 0.2,
            Kind::Tussock => 0.75,
            Kind::Meadow | Kind::Reed => 0.95,
        }
    }
}

/// How many plants a batch draws.
#[derive(Clone, Copy, Debug)]
pub enum PlantCount<'a> {
    /// Known on the CPU.
    Direct(u32),
    /// Indexed indirect arguments on the GPU at this byte offset: index count per instance from [`index_count`], instances =
    /// plants / [`PLANTS_PER_INSTANCE`] rounded up, the rest 0.
    Indirect(&'a wgpu::Buffer, u64),
}

/// Plants of one look and one number of segments. Draw batches near to far: hidden plants are then skipped early.
#[derive(Clone, Copy, Debug)]
pub struct PlantBatch<'a> {
    /// Storage buffer of [`Plant`].
    pub plants: &'a wgpu::Buffer,
    /// Storage buffer of `vec4<f32>`: joint k (0..=segments) of plant i at `i·(segments+1)+k`.
    pub joints: &'a wgpu::Buffer,
    /// How many.
    pub count: PlantCount<'a>,
    /// Segments per card, 1..=8.
    pub segments: u32,
    /// Crossed cards per plant, 1..=3.
    pub cards: u32,
    /// Number of the look in the renderer's setup.
    pub look: usize,
    /// Whether these plants cast shadows (worth it near the camera only).
    pub shadows: bool,
}

/// All plants of a picture.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlantDraws<'a> {
    /// Near to far.
    pub batches: &'a [PlantBatch<'a>],
}

/// Indices drawn per instance.
pub fn index_count(segments: u32, cards: u32) -> u32 {
    PLANTS_PER_INSTANCE * cards * segments * 6
}

/// `Style` of `plants.wgsl`.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct StyleUniform {
    root: [f32; 4],
    tip: [f32; 4],
    mean: [f32; 4],
    shape: [u32; 4],
}

/// A batch made ready for this frame.
struct Ready<'a> {
    batch: PlantBatch<'a>,
    main: wgpu::BindGroup,
    shadow: wgpu::BindGroup,
}

/// The batches of one frame.
pub(crate) struct ReadyPlants<'a>(Vec<Ready<'a>>);

pub(crate) struct PlantPass {
    main: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
    main_layout: wgpu::BindGroupLayout,
    shadow_layout: wgpu::BindGroupLayout,
    clumps: ClumpTexture,
    looks: Vec<Look>,
    styles: HashMap<(usize, u32, u32), wgpu::Buffer>,
    indices: HashMap<(u32, u32), wgpu::Buffer>,
}

impl PlantPass {
    pub(crate) fn new(gpu: &Gpu, looks: &[Look]) -> Self {
        let device = &gpu.device;
        let module = shader(device, "plants", &PARTS);
        let own = [
            (0, Slot::Uniform),
            (4, Slot::Storage),
            (5, Slot::Storage),
            (6, Slot::Uniform),
            (7, Slot::Pictures),
            (8, Slot::Filtering),
        ];
        let shadow_layout = layout(device, "plant shadows", &own);
        let main_layout = layout(
            device,
            "plants",
            &[&own[..], &[(2, Slot::ShadowMap), (3, Slot::Comparison)]].concat(),
        );
        let main = main_pipeline(
            device,
            &PipelineParts {
                label: "plants",
                module: &module,
                layout: &main_layout,
                vertex: "plants_vertex",
                buffers: &[],
                fragment: Some("plants_fragment"),
                coverage: true,
                depth_write: true,
            },
        );
        let shadow = shadow_pipeline(
            device,
            &PipelineParts {
                label: "plant shadows",
                module: &module,
                layout: &shadow_layout,
                vertex: "plants_shadow_vertex",
                buffers: &[],
                fragment: Some("plants_shadow_fragment"),
                coverage: false,
                depth_write: true,
            },
        );
        Self {
            main,
            shadow,
            main_layout,
            shadow_layout,
            clumps: ClumpTexture::new(gpu),
            looks: looks.to_vec(),
            styles: HashMap::new(),
            indices: HashMap::new(),
        }
    }

    /// Makes what the batches need; batches with an unknown look or shape are left out.
    pub(crate) fn ready<'a>(
        &mut self,
        gpu: &Gpu,
        frame: &wgpu::Buffer,
        map: &ShadowMap,
        draws: &PlantDraws<'a>,
    ) -> ReadyPlants<'a> {
        let fits = |batch: &&PlantBatch<'_>| {
            batch.look < self.looks.len()
                && (1..=MOST_SEGMENTS).contains(&batch.segments)
                && (1..=MOST_CARDS).contains(&batch.cards)
        };
        let batches: Vec<PlantBatch<'a>> = draws.batches.iter().filter(fits).copied().collect();
        ReadyPlants(
            batches
                .into_iter()
                .map(|batch| self.ready_batch(gpu, frame, map, batch))
                .collect(),
        )
    }

    fn ready_batch<'a>(
        &mut self,
        gpu: &Gpu,
        frame: &wgpu::Buffer,
        map: &ShadowMap,
        batch: PlantBatch<'a>,
    ) -> Ready<'a> {
        let device = &gpu.device;
        self.indices
            .entry((batch.segments, batch.cards))
            .or_insert_with(|| index_buffer(device, batch.segments, batch.cards));
        let look = &self.looks[batch.look];
        let style = self
            .styles
            .entry((batch.look, batch.segments, batch.cards))
            .or_insert_with(|| style_buffer(device, look, &batch));
        let own = [
            wgpu::BindGroupEntry {
                binding: 0,
                resource: frame.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 4,
                resource: batch.plants.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 5,
                resource: batch.joints.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 6,
                resource: style.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 7,
                resource: wgpu::BindingResource::TextureView(&self.clumps.view),
            },
            wgpu::BindGroupEntry {
                binding: 8,
                resource: wgpu::BindingResource::Sampler(&self.clumps.sampler),
            },
        ];
        let shadow = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("plant shadows"),
            layout: &self.shadow_layout,
            entries: &own,
        });
        let mut all = own.to_vec();
        all.push(wgpu::BindGroupEntry {
            binding: 2,
            resource: wgpu::BindingResource::TextureView(&map.view),
        });
        all.push(wgpu::BindGroupEntry {
            binding: 3,
            resource: wgpu::BindingResource::Sampler(&map.sampler),
        });
        let main = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("plants"),
            layout: &self.main_layout,
            entries: &all,
        });
        Ready {
            batch,
            main,
            shadow,
        }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, plants: &ReadyPlants<'_>) {
        pass.set_pipeline(&self.main);
        for ready in &plants.0 {
            pass.set_bind_group(0, &ready.main, &[]);
            self.draw_batch(pass, &ready.batch);
        }
    }

    pub(crate) fn draw_shadow(&self, pass: &mut wgpu::RenderPass<'_>, plants: &ReadyPlants<'_>) {
        pass.set_pipeline(&self.shadow);
        for ready in plants.0.iter().filter(|ready| ready.batch.shadows) {
            pass.set_bind_group(0, &ready.shadow, &[]);
            self.draw_batch(pass, &ready.batch);
        }
    }

    fn draw_batch(&self, pass: &mut wgpu::RenderPass<'_>, batch: &PlantBatch<'_>) {
        let Some(indices) = self.indices.get(&(batch.segments, batch.cards)) else {
            return;
        };
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint16);
        match batch.count {
            PlantCount::Direct(count) => {
                pass.draw_indexed(
                    0..index_count(batch.segments, batch.cards),
                    0,
                    0..count.div_ceil(PLANTS_PER_INSTANCE),
                );
            }
            PlantCount::Indirect(buffer, offset) => pass.draw_indexed_indirect(buffer, offset),
        }
    }
}

/// Two triangles per segment; corner numbers are taken apart again in the vertex shader.
fn index_buffer(device: &wgpu::Device, segments: u32, cards: u32) -> wgpu::Buffer {
    let strips = PLANTS_PER_INSTANCE * cards;
    let corners = 2 * (segments + 1);
    let indices: Vec<u16> = (0..strips)
        .flat_map(|strip| (0..segments).map(move |segment| strip * corners + 2 * segment))
        .flat_map(|at| [at, at + 1, at + 2, at + 2, at + 1, at + 3])
        .map(|index| index as u16)
        .collect();
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("plant indices"),
        contents: bytemuck::cast_slice(&indices),
        usage: wgpu::BufferUsages::INDEX,
    })
}

fn style_buffer(device: &wgpu::Device, look: &Look, batch: &PlantBatch<'_>) -> wgpu::Buffer {
    let closed = look.cover();
    let style = StyleUniform {
        root: [look.root[0], look.root[1], look.root[2], look.dryness],
        tip: [look.tip[0], look.tip[1], look.tip[2], look.through],
        mean: [
            1.0 - 0.88 * closed,
            1.6 * closed,
            look.fade[0],
            look.fade[1],
        ],
        shape: [
            batch.segments,
            batch.cards,
            2 * (batch.segments + 1) * batch.cards,
            PLANTS_PER_INSTANCE,
        ],
    };
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("plant style"),
        contents: bytemuck::bytes_of(&style),
        usage: wgpu::BufferUsages::UNIFORM,
    })
}
