//! Outputs of the GPU: against the CPU's, and from cells that a GPU holds.

use libtest_mimic::Failed;
use sward::picture::aov::Aov;
use sward::picture::past::Past;
use sward::world::World;
use sward_wgpu::compare::Deviation;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

use crate::adapter::{Verdict, ensure};
use crate::edited;
use crate::reprojection::{CAR_PASS, FRAMES, Pair, SIZE, blade_pass, deformed_pass, sheet_pass, world};
use crate::verdicts;

/// A shrub and a tree, no grass, in gusts and a ball that brushes past.
const LAYERS_PASS: &str = r#"(version: 1, field: (patch_side: 16),
    stands: [(species: Shrub, places: [(at: (-1, 5), height: 1.5), (at: (2, 7), height: 1.8)], representation: Layers(mesh: Grown(triangles: 6000))),
        (species: Tree, places: [(at: (1, 14))], representation: Layers(mesh: Grown(form: Tree, triangles: 6000)))],
    wind: [Natural(velocity: (7, 1), turbulence: 0.5)], terrain: Image(path: "assets/jacksboro.png", scale: 0.1),
    interactors: [(name: "ball", shape: Sphere(radius: 0.4), path: Circle(centre: (-1, 5), radius: 0.9, speed: 3))],
    camera: (keys: [(time: 0, eye: (-3, 2.0, 0), target: (-1, 1.0, 8)), (time: 1.5, eye: (0.5, 2.2, 0.5), target: (1.5, 1.0, 8))]))"#;

/// The worlds of both frames, stepped on the CPU.
fn worlds() -> [World; 2] {
    worlds_of(CAR_PASS)
}

fn worlds_of(text: &str) -> [World; 2] {
    let mut moving = world(text);
    FRAMES.map(|(step, _)| {
        (moving.state.step..step).for_each(|_| moving.step());
        moving.clone()
    })
}

/// Outputs of both frames, one after the other, of cells on the CPU.
fn on_gpu(gpu: &Gpu, worlds: &[World; 2]) -> Result<[Aov; 2], Failed> {
    let mut studio = Studio::new(gpu, &worlds[0])?;
    let mut draw = |k: usize| studio.draw_aov(gpu, &worlds[k], CellsAt::Cpu, FRAMES[k].1, SIZE);
    Ok([draw(0)?.1, draw(1)?.1])
}

pub(crate) fn a_car_pass_is_followed(gpu: &Gpu) -> Verdict {
    let worlds = worlds();
    let frames = on_gpu(gpu, &worlds)?;
    Ok(verdicts::car_pass(&Pair::new(worlds, frames))?)
}

pub(crate) fn blades_are_followed(gpu: &Gpu) -> Verdict {
    let worlds = worlds_of(&blade_pass());
    let frames = on_gpu(gpu, &worlds)?;
    Ok(verdicts::blade_pass(&Pair::new(worlds, frames))?)
}

/// Motion of sheets is exact, as that of cards.
pub(crate) fn sheets_are_followed(gpu: &Gpu) -> Verdict {
    let worlds = worlds_of(&sheet_pass());
    let frames = on_gpu(gpu, &worlds)?;
    Ok(verdicts::sheet_pass(&Pair::new(worlds, frames))?)
}

/// The same of billboards that bodies deform.
pub(crate) fn deformed_sheets_are_followed(gpu: &Gpu) -> Verdict {
    let worlds = worlds_of(&deformed_pass());
    let frames = on_gpu(gpu, &worlds)?;
    Ok(verdicts::deformed_pass(&Pair::new(worlds, frames))?)
}

pub(crate) fn outputs_of_deformed_sheets_agree(gpu: &Gpu) -> Verdict {
    passes_agree(gpu, "deformed sheets", &deformed_pass())
}

pub(crate) fn outputs_of_blades_agree(gpu: &Gpu) -> Verdict {
    passes_agree(gpu, "blades", &blade_pass())
}

/// Plants in layers, while new cuts take over.
pub(crate) fn outputs_of_layers_agree(gpu: &Gpu) -> Verdict {
    passes_agree(gpu, "layers", LAYERS_PASS)
}

/// Waves that a GPU holds.
pub(crate) fn waves_of_the_gpu_are_remembered(gpu: &Gpu) -> Verdict {
    remembered(gpu, LAYERS_PASS)
}

pub(crate) fn outputs_of_sheets_agree(gpu: &Gpu) -> Verdict {
    passes_agree(gpu, "sheets", &sheet_pass())
}

/// Controls: the frame before.
fn passes_agree(gpu: &Gpu, name: &str, text: &str) -> Verdict {
    let worlds = worlds_of(text);
    let theirs = on_gpu(gpu, &worlds)?;
    let studio = sward_raster::Studio::new(&worlds[0]);
    let first = Past::of(&worlds[0], FRAMES[0].1);
    let ours = [0, 1].map(|k| studio.draw_aov(&worlds[k], &first, FRAMES[k].1, SIZE).1);
    for k in 0..2 {
        agree(&format!("{name}, frame {k}"), &ours[k], &theirs[k])?;
    }
    ensure(agree("control: the frame before", &ours[0], &theirs[1]).is_err(), || "the frame before looks the same".to_owned())
}

/// What a GPU may make of no motion, pixels: its two projections of one point are rounded apart.
const ROUNDING: f32 = 1e-3;

/// Largest component of all motion, pixels.
fn farthest(aov: &Aov) -> f32 {
    aov.motion.iter().flatten().fold(0.0, |most, motion| most.max(motion.abs()))
}

/// Whether a pixel, or one beside it, shows a number.
fn near(aov: &Aov, at: usize, number: u32) -> bool {
    let [width, height] = [aov.width as i64, aov.height as i64];
    let (x, y) = (at as i64 % width, at as i64 / width);
    (0..9)
        .map(|k| [x + k % 3 - 1, y + k / 3 - 1])
        .any(|[x, y]| (0..width).contains(&x) && (0..height).contains(&y) && aov.plant[(y * width + x) as usize] == number)
}

/// Whether two outputs agree: numbers on all pixels but some at edges; depth and motion where numbers do.
///
/// Drivers filter clump pictures to eight bits and less: a leaf's rim may lie a part of a pixel aside.
fn agree(name: &str, a: &Aov, b: &Aov) -> Verdict {
    ensure([a.width, a.height] == [b.width, b.height] && a.plant.len() == b.plant.len(), || format!("{name}: other sizes"))?;
    let apart: Vec<usize> = (0..a.plant.len()).filter(|at| a.plant[*at] != b.plant[*at]).collect();
    let far = apart.iter().filter(|at| !near(a, **at, b.plant[**at]) && !near(b, **at, a.plant[**at])).count();
    let same: Vec<usize> = (0..a.plant.len()).filter(|at| a.plant[*at] == b.plant[*at]).collect();
    let depth = |aov: &Aov| -> Vec<f32> { same.iter().map(|at| 1.0 / aov.depth[*at]).collect() };
    let motion = |aov: &Aov| -> Vec<f32> { same.iter().flat_map(|at| aov.motion[*at]).collect() };
    let (depth, motion) = (Deviation::of(&depth(a), &depth(b), 1e-2), Deviation::of(&motion(a), &motion(b), 0.5));
    let share = |count: usize| count as f64 / a.plant.len() as f64;
    let line = format!(
        "{name}: {:.3} % of the numbers differ, {:.3} % not at edges; 1/depth {:.1e} (p99.9) {:.1e} (rms); motion {:.1e} (p99.9) {:.1e} (rms)",
        100.0 * share(apart.len()),
        100.0 * share(far),
        depth.p999,
        depth.rms,
        motion.p999,
        motion.rms
    );
    println!("{line}");
    ensure(share(apart.len()) < 0.01 && share(far) < 0.001, || line.clone())?;
    ensure(depth.p999 < 2e-3 && depth.rms < 1e-3 && motion.p999 < 0.05 && motion.rms < 0.02, || line.clone())
}

/// Controls: the frame before, and motion since another moment.
pub(crate) fn outputs_agree(gpu: &Gpu) -> Verdict {
    let worlds = worlds();
    let theirs = on_gpu(gpu, &worlds)?;
    let studio = sward_raster::Studio::new(&worlds[0]);
    let draw = |k: usize, past: &Past| studio.draw_aov(&worlds[k], past, FRAMES[k].1, SIZE).1;
    let first = Past::of(&worlds[0], FRAMES[0].1);
    let ours = [draw(0, &first), draw(1, &first)];
    for k in 0..2 {
        agree(&format!("frame {k}"), &ours[k], &theirs[k])?;
    }
    for (host, frames, most) in [("CPU", &ours, 0.0), ("GPU", &theirs, ROUNDING)] {
        let moved = farthest(&frames[0]);
        ensure(moved <= most, || format!("{host}: the first frame moves by {moved}"))?;
    }
    ensure(agree("control: the frame before", &ours[0], &theirs[1]).is_err(), || "the frame before looks the same".to_owned())?;
    let later = draw(1, &Past::of(&worlds[0], 1.0));
    ensure(later.plant == ours[1].plant && later.depth == ours[1].depth, || "the past changes what is seen".to_owned())?;
    ensure(agree("control: since a step earlier", &later, &theirs[1]).is_err(), || "another past looks the same".to_owned())
}

/// Stepped on the GPU, whose cells of the frame before are gone when the next is drawn. Control: the present moment for the one before.
pub(crate) fn cells_of_the_gpu_are_remembered(gpu: &Gpu) -> Verdict {
    remembered(gpu, CAR_PASS)
}

/// Air that flows there, too.
pub(crate) fn air_of_the_gpu_is_remembered(gpu: &Gpu) -> Verdict {
    remembered(gpu, &CAR_PASS.replace("Natural(velocity: (4, 1))", "Fluid(velocity: (4, 1), cells: 32)"))
}

fn remembered(gpu: &Gpu, text: &str) -> Verdict {
    let theirs = on_gpu(gpu, &worlds_of(text))?;
    let mut world = world(text);
    let (mut step, mut studio) = (GpuStep::new(gpu, &world)?, Studio::new(gpu, &world)?);
    for (at, behind) in [FRAMES[0], (FRAMES[1].0, FRAMES[1].1)] {
        while world.state.step < at {
            step.step(gpu, &mut world)?;
        }
        if at == FRAMES[0].0 {
            studio.remember(gpu, &world, CellsAt::Gpu(&step), behind)?;
        }
    }
    let second = studio.draw_aov(gpu, &world, CellsAt::Gpu(&step), FRAMES[1].1, SIZE)?.1;
    agree("stepped on the GPU", &second, &theirs[1])?;
    let again = studio.draw_aov(gpu, &world, CellsAt::Gpu(&step), FRAMES[1].1, SIZE)?.1;
    let moved = farthest(&again);
    ensure(moved <= ROUNDING, || format!("the same moment again moves by {moved}"))?;
    ensure(agree("control: the present for the past", &again, &theirs[1]).is_err(), || "cells of the frame before do not matter".to_owned())
}

pub(crate) fn asking_for_outputs_changes_no_picture(gpu: &Gpu) -> Verdict {
    let [first, second] = worlds();
    let mut studio = Studio::new(gpu, &first)?;
    studio.draw_aov(gpu, &first, CellsAt::Cpu, 0.0, SIZE)?;
    let beside = studio.draw_aov(gpu, &second, CellsAt::Cpu, 0.5, SIZE)?.0;
    let alone = Studio::new(gpu, &second)?.draw_before(gpu, &second, CellsAt::Cpu, 0.5, SIZE)?;
    ensure(beside == alone, || "the picture is another one".to_owned())?;
    let earlier = studio.draw_before(gpu, &second, CellsAt::Cpu, 0.0, SIZE)?;
    ensure(earlier != alone, || "control: half a step later looks the same".to_owned())
}

/// At half precision, of cells here and there by turns. Control: of one's own frame before.
pub(crate) fn cells_may_change_their_place(gpu: &Gpu) -> Verdict {
    let mut world = world(&CAR_PASS.replace("budget: (", "budget: (precision: Half, "));
    let mut step = GpuStep::new(gpu, &world)?;
    let [mut turns, mut steady] = [Studio::new(gpu, &world)?, Studio::new(gpu, &world)?];
    let mut before = None;
    for frame in 0..4 {
        while world.state.step < 54 + 3 * frame {
            step.step(gpu, &mut world)?;
        }
        step.download(gpu, &mut world)?;
        let here = if frame % 2 == 1 { CellsAt::Gpu(&step) } else { CellsAt::Cpu };
        let ours = turns.draw_aov(gpu, &world, here, 0.5, SIZE)?.1;
        let theirs = steady.draw_aov(gpu, &world, CellsAt::Gpu(&step), 0.5, SIZE)?.1;
        agree(&format!("frame {frame}"), &ours, &theirs)?;
        let moved = farthest(&theirs);
        ensure((frame == 0) == (moved <= ROUNDING), || format!("control: frame {frame} moves by {moved}"))?;
        if let Some(before) = before.replace(ours) {
            ensure(agree("control: the frame before", &before, &theirs).is_err(), || "the frame before looks the same".to_owned())?;
        }
    }
    Ok(gpu.check()?)
}

/// On both hosts alike. Control: the frame before.
pub(crate) fn edited_ground_is_no_motion(gpu: &Gpu) -> Verdict {
    let worlds = edited::worlds();
    let mut studio = Studio::new(gpu, &worlds[0])?;
    let mut draw = |world: &World| studio.draw_aov(gpu, world, CellsAt::Cpu, 0.0, SIZE).map(|(_, aov)| aov);
    let theirs = [draw(&worlds[0])?, draw(&worlds[1])?];
    let still = draw(&worlds[1])?;
    studio.remember(gpu, &edited::always(&worlds), CellsAt::Cpu, 0.0)?;
    let same = studio.draw_aov(gpu, &worlds[1], CellsAt::Cpu, 0.0, SIZE)?.1;
    edited::verdict(&worlds, &theirs, &same, &still)?;
    let ours = sward_raster::Studio::new(&worlds[0]).draw_aov(&worlds[1], &Past::of(&worlds[0], 0.0), 0.0, SIZE).1;
    agree("edited", &ours, &theirs[1])?;
    ensure(agree("control: the frame before", &ours, &theirs[0]).is_err(), || "the frame before looks the same".to_owned())
}
