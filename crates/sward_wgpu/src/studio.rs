//! A world, drawn: prepares the visible plants and hands everything to the renderer.

use std::sync::Arc;

use sward::model::Revision;
use sward::picture::aov::Aov;
use sward::picture::blade_plan::{self, BladePlan};
use sward::picture::frame::FrameInput;
use sward::picture::layers::{self, CutPlan, Origin};
use sward::picture::plan::{BatchPlan, PatchDraw, Seen, plan, share};
use sward::picture::prepare::PrepareUniform;
use sward::picture::subject::{self, Dressing, Frame};
use sward::picture::volume::Lighting;
use sward::scene::Precision;
use sward::shading::blade::BladeStyle;
use sward::shading::look::Look;
use sward::state::PatchKey;
use sward::view::View;
use sward::world::World;

use crate::compute::GpuStep;
use crate::compute::buffers::CellBuffers;
use crate::compute::layers::LayeredBuffers;
use crate::gpu::{Gpu, GpuError};
use crate::past::KeptPast;
use crate::picture::{self, Before, Picture, Renderer, Setup};
use crate::render::blades::{BladeBuffers, BladeDraw, SolvePass, Solving};
use crate::render::growth_maps::GrowthMaps;
use crate::render::layers::{LayerDraws, WaveBuffers, WaveUpload};
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
    /// Mesh of each body.
    dressing: Dressing,
    /// Near and plain plants of each stand.
    batches: Vec<[BatchBuffers; 2]>,
    /// Where there are stands of blades.
    solve: Option<SolvePass>,
    /// Blades of each stand.
    blades: Vec<BladeBuffers>,
    /// Where each stand grows.
    growth: Vec<GrowthMaps>,
    /// Cells uploaded from the CPU, per stand.
    uploaded: Vec<CellBuffers>,
    /// Waves of each stand of meshes, uploaded from the CPU.
    waves: Vec<WaveUpload>,
    /// The picture before; where outputs beside pictures are asked for.
    past: Option<KeptPast>,
    /// Share of the distance up to which every plant is drawn.
    near: f64,
    /// What of the model all this is made for.
    seen: Revision,
}

/// A picture's moment, made ready.
struct Ready {
    frame: Frame,
    origin: PatchKey,
    view: View,
    /// Near and plain plants of each stand.
    plans: Vec<[BatchPlan; 2]>,
    /// Blades of each stand of them.
    blades: Vec<Option<BladePlan>>,
}

impl Studio {
    /// Builds what stays the same from picture to picture.
    ///
    /// # Errors
    /// What the device reports.
    pub fn new(gpu: &Gpu, world: &World) -> Result<Self, GpuError> {
        Self::lit(gpu, world, Lighting::of(world).map(Arc::new))
    }

    /// As [`Studio::new`], with the light of the surroundings that was worked out or stored before; `None` draws the scene without any.
    ///
    /// # Errors
    /// What the device reports.
    pub fn lit(gpu: &Gpu, world: &World, lighting: Option<Arc<Lighting>>) -> Result<Self, GpuError> {
        let looks = subject::looks(world);
        let relief = subject::relief(&world.model.terrain);
        let renderer = Renderer::new(gpu, &Setup { relief, looks: looks.clone(), lighting, ..Setup::default() })?;
        let uploaded = world.model.stands.iter().map(|stand| CellBuffers::new(gpu, stand, Precision::Full)).collect();
        let waves = world.model.layered.iter().map(|stand| WaveUpload::new(gpu, &stand.harmonic)).collect();
        let batches = world.model.stands.iter().map(|_| Default::default()).collect();
        let growth = world.model.stands.iter().map(|stand| GrowthMaps::new(gpu, stand)).collect();
        let solve = world.model.stands.iter().any(|stand| stand.species.blade.is_some()).then(|| SolvePass::new(gpu));
        let blades = world.model.stands.iter().map(|_| BladeBuffers::default()).collect();
        let prepare = PreparePass::new(gpu, world);
        let (dressing, seen) = (Dressing::default(), world.model.revision);
        let mut studio =
            Self { renderer, prepare, looks, dressing, batches, solve, blades, growth, uploaded, waves, past: None, near: 1.0, seen };
        studio.follow(gpu, world);
        gpu.check()?;
        Ok(studio)
    }

    /// Follows what a host has changed of the model: bodies, wind, how stands move.
    fn follow(&mut self, gpu: &Gpu, world: &World) {
        let renderer = &mut self.renderer;
        self.dressing.follow(world, |number, mesh| renderer.put_mesh(gpu, number, &mesh));
        let now = world.model.revision;
        if now.wind != self.seen.wind {
            self.prepare.shared.air.follow(gpu, world);
        }
        if now.stands != self.seen.stands || now.wind != self.seen.wind {
            self.uploaded.iter_mut().zip(&world.model.stands).for_each(|(cells, stand)| cells.follow(gpu, stand));
        }
        self.seen = now;
    }

    /// From the next picture on plants grow fewer, and wider, from a `near`th (0.01 to 1) of the usual distance on: for slow devices. Outputs beside a
    /// picture ([`Studio::draw_aov`]) always show all.
    pub fn thin(&mut self, near: f64) {
        self.near = near.clamp(0.01, 1.0);
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
        self.show(gpu, world, cells, behind, size)?;
        self.renderer.read(gpu)
    }

    /// Draws the same and leaves it on the device, for a host with a window: [`Studio::shown`].
    ///
    /// # Errors
    /// What the device reports.
    pub fn show(&mut self, gpu: &Gpu, world: &World, cells: CellsAt<'_>, behind: f64, size: [u32; 2]) -> Result<(), GpuError> {
        gpu.check()?;
        let size = picture::fitting(gpu, size);
        let ready = self.ready(gpu, world, &cells, (behind, self.near), size, false)?;
        let bodies = subject::bodies(world, &ready.frame, &self.dressing.meshes);
        let input = ready.frame.input(world, &ready.view, &bodies);
        let (cuts, waves) = self.layers(gpu, world, &cells, behind, size, &input);
        let (batches, blades) = (drawn(&self.batches, world, &ready.plans), strips(&self.blades, world, &self.looks, &ready.blades));
        let layers = layered(world, &ready.frame, &cuts, &waves);
        self.renderer.draw(gpu, &input, &PlantDraws { batches: &batches, blades: &blades, layers }, size)
    }

    /// The last picture on the device, its code values as sRGB has them; a new texture whenever the size changes.
    pub fn shown(&self) -> Option<&wgpu::Texture> {
        self.renderer.shown()
    }

    /// Reads back the last picture that [`Studio::show`] drew.
    ///
    /// # Errors
    /// What the device reports.
    pub fn read(&self, gpu: &Gpu) -> Result<Picture, GpuError> {
        self.renderer.read(gpu)
    }

    /// Draws the moment `behind` steps (0 to 1) before the state, and beside the picture depth, motion and plant of each pixel.
    ///
    /// Motion leads to the moment of the last call of this function or of [`Studio::remember`]; the first one's is 0. Until the first
    /// call none of it costs anything; from then on a copy of the world and of its cells is kept.
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw_aov(
        &mut self,
        gpu: &Gpu,
        world: &World,
        cells: CellsAt<'_>,
        behind: f64,
        size: [u32; 2],
    ) -> Result<(Picture, Aov), GpuError> {
        gpu.check()?;
        let size = picture::fitting(gpu, size);
        let mut past = match self.past.take() {
            Some(past) => past,
            None => KeptPast::new(gpu, world, &cells, behind)?,
        };
        let ready = self.ready(gpu, world, &cells, (behind, 1.0), size, true)?;
        let bodies = subject::bodies(world, &ready.frame, &self.dressing.meshes);
        let input = ready.frame.input(world, &ready.view, &bodies);
        past.prepare(gpu, &self.prepare, ready.origin, &world.model.terrain, &ready.plans, &self.growth);
        if let Some(solve) = &self.solve {
            let passes = (solve, &self.prepare.shared);
            past.solve(gpu, passes, ready.origin, &world.model.terrain, (&ready.blades, &self.blades), &self.growth);
        }
        let (cuts, waves) = self.layers(gpu, world, &cells, behind, size, &input);
        let before = Before {
            layers: &past.moment.layers(&cuts[0], Origin(ready.frame.corner)),
            waves: past.waves(),
            camera: past.moment.camera(&ready.frame, size),
            bodies: &past.moment.bodies(world, &ready.frame, &bodies, &self.dressing.meshes),
            meshes: &past.meshes(world, &self.dressing.meshes),
            plants: &past.plants(&ready.plans),
        };
        let (batches, blades) = (drawn(&self.batches, world, &ready.plans), strips(&self.blades, world, &self.looks, &ready.blades));
        let layers = layered(world, &ready.frame, &cuts, &waves);
        self.renderer.draw_aov(gpu, &input, &PlantDraws { batches: &batches, blades: &blades, layers }, &before, size)?;
        let images = (self.renderer.read(gpu)?, self.renderer.read_aov(gpu)?);
        past.keep(gpu, world, &cells, behind)?;
        self.past = Some(past);
        Ok(images)
    }

    /// Makes the moment `behind` steps (0 to 1) before the state the one that the motion of the next [`Studio::draw_aov`] leads to,
    /// without drawing it.
    ///
    /// # Errors
    /// What the device reports.
    pub fn remember(&mut self, gpu: &Gpu, world: &World, cells: CellsAt<'_>, behind: f64) -> Result<(), GpuError> {
        gpu.check()?;
        match &mut self.past {
            Some(past) => past.keep(gpu, world, &cells, behind),
            None => {
                self.past = Some(KeptPast::new(gpu, world, &cells, behind)?);
                Ok(())
            }
        }
    }

    /// Brings cells, bodies and plants to the moment of a picture of `size` pixels; `then`: with room for the picture before.
    fn ready(
        &mut self,
        gpu: &Gpu,
        world: &World,
        cells: &CellsAt<'_>,
        (behind, near): (f64, f64),
        size: [u32; 2],
        then: bool,
    ) -> Result<Ready, GpuError> {
        self.follow(gpu, world);
        if matches!(cells, CellsAt::Cpu) {
            for ((buffers, state), stand) in self.uploaded.iter_mut().zip(&world.state.stands).zip(&world.model.stands) {
                buffers.reserve(gpu, state, !stand.stores_ground(&world.model.terrain))?;
                buffers.reserve_sheets(gpu, state)?;
                buffers.upload(gpu, state);
            }
        }
        let behind = behind.clamp(0.0, 1.0);
        self.pose_figures(gpu, world, behind);
        let view = world.camera_before(behind);
        let (frame, origin) = Frame::of(world, &view, behind);
        let seen = Seen { view: &view, origin, fullness: 1.0, near, behind };
        let projection = frame.view(&view).projection(size);
        let mut blades = blade_plan::plan(world, &seen, &self.looks, &projection, then);
        let plans = self.prepare_plants(gpu, world, cells, &seen, &mut blades);
        Ok(Ready { frame, origin, view, plans, blades })
    }

    /// What is shown of stands of meshes, and the waves that move them.
    fn layers(
        &mut self,
        gpu: &Gpu,
        world: &World,
        cells: &CellsAt<'_>,
        behind: f64,
        size: [u32; 2],
        input: &FrameInput<'_>,
    ) -> ([Vec<CutPlan>; 2], Vec<WaveBuffers>) {
        if world.model.layered.is_empty() {
            return Default::default();
        }
        let waves = match cells {
            CellsAt::Gpu(step) => step.layered().map(LayeredBuffers::waves).collect(),
            CellsAt::Cpu => {
                let stands = world.model.layered.iter().zip(&world.state.layered).zip(&mut self.waves);
                stands.for_each(|((stand, state), waves)| waves.follow(gpu, &stand.harmonic, state, world.state.step));
                self.waves.iter().map(|waves| waves.buffers.clone()).collect()
            }
        };
        (layers::plan(world, behind, size[1], input), waves)
    }

    /// Times the passes of the pictures while there is one.
    pub fn stopwatch(&mut self) -> &mut Option<Stopwatch> {
        &mut self.renderer.stopwatch
    }

    /// The plants of a stand in the last picture: near ones with all segments, and plain ones.
    pub fn batches(&self, stand: usize) -> Option<&[BatchBuffers; 2]> {
        self.batches.get(stand)
    }

    /// The blades of a stand in the last picture.
    pub fn blades(&self, stand: usize) -> Option<&BladeBuffers> {
        self.blades.get(stand)
    }

    /// Fills the batches, and the blades as planned; returns what the batches hold.
    fn prepare_plants(
        &mut self,
        gpu: &Gpu,
        world: &World,
        cells: &CellsAt,
        seen: &Seen,
        blades: &mut [Option<BladePlan>],
    ) -> Vec<[BatchPlan; 2]> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.prepare.follow(gpu, world);
        match cells {
            CellsAt::Gpu(step) => self.prepare.shared.air.copy_from(&mut encoder, step.air()),
            CellsAt::Cpu => self.prepare.shared.air.upload(gpu, world),
        }
        let share = share(world);
        let mut filled = Vec::new();
        for (index, stand) in world.model.stands.iter().enumerate() {
            let look = &self.looks[index];
            let (mut plans, fullness) = plan(world, index, seen, look, share);
            let growth = &mut self.growth[index];
            let blade_draws = blades[index].iter_mut().flat_map(|plan| &mut plan.draws);
            let mut draws: Vec<&mut PatchDraw> = plans.iter_mut().flat_map(|batch| &mut batch.draws).chain(blade_draws).collect();
            growth.place(gpu, world, stand, &mut draws);
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
            if let (Some(solve), Some(plan)) = (&self.solve, &blades[index]) {
                let prepare = PrepareUniform::new(world, stand, false, seen, look);
                let wind = world.wind_before(stand, seen.behind);
                let of = Solving { prepare, wind: &wind, air: &self.prepare.shared.air, cells: stored, growth: &growth.view };
                let (shared, buffers) = (&self.prepare.shared, &mut self.blades[index]);
                solve.record(gpu, &mut encoder, shared, &of, plan, buffers, self.renderer.stopwatch.as_mut());
            }
            filled.push(plans);
        }
        gpu.queue.submit([encoder.finish()]);
        filled
    }

    /// Moves the meshes of bodies that play a clip.
    fn pose_figures(&mut self, gpu: &Gpu, world: &World, behind: f64) {
        for (index, mesh) in self.dressing.meshes.iter().enumerate() {
            if let (Some(mesh), Some(moved)) = (mesh, subject::moved(world, index, behind)) {
                self.renderer.move_mesh(gpu, *mesh, &moved);
            }
        }
    }
}

/// What is drawn of the stands of meshes.
fn layered<'a>(world: &'a World, frame: &Frame, plans: &'a [Vec<CutPlan>; 2], waves: &'a [WaveBuffers]) -> Option<LayerDraws<'a>> {
    let stands = &world.model.layered[..];
    (!stands.is_empty()).then_some(LayerDraws { stands, origin: Origin(frame.corner), plans, waves })
}

/// What is drawn of the stands of blades made ready.
fn strips<'a>(buffers: &'a [BladeBuffers], world: &World, looks: &[Look], plans: &[Option<BladePlan>]) -> Vec<BladeDraw<'a>> {
    let draw = |(index, plan): (usize, &Option<BladePlan>)| {
        let (numbers, blade) = (&plan.as_ref()?.uniform, world.model.stands[index].species.blade.as_ref()?);
        let style = |level: usize| {
            let shape = [numbers.pieces[level], numbers.stride(level), numbers.firsts[level], level as u32];
            BladeStyle::new(blade, &looks[index], shape)
        };
        Some(BladeDraw { buffers: &buffers[index], styles: [style(0), style(1), style(2)] })
    };
    plans.iter().enumerate().filter_map(draw).collect()
}

/// Batches that hold plants, as (stand, 0 near or 1 plain), in the order they are drawn.
pub(crate) fn batch_order(plans: &[[BatchPlan; 2]]) -> impl Iterator<Item = (usize, usize)> {
    (0..2).flat_map(|plain| (0..plans.len()).map(move |index| (index, plain))).filter(|(index, plain)| plans[*index][*plain].plants > 0)
}

/// What is drawn of the plants made ready: near plants of all stands, then plain ones, near to far.
fn drawn<'a>(batches: &'a [[BatchBuffers; 2]], world: &World, plans: &[[BatchPlan; 2]]) -> Vec<PlantBatch<'a>> {
    let mut draws = Vec::new();
    for (index, plain) in batch_order(plans) {
        let Some((plants, joints)) = &batches[index][plain].filled else { continue };
        let species = &world.model.stands[index].species;
        let segments = if plain == 1 { 1 } else { species.pieces() };
        let count = PlantCount::Direct(plans[index][plain].plants);
        draws.push(PlantBatch { plants, joints, count, segments, cards: species.cards(), look: index, shadows: true });
    }
    draws
}
