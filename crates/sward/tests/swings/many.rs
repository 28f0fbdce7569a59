//! A thousand bodies at once, and what must hold whatever they do.

use sward::response::oscillator::limited;

use super::field::{coefficients, field, length, touched};
use crate::common::Dice;

#[test]
fn a_thousand_bodies() {
    let mut dice = Dice(7);
    let mut bodies = String::new();
    for k in 0..1024 {
        let (x, z) = (dice.between(-30.0, 30.0), dice.between(-30.0, 30.0));
        let (radius, speed, circle) = (dice.between(0.1, 0.5), dice.between(-3.0, 3.0), dice.between(0.3, 3.0));
        let (from, until) = (dice.between(0.0, 0.5), dice.between(0.6, 1.4));
        bodies += &format!(
            "(name: \"b{k}\", shape: Ellipsoid(radii: ({radius:.2}, {:.2}, {:.2})), clearance: {:.2}, path: Circle(centre: ({x:.2}, {z:.2}), radius: {circle:.2}, \
             speed: {speed:.2}), from: {from:.3}, until: {until:.3}), ",
            radius * 0.8,
            radius * 1.4,
            dice.between(0.0, 0.2)
        );
    }
    let mut world = field("response: Oscillator()", &format!("interactors: [{bodies}]"));
    let mut most = 0;
    for _ in 0..90 {
        world.step();
        let found = touched(&world);
        most = most.max(found.iter().filter(|(_, found)| found.is_held(&world)).count());
        assert!(found.iter().all(|(_, found)| length(limited(found.at(&world, 0.0))) <= std::f32::consts::FRAC_PI_2 + 1e-5));
    }
    println!("1024 bodies: {most} plants held at once");
    assert!(most > 3000, "{most}");
    // All are gone by now: no plant stays bent.
    for _ in 0..coefficients(&world).settle {
        world.step();
    }
    assert!(touched(&world).iter().all(|(_, found)| length(found.at(&world, 0.0)) < 1e-3));
    for _ in 0..130 {
        world.step();
    }
    assert!(world.state.stands[0].awake.is_empty(), "{}", world.state.stands[0].awake.len());
}

/// Two bodies on one plant: the stronger push holds, the direction is between them.
#[test]
fn between_two_bodies_a_plant_leans_between_them() {
    let two = "interactors: [(name: \"a\", shape: Sphere(radius: 1.2), path: Still(at: (0, 0.4))), (name: \"b\", shape: Sphere(radius: 1.2), path: Still(at: (0, -0.4)))]";
    let mut world = field("response: Oscillator()", two);
    (0..60).for_each(|_| world.step());
    let beside = |world: &sward::world::World| -> Vec<[f32; 2]> {
        let between = |root: [f64; 2]| (0.25..0.5).contains(&root[0]) && root[1].abs() < 0.12;
        touched(world).iter().filter(|(_, found)| between(found.root)).map(|(_, found)| found.record.deviation).collect()
    };
    let both = beside(&world);
    assert!(!both.is_empty());
    assert!(both.iter().all(|[x, z]| *x > 0.1 && z.abs() < 0.6 * x), "{both:?}");
    let mut world = field("response: Oscillator()", "interactors: [(shape: Sphere(radius: 1.2), path: Still(at: (0, 0.4)))]");
    (0..60).for_each(|_| world.step());
    assert!(beside(&world).iter().all(|[x, z]| *z < -0.6 * x), "one alone pushes it away from itself");
}
