//! Whole runs of stands whose billboards bodies deform, on the CPU and on the GPU.

use std::sync::Arc;

use libtest_mimic::Failed;
use sward::model::{Assets, Folder};
use sward::scene::Scene;
use sward::world::World;
use sward_wgpu::compare::Tolerance;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::glb;
use crate::kernels::judge;
use crate::runs::{Backend, agree, cells, world};

/// Agreement of vertices after one step from the same state, m: sheets half a metre long, in `f32`. One in thousands goes another way.
const ONE_STEP: Tolerance = Tolerance { p999: 2e-5, rms: 1e-4, outlier: 1e-4, share: 5e-4 };

/// A ball with long axes walks over hills in gusts, and grass recovers behind it.
const WALKER: &str = r#"(version: 1, field: (patch_side: 16), terrain: Image(path: "assets/jacksboro.png", scale: 0.03125),
    stands: [(species: Meadow, cells: 128, response: Springs(recover: 1))], wind: [Natural()],
    interactors: [(shape: Ellipsoid(radii: (0.25, 0.9, 0.25)), path: Circle(centre: (0, 2), radius: 3, speed: 1.5))],
    camera: (eye: (0, 2, 0), target: (4, 1, 8)), budget: (patches: 9))"#;

/// A box that turns into the grass, on the same hills.
const BOX: &str = r#"(version: 1, field: (patch_side: 16), terrain: Image(path: "assets/jacksboro.png", scale: 0.03125),
    stands: [(species: Meadow, cells: 128, response: Springs(recover: 1))], wind: [Uniform(velocity: (3, 1))],
    interactors: [(shape: Box(size: (1, 1, 1.5)), path: Keyframes(keys: [(time: 0, at: (-4, 3)), (time: 2, at: (4, 7))]))],
    camera: (eye: (0, 2, 0), target: (4, 1, 8)), budget: (patches: 9))"#;

/// A walker, a box and a ball that vanishes, on hills, among limits of growth, in gusts.
const SHEETS: &str = r#"(version: 1, field: (patch_side: 16), terrain: Image(path: "assets/jacksboro.png", scale: 0.03125),
    stands: [(species: Meadow, cells: 96, response: Springs(recover: 1.2))], wind: [Natural()],
    exclusions: [(area: Road(points: [(-30, 2), (0, 3), (30, -4)], width: 2), soft: 0.8)],
    interactors: [
        (shape: Ellipsoid(radii: (0.25, 0.9, 0.25)), path: Circle(centre: (0, 2), radius: 3, speed: 1.5)),
        (shape: Box(size: (1, 1, 1.5)), clearance: 0.1, path: Keyframes(keys: [(time: 0, at: (-6, 3)), (time: 4, at: (6, 8))])),
        (shape: Sphere(radius: 1), path: Still(at: (5, 3)), from: 0.3, until: 1.7),
    ], camera: (eye: (0, 2, 0), target: (4, 1, 8)), budget: (patches: 9))"#;

/// Finer sheets, in a small pool, under a truck.
const CROWDED: &str =
    "(version: 1, field: (patch_side: 8), stands: [(species: Reed, cells: 24, response: Springs(columns: 5, rows: 4, recover: 1))],
    interactors: [(shape: Truck, path: Circle(centre: (0, 2), radius: 4, speed: 5))], budget: (sheets: 64))";

/// Figures whose clips move limbs, and bend one skin over two joints.
const FIGURES: &str = r#"(version: 1, field: (patch_side: 16),
    stands: [(species: Meadow, cells: 128, height: (0.4, 0.4), response: Springs(recover: 1))], wind: [Natural()], interactors: [
        (shape: Mesh(file: "walker.glb", clip: "Walk"), path: Circle(centre: (4, 4), radius: 3, speed: 1)),
        (shape: Mesh(file: "post.glb", clip: "Bow"), path: Keyframes(keys: [(time: 0, at: (-2, 3)), (time: 2, at: (0, 3))])),
    ])"#;

struct Figures;

impl Assets for Figures {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        match path {
            "walker.glb" => Ok(glb::walker().bytes()),
            "post.glb" => Ok(glb::post().bytes()),
            _ => Folder(concat!(env!("CARGO_MANIFEST_DIR"), "/../..").into()).read(path),
        }
    }
}

/// Some have a sheet.
fn is_deformed(world: &World) -> bool {
    world.state.stands[0].sheets.pool.taken().count() > 10
}

/// What two worlds would do next to their sheets is the same: nodes, places, bodies.
fn plans_agree(mut a: World, mut b: World) -> Verdict {
    let [a, b] = [&mut a, &mut b].map(|world| world.plan().stands.into_iter().map(|stand| stand.sheets).collect::<Vec<_>>());
    ensure(a.iter().any(|sheets| !sheets.active.is_empty()), || "nothing is active".to_owned())?;
    ensure(format!("{a:?}") == format!("{b:?}"), || "plans differ".to_owned())
}

/// Both backends on a world for some steps, twice; and once more on the GPU with `change`, which must be found.
fn compare(gpu: &Gpu, name: &str, make: &dyn Fn() -> Result<World, Failed>, steps: u64, change: &dyn Fn(&mut World)) -> Verdict {
    let (mut cpu, mut other, mut changed) = (make()?, make()?, make()?);
    let mut on_gpu = Backend::on(gpu, &other)?;
    for _ in 0..2 {
        Backend::Cpu.run(gpu, &mut cpu, steps / 2)?;
        on_gpu.run(gpu, &mut other, steps / 2)?;
        agree(name, &cpu, &other, true)?;
    }
    ensure(is_deformed(&cpu), || format!("{name}: too few sheets"))?;
    change(&mut changed);
    Backend::on(gpu, &changed)?.run(gpu, &mut changed, steps)?;
    let found = agree(name, &cpu, &changed, false).err().ok_or_else(|| format!("{name}: what differs is not found"))?;
    println!("control: {}", found.message().unwrap_or_default());
    ensure(found.message().is_some_and(|found| found.contains("bend")), || format!("{name}: found by something else"))?;
    plans_agree(cpu, other)
}

/// Recovery a hundredth slower, springs half as stiff.
fn softer(world: &mut World) {
    if let Some(springs) = &mut world.model.stands[0].springs {
        springs.coefficients.recover *= 1.01;
        springs.coefficients.stiffness *= 0.5;
    }
}

/// One step from the same state, of a crowd in a small pool and of the others: little for rounding to decide. Control: softer sheets.
pub(crate) fn steps(gpu: &Gpu) -> Verdict {
    let crowd: fn(&World) -> bool = |world| world.state.stands[0].sheets.pool.evicted > 10;
    for (name, scene, shows) in [("crowded", CROWDED, crowd), ("box", BOX, is_deformed), ("sheets", SHEETS, is_deformed)] {
        let mut found = false;
        for before in [10, 59] {
            let (mut cpu, mut other, mut changed) = (world(scene)?, world(scene)?, world(scene)?);
            Backend::Cpu.run(gpu, &mut cpu, before)?;
            other.restore(&cpu.save())?;
            changed.restore(&cpu.save())?;
            softer(&mut changed);
            Backend::Cpu.run(gpu, &mut cpu, 1)?;
            Backend::on(gpu, &other)?.run(gpu, &mut other, 1)?;
            Backend::Cpu.run(gpu, &mut changed, 1)?;
            agree(name, &cpu, &other, false)?;
            let [own, theirs, softer] = [&cpu, &other, &changed].map(|world| cells(world, 0)[0].clone());
            judge(&format!("{name}, step {before} alone"), &own, &theirs, &ONE_STEP)?;
            found |= judge("softer", &own, &softer, &ONE_STEP).is_err();
            ensure(before < 59 || shows(&cpu), || format!("{name} does not show what it is about"))?;
        }
        ensure(found, || format!("{name}: softer sheets are not found"))?;
    }
    Ok(())
}

/// An ellipsoid in wind on hills, a box, and all together. Control: softer sheets.
pub(crate) fn runs(gpu: &Gpu) -> Verdict {
    compare(gpu, "ellipsoid", &|| world(WALKER), 120, &softer)?;
    compare(gpu, "box", &|| world(BOX), 120, &softer)?;
    compare(gpu, "sheets", &|| world(SHEETS), 120, &softer)
}

/// Figures whose maps are drawn anew in each step, by the device. Control: the device draws them a twentieth smaller.
pub(crate) fn figures(gpu: &Gpu) -> Verdict {
    let make = || Ok(World::new(Scene::parse(FIGURES, "figures.ron")?, &Figures)?);
    compare(gpu, "figures", &make, 120, &|world| {
        for body in &mut world.model.bodies {
            let Some(figure) = &mut body.figure else { continue };
            for vertex in &mut Arc::make_mut(&mut figure.figure).vertices {
                vertex.position = vertex.position.map(|part| 0.95 * part);
            }
        }
    })
}

/// More sheets than one dispatch takes.
pub(crate) fn many(gpu: &Gpu) -> Verdict {
    let make = || {
        world(
            "(version: 1, field: (patch_side: 16), stands: [(species: Meadow, cells: 128, response: Springs())], wind: [Natural()],
            interactors: [(shape: Ellipsoid(radii: (5, 1.5, 5)), path: Keyframes(keys: [(time: 0, at: (8, 8)), (time: 1, at: (9, 8))]))])",
        )
    };
    compare(gpu, "many", &make, 8, &softer)?;
    let mut many = make()?;
    many.step();
    let count = many.state.stands[0].sheets.pool.taken().count();
    ensure(count > sward_wgpu::compute::sheets::MOST_AT_ONCE, || format!("only {count} sheets"))
}

/// What a download gives back: bends that can be asked for, and a state that continues as if it had never been saved.
pub(crate) fn handed_over(gpu: &Gpu) -> Verdict {
    let (mut cpu, mut whole, mut first) = (world(WALKER)?, world(WALKER)?, world(WALKER)?);
    let bends = |world: &World| -> Vec<f32> {
        let places = (0..900).map(|k| [f64::from(k % 30) * 0.27 - 4.0, f64::from(k / 30) * 0.27 - 2.0]);
        places.filter_map(|at| world.bend_at(0, at)).flatten().collect()
    };
    let apart = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    Backend::Cpu.run(gpu, &mut cpu, 40)?;
    let mut step = GpuStep::new(gpu, &first)?;
    for _ in 0..40 {
        step.step(gpu, &mut first)?;
    }
    let before = apart(&bends(&cpu), &bends(&first));
    step.download(gpu, &mut first)?;
    let after = apart(&bends(&cpu), &bends(&first));
    println!("bends asked for: {before:.1e} rad apart before the download, {after:.1e} after");
    ensure(before > 0.1 && after < 1e-3, || format!("{before} {after}"))?;
    // Saved, and continued by another device; and by the CPU.
    let mut again = world(WALKER)?;
    again.restore(&first.save())?;
    Backend::on(gpu, &again)?.run(gpu, &mut again, 40)?;
    Backend::on(gpu, &whole)?.run(gpu, &mut whole, 80)?;
    ensure(again.save() == whole.save(), || "the saved run is another".to_owned())?;
    Backend::Cpu.run(gpu, &mut first, 40)?;
    agree("continued by the CPU", &first, &whole, true)
}

/// Billboards that nothing is near add no invocation; those with a sheet one or, near a body, two each, in groups of 64.
pub(crate) fn free_billboards_cost_nothing(gpu: &Gpu) -> Verdict {
    let cost = |patches: u32, radius: f32| -> Result<(u64, u64), Failed> {
        let mut world = world(&format!(
            "(version: 1, field: (patch_side: 16, patches: ({patches}, {patches})),
            stands: [(species: Meadow, cells: 64, response: Springs(recover: 0.3))],
            interactors: [(shape: Ellipsoid(radii: ({radius}, 1, {radius})), path: Still(at: (4, 4)), until: 0.3)])"
        ))?;
        let mut step = GpuStep::new(gpu, &world)?;
        let mut awake = 0;
        for number in 0..60 {
            let before = step.work;
            step.step(gpu, &mut world)?;
            let sheets = world.state.stands[0].sheets.pool.taken().count() as u64;
            let least = 64 * sheets.div_ceil(64);
            let invocations = step.work.invocations - before.invocations;
            ensure((least..=2 * least).contains(&invocations), || format!("{invocations} invocations for {sheets} sheets"))?;
            ensure(number < 50 || step.work.dispatches == before.dispatches, || "dispatches after all have recovered".to_owned())?;
            awake += sheets;
        }
        step.wait(gpu, &mut world)?;
        Ok((step.work.invocations, awake))
    };
    let [small, large, wide] = [cost(2, 0.5)?, cost(200, 0.5)?, cost(2, 1.5)?];
    println!("invocations and sheets: {small:?} on 4 patches, {large:?} on 40000, {wide:?} under a body three times as wide");
    ensure(small == large && small.0 > 0 && wide.1 > 4 * small.1, || format!("{small:?} {large:?} {wide:?}"))
}
