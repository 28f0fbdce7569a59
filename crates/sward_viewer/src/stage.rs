//! A scene on the stage: its world, what draws it, and where it is stepped.

use std::sync::Arc;

use sward::picture::Picture;
use sward::picture::subject::looks;
use sward::scene::{Driven, Path, Scene};
use sward::shading::clump;
use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::compute::download::Download;
use sward_wgpu::gpu::{Gpu, GpuError};
use sward_wgpu::stopwatch::Stopwatch;
use web_time::Instant;

use crate::clock::Passing;
use crate::loading::breathe;
use crate::painter::{Means, Painter, Shot, Shown};
use crate::source::{Painted, Source};
use crate::timing::{self, Times};

/// Where cells move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// On the processor.
    #[default]
    Cpu,
    /// On the graphics device.
    Gpu,
}

impl Backend {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cpu => "cpu",
            Self::Gpu => "gpu",
        }
    }
}

/// Where somebody puts a body in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Its number.
    pub body: usize,
    /// m.
    pub ground: [f64; 2],
    /// Heading, rad.
    pub yaw: f64,
    /// Height over the ground, m.
    pub clearance: f64,
}

/// A change that takes longer, ms, is made beside the window.
const FELT: f64 = 25.0;
/// Pictures between two looks at the device's clock.
const CLOCK: u64 = 6;

/// A scene that was changed beside the window.
pub enum Changed {
    /// What drew it before draws it still.
    Kept(Box<(Scene, World)>),
    /// It was made anew.
    Anew(Box<Stage>),
}

/// Where a scene's files come from.
pub type From = (Source, Painted);

/// Cells on the device.
struct OnGpu {
    step: GpuStep,
    gpu: Arc<Gpu>,
    /// Whether anybody may wait for it.
    patient: bool,
    /// Cells on their way to the processor.
    fetching: Option<Download>,
    /// Step whose cells the processor has, too.
    fetched: Option<u64>,
}

/// A scene that runs.
pub struct Stage {
    /// Where it comes from.
    pub source: Source,
    /// The wind that is being painted.
    pub painted: Painted,
    /// The scene as it was opened.
    pub opened: Scene,
    /// The scene as it is now.
    pub edited: Scene,
    /// The scene that runs: `edited`, unless a change is still on its way.
    running: Scene,
    /// The world.
    pub world: World,
    painter: Painter,
    on_gpu: Option<OnGpu>,
    means: Means,
    /// The step before which the last picture was taken, and what it showed.
    drawn: Option<(u64, Shot)>,
    /// Milliseconds that a change takes, as far as is known.
    adopted: f64,
    /// What draws no longer fits the world: another stage is on its way.
    stale: bool,
}

impl Stage {
    /// Makes everything ready; takes long, and may run anywhere.
    ///
    /// # Errors
    /// What is wrong with the scene, or what the device reports, in plain words.
    pub async fn new(means: &Means, (source, painted): From, scene: Scene, backend: Backend) -> Result<Self, String> {
        let begun = Instant::now();
        let world = World::new(scene.clone(), &*source.assets(painted.clone())).map_err(|error| source.located(error))?;
        let took = begun.elapsed().as_secs_f64() * 1e3;
        Ok(Self { adopted: took, ..Self::of(means, (source, painted), scene, world, backend).await? })
    }

    /// A changed scene that goes on from where `world` is; takes as long, and may run anywhere. `scene` is as its author wrote it. What draws `running` is
    /// kept where it still can.
    ///
    /// # Errors
    /// As [`Stage::new`].
    pub async fn changed(
        means: &Means,
        (source, painted): From,
        running: Option<&Scene>,
        scene: Scene,
        mut world: World,
        backend: Backend,
    ) -> Result<Changed, String> {
        let begun = Instant::now();
        let kept = world.rescene(with_drivers(&world, &scene), &*source.assets(painted.clone())).map_err(|error| error.to_string())?;
        if kept.stands.iter().chain(&kept.bodies).all(|fate| fate.is_kept()) && running.is_some_and(|running| fits(running, &scene)) {
            return Ok(Changed::Kept(Box::new((scene, world))));
        }
        let took = begun.elapsed().as_secs_f64() * 1e3;
        let stage = Self::of(means, (source, painted), scene, world, backend).await?;
        Ok(Changed::Anew(Box::new(Self { adopted: took, ..stage })))
    }

    /// Goes on with a world whose scene was changed elsewhere.
    ///
    /// # Errors
    /// What the device reports.
    pub fn go_on(&mut self, scene: Scene, world: World) -> Result<(), String> {
        let backend = self.backend();
        self.on_gpu = None;
        self.world = world;
        (self.edited, self.running, self.drawn) = (scene.clone(), scene, None);
        self.step_on(backend).map(|_| ())
    }

    async fn of(means: &Means, (source, painted): From, scene: Scene, world: World, backend: Backend) -> Result<Self, String> {
        breathe().await;
        // What painting plants takes is divided, so that a page answers in between.
        for look in looks(&world) {
            for variant in 0..clump::VARIANTS {
                clump::painted(look.kind, variant);
                breathe().await;
            }
        }
        let painter = Painter::new(means, &world)?;
        let [opened, edited, running] = [scene.clone(), scene.clone(), scene];
        let mut stage = Self {
            source,
            painted,
            opened,
            edited,
            running,
            world,
            painter,
            on_gpu: None,
            means: means.clone(),
            drawn: None,
            adopted: 0.0,
            stale: false,
        };
        breathe().await;
        stage.step_on(backend)?;
        Ok(stage)
    }

    /// Brings the cells to the processor, where a device steps: for whoever looks at them. `false` where nobody may wait: they are on their way then,
    /// and until they are there no step is taken.
    ///
    /// # Errors
    /// What the device reports.
    pub fn bring(&mut self) -> Result<bool, String> {
        self.on_gpu.as_mut().map_or(Ok(true), |on_gpu| on_gpu.bring(&mut self.world).map_err(|error| error.to_string()))
    }

    /// Whether a step can be taken without waiting; always where waiting is allowed.
    ///
    /// # Errors
    /// What the device reports.
    pub fn ready(&mut self) -> Result<bool, String> {
        match &mut self.on_gpu {
            Some(on_gpu) if !on_gpu.patient => {
                if on_gpu.fetching.is_some() {
                    // Whoever asked for the cells sees them before the next step makes them old.
                    on_gpu.bring(&mut self.world).map_err(|error| error.to_string())?;
                    return Ok(false);
                }
                Ok(on_gpu.step.ready(&on_gpu.gpu))
            }
            _ => Ok(true),
        }
    }

    /// The scene that is drawn; `None` if what draws no longer fits.
    pub fn shown(&self) -> Option<&Scene> {
        (!self.stale).then_some(&self.running)
    }

    /// Steps that were due and could not be taken: their time has not passed.
    pub fn give_back(&mut self, steps: u32) {
        let most = self.world.model.dt * f64::from(self.world.scene.budget.catch_up);
        self.world.state.pending_seconds = (self.world.state.pending_seconds + f64::from(steps) * self.world.model.dt).min(most);
    }

    /// A change was refused while it was made ready: the panel shows what runs.
    pub fn refused(&mut self) {
        self.edited = self.running.clone();
    }

    /// Where it is stepped.
    pub fn backend(&self) -> Backend {
        if self.on_gpu.is_some() { Backend::Gpu } else { Backend::Cpu }
    }

    /// Steps elsewhere from now on; the state goes along. `false`: not yet, as in [`Stage::bring`]. Where there is no device the processor steps.
    ///
    /// # Errors
    /// What the device reports.
    pub fn step_on(&mut self, backend: Backend) -> Result<bool, String> {
        match (backend, &self.on_gpu, &self.means) {
            (Backend::Gpu, None, Means::Device { gpu, patient, .. }) => {
                let step = GpuStep::new(gpu, &self.world).map_err(|error| error.to_string())?;
                let (gpu, patient, now) = (Arc::clone(gpu), *patient, self.world.state.step);
                self.on_gpu = Some(OnGpu { step, gpu, patient, fetching: None, fetched: Some(now) });
            }
            (Backend::Cpu, Some(_), _) => {
                if !self.bring()? {
                    return Ok(false);
                }
                self.on_gpu = None;
            }
            _ => {}
        }
        Ok(true)
    }

    /// Takes over a changed scene while it runs, if what has changed can be changed so and takes no time that anybody would feel; `false`: it must be
    /// made ready beside this one, with [`Stage::changed`]. The cells must have been [brought](Stage::bring).
    ///
    /// # Errors
    /// What is wrong with it; the scene before goes on.
    pub fn adopt(&mut self, scene: &Scene) -> Result<bool, String> {
        if self.adopted > FELT || !fits(&self.running, scene) {
            return Ok(false);
        }
        let begun = Instant::now();
        let backend = self.backend();
        self.drawn = None;
        self.step_on(Backend::Cpu)?;
        let kept = self.world.rescene(with_drivers(&self.world, scene), &*self.source.assets(self.painted.clone()));
        let kept = match kept {
            Ok(kept) => kept,
            Err(error) => {
                self.step_on(backend)?;
                return Err(error.to_string());
            }
        };
        (self.edited, self.running) = (scene.clone(), scene.clone());
        if !kept.stands.iter().chain(&kept.bodies).all(|fate| fate.is_kept()) {
            self.stale = true;
            return Ok(false);
        }
        self.step_on(backend)?;
        self.adopted = begun.elapsed().as_secs_f64() * 1e3;
        Ok(true)
    }

    /// How many steps are due.
    pub fn due(&mut self, passing: Passing) -> u32 {
        match passing {
            Passing::Steps(steps) => {
                self.world.state.pending_seconds = 0.0;
                steps
            }
            Passing::Seconds(seconds) => self.world.take_steps(seconds),
        }
    }

    /// Takes a step, with bodies where somebody puts them.
    ///
    /// # Errors
    /// What the device reports.
    pub fn step(&mut self, moves: &[Move], times: &mut Times) -> Result<(), String> {
        for moved in moves {
            let world = &mut self.world;
            if !world.drive(moved.body, moved.ground, moved.yaw, moved.clearance) && world.take_over(moved.body).is_some() {
                world.drive(moved.body, moved.ground, moved.yaw, moved.clearance);
            }
        }
        let mut before = Instant::now();
        if let Some(OnGpu { step, gpu, patient, .. }) = &mut self.on_gpu {
            let asked = *patient && times.asks() && times.pictures().is_multiple_of(CLOCK);
            step.stopwatch = if asked { Stopwatch::new(gpu) } else { None };
            step.step(gpu, &mut self.world).map_err(|error| error.to_string())?;
            times.lap("plan and submit", &mut before);
            return told(&mut step.stopwatch, gpu, times);
        }
        let plan = self.world.plan();
        times.lap("plan", &mut before);
        let reports = self.world.respond_in_stages(&plan, &mut |stage| times.lap(timing::name(stage), &mut before));
        self.world.finish(reports);
        times.lap("finish", &mut before);
        Ok(())
    }

    /// Draws; nothing where that is what was drawn last, or where the device is not `free`.
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw(&mut self, shot: Shot, free: bool, times: &mut Times) -> Result<Option<Shown>, String> {
        self.world.viewed = shot.view;
        let moment = (self.world.state.step, shot);
        let timed = match &self.means {
            Means::Device { gpu, patient: true, .. } => Some(gpu),
            _ => None,
        };
        if !self.stale && free && self.drawn != Some(moment) {
            let mut before = Instant::now();
            let asked = times.asks() && times.pictures().is_multiple_of(CLOCK);
            if let (Some(stopwatch), Some(gpu)) = (self.painter.stopwatch(), timed) {
                *stopwatch = if asked { Stopwatch::new(gpu) } else { None };
            }
            let step = self.on_gpu.as_ref().map(|on_gpu| &on_gpu.step);
            self.painter.draw(&self.means, &self.world, step, &shot)?;
            self.drawn = Some(moment);
            if let Means::Device { gpu, patient: false, pace } = &self.means {
                pace.hand_in(&gpu.queue);
            }
            times.lap(timing::SUBMITTED, &mut before);
            if let (Some(stopwatch), Some(gpu)) = (self.painter.stopwatch(), timed) {
                told(stopwatch, gpu, times)?;
            }
        }
        Ok(self.painter.shown())
    }

    /// Whether anything has been drawn of it yet.
    pub fn has_picture(&self) -> bool {
        self.painter.shown().is_some()
    }

    /// The step that the last picture shows.
    pub fn drawn(&self) -> Option<u64> {
        self.drawn.map(|(step, ..)| step)
    }

    /// Reads the last picture back; waits for the device.
    ///
    /// # Errors
    /// What the device reports.
    pub fn picture(&self) -> Result<Picture, String> {
        self.painter.read(&self.means)
    }
}

impl OnGpu {
    /// See [`Stage::bring`].
    fn bring(&mut self, world: &mut World) -> Result<bool, GpuError> {
        let now = world.state.step;
        if self.fetched == Some(now) {
            return Ok(true);
        }
        let mut fetching = match self.fetching.take() {
            Some(fetching) => fetching,
            None => self.step.begin_download(&self.gpu, world),
        };
        if self.patient || self.step.arrived(&self.gpu, &mut fetching) {
            self.step.finish_download(&self.gpu, world, fetching)?;
            self.fetched = Some(now);
            return Ok(true);
        }
        self.fetching = Some(fetching);
        Ok(false)
    }
}

/// What the device's clock said, where it was asked.
fn told(stopwatch: &mut Option<Stopwatch>, gpu: &Gpu, times: &mut Times) -> Result<(), String> {
    if let Some(mut stopwatch) = stopwatch.take() {
        for (stage, milliseconds) in stopwatch.read(gpu).map_err(|error| error.to_string())? {
            times.add(stage, true, milliseconds);
        }
    }
    Ok(())
}

/// The same scene, with every body that somebody drives where it is now.
fn with_drivers(world: &World, scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let corner = scene.origin.map(|patch| f64::from(patch) * f64::from(scene.field.patch_side));
    for (body, state) in scene.interactors.iter_mut().zip(&world.state.bodies) {
        if let Some((ground, yaw, _)) = state.driven {
            body.path = Path::Driven(Driven { at: [0, 1].map(|axis| ground[axis] + corner[axis]), yaw: yaw as f32 });
        }
    }
    scene
}

/// Whether what draws one scene can draw the other, too.
fn fits(running: &Scene, scene: &Scene) -> bool {
    still(running) == still(scene) && responses(running) == responses(scene)
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
