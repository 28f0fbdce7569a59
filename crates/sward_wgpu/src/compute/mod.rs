//! The step on the GPU: the same plan, the same kernels, cells that never leave the device.
//!
//! Planning (bodies, wind phases, activation) stays on the CPU; the response runs as compute passes. What activation needs to know
//! of a step comes back [`sward::activation::LATENCY`] steps later, so nothing waits for the GPU within a step. Where nothing may wait at all, in a
//! browser, a host steps only while [`GpuStep::ready`], and takes cells over in two halves: [`GpuStep::begin_download`], [`GpuStep::finish_download`].

pub mod air;
pub mod ask;
pub mod blades;
pub mod buffers;
pub mod counted;
pub mod distance_maps;
pub mod download;
pub mod entries;
pub mod fluid;
pub mod layers;
pub mod passes;
pub mod readback;
pub mod sheets;
pub mod swings;
pub mod traffic;

use std::collections::VecDeque;

use sward::activation::LATENCY;
use sward::interaction::reaction::{Sums, WORDS};
use sward::model::Revision;
use sward::plan::{Report, StandPlan, Toucher};
use sward::response::chain;
use sward::state::{NONE, PatchKey, Summary};
use sward::world::World;

use crate::gpu::{Gpu, GpuError};
use crate::stopwatch::Stopwatch;
use air::AirTexels;
use blades::{BladePasses, SUMMARY_WORDS};
use buffers::CellBuffers;
use entries::{Entries, StandUniform};
use fluid::FluidPasses;
use layers::{LayerPasses, LayeredBuffers};
use passes::{Passes, StepBuffers};
use readback::Readback;
use sheets::SheetPasses;
use swings::SwingPasses;

/// How hosts read a cell; goes after [`sward::response::continuum::HALF_WGSL`].
pub const CELLS_WGSL: &str = include_str!("cells.wgsl");

/// What a step reports on its way to the CPU: stands of grass, then those of meshes.
struct Pending {
    step: u64,
    submission: wgpu::SubmissionIndex,
    stands: Vec<Reported>,
}

/// What one stand reports: a summary for each patch, then sums for each toucher.
struct Reported {
    patches: Vec<PatchKey>,
    touchers: Vec<Toucher>,
    readback: Readback,
}

impl Pending {
    /// Whether filing it will not wait.
    fn is_there(&mut self) -> bool {
        self.stands.iter_mut().all(|reported| reported.readback.is_there())
    }
}

/// Words of what a stand reports.
fn report_words(plan: &StandPlan) -> u64 {
    u64::from(SUMMARY_WORDS) * plan.patches.len() as u64 + (WORDS * plan.touchers.len()) as u64
}

/// What the GPU did so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Compute dispatches.
    pub dispatches: u64,
    /// Invocations (cells, wind nodes).
    pub invocations: u64,
    /// Bytes handed over.
    pub uploaded: u64,
    /// Bytes that the passes read and wrote at least: see [`traffic::Traffic`].
    pub traffic: u64,
    /// The same for upper segments, which only patches near a camera keep.
    pub upper_traffic: u64,
}

impl Work {
    /// Adds what was done besides.
    pub fn add(&mut self, more: &Self) {
        self.dispatches += more.dispatches;
        self.invocations += more.invocations;
        self.uploaded += more.uploaded;
        self.traffic += more.traffic;
        self.upper_traffic += more.upper_traffic;
    }
}

/// The cells of a world, held and stepped on the GPU; planning stays in the [`World`].
pub struct GpuStep {
    passes: Passes,
    /// Where stands move blade by blade.
    blades: Option<BladePasses>,
    /// Where plants swing by themselves.
    swings: Option<SwingPasses>,
    /// Where bodies deform billboards.
    sheets: Option<SheetPasses>,
    /// Where air flows.
    fluids: Option<FluidPasses>,
    /// Where meshes sway.
    layers: Option<LayerPasses>,
    layered: Vec<LayeredBuffers>,
    air: AirTexels,
    stands: Vec<CellBuffers>,
    pending: VecDeque<Pending>,
    /// Counters since the start.
    pub work: Work,
    /// Times the passes of the steps while there is one.
    pub stopwatch: Option<Stopwatch>,
    /// What of the model all this is made for.
    seen: Revision,
    /// What hosts have asked.
    ask: ask::AskPasses,
}

impl GpuStep {
    /// Makes buffers and pipelines for a world and takes over the cells it holds.
    ///
    /// # Errors
    /// What the device reports.
    pub fn new(gpu: &Gpu, world: &World) -> Result<Self, GpuError> {
        let precision = &world.scene.budget.precision;
        let by_blade = world.model.stands.iter().any(|stand| stand.chain.is_some());
        let deformed = world.model.stands.iter().any(|stand| stand.springs.is_some());
        let swinging = world.model.stands.iter().any(|stand| stand.oscillator.is_some());
        let air = AirTexels::new(gpu, world);
        let mut step = Self {
            passes: Passes::new(gpu, &air, precision),
            blades: by_blade.then(|| BladePasses::new(gpu, &air)),
            swings: swinging.then(|| SwingPasses::new(gpu, &air)),
            sheets: deformed.then(|| SheetPasses::new(gpu, world, &air)),
            fluids: (!world.model.fluids.is_empty()).then(|| FluidPasses::new(gpu, &world.model.fluids)),
            layers: (!world.model.layered.is_empty()).then(|| LayerPasses::new(gpu)),
            layered: world.state.layered.iter().map(|state| LayeredBuffers::new(gpu, state)).collect(),
            air,
            stands: Vec::new(),
            pending: VecDeque::new(),
            work: Work::default(),
            stopwatch: None,
            seen: world.model.revision,
            ask: Default::default(),
        };
        for (stand, state) in world.model.stands.iter().zip(&world.state.stands) {
            let mut buffers = CellBuffers::new(gpu, stand, precision.clone());
            buffers.reserve(gpu, state, !stand.stores_ground(&world.model.terrain))?;
            buffers.reserve_sheets(gpu, state)?;
            buffers.upload(gpu, state);
            step.stands.push(buffers);
        }
        gpu.check()?;
        Ok(step)
    }

    /// What the wind is read from, for drawing.
    pub fn air(&self) -> &AirTexels {
        &self.air
    }

    /// The waves of stands of meshes, for drawing.
    pub fn layered(&self) -> impl Iterator<Item = &LayeredBuffers> {
        self.layered.iter()
    }

    /// The cells of a stand, for drawing.
    pub fn cells(&self, stand: usize) -> Option<&CellBuffers> {
        self.stands.get(stand)
    }

    /// One fixed step: plans on the CPU, moves the cells on the GPU.
    ///
    /// # Errors
    /// What the device reports. The call that notices a loss may have planned the step; later ones leave the world as it is, with the cells of the last
    /// download.
    pub fn step(&mut self, gpu: &Gpu, world: &mut World) -> Result<(), GpuError> {
        gpu.check()?;
        self.collect(gpu, world, LATENCY - 1)?;
        let plan = world.plan();
        self.follow(gpu, world);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        if let Some(passes) = &self.sheets {
            passes.draw_maps(gpu, &mut encoder, world, &plan.maps, &mut self.work, self.stopwatch.as_mut());
        }
        let mut stands = Vec::new();
        for (index, stand) in plan.stands.iter().enumerate() {
            self.respond(gpu, world, index, stand, plan.step, &mut encoder, &mut stands)?;
        }
        if let Some(passes) = &self.layers {
            for ((stand, own), buffers) in world.model.layered.iter().zip(&plan.layered).zip(&mut self.layered) {
                let (plan, watch) = ((own, plan.step), self.stopwatch.as_mut());
                let felt = passes.record(gpu, &mut encoder, &stand.harmonic, plan, &self.air, buffers, &mut self.work, watch);
                let bytes = 4 * (WORDS * own.touchers.len()) as u64;
                let readback = Readback::record(gpu, &mut encoder, &felt, bytes);
                stands.push(Reported { patches: Vec::new(), touchers: own.touchers.clone(), readback });
            }
        }
        if let Some(passes) = &self.fluids {
            let (fluids, plans) = (&world.model.fluids, (&plan.fluids[..], plan.step));
            passes.record(gpu, &mut encoder, fluids, plans, &self.air, &mut self.work, self.stopwatch.as_mut());
        }
        if let Some(stopwatch) = &self.stopwatch {
            stopwatch.resolve(&mut encoder);
        }
        let submission = gpu.queue.submit([encoder.finish()]);
        stands.iter_mut().for_each(|reported: &mut Reported| reported.readback.begin(gpu));
        self.pending.push_back(Pending { step: plan.step, submission, stands });
        world.end_step();
        gpu.check()
    }

    /// Follows what a host has changed of the model: bodies, wind, how stands move.
    fn follow(&mut self, gpu: &Gpu, world: &World) {
        let now = world.model.revision;
        if let Some(sheets) = self.sheets.as_mut().filter(|_| now.bodies != self.seen.bodies) {
            sheets.follow(gpu, world);
        }
        if now.wind != self.seen.wind && self.air.follow(gpu, world) {
            self.passes.heed(&self.air);
            self.blades.iter_mut().for_each(|passes| passes.heed(&self.air));
            self.swings.iter_mut().for_each(|passes| passes.heed(&self.air));
            self.sheets.iter_mut().for_each(|passes| passes.heed(&self.air));
            let fits = self.fluids.as_ref().is_some_and(|passes| passes.fits(&world.model.fluids));
            if !fits {
                self.fluids = (!world.model.fluids.is_empty()).then(|| FluidPasses::new(gpu, &world.model.fluids));
            }
        }
        if now.stands != self.seen.stands || now.wind != self.seen.wind {
            self.stands.iter_mut().zip(&world.model.stands).for_each(|(cells, stand)| cells.follow(gpu, stand));
        }
        self.seen = now;
    }

    /// Whether the next [`GpuStep::step`] will not wait for the device. Never waits itself. It says nothing of what a step does: summaries are
    /// filed as late as ever.
    pub fn ready(&mut self, gpu: &Gpu) -> bool {
        self.filed_without_waiting(gpu, LATENCY - 1)
    }

    /// Whether all but the last `left` summaries can be filed at once.
    fn filed_without_waiting(&mut self, gpu: &Gpu, left: usize) -> bool {
        gpu.look();
        let due = self.pending.len().saturating_sub(left);
        self.pending.iter_mut().take(due).all(Pending::is_there)
    }

    /// Waits until all steps handed over are done.
    ///
    /// # Errors
    /// What the device reports.
    pub fn wait(&mut self, gpu: &Gpu, world: &mut World) -> Result<(), GpuError> {
        self.collect(gpu, world, 0)
    }

    /// Files summaries until at most `left` are on their way.
    fn collect(&mut self, gpu: &Gpu, world: &mut World, left: usize) -> Result<(), GpuError> {
        while self.pending.len() > left {
            let Some(pending) = self.pending.pop_front() else { break };
            let mut filed = Vec::new();
            let grass = world.model.stands.len();
            for (index, Reported { patches, touchers, readback }) in pending.stands.into_iter().enumerate() {
                let values: Vec<u32> = readback.take(gpu, &pending.submission)?;
                let (summaries, sums) = values.split_at((SUMMARY_WORDS as usize * patches.len()).min(values.len()));
                let sums: Vec<Sums> = sums.chunks_exact(WORDS).map(Sums::of_words).collect();
                if index >= grass {
                    filed.push(world.report_layered(index - grass, &touchers, sums));
                    continue;
                }
                let summary = |bits: &[u32]| Summary {
                    largest: f32::from_bits(bits[0]),
                    borders: [1, 2, 3, 4].map(|k| f32::from_bits(bits[k])),
                    clamped: bits[5],
                    held: bits[6],
                };
                let summaries = patches.into_iter().zip(summaries.chunks_exact(SUMMARY_WORDS as usize).map(summary));
                filed.push(Report::new(summaries.collect(), &touchers, sums));
            }
            world.file(pending.step, filed);
        }
        Ok(())
    }

    /// Records the passes of one stand.
    fn respond(
        &mut self,
        gpu: &Gpu,
        world: &World,
        index: usize,
        plan: &StandPlan,
        step: u64,
        encoder: &mut wgpu::CommandEncoder,
        stands: &mut Vec<Reported>,
    ) -> Result<(), GpuError> {
        let (stand, state) = (&world.model.stands[index], &world.state.stands[index]);
        let cells = &mut self.stands[index];
        if let (Some(chain), Some(passes)) = (&stand.chain, &self.blades) {
            cells.reserve(gpu, state, true)?;
            for patch in plan.patches.iter().filter(|patch| patch.lag != NONE && (patch.lag_woken || patch.edited)) {
                let roots = chain::roots(&world.model.terrain, stand, chain, patch.patch);
                self.work.uploaded += size_of_val(&roots[..]) as u64;
                cells.plant(gpu, patch.lag, &roots);
            }
            let of = (stand, chain, world.model.dt);
            let summary = passes.record(gpu, encoder, of, plan, cells, &mut self.work, self.stopwatch.as_mut());
            stands.push(reported(gpu, encoder, plan, &summary));
            return Ok(());
        }
        let level = !stand.stores_ground(&world.model.terrain);
        // On ground that was level until now no patch has any yet.
        let laid = !level && !cells.has_ground();
        cells.reserve(gpu, state, level)?;
        for patch in plan.patches.iter().filter(|patch| (patch.woken || patch.edited || laid) && !level) {
            let ground = stand.ground_of(&world.model.terrain, patch.patch);
            let planes = ground.planes((stand.cells * stand.cells) as usize);
            let bytes = bytemuck::cast_slice(&planes);
            if let Some(steepest) = cells.steepest.get_mut(patch.slot as usize) {
                *steepest = ground.steepest;
            }
            gpu.queue.write_buffer(&cells.ground, u64::from(patch.slot) * bytes.len() as u64, bytes);
            self.work.uploaded += bytes.len() as u64;
        }
        if let (Some(springs), Some(passes)) = (&stand.springs, &self.sheets) {
            cells.reserve_sheets(gpu, state)?;
            for patch in &plan.sheets.changed {
                let slot = state.awake.get(patch).map(|awake| awake.slot);
                if let Some((slot, places)) = slot.and_then(|slot| Some((slot, state.cells.now.get(slot as usize)?))) {
                    self.work.uploaded += size_of_val(&places[..]) as u64;
                    cells.place_sheets(gpu, slot, places);
                }
            }
            let report = passes.record(gpu, encoder, world, (index, springs), plan, cells, &mut self.work, self.stopwatch.as_mut());
            stands.push(reported(gpu, encoder, plan, &report));
            return Ok(());
        }
        if let (Some(oscillator), Some(passes)) = (&stand.oscillator, &self.swings) {
            let grows = !stand.growth.is_free();
            let all = grows && !std::mem::replace(&mut cells.knows_growth, grows);
            for patch in plan.patches.iter().filter(|patch| grows && (patch.woken || patch.edited || all)) {
                let map = stand.growth_map(&world.model.terrain, patch.patch).unwrap_or_default();
                let grown: Vec<u8> = map.iter().map(|growing| growing.share).collect();
                self.work.uploaded += grown.len() as u64;
                cells.grow_plants(gpu, patch.slot, &grown);
            }
            let of = (&world.model.terrain, stand, oscillator);
            let summary = passes.record(gpu, encoder, of, plan, step, cells, &mut self.work, self.stopwatch.as_mut());
            stands.push(reported(gpu, encoder, plan, &summary));
            return Ok(());
        }
        let entries = Entries::of(plan, step, |slot| cells.steepest.get(slot as usize).copied().unwrap_or(f32::MAX));
        let uniform = StandUniform::new(world, stand, plan, step);
        let buffers = StepBuffers::new(gpu, stand, plan, &entries, &uniform, &mut self.work);
        self.passes.record(gpu, encoder, stand, &entries, &buffers, cells, &mut self.work, self.stopwatch.as_mut());
        stands.push(reported(gpu, encoder, plan, &buffers.summary));
        Ok(())
    }
}

/// What a stand reports of a step, on its way back.
fn reported(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, plan: &StandPlan, report: &wgpu::Buffer) -> Reported {
    let readback = Readback::record(gpu, encoder, report, 4 * report_words(plan));
    Reported { patches: plan.patches.iter().map(|patch| patch.patch).collect(), touchers: plan.touchers.clone(), readback }
}
