//! What a world answers about single plants, winds and bodies, against what is known of the scene.

use sward::model::NoAssets;
use sward::picture::standing::standing;
use sward::scene::Scene;
use sward::world::World;

fn world(text: &str) -> World {
    World::new(Scene::parse(text, "asked.ron").expect("valid"), &NoAssets).expect("compiles")
}

fn after(text: &str, steps: u32) -> World {
    let mut world = world(text);
    (0..steps).for_each(|_| world.step());
    world
}

const PLACE: [[f64; 2]; 2] = [[-0.8, 3.2], [0.8, 4.8]];

/// In any response and form plants keep their lengths and lean with the wind; roots stay inside the place that was asked for.
#[test]
fn plants_stand_as_they_grew() {
    for (response, form) in [
        ("Continuum()", "Billboard()"),
        ("Oscillator()", "Billboard()"),
        ("Springs()", "Sheet()"),
        ("Chain()", "Blade()"),
        ("VirtualInertia()", "Blade()"),
    ] {
        let text = format!(
            "(version: 1, stands: [(species: Meadow, cells: 32, response: {response}, representation: {form})], wind: [Uniform(velocity: (7, 0))], field: (patch_side: 8, patches: (3, 3)))"
        );
        let plants = standing(&after(&text, 90), 0, PLACE, 400);
        assert!(plants.len() > 10, "{response} {form}: {}", plants.len());
        let mean = plants.iter().map(|plant| plant.lean()[0]).sum::<f64>() / plants.len() as f64;
        assert!(mean > 0.05, "{response} {form} leans {mean}");
        for plant in &plants {
            let [x, _, z] = plant.points[0];
            assert!((PLACE[0][0]..=PLACE[1][0]).contains(&x) && (PLACE[0][1]..=PLACE[1][1]).contains(&z), "{x} {z}");
            let stretch = plant.stretch();
            assert!((0.97..1.001).contains(&stretch), "{response} {form}: {stretch}");
        }
        let calm = standing(&after(&text.replace("(7, 0)", "(0, 0)"), 90), 0, PLACE, 400);
        let still = calm.iter().map(|plant| plant.lean()[0]).sum::<f64>() / calm.len() as f64;
        assert!(still.abs() < 0.5 * mean, "control: {response} {form} leans {still} without wind");
    }
}

/// A plant in a body is as deep in it as its deepest point; one that was pushed out is not.
#[test]
fn depth_is_measured_in_the_true_shape() {
    let text =
        "(version: 1, stands: [(species: Meadow)], interactors: [(shape: Sphere(radius: 1), clearance: 0.5, path: Still(at: (0, 4)))])";
    let world = world(text);
    let bodies = world.solids_now();
    assert_eq!(bodies.len(), 1);
    // Its middle is 1.5 m up; a little off it, the nearest way out is sideways as much as down.
    for (point, depth) in
        [([0.0, 1.4, 4.0], 0.9), ([0.0, 0.7, 4.0], 0.2), ([0.0, 0.4, 4.0], 0.0), ([0.6, 1.5, 4.0], 0.4), ([3.0, 1.5, 4.0], 0.0)]
    {
        let found = bodies[0].depth(point);
        assert!((found - depth).abs() < 0.02, "{point:?}: {found} instead of {depth}");
    }
}

/// The wind that is asked for is the wind that blows; its sources add up.
#[test]
fn the_wind_of_a_place_is_the_sum_of_its_sources() {
    let uniform = world("(version: 1, stands: [(species: Meadow)], wind: [Uniform(velocity: (3, -2)), Uniform(velocity: (1, 0))])");
    assert_eq!(uniform.wind_at([5.0, 7.0]), [4.0, -2.0]);
    let downwash = world("(version: 1, wind: [Footprint(flow: Outward, radius: 10, speed: 8)])");
    let [x, z] = downwash.wind_at([5.0, 0.0]);
    assert!((x - 4.0).abs() < 0.15 && z.abs() < 0.1, "half way out half of it blows: {x} {z}");
    assert_eq!(downwash.wind_at([15.0, 0.0]), [0.0, 0.0], "control");
    assert_eq!(downwash.winds_at(&[[5.0, 0.0], [15.0, 0.0]]), [downwash.wind_at([5.0, 0.0]), [0.0, 0.0]]);
}

/// What a body swept lies around its way; one that is away sweeps nothing.
#[test]
fn what_was_swept_lies_around_the_way() {
    let text = "(version: 1, stands: [(species: Meadow)], interactors: [(shape: Sphere(radius: 0.5), path: Circle(radius: 6, speed: 6)), (shape: Sphere(radius: 0.5), from: 99)])";
    let world = after(text, 10);
    let swept = world.swept_now();
    assert_eq!(swept.iter().map(|(body, _)| *body).collect::<Vec<_>>(), [0]);
    let pose = world.pose_before(0, 0.0).expect("there");
    for [x, z] in &swept[0].1 {
        let away = (x - pose.ground[0]).hypot(z - pose.ground[1]);
        assert!((0.3..0.75).contains(&away), "{away} m from the middle");
    }
}
