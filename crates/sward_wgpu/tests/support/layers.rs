//! Stands of meshes: waves of their planes, and of plants that a body brushes past, on both backends.

use sward::world::World;
use sward_wgpu::compare::{Deviation, Tolerance};
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::kernels::{Random, line};
use crate::runs::{Backend, world};

/// Agreement of V, m/s: rounding of steps, which waves damp.
const WAVES: Tolerance = Tolerance { p999: 2e-5, rms: 5e-6, outlier: 1e-3, share: 0.0 };

/// Two stands in gusts and eddies; one plant is brushed by a ball, another stands in a downwash.
const PLANTS: &str = "(version: 1, stands: [
        (species: Shrub, places: [(at: (0, 0), height: 1.4), (at: (9, 1))], representation: Layers(mesh: Grown(triangles: 2000))),
        (species: Tree, places: [(at: (-6, 4), yaw: 2)], response: Harmonic(cells: 32, heading: 0.7), representation: Layers(mesh: Grown(form: Tree, triangles: 2000))),
    ], wind: [Natural(velocity: (5, -2), turbulence: 0.4), Fluid(side: 12, cells: 32), Footprint(flow: Outward, radius: 4, path: Still(at: (10, 0)))],
    interactors: [(shape: Sphere(radius: 0.5), path: Circle(centre: (0, 0), radius: 0.9, speed: 2.5))],
    camera: (eye: (0, 1.5, -6), target: (0, 1, 0)))";

/// V of everything, in one list.
fn numbers(world: &World) -> Vec<f32> {
    let mut all = Vec::new();
    for state in &world.state.layered {
        let touched = state.pool.taken().filter_map(|(_, place)| state.touches.get(place as usize));
        for waves in [&state.waves].into_iter().chain(touched) {
            all.extend(waves.now.iter().chain(&waves.old).flatten());
        }
        all.extend(state.notes.iter().flatten().flatten());
    }
    all
}

/// Waves of chance, up to 3 m/s.
fn stirred() -> Result<World, libtest_mimic::Failed> {
    let mut world = world(PLANTS)?;
    for (state, seed) in world.state.layered.iter_mut().zip(3..) {
        let mut random = Random::new(seed);
        let cells = state.waves.now.len();
        let mut chance = || (0..cells).map(|_| [random.drawn(-3.0, 3.0), random.drawn(-3.0, 3.0)]).collect::<Vec<_>>();
        (state.waves.now, state.waves.old) = (chance(), chance());
    }
    Ok(world)
}

/// One step from chance waves, and then two seconds.
pub(crate) fn waves(gpu: &Gpu) -> Verdict {
    let (mut cpu, mut other) = (stirred()?, stirred()?);
    let mut backend = Backend::on(gpu, &other)?;
    for (steps, wider) in [(1, 1.0), (119, 2.0)] {
        Backend::Cpu.run(gpu, &mut cpu, steps)?;
        backend.run(gpu, &mut other, steps)?;
        let deviation = Deviation::of(&numbers(&cpu), &numbers(&other), WAVES.outlier);
        println!("{}", line(&format!("waves after {} steps", cpu.state.step), &deviation));
        let tolerance = Tolerance { p999: wider * WAVES.p999, rms: wider * WAVES.rms, ..WAVES };
        ensure(deviation.within(&tolerance), || format!("{deviation:?} beyond {tolerance:?}"))?;
    }
    let touched: Vec<usize> = cpu.state.layered.iter().map(|state| state.pool.taken().count()).collect();
    let moves = numbers(&cpu).iter().any(|part| part.abs() > 0.3);
    ensure(touched == [2, 0] && moves, || format!("nothing much happens: {touched:?}"))?;
    // Controls: leaves that follow the wind by one percent more, and a ball that passes farther off.
    for (from, to) in [("heading: 0.7", "heading: 0.7, gain: 0.606"), ("radius: 0.9", "radius: 3.9")] {
        let (mut cpu, mut other) = (world(PLANTS)?, world(&PLANTS.replace(from, to))?);
        Backend::Cpu.run(gpu, &mut cpu, 40)?;
        Backend::on(gpu, &other)?.run(gpu, &mut other, 40)?;
        let [ours, theirs] = [numbers(&cpu), numbers(&other)];
        let found = ours.len() != theirs.len() || !Deviation::of(&ours, &theirs, WAVES.outlier).within(&WAVES);
        ensure(found, || format!("{to} is not found"))?;
    }
    Ok(())
}
