//! The step and the picture under the driver's validation layer (`SWARD_VALIDATION=1`): it has nothing to say.

#[path = "support/slope.rs"]
mod slope;
#[path = "support/soak.rs"]
mod soak;
mod support;

use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial};
use sward::{model::NoAssets, scene::Scene, world::World};
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

/// Wind, a body, upper segments, a species that needs no segments, one of blades, and a shrub in layers: every pass runs.
const SCENE: &str = "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32), (species: Lawn, cells: 32), (species: Tussock, cells: 32, representation: Blade(blades: 3)),
        (species: Shrub, places: [(at: (1, 4), height: 1.5)], representation: Layers(mesh: Grown(triangles: 2000)))],
    wind: [Natural(velocity: (3.0, 1.0))], budget: (patches: 25, focus_distance: 12.0, lag_distance: 12.0),
    interactors: [(name: \"ball\", shape: Sphere(radius: 0.6), path: Circle(radius: 3.0, speed: 4.0))])";

fn silent(messages: &[String]) -> Result<(), Failed> {
    if messages.is_empty() { Ok(()) } else { Err(messages.join("\n").into()) }
}

fn step_and_picture() -> Result<(), Failed> {
    let watch = support::Watch::install();
    let gpu = Gpu::new()?;
    let mut world = World::new(Scene::parse(SCENE, "validation.ron")?, &NoAssets)?;
    let mut step = GpuStep::new(&gpu, &world)?;
    for _ in 0..12 {
        step.step(&gpu, &mut world)?;
    }
    let mut studio = Studio::new(&gpu, &world)?;
    studio.draw(&gpu, &world, CellsAt::Gpu(&step), [64, 48])?;
    for _ in 0..2 {
        studio.draw_aov(&gpu, &world, CellsAt::Gpu(&step), 0.5, [64, 48])?;
        step.step(&gpu, &mut world)?;
    }
    step.download(&gpu, &mut world)?;
    drop((studio, step, gpu));
    silent(&watch.take())
}

/// The watch hears the layer's channel, and only that.
fn the_watch_hears() -> Result<(), Failed> {
    let watch = support::Watch::install();
    log::warn!(target: "wgpu_hal::vulkan::instance", "a message of the layer");
    log::warn!(target: "wgpu_hal::vulkan::instance", "\tobjects: a list");
    log::debug!(target: "wgpu_hal::vulkan::instance", "chatter");
    log::warn!(target: "elsewhere", "another message");
    let heard = watch.take();
    if heard != ["a message of the layer"] {
        return Err(format!("heard {heard:?}").into());
    }
    if silent(&heard).is_ok() {
        return Err("a message did not fail the test".into());
    }
    Ok(())
}

fn main() -> ExitCode {
    // One after the other: the watch is shared.
    let arguments = Arguments { test_threads: Some(1), ..Arguments::from_args() };
    support::Watch::install();
    let ready = support::adapter();
    let ignored = matches!(ready, Ok(false));
    let of_picture = ready.clone();
    let picture = move || of_picture.map_err(Failed::from).and_then(|_| step_and_picture());
    let trials = vec![
        Trial::test("step_and_picture_leave_the_layer_silent", picture).with_ignored_flag(ignored),
        Trial::test("everything_stays_sound_for_long", move || ready.map_err(Failed::from).and_then(|_| soak::soak()))
            .with_ignored_flag(ignored),
        Trial::test("the_watch_hears_the_layer", the_watch_hears),
    ];
    libtest_mimic::run(&arguments, trials).exit_code()
}
