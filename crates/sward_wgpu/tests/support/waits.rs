//! A host that never waits takes the same steps, and gets the same cells, as one that does.

use std::time::{Duration, Instant};

use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::runs::world;

/// Everything that is downloaded: cells, upper segments, ground, air that flows.
const SCENE: &str = "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)],
    wind: [Natural(velocity: (3.0, 1.0)), Fluid()], budget: (patches: 16, focus_distance: 12.0, lag_distance: 12.0),
    interactors: [(shape: Sphere(radius: 0.6), path: Circle(radius: 3.0, speed: 4.0))])";
const STEPS: u64 = 20;
/// A device that takes longer for a step is no longer believed in.
const PATIENCE: Duration = Duration::from_secs(60);

/// Looks again and again, as a page does from picture to picture. How often it had to.
fn until(mut done: impl FnMut() -> bool) -> Result<u32, String> {
    let begun = Instant::now();
    let mut looks = 0;
    while !done() {
        looks += 1;
        if begun.elapsed() > PATIENCE {
            return Err(format!("not ready after {looks} looks"));
        }
        std::thread::sleep(Duration::from_micros(200));
    }
    Ok(looks)
}

/// What a host gets that waits.
fn waiting(gpu: &Gpu, steps: u64) -> Result<World, libtest_mimic::Failed> {
    let mut world = world(SCENE)?;
    let mut step = GpuStep::new(gpu, &world)?;
    for _ in 0..steps {
        step.step(gpu, &mut world)?;
    }
    step.download(gpu, &mut world)?;
    Ok(world)
}

pub(crate) fn nobody_waits(gpu: &Gpu) -> Verdict {
    let mut world = world(SCENE)?;
    let mut step = GpuStep::new(gpu, &world)?;
    let mut looks = 0;
    ensure(step.ready(gpu), || "nothing was begun, yet it is not ready".to_owned())?;
    for _ in 0..STEPS - 1 {
        looks += until(|| step.ready(gpu))?;
        step.step(gpu, &mut world)?;
    }
    // Asked for too early: the world goes on, and what comes must be of the step it is then in.
    let early = step.begin_download(gpu, &world);
    step.step(gpu, &mut world)?;
    step.finish_download(gpu, &mut world, early)?;
    let reference = waiting(gpu, STEPS)?;
    ensure(world.hash() == reference.hash(), || "an early download brought other cells".to_owned())?;
    // And in two halves; a step in between would not have been asked for.
    let mut download = step.begin_download(gpu, &world);
    looks += until(|| step.arrived(gpu, &mut download))?;
    let emptied = std::mem::take(&mut world.state.stands[0].cells.now);
    step.finish_download(gpu, &mut world, download)?;
    println!("{looks} looks in {STEPS} steps");
    ensure(!emptied.is_empty() && world.hash() == reference.hash(), || "two halves brought other cells".to_owned())?;
    ensure(waiting(gpu, STEPS - 1)?.hash() != reference.hash(), || "control: a step more or less makes no difference".to_owned())
}
