//! Frames of a paper's scene, timed: a step and a picture, waited for.

use std::cell::RefCell;
use std::rc::Rc;

use sward::model::Assets;
use sward::scene::Scene;
use sward::view::View;
use sward::world::World;
use sward_scenes::Embedded;
use sward_wgpu::gpu::Gpu;

use super::super::measure::{Interval, interval, seconds};
use crate::arguments::{Draw, Where};
use crate::artist::Artist;
use crate::backend::Backend;
use crate::cache::Cache;
use crate::console::Console;
use crate::failure::Failure;

/// Steps before anything is timed: patches are awake, bodies drive.
const WARM_UP: u32 = 60;

/// What runs and draws all scenes.
pub(super) struct Machine<'a> {
    pub(super) gpu: Option<&'a Gpu>,
    pub(super) on: Where,
    pub(super) draw: Draw,
    pub(super) cache: &'a Cache,
    pub(super) console: &'a Console,
    /// Pairs of frames behind a ratio.
    pub(super) pairs: u32,
    /// Share of the papers' counts and pixels: 1, but for tests.
    pub(super) scale: f64,
}

/// What draws one scene, or several that look alike.
pub(super) type Drawer<'a> = Rc<RefCell<Artist<'a>>>;

/// A scene, frame by frame.
pub(super) struct Film<'a> {
    pub(super) world: World,
    backend: Backend<'a>,
    drawer: Drawer<'a>,
    size: [u32; 2],
    /// Nothing moves: no step is taken.
    frozen: bool,
    /// How far the viewer goes round from frame to frame, rad.
    turn: f64,
}

impl<'a> Machine<'a> {
    /// A share of a paper's count, at least `least`.
    pub(super) fn count(&self, printed: u32, least: u32) -> u32 {
        ((f64::from(printed) * self.scale).round() as u32).max(least)
    }

    /// A picture's size, with that share of the pixels.
    pub(super) fn size(&self, printed: [u32; 2]) -> [u32; 2] {
        printed.map(|side| ((f64::from(side) * self.scale.sqrt()) as u32).max(16))
    }

    /// A world of a scene, at time 0.
    pub(super) fn world(&self, scene: Scene) -> Result<World, Failure> {
        let assets: &dyn Assets = &Embedded;
        Ok(World::new(scene, assets)?)
    }

    /// What draws a world.
    pub(super) fn drawer(&self, world: &World, size: [u32; 2]) -> Result<Drawer<'a>, Failure> {
        Ok(Rc::new(RefCell::new(Artist::choose(self.draw, self.gpu, world, size, (self.cache, self.console))?)))
    }

    /// A film of a world, warmed up by steps and one picture.
    pub(super) fn film(&self, world: World, size: [u32; 2]) -> Result<Film<'a>, Failure> {
        let drawer = self.drawer(&world, size)?;
        let backend = Backend::choose(self.on, self.gpu, &world)?;
        let mut film = Film { world, backend, drawer, size, frozen: false, turn: 0.0 };
        for _ in 0..WARM_UP {
            film.backend.step(&mut film.world)?;
        }
        film.backend.wait(&mut film.world)?;
        film.frame()?;
        Ok(film)
    }

    /// Where steps run and what draws, for a line of a table.
    pub(super) fn name(&self) -> String {
        let adapter = self.gpu.map_or("the CPU", |gpu| &gpu.adapter_info.name);
        let is_on_gpu = self
            .gpu
            .is_some_and(|gpu| self.on == Where::Gpu || (self.on == Where::Auto && gpu.adapter_info.device_type != wgpu::DeviceType::Cpu));
        if is_on_gpu || self.gpu.is_none() { adapter.to_owned() } else { format!("{adapter}, steps on the CPU") }
    }
}

impl<'a> Film<'a> {
    /// The same moment over and over: what draws is shared, so its shaders and pixels are the same.
    pub(super) fn frozen(&mut self, machine: &Machine<'a>) -> Result<Self, Failure> {
        self.backend.fetch(&mut self.world)?;
        let world = self.world.clone();
        let backend = Backend::choose(machine.on, machine.gpu, &world)?;
        Ok(Self { world, backend, drawer: Rc::clone(&self.drawer), size: self.size, frozen: true, turn: 0.0 })
    }

    /// From now on the viewer goes round what he looks at, so far from frame to frame, rad.
    pub(super) fn go_round(&mut self, turn: f64) {
        self.turn = turn;
    }

    /// A step that nobody times.
    pub(super) fn step(&mut self) -> Result<(), Failure> {
        self.backend.step(&mut self.world)
    }

    /// One frame, waited for: seconds of the step and of the picture.
    pub(super) fn frame(&mut self) -> Result<[f64; 2], Failure> {
        if self.turn != 0.0 {
            self.world.viewed = Some(round(&self.world.camera(), self.turn));
        }
        let (stepped, done) = seconds(|| -> Result<(), Failure> {
            if !self.frozen {
                self.backend.step(&mut self.world)?;
                self.backend.wait(&mut self.world)?;
            }
            Ok(())
        });
        done?;
        let (drawn, picture) = seconds(|| self.drawer.borrow_mut().draw(&mut self.world, &mut self.backend, 0.0, self.size));
        picture?;
        Ok([stepped, drawn])
    }

    /// Median seconds of steps and pictures of some frames.
    pub(super) fn frames(&mut self, count: u32, progress: &mut dyn FnMut()) -> Result<[f64; 2], Failure> {
        let (mut steps, mut pictures) = (Vec::new(), Vec::new());
        for _ in 0..count.max(1) {
            let [step, picture] = self.frame()?;
            steps.push(step);
            pictures.push(picture);
            progress();
        }
        Ok([median(&mut steps), median(&mut pictures)])
    }
}

/// A view turned round what it looks at.
fn round(view: &View, turn: f64) -> View {
    let [x, z] = [0, 2].map(|axis: usize| view.eye[axis] - view.target[axis]);
    let (sine, cosine) = turn.sin_cos();
    let eye = [view.target[0] + cosine * x - sine * z, view.eye[1], view.target[2] + sine * x + cosine * z];
    View { eye, ..*view }
}

/// Frames of two films by turns.
pub(super) struct Pairs {
    /// Median seconds of a frame of each.
    pub(super) seconds: [f64; 2],
    /// Frames a second of the second film over those of the first.
    pub(super) ratio: Option<Interval>,
}

/// Measures two films in pairs of frames, in ABBA order.
pub(super) fn pairs(count: u32, films: [&mut Film<'_>; 2], progress: &mut dyn FnMut()) -> Result<Pairs, Failure> {
    let [a, b] = films;
    let (mut times, mut ratios) = ([Vec::new(), Vec::new()], Vec::new());
    for pair in 0..count.max(1) {
        let mut spent = [0.0; 2];
        let order = if pair % 2 == 0 { [0, 1, 1, 0] } else { [1, 0, 0, 1] };
        for which in order {
            let [step, picture] = if which == 0 { a.frame()? } else { b.frame()? };
            spent[which] += step + picture;
            times[which].push(step + picture);
            progress();
        }
        ratios.push(spent[0] / spent[1]);
    }
    let [first, second] = &mut times;
    Ok(Pairs { seconds: [median(first), median(second)], ratio: interval(ratios) })
}

/// Of one value or more; 0 of none.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// What other programs leave of the memory, bytes, where the system tells it.
pub(super) fn free_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.split_whitespace().next()?.parse::<u64>().ok().map(|kilobytes| 1024 * kilobytes)
}
