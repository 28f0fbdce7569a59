//! Bodies made by others: walking figures, and a body with holes.

use glam::{DVec3, Vec3};
use sward::interaction::FigureBody;
use sward::interaction::distance_map::{DistanceMapHead, contact_at};
use sward::model::Folder;
use sward::response::springs::{Maps, moments};
use sward::scene::Scene;
use sward::world::World;

use crate::field::{Plant, STEP, Seen, coefficients, head, look, root};
use crate::maps::random;
use crate::{Test, shared};

pub(crate) const TESTS: &[Test] = &[
    ("walking_figures_push_sheets_out", walking_figures_push_sheets_out),
    ("a_body_with_holes_has_them", a_body_with_holes_has_them),
    ("a_figure_is_the_body_of_its_triangles", a_figure_is_the_body_of_its_triangles),
];

fn figure(file: &str, scale: f64, clip: &str) -> FigureBody {
    let clip = if clip.is_empty() { String::new() } else { format!(", clip: \"{clip}\"") };
    let text =
        format!("(version: 1, stands: [(species: Meadow)], interactors: [(shape: Mesh(file: \"{file}.glb\", scale: {scale}{clip}))])");
    let scene = Scene::parse(&text, "test.ron").unwrap_or_else(|error| panic!("{error}"));
    let world = World::new(scene, &Folder(shared().expect("ignored without it"))).unwrap_or_else(|error| panic!("{error}"));
    world.model.bodies[0].figure.clone().expect("a figure")
}

fn walking_figures_push_sheets_out() {
    for (file, scale, clip, speed, texels) in [
        ("fox", 0.007, "Walk", 0.9, 64),
        ("knight", 0.7, "Walking_A", 1.2, 64),
        ("knight", 0.7, "Walking_A", 1.2, 128),
        ("knight", 0.7, "Running_A", 3.0, 64),
    ] {
        let (co, body) = (coefficients(3, 3), figure(file, scale, clip));
        let cube = body.cube(texels);
        let mut seen = Seen { lowest: 1.0, ..Seen::default() };
        let mut plants: Vec<(Plant, u32)> = (0..14)
            .flat_map(|i| (0..3).map(move |k| root(0.09 * (i as f32 - 6.5), 0.2 * k as f32, (i * 3 + k) as f32 * 0.7, 0.4)))
            .map(|root| (Plant::new(&co, root), 0))
            .collect();
        let mut most = 0;
        for frame in 0..(4.5 / speed / STEP) as u32 {
            let time = |frame: f32| frame * STEP;
            let stride = body.stride(f64::from(time(frame as f32 - 1.0)), f64::from(time(frame as f32)));
            let count = moments(speed * STEP + stride, 0.4);
            most = most.max(count);
            let (mut heads, mut texels_of_all) = (Vec::new(), Vec::new());
            for moment in 0..count {
                let now = time(frame as f32 - 1.0 + (moment + 1) as f32 / count as f32);
                let map = body.distance_map(cube, texels, f64::from(now));
                let first = texels_of_all.len() as u32;
                heads.push(DistanceMapHead { first, ..head(&map, moment, Vec3::Z * (speed * now - 2.0), 0.0) });
                texels_of_all.extend(map.texels);
            }
            let maps = Maps { heads: &heads, texels: &texels_of_all };
            for (plant, deep) in &mut plants {
                let before = plant.shown;
                plant.step(&co, &maps, [0.0, 1.0]);
                let own = |p: Vec3| contact_at(&heads[heads.len() - 1], maps.texels, p.to_array()).distance;
                look(&mut seen, &co, plant, &before, &maps, deep, own);
            }
        }
        seen.print(&format!(
            "{file} {clip} at {speed} m/s, up to {most} moments, {texels} texels of {:.0} mm",
            2e3 * cube.half / texels as f32
        ));
        assert!(seen.touched > 100, "it must touch: {seen:?}");
        assert!(seen.stretch < 1e-3 && seen.lowest > 0.9e-3, "{seen:?}");
        // A limb that is met at several moments of a step carries plants along.
        assert!(seen.jump < 0.35, "{seen:?}");
        assert!(seen.over[0] * 2000 < seen.frames && seen.in_a_row <= 1 && seen.deepest < 0.012, "{seen:?}");
    }
}

/// How many triangles a ray crosses.
fn crossings(points: &[[f32; 3]], triangles: &[[u32; 3]], from: Vec3, ray: DVec3) -> usize {
    let corner = |index: u32| Vec3::from(points[index as usize]).as_dvec3() - from.as_dvec3();
    let crosses = |triangle: &&[u32; 3]| {
        let [a, b, c] = triangle.map(corner);
        let sides = [ray.dot(a.cross(b)), ray.dot(b.cross(c)), ray.dot(c.cross(a))];
        let all = sides.iter().all(|side| *side > 0.0) || sides.iter().all(|side| *side < 0.0);
        let normal = (b - a).cross(c - a);
        all && normal.dot(a) / normal.dot(ray) > 0.0
    };
    triangles.iter().filter(crosses).count()
}

/// Whether a point lies inside closed triangles: a ray crosses them an odd number of times.
fn is_inside(points: &[[f32; 3]], triangles: &[[u32; 3]], p: Vec3) -> bool {
    crossings(points, triangles, p, DVec3::new(0.412_345, 0.783_211, 0.465_432)) % 2 == 1
}

/// Share of random points in its cube that a body's map and rays judge alike, and of those that differ the shares that the map takes for
/// inside, and that lie farther than two texels from where the ray test changes its mind.
fn agreement(body: &FigureBody, elapsed: f64, texels: u32, shift: f32) -> [f64; 2] {
    let points = body.points(elapsed);
    let map = body.distance_map(body.cube(texels), texels, elapsed);
    let place = DistanceMapHead::new(&map, 0, (0, 0), [shift, 0.0, 0.0], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    let (mut alike, mut hollow, mut count) = (0u32, 0u32, 0u32);
    for p in random(20_000, map.cube.half, Vec3::from(map.cube.centre)) {
        let truth = is_inside(&points, &body.figure.triangles, p);
        let seen = contact_at(&place, &map.texels, p.to_array()).distance < 0.0;
        alike += u32::from(truth == seen);
        hollow += u32::from(seen && !truth);
        count += 1;
    }
    [f64::from(alike) / f64::from(count), f64::from(hollow) / f64::from(count)]
}

fn a_body_with_holes_has_them() {
    let body = figure("torus_pair", 1.0, "");
    let points = body.points(0.0);
    for texels in [32, 64, 128] {
        let [alike, hollow] = agreement(&body, 0.0, texels, 0.0);
        println!(
            "two tori, {texels} texels: {:.2} % of points judged alike, {:.2} % taken for inside though outside",
            alike * 1e2,
            hollow * 1e2
        );
        assert!(alike > 0.9, "{alike}");
    }
    let [shifted, _] = agreement(&body, 0.0, 64, 0.3);
    assert!(shifted < agreement(&body, 0.0, 64, 0.0)[0] - 0.02, "a map beside its body must show: {shifted}");
    // Holes: places that one can look through along an axis, and beside them by a texel and a half too.
    let map = body.distance_map(body.cube(64), 64, 0.0);
    let (place, beside) = (head(&map, 0, Vec3::ZERO, 0.0), 3.0 * map.cube.half / 64.0);
    let clear =
        |p: Vec3, axis: Vec3| [1.0, -1.0].iter().all(|sign| crossings(&points, &body.figure.triangles, p, (axis * *sign).as_dvec3()) == 0);
    let (mut holes, mut open) = (0, 0);
    for p in random(3000, 0.5 * map.cube.half, Vec3::from(map.cube.centre)) {
        let free = |k: usize| {
            let (axis, u, v) = (Vec3::AXES[k], Vec3::AXES[(k + 1) % 3] * beside, Vec3::AXES[(k + 2) % 3] * beside);
            [Vec3::ZERO, u, -u, v, -v].iter().all(|off| clear(p + *off, axis))
        };
        if (0..3).any(free) {
            holes += 1;
            open += u32::from(contact_at(&place, &map.texels, p.to_array()).distance >= 0.0);
        }
    }
    println!("{holes} places in holes that one can look through, {open} of them outside");
    assert!(holes > 50 && open == holes);
}

fn a_figure_is_the_body_of_its_triangles() {
    // The knight's trunk and head are open, so no ray can tell.
    let body = figure("fox", 0.007, "Walk");
    for texels in [64, 128] {
        let [alike, hollow] = agreement(&body, 0.3, texels, 0.0);
        println!(
            "fox, {texels} texels: {:.2} % of points judged alike, {:.2} % taken for inside though outside",
            alike * 1e2,
            hollow * 1e2
        );
        assert!(alike > 0.99, "{alike}");
    }
    let other = agreement(&body, 0.3, 64, 0.2)[0];
    assert!(other < 0.99, "a map beside its body must show: {other}");
}
