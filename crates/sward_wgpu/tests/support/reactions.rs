//! What plants do to bodies is the same on both backends, and so are the events.

use sward::state::{Event, Reaction};
use sward::world::World;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::runs::{Backend, world};

/// Steps of a run.
const STEPS: usize = 90;
/// Largest difference of a force or moment, over the largest there is.
const TOLERANCE: f64 = 2e-3;

/// A stand under a ball of a radius \[m\] that goes round in a wind.
fn scene(stand: &str, radius: f64) -> String {
    format!(
        "(version: 1, field: (patch_side: 8), stands: [({stand})], wind: [Natural(velocity: (2, 1))],
          camera: (eye: (0, 2, 0), target: (2, 1, 4)),
          interactors: [(name: \"ball\", shape: Sphere(radius: {radius}), path: Circle(centre: (0, 2), radius: 1.5, speed: 2)),
                        (shape: Box(size: (0.8, 0.6, 1.2)), clearance: 0.1, path: Circle(centre: (1, 2), radius: 3, speed: 6), until: 1.2)],
          budget: (patches: 12, focus_distance: 8))"
    )
}

/// What both bodies feel, step by step, and all events.
fn felt(gpu: &Gpu, backend: &mut Backend, world: &mut World) -> Result<(Vec<[Reaction; 2]>, Vec<Event>), libtest_mimic::Failed> {
    let mut felt = Vec::new();
    for _ in 0..STEPS {
        backend.run(gpu, world, 1)?;
        felt.push([0, 1].map(|body| world.reaction(body).unwrap_or_default()));
    }
    Ok((felt, world.take_events()))
}

/// Largest difference of forces and moments, and the largest there is.
fn apart(a: &[[Reaction; 2]], b: &[[Reaction; 2]]) -> [f64; 2] {
    let numbers = |felt: &[[Reaction; 2]]| -> Vec<f64> {
        felt.iter().flatten().flat_map(|felt| felt.force.into_iter().chain(felt.torque).collect::<Vec<_>>()).collect()
    };
    let (a, b) = (numbers(a), numbers(b));
    let largest = a.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    [a.iter().zip(&b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())), largest]
}

/// What all bodies feel is the same, as far as both worlds are; returns the largest force.
pub(crate) fn agree(name: &str, cpu: &World, gpu: &World) -> Result<f64, libtest_mimic::Failed> {
    let felt = |world: &World| (0..world.state.bodies.len()).map(|body| [world.reaction(body).unwrap_or_default(); 2]).collect::<Vec<_>>();
    let [off, largest] = apart(&felt(cpu), &felt(gpu));
    ensure(off <= TOLERANCE * largest, || format!("{name}: {off} of {largest} N and N·m"))?;
    Ok(largest)
}

/// When and between whom events are.
pub(crate) fn plain(events: &[Event]) -> Vec<(u64, usize, usize)> {
    events.iter().map(|event| (event.step, event.body, event.stand)).collect()
}

/// Of meshes, step by step; other responses are in [`crate::inputs::followed`].
pub(crate) fn of_meshes(gpu: &Gpu) -> Verdict {
    let stand = "species: Shrub, cells: 8, height: (0.8, 1.0), representation: Layers(mesh: Grown(form: Bush, triangles: 2000))";
    let text = scene(stand, 0.4);
    let (mut cpu, mut other, mut larger) = (world(&text)?, world(&text)?, world(&scene(stand, 0.45))?);
    let mut backend = Backend::on(gpu, &other)?;
    let (here, there) = (felt(gpu, &mut Backend::Cpu, &mut cpu)?, felt(gpu, &mut backend, &mut other)?);
    let [off, largest] = apart(&here.0, &there.0);
    println!("meshes: {off:.2e} of {largest:.2} N and N·m, {} events", here.1.len());
    ensure(largest > 0.1, || "nothing is felt".to_owned())?;
    ensure(off < TOLERANCE * largest, || format!("{off} of {largest}"))?;
    let [off, _] = apart(&here.0, &felt(gpu, &mut Backend::Cpu, &mut larger)?.0);
    ensure(off > TOLERANCE * largest, || "control: a larger ball feels the same".to_owned())?;
    ensure(!here.1.is_empty() && plain(&here.1) == plain(&there.1), || format!("other events: {:?} and {:?}", here.1, there.1))
}
