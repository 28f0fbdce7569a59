//! Where blades stand: on the ground, as the cells are bent.

use crate::solved::{plan, solve, world};
use sward::picture::blade_plan::BladePlan;
use sward::world::World;

/// Steep, bumpy ground in a gale, under a truck.
fn steep(response: &str) -> World {
    let mut world = world(&format!(
        r#"terrain: Image(path: "assets/jacksboro.png", scale: 0.03125), detail: (amplitude: 0.2, wavelength: 4),
        stands: [(species: Meadow, response: {response}, representation: Blade(blades: 12))], wind: [Natural(velocity: (7, 2))],
        interactors: [(shape: Truck, path: Circle(radius: 6, speed: 8))], camera: (eye: (0, 1.5, -8), target: (0, 0, 4)),
        budget: (patches: 25, focus_distance: 20)"#
    ));
    (0..90).for_each(|_| world.step());
    world
}

/// Cells that bend, and blades that bodies touch one by one.
const RESPONSES: [&str; 2] = ["Continuum()", "VirtualInertia()"];

fn lowest(world: &World, plan: &BladePlan, lift: f64) -> (f64, usize) {
    let view = world.camera();
    let (frame, _) = sward::picture::subject::Frame::of(world, &view, 0.0);
    let (mut least, mut points) = (f64::INFINITY, 0);
    for (_, _, strip) in solve(world, plan) {
        for point in &strip[1..] {
            let [x, z] = [f64::from(point.x) + frame.corner[0], f64::from(point.z) + frame.corner[1]];
            least = least.min(f64::from(point.y) - world.model.terrain.height_at(x, z) - lift);
            points += 1;
        }
    }
    (least, points)
}

/// On steep, bumpy ground, in a gale, under a truck. Control: ground a millimetre and a half higher.
#[test]
fn no_blade_is_below_the_ground() {
    for response in RESPONSES {
        let world = steep(response);
        let plan = plan(&world);
        let (least, points) = lowest(&world, &plan, 0.0);
        println!("{response}: {points} points, the lowest {:.2} mm above the ground", 1e3 * least);
        assert!(points > 100_000 && least > 0.0005, "{response}: {least} of {points}");
        assert!(lowest(&world, &plan, 0.0015).0 < 0.0, "control: some lie on the ground");
    }
}

/// Drawn lengths on that ground: pieces turn up where they would dip into it.
#[test]
fn lengths_are_kept_on_rough_ground() {
    for response in RESPONSES {
        let world = steep(response);
        let mut off: Vec<f32> = Vec::new();
        for (blade, _, strip) in solve(&world, &plan(&world)) {
            let length: f32 = strip.windows(2).map(|two| two[0].distance(two[1])).sum();
            off.push((length / blade.height - 1.0).abs());
        }
        off.sort_by(f32::total_cmp);
        let at = |share: f64| off[((off.len() - 1) as f64 * share) as usize];
        println!(
            "{response}: {} blades off their length by {:.1e} (median), {:.1e} (p99.9), {:.1e} at most",
            off.len(),
            at(0.5),
            at(0.999),
            at(1.0)
        );
        assert!(at(1.0) <= 5e-3, "{response}: {:.1e}", at(1.0));
    }
}

/// A blade without a lean of its own is bent as its cell: in a steady wind, as β_eq says.
#[test]
fn blades_follow_the_cells() {
    let scene = |wind: f64| {
        format!(
            "stands: [(species: Meadow, representation: Blade(blades: 2, lean: 0, curl: 0))], wind: [Uniform(velocity: ({wind}, 0))],
             camera: (eye: (0, 1.5, -6), target: (0, 0, 4))"
        )
    };
    let world = world(&scene(5.0));
    let rest = sward::wind::equilibrium([5.0, 0.0], world.model.stands[0].species.continuum.wind);
    let mut seen = 0;
    for (blade, _, strip) in solve(&world, &plan(&world)) {
        let way = (strip[strip.len() - 1] - strip[0]) / blade.height;
        let tilt = way.x.atan2(way.y);
        assert!((tilt - rest[0]).abs() < 1e-3 && way.z.abs() < 1e-3, "{tilt} instead of {}", rest[0]);
        seen += 1;
    }
    assert!(seen > 5_000 && rest[0] > 0.1, "{seen} blades, {} rad", rest[0]);
}

/// Which blades stand where does not depend on threads, steps or the state.
#[test]
fn the_same_blades_every_time() {
    let roots =
        |world: &World| -> Vec<[u32; 3]> { solve(world, &plan(world)).iter().map(|(blade, ..)| blade.root.map(f32::to_bits)).collect() };
    let mut world = steep(RESPONSES[0]);
    let first = roots(&world);
    (0..30).for_each(|_| world.step());
    assert!(first == roots(&world) && first.len() > 10_000);
    world.model.stands[0].placement.seed ^= 1;
    assert!(first != roots(&world), "control: another seed");
}
