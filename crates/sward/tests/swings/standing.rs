//! A body that stands still: no plant stirs, none changes between held and free.

use super::field::{field, length, touched};

/// Plants that change between held and free from step to step in 10 s, and the farthest that a plant goes in a step, rad, after `settle` steps.
fn watch(rest: &str, settle: u32, steps: u32) -> (u32, f32, usize) {
    let mut world = field("response: Oscillator()", rest);
    (0..settle).for_each(|_| world.step());
    let (mut switches, mut farthest): (u32, f32) = (0, 0.0);
    let held = |world: &sward::world::World| -> Vec<_> {
        touched(world).into_iter().map(|(key, found)| (key, found.is_held(world), found.at(world, 0.0))).collect()
    };
    let mut before = held(&world);
    let count = before.iter().filter(|(_, held, _)| *held).count();
    for _ in 0..steps {
        world.step();
        let now = held(&world);
        assert_eq!(now.len(), before.len());
        for ((_, was, a), (_, is, b)) in before.iter().zip(&now) {
            switches += u32::from(was != is);
            farthest = farthest.max(length([a[0] - b[0], a[1] - b[1]]));
        }
        before = now;
    }
    (switches, farthest, count)
}

#[test]
fn under_a_body_that_stands_nothing_stirs() {
    let bodies = "interactors: [(shape: Sphere(radius: 1), path: Still(at: (3, 3))), (shape: Ellipsoid(radii: (0.4, 0.3, 0.9)), clearance: 0.1, \
                  path: Still(at: (-3, 4), yaw: 0.5)), (shape: Truck, path: Still(at: (-4, -4)))]";
    let (switches, farthest, held) = watch(bodies, 60, 600);
    println!("standing 10 s: {held} plants held, {switches} switches, {farthest:.1e} rad a step at most");
    assert!(held > 100, "{held}");
    assert_eq!(switches, 0);
    assert!(farthest < 1e-6, "{farthest}");
    // A body that creeps does switch and stir.
    let creeping = "interactors: [(shape: Sphere(radius: 1), path: Circle(radius: 3, speed: 0.3))]";
    let (switches, farthest, _) = watch_moving(creeping);
    assert!(switches > 10 && farthest > 1e-3, "{switches} {farthest}");
}

/// As [`watch`], of plants that are touched throughout.
fn watch_moving(rest: &str) -> (u32, f32, usize) {
    let mut world = field("response: Oscillator()", rest);
    (0..60).for_each(|_| world.step());
    let (mut switches, mut farthest): (u32, f32) = (0, 0.0);
    for _ in 0..120 {
        let before: Vec<_> = touched(&world).into_iter().map(|(key, found)| (key, found.is_held(&world), found)).collect();
        let then: Vec<_> = before.iter().map(|(_, _, found)| found.at(&world, 0.0)).collect();
        world.step();
        let now = touched(&world);
        for ((key, was_held, _), a) in before.iter().zip(then) {
            let Some((_, is)) = now.iter().find(|(other, _)| other == key) else { continue };
            let b = is.at(&world, 0.0);
            switches += u32::from(*was_held != is.is_held(&world));
            farthest = farthest.max(length([a[0] - b[0], a[1] - b[1]]));
        }
    }
    (switches, farthest, 0)
}
