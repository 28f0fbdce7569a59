//! The picture before, on the GPU: its cells, and the plants of the present picture as they were.

use sward::geometry::mesh::Mesh;
use sward::model::Revision;
use sward::picture::blade_plan::BladePlan;
use sward::picture::past::Past;
use sward::picture::plan::BatchPlan;
use sward::scene::Precision;
use sward::state::PatchKey;
use sward::terrain::Terrain;
use sward::world::World;

use crate::compute::air::AirTexels;
use crate::compute::buffers::CellBuffers;
use crate::gpu::{Gpu, GpuError};
use crate::render::blades::{BladeBuffers, SolvePass, Solving};
use crate::render::growth_maps::GrowthMaps;
use crate::render::layers::{WaveBuffers, WaveUpload};
use crate::render::prepare::{BatchBuffers, PreparePass, Shared};
use crate::studio::{CellsAt, batch_order};

/// How a stand's cells are stored where they are.
fn precision(cells: &CellsAt<'_>, stand: usize) -> Precision {
    let on_gpu = if let CellsAt::Gpu(step) = cells { step.cells(stand) } else { None };
    on_gpu.map_or(Precision::Full, |cells| cells.precision.clone())
}

/// The moment of the picture before, and what of it lies on the GPU.
pub(crate) struct KeptPast {
    pub(crate) moment: Past,
    /// Cells of that moment, per stand.
    cells: Vec<CellBuffers>,
    /// Air of that moment.
    air: AirTexels,
    /// The plants of the present picture as they were, near and plain, per stand.
    batches: Vec<[BatchBuffers; 2]>,
    /// Waves of that moment, per stand of meshes.
    waves: Vec<WaveBuffers>,
    /// What of the model all this is made for.
    seen: Revision,
}

impl KeptPast {
    /// The moment `behind` steps before the state.
    pub(crate) fn new(gpu: &Gpu, world: &World, cells: &CellsAt<'_>, behind: f64) -> Result<Self, GpuError> {
        let stands = &world.model.stands;
        let mut past = Self {
            moment: Past::of(world, behind),
            cells: stands.iter().enumerate().map(|(index, stand)| CellBuffers::new(gpu, stand, precision(cells, index))).collect(),
            air: AirTexels::new(gpu, world),
            batches: stands.iter().map(|_| Default::default()).collect(),
            waves: Vec::new(),
            seen: world.model.revision,
        };
        past.keep_cells(gpu, world, cells)?;
        Ok(past)
    }

    /// Lets another moment be the one that is kept.
    pub(crate) fn keep(&mut self, gpu: &Gpu, world: &World, cells: &CellsAt<'_>, behind: f64) -> Result<(), GpuError> {
        self.moment = Past::of(world, behind);
        self.keep_cells(gpu, world, cells)
    }

    fn keep_cells(&mut self, gpu: &Gpu, world: &World, cells: &CellsAt<'_>) -> Result<(), GpuError> {
        match cells {
            CellsAt::Cpu => {
                self.air.follow(gpu, world);
                self.air.upload(gpu, world);
                let stands = world.model.layered.iter().zip(&world.state.layered);
                let kept = stands.map(|(stand, state)| {
                    let mut waves = WaveUpload::new(gpu, &stand.harmonic);
                    waves.follow(gpu, &stand.harmonic, state, world.state.step);
                    waves.buffers
                });
                self.waves = kept.collect();
            }
            CellsAt::Gpu(step) => {
                self.air.follow(gpu, world);
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                self.air.copy_from(&mut encoder, step.air());
                self.waves = step.layered().map(|waves| waves.waves().copied(gpu, &mut encoder)).collect();
                gpu.queue.submit([encoder.finish()]);
            }
        }
        let stands = world.model.stands.iter().zip(&world.state.stands);
        let changed = std::mem::replace(&mut self.seen, world.model.revision) != world.model.revision;
        for (index, (kept, (stand, state))) in self.cells.iter_mut().zip(stands).enumerate() {
            if changed {
                kept.follow(gpu, stand);
            }
            match cells {
                CellsAt::Cpu => {
                    // Copied from a GPU the picture before.
                    if kept.precision != Precision::Full {
                        *kept = CellBuffers::new(gpu, stand, Precision::Full);
                    }
                    kept.reserve(gpu, state, !stand.stores_ground(&world.model.terrain))?;
                    kept.reserve_sheets(gpu, state)?;
                    kept.upload(gpu, state);
                }
                CellsAt::Gpu(step) => {
                    if let Some(cells) = step.cells(index) {
                        kept.copy_from(gpu, cells);
                    }
                }
            }
        }
        // Whoever only remembers asks for nothing else that would tell.
        gpu.check()
    }

    /// Solves the plants of the present picture, whose frame begins at the patch `origin`, as they were, on the `ground` of now.
    pub(crate) fn prepare(
        &mut self,
        gpu: &Gpu,
        pass: &PreparePass,
        origin: PatchKey,
        ground: &Terrain,
        plans: &[[BatchPlan; 2]],
        growth: &[GrowthMaps],
    ) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for (index, plain) in batch_order(plans) {
            let batch = self.moment.plan(index, origin, &plans[index][plain]);
            let buffers = &mut self.batches[index][plain];
            let (cells, growth) = ((&self.cells[index], &self.air), &growth[index].view);
            pass.record_past(gpu, &mut encoder, &self.moment, (index, origin), ground, &batch, plain == 1, cells, growth, buffers);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    /// Solves the blades of the present picture as they were.
    pub(crate) fn solve(
        &self,
        gpu: &Gpu,
        (pass, shared): (&SolvePass, &Shared),
        origin: PatchKey,
        ground: &Terrain,
        (plans, buffers): (&[Option<BladePlan>], &[BladeBuffers]),
        growth: &[GrowthMaps],
    ) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for (index, plan) in plans.iter().enumerate() {
            let Some(then) = plan.as_ref().and_then(|plan| self.moment.blades(index, origin, plan)) else { continue };
            let prepare = self.moment.uniform(index, origin, false, ground);
            let wind = self.moment.wind(index);
            let of = Solving { prepare, wind: &wind, air: &self.air, cells: &self.cells[index], growth: &growth[index].view };
            pass.record_past(gpu, &mut encoder, shared, &of, &then, &buffers[index]);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    /// Buffers of those plants and of their joints, in the order they are drawn.
    pub(crate) fn plants(&self, plans: &[[BatchPlan; 2]]) -> Vec<[&wgpu::Buffer; 2]> {
        let filled = |(index, plain): (usize, usize)| self.batches[index][plain].filled.as_ref();
        batch_order(plans).filter_map(filled).map(|(plants, joints)| [plants, joints]).collect()
    }

    /// Waves of that moment.
    pub(crate) fn waves(&self) -> &[WaveBuffers] {
        &self.waves
    }

    /// Meshes of bodies that play a clip, as they were, with the numbers of `meshes`.
    pub(crate) fn meshes(&self, world: &World, meshes: &[Option<usize>]) -> Vec<(usize, Mesh)> {
        let moved = |(body, mesh): (usize, &Option<usize>)| Some(((*mesh)?, self.moment.moved(world, body)?));
        meshes.iter().enumerate().filter_map(moved).collect()
    }
}
