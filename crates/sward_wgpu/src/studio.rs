//! A world, drawn: prepares the visible plants and hands everything to the renderer.

use sward::picture::plan::{Seen, plan};
use sward::picture::subject::{self, Frame};
use sward::scene::Precision;
use sward::shading::look::Look;
use sward::world::World;

use crate::compute::GpuStep;
use crate::compute::buffers::CellBuffers;
use crate::gpu::{Gpu, GpuError};
use crate::picture::{Picture, Renderer, Setup};
use crate::render::growth_maps::GrowthMaps;
use crate::render::plants::{PlantBatch, PlantCount, PlantDraws};
use crate::render::prepare::{BatchBuffers, PreparePass};
use crate::stopwatch::Stopwatch;

/// Where the cells to be drawn are.
pub enum CellsAt<'a> {
    /// In `world.state`; they are uploaded.
    Cpu,
    /// On the GPU already.
    Gpu(&'a GpuStep),
}

/// Draws a world.
pub struct Studio {
    renderer: Renderer,
    prepare: PreparePass,
    looks: Vec<Look>,
    /// Mesh of each body; `None` for a shape without one.
    meshes: Vec<Option<usize>>,
    /// Near and plain plants of each stand.
    batches: Vec<[BatchBuffers; 2]>,
    /// Where each stand grows.
    growth: Vec<GrowthMaps>,
    /// Cells uploaded from the CPU, per stand.
    uploaded: Vec<CellBuffers>,
}

impl Studio {
    /// Builds what stays the same from picture to picture.
    ///
    /// # Errors
    /// What the device reports.
    pub fn new(gpu: &Gpu, world: &World) -> Result<Self, GpuError> {
        let looks = subject::looks(world);
        let relief = subject::relief(&world.model.terrain);
        let mut renderer = Renderer::new(gpu, &Setup { relief, looks: looks.clone(), ..Setup::default() })?;
        let meshes = subject::meshes(world).iter().map(|mesh| mesh.as_ref().map(|mesh| renderer.add_mesh(gpu, mesh))).collect();
        let uploaded = world.model.stands.iter().map(|stand| CellBuffers::new(gpu, stand, Precision::Full)).collect();
        let batches = world.model.stands.iter().map(|_| Default::default()).collect();
        let growth = world.model.stands.iter().map(|stand| GrowthMaps::new(gpu, stand)).collect();
        let studio = Self { renderer, prepare: PreparePass::new(gpu, world), looks, meshes, batches, growth, uploaded };
        gpu.check()?;
        Ok(studio)
    }

    /// Draws the world as it stands, in `size` pixels.
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw(&mut self, gpu: &Gpu, world: &World, cells: CellsAt<'_>, size: [u32; 2]) -> Result<Picture, GpuError> {
        self.draw_before(gpu, world, cells, 0.0, size)
    }

    /// Draws the moment `behind` steps (0 to 1) before the state: see [`World::behind`].
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw_before(&mut self, gpu: &Gpu, world: &World, cells: CellsAt<'_>, behind: f64, size: [u32; 2]) -> Result<Picture, GpuError> {
        gpu.check()?;
        if matches!(cells, CellsAt::Cpu) {
            for ((buffers, state), stand) in self.uploaded.iter_mut().zip(&world.state.stands).zip(&world.model.stands) {
                buffers.reserve(gpu, state, stand.is_level(&world.model.terrain))?;
                buffers.upload(gpu, state);
            }
        }
        let behind = behind.clamp(0.0, 1.0);
        self.pose_figures(gpu, world, behind);
        let view = world.camera_before(behind);
        let (frame, origin) = Frame::of(world, &view, behind);
        let plans = self.prepare_plants(gpu, world, &cells, &Seen { view: &view, origin, fullness: 1.0, behind });
        let mut batches = Vec::new();
        // Near plants of all stands, then plain ones: near to far.
        for plain in 0..2 {
            for (index, plan) in plans.iter().enumerate() {
                if let Some((plants, joints)) = self.batches[index][plain].filled.as_ref().filter(|_| plan[plain] > 0) {
                    let billboard = &world.model.stands[index].species.billboard;
                    let segments = if plain == 1 { 1 } else { billboard.segments };
                    let count = PlantCount::Direct(plan[plain]);
                    batches.push(PlantBatch { plants, joints, count, segments, cards: billboard.cards, look: index, shadows: true });
                }
            }
        }
        let bodies = subject::bodies(world, &frame, &self.meshes);
        let input = frame.input(world, &view, &bodies);
        self.renderer.draw(gpu, &input, &PlantDraws { batches: &batches }, size)?;
        self.renderer.read(gpu)
    }

    /// Times the passes of the pictures while there is one.
    pub fn stopwatch(&mut self) -> &mut Option<Stopwatch> {
        &mut self.renderer.stopwatch
    }

    /// The plants of a stand in the last picture: near ones with all segments, and plain ones.
    pub fn batches(&self, stand: usize) -> Option<&[BatchBuffers; 2]> {
        self.batches.get(stand)
    }

    /// Fills the batches; returns the number of plants in each.
    fn prepare_plants(&mut self, gpu: &Gpu, world: &World, cells: &CellsAt, seen: &Seen) -> Vec<[u32; 2]> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.prepare.follow(gpu, world);
        let share = world.scene.budget.visible_plants / (world.model.stands.len().max(1) as u32);
        let mut filled = Vec::new();
        for (index, stand) in world.model.stands.iter().enumerate() {
            let look = &self.looks[index];
            let (mut plans, fullness) = plan(world, index, seen, look, share);
            let growth = &mut self.growth[index];
            growth.place(gpu, world, stand, &mut plans);
            let stored = match cells {
                CellsAt::Gpu(step) => step.cells(index).unwrap_or(&self.uploaded[index]),
                CellsAt::Cpu => &self.uploaded[index],
            };
            for (plain, batch) in plans.iter().enumerate() {
                let buffers = &mut self.batches[index][plain];
                let seen = Seen { fullness, ..*seen };
                self.prepare.record(
                    gpu,
                    &mut encoder,
                    world,
                    stand,
                    batch,
                    plain == 1,
                    &seen,
                    look,
                    stored,
                    &growth.view,
                    buffers,
                    self.renderer.stopwatch.as_mut(),
                );
            }
            filled.push([plans[0].plants, plans[1].plants]);
        }
        gpu.queue.submit([encoder.finish()]);
        filled
    }

    /// Moves the meshes of bodies that play a clip.
    fn pose_figures(&mut self, gpu: &Gpu, world: &World, behind: f64) {
        for (index, mesh) in self.meshes.iter().enumerate() {
            if let (Some(mesh), Some(moved)) = (mesh, subject::moved(world, index, behind)) {
                self.renderer.move_mesh(gpu, *mesh, &moved);
            }
        }
    }
}
