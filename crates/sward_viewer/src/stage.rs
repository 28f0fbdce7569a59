//! A scene on the stage: its world, what draws it, and where it is stepped.

use std::sync::Arc;

use sward::scene::Scene;
use sward::view::View;
use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

use crate::clock::Passing;
use crate::drive::{Asked, Drive};
use crate::source::Source;

/// Where cells move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// On the processor.
    #[default]
    Cpu,
    /// On the graphics device.
    Gpu,
}

/// A scene that runs.
pub struct Stage {
    /// Where it comes from.
    pub source: Source,
    /// The scene as it was opened.
    pub opened: Scene,
    /// The scene as it is now.
    pub edited: Scene,
    /// The world.
    pub world: World,
    studio: Studio,
    on_gpu: Option<GpuStep>,
    gpu: Arc<Gpu>,
}

impl Stage {
    /// Makes everything ready; takes long, and may run anywhere.
    ///
    /// # Errors
    /// What is wrong with the scene, or what the device reports, in plain words.
    pub fn new(gpu: &Arc<Gpu>, source: Source, scene: Scene, backend: Backend) -> Result<Self, String> {
        let [opened, edited] = [scene.clone(), scene.clone()];
        let world = World::new(scene, &*source.assets()).map_err(|error| source.located(error))?;
        let studio = Studio::new(gpu, &world).map_err(|error| error.to_string())?;
        let mut stage = Self { source, opened, edited, world, studio, on_gpu: None, gpu: Arc::clone(gpu) };
        stage.step_on(backend)?;
        Ok(stage)
    }

    /// Where it is stepped.
    pub fn backend(&self) -> Backend {
        if self.on_gpu.is_some() { Backend::Gpu } else { Backend::Cpu }
    }

    /// Steps elsewhere from now on; the state goes along.
    ///
    /// # Errors
    /// What the device reports.
    pub fn step_on(&mut self, backend: Backend) -> Result<(), String> {
        match (backend, self.on_gpu.take()) {
            (Backend::Gpu, None) => self.on_gpu = Some(GpuStep::new(&self.gpu, &self.world).map_err(|error| error.to_string())?),
            (Backend::Gpu, Some(step)) => self.on_gpu = Some(step),
            (Backend::Cpu, Some(mut step)) => step.download(&self.gpu, &mut self.world).map_err(|error| error.to_string())?,
            (Backend::Cpu, None) => {}
        }
        Ok(())
    }

    /// Takes over a changed scene while it runs, if what has changed can be changed so; `false`: it must be opened anew.
    ///
    /// # Errors
    /// What is wrong with it; the scene before goes on.
    pub fn adopt(&mut self, scene: &Scene) -> Result<bool, String> {
        if still(&self.edited) != still(scene) || responses(&self.edited) != responses(scene) {
            return Ok(false);
        }
        let backend = self.backend();
        self.step_on(Backend::Cpu)?;
        let assets = self.source.assets();
        // Whoever is at a wheel stays there.
        let mut changed = scene.clone();
        let now = self.world.scene.interactors.iter().zip(&self.world.state.bodies);
        for (body, (now, _)) in changed.interactors.iter_mut().zip(now).filter(|(_, (_, state))| state.driven.is_some()) {
            body.path = now.path.clone();
        }
        let kept = match self.world.rescene(changed, &*assets) {
            Ok(kept) => kept,
            Err(error) => {
                self.step_on(backend)?;
                return Err(error.to_string());
            }
        };
        self.edited = scene.clone();
        if !kept.stands.iter().chain(&kept.bodies).all(|fate| fate.is_kept()) {
            return Ok(false);
        }
        self.step_on(backend)?;
        Ok(true)
    }

    /// Lets time pass, with somebody at the wheel. Returns the steps that were taken.
    ///
    /// # Errors
    /// What the device reports.
    pub fn pass(&mut self, passing: Passing, drive: Option<&mut Drive>, asked: &Asked) -> Result<u32, String> {
        let steps = match passing {
            Passing::Steps(steps) => {
                self.world.state.pending_seconds = 0.0;
                steps
            }
            Passing::Seconds(seconds) => self.world.take_steps(seconds),
        };
        let mut drive = drive;
        for _ in 0..steps {
            if let Some(drive) = &mut drive {
                drive.go(asked, self.world.model.dt);
                self.world.drive(drive.body, drive.ground, drive.yaw, drive.clearance);
            }
            match &mut self.on_gpu {
                Some(step) => step.step(&self.gpu, &mut self.world).map_err(|error| error.to_string())?,
                None => self.world.step(),
            }
        }
        Ok(steps)
    }

    /// Draws what `view` sees, or the scene's own camera.
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw(&mut self, view: Option<View>, behind: f64, size: [u32; 2]) -> Result<Option<&wgpu::Texture>, String> {
        self.world.viewed = view;
        let cells = self.on_gpu.as_ref().map_or(CellsAt::Cpu, CellsAt::Gpu);
        self.studio.show(&self.gpu, &self.world, cells, behind, size).map_err(|error| error.to_string())?;
        Ok(self.studio.shown())
    }
}

/// A scene without what may change while it runs.
fn still(scene: &Scene) -> Scene {
    let mut scene = Scene { title: String::new(), wind: Vec::new(), camera: Default::default(), ..scene.clone() };
    scene.light = sward::scene::Light { environment: scene.light.environment.clone(), ..Default::default() };
    scene.stands.iter_mut().for_each(|stand| stand.response = None);
    scene
}

/// Which responses the stands have, whatever their numbers.
fn responses(scene: &Scene) -> Vec<Option<std::mem::Discriminant<sward::scene::Response>>> {
    scene.stands.iter().map(|stand| stand.response.as_ref().map(std::mem::discriminant)).collect()
}
