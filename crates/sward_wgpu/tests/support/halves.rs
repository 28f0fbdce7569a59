//! Cells at half precision: the twin of the packing; whole runs against the same arithmetic on the CPU, and against full precision;
//! memory, traffic, and the picture.

use sward::math;
use sward::plan::Plan;
use sward::response::continuum::{HALF_WGSL, REST, half};
use sward::scene::Precision;
use sward::state::{Awake, NONE};
use sward::world::World;
use sward_wgpu::compare::{Deviation, Tolerance};
use sward_wgpu::compute::GpuStep;
use sward_wgpu::compute::buffers::CellBuffers;
use sward_wgpu::gpu::{Gpu, GpuError};

use crate::adapter::{Verdict, ensure};
use crate::kernels::{By, Random, Twin, line};
use crate::runs::{Backend, world};
use crate::scenes::TRUCK;

/// A ball that passes and leaves: its track recovers.
const BALL: &str = "(version: 1, field: (patch_side: 16), stands: [(species: Meadow, cells: 64)], wind: [Uniform(velocity: (4, 1))],
    interactors: [(shape: Sphere(radius: 0.8), path: Keyframes(keys: [(time: 0, at: (-6, 4)), (time: 1.5, at: (10, 7))]), until: 1.5)])";

/// The packing, the same bits on every device.
pub(crate) fn half_words(gpu: &Gpu) -> Verdict {
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let small = 0.5_f32.powi((random.bits() % 24) as i32);
        let (bend, rate) = (random.drawn(-2.0, 2.0) * small, random.drawn(-70.0, 70.0) * small);
        let (bend, rate, dither) = (random.put(bend), random.put(rate), random.any());
        input.extend(random.words);
        let word = half::pack(bend, rate, dither);
        vec![word, half::bend(word).to_bits(), half::rate(word).to_bits(), half::dither(word, dither)]
    };
    let host = "fn twin() {
        let bend = next_f();
        let rate = next_f();
        let dither = next_u();
        let word = half_pack(bend, rate, dither);
        put_u(word);
        put_f(half_bend(word));
        put_f(half_rate(word));
        put_u(half_dither(word, dither));
    }";
    Twin { name: "half", library: &[math::WGSL, HALF_WGSL], host, tables: &[], rust }.check(gpu, By::Bits)
}

/// How a CPU run rounds its cells after each step.
type Rounding = fn(&[f32], u32) -> Vec<f32>;

/// As the GPU does.
fn halved(cells: &[f32], patch: u32) -> Vec<f32> {
    half::unpack_patch(&half::pack_patch(cells, patch))
}

fn rounded(world: &mut World, plan: &Plan, rounding: Rounding) {
    for (plan_of, state) in plan.stands.iter().zip(&mut world.state.stands) {
        for patch in &plan_of.patches {
            let number = half::patch_dither(patch.patch, plan.step);
            for level in [&mut state.cells.now, &mut state.cells.old] {
                let cells = &mut level[patch.slot as usize];
                *cells = rounding(cells, number).into();
            }
        }
    }
}

fn stepped(world: &mut World, steps: u64, rounding: Rounding) {
    for _ in 0..steps {
        let plan = world.plan();
        let reports = world.respond(&plan);
        rounded(world, &plan, rounding);
        world.finish(reports);
    }
}

fn halved_world(scene: &str) -> Result<World, libtest_mimic::Failed> {
    let mut world = world(scene)?;
    world.scene.budget.precision = Precision::Half;
    Ok(world)
}

/// β and ω of the patches both worlds have awake, and how many only one has.
fn common(a: &World, b: &World) -> ([[Vec<f32>; 2]; 2], usize) {
    let mut cells = [[Vec::new(), Vec::new()], [Vec::new(), Vec::new()]];
    let (a, b) = (&a.state.stands[0], &b.state.stands[0]);
    let mut shared = 0;
    for (patch, left) in &a.awake {
        let Some(right) = b.awake.get(patch) else { continue };
        shared += 1;
        for (which, level) in [&a.cells.now[left.slot as usize], &b.cells.now[right.slot as usize]].into_iter().enumerate() {
            let half = level.len() / 2;
            cells[0][which].extend_from_slice(&level[..half]);
            cells[1][which].extend_from_slice(&level[half..]);
        }
    }
    (cells, a.awake.len() + b.awake.len() - 2 * shared)
}

/// Agreement of one step at half precision on the GPU with the same on the CPU: now and then a rounding of the step turns one of the
/// packing. Over many steps the two part like any two runs with different dither.
const ONCE: [Tolerance; 2] =
    [Tolerance { p999: 2e-5, rms: 2e-6, outlier: 1e-7, share: 0.02 }, Tolerance { p999: 1e-2, rms: 1e-3, outlier: 1e-6, share: 0.02 }];
/// Agreement of half precision with full.
const FULL: [Tolerance; 2] =
    [Tolerance { p999: 1e-3, rms: 1.5e-4, outlier: 1e-2, share: 1e-4 }, Tolerance { p999: 0.1, rms: 2e-2, outlier: 1.0, share: 1e-4 }];

fn near(name: &str, a: &World, b: &World, tolerances: &[Tolerance; 2], most_alone: usize) -> Verdict {
    let (cells, alone) = common(a, b);
    for (([left, right], tolerance), part) in cells.iter().zip(tolerances).zip(["bend", "rate"]) {
        let deviation = Deviation::of(left, right, tolerance.outlier);
        let line = line(&format!("{name}, {part} at step {}", a.state.step), &deviation);
        println!("{line}; {alone} patches alone");
        ensure(deviation.within(tolerance), || format!("{line} beyond {tolerance:?}"))?;
    }
    ensure(alone <= most_alone, || format!("{name}: {alone} patches are awake in one world only"))
}

/// Whole runs at half precision are near full precision, and each of some steps is the step the CPU takes with the same rounding. Told
/// from that: a dither of another step, and rounding to a thousandth of a radian.
pub(crate) fn half_runs(gpu: &Gpu) -> Verdict {
    for (name, scene) in [("ball", BALL), ("truck", TRUCK)] {
        let (mut on_gpu, mut full) = (halved_world(scene)?, world(scene)?);
        let mut backend = Backend::on(gpu, &on_gpu)?;
        let mut compared = 0;
        for _ in 0..3 {
            backend.run(gpu, &mut on_gpu, 39)?;
            let (mut once, mut wrong) = (on_gpu.clone(), on_gpu.clone());
            stepped(&mut once, 1, halved);
            stepped(&mut wrong, 1, |cells, patch| halved(cells, patch ^ 77));
            backend.run(gpu, &mut on_gpu, 1)?;
            // A patch that wakes is rounded before its first step on the GPU, and after it here.
            if on_gpu.state.stands[0].awake.values().all(|awake| !awake.woken) {
                compared += 1;
                near(&format!("{name}, one step"), &once, &on_gpu, &ONCE, 0)?;
                ensure(near("control", &wrong, &on_gpu, &ONCE, 0).is_err(), || "another dither is not found".to_owned())?;
            }
            Backend::Cpu.run(gpu, &mut full, 40)?;
            near(&format!("{name}, half and full"), &full, &on_gpu, &FULL, 1)?;
        }
        ensure(compared > 1, || format!("{name}: patches wake in every step that is looked at"))?;
        let coarse = |cells: &[f32], _: u32| cells.iter().map(|value| (value * 1024.0).round() / 1024.0).collect();
        let mut wrong = world(scene)?;
        stepped(&mut wrong, 120, coarse);
        ensure(near(&format!("{name}, control"), &wrong, &on_gpu, &FULL, 1).is_err(), || {
            "a thousandth of a radian is not found".to_owned()
        })?;
    }
    Ok(())
}

/// A track recovers to rest and its patches sleep, as soon as at full precision, but for a few steps.
pub(crate) fn half_sleeps(gpu: &Gpu) -> Verdict {
    let asleep = |backend: &mut Backend, world: &mut World| -> Result<u64, libtest_mimic::Failed> {
        while world.state.stands[0].counters.woken == 0 || !world.state.stands[0].awake.is_empty() {
            backend.run(gpu, world, 1)?;
            ensure(world.state.step < 600, || format!("still awake: {:?}", world.state.stands[0].awake))?;
        }
        Ok(world.state.step)
    };
    let ball = BALL.replace("cells: 64", "cells: 32");
    let (mut full, mut halved) = (world(&ball)?, halved_world(&ball)?);
    // In wind too nothing but rest counts as rest.
    [&mut full, &mut halved].into_iter().for_each(|world| world.model.stands[0].tolerance = REST);
    let mut backend = Backend::on(gpu, &halved)?;
    let steps = [asleep(&mut Backend::Cpu, &mut full)?, asleep(&mut backend, &mut halved)?];
    println!("asleep after {steps:?} steps, at full and at half precision");
    ensure(steps[0].abs_diff(steps[1]) <= 20, || format!("asleep after {steps:?} steps"))
}

/// Stopped and continued is the same run, to the bit, on one device: what is stored comes back exactly.
pub(crate) fn half_continues(gpu: &Gpu) -> Verdict {
    let (mut whole, mut parts) = (halved_world(TRUCK)?, halved_world(TRUCK)?);
    Backend::on(gpu, &whole)?.run(gpu, &mut whole, 60)?;
    Backend::on(gpu, &parts)?.run(gpu, &mut parts, 30)?;
    let mut other = parts.clone();
    Backend::on(gpu, &parts)?.run(gpu, &mut parts, 30)?;
    ensure(whole.hash() == parts.hash() && !whole.state.stands[0].awake.is_empty(), || {
        "continuing differs from never stopping".to_owned()
    })?;
    // Control: one cell differs by one step of its words.
    let slot = other.state.stands[0].awake.values().next().map_or(0, |awake| awake.slot as usize);
    other.state.stands[0].cells.now[slot][700] += 1.0 / 65_536.0;
    Backend::on(gpu, &other)?.run(gpu, &mut other, 30)?;
    ensure(whole.hash() != other.hash(), || "a cell that differs is not found".to_owned())
}

/// 225 patches of 128×128 cells take 16 bytes a cell and less than 64 MB, as allocated; 32 at full precision.
pub(crate) fn half_memory(gpu: &Gpu) -> Verdict {
    let world = world("(version: 1, stands: [(species: Meadow)])")?;
    let mut state = world.state.stands[0].clone();
    let cells = 225 * 128 * 128;
    for (precision, each) in [(Precision::Half, 16), (Precision::Full, 32)] {
        let mut buffers = CellBuffers::new(gpu, &world.model.stands[0], precision);
        // One after the other, as they wake.
        while let Some(slot) = state.free.pop_first() {
            let awake = Awake { slot, woken: true, ..Awake::default() };
            state.awake.insert([slot as i32, 0], awake);
            if slot.is_multiple_of(32) {
                buffers.reserve(gpu, &state, true)?;
            }
        }
        buffers.reserve(gpu, &state, true)?;
        println!("{} bytes for {cells} cells", buffers.state_bytes());
        ensure(buffers.state_bytes() == each * cells, || format!("{} bytes for {cells} cells", buffers.state_bytes()))?;
        let within = buffers.state_bytes() <= 64_000_000;
        ensure(within == (each == 16), || format!("{} bytes", buffers.state_bytes()))?;
    }
    Ok(gpu.check()?)
}

/// What does not fit a buffer is an error that names what does not, and nothing is replaced: level ground may be edited at any moment, so
/// that it holds no more patches than hills. Controls: as many as fit.
pub(crate) fn room_ends(gpu: &Gpu) -> Verdict {
    let world = world("(version: 1, stands: [(species: Meadow, cells: 256)])")?;
    let mut state = world.state.stands[0].clone();
    let mut buffers = CellBuffers::new(gpu, &world.model.stands[0], Precision::Half);
    let mut reserved = |slot: u32, lag: u32, level: bool| {
        let awake = Awake { slot, lag, woken: true, ..Awake::default() };
        state.awake = [([0, 0], awake)].into();
        buffers.reserve(gpu, &state, level).map(|_| buffers.state_bytes())
    };
    for level in [true, false] {
        match reserved(170, NONE, level) {
            Err(GpuError::TooManyCells { slots: 171, cells: 256, most: 170 }) => {}
            other => return Err(format!("level {level}: {other:?}").into()),
        }
        match reserved(0, 85, level) {
            Err(GpuError::TooManyLagCells { slots: 86, cells: 256, most: 85 }) => {}
            other => return Err(format!("level {level}: {other:?}").into()),
        }
    }
    let (some, most) = (reserved(1, 84, true)?, reserved(169, 84, true)?);
    ensure(some < most, || format!("{some} and {most} bytes"))?;
    // The same slots when the ground has risen.
    ensure(reserved(169, 84, false)? == most, || "slots were lost".to_owned())
}

/// One dispatch per stage and step, and one per substep of the wave; bytes a cell and step.
pub(crate) fn one_dispatch_a_stage(gpu: &Gpu) -> Verdict {
    let scene = "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 32, response: Continuum(kappa: 4000))],
        wind: [Natural(velocity: (3, 1))], budget: (patches: 49, focus_distance: 14, lag_distance: 14),
        interactors: [(shape: Sphere(radius: 0.5), path: Circle(radius: 3, speed: 2))])";
    for (precision, most) in [(Precision::Full, 52.0), (Precision::Half, 26.0)] {
        let mut world = world(scene)?;
        world.scene.budget.precision = precision.clone();
        let mut step = GpuStep::new(gpu, &world)?;
        (0..20).try_for_each(|_| step.step(gpu, &mut world))?;
        let before = (step.work, world.state.stands[0].counters);
        (0..10).try_for_each(|_| step.step(gpu, &mut world))?;
        // rest, contact, two substeps of the wave, upper segments; wake only where patches woke.
        let woken = world.state.stands[0].counters.woken - before.1.woken;
        let dispatches = step.work.dispatches - before.0.dispatches;
        ensure(woken == 0 && dispatches == 10 * 5, || format!("{dispatches} dispatches in 10 steps, {woken} patches woken"))?;
        // The body has left, and no camera is near: the wave alone.
        let mut still = self::world(
            &BALL.replace("until: 1.5", "until: 0.2").replace("wind: [Uniform(velocity: (4, 1))]", "budget: (lag_distance: 0)"),
        )?;
        still.scene.budget.precision = precision;
        let mut step = GpuStep::new(gpu, &still)?;
        (0..20).try_for_each(|_| step.step(gpu, &mut still))?;
        let before = (step.work, still.state.stands[0].counters);
        (0..10).try_for_each(|_| step.step(gpu, &mut still))?;
        let cells = 64 * 64 * (still.state.stands[0].counters.patch_steps - before.1.patch_steps);
        let each = (step.work.traffic - before.0.traffic) as f64 / cells as f64;
        println!("{each} bytes a cell and step");
        ensure(cells > 0 && each <= most, || format!("{each} bytes a cell and step"))?;
    }
    Ok(())
}
