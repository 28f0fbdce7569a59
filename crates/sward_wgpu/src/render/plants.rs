//! Plants as the drawing side takes them: buffers of plants and joints, in batches of one look.

use sward::shading::clump::{Kind, VARIANTS, first_layer};

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
        Self { kind, root, tip, dryness, through, fade: [70.0, 110.0] }
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
