//! What hosts change while a world runs: the device follows bodies, wind, responses and growth, as the CPU does.

use libtest_mimic::Failed;
use sward::model::Folder;
use sward::scene::{Change, Cut, Edit, Interactor, Path, Shape, Sphere, Still, response};
use sward::world::{Input, World};
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::reactions;
use crate::runs::{Backend, agree, world};

/// A calm world of one stand.
fn calm(stand: &str) -> String {
    format!(
        "(version: 1, field: (patch_side: 8), stands: [({stand})], camera: (eye: (0, 2, 0), target: (2, 1, 4)),
          interactors: [(shape: Sphere(radius: 0.4), path: Circle(centre: (0, 2), radius: 1.5, speed: 3), until: 0.8)],
          budget: (patches: 12, focus_distance: 8, lag_distance: 10))"
    )
}

/// Inputs with the steps before which they come: bodies that come and go, gusts, a whirl and air that flows, other numbers, cut grass.
fn inputs(other: &str) -> Result<Vec<(u64, Input)>, Failed> {
    let ball = |at| Interactor {
        shape: Shape::Sphere(Sphere { radius: 0.5 }),
        path: Path::Still(Still { at, yaw: 0.0 }),
        ..Interactor::default()
    };
    let wind = |text: &str| -> Result<_, Failed> {
        let scene = format!("(version: 1, wind: [{text}])");
        Ok(sward::scene::Scene::parse(&scene, "wind.ron")?.wind.remove(0))
    };
    let add = |text: &str, fade| -> Result<_, Failed> { Ok(Input::AddWind { source: wind(text)?, fade }) };
    let edit = |at, change| Input::Edit(Edit { at, radius: 1.5, change, ..Edit::default() });
    Ok(vec![
        (6, Input::AddBody(ball([1.2, 1.0]))),
        (10, add("Natural(velocity: (3, 1))", 0.2)?),
        (14, Input::AddBody(Interactor { shape: Shape::Box(Default::default()), ..ball([-1.0, 1.5]) })),
        (20, Input::Tune { stand: 0, response: response(other)?, over: 0.2 }),
        (24, edit([0.5, 3.0], Change::Cut(Cut { height: 0.1 }))),
        (28, add("Fluid(velocity: (2, 0), side: 16, cells: 32)", 0.1)?),
        (34, Input::RemoveBody(1)),
        (36, add("Footprint(flow: Swirl, radius: 5, speed: 6)", 0.1)?),
        (40, Input::AddBody(ball([0.3, 0.2]))),
        (44, edit([-1.0, 0.0], Change::Burn)),
        (48, Input::RemoveWind { wind: 0, fade: 0.1 }),
    ])
}

fn assets() -> Folder {
    Folder(concat!(env!("CARGO_MANIFEST_DIR"), "/../..").into())
}

fn run(gpu: &Gpu, backend: &mut Backend, world: &mut World, inputs: &[(u64, Input)], last: u64) -> Verdict {
    while world.state.step < last {
        let now = world.state.step;
        for (_, input) in inputs.iter().filter(|(step, _)| *step == now) {
            world.apply(input, &assets())?;
        }
        let next = inputs.iter().map(|(step, _)| *step).find(|step| *step > world.state.step).unwrap_or(last).min(last);
        backend.run(gpu, world, next - world.state.step)?;
    }
    Ok(())
}

/// Every response follows; of each the parts that the device did not know of would differ.
pub(crate) fn followed(gpu: &Gpu) -> Verdict {
    let cases = [
        ("species: Meadow, cells: 32", "Continuum(frequency: 2.5, wind: 0.06)"),
        ("species: Meadow, cells: 32, response: Oscillator()", "Oscillator(frequency: 2.5, wind: 3)"),
        ("species: Meadow, cells: 8, response: VirtualInertia(), representation: Blade(blades: 3)", "VirtualInertia(drag: 3e-3)"),
        ("species: Meadow, cells: 16, response: Springs()", "Springs(wind: 0.06, recover: 1.5)"),
    ];
    for (stand, other) in cases {
        let (text, inputs) = (calm(stand), inputs(other)?);
        let (mut cpu, mut other) = (world(&text)?, world(&text)?);
        let (mut backend, mut hash) = (Backend::on(gpu, &other)?, 0);
        let mut largest = 0.0_f64;
        for last in [5, 8, 22, 28, 42, 60] {
            run(gpu, &mut Backend::Cpu, &mut cpu, &inputs, last)?;
            run(gpu, &mut backend, &mut other, &inputs, last)?;
            agree(stand, &cpu, &other, true)?;
            largest = largest.max(reactions::agree(stand, &cpu, &other)?);
            if last == 28 {
                hash = cpu.hash();
            }
        }
        ensure(cpu.state.winds[0].vacant && cpu.state.fluids.len() == 1 && cpu.state.vacant.is_empty(), || {
            "not all of it came about".to_owned()
        })?;
        let (events, others) = (cpu.take_events(), other.take_events());
        println!("{stand}: bodies feel up to {largest:.2} N and N·m, {} events", events.len());
        ensure(largest > 0.01 && !events.is_empty(), || format!("{stand}: nothing is felt"))?;
        ensure(reactions::plain(&events) == reactions::plain(&others), || format!("{stand}: other events: {events:?}, {others:?}"))?;
        // Control: without the other numbers, and without the first ball, it is another state.
        for left_out in [0, 3] {
            let mut less: Vec<_> = inputs.iter().filter(|(step, _)| *step < 28).cloned().collect();
            less.remove(left_out);
            let mut without = world(&text)?;
            run(gpu, &mut Backend::Cpu, &mut without, &less, 28)?;
            // Sheets of the wind alone are not kept.
            let sheets = stand.contains("Springs") && left_out == 3;
            ensure(sheets || without.hash() != hash, || format!("{stand}: input {left_out} changes nothing"))?;
        }
    }
    Ok(())
}
