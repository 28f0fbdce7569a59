//! A device that is lost, or has no room left: errors with words, no panic, no waiting for ever, and a way to go on.

#[path = "support/adapter.rs"]
mod adapter;
#[allow(dead_code)]
#[path = "../../sward/tests/figures/glb.rs"]
mod glb;

use std::process::ExitCode;

use adapter::{Test, Verdict, ensure};
use sward::{model::Assets, model::NoAssets, scene::Scene, world::World};
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::{Gpu, GpuError};
use sward_wgpu::studio::{CellsAt, Studio};

/// Wind, a body, upper segments: every pass runs.
const SCENE: &str = "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], wind: [Natural(velocity: (3.0, 1.0))],
    budget: (patches: 16, focus_distance: 12.0, lag_distance: 12.0),
    interactors: [(shape: Sphere(radius: 0.6), path: Circle(radius: 3.0, speed: 4.0)), (shape: Truck)])";
const SIZE: [u32; 2] = [64, 48];

fn world() -> Result<World, libtest_mimic::Failed> {
    Ok(World::new(Scene::parse(SCENE, "loss.ron")?, &NoAssets)?)
}

fn lost<T>(what: &str, result: Result<T, GpuError>) -> Verdict {
    match result {
        Err(GpuError::Lost { reason }) if reason == "it was destroyed" => Ok(()),
        Err(other) => Err(format!("{what}: {other}").into()),
        Ok(_) => Err(format!("{what}: no error").into()),
    }
}

/// Everything that can be asked of a device fails with the loss; what was saved before goes on on the CPU, and on another device.
fn a_lost_device_is_an_error_everywhere(_: &Gpu) -> Verdict {
    let gpu = Gpu::new()?;
    let mut world = world()?;
    let mut step = GpuStep::new(&gpu, &world)?;
    let mut studio = Studio::new(&gpu, &world)?;
    for _ in 0..6 {
        step.step(&gpu, &mut world)?;
    }
    studio.draw(&gpu, &world, CellsAt::Gpu(&step), SIZE)?;
    step.download(&gpu, &mut world)?;
    let saved = world.save();
    // Work and summaries are on their way when it happens.
    step.step(&gpu, &mut world)?;
    gpu.device.destroy();
    lost("the step that notices", step.step(&gpu, &mut world))?;
    let (before, hash) = (world.state.step, world.hash());
    for _ in 0..4 {
        lost("step", step.step(&gpu, &mut world))?;
    }
    lost("download", step.download(&gpu, &mut world))?;
    lost("draw", studio.draw(&gpu, &world, CellsAt::Gpu(&step), SIZE))?;
    lost("draw cells of the CPU", studio.draw(&gpu, &world, CellsAt::Cpu, [32, 32]))?;
    lost("a new step", GpuStep::new(&gpu, &world))?;
    lost("a new studio", Studio::new(&gpu, &world))?;
    lost("check", gpu.check())?;
    ensure((world.state.step, world.hash()) == (before, hash), || "the world moved on without its cells".to_owned())?;
    drop((step, studio));
    goes_on(&mut world, &saved)
}

fn goes_on(world: &mut World, saved: &[u8]) -> Verdict {
    let mut control = self::world()?;
    control.restore(saved)?;
    world.restore(saved)?;
    let other = Gpu::new()?;
    let mut step = GpuStep::new(&other, &control)?;
    for _ in 0..30 {
        world.step();
        step.step(&other, &mut control)?;
    }
    step.download(&other, &mut control)?;
    ensure(world.state.step == 36 && world.hash() != self::world()?.hash(), || "the world stands still".to_owned())?;
    let [cpu, gpu] = [&*world, &control]
        .map(|world| world.state.stands[0].cells.now.iter().flat_map(|cells| cells.iter()).copied().collect::<Vec<f32>>());
    let worst = cpu.iter().zip(&gpu).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    ensure(worst < 1e-3, || format!("on the CPU and on a new device: {worst} apart"))
}

/// A body that plays a clip: its mesh is sent anew for each picture.
struct Post;

impl Assets for Post {
    fn read(&self, _: &str) -> Result<Vec<u8>, String> {
        Ok(glb::post().bytes())
    }
}

/// Outputs beside pictures, too: those that go on, and the first ones. Controls: before the loss all of them come.
fn outputs_of_a_lost_device_are_errors(_: &Gpu) -> Verdict {
    let gpu = Gpu::new()?;
    let scene = SCENE.replace("(shape: Truck)", r#"(shape: Mesh(file: "post.glb", clip: "Bow"), path: Circle(radius: 1, speed: 1))"#);
    let mut world = World::new(Scene::parse(&scene, "loss.ron")?, &Post)?;
    let mut step = GpuStep::new(&gpu, &world)?;
    let [mut cells_here, mut cells_there, mut fresh] = [Studio::new(&gpu, &world)?, Studio::new(&gpu, &world)?, Studio::new(&gpu, &world)?];
    for _ in 0..3 {
        step.step(&gpu, &mut world)?;
    }
    cells_here.draw_aov(&gpu, &world, CellsAt::Cpu, 0.0, SIZE)?;
    cells_there.draw_aov(&gpu, &world, CellsAt::Gpu(&step), 0.0, SIZE)?;
    cells_there.remember(&gpu, &world, CellsAt::Gpu(&step), 0.0)?;
    // A destroyed device says so once its work is done, and this work nobody has waited for.
    gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
    gpu.device.destroy();
    for studio in [&mut cells_here, &mut cells_there, &mut fresh] {
        lost("remember", studio.remember(&gpu, &world, CellsAt::Gpu(&step), 0.0))?;
        lost("remember cells of the CPU", studio.remember(&gpu, &world, CellsAt::Cpu, 0.0))?;
        lost("outputs", studio.draw_aov(&gpu, &world, CellsAt::Gpu(&step), 0.0, SIZE))?;
        lost("outputs of cells of the CPU", studio.draw_aov(&gpu, &world, CellsAt::Cpu, 0.0, SIZE))?;
    }
    Ok(())
}

/// Destroyed before anything was asked of it, and at each moment of a short run.
fn a_device_may_be_lost_at_any_moment(_: &Gpu) -> Verdict {
    for moment in 0..5 {
        let gpu = Gpu::new()?;
        let mut world = world()?;
        let mut step = GpuStep::new(&gpu, &world)?;
        (0..moment).try_for_each(|_| step.step(&gpu, &mut world))?;
        gpu.device.destroy();
        if moment % 2 == 0 {
            lost("download", step.download(&gpu, &mut world))?;
        }
        lost("step", step.step(&gpu, &mut world))?;
    }
    Ok(())
}

/// Larger than the device allows: its words come back.
fn what_no_device_has_is_an_error(_: &Gpu) -> Verdict {
    let gpu = Gpu::new()?;
    let side = gpu.device.limits().max_texture_dimension_2d + 1;
    let _texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("too large"),
        size: wgpu::Extent3d { width: side, height: 1, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    match gpu.check() {
        Err(GpuError::Device(text)) if text.contains("too large") || text.contains("imit") => {}
        other => return Err(format!("{other:?}").into()),
    }
    ensure(gpu.check().is_ok(), || "told twice".to_owned())
}

/// A device that may take one per cent of the memory there is.
fn narrow() -> Option<Gpu> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::VULKAN;
    descriptor.flags = wgpu::InstanceFlags::empty();
    descriptor.memory_budget_thresholds = wgpu::MemoryBudgetThresholds { for_resource_creation: Some(1), for_device_loss: None };
    let adapters = pollster::block_on(wgpu::Instance::new(descriptor).enumerate_adapters(wgpu::Backends::VULKAN));
    let adapter = adapters.into_iter().next()?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).ok()?;
    Some(Gpu::watch(device, queue, adapter.get_info()))
}

/// Takes memory until there is none; the buffers are never touched.
fn filled_up(gpu: &Gpu) -> (Vec<wgpu::Buffer>, Option<String>) {
    let mut buffers = Vec::new();
    for _ in 0..64 {
        buffers.push(gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("ballast"),
            size: gpu.device.limits().max_buffer_size,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        }));
        match gpu.check() {
            Err(GpuError::OutOfMemory { what }) => return (buffers, Some(what)),
            Err(other) => return (buffers, Some(format!("not for want of memory: {other}"))),
            Ok(()) => {}
        }
    }
    (buffers, None)
}

fn a_full_device_is_an_error(_: &Gpu) -> Verdict {
    let gpu = narrow().ok_or("the device opened a moment ago")?;
    let control = Studio::new(&gpu, &world()?).map_err(|error| format!("control: there is room at first: {error}"))?;
    drop(control);
    let (buffers, what) = filled_up(&gpu);
    let what = what.ok_or("it was full a moment ago")?;
    ensure(what.contains("ballast"), || format!("what did not fit is named: {what}"))?;
    // Small buffers still find room in blocks that are there already; fill those, too.
    let scene = SCENE.replace("cells: 32", "cells: 256").replace("patches: 16", "patches: 400");
    let mut world = World::new(Scene::parse(&scene, "loss.ron")?, &NoAssets)?;
    (0..2).for_each(|_| world.step());
    match GpuStep::new(&gpu, &world) {
        Err(GpuError::OutOfMemory { .. }) => {}
        Err(other) => return Err(format!("{other}").into()),
        Ok(_) => return Err("there was room".into()),
    }
    drop(buffers);
    Ok(())
}

/// Whether a test cannot run here.
fn skip(_: &Gpu, name: &str) -> Option<String> {
    if name != "a_full_device_is_an_error" {
        return None;
    }
    let full = narrow().is_some_and(|gpu| filled_up(&gpu).1.is_some());
    (!full).then(|| "this driver does not say how much memory is left".to_owned())
}

fn main() -> ExitCode {
    let tests: &[Test] = &[
        ("a_lost_device_is_an_error_everywhere", a_lost_device_is_an_error_everywhere),
        ("outputs_of_a_lost_device_are_errors", outputs_of_a_lost_device_are_errors),
        ("a_device_may_be_lost_at_any_moment", a_device_may_be_lost_at_any_moment),
        ("what_no_device_has_is_an_error", what_no_device_has_is_an_error),
        ("a_full_device_is_an_error", a_full_device_is_an_error),
    ];
    adapter::run(tests, skip)
}
