//! Bodies that jump, vanish, fly, come in crowds or stand outside the field.

use crate::common::world;

#[test]
fn a_body_that_jumps_sweeps_nothing_between() {
    let mut world = world(
        "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 16)], 
         interactors: [(shape: Box(size: (1.0, 1.0, 1.0)), path: Driven(at: (4.0, 4.0)))]",
    );
    (0..5).for_each(|_| world.step());
    world.drive(0, [404.0, 4.0], 0.0, 0.0);
    (0..5).for_each(|_| world.step());
    let stand = &world.state.stands[0];
    assert!(stand.awake.contains_key(&[0, 0]) && stand.awake.contains_key(&[50, 0]));
    assert!(stand.awake.keys().all(|patch| patch[0] < 3 || patch[0] > 47), "{:?}", stand.awake.keys());
    // A fast drive is swept: 140 m/s is not a jump.
    world.drive(0, [404.0, 6.3], 0.0, 0.0);
    world.step();
    let bend = world.bend_at(0, [404.25, 5.25]).expect("a stand");
    assert!(bend[1] > 0.5, "control: {bend:?}");
}

#[test]
fn a_body_that_vanishes_leaves_nothing_behind() {
    let mut world = world(
        "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 16)],
         interactors: [(shape: Truck, path: Still(at: (4.0, 4.0)), from: 0.5, until: 1.0)]",
    );
    (0..29).for_each(|_| world.step());
    assert_eq!(world.state.stands[0].counters.woken, 0, "not there yet");
    (0..20).for_each(|_| world.step());
    assert!(world.bend_at(0, [4.25, 4.25]).expect("a stand")[0].abs() + world.bend_at(0, [4.25, 4.25]).expect("a stand")[1].abs() > 0.3);
    (0..600).for_each(|_| world.step());
    let stand = &world.state.stands[0];
    assert!(stand.awake.is_empty() && world.state.bodies[0].pose.is_none());
    assert_eq!(world.bend_at(0, [4.25, 4.25]), Some([0.0, 0.0]));
}

#[test]
fn a_body_that_flies_or_stands_outside_the_field_touches_nothing() {
    let wakes = |body: &str| {
        let mut world =
            world(&format!("field: (patch_side: 8.0, patches: (4, 4)), stands: [(species: Meadow, cells: 16)], interactors: [{body}]"));
        (0..20).for_each(|_| world.step());
        world.state.stands[0].counters.woken
    };
    assert_eq!(wakes("(shape: Truck, clearance: 30.0)"), 0);
    assert_eq!(wakes("(shape: Truck, path: Still(at: (1000000.0, -1000000.0)))"), 0);
    assert_eq!(wakes("(shape: Sphere(radius: 2), path: Circle(centre: (90.0, 0.0), radius: 10.0, speed: 100.0))"), 0);
    assert!(wakes("(shape: Truck)") > 0, "control");
}

#[test]
fn a_crowd_of_256_bodies_is_stepped() {
    let body = |k: i32| {
        let (x, z) = (k % 16 * 3, k / 16 * 3);
        format!("(shape: Sphere(radius: 0.5), path: Circle(centre: ({x}, {z}), radius: 2.0, speed: {}))", k % 7 - 3)
    };
    let bodies: Vec<String> = (0..256).map(body).collect();
    let text = format!("field: (patch_side: 8.0), stands: [(species: Meadow, cells: 16)], interactors: [{}]", bodies.join(", "));
    let mut world = world(&text);
    for step in 0..30 {
        if step == 29 {
            let plan = world.plan();
            assert_eq!(plan.stands[0].contacts.len(), 256);
            assert!(plan.stands[0].pairs.len() >= 256);
            break;
        }
        world.step();
    }
    assert!(world.state.stands[0].awake.len() > 36);
    // Every body left a mark where it started.
    let marked = (0..256).filter(|k| {
        let bend = world.bend_at(0, [f64::from(k % 16 * 3) + 2.0, f64::from(k / 16 * 3)]).expect("a stand");
        bend[0].abs() + bend[1].abs() > 0.05
    });
    assert!(marked.count() > 200);
}
