//! Plants of a stand of meshes: what touches them, and how they are cut as the camera goes round them.

use sward::geometry::layers::{Extent, depths, layer_of};
use sward::model::NoAssets;
use sward::plan::Brush;
use sward::response::harmonic::{HarmonicCoefficients, TOUCH_SIDE, step_touched};
use sward::scene::Scene;
use sward::specimen::Kind;
use sward::state::{LayeredPlant, Waves};
use sward::world::World;

fn world(text: &str) -> World {
    World::new(Scene::parse(text, "plants.ron").expect("valid"), &NoAssets).expect("it compiles")
}

const SHRUB: &str =
    "stands: [(species: Shrub, places: [(at: (0.0, 0.0), height: 1.4)], representation: Layers(mesh: Grown(triangles: 4000)))]";

fn moving(world: &World) -> f32 {
    let state = &world.state.layered[0];
    let touched = state.pool.taken().filter_map(|(_, place)| state.touches.get(place as usize));
    touched.flat_map(|waves| waves.now.iter().flatten()).fold(0.0, |most, part| most.max(part.abs()))
}

#[test]
fn a_body_in_front_of_a_plant_disturbs_it_and_it_comes_to_rest() {
    let passing = |z: f64| {
        format!(
            "(version: 1, {SHRUB}, interactors: [(shape: Sphere(radius: 0.4), path: Keyframes(keys: [(time: 0.0, at: (-4.0, {z})), (time: 2.0, at: (4.0, {z}))]))])"
        )
    };
    let run = |z: f64| {
        let mut world = world(&passing(z));
        let mut most = 0.0_f32;
        for _ in 0..150 {
            world.step();
            most = most.max(moving(&world));
        }
        (world, most)
    };
    let (mut near, most) = run(-0.7);
    println!("V up to {most:.2} m/s");
    assert!(most > 1.0 && most < 8.0, "{most}");
    for _ in 0..near.model.layered[0].harmonic.settle {
        near.step();
    }
    assert!(near.state.layered[0].pool.is_empty(), "it still has a plane of its own");
    // Control: one that passes well before it.
    let (far, most) = run(-3.0);
    assert!(most == 0.0 && far.state.layered[0].pool.is_empty());
    // What it does to others: nothing.
    assert_eq!(near.state.layered[0].waves.now, far.state.layered[0].waves.now.iter().map(|_| [0.0; 2]).collect::<Vec<_>>());
}

#[test]
fn a_downwash_moves_only_the_plants_below_it() {
    let text = "(version: 1, stands: [(species: Shrub, places: [(at: (0.0, 2.0)), (at: (40.0, 2.0))],
        representation: Layers(mesh: Grown(triangles: 4000)))],
        wind: [Footprint(flow: Outward, radius: 6.0, speed: 20.0, path: Still(at: (-1.0, 0.0)))])";
    let mut world = world(text);
    (0..60).for_each(|_| world.step());
    let taken: Vec<_> = world.state.layered[0].pool.taken().map(|((_, number), _)| number).collect();
    assert!(taken == [0] && moving(&world) > 0.3, "{taken:?} {}", moving(&world));
}

/// Going round a plant cuts it every five degrees; turning the camera cuts nothing.
#[test]
fn plants_are_cut_as_the_view_of_them_turns() {
    let camera = |keys: &str| format!("(version: 1, {SHRUB}, camera: (keys: [{keys}]))");
    let round: Vec<String> = (0..=36)
        .map(|k| {
            let (sine, cosine) = (f64::from(k) * 10.0_f64.to_radians()).sin_cos();
            format!("(time: {}, eye: ({}, 1.0, {}), target: (0.0, 0.7, 0.0))", f64::from(k) / 1.2, 9.0 * sine, 9.0 * cosine)
        })
        .collect();
    let mut orbit = world(&camera(&round.join(",")));
    let mut fades = 0;
    for _ in 0..1800 {
        orbit.step();
        let cuts = orbit.state.layered[0].cuts.values().next().expect("in sight");
        fades += u32::from(cuts.before.is_some_and(|before| before.step < cuts.now.step));
    }
    // Nine metres off, nearly eight from its nearest leaf: some eighty turns of five degrees of what is nearest.
    let cut = orbit.state.layered[0].cut;
    assert!((60..110).contains(&cut), "{cut}");
    assert!(fades > 400, "one fades into the other: {fades}");
    (0..60).for_each(|_| orbit.step());
    assert!(orbit.state.layered[0].cuts.values().all(|cuts| cuts.before.is_none()), "and has, when the camera rests");
    let turn = "(time: 0.0, eye: (0.0, 1.0, -6.0), target: (-2.0, 0.7, 0.0)), (time: 2.0, eye: (0.0, 1.0, -6.0), target: (2.0, 0.7, 0.0))";
    let mut turning = world(&camera(turn));
    (0..120).for_each(|_| turning.step());
    assert_eq!(turning.state.layered[0].cut, 1);
}

/// No leaf is in two layers: all corners of a leaf go by its root. Cutting at planes would cut many.
#[test]
fn no_leaf_is_cut() {
    let world = world(&format!("(version: 1, {SHRUB})"));
    let stand = &world.model.layered[0];
    let (key, cuts) = world.state.layered[0].cuts.iter().next().expect("in sight");
    let plant: &LayeredPlant = world.state.layered[0].plant(*key).expect("near");
    let extent = Extent::new(plant, stand.specimen.low, stand.specimen.high);
    let edges = depths(&cuts.now, &extent, stand.layers().bands);
    assert_eq!(edges.len(), 6, "3-1-1 layers");
    let scale = plant.height / stand.specimen.high[1];
    let forward = glam::Vec3::from(cuts.now.forward);
    let layer = |point: [f32; 3]| {
        let [x, z] = extent.axes;
        let at = (x * point[0] + glam::Vec3::Y * point[1] + z * point[2]) * scale;
        let place = glam::DVec3::from(plant.root) + at.as_dvec3();
        layer_of(&edges, (place - glam::DVec3::from(cuts.now.eye)).as_vec3().dot(forward))
    };
    let (mut by_root, mut by_corner, mut filled) = (0, 0, [0_u32; 5]);
    for part in stand.specimen.parts.iter().filter(|part| stand.specimen.finishes[part.finish].kind == Kind::Leaf) {
        for triangle in &stand.specimen.triangles[part.triangles.start as usize..part.triangles.end as usize] {
            let corners = triangle.map(|vertex| stand.specimen.vertices[vertex as usize]);
            let roots = corners.map(|corner| layer(corner.root));
            let own = corners.map(|corner| layer(corner.position));
            by_root += u32::from(roots != [roots[0]; 3]);
            by_corner += u32::from(own != [own[0]; 3]);
            filled[roots[0]] += 1;
        }
    }
    println!("triangles a layer: {filled:?}; planes would cut {by_corner}");
    assert_eq!(by_root, 0);
    assert!(by_corner > 100, "control: {by_corner}");
    assert!(filled.iter().all(|count| *count > 20), "{filled:?}");
}

/// Saved, loaded and run on: the same bits; and far away the same as here.
#[test]
fn it_goes_on_as_if_it_had_never_stopped_anywhere() {
    let text = |origin: [i32; 2]| {
        let [x, z] = origin.map(|patch| f64::from(patch) * 32.0);
        format!(
            "(version: 1, origin: ({}, {}), stands: [(species: Shrub, places: [(at: ({x}, {}), height: 1.4)],
            representation: Layers(mesh: Grown(triangles: 4000)))], wind: [Natural(velocity: (4.0, 2.0)), Fluid(side: 16, cells: 32)],
            interactors: [(shape: Sphere(radius: 0.4), path: Circle(centre: ({x}, {}), radius: 1.2, speed: 2.0))],
            camera: (eye: ({x}, 1.5, {}), target: ({x}, 0.7, {})))",
            origin[0],
            origin[1],
            z + 3.0,
            z + 3.0,
            z - 2.0,
            z + 3.0
        )
    };
    let mut world = world(&text([0, 0]));
    (0..50).for_each(|_| world.step());
    let saved = world.save();
    let mut again = self::world(&text([0, 0]));
    again.restore(&saved).expect("its own");
    let mut far = self::world(&text([8000, -8000]));
    (0..50).for_each(|_| far.step());
    (0..40).for_each(|_| (world.step(), again.step(), far.step()).0);
    assert_eq!(world.hash(), again.hash());
    assert_eq!(world.state.layered[0].cuts, again.state.layered[0].cuts);
    assert_eq!(world.hash(), far.hash());
    assert!(world.state.layered[0].waves.now.iter().flatten().any(|part| part.abs() > 0.1));
    // Control.
    world.step();
    assert_ne!(world.hash(), far.hash());
}

/// The most that V comes to in 20 s, over what the body has, if it holds a cell now and then; `step` takes V now and before to V.
fn pumped(held_for: u32, in_all: u32, step: impl Fn([f32; 2], bool) -> f32) -> f32 {
    let (mut now, mut old, mut most) = (0.0, 0.0, 0.0_f32);
    for k in 0..1200 {
        (now, old) = (step([now, old], k % in_all < held_for), now);
        most = most.max(now.abs());
    }
    most
}

#[test]
fn what_holds_leaves_now_and_then_does_not_pump_them_up() {
    let brush = Brush { at: [0.0, 8.0], half: [64.0; 2], velocity: [1.0, 0.0], through: 0.0, hold: Brush::hold(1.0 / 60.0) };
    let co = HarmonicCoefficients::new(0.0, 0.5, 0.15, 0.6, 0.5, 1.0 / 60.0);
    let ours = |[now, old]: [f32; 2], held: bool| {
        let mut waves = Waves::new(TOUCH_SIDE as usize);
        waves.now.fill([now, 0.0]);
        waves.old.fill([old, 0.0]);
        step_touched(&mut waves, &co, [0.0; 2], if held { std::slice::from_ref(&brush) } else { &[] }, (0.0, 1.0 / 60.0), &mut []);
        waves.now[(TOUCH_SIDE * TOUCH_SIDE / 2 + TOUCH_SIDE / 2) as usize][0]
    };
    // Control: V set at once, a share of the way.
    let leaping = |[now, old]: [f32; 2], held: bool| {
        let free = now + (1.0 - co.damping) * (now - old) - co.restoring * now;
        if held { free + brush.hold * (1.0 - free) } else { free }
    };
    let (mut most, mut most_leaping) = (0.0_f32, 0.0_f32);
    for in_all in [2, 3, 7, 15, 30, 60, 120] {
        for held_for in [1, 2, in_all / 2, in_all - 1].into_iter().filter(|held| (1..in_all).contains(held)) {
            most = most.max(pumped(held_for, in_all, ours));
            most_leaping = most_leaping.max(pumped(held_for, in_all, leaping));
        }
    }
    println!("V up to {most:.2} of the body's; set at once up to {most_leaping:.1e}");
    assert!(most < 2.0, "{most}");
    assert!(most_leaping > 10.0, "control: {most_leaping}");
    assert!((pumped(1, 1, ours) - 1.0).abs() < 0.2, "leaves that are held all the time come along");
}

/// The most that a touched plant's V comes to in 3000 steps of 1/`rate` s, under a body that is on it at some moments and off it at others.
fn brushed(co: &HarmonicCoefficients, rate: u32) -> f32 {
    let dt = 1.0 / rate as f32;
    let mut waves = Waves::new(TOUCH_SIDE as usize);
    let mut seed = 1_u32;
    let mut drawn = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / (1 << 24) as f32
    };
    for _ in 0..3000 {
        let at = [16.0 * drawn() - 8.0, 16.0 * drawn()];
        let half = [1.0 + 8.0 * drawn(), 1.0 + 8.0 * drawn()];
        let brush = Brush { at, half, velocity: [2.0 * drawn() - 1.0, 0.3], through: drawn(), hold: Brush::hold(dt) };
        let held = drawn() < 0.6;
        step_touched(&mut waves, co, [0.0; 2], if held { std::slice::from_ref(&brush) } else { &[] }, (0.0, dt), &mut []);
    }
    waves.now.iter().flatten().fold(0.0, |most, part| if part.is_finite() { most.max(part.abs()) } else { f32::INFINITY })
}

#[test]
fn no_touch_makes_any_waves_blow_up() {
    for rate in [20, 30, 60, 1000] {
        for (speed, frequency, ratio) in
            [(50.0, 0.05, 0.0), (50.0, 10.0, 0.0), (50.0, 10.0, 2.0), (50.0, 1.0, 2.0), (46.6, 0.05, 0.0), (0.0, 10.0, 0.3)]
        {
            let dt = 1.0 / rate as f32;
            let free = HarmonicCoefficients::new(speed, frequency, ratio, 1.0, 0.3, dt);
            let most = brushed(&free.under(Brush::hold(dt)), rate);
            println!("{rate} Hz, {speed} m/s, {frequency} Hz, {ratio}: {most:.1}, stiff as free ones {:.1e}", brushed(&free, rate));
            assert!(most < 100.0, "{most}");
        }
    }
    // Control: waves that are as stiff as those that nothing holds.
    let free = HarmonicCoefficients::new(50.0, 0.05, 0.0, 1.0, 0.3, 1.0 / 30.0);
    assert!(brushed(&free, 30) > 1e4, "control");
}
