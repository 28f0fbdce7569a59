//! Plants as the drawing side takes them: buffers of plants and joints, in batches of one look.

pub use sward::picture::plants::{MOST_CARDS, MOST_SEGMENTS, PLANTS_PER_INSTANCE, Plant};
pub use sward::shading::look::Look;

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
    /// Storage buffer of `vec4<f32>`: joint k (0..=segments) of plant i at `i·(segments+1)+k`; of sheets, their (segments + 1)² points, row
    /// by row from the root up.
    pub joints: &'a wgpu::Buffer,
    /// How many.
    pub count: PlantCount<'a>,
    /// Segments per card, or pieces along each side of a sheet, 1..=8.
    pub segments: u32,
    /// Crossed cards per plant, 1..=3; 0 where each is a sheet.
    pub cards: u32,
    /// Number of the look in the renderer's setup.
    pub look: usize,
    /// Whether these plants cast shadows (worth it near the camera only).
    pub shadows: bool,
}

impl PlantBatch<'_> {
    /// Whether its plants are sheets.
    pub fn is_sheet(&self) -> bool {
        self.cards == 0
    }
}

/// All plants of a picture.
#[derive(Clone, Copy, Default)]
pub struct PlantDraws<'a> {
    /// Billboards and sheets, near to far.
    pub batches: &'a [PlantBatch<'a>],
    /// Stands of blades.
    pub blades: &'a [super::blades::BladeDraw<'a>],
    /// Stands of meshes.
    pub layers: Option<super::layers::LayerDraws<'a>>,
}

/// Indices drawn per instance.
pub fn index_count(segments: u32, cards: u32) -> u32 {
    let quads = if cards == 0 { segments * segments } else { cards * segments };
    PLANTS_PER_INSTANCE * quads * 6
}
