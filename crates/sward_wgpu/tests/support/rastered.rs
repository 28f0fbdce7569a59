//! A scene's picture from the CPU and from the GPU, and pictures that must not look like it.

use std::path::PathBuf;

use libtest_mimic::Failed;
use sward::model::Folder;
use sward::picture::Picture;
use sward::scene::Scene;
use sward::world::World;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

use crate::adapter::{Verdict, ensure};

/// Size of the pictures, pixels.
const SIZE: [u32; 2] = [320, 180];
/// Largest mean difference over pixels and channels, of 255, on software adapters. 0.1 to 0.5 when this was written.
const SOFTWARE: f64 = 1.0;
/// Hardware spreads alpha over samples in its own way.
const HARDWARE: f64 = 4.0;

fn difference(a: &Picture, b: &Picture) -> f64 {
    if [a.width, a.height] != [b.width, b.height] || a.rgba8.is_empty() {
        return f64::INFINITY;
    }
    let sum: f64 = a.rgba8.iter().zip(&b.rgba8).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
    sum / (0.75 * a.rgba8.len() as f64)
}

fn world_of(scene: Scene, root: PathBuf) -> Result<World, Failed> {
    Ok(World::new(scene, &Folder(root))?)
}

/// Compares a shipped scene's default view after `seconds`. Controls: the picture of 0.1 s later, and that without bodies.
fn same(gpu: &Gpu, name: &str, seconds: f64) -> Verdict {
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let text = std::fs::read_to_string(root.join("scenes").join(format!("{name}.ron")))?;
    let mut scene = Scene::parse(&text, name)?;
    // A gale wakes all the patches it may; the nearest are what is seen, and take a tenth of the time.
    scene.budget.patches = scene.budget.patches.min(25);
    let mut world = world_of(scene, root)?;
    (0..(seconds / world.model.dt).round() as u64).for_each(|_| world.step());
    let theirs = Studio::new(gpu, &world)?.draw(gpu, &world, CellsAt::Cpu, SIZE)?;
    let studio = sward_raster::Studio::new(&world);
    let ours = studio.draw(&world, SIZE);
    let apart = difference(&ours, &theirs);
    let most = if gpu.adapter_info.device_type == wgpu::DeviceType::Cpu { SOFTWARE } else { HARDWARE };
    (0..6).for_each(|_| world.step());
    let later = difference(&studio.draw(&world, SIZE), &theirs);
    println!("{name}: {apart:.3} of 255, 0.1 s later {later:.3}");
    ensure(apart <= most, || format!("{name}: CPU and GPU differ by {apart:.3} of 255 on average, allowed {most}"))?;
    ensure(later > most, || format!("{name}: 0.1 s later looks the same: {later:.3} of 255"))
}

pub(crate) fn hello(gpu: &Gpu) -> Verdict {
    same(gpu, "hello", 6.2)
}

pub(crate) fn lawn(gpu: &Gpu) -> Verdict {
    same(gpu, "lawn", 6.0)
}

pub(crate) fn reed(gpu: &Gpu) -> Verdict {
    same(gpu, "reed", 2.0)
}

pub(crate) fn crossing(gpu: &Gpu) -> Verdict {
    same(gpu, "crossing", 3.0)
}

pub(crate) fn paper(gpu: &Gpu) -> Verdict {
    same(gpu, "paper", 1.0)
}

pub(crate) fn endless(gpu: &Gpu) -> Verdict {
    same(gpu, "endless", 1.0)
}
