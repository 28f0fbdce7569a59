//! What only the device itself can tell: the time of each pass, and of half precision against full.

use sward::scene::Precision;
use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::stopwatch::Stopwatch;

use super::PAIRS;
use super::measure::{Interval, Stages, interval, seconds};
use crate::artist::Artist;
use crate::backend::Backend;
use crate::failure::Failure;
use crate::progress::Progress;

/// Steps timed pass by pass.
pub(crate) fn time_steps(
    world: &mut World,
    backend: &mut Backend<'_>,
    steps: u32,
    stages: &mut Stages,
    progress: &mut Progress,
) -> Result<(), Failure> {
    let Backend::Gpu(gpu, step) = backend else { return Ok(()) };
    step.stopwatch = Stopwatch::new(gpu);
    for _ in 0..steps {
        step.step(gpu, world)?;
        progress.advance();
        let Some(stopwatch) = &mut step.stopwatch else { continue };
        for (stage, milliseconds) in stopwatch.read(gpu)? {
            stages.add(stage, milliseconds);
        }
    }
    step.stopwatch = None;
    Ok(())
}

/// Pictures timed pass by pass.
pub(crate) fn time_pictures(
    world: &mut World,
    backend: &mut Backend<'_>,
    artist: &mut Artist<'_>,
    (pictures, size): (u32, [u32; 2]),
    stages: &mut Stages,
    progress: &mut Progress,
) -> Result<(), Failure> {
    let Artist::Gpu(gpu, studio) = artist else { return Ok(()) };
    *studio.stopwatch() = Stopwatch::new(gpu);
    for _ in 0..pictures {
        studio.draw(gpu, world, backend.cells(), size)?;
        progress.advance();
        let Some(stopwatch) = studio.stopwatch() else { continue };
        for (stage, milliseconds) in stopwatch.read(gpu)? {
            stages.add(stage, milliseconds);
        }
    }
    *studio.stopwatch() = None;
    Ok(())
}

/// One precision of a world, stepping on its own.
struct Run<'a> {
    gpu: &'a Gpu,
    world: World,
    step: GpuStep,
}

impl Run<'_> {
    /// Seconds of a step, waited for.
    fn step(&mut self) -> Result<f64, Failure> {
        let (seconds, done) = seconds(|| -> Result<(), Failure> {
            self.step.step(self.gpu, &mut self.world)?;
            Ok(self.step.wait(self.gpu, &mut self.world)?)
        });
        done.map(|()| seconds)
    }
}

/// Time of a step at half precision over that at full, from pairs in ABBA order; `None` where the simulation is not on a GPU.
pub(crate) fn half_to_full(world: &mut World, backend: &mut Backend<'_>, progress: &mut Progress) -> Result<Option<Interval>, Failure> {
    backend.fetch(world)?;
    let Backend::Gpu(gpu, _) = backend else { return Ok(None) };
    let run = |precision: Precision| -> Result<Run<'_>, Failure> {
        let mut world = world.clone();
        world.scene.budget.precision = precision;
        let step = GpuStep::new(gpu, &world)?;
        Ok(Run { gpu, world, step })
    };
    let (mut full, mut half) = (run(Precision::Full)?, run(Precision::Half)?);
    let mut ratios = Vec::new();
    for pair in 0..PAIRS {
        let (first, second) = if pair % 2 == 0 { (&mut half, &mut full) } else { (&mut full, &mut half) };
        let [a, b, c, d] = [first.step()?, second.step()?, second.step()?, first.step()?];
        progress.advance();
        let ratio = (a + d) / (b + c);
        ratios.push(if pair % 2 == 0 { ratio } else { 1.0 / ratio });
    }
    Ok(interval(ratios))
}
