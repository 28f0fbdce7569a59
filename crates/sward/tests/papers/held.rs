//! Methods behind Chen & Johan 2010, §5.1: bodies that stand, turn, or share a plant.

use crate::common::world;
use sward::interaction::Hit;
use sward::response::continuum::contact;
use sward::world::World;

fn length(v: [f32; 2]) -> f32 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

/// Cell centres in x and z of a grid of quarter metres inside a square around a place, and their distance to its edge.
fn inside(centre: [f64; 2], half: f64) -> Vec<([f64; 2], f64)> {
    let mut places = Vec::new();
    for j in -40..80 {
        for i in -40..80 {
            let place = [f64::from(i) * 0.25 + 0.125, f64::from(j) * 0.25 + 0.125];
            let depth = half - (place[0] - centre[0]).abs().max((place[1] - centre[1]).abs());
            if depth > 0.0 {
                places.push((place, depth));
            }
        }
    }
    places
}

fn parked(until: f64) -> World {
    world(&format!(
        "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], interactors: [(shape: Box(size: (2.0, 1.0, 2.0)),
         clearance: 0.2, until: {until:.1}, path: Still(at: (4.1, 4.07)))]"
    ))
}

#[test]
fn grass_under_a_parked_body_reaches_its_floor_and_stays() {
    let mut world = parked(1e6);
    let places = inside([4.1, 4.07], 1.0);
    assert!(places.len() > 50);
    let mut before = vec![0.0_f32; places.len()];
    let (mut settled, mut unlike) = (Vec::new(), 0);
    for step in 0..360 {
        world.step();
        for (k, (place, depth)) in places.iter().enumerate() {
            let bend = world.bend_at(0, *place).expect("a stand");
            assert!(length(bend) <= before[k] + 6.0 / 60.0 + 1e-6, "approached at 6 rad/s at most");
            assert!(length(bend) >= before[k], "never stands up");
            before[k] = length(bend);
            if step == 120 {
                let floor = (depth / 0.2).atan();
                assert!((f64::from(length(bend)) - floor).abs() < 3e-3, "{place:?}: {} for {floor}", length(bend));
                unlike += u32::from((f64::from(length(bend)) - (depth / 0.22).atan()).abs() > 3e-3);
                settled.push(bend);
            }
        }
    }
    assert!(unlike as usize > places.len() / 2, "control: a body 2 cm higher has another floor");
    for ((place, _), bend) in places.iter().zip(&settled) {
        assert_eq!(world.bend_at(0, *place), Some(*bend), "not a bit moves in four seconds");
    }
    let mut gone = parked(2.0);
    (0..360).for_each(|_| gone.step());
    let risen = places.iter().filter(|(place, _)| length(gone.bend_at(0, *place).expect("a stand")) < 0.1).count();
    assert!(risen > places.len() / 2, "control: without the body it rises, {risen} of {}", places.len());
}

#[test]
fn grass_does_not_rise_through_a_body_that_drives_in_and_parks() {
    let mut world = world(
        "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], interactors: [(shape: Box(size: (2.0, 1.0, 2.0)),
         clearance: 0.2, path: Keyframes(keys: [(time: 0.0, at: (-6.0, 4.0)), (time: 1.0, at: (4.0, 4.0))]))]",
    );
    (0..64).for_each(|_| world.step());
    let places = inside([4.0, 4.0], 0.99);
    let before: Vec<_> = places.iter().map(|(place, _)| world.bend_at(0, *place).expect("a stand")).collect();
    assert!(before.iter().filter(|bend| length(**bend) > 1.0).count() > places.len() / 2);
    (0..300).for_each(|_| world.step());
    for ((place, _), bend) in places.iter().zip(&before) {
        assert!(length(world.bend_at(0, *place).expect("a stand")) >= length(*bend) - 1e-6, "{place:?}");
    }
}

#[test]
fn a_body_that_turns_on_the_spot_bends_along_its_motion() {
    let mut world = world(
        "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], interactors: [(shape: Box(size: (2.0, 1.0, 3.0)),
         clearance: 0.2, path: Driven(at: (4.0, 4.0)))]",
    );
    for step in 1..=20 {
        assert!(world.drive(0, [4.0, 4.0], f64::from(step) * 0.05, 0.2));
        world.step();
    }
    // Turning +z towards +x moves the front (+z) to +x and the left side (+x) to −z.
    let (mut along, mut count) = (0, 0);
    for (place, _) in inside([4.0, 4.0], 0.9) {
        let arm = [place[0] - 4.0, place[1] - 4.0];
        if arm[0].hypot(arm[1]) < 0.3 {
            continue;
        }
        let bend = world.bend_at(0, place).expect("a stand");
        let speed = f64::from(bend[0]) * arm[1] - f64::from(bend[1]) * arm[0];
        count += 1;
        along += u32::from(speed / (f64::from(length(bend)) * arm[0].hypot(arm[1])) > 0.4 && length(bend) > 0.3);
    }
    assert!(count > 30 && along > count * 9 / 10, "{along} of {count}");
}

#[test]
fn of_several_bodies_the_largest_push_wins_and_ties_go_to_the_lower_id() {
    let co = world("stands: [(species: Meadow)]").model.stands[0].coefficients;
    let hit = |speed: f32, direction: [f32; 2]| Hit { speed, direction, along: speed, height: 0.2, normal: [1.0, 0.0], depth: 0.0 };
    let bend_of = |hits: &[Hit]| contact(&co, [0.0, 0.0], [0.0, 0.0], hits).expect("touched").bend;
    let (east, south) = (hit(2.0, [1.0, 0.0]), hit(2.0, [0.0, 1.0]));
    assert!(bend_of(&[east, south])[0] > 0.1 && bend_of(&[east, south])[1] == 0.0, "a tie goes to the first");
    assert!(bend_of(&[south, east])[1] > 0.1 && bend_of(&[south, east])[0] == 0.0, "swapped, to the other");
    let faster = hit(2.1, [0.0, 1.0]);
    assert_eq!(bend_of(&[east, faster]), bend_of(&[faster, east]), "a larger push wins in any order");
    assert!(bend_of(&[east, faster])[1] > 0.1);
    let standing = hit(0.0, [0.0, 1.0]);
    assert_eq!(bend_of(&[standing, east]), bend_of(&[east]), "a standing body does not win over a moving one");
}

#[test]
fn the_highest_floor_holds_whichever_body_pushes() {
    let co = world("stands: [(species: Meadow)]").model.stands[0].coefficients;
    let moving = Hit { speed: 2.0, direction: [1.0, 0.0], along: 2.0, height: 0.2, normal: [1.0, 0.0], depth: 0.0 };
    let deep = Hit { speed: 0.0, along: 0.0, depth: 1.0, ..moving };
    let after = |hits: &[Hit]| {
        let touched = |bend: [f32; 2]| contact(&co, bend, [0.0, 0.0], hits).expect("touched").bend;
        (0..20).fold([0.0, 0.0], |bend, _| touched(bend))
    };
    let floor = 5.0_f32.atan();
    assert!(length(after(&[moving, deep])) >= floor - 1e-5 && length(after(&[deep, moving])) >= floor - 1e-5);
    assert!(length(after(&[moving])) < floor - 0.05, "control: the push alone does not get there");
}

/// Two equal boxes pass through each other in one step; the cells they share follow the first.
#[test]
fn bodies_that_meet_on_a_cell_keep_their_order_in_a_world() {
    let meeting = |first: f64| {
        let body = |way: f64| {
            format!(
                "(shape: Box(size: (1.0, 1.0, 1.0)), clearance: 0.2, path: Keyframes(keys: [(time: 0.0, at: ({}, 4.0), yaw: 0.0),
                 (time: 1.0, at: ({}, 4.0), yaw: 0.0)]))",
                4.0 - way * 0.01,
                4.0 + way * 2.0
            )
        };
        let mut world = world(&format!(
            "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], interactors: [{}, {}]",
            body(first),
            body(-first)
        ));
        world.step();
        world.bend_at(0, [4.125, 4.125]).expect("a stand")
    };
    let (one, other) = (meeting(1.0), meeting(-1.0));
    assert!(one[0] > 0.05, "{one:?}");
    assert!(other[0] < -0.05, "{other:?}");
}
