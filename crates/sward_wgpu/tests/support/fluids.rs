//! Air that flows: its divergence on the GPU, steps from any flow, and whole scenes under it.

use std::sync::Arc;

use sward::wind::fluid::divergence;
use sward::world::World;
use sward_wgpu::compare::{Deviation, Tolerance};
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::kernels::{Random, line};
use crate::runs::{Backend, Run, agree, world};

/// Agreement of flows of some m/s after a step: rounding of transforms, m/s.
const STEP: Tolerance = Tolerance { p999: 3e-5, rms: 1e-5, outlier: 1e-3, share: 0.0 };

/// Two planes without plants: a coarse one that gusts and a turning body push, and a fine one.
const AIR: &str = "(version: 1, wind: [
        Fluid(side: 24, cells: 32, viscosity: 0.01, gusts: [(from: Place(at: (3, 20)), turn: 2, strength: 30), (from: South, frequency: 0)]),
        Fluid(side: 40, cells: 256, velocity: (-3, 2), gusts: [(from: East, along: 0.2, radius: 1.5)]),
    ], interactors: [(shape: Box(size: (2, 1, 5)), path: Circle(radius: 6, speed: 7)), (shape: Sphere(radius: 0.3), path: Circle(radius: 3, speed: 2))])";

/// A scene with chance flows of up to 5 m/s.
fn stirred(scene: &str) -> Result<World, libtest_mimic::Failed> {
    let mut world = world(scene)?;
    for (fluid, seed) in world.state.fluids.iter_mut().zip(7..) {
        let mut random = Random::new(seed);
        fluid.now = Arc::new((0..fluid.now.len()).map(|_| [random.drawn(-5.0, 5.0), random.drawn(-5.0, 5.0)]).collect());
    }
    Ok(world)
}

/// The flow of a plane as numbers.
fn numbers(world: &World, plane: usize) -> Vec<f32> {
    world.state.fluids[plane].now.iter().flatten().copied().collect()
}

/// One step and twenty, of both planes; and what is left of divergence is rounding.
pub(crate) fn steps(gpu: &Gpu) -> Verdict {
    let (mut cpu, mut other) = (stirred(AIR)?, stirred(AIR)?);
    let mut backend = Backend::on(gpu, &other)?;
    for (steps, wider) in [(1, 1.0), (19, 4.0)] {
        let before: Vec<f64> = (0..2).map(|plane| spread(&other, plane)).collect();
        Backend::Cpu.run(gpu, &mut cpu, steps)?;
        backend.run(gpu, &mut other, steps)?;
        for plane in 0..2 {
            let deviation = Deviation::of(&numbers(&cpu, plane), &numbers(&other, plane), STEP.outlier);
            println!("{}", line(&format!("air {plane} after {} steps", cpu.state.step), &deviation));
            let tolerance = Tolerance { p999: wider * STEP.p999, rms: wider * STEP.rms, ..STEP };
            ensure(deviation.within(&tolerance), || format!("{deviation:?} beyond {tolerance:?}"))?;
            let earlier = |world: &World| world.state.fluids[plane].before.iter().flatten().copied().collect::<Vec<f32>>();
            let earlier = Deviation::of(&earlier(&cpu), &earlier(&other), STEP.outlier);
            ensure(earlier.within(&tolerance), || format!("the flow before: {earlier:?}"))?;
            if steps == 1 {
                let left = spread(&other, plane) / before[plane];
                println!("air {plane}: {left:.1e} of the divergence is left");
                ensure(left <= 1e-5 && before[plane] > 1.0, || format!("{left} of {} is left", before[plane]))?;
            }
        }
    }
    // Control: gusts that push one percent more.
    let (mut cpu, mut other) = (world(AIR)?, world(&AIR.replace("strength: 30", "strength: 30.3"))?);
    Backend::Cpu.run(gpu, &mut cpu, 6)?;
    Backend::on(gpu, &other)?.run(gpu, &mut other, 6)?;
    let deviation = Deviation::of(&numbers(&cpu, 0), &numbers(&other, 0), STEP.outlier);
    ensure(!deviation.within(&STEP), || format!("one percent of a gust is not found: {deviation:?}"))
}

fn spread(world: &World, plane: usize) -> f64 {
    let (flow, model) = (&world.state.fluids[plane].now, &world.model.fluids[plane].model);
    divergence(flow, model.side, f64::from(model.cell))
}

/// A pickup in eddies, over a meadow that the given words say more of.
fn meadow(more: &str, wind: &str) -> String {
    format!(
        "(version: 1, field: (patch_side: 16), stands: [(species: Meadow, cells: 64{more})], wind: [{wind}],
        interactors: [(shape: Truck, path: Keyframes(keys: [(time: 0, at: (-8, 2)), (time: 1.5, at: (4, 6)), (time: 3, at: (14, 2))]))],
        camera: (eye: (0, 2, 0), target: (4, 1, 8)), budget: (patches: 9, focus_distance: 12, lag_distance: 10))"
    )
}

const EDDIES: &str = "Fluid(side: 24, cells: 32), Uniform(velocity: (0, 1))";

/// Whole scenes, of each response; half on the GPU and half on the CPU. Control: without bodies in the air.
pub(crate) fn runs(gpu: &Gpu) -> Verdict {
    let shows = |world: &World| world.state.fluids[0].now.iter().flatten().any(|speed| speed.abs() > 1.0);
    for (name, more, steps) in [
        ("eddies", "", 90),
        ("eddies, plant by plant", ", response: Oscillator()", 30),
        ("eddies, blade by blade", ", response: VirtualInertia(), representation: Blade(blades: 1)", 3),
    ] {
        let scene = meadow(more, EDDIES);
        Run { name, scene: &scene, shows }.check_for(gpu, steps)?;
    }
    let scene = meadow("", EDDIES);
    let (mut whole, mut parts) = (world(&scene)?, world(&scene)?);
    Backend::Cpu.run(gpu, &mut whole, 60)?;
    Backend::on(gpu, &parts)?.run(gpu, &mut parts, 25)?;
    Backend::Cpu.run(gpu, &mut parts, 20)?;
    Backend::on(gpu, &parts)?.run(gpu, &mut parts, 15)?;
    agree("eddies, handed over twice", &whole, &parts, true)?;
    let mut control = world(&meadow("", &EDDIES.replace("cells: 32", "cells: 32, bodies: false")))?;
    Backend::on(gpu, &control)?.run(gpu, &mut control, 60)?;
    ensure(agree("control", &whole, &control, false).is_err(), || "no wake, and the same grass".to_owned())
}
