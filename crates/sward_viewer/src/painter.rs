//! What draws: a graphics device, or the processor alone where there is none.

use std::sync::Arc;

use sward::picture::Picture;
use sward::view::View;
use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::stopwatch::Stopwatch;
use sward_wgpu::studio::{CellsAt, Studio};

use crate::pace::Pace;

/// Most pixels of a picture that the processor draws: 240 × 135.
const PIXELS: f32 = 32400.0;

/// What there is to draw with, and to step on.
#[derive(Clone)]
pub enum Means {
    /// A graphics device.
    Device {
        /// The device.
        gpu: Arc<Gpu>,
        /// Whether anybody may wait for it: not in a browser.
        patient: bool,
        /// Pictures that it has before it.
        pace: Pace,
    },
    /// The processor alone.
    Processor,
}

impl Means {
    /// A device of this machine, which may be waited for unless this is a page.
    pub fn device(gpu: Gpu) -> Self {
        Self::Device { gpu: Arc::new(gpu), patient: !cfg!(target_arch = "wasm32"), pace: Pace::default() }
    }

    /// The device, if there is one.
    pub fn gpu(&self) -> Option<&Arc<Gpu>> {
        match self {
            Self::Device { gpu, .. } => Some(gpu),
            Self::Processor => None,
        }
    }

    /// What suits it: shares of the window's pixels, and of the distance up to which every plant is drawn. A `software` adapter shares the processor
    /// with everything else.
    pub fn usual(&self, software: bool) -> [f32; 2] {
        match self {
            Self::Device { .. } if software => [0.5; 2],
            Self::Device { .. } => [1.0; 2],
            Self::Processor => [1.0, 0.2],
        }
    }

    /// Whether another picture can be asked for; always where waiting is allowed.
    pub fn is_free(&self) -> bool {
        match self {
            Self::Device { patient: false, pace, .. } => pace.is_free(),
            _ => true,
        }
    }

    /// What panels say of it.
    pub fn name(&self) -> &str {
        match self {
            Self::Device { gpu, .. } if gpu.adapter_info.name.is_empty() => "the browser's graphics device",
            Self::Device { gpu, .. } => &gpu.adapter_info.name,
            Self::Processor => "no graphics device: the processor draws",
        }
    }

    /// The size in which a picture for so many pixels is drawn.
    pub fn fitting(&self, size: [u32; 2]) -> [u32; 2] {
        let [width, height] = size.map(|side| side.max(1) as f32);
        let share = (PIXELS / (width * height)).sqrt();
        match self {
            Self::Processor if share < 1.0 => [width, height].map(|side| (side * share).round().max(1.0) as u32),
            _ => size,
        }
    }
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// From where; `None`: as the scene's own camera sees it.
    pub view: Option<View>,
    /// Steps, 0 to 1, before the state.
    pub behind: f64,
    /// Pixels.
    pub size: [u32; 2],
    /// Share, 0.05 to 1, of the distance up to which every plant is drawn.
    pub near: f64,
}

/// Draws one world.
pub enum Painter {
    /// On a device.
    Device(Box<Studio>),
    /// On the processor, with the last picture.
    Processor(Box<sward_raster::Studio>, Option<Arc<Picture>>),
}

/// A picture, where it was drawn.
#[derive(Clone)]
pub enum Shown {
    /// On the device.
    Texture(wgpu::Texture),
    /// Here.
    Pixels(Arc<Picture>),
}

impl Painter {
    /// Makes what stays the same from picture to picture; takes long.
    ///
    /// # Errors
    /// What the device reports, in plain words.
    pub fn new(means: &Means, world: &World) -> Result<Self, String> {
        Ok(match means {
            Means::Device { gpu, .. } => Self::Device(Box::new(Studio::new(gpu, world).map_err(|error| error.to_string())?)),
            Means::Processor => Self::Processor(Box::new(sward_raster::Studio::new(world)), None),
        })
    }

    /// Draws a moment, with cells of the device where it steps.
    ///
    /// # Errors
    /// What the device reports, in plain words.
    pub fn draw(&mut self, means: &Means, world: &World, step: Option<&GpuStep>, shot: &Shot) -> Result<(), String> {
        let (size, behind) = (means.fitting(shot.size), shot.behind);
        match (self, means) {
            (Self::Device(studio), Means::Device { gpu, .. }) => {
                studio.thin(shot.near);
                let cells = step.map_or(CellsAt::Cpu, CellsAt::Gpu);
                studio.show(gpu, world, cells, behind, size).map_err(|error| error.to_string())?;
            }
            (Self::Processor(studio, shown), _) => {
                studio.thin(shot.near);
                *shown = Some(Arc::new(studio.draw_before(world, behind, size)));
            }
            (Self::Device(_), Means::Processor) => {}
        }
        Ok(())
    }

    /// The last picture.
    pub fn shown(&self) -> Option<Shown> {
        match self {
            Self::Device(studio) => studio.shown().cloned().map(Shown::Texture),
            Self::Processor(_, shown) => shown.clone().map(Shown::Pixels),
        }
    }

    /// The last picture's pixels; waits for the device.
    ///
    /// # Errors
    /// What the device reports, in plain words.
    pub fn read(&self, means: &Means) -> Result<Picture, String> {
        match (self, means) {
            (Self::Device(studio), Means::Device { gpu, .. }) => studio.read(gpu).map_err(|error| error.to_string()),
            (Self::Processor(_, Some(shown)), _) => Ok(Picture::clone(shown)),
            _ => Err("nothing is drawn yet".to_owned()),
        }
    }

    /// What times the passes on the device while there is one.
    pub fn stopwatch(&mut self) -> Option<&mut Option<Stopwatch>> {
        match self {
            Self::Device(studio) => Some(studio.stopwatch()),
            Self::Processor(..) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_draws_small_pictures_of_the_same_shape() {
        assert_eq!(Means::Processor.fitting([1920, 1080]), [240, 135]);
        assert_eq!(Means::Processor.fitting([135, 60]), [135, 60], "control: no larger than asked for");
        let [width, height] = Means::Processor.fitting([300, 3000]);
        assert!((8..=12).contains(&(height / width)) && width * height <= 33000, "{width} × {height}");
    }

    #[test]
    fn the_processor_shows_something() {
        let scene =
            sward::scene::Scene::parse("(version: 1, stands: [(species: Lawn, cells: 16)], field: (patch_side: 8, patches: (3, 3)))", "x");
        let world = World::new(scene.expect("valid"), &sward::model::NoAssets).expect("compiles");
        let mut painter = Painter::new(&Means::Processor, &world).expect("needs nothing");
        assert!(painter.shown().is_none() && painter.read(&Means::Processor).is_err(), "control: nothing is drawn");
        let shot = Shot { view: None, behind: 0.0, size: [64, 36], near: 0.2 };
        painter.draw(&Means::Processor, &world, None, &shot).expect("draws");
        let picture = painter.read(&Means::Processor).expect("drawn");
        assert_eq!([picture.width, picture.height], [64, 36]);
        let first = &picture.rgba8[..4];
        assert!(picture.rgba8.chunks_exact(4).any(|pixel| pixel != first), "it is flat");
    }
}
