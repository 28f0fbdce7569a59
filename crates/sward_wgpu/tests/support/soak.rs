//! A long while of `everything`, in which bodies appear, vanish and jump at random: memory stays flat, all stays finite, and nobody complains.

use std::time::Instant;

use libtest_mimic::Failed;
use sward::math::{hash, unit};
use sward::model::Folder;
use sward::picture::standing::standing;
use sward::scene::{Interactor, Scene};
use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

use crate::slope::slope;
use crate::support::Watch;

/// Most bodies at once, beside those of the scene.
const CROWD: usize = 12;
/// Most that memory may seem to grow by over the whole time, bytes: ten minutes on a driver in software show 450 MB, 25 MB more or less, from the fifth on. Until
/// then buffers grow, whenever bodies wake more of the field than ever before.
const GROWTH: f64 = 50e6;
/// Who appears.
const BODIES: &str = "(version: 1, interactors: [
    (shape: Sphere(radius: 0.7), path: Driven()), (shape: Ellipsoid(radii: (0.4, 0.9, 0.4)), path: Driven()), (shape: Box(size: (1.2, 0.8, 2)), path: Driven()),
    (shape: Truck, path: Driven()), (shape: Mesh(file: \"assets/walker.glb\", clip: \"Walk\"), path: Driven())])";

/// A number from 0 to 1 for a step and a purpose.
fn drawn(step: u64, purpose: u32) -> f64 {
    f64::from(unit(hash(8, step as i32, 0, 0, purpose)))
}

/// Somewhere among the plants before the camera, m.
fn place(step: u64) -> [f64; 2] {
    [-14.0 + 20.0 * drawn(step, 1), -2.0 + 34.0 * drawn(step, 2)]
}

/// Who is there of the crowd, and how often each thing has happened.
#[derive(Default)]
struct Crowd {
    known: Vec<Interactor>,
    bodies: Vec<(usize, [f64; 2], f64)>,
    appeared: usize,
    vanished: usize,
    jumped: usize,
}

impl Crowd {
    /// Something happens to someone at random; all others go on their way at 2 m/s.
    fn act(&mut self, world: &mut World, assets: &Folder) -> Result<(), Failed> {
        let step = world.state.step;
        let someone = (drawn(step, 3) * self.bodies.len() as f64) as usize;
        let yaw = 6.3 * drawn(step, 4);
        match (drawn(step, 5), self.bodies.len()) {
            (0.00..0.15, 0..CROWD) => {
                let body = self.known[(drawn(step, 6) * self.known.len() as f64) as usize].clone();
                let body = world.add_body(body, assets)?;
                world.teleport(body, place(step), yaw, 0.0);
                self.bodies.push((body, place(step), yaw));
                self.appeared += 1;
            }
            (0.15..0.27, 1..) => {
                let (body, ..) = self.bodies.swap_remove(someone);
                world.remove_body(body);
                self.vanished += 1;
            }
            (0.27..0.50, 1..) => {
                let clearance = if drawn(step, 7) < 0.2 { 3.0 } else { 0.0 };
                let body = self.bodies[someone].0;
                world.teleport(body, place(step), yaw, clearance);
                self.bodies[someone] = (body, place(step), yaw);
                self.jumped += 1;
                return Ok(());
            }
            _ => {}
        }
        for (body, at, yaw) in &mut self.bodies {
            *at = [at[0] + yaw.sin() / 30.0, at[1] + yaw.cos() / 30.0];
            world.drive(*body, *at, *yaw, 0.0);
        }
        Ok(())
    }
}

/// Whether all that is known of vegetation, and all that bodies feel of it, is a number.
fn is_finite(world: &World) -> bool {
    let grass = (0..world.model.stands.len()).all(|stand| {
        let plants = standing(world, stand, [[-14.0, -2.0], [6.0, 32.0]], 200);
        plants.iter().flat_map(|plant| plant.points.iter().flatten()).all(|value| value.is_finite())
    });
    let cells = world.state.stands.iter().zip(&world.model.stands).filter(|(_, model)| model.springs.is_none());
    let levels = cells.flat_map(|(stand, _)| stand.cells.now.iter().chain(&stand.cells.lag)).flatten();
    let planes = world
        .state
        .layered
        .iter()
        .flat_map(|stand| std::iter::once(&stand.waves).chain(&stand.touches))
        .flat_map(|waves| waves.now.iter().flatten());
    let felt = world.state.reactions.iter().flat_map(|felt| felt.force.iter().chain(&felt.torque).chain([&felt.power]));
    grass && felt.copied().all(f64::is_finite) && levels.chain(planes).all(|value| value.is_finite())
}

/// Resident memory of this process, bytes; `None` where the system does not say.
fn memory() -> Option<f64> {
    let about = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = about.lines().find(|line| line.starts_with("VmRSS:"))?;
    Some(1024.0 * line.split_whitespace().nth(1)?.parse::<f64>().ok()?)
}

pub(crate) fn soak() -> Result<(), Failed> {
    let seconds: f64 = std::env::var("SWARD_SOAK").ok().and_then(|text| text.parse().ok()).unwrap_or(60.0);
    let watch = Watch::install();
    let gpu = Gpu::new()?;
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let assets = Folder(root.into());
    let text = std::fs::read_to_string(format!("{root}/scenes/everything.ron"))?;
    // The nearer part of the field: a driver in software does two steps a second even so.
    let mut scene = Scene::parse(&text, "everything.ron")?;
    scene.budget.focus_distance = 22.0;
    let mut world = World::new(scene, &assets)?;
    let mut step = GpuStep::new(&gpu, &world)?;
    let (mut crowd, mut samples) = (Crowd { known: Scene::parse(BODIES, "bodies.ron")?.interactors, ..Crowd::default() }, Vec::new());
    let (mut held, most) = (0, GROWTH / seconds);
    // Of a minute the last half, of ten minutes the last eight.
    let watched = (seconds / 2.0).max(seconds - 120.0);
    let last = |samples: &[(f64, f64)]| -> Vec<(f64, f64)> {
        let end = samples.last().map_or(0.0, |(passed, _)| *passed);
        samples.iter().copied().filter(|(passed, _)| *passed > end - watched).collect()
    };
    let flat = |samples: &[(f64, f64)]| slope(&last(samples)) < most;
    let begun = Instant::now();
    // A leak never becomes flat.
    while begun.elapsed().as_secs_f64() < seconds || (begun.elapsed().as_secs_f64() < 3.0 * seconds && !flat(&samples)) {
        crowd.act(&mut world, &assets)?;
        step.step(&gpu, &mut world)?;
        held += world.state.reactions.iter().map(|felt| u64::from(felt.plants)).sum::<u64>();
        if world.state.step.is_multiple_of(5) {
            step.download(&gpu, &mut world)?;
            if world.state.step.is_multiple_of(60) && !is_finite(&world) {
                return Err(format!("not finite after step {}", world.state.step).into());
            }
            samples.extend(memory().map(|memory| (begun.elapsed().as_secs_f64(), memory)));
        }
    }
    step.download(&gpu, &mut world)?;
    if !is_finite(&world) {
        return Err("not finite in the end".into());
    }
    let mut studio = Studio::new(&gpu, &world)?;
    let picture = studio.draw(&gpu, &world, CellsAt::Gpu(&step), [320, 180])?;
    let Crowd { appeared, vanished, jumped, .. } = crowd;
    let steps = world.state.step;
    println!(
        "soak: {steps} steps; {appeared} bodies appeared, {vanished} vanished, {jumped} jumps; {:.0} bytes a second",
        slope(&last(&samples))
    );
    println!("soak: bodies held a plant {held} times");
    println!("soak: memory from {:?} to {:?}", samples.first(), samples.last());
    // Control: it was a crowd.
    if held == 0 || appeared < 3 || vanished < 2 || jumped < 3 || steps < 30 || picture.rgba8.is_empty() {
        return Err("nothing happened".into());
    }
    if !samples.is_empty() {
        let leaking: Vec<(f64, f64)> = samples.iter().map(|(passed, memory)| (*passed, memory + 2.0 * most * passed)).collect();
        if flat(&leaking) {
            return Err("control: a leak is not seen".into());
        }
        if !flat(&samples) {
            return Err(format!("memory grows by {:.0} bytes a second", slope(&last(&samples))).into());
        }
    }
    // Control: what is not a number is found.
    world.state.stands[0].cells.now[0][0] = f32::NAN;
    if is_finite(&world) {
        return Err("control: a cell that is not a number is not found".into());
    }
    drop((studio, step, gpu));
    crate::silent(&watch.take())
}
