//! The step of a stand that moves blade by blade: its plan as the passes read it, and the passes.

use bytemuck::{Pod, Zeroable};
use sward::interaction::reaction::{self, WORDS};
use sward::plan::{PatchPlan, StandPlan};
use sward::response::StandModel;
use sward::response::chain::{self, ChainCoefficients, ChainModel, MOST_SEGMENTS, SPEEDS};
use sward::response::oscillation;
use sward::state::{NONE, TILE};

use super::Work;
use super::air::AirTexels;
use super::buffers::CellBuffers;
use super::passes::{Groups, Pass};
use super::traffic;
use crate::gpu::{Gpu, Program};
use crate::stopwatch::Stopwatch;

/// `ChainStand`, for hosts that read virtual blades; needs [`chain::WGSL`] before it.
pub const CHAIN_STAND_WGSL: &str = include_str!("chain_stand.wgsl");

/// Words of a patch's summary.
pub const SUMMARY_WORDS: u32 = 7;

/// `ChainStand` of `blades.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ChainUniform {
    /// Kernel numbers.
    pub coefficients: ChainCoefficients,
    /// Virtual blades along a patch side.
    pub virtual_side: u32,
    /// Blades of a patch.
    pub blades: u32,
    /// Cells along a patch side.
    pub cells: u32,
    /// Step, s.
    pub dt: f32,
    /// m.
    pub patch_side: f32,
    /// Where planes begin behind the solids, `vec4`s.
    pub planes: u32,
    /// Where the list of busy blades begins behind the summaries, words.
    pub busy: u32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: u32,
    /// [`sward::response::chain::Steady::values`].
    pub steady: [[f32; 2]; SPEEDS * MOST_SEGMENTS],
}

impl ChainUniform {
    /// Numbers of a stand whose step has `solids` solids and `patches` patches.
    pub fn new(stand: &StandModel, chain: &ChainModel, dt: f64, [solids, patches]: [usize; 2]) -> Self {
        let mut steady = [[0.0; 2]; SPEEDS * MOST_SEGMENTS];
        steady.iter_mut().zip(&chain.steady.values).for_each(|(to, from)| *to = *from);
        Self {
            coefficients: chain.coefficients,
            virtual_side: chain.virtual_side,
            blades: chain.blades_of_patch(stand.cells),
            cells: stand.cells,
            dt: dt as f32,
            patch_side: stand.patch_side as f32,
            planes: 6 * solids as u32,
            busy: SUMMARY_WORDS * patches as u32 + WORDS as u32 * solids as u32,
            unused: 0,
            steady,
        }
    }
}

/// `ChainPatch` of `blades.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ChainPatch {
    /// Where its virtual blades are.
    pub slot: u32,
    /// Where its blades are, or none.
    pub lag: u32,
    /// 1: it wakes; 2: it is the tiled wind patch; 4: its blades are new; 8: they are handed back; 16: all of its blades are held.
    pub flags: u32,
    /// Its place in the summaries.
    pub entry: u32,
    /// Which patch.
    pub patch: [i32; 2],
    /// First of its solids.
    pub solid_first: u32,
    /// Their number.
    pub solid_count: u32,
    /// How far virtual blades rule at its corners.
    pub weights: [f32; 4],
    /// Share of its deviation it keeps.
    pub keep: f32,
    /// Pixels of a metre where it is nearest to a focus.
    pub pixels: f32,
    /// Slots of the 3×3 patches around it, or none.
    pub around: [u32; 9],
    /// Segments of its blades: the coefficients' own, where no driver takes it for a constant.
    pub segments: u32,
}

fn entry((number, patch): (usize, &PatchPlan), (segments, all): (u32, bool)) -> ChainPatch {
    let flag = |on: bool, bit: u32| if on { bit } else { 0 };
    ChainPatch {
        slot: patch.slot,
        lag: patch.lag,
        flags: flag(patch.woken, 1) | flag(patch.patch == TILE, 2) | flag(patch.lag_woken, 4) | flag(patch.handing, 8) | flag(all, 16),
        entry: number as u32,
        patch: patch.patch,
        solid_first: patch.solids.start as u32,
        solid_count: patch.solids.len() as u32,
        weights: patch.weights,
        keep: patch.keep,
        pixels: patch.pixels,
        around: patch.around,
        segments,
    }
}

/// The full text of the compute shader.
pub fn assembled() -> String {
    let constants =
        format!("const SUMMARY_WORDS: u32 = {SUMMARY_WORDS}u;\nconst BLADES_RESTLESS: f32 = {:?};", sward::response::chain::RESTLESS);
    let mut parts = vec![sward::math::WGSL, sward::wind::WGSL, oscillation::WGSL];
    parts.extend(chain::WGSL.iter().chain(&chain::STANDING_WGSL));
    parts.push(sward::interaction::solid::WGSL);
    parts.extend(chain::HELD_WGSL);
    parts.extend([reaction::SUMS_WGSL, &constants]);
    parts.extend([CHAIN_STAND_WGSL, include_str!("blades.wgsl"), sward::wind::TILED_SUM_WGSL]);
    parts.join("\n")
}

/// The passes.
pub struct BladePasses {
    virtual_blades: Pass,
    busy: Pass,
    blades: Pass,
    tile: wgpu::Buffer,
}

impl BladePasses {
    /// Reads the wind from other texels.
    pub fn heed(&mut self, air: &AirTexels) {
        self.tile = air.buffer.clone();
    }

    /// Builds the pipelines; wind is read from `air`.
    pub fn new(gpu: &Gpu, air: &AirTexels) -> Self {
        let program = Program::new("blades", assembled());
        Self {
            virtual_blades: Pass::plain(gpu, &program, "virtual_pass", &[0, 1, 2, 3, 4, 5, 8, 11, 14]),
            busy: Pass::plain(gpu, &program, "busy_pass", &[0, 2, 6, 7, 10, 11]),
            blades: Pass::plain(gpu, &program, "blades_pass", &[0, 1, 2, 3, 4, 6, 7, 8, 10, 11, 14]),
            tile: air.buffer.clone(),
        }
    }

    /// Records one step of a stand; `cells.now` is one step on when it has run. Returns the summaries, [`SUMMARY_WORDS`] a patch, and the sums of what solids feel.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (stand, chain, dt): (&StandModel, &ChainModel, f64),
        plan: &StandPlan,
        cells: &mut CellBuffers,
        work: &mut Work,
        mut stopwatch: Option<&mut Stopwatch>,
    ) -> wgpu::Buffer {
        let mut filled = |label: &str, bytes: &[u8], usage: wgpu::BufferUsages| {
            work.uploaded += bytes.len() as u64;
            let padding = [0; 96];
            gpu.filled(label, if bytes.is_empty() { &padding } else { bytes }, usage)
        };
        let (uniform, storage) = (wgpu::BufferUsages::UNIFORM, wgpu::BufferUsages::STORAGE);
        let all: Vec<ChainPatch> =
            plan.patches.iter().enumerate().map(|patch| entry(patch, (chain.coefficients.segments, chain.all))).collect();
        let with_room: Vec<ChainPatch> = all.iter().filter(|patch| patch.lag != NONE).copied().collect();
        let numbers = ChainUniform::new(stand, chain, dt, [plan.solids.heads.len(), all.len()]);
        let intervals = stand.cells / sward::response::continuum::NODE_CELLS;
        let (wind, tile_wind) = (plan.wind.block(intervals), plan.tile_wind.block(intervals));
        let solids = [bytemuck::cast_slice::<_, u8>(&plan.solids.heads), bytemuck::cast_slice(&plan.solids.planes)].concat();
        let numbers = filled("blades", bytemuck::bytes_of(&numbers), uniform);
        let wind = filled("wind", bytemuck::bytes_of(&wind), uniform);
        let tile_wind = filled("tiled wind", bytemuck::bytes_of(&tile_wind), uniform);
        let words = filled("solids", &solids, storage);
        let (awake, roomy) = (
            filled("awake patches", bytemuck::cast_slice(&all), storage),
            filled("patches with blades", bytemuck::cast_slice(&with_room), storage),
        );
        let blades = chain.blades_of_patch(stand.cells);
        let make = |label: &str, words: u64, usage: wgpu::BufferUsages| {
            let usage = usage | wgpu::BufferUsages::COPY_DST;
            gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size: 4 * words, usage, mapped_at_creation: false })
        };
        let busy = super::report_words(plan);
        let listed = 2 * u64::from(blades) * with_room.len() as u64;
        let summary = make("summaries", busy + 4 + listed.max(2), storage | wgpu::BufferUsages::COPY_SRC);
        gpu.queue.write_buffer(&summary, 4 * busy, bytemuck::cast_slice(&[0_u32, 1, 1, 0]));
        let mut run = |encoder: &mut wgpu::CommandEncoder, pass: &Pass, patches: &wgpu::Buffer, cells: &CellBuffers, groups: Groups<'_>| {
            let bound = [
                (0, &numbers),
                (1, &wind),
                (2, patches),
                (3, &cells.now),
                (4, &cells.old),
                (5, &cells.states),
                (6, &cells.upper),
                (7, &cells.roots),
                (8, &self.tile),
                (10, &words),
                (11, &summary),
                (14, &tile_wind),
            ];
            work.add(&pass.run(gpu, encoder, &bound, groups, stopwatch.as_deref_mut()));
        };
        let side = chain.virtual_side / 8;
        run(encoder, &self.virtual_blades, &awake, cells, Groups::Direct([side, side, all.len() as u32]));
        cells.swap();
        if !with_room.is_empty() {
            run(encoder, &self.busy, &roomy, cells, Groups::Direct([blades.div_ceil(64), with_room.len() as u32, 1]));
            let groups = make("groups of busy blades", 3, wgpu::BufferUsages::INDIRECT);
            encoder.copy_buffer_to_buffer(&summary, 4 * busy, &groups, 0, Some(12));
            run(encoder, &self.blades, &roomy, cells, Groups::Indirect(&groups));
        }
        // Blades that are held take more: how many is not known here, but see [`super::counted`].
        work.traffic += traffic::virtual_blades(chain, all.len() as u64) + traffic::looked_at(with_room.len() as u64 * u64::from(blades));
        summary
    }
}
