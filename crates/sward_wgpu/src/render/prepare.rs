//! The pass that solves each visible plant once, into joints. What is drawn is decided by [`sward::picture::plan`].

use sward::picture::past::Past;
use sward::picture::plan::Seen;
pub use sward::picture::plan::{BatchPlan, PatchDraw, plan};
pub use sward::picture::prepare::PrepareUniform;
use sward::response::{StandModel, chain, oscillation, oscillator, springs};
use sward::shading::look::Look;
use sward::state::PatchKey;
use sward::terrain::Terrain;
use sward::wind::WindField;
use sward::world::World;

use super::height_samples::HeightSamples;
use super::prepare_pipelines::Pipelines;
pub use super::prepare_pipelines::{Solved, assembled};
use crate::compute::air::AirTexels;
use crate::compute::blades::CHAIN_STAND_WGSL;
use crate::compute::buffers::{CellBuffers, Numbers};
use crate::compute::sheets::SHEET_WORDS_WGSL;
use crate::gpu::Gpu;
use crate::stopwatch::Stopwatch;

/// How a stand bends its plants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bending {
    /// As a continuum.
    Continuum,
    /// Blade by blade.
    Chain,
    /// Every plant swings by itself.
    Swing,
    /// Bodies deform billboards.
    Sheet,
}

impl Bending {
    /// Of a stand.
    pub fn of(stand: &StandModel) -> Self {
        match (&stand.chain, &stand.oscillator) {
            (Some(_), _) => Self::Chain,
            _ if stand.springs.is_some() => Self::Sheet,
            (_, Some(_)) => Self::Swing,
            _ => Self::Continuum,
        }
    }

    /// Of the cells of a stand.
    pub fn of_cells(cells: &CellBuffers) -> Self {
        match &cells.numbers {
            Some(Numbers::Chain(_)) => Self::Chain,
            Some(Numbers::Swing(_)) => Self::Swing,
            Some(Numbers::Sheet(_)) => Self::Sheet,
            None => Self::Continuum,
        }
    }

    /// Whether a stand of the world bends so.
    pub fn is_in(self, world: &World) -> bool {
        world.model.stands.iter().any(|stand| Self::of(stand) == self)
    }

    /// What it needs after the texts of cells and wind: [`bends.wgsl`](self) and its own.
    pub(crate) fn parts(self) -> Vec<&'static str> {
        let (common, sum) = (include_str!("bends.wgsl"), sward::wind::SUM_WGSL);
        match self {
            Self::Continuum => vec![common, sum, include_str!("continuum_bends.wgsl")],
            Self::Sheet => {
                let [vector, sheet, lengths, recover, wind, _] = springs::WGSL;
                vec![vector, sheet, lengths, recover, wind, SHEET_WORDS_WGSL, common, sum, include_str!("sheet_bends.wgsl")]
            }
            Self::Swing => {
                let [swing, air] = oscillator::POSE_WGSL;
                vec![oscillation::WGSL, swing, air, common, sum, include_str!("swing_bends.wgsl")]
            }
            Self::Chain => {
                let [one, two] = chain::WGSL;
                let [steady, standing] = chain::STANDING_WGSL;
                vec![oscillation::WGSL, one, two, steady, standing, CHAIN_STAND_WGSL, common, sum, include_str!("chain_bends.wgsl")]
            }
        }
    }
}

/// What all passes that solve plants read.
pub struct Shared {
    heights: HeightSamples,
    /// What the wind is read from.
    pub air: AirTexels,
}

impl Shared {
    /// Heights of the ground, m.
    pub fn heights(&self) -> &wgpu::Buffer {
        &self.heights.buffer
    }
}

/// The pipelines and what they always read.
pub struct PreparePass {
    spines: Pipelines,
    /// Where there are sheets.
    sheets: Option<Pipelines>,
    /// What other passes read too.
    pub shared: Shared,
}

/// The transient buffers of one batch, kept from picture to picture.
#[derive(Default)]
pub struct BatchBuffers {
    /// Storage of plants and joints, and room in plants.
    pub filled: Option<(wgpu::Buffer, wgpu::Buffer)>,
    /// Plants in the last picture, those of height 0 included.
    pub plants: u32,
    /// Joints of each.
    pub joints: u32,
    room: u32,
}

impl BatchBuffers {
    /// Makes room for `plants` plants of `joints` joints.
    fn reserve(&mut self, gpu: &Gpu, plants: u32, joints: u32) {
        if plants <= self.room && self.filled.is_some() {
            return;
        }
        let make = |label: &str, bytes: u64| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes.max(64),
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let plants_bytes = u64::from(plants) * 32;
        self.filled = Some((make("plants", plants_bytes), make("joints", u64::from(plants) * u64::from(joints) * 16)));
        self.room = plants;
    }
}

impl PreparePass {
    /// Builds the pipelines for a world.
    pub fn new(gpu: &Gpu, world: &World) -> Self {
        let has_sheets = world.model.stands.iter().any(|stand| stand.species.sheet.is_some());
        Self {
            spines: Pipelines::new(gpu, world, Solved::Spines),
            sheets: has_sheets.then(|| Pipelines::new(gpu, world, Solved::Sheets)),
            shared: Shared {
                heights: HeightSamples::new(gpu, world.model.terrain.heights(), world.model.terrain.edits()),
                air: AirTexels::new(gpu, world),
            },
        }
    }

    /// Follows what was added to the ground.
    pub fn follow(&mut self, gpu: &Gpu, world: &World) {
        self.shared.heights.follow(gpu, &world.model.terrain);
    }

    /// Records the pass for one batch. `plain` batches have one segment.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        world: &World,
        stand: &StandModel,
        batch: &BatchPlan,
        plain: bool,
        seen: &Seen<'_>,
        look: &Look,
        cells: &CellBuffers,
        growth: &wgpu::TextureView,
        buffers: &mut BatchBuffers,
        stopwatch: Option<&mut Stopwatch>,
    ) {
        let uniform = PrepareUniform::new(world, stand, plain, seen, look);
        let wind = (&world.wind_before(stand, seen.behind), &self.shared.air);
        self.record_with(gpu, encoder, &uniform, wind, batch, cells, growth, buffers, stopwatch);
    }

    /// Records the pass for the plants of a batch as they were in the picture before: `batch` is that of [`Past::plan`], `ground` that
    /// of now, as this pass follows it. Cells and air are those of then.
    pub fn record_past(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        past: &Past,
        (index, origin): (usize, PatchKey),
        ground: &Terrain,
        batch: &BatchPlan,
        plain: bool,
        (cells, air): (&CellBuffers, &AirTexels),
        growth: &wgpu::TextureView,
        buffers: &mut BatchBuffers,
    ) {
        let uniform = past.uniform(index, origin, plain, ground);
        self.record_with(gpu, encoder, &uniform, (&past.wind(index), air), batch, cells, growth, buffers, None);
    }

    fn record_with(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        uniform: &PrepareUniform,
        (wind, air): (&WindField, &AirTexels),
        batch: &BatchPlan,
        cells: &CellBuffers,
        growth: &wgpu::TextureView,
        buffers: &mut BatchBuffers,
        stopwatch: Option<&mut Stopwatch>,
    ) {
        (buffers.plants, buffers.joints) = (batch.plants, uniform.joints());
        if batch.draws.is_empty() {
            return;
        }
        buffers.reserve(gpu, batch.plants, uniform.joints());
        let Some((plants, joints)) = &buffers.filled else { return };
        let made = |label: &str, contents: &[u8], usage| gpu.filled(label, contents, usage);
        let wind = wind.block(uniform.placement.cells / sward::response::continuum::NODE_CELLS);
        let pipelines = self.sheets.as_ref().filter(|_| Solved::of(uniform) == Solved::Sheets).unwrap_or(&self.spines);
        let uniform = made("prepare", bytemuck::bytes_of(uniform), wgpu::BufferUsages::UNIFORM);
        let wind = made("wind", bytemuck::bytes_of(&wind), wgpu::BufferUsages::UNIFORM);
        let draws = made("patches to draw", bytemuck::cast_slice(&batch.draws), wgpu::BufferUsages::STORAGE);
        let heights = &self.shared.heights;
        let bound = [&uniform, &wind, &draws, &cells.now, &cells.upper, &heights.buffer, &air.buffer, plants, joints, &cells.old];
        let mut entries: Vec<wgpu::BindGroupEntry> = bound
            .iter()
            .enumerate()
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding: binding as u32, resource: buffer.as_entire_binding() })
            .collect();
        entries.push(wgpu::BindGroupEntry { binding: 10, resource: wgpu::BindingResource::TextureView(growth) });
        if let Some(numbers) = &cells.numbers {
            entries.push(wgpu::BindGroupEntry { binding: 12, resource: numbers.buffer().as_entire_binding() });
        }
        // It has no upper segments.
        entries.retain(|entry| entry.binding != 4 || Bending::of_cells(cells) != Bending::Swing);
        let pipeline = pipelines.of(cells);
        if Bending::of_cells(cells) == Bending::Sheet {
            // They have sheets instead, and no time level before.
            entries.retain(|entry| !matches!(entry.binding, 4 | 9));
            entries.push(wgpu::BindGroupEntry { binding: 4, resource: cells.sheets.as_entire_binding() });
        }
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("prepare"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let most = batch.draws.iter().map(|draw| draw.count).max().unwrap_or(0);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("prepare"),
            timestamp_writes: stopwatch.and_then(|stopwatch| stopwatch.compute("prepare")),
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(most.div_ceil(64), batch.draws.len() as u32, 1);
    }
}
