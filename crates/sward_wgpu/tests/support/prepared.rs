//! Plants and joints solved on the GPU and on the CPU.

use libtest_mimic::Failed;
use sward::picture::plan::{self, Seen};
use sward::picture::plants::Plant;
use sward::picture::prepare::{PrepareUniform, Preparing};
use sward::picture::subject::{self, Frame};
use sward::response::continuum::NODE_CELLS;
use sward::scene::Scene;
use sward::world::World;
use sward_wgpu::compare::Tolerance;
use sward_wgpu::compute::{GpuStep, readback};
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

use crate::adapter::{Verdict, ensure};
use crate::kernels::judge;

/// Both batches of a world's first stand as the CPU solves them: numbers of plants, then of joints.
fn on_cpu(world: &World, behind: f64) -> [Vec<f32>; 2] {
    let (view, looks) = (world.camera_before(behind), subject::looks(world));
    let (_, origin) = Frame::of(world, &view, behind);
    let seen = Seen { view: &view, origin, fullness: 1.0, near: 1.0, behind };
    let (stand, state) = (&world.model.stands[0], &world.state.stands[0]);
    let (plans, fullness) = plan::plan(world, 0, &seen, &looks[0], world.scene.budget.visible_plants);
    let seen = Seen { fullness, ..seen };
    let wind = world.wind_before(stand, behind);
    let (mut plants, mut joints) = (Vec::new(), Vec::new());
    for (plan, plain) in plans.iter().zip([false, true]) {
        let uniform = PrepareUniform::new(world, stand, plain, &seen, &looks[0]);
        let intervals = stand.cells / NODE_CELLS;
        let preparing = Preparing { uniform, cells: &state.cells, terrain: &world.model.terrain, stand, wind: &wind, intervals };
        for draw in &plan.draws {
            let mut solved = vec![Plant::default(); draw.count as usize];
            let mut spines = vec![[0.0; 4]; solved.len() * uniform.joints() as usize];
            preparing.prepare_patch(draw, &mut solved, &mut spines);
            gather(&solved, &spines, &mut plants, &mut joints);
        }
    }
    [plants, joints]
}

/// Joints of places without a plant mean nothing.
fn gather(solved: &[Plant], spines: &[[f32; 4]], plants: &mut Vec<f32>, joints: &mut Vec<f32>) {
    let count = spines.len() / solved.len().max(1);
    for (plant, spine) in solved.iter().zip(spines.chunks_exact(count.max(1))) {
        let there = if plant.height > 0.0 { 1.0 } else { 0.0 };
        plants.extend(plant.root);
        plants.extend([plant.height, plant.yaw, plant.width, plant.tint, plant.layer as f32]);
        joints.extend(spine.iter().flat_map(|joint| [joint[0], joint[1], joint[2]]).map(|value| value * there));
    }
}

/// The same as the GPU solves them.
fn on_gpu(gpu: &Gpu, world: &World, behind: f64) -> Result<[Vec<f32>; 2], Failed> {
    let mut studio = Studio::new(gpu, world)?;
    studio.draw_before(gpu, world, CellsAt::Cpu, behind, [32, 18])?;
    solved(gpu, &studio)
}

/// What a studio solved for its last picture.
fn solved(gpu: &Gpu, studio: &Studio) -> Result<[Vec<f32>; 2], Failed> {
    let (mut plants, mut joints) = (Vec::new(), Vec::new());
    for batch in studio.batches(0).into_iter().flatten().filter(|batch| batch.plants > 0) {
        let Some((stored, stored_joints)) = &batch.filled else { continue };
        let solved: Vec<Plant> = readback::read(gpu, stored, u64::from(batch.plants) * 32)?;
        let bytes = u64::from(batch.plants) * 16 * u64::from(batch.joints);
        let spines: Vec<[f32; 4]> = readback::read(gpu, stored_joints, bytes)?;
        gather(&solved, &spines, &mut plants, &mut joints);
    }
    Ok([plants, joints])
}

/// Bodies, gusts, patches with upper segments and without, sleeping ones; near and plain plants.
pub(crate) fn plants_solved(gpu: &Gpu) -> Verdict {
    let text = "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], wind: [Natural(velocity: (4.0, 2.0))],
        budget: (patches: 25, focus_distance: 10.0, lag_distance: 6.0), camera: (eye: (0, 2, -4), target: (0, 0, 6)),
        interactors: [(shape: Sphere(radius: 0.6), path: Circle(radius: 3.0, speed: 4.0))])";
    let mut world = World::new(Scene::parse(text, "prepare.ron")?, &sward::model::NoAssets)?;
    (0..40).for_each(|_| world.step());
    // A plant at the end of the drawing order may fall on either side of a rounded limit; then all its numbers differ.
    let tolerance = Tolerance { p999: 2e-5, rms: 1e-2, outlier: 1e-4, share: 2e-4 };
    let [_, own_joints] = on_cpu(&world, 0.0);
    for behind in [0.0, 0.4] {
        let [plants, joints] = on_gpu(gpu, &world, behind)?;
        let [own_plants, earlier] = on_cpu(&world, behind);
        judge("plants", &own_plants, &plants, &tolerance)?;
        judge("joints", &earlier, &joints, &tolerance)?;
        ensure(plants.len() > 8 * 10_000, || format!("only {} plants", plants.len() / 8))?;
        let other = judge("another moment", &own_joints, &earlier, &tolerance).is_err();
        ensure(other == (behind > 0.0), || format!("{behind} steps before the state"))?;
    }
    // One step later the plants stand where they stood, and their joints do not.
    world.step();
    let [_, later] = on_cpu(&world, 0.0);
    ensure(judge("one step later", &own_joints, &later, &tolerance).is_err(), || "a step later looks the same".to_owned())
}

/// Plants in air that flows: from a CPU at the moment of a step and between two, and from a GPU that steps it. Control: the flow that the CPU holds while
/// the GPU steps.
pub(crate) fn air_solved(gpu: &Gpu) -> Verdict {
    let text = "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], wind: [Fluid(side: 12, cells: 32)],
        budget: (patches: 9, focus_distance: 8.0, lag_distance: 6.0), camera: (eye: (0, 2, -4), target: (0, 0, 6)),
        interactors: [(shape: Box(size: (1, 1, 2)), path: Circle(radius: 3.0, speed: 4.0))])";
    let mut world = World::new(Scene::parse(text, "prepare.ron")?, &sward::model::NoAssets)?;
    let mut step = GpuStep::new(gpu, &world)?;
    for _ in 0..21 {
        step.step(gpu, &mut world)?;
    }
    step.wait(gpu, &mut world)?;
    let stale = world.state.fluids.clone();
    let mut studio = Studio::new(gpu, &world)?;
    let tolerance = Tolerance { p999: 2e-5, rms: 1e-2, outlier: 1e-4, share: 2e-4 };
    let mut stepped = Vec::new();
    for behind in [0.0, 0.4] {
        studio.draw_before(gpu, &world, CellsAt::Gpu(&step), behind, [32, 18])?;
        stepped.push((behind, solved(gpu, &studio)?));
    }
    step.download(gpu, &mut world)?;
    for (behind, [plants, joints]) in stepped {
        let [own_plants, own_joints] = on_cpu(&world, behind);
        judge("plants in air", &own_plants, &plants, &tolerance)?;
        judge("joints in air", &own_joints, &joints, &tolerance)?;
        let [_, uploaded] = on_gpu(gpu, &world, behind)?;
        judge("joints in uploaded air", &own_joints, &uploaded, &tolerance)?;
    }
    let [_, own_joints] = on_cpu(&world, 0.0);
    world.state.fluids = stale;
    let [_, still] = on_cpu(&world, 0.0);
    ensure(judge("air as it was", &own_joints, &still, &tolerance).is_err(), || "still air looks the same".to_owned())
}

/// Plants that swing by themselves: held, let go and at rest, in gusts; at the moment of a step and between two.
pub(crate) fn swings_solved(gpu: &Gpu) -> Verdict {
    let text = "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32, response: Oscillator())], wind: [Natural(velocity: (4.0, 2.0))],
        budget: (patches: 25, focus_distance: 10.0, visible_plants: 20000), camera: (eye: (0, 2, -4), target: (0, 0, 6)),
        exclusions: [(area: Road(points: [(-30, 6), (2, 3), (9, 40)], width: 2), soft: 1.5)],
        interactors: [(shape: Sphere(radius: 1.2), path: Circle(radius: 3.0, speed: 6.0))])";
    let mut world = World::new(Scene::parse(text, "swings.ron")?, &sward::model::NoAssets)?;
    (0..80).for_each(|_| world.step());
    let tolerance = Tolerance { p999: 5e-5, rms: 1e-2, outlier: 1e-4, share: 4e-4 };
    let [_, own_joints] = on_cpu(&world, 0.0);
    for behind in [0.0, 0.4] {
        let [plants, joints] = on_gpu(gpu, &world, behind)?;
        let [own_plants, earlier] = on_cpu(&world, behind);
        judge("plants", &own_plants, &plants, &tolerance)?;
        judge("joints", &earlier, &joints, &tolerance)?;
        let other = judge("another moment", &own_joints, &earlier, &tolerance).is_err();
        ensure(other == (behind > 0.0), || format!("{behind} steps before the state"))?;
    }
    // Control: as if none had ever been touched.
    world.state.stands[0].cells.now.iter_mut().for_each(|records| records.fill(0.0));
    ensure(judge("untouched", &own_joints, &on_cpu(&world, 0.0)[1], &tolerance).is_err(), || "bodies left no track".to_owned())
}

/// Billboards that bodies deform, as spines: deformed, recovering and free, in gusts.
pub(crate) fn sheets_bent(gpu: &Gpu) -> Verdict {
    let text =
        "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32, response: Springs(), representation: Billboard())],
        wind: [Natural(velocity: (4.0, 2.0))], camera: (eye: (0, 2, -4), target: (0, 0, 6)),
        interactors: [(shape: Sphere(radius: 0.7), path: Circle(radius: 3.0, speed: 4.0))])";
    let mut world = World::new(Scene::parse(text, "sheets.ron")?, &sward::model::NoAssets)?;
    (0..80).for_each(|_| world.step());
    let tolerance = Tolerance { p999: 5e-5, rms: 1e-2, outlier: 1e-3, share: 4e-4 };
    let [own_plants, own_joints] = on_cpu(&world, 0.0);
    let [plants, joints] = on_gpu(gpu, &world, 0.0)?;
    judge("plants", &own_plants, &plants, &tolerance)?;
    judge("joints", &own_joints, &joints, &tolerance)?;
    // Control: as if none had a sheet.
    world.state.stands[0].cells.now.iter_mut().for_each(|places| places.fill(f32::from_bits(u32::MAX)));
    ensure(judge("untouched", &own_joints, &on_cpu(&world, 0.0)[1], &tolerance).is_err(), || "bodies left no track".to_owned())
}

/// Billboards that bodies deform, as the sheets they are: deformed, recovering and free, in gusts on a hill; near, thinned out and plain.
pub(crate) fn deformed_sheets_solved(gpu: &Gpu) -> Verdict {
    for response in ["", "columns: 2, rows: 9, recover: 1", "columns: 4, rows: 2"] {
        let text = format!(
            "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32, response: Springs({response}))],
            wind: [Natural(velocity: (4.0, 2.0))], camera: (eye: (0, 2, -4), target: (0, 0, 6)), budget: (visible_plants: 20000),
            edits: [(at: (3, 3), radius: 6, change: Raise(height: 1.2))],
            interactors: [(shape: Sphere(radius: 0.7), path: Circle(radius: 3.0, speed: 4.0))])"
        );
        let mut world = World::new(Scene::parse(&text, "sheets.ron")?, &sward::model::NoAssets)?;
        (0..80).for_each(|_| world.step());
        let tolerance = Tolerance { p999: 5e-5, rms: 1e-2, outlier: 1e-3, share: 4e-4 };
        let own = on_cpu(&world, 0.0)[1].clone();
        for behind in [0.0, 0.4] {
            let [plants, points] = on_gpu(gpu, &world, behind)?;
            let [own_plants, earlier] = on_cpu(&world, behind);
            judge("plants", &own_plants, &plants, &tolerance)?;
            judge(&format!("{response}: points"), &earlier, &points, &tolerance)?;
            let other = judge("another moment", &own, &earlier, &tolerance).is_err();
            ensure(other == (behind > 0.0), || format!("{behind} steps before the state"))?;
        }
        // Control: as if none had a sheet.
        world.state.stands[0].cells.now.iter_mut().for_each(|places| places.fill(f32::from_bits(u32::MAX)));
        ensure(judge("untouched", &own, &on_cpu(&world, 0.0)[1], &tolerance).is_err(), || "bodies left no track".to_owned())?;
    }
    Ok(())
}

/// A road, a house and a hill that rose: plants that are gone, lower, and higher up.
pub(crate) fn plants_on_edited_ground(gpu: &Gpu) -> Verdict {
    let text = |more: &str| {
        format!(
            "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], {more}
            budget: (patches: 25, lag_distance: 6.0), camera: (eye: (0, 2, -4), target: (0, 0, 6)))"
        )
    };
    let limits = "exclusions: [(area: Road(points: [(-30, 6), (2, 3), (9, 40)], width: 3), soft: 1.5), (area: Box(at: (-4, 14), size: (5, 7), yaw: 0.3))],
        edits: [(at: (3, 9), radius: 6, change: Raise(height: 1.2))],";
    let mut world = World::new(Scene::parse(&text(limits), "limits.ron")?, &sward::model::NoAssets)?;
    let free = World::new(Scene::parse(&text(""), "free.ron")?, &sward::model::NoAssets)?;
    let tolerance = Tolerance { p999: 2e-5, rms: 1e-2, outlier: 1e-4, share: 2e-4 };
    let mut studio = Studio::new(gpu, &world)?;
    let raise = |x: f64| sward::scene::Edit { at: [x, 12.0], radius: 3.0, ..sward::scene::Edit::default() };
    // Before and after strokes of a brush that the studio follows: within its grid, and beyond it.
    for stroke in [None, Some(raise(1.0)), Some(raise(-40.0))] {
        if let Some(edit) = stroke {
            world.edit(&edit)?;
        }
        studio.draw_before(gpu, &world, CellsAt::Cpu, 0.0, [32, 18])?;
        let (own, theirs) = (on_cpu(&world, 0.0), solved(gpu, &studio)?);
        judge("plants", &own[0], &theirs[0], &tolerance)?;
        judge("joints", &own[1], &theirs[1], &tolerance)?;
    }
    let standing = |plants: &[f32]| plants.chunks_exact(8).filter(|plant| plant[3] > 0.0).count();
    let (kept, all) = (standing(&on_cpu(&world, 0.0)[0]), standing(&on_cpu(&free, 0.0)[0]));
    ensure(kept + 500 < all, || format!("control: {kept} of {all} plants"))
}

/// Sheets of every kind of response, near and plain, at the moment of a step and between two; and of the fewest and the most vertices.
pub(crate) fn sheets_solved(gpu: &Gpu) -> Verdict {
    for (response, sheet) in [
        ("Continuum()", ""),
        ("Continuum()", "columns: 2, rows: 2, points: 3"),
        ("Oscillator()", "columns: 9, rows: 9, points: 9"),
        ("VirtualInertia()", "rows: 5"),
        ("Chain()", ""),
    ] {
        let text = format!(
            "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32, response: {response}, representation: Sheet({sheet}))],
            wind: [Natural(velocity: (4.0, 2.0))], camera: (eye: (0, 2, -4), target: (0, 0, 6)),
            budget: (patches: 25, focus_distance: 10.0, lag_distance: 6.0, visible_plants: 20000),
            interactors: [(shape: Sphere(radius: 1.2), path: Circle(radius: 3.0, speed: 6.0))])"
        );
        let mut world = World::new(Scene::parse(&text, "sheets.ron")?, &sward::model::NoAssets)?;
        (0..40).for_each(|_| world.step());
        let tolerance = Tolerance { p999: 5e-5, rms: 1e-2, outlier: 1e-4, share: 4e-4 };
        let [_, own_points] = on_cpu(&world, 0.0);
        for behind in [0.0, 0.4] {
            let [plants, points] = on_gpu(gpu, &world, behind)?;
            let [own_plants, earlier] = on_cpu(&world, behind);
            judge("plants", &own_plants, &plants, &tolerance)?;
            judge(&format!("{response} {sheet}: points"), &earlier, &points, &tolerance)?;
            ensure(plants.len() > 8 * 1000, || format!("only {} plants", plants.len() / 8))?;
            let other = judge("another moment", &own_points, &earlier, &tolerance).is_err();
            ensure(other == (behind > 0.0), || format!("{behind} steps before the state"))?;
        }
        // Control: a step later.
        world.step();
        ensure(judge("a step later", &own_points, &on_cpu(&world, 0.0)[1], &tolerance).is_err(), || {
            "a step later looks the same".to_owned()
        })?;
    }
    Ok(())
}

/// No point of a sheet lies below the ground, on steep hills with bumps and in a storm. Control: ground that is shifted.
pub(crate) fn sheets_stay_above_ground(gpu: &Gpu) -> Verdict {
    let text = r#"(version: 1, terrain: Image(path: "assets/jacksboro.png", scale: 0.01), detail: (amplitude: 0.4, wavelength: 3, octaves: 4),
        stands: [(species: Reed, representation: Sheet())], wind: [Natural(velocity: (30, 12), turbulence: 0.5)],
        interactors: [(shape: Truck, path: Keyframes(keys: [(time: 0, at: (-6, 6)), (time: 1, at: (6, 6))]))],
        budget: (focus_distance: 20, lag_distance: 20, visible_plants: 30000))"#;
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let mut world = World::new(Scene::parse(text, "steep.ron")?, &sward::model::Folder(root.into()))?;
    (0..60).for_each(|_| world.step());
    let corner = world.camera().focus().map(|metres| (metres / world.model.patch_side).floor() * world.model.patch_side);
    let below = |points: &[f32], shift: f64| {
        let under = |at: &&[f32]| {
            let ground = world.model.terrain.height_at(f64::from(at[0]) + corner[0] + shift, f64::from(at[2]) + corner[1]);
            at[1] != 0.0 && f64::from(at[1]) < ground - 1e-4
        };
        points.as_chunks::<3>().0.iter().map(|at| &at[..]).filter(under).count()
    };
    for (host, points) in [("CPU", on_cpu(&world, 0.0)[1].clone()), ("GPU", on_gpu(gpu, &world, 0.0)?[1].clone())] {
        let (found, shifted) = (below(&points, 0.0), below(&points, 1.0));
        println!("{host}: {found} of {} points below the ground, {shifted} of a shifted one", points.len() / 3);
        ensure(found == 0 && points.len() > 30_000, || format!("{host}: {found} of {} points below the ground", points.len() / 3))?;
        ensure(shifted > 0, || format!("{host}, control: a shifted ground is not found"))?;
    }
    Ok(())
}
