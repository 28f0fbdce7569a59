//! The step of a stand of plants that swing by themselves: its plan as the passes read it, and the passes.

use bytemuck::{Pod, Zeroable};
use sward::interaction::reaction;
use sward::placement::PlacementParameters;
use sward::plan::{PatchPlan, StandPlan};
use sward::response::StandModel;
use sward::response::oscillator::{self, Blocks, OscillatorCoefficients, OscillatorModel, is_census};
use sward::response::{continuum, oscillation};
use sward::state::TILE;
use sward::terrain::Terrain;

use super::Work;
use super::air::AirTexels;
use super::blades::SUMMARY_WORDS;
use super::buffers::CellBuffers;
use super::passes::{Groups, Pass};
use super::traffic;
use crate::gpu::{Gpu, Program};
use crate::stopwatch::Stopwatch;

/// Most workgroups along one axis that are asked for.
pub(super) const ROW: u32 = 32768;

/// `SwingStand` of `swing_bends.wgsl`: what pictures read of a stand.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SwingUniform {
    /// Kernel numbers.
    pub coefficients: OscillatorCoefficients,
    /// m.
    pub patch_side: f32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: [f32; 3],
}

impl SwingUniform {
    /// Of a stand.
    pub fn new(stand: &StandModel, oscillator: &OscillatorModel) -> Self {
        Self { coefficients: oscillator.coefficients, patch_side: stand.patch_side as f32, unused: [0.0; 3] }
    }
}

/// `SwingStep` of `swings.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SwingStep {
    /// Where plants stand.
    pub placement: PlacementParameters,
    /// Kernel numbers.
    pub coefficients: OscillatorCoefficients,
    /// m.
    pub patch_side: f32,
    /// Height of level ground, m.
    pub height: f32,
    /// 1: all ground is level.
    pub level: u32,
    /// 1: how far plants have grown is stored.
    pub growing: u32,
    /// Steps done after this one; wraps.
    pub now: u32,
    /// Place of the pairs behind the edges.
    pub pairs: u32,
    /// Place of the blocks behind those.
    pub blocks: u32,
    /// Number of blocks.
    pub count: u32,
    /// Place of the contacts behind those.
    pub contacts: u32,
    /// First word of what contacts feel behind the summaries.
    pub reactions: u32,
    /// ⅓ of the mass of a plant over its height, kg/m.
    pub inertia: f32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: u32,
}

/// `SwingPatch` of `swings.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SwingPatch {
    /// Where its cells are.
    pub slot: u32,
    /// 1: it wakes; 2: it is the tiled wind patch; 4: its tilt in the wind begins.
    pub flags: u32,
    /// Its place in the summaries.
    pub entry: u32,
    /// Share of its deviation it keeps.
    pub keep: f32,
    /// Which patch.
    pub patch: [i32; 2],
    /// Keeps the next at a multiple of 16 bytes.
    pub unused: [u32; 2],
    /// How far texels rule at its corners.
    pub weights: [f32; 4],
    /// Slots of the 3×3 patches around it, or none.
    pub around: [u32; 9],
    /// Keeps the size a multiple of 16 bytes.
    pub unused_more: [u32; 3],
}

fn entry((number, patch): (usize, &PatchPlan)) -> SwingPatch {
    SwingPatch {
        slot: patch.slot,
        flags: u32::from(patch.woken) | if patch.patch == TILE { 2 } else { 0 } | if patch.aired { 4 } else { 0 },
        entry: number as u32,
        keep: patch.keep,
        patch: patch.patch,
        unused: [0; 2],
        weights: patch.weights,
        around: patch.around,
        unused_more: [0; 3],
    }
}

/// The full text of the compute shader.
pub fn assembled() -> String {
    let words = format!("const SUMMARY_WORDS: u32 = {SUMMARY_WORDS}u;");
    let mut parts = vec![sward::math::WGSL, sward::wind::WGSL, sward::placement::WGSL, sward::interaction::WGSL, oscillation::WGSL];
    parts.extend(oscillator::WGSL);
    parts.extend([reaction::SUMS_WGSL, &words, include_str!("swings.wgsl"), sward::wind::TILED_SUM_WGSL]);
    parts.join("\n")
}

/// The passes.
pub struct SwingPasses {
    rebase: Pass,
    air: Pass,
    fade: Pass,
    touch: Pass,
    tile: wgpu::Buffer,
}

/// Edges, pairs, blocks and contacts of a step as one list of words.
fn words(plan: &StandPlan, blocks: &Blocks) -> Vec<u8> {
    let mut words: Vec<u8> = bytemuck::cast_slice(&plan.edges).to_vec();
    for pair in &blocks.pairs {
        words.extend_from_slice(bytemuck::bytes_of(&[pair.contact as i32, pair.corner[0], pair.corner[1], 0]));
    }
    for block in &blocks.blocks {
        let corner = block.corner[0] | (block.corner[1] << 16);
        words.extend_from_slice(bytemuck::bytes_of(&[block.patch, corner, block.first, block.count]));
    }
    words.extend_from_slice(bytemuck::cast_slice(&plan.contacts));
    words
}

impl SwingPasses {
    /// Reads the wind from other texels.
    pub fn heed(&mut self, air: &AirTexels) {
        self.tile = air.buffer.clone();
    }

    /// Builds the pipelines; wind is read from `air`.
    pub fn new(gpu: &Gpu, air: &AirTexels) -> Self {
        let program = Program::new("swings", assembled());
        Self {
            rebase: Pass::plain(gpu, &program, "rebase_pass", &[0, 2, 3, 6]),
            air: Pass::plain(gpu, &program, "air_pass", &[0, 1, 2, 4, 8, 11, 14]),
            fade: Pass::plain(gpu, &program, "fade_pass", &[0, 2, 3]),
            touch: Pass::plain(gpu, &program, "touch_pass", &[0, 1, 2, 3, 4, 5, 6, 8, 10, 11, 14]),
            tile: air.buffer.clone(),
        }
    }

    /// Records one step of a stand, the one after `before` steps. Returns the summaries, [`SUMMARY_WORDS`] a patch, and the sums of what contacts feel.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (terrain, stand, oscillator): (&Terrain, &StandModel, &OscillatorModel),
        plan: &StandPlan,
        before: u64,
        cells: &CellBuffers,
        work: &mut Work,
        mut stopwatch: Option<&mut Stopwatch>,
    ) -> wgpu::Buffer {
        let co = oscillator.coefficients;
        for patch in plan.patches.iter().filter(|patch| patch.woken) {
            cells.clear(encoder, patch.slot);
        }
        let mut filled = |label: &str, bytes: &[u8], usage: wgpu::BufferUsages| {
            work.uploaded += bytes.len() as u64;
            let padding = [0; 96];
            gpu.filled(label, if bytes.is_empty() { &padding } else { bytes }, usage)
        };
        let (uniform, storage) = (wgpu::BufferUsages::UNIFORM, wgpu::BufferUsages::STORAGE);
        let now = (before as u32).wrapping_add(1);
        let blocks = Blocks::of(plan, stand.cells);
        let count = blocks.blocks.len() as u32;
        let pairs = 2 * plan.edges.len() as u32;
        let numbers = SwingStep {
            placement: stand.placement,
            coefficients: co,
            patch_side: stand.patch_side as f32,
            height: terrain.height_at(0.0, 0.0) as f32,
            level: u32::from(!stand.stores_ground(terrain)),
            growing: u32::from(!stand.growth.is_free()),
            now,
            pairs,
            blocks: pairs + blocks.pairs.len() as u32,
            count,
            contacts: pairs + blocks.pairs.len() as u32 + count,
            reactions: SUMMARY_WORDS * plan.patches.len() as u32,
            inertia: stand.inertia,
            unused: 0,
        };
        let all: Vec<SwingPatch> = plan.patches.iter().enumerate().map(entry).collect();
        let fading: Vec<SwingPatch> = all.iter().filter(|patch| patch.keep < 1.0 || is_census(now)).copied().collect();
        let intervals = stand.cells / continuum::NODE_CELLS;
        let (wind, tile_wind) = (plan.wind.block(intervals), plan.tile_wind.block(intervals));
        // Motions go on from where the step before left them.
        let former =
            oscillator.former.filter(|_| plan.rebase).map(|former| SwingStep { coefficients: former, now: before as u32, ..numbers });
        let former = former.map(|former| filled("swings till now", bytemuck::bytes_of(&former), uniform));
        let numbers = filled("swings", bytemuck::bytes_of(&numbers), uniform);
        let wind = filled("wind", bytemuck::bytes_of(&wind), uniform);
        let tile_wind = filled("tiled wind", bytemuck::bytes_of(&tile_wind), uniform);
        let awake = filled("awake patches", bytemuck::cast_slice(&all), storage);
        let faded = filled("fading patches", bytemuck::cast_slice(&fading), storage);
        let words = filled("edges, pairs, blocks and contacts", &words(plan, &blocks), storage);
        let summary = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("summaries"),
            size: super::report_words(plan).max(4) * 4,
            usage: storage | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let mut run = |pass: &Pass, (numbers, patches): (&wgpu::Buffer, &wgpu::Buffer), groups: [u32; 3]| {
            let bound = [
                (0, numbers),
                (1, &wind),
                (2, patches),
                (3, &cells.now),
                (4, &cells.old),
                (5, &cells.ground),
                (6, &cells.grown),
                (8, &self.tile),
                (10, &words),
                (11, &summary),
                (14, &tile_wind),
            ];
            work.add(&pass.run(gpu, encoder, &bound, Groups::Direct(groups), stopwatch.as_deref_mut()));
        };
        let (texels, side) = (co.texels / 8, stand.cells / 8);
        if let Some(former) = &former {
            run(&self.rebase, (former, &awake), [side, side, all.len() as u32]);
        }
        if texels > 0 {
            run(&self.air, (&numbers, &awake), [texels, texels, all.len() as u32]);
        }
        run(&self.fade, (&numbers, &faded), [side, side, fading.len() as u32]);
        run(&self.touch, (&numbers, &awake), [count.min(ROW), count.div_ceil(ROW), u32::from(count > 0)]);
        let texels = u64::from(co.texels) * u64::from(co.texels);
        let fading = fading.len() as u64 * u64::from(side * side);
        work.traffic += traffic::texels(all.len() as u64 * texels) + traffic::records(fading + u64::from(count));
        summary
    }
}
