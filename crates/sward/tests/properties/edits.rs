//! The ground changes while a world runs: cells, bodies and plants follow, and so does a saved state.

use crate::common::world;
use sward::saved::SavedError;
use sward::scene::{Change, Edit, Flatten, Raise};
use sward::terrain::Terrain;
use sward::world::World;

fn raise(at: [f64; 2], radius: f32, height: f32) -> Edit {
    Edit { at, radius, change: Change::Raise(Raise { height }), ..Edit::default() }
}

/// A truck parked on the patch [0, 0].
fn parked(more: &str) -> World {
    world(&format!(
        "field: (patch_side: 8), stands: [(species: Meadow, cells: 32)], {more}
         interactors: [(name: \"truck\", shape: Truck, path: Still(at: (4, 4)))]"
    ))
}

fn run(world: &mut World, steps: u32) {
    (0..steps).for_each(|_| world.step());
}

fn height_under_cells(world: &World, patch: [i32; 2]) -> f32 {
    let awake = world.state.stands[0].awake[&patch];
    world.state.stands[0].cells.ground[awake.slot as usize].height(32, 16 * 32 + 16)
}

#[test]
fn ground_rises_smoothly_where_it_was_asked_and_nowhere_else() {
    for detail in ["", "detail: (amplitude: 0.3),"] {
        let (plain, mut world) = (parked(detail), parked(detail));
        world.edit(&raise([40.0, -3.0], 5.0, 1.5)).unwrap();
        let added = |x: f64, z: f64| world.model.terrain.height_at(x, z) - plain.model.terrain.height_at(x, z);
        assert!((added(40.0, -3.0) - 1.5).abs() < 0.01);
        assert!((added(42.5, -3.0) - 1.5 * 0.5625).abs() < 0.01, "(1 - 1/4)² of it half way");
        for [x, z] in [[45.8, -3.0], [40.0, 2.8], [0.0, 0.0], [-40.0, 3.0], [1e7, 5.0]] {
            assert_eq!(added(x, z), 0.0, "{x} {z}");
        }
        // The slope is that of the heights.
        for [x, z] in [[41.3, -1.2], [38.0, -5.0], [44.0, -3.3]] {
            let (_, slope) = world.model.terrain.height_and_gradient_at(x, z);
            let rise = (world.model.terrain.height_at(x + 1e-4, z) - world.model.terrain.height_at(x - 1e-4, z)) / 2e-4;
            assert!((slope[0] - rise).abs() < 1e-3, "{} {rise}", slope[0]);
            let anchor = world.model.terrain.anchor([x - 3.0, z + 7.0]);
            let (height, _) = world.model.terrain.height_and_gradient(anchor, [3.0, -7.0]);
            assert!((f64::from(height) - world.model.terrain.height_at(x, z)).abs() < 1e-4);
        }
    }
}

#[test]
fn flattened_ground_is_level() {
    let mut world = parked("");
    world.edit(&raise([0.0, 0.0], 20.0, 4.0)).unwrap();
    let level =
        Edit { at: [6.0, 0.0], radius: 8.0, hardness: 0.5, change: Change::Flatten(Flatten { height: Some(1.0) }), ..Edit::default() };
    world.edit(&level).unwrap();
    for [x, z] in [[6.0, 0.0], [9.0, 1.0], [4.0, -3.0]] {
        assert!((world.model.terrain.height_at(x, z) - 1.0).abs() < 1e-4);
    }
    assert!(world.model.terrain.height_at(-4.0, 0.0) > 3.0, "control");
    let here = Edit { change: Change::Flatten(Flatten { height: None }), at: [-6.0, 0.0], ..level };
    let middle = world.model.terrain.height_at(-6.0, 0.0);
    world.edit(&here).unwrap();
    assert!((world.model.terrain.height_at(-8.0, 1.0) - middle).abs() < 1e-4);
}

#[test]
fn a_parked_truck_and_its_cells_are_lifted_in_the_next_step() {
    let mut world = parked("");
    run(&mut world, 10);
    let (hash, before) = (world.hash(), world.state.bodies[0].pose.unwrap().height);
    assert_eq!((height_under_cells(&world, [0, 0]), before), (0.0, 0.0));
    world.edit(&raise([4.0, 4.0], 3.0, 0.8)).unwrap();
    assert_eq!((world.hash(), height_under_cells(&world, [0, 0])), (hash, 0.0), "not before the next step");
    world.step();
    assert!((height_under_cells(&world, [0, 0]) - 0.8).abs() < 0.05 && world.state.bodies[0].pose.unwrap().height > 0.2);
    // Only patches that the edit touches are sampled again, and each once.
    let resampled = world.state.stands[0].counters.resampled;
    let touched = world.state.stands[0].awake.keys().filter(|patch| patch.iter().all(|at| (0..=0).contains(at))).count() as u64;
    assert_eq!((resampled, touched), (1, 1));
    run(&mut world, 30);
    assert_eq!(world.state.stands[0].counters.resampled, 1);
    world.edit(&raise([400.0, 4.0], 3.0, 0.8)).unwrap();
    world.step();
    assert_eq!(world.state.stands[0].counters.resampled, 1, "far from every awake patch");
}

#[test]
fn a_patch_that_wakes_later_has_the_new_ground() {
    let drive = "interactors: [(shape: Sphere(radius: 0.5), path: Driven(at: (100, 100)))]";
    let mut world = world(&format!("field: (patch_side: 8), stands: [(species: Meadow, cells: 32)], {drive}"));
    run(&mut world, 2);
    world.edit(&raise([4.0, 4.0], 3.0, 0.8)).unwrap();
    run(&mut world, 2);
    assert!(!world.state.stands[0].awake.contains_key(&[0, 0]), "asleep");
    world.drive(0, [4.0, 4.0], 0.0, 0.0);
    run(&mut world, 2);
    assert!((height_under_cells(&world, [0, 0]) - 0.8).abs() < 0.05);
    assert!(world.bend_at(0, [4.2, 4.2]).unwrap().iter().any(|bend| bend.abs() > 0.1), "pushed at its new height");
}

#[test]
fn saved_states_keep_the_ground() {
    let edits =
        "edits: [(at: (5, 5), radius: 3, change: Raise(height: 0.3)), (time: 0.4, at: (2, 4), radius: 2, change: Raise(height: -0.2))],";
    for (scene, by_hand) in [("", true), (edits, false), (edits, true)] {
        let mut first = parked(scene);
        run(&mut first, 20);
        if by_hand {
            first.edit(&raise([3.0, 4.0], 4.0, 0.7)).unwrap();
        }
        let (saved, mut second, mut other) = (first.save(), parked(scene), parked(scene));
        second.restore(&saved).unwrap();
        assert_eq!(second.save(), saved);
        run(&mut first, 60);
        run(&mut second, 60);
        assert_eq!((second.hash(), second.save()), (first.hash(), first.save()), "by hand: {by_hand}");
        run(&mut other, 80);
        assert_eq!(other.hash() != first.hash(), by_hand, "control: without the edit from code it is another state");
        assert_eq!(other.model.terrain.height_at(3.0, 4.0) != first.model.terrain.height_at(3.0, 4.0), by_hand);
    }
}

#[test]
fn a_scenes_edits_come_at_their_time() {
    let mut world = parked("edits: [(time: 0.5, at: (4, 4), radius: 3, change: Raise(height: 0.8))],");
    run(&mut world, 29);
    assert_eq!((world.model.terrain.height_at(4.0, 4.0), height_under_cells(&world, [0, 0])), (0.0, 0.0));
    world.step();
    assert!((world.model.terrain.height_at(4.0, 4.0) - 0.8).abs() < 0.01 && (height_under_cells(&world, [0, 0]) - 0.8).abs() < 0.05);
    let start = parked("edits: [(at: (4, 4), radius: 3, change: Raise(height: 0.8))],");
    assert!((start.model.terrain.height_at(4.0, 4.0) - 0.8).abs() < 0.01);
}

/// A backend that could not take a step plans it again.
#[test]
fn a_step_planned_again_edits_nothing_twice() {
    let edits = "edits: [(time: 0.1, at: (4, 4), radius: 3, change: Raise(height: 0.8))],";
    let (mut once, mut again) = (parked(edits), parked(edits));
    for _ in 0..20 {
        once.step();
        for _ in 0..3 {
            assert!(again.plan().stands[0].patches.iter().all(|patch| !patch.edited || again.state.step == 5));
        }
        if again.state.step == 5 {
            let saved = again.save();
            again.restore(&saved).unwrap();
        }
        let plan = again.plan();
        let reports = again.respond(&plan);
        again.finish(reports);
        let ground = |world: &World| (world.state.step, world.model.terrain.edits().size(), world.model.terrain.edits().heights().to_vec());
        assert!(ground(&again) == ground(&once), "step {}", again.state.step);
        assert_eq!(height_under_cells(&again, [0, 0]), height_under_cells(&once, [0, 0]));
    }
    assert!((height_under_cells(&again, [0, 0]) - 0.8).abs() < 0.05, "control: the edit came");
    assert_eq!(again.state.stands[0].counters.resampled, 1);
}

/// The samples of a large terrain and those of edits share one buffer: what they leave is the limit, for edits and for saved ones.
#[test]
fn edits_have_the_room_that_the_terrain_leaves() {
    let mut full = Terrain::new(vec![0.0; 8192 * 4095], 8192, 4095, [1.0; 2], [0.0; 2]).unwrap();
    let error = full.edit(&raise([0.0, 0.0], 20.0, 1.0)).expect_err("no room").to_string();
    assert!(error.contains("`edits` is 64 m x 64 m, allowed is a rectangle round all of them of at most 512 square metres"), "{error}");
    assert!(full.edits().is_none());
    let mut smaller = parked("");
    smaller.edit(&raise([0.0, 0.0], 20.0, 1.0)).unwrap();
    let saved = smaller.save();
    assert_eq!(smaller.restore(&saved), Ok(()), "control");
    let mut tight = parked("");
    tight.model.terrain = full;
    assert_eq!(tight.restore(&saved), Err(SavedError::Damaged("its ground is none")));
}

#[test]
fn impossible_edits_are_refused_and_change_nothing() {
    let mut world = parked("");
    world.edit(&raise([0.0, 0.0], 3.0, 0.5)).unwrap();
    let before = world.save();
    for (edit, words) in [
        (raise([f64::NAN, 0.0], 3.0, 0.5), "`at` is NaN m"),
        (raise([0.0, 0.0], 0.0, 0.5), "`radius` is 0 m"),
        (raise([0.0, 0.0], 3.0, 1e9), "`height` is 1000000000 m"),
        (raise([90_000.0, 90_000.0], 3.0, 0.5), "at most 524288 square metres"),
    ] {
        let error = world.edit(&edit).expect_err("refused").to_string();
        assert!(error.contains(words), "{error}");
        assert_eq!(world.save(), before);
    }
}
