//! Blades: their kernels, and whole pictures' blades solved on the GPU and on the CPU.

use std::collections::BTreeMap;

use glam::Vec3;
use libtest_mimic::Failed;
use sward::geometry::blade;
use sward::picture::blade_plan::{self, BladePlan, HEAD};
use sward::picture::blades::{Blade, Blades};
use sward::picture::plan::Seen;
use sward::picture::prepare::{PrepareUniform, Preparing};
use sward::picture::subject::{self, Frame};
use sward::response::continuum::NODE_CELLS;
use sward::scene::{BladeOverrides, Precision, Scene};
use sward::shading::blade as shading;
use sward::world::World;
use sward_wgpu::compare::Tolerance;
use sward_wgpu::compute::buffers::CellBuffers;
use sward_wgpu::compute::readback;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::render::blades::{BladeBuffers, SolvePass, Solving};
use sward_wgpu::render::growth_maps::GrowthMaps;
use sward_wgpu::render::prepare::PreparePass;
use sward_wgpu::studio::{CellsAt, Studio};

use crate::adapter::{Verdict, ensure};
use crate::kernels::{By, judge};
use crate::shading::{check, direction, light, vector};

/// Bends, pieces, strips and densities.
pub(crate) fn strips(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        var bends: array<vec2<f32>, 8>;
        let count = next_u();
        for (var k = 0u; k < 8u; k++) { bends[k] = next_v(); }
        let turn = next_v();
        let lean = next_f();
        let stance = BladeStance(turn, lean, next_f());
        let pieces = next_u();
        let coarse = next_u();
        let piece = next_u();
        let morph = next_f();
        let bend = blade_piece_bend(&bends, count, stance, piece, pieces, coarse, morph);
        put_v(bend);
        let way = billboard_segment(bend, 0.1);
        put_3(blade_raised(way, next_f()));
        let twist = next_f();
        put_3(blade_across(turn, normalize(next_3()), twist));
        let along = next_f();
        put_f(blade_profile(along));
        let facing = next_f();
        put_f(blade_density(vec3<f32>(0.15, 0.006, 0.0012), facing, next_f()));
    }";
    // Where a piece hardly rises, or a tangent points down, roundings grow.
    let tolerance = Tolerance { p999: 2e-5, rms: 1e-4, outlier: 1e-4, share: 1e-3 };
    check(gpu, "strips", host, By::Absolute(tolerance), |random| {
        let count = random.whole(1, 9) as usize;
        let bends: Vec<[f32; 2]> = (0..8).map(|_| [random.float(-1.5, 1.5), random.float(-1.5, 1.5)]).collect();
        let turn = random.drawn(0.0, std::f32::consts::TAU);
        let heading = [random.put(turn.cos()), random.put(turn.sin())];
        let stance = blade::Stance { heading, lean: random.float(0.0, 1.2), curl: random.float(0.0, 2.0) };
        let pieces = random.whole(1, 13) as u32;
        let coarse = random.whole(1, pieces as i32 + 1) as u32;
        let piece = random.whole(0, pieces as i32) as u32;
        let morph = random.float(-0.3, 1.0);
        let bend = blade::piece_bend(&bends[..count], &stance, piece, [pieces, coarse], morph);
        let raised = blade::raised(blade::piece(bend, 0.1), random.float(-0.12, 0.12));
        let twist = random.float(-6.0, 6.0);
        let tangent = vector(random, -0.5, 1.0);
        let across = blade::across(heading, tangent.normalize(), twist);
        let profile = blade::profile(random.float(0.0, 1.0));
        let facing = random.float(-1.0, 1.0);
        let density = blade::density([0.15, 0.006, 0.0012], facing, random.float(0.0, 120.0));
        [&bend[..], &raised.to_array(), &across.to_array(), &[profile, density]].concat()
    })
}

/// Light on blades. Control: one percent more light of the sky at the root.
pub(crate) fn lit(gpu: &Gpu) -> Verdict {
    let host = |root: f32| {
        format!(
            "fn twin() {{
            let light = next_light();
            let style = BladeStyle(vec4<f32>(0.024, 0.066, 0.011, 0.05), vec4<f32>(0.085, 0.2, 0.03, 0.8), vec4<f32>(1.6, {root:?}, 0.12, 110.0), vec4<u32>(0u));
            let facing = next_3();
            let across = next_3();
            let side = next_f();
            let along = next_f();
            let ground = next_3();
            let patchwork = next_3();
            let spot = BladeSpot(facing, across, side, along, ground, patchwork, next_f());
            let view = next_3();
            let distance = next_f();
            put_3(shading_blade(style, spot, view, distance, light, next_f()));
            let width = next_f();
            put_f(shading_blade_coverage(width, next_f(), spot.tint));
        }}"
        )
    };
    let tolerance = || Tolerance { p999: 1e-4, rms: 5e-4, outlier: 1e-3, share: 1e-3 };
    let compare = |root: f32| {
        check(gpu, "blades lit", &host(root), By::Relative(tolerance(), 0.05), |random| {
            let light = light(random);
            let style = shading::BladeStyle {
                root: [0.024, 0.066, 0.011, 0.05],
                tip: [0.085, 0.2, 0.03, 0.8],
                light: [1.6, 0.22, 0.12, 110.0],
                shape: [0; 4],
            };
            let (facing, across) = (direction(random, -1.0), direction(random, -1.0));
            let (side, along) = (random.float(-1.0, 1.0), random.float(0.0, 1.0));
            let ground = direction(random, 0.5);
            let patchwork = vector(random, 0.0, 1.0);
            let spot = shading::Spot { facing, across, side, along, ground, patchwork, tint: random.float(0.0, 1.0) };
            let view = direction(random, -1.0);
            let distance = random.float(0.3, 110.0);
            let colour = shading::blade(&style, &spot, view, distance, &light, random.float(0.0, 1.0));
            let width = random.float(0.0, 0.02);
            let cover = shading::coverage(width, random.float(0.0, 0.02), spot.tint);
            [&colour.to_array()[..], &[cover]].concat()
        })
    };
    compare(0.22)?;
    ensure(compare(0.2222).is_err(), || "one percent more light is not found".to_owned())
}

/// Numbers of a blade by its patch and place in the drawing order: level, head, then points.
type Solved = BTreeMap<(u32, u32), Vec<f32>>;

fn numbers(blade: &Blade, level: usize, points: impl Iterator<Item = [f32; 3]>) -> Vec<f32> {
    let head = [blade.height, blade.yaw, blade.width, blade.tint, blade.twist, blade.slope[0], blade.slope[1]];
    [level as f32].into_iter().chain(blade.root).chain(head).chain(points.flatten()).collect()
}

/// The first stand's blades as the CPU solves them.
fn on_cpu(world: &World, behind: f64) -> (Solved, BladePlan) {
    let view = world.camera_before(behind);
    let (frame, origin) = Frame::of(world, &view, behind);
    let seen = Seen { view: &view, origin, fullness: 1.0, near: 1.0, behind };
    let looks = subject::looks(world);
    let projection = frame.view(&view).projection([64, 36]);
    let plan = blade_plan::plan(world, &seen, &looks, &projection, false).swap_remove(0).expect("a stand of blades");
    let (stand, wind) = (&world.model.stands[0], world.wind_before(&world.model.stands[0], behind));
    let uniform = PrepareUniform::new(world, stand, false, &seen, &looks[0]);
    let (cells, terrain, intervals) = (&world.state.stands[0].cells, &world.model.terrain, stand.cells / NODE_CELLS);
    let blades = Blades { preparing: Preparing { uniform, cells, terrain, stand, wind: &wind, intervals }, uniform: plan.uniform };
    let mut solved = Solved::new();
    for (number, draw) in plan.draws.iter().enumerate() {
        blades.of_patch(number as u32, draw, |blade, level, points| {
            solved.insert((blade.draw, blade.rank), numbers(blade, level, points.iter().map(Vec3::to_array)));
        });
    }
    (solved, plan)
}

/// The same as the GPU solves them.
fn on_gpu(gpu: &Gpu, world: &World, behind: f64) -> Result<Solved, Failed> {
    let mut studio = Studio::new(gpu, world)?;
    studio.draw_before(gpu, world, CellsAt::Cpu, behind, [64, 36])?;
    let buffers = studio.blades(0).ok_or("no stand")?;
    let (Some([records, found, _]), Some(plan)) = (&buffers.filled, &buffers.numbers) else { return Err("nothing was solved".into()) };
    let found: Vec<u32> = readback::read(gpu, found, 16)?;
    let records: Vec<[f32; 4]> = readback::read(gpu, records, u64::from(plan.records()) * 16)?;
    let mut solved = Solved::new();
    ensure(found[3] == 0, || format!("no room for {} of {found:?} in {:?}", found[3], plan.rooms))?;
    for level in 0..3 {
        for slot in 0..found[level] {
            let first = (plan.firsts[level] + slot * plan.stride(level)) as usize;
            let words: Vec<f32> = records[first..first + HEAD as usize].concat();
            let blade: Blade = bytemuck::pod_read_unaligned(bytemuck::cast_slice(&words));
            let points = &records[first + HEAD as usize..][..=plan.pieces[level] as usize];
            solved.insert((blade.draw, blade.rank), numbers(&blade, level, points.iter().map(|point| [point[0], point[1], point[2]])));
        }
    }
    Ok(solved)
}

/// Blades both have, number by number; few are found by one only, whose eye or limit is rounded otherwise.
fn compare(own: &Solved, theirs: &Solved) -> Verdict {
    let both: Vec<_> = own.iter().filter_map(|(place, a)| Some((a, theirs.get(place)?))).filter(|(a, b)| a.len() == b.len()).collect();
    let apart = own.len() + theirs.len() - 2 * both.len();
    ensure(both.len() > 3_000 && apart * 500 < both.len(), || format!("{apart} of {} are found by one only", both.len()))?;
    let own: Vec<f32> = both.iter().flat_map(|(a, _)| (*a).clone()).collect();
    let theirs: Vec<f32> = both.iter().flat_map(|(_, b)| (*b).clone()).collect();
    let tolerance = Tolerance { p999: 5e-5, rms: 1e-3, outlier: 2e-3, share: 2e-4 };
    judge("blades", &own, &theirs, &tolerance)
}

/// Hills, gusts, a truck, a road; whole steps and moments between them; few blades and many.
pub(crate) fn solved(gpu: &Gpu) -> Verdict {
    for (seconds, budget) in [(40, 20_000), (70, 9_000)] {
        let text = format!(
            "(version: 1, field: (patch_side: 16), stands: [(species: Meadow, cells: 64, representation: Blade(blades: 6, piece_distances: (4, 9)))],
            terrain: Image(path: \"assets/jacksboro.png\", scale: 0.05), wind: [Natural(velocity: (4, 2))],
            exclusions: [(area: Road(points: [(-30, 6), (2, 3), (9, 40)], width: 3), soft: 1.5)],
            interactors: [(shape: Truck, path: Circle(radius: 5, speed: 6))], camera: (eye: (0, 2, -5), target: (0, 0, 6)),
            budget: (patches: 25, focus_distance: 20, lag_distance: 9, visible_blades: {budget}))"
        );
        let root = std::path::PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
        let mut world = World::new(Scene::parse(&text, "blades.ron")?, &sward::model::Folder(root))?;
        (0..seconds).for_each(|_| world.step());
        for behind in [0.0, 0.4] {
            let (own, plan) = on_cpu(&world, behind);
            println!("{} blades, distances count {:.2} times", own.len(), plan.uniform.thinning[3]);
            let theirs = on_gpu(gpu, &world, behind)?;
            compare(&own, &theirs)?;
            let levels = (0..3).filter(|level| own.values().filter(|numbers| numbers[0] == *level as f32).count() > 300).count();
            ensure(levels == 3, || "some numbers of pieces are missing".to_owned())?;
            let other = on_cpu(&world, 0.4 - behind).0;
            ensure(compare(&other, &theirs).is_err(), || "another moment looks the same".to_owned())?;
        }
        let mut other = world.clone();
        let overrides = BladeOverrides { curl: Some(1.01), ..Default::default() };
        other.model.stands[0].species.blade = other.model.stands[0].species.blade.as_ref().map(|blade| blade.with(&overrides));
        let theirs = on_gpu(gpu, &world, 0.0)?;
        ensure(compare(&on_cpu(&other, 0.0).0, &theirs).is_err(), || "one percent more curl looks the same".to_owned())?;
    }
    Ok(())
}

/// More blades than there is room for: those beyond are left out and counted, and the others are what they were.
pub(crate) fn room_ends(gpu: &Gpu) -> Verdict {
    let text = "(version: 1, stands: [(species: Meadow, cells: 64, representation: Blade(blades: 2))], camera: (eye: (0, 2, -5), target: (0, 0, 6)))";
    let world = World::new(Scene::parse(text, "room.ron")?, &sward::model::NoAssets)?;
    let view = world.camera();
    let (frame, origin) = Frame::of(&world, &view, 0.0);
    let seen = Seen { view: &view, origin, fullness: 1.0, near: 1.0, behind: 0.0 };
    let looks = subject::looks(&world);
    let mut plan =
        blade_plan::plan(&world, &seen, &looks, &frame.view(&view).projection([64, 36]), false).swap_remove(0).ok_or("blades")?;
    let solve = |plan: &BladePlan| -> Result<Vec<u32>, Failed> {
        let (stand, pass) = (&world.model.stands[0], SolvePass::new(gpu));
        let prepare = PreparePass::new(gpu, &world);
        let uniform = PrepareUniform::new(&world, stand, false, &seen, &looks[0]);
        let (cells, wind) = (CellBuffers::new(gpu, stand, Precision::Full), world.wind(stand));
        let growth = GrowthMaps::new(gpu, stand);
        let of = Solving { prepare: uniform, wind: &wind, air: &prepare.shared.air, cells: &cells, growth: &growth.view };
        let mut buffers = BladeBuffers::default();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        pass.record(gpu, &mut encoder, &prepare.shared, &of, plan, &mut buffers, None);
        gpu.queue.submit([encoder.finish()]);
        let Some([_, found, arguments]) = &buffers.filled else { return Err("nothing was solved".into()) };
        let (found, arguments): (Vec<u32>, Vec<u32>) = (readback::read(gpu, found, 16)?, readback::read(gpu, arguments, 60)?);
        for level in 0..3 {
            ensure(arguments[5 * level + 1] == found[level].div_ceil(64), || format!("{arguments:?} of {found:?}"))?;
        }
        Ok(found)
    };
    let all = solve(&plan)?;
    ensure(all[3] == 0 && all[..3].iter().all(|found| *found > 100), || format!("control: {all:?} in {:?}", plan.uniform.rooms))?;
    plan.uniform.rooms[1] = 64;
    let few = solve(&plan)?;
    ensure(few == [all[0], 64, all[2], all[1] - 64], || format!("{few:?} of {all:?}"))
}
