//! A scene's air that flows: what pushes it, what it bends, and what it is read as between two steps, far away, and after a rest.

use crate::common::world;
use sward::wind::fluid::FluidState;
use sward::wind::{Phases, WindField};
use sward::world::World;

/// A pickup that drives along +x past (0, 0) in 1 s, at 8 m/s.
fn truck(wind: &str) -> World {
    world(&format!(
        "field: (patch_side: 16), stands: [(species: Meadow, cells: 64)], wind: [{wind}], budget: (focus_distance: 24),
         interactors: [(shape: Truck, path: Keyframes(keys: [(time: 0, at: (-8, 2)), (time: 2, at: (8, 2))]), until: 2)],
         camera: (eye: (0, 3, -6), target: (0, 0, 4))"
    ))
}

fn run(world: &mut World, steps: u32) {
    (0..steps).for_each(|_| world.step());
}

/// The wind of a world's first stand at a node of a patch, with all that belongs to it.
fn wind(world: &World, behind: f64) -> (WindField, u32) {
    let stand = &world.model.stands[0];
    (world.wind_before(stand, behind), stand.cells / 2)
}

fn length([x, z]: [f32; 2]) -> f32 {
    x.hypot(z)
}

#[test]
fn a_wake_bends_grass_beside_the_track() {
    let still = "Fluid(velocity: (0, 0), gusts: []";
    let (mut with, mut without) = (truck(&format!("{still})")), truck(&format!("{still}, bodies: false)")));
    // A little after it has passed x = 0; 1.6 m beside the middle of its track no wheel has been.
    let (mut most, mut waves): (f32, f32) = (0.0, 0.0);
    for _ in 0..100 {
        with.step();
        without.step();
        let at = [0.1, 3.9];
        let [bent, control] = [&with, &without].map(|world| world.bend_at(0, at).expect("a stand"));
        (most, waves) = (most.max(length(bent)), waves.max(length(control)));
    }
    let (field, intervals) = wind(&with, 0.0);
    let behind = field.velocity_local(&field.patch_phases([0, 0], intervals), [0.5, 2.0]);
    println!("bent by {most:.3} rad beside the track, by {waves:.3} without air; air in it moves at {behind:?} m/s");
    assert!(most > 0.05 && most > 2.0 * waves && behind[0] > 0.5, "control: the push of the truck alone hardly reaches there");
    let (field, intervals) = wind(&without, 0.0);
    assert_eq!(field.velocity_local(&field.patch_phases([0, 0], intervals), [0.5, 2.0]), [0.0; 2]);
}

#[test]
fn without_wind_nothing_moves() {
    let mut world = world("stands: [(species: Meadow, cells: 32)], wind: [Fluid(velocity: (0, 0), gusts: [])]");
    let before = world.hash();
    run(&mut world, 60);
    assert!(world.state.fluids[0].now.iter().flatten().all(|speed| speed.to_bits() == 0));
    assert_eq!((world.state.stands[0].awake.len(), world.state.stands[0].counters.patch_steps), (0, 0), "nothing is awake");
    world.state.step = 0;
    assert_eq!(world.hash(), before);
}

/// A body that flies high moves no air; one that stands in the wind shelters the grass behind it.
#[test]
fn bodies_shelter_and_fly_above() {
    let speeds = |clearance: f32| {
        let mut world = world(&format!(
            "stands: [(species: Meadow, cells: 32)], wind: [Fluid(gusts: [])], interactors: [(shape: Box(size: (3, 2, 3)), clearance: {clearance:?})]"
        ));
        run(&mut world, 60);
        let (field, intervals) = wind(&world, 0.0);
        let at = |x: f32, z: f32| field.velocity_local(&field.patch_phases([0, 0], intervals), [x, z])[0];
        [at(2.6, 0.0), at(0.0, 3.0)]
    };
    let ([behind, beside], high) = (speeds(0.0), speeds(5.0));
    println!("4 m/s; {behind:.2} m/s behind a box, {beside:.2} beside it");
    assert!(behind < 2.0 && beside > 4.2, "it shelters, and air goes round it");
    assert_eq!(high, [4.0; 2], "control: above the grass it does nothing");
}

/// The usual gusts are a lively wind, and the speed that is said to be seldom exceeded is.
#[test]
fn eddies_are_as_fast_as_said() {
    for fluid in [
        "",
        "velocity: (0, 0)",
        "velocity: (9, 3)",
        "side: 16, cells: 32, gusts: [(radius: 3, strength: 30)]",
        "side: 48, gusts: [(strength: 6, frequency: 0), (from: South, radius: 8, strength: 20)]",
        "fade: 4, gusts: [(from: Place(at: (9, 9)), frequency: 2, strength: 60, radius: 2)]",
    ] {
        let mut world = world(&format!("stands: [(species: Meadow, cells: 8)], wind: [Fluid({fluid})], budget: (focus_distance: 8)"));
        run(&mut world, 240);
        let (mut squares, mut count, mut beyond, mut most) = (0.0, 0.0, 0.0, 0.0_f32);
        let said = wind(&world, 0.0).0.fluids[0].speed;
        for _ in 0..30 {
            run(&mut world, 10);
            for flow in world.state.fluids[0].now.iter() {
                let speed = length(*flow);
                (squares, count, most) = (squares + f64::from(speed * speed), count + 1.0, most.max(speed));
                beyond += f64::from(u8::from(speed > said));
            }
        }
        let (rms, share) = ((squares / count).sqrt(), beyond / count);
        println!("Fluid({fluid}): rms {rms:.2} m/s, at most {most:.2}, said {said:.2}, beyond it {:.1} %", 100.0 * share);
        assert!(share < 0.08 && f64::from(said) < 8.0 * rms, "{fluid}");
    }
}

/// A whole step before a state its wind is that of the step before; half a step before, half each.
#[test]
fn between_two_steps_flows_mix() {
    let mut world = truck("Fluid()");
    run(&mut world, 99);
    let (then, intervals) = wind(&world, 0.0);
    world.step();
    let places = (0..500).map(|k| ([k % 5 - 2, k % 3], [(k * 7 % 160) as f32 * 0.1, (k * 11 % 160) as f32 * 0.1]));
    let (mut worst, mut moved) = (0.0_f32, 0.0_f32);
    let [now, half, whole] = [0.0, 0.5, 1.0].map(|behind| wind(&world, behind).0);
    for (patch, local) in places {
        let at = |field: &WindField| field.velocity_local(&field.patch_phases(patch, intervals), local);
        let [before, after, same, middle] = [&then, &now, &whole, &half].map(at);
        let off = |a: [f32; 2], b: [f32; 2]| length([a[0] - b[0], a[1] - b[1]]);
        worst = worst.max(off(same, before)).max(off(middle, [0, 1].map(|axis| 0.5 * (before[axis] + after[axis]))) - 0.05);
        moved = moved.max(off(after, before));
    }
    println!("the flow of then is off by {worst:.1e} m/s; a step changes {moved:.2} m/s");
    assert!(worst < 1e-4 && moved > 0.05);
}

#[test]
fn patches_share_nodes_and_tiles_have_no_seam() {
    let mut world = truck("Fluid(side: 27.3)");
    run(&mut world, 90);
    let (field, intervals) = wind(&world, 0.0);
    let bits = |field: &WindField, phases: &Phases, node: [i32; 2]| field.velocity(phases, node).map(f32::to_bits);
    let last = intervals as i32;
    for [x, z] in [[0, 0], [-1, 3], [8000, -8000], [i32::MAX, i32::MIN]] {
        let phases = |dx: i32, dz: i32| field.patch_phases([x.wrapping_add(dx), z.wrapping_add(dz)], intervals);
        for i in 0..=last {
            assert_eq!(bits(&field, &phases(0, 0), [last, i]), bits(&field, &phases(1, 0), [0, i]));
            assert_eq!(bits(&field, &phases(0, 0), [i, last]), bits(&field, &phases(0, 1), [i, 0]));
        }
        assert_ne!(bits(&field, &phases(0, 0), [last - 1, 5]), bits(&field, &phases(1, 0), [0, 5]));
    }
    let tiled = field.snapped(intervals);
    let phases = tiled.patch_phases([0, 0], intervals);
    let side = world.model.patch_side as f32;
    for i in 0..=last {
        let edges = |field: &WindField| {
            [[0, i], [last, i], [i, 0], [i, last]].map(|node| field.velocity(&field.patch_phases([0, 0], intervals), node))
        };
        let [left, right, low, high] = edges(&tiled);
        assert!(length([left[0] - right[0], left[1] - right[1]]) < 1e-4 && length([low[0] - high[0], low[1] - high[1]]) < 1e-4, "{i}");
        let between = tiled.velocity_local(&phases, [side, i as f32 * side / last as f32]);
        assert!(length([between[0] - right[0], between[1] - right[1]]) < 1e-3, "nodes and places agree");
    }
    let seam = (0..=last).any(|i| {
        field.velocity(&field.patch_phases([0, 0], intervals), [0, i]) != field.velocity(&field.patch_phases([0, 0], intervals), [last, i])
    });
    assert!(seam, "control: as it is it has one");
}

#[test]
fn a_flow_is_saved_and_goes_on() {
    let make = || truck("Fluid(cells: 32), Natural()");
    let mut first = make();
    run(&mut first, 70);
    let saved = first.save();
    run(&mut first, 30);
    let mut second = make();
    second.restore(&saved).expect("its own state");
    assert_eq!(second.save(), saved);
    run(&mut second, 30);
    assert_eq!((second.hash(), second.save()), (first.hash(), first.save()));
    let mut still = make();
    still.restore(&saved).expect("its own state");
    still.state.fluids[0] = FluidState::still(32);
    run(&mut still, 30);
    assert_ne!(still.hash(), first.hash(), "control: without its flow it goes another way");
    // Of another plane, or of none.
    for other in ["Fluid(cells: 64), Natural()", "Natural()"] {
        let error = truck(other).restore(&saved).expect_err("another scene");
        assert!(error.to_string().contains("another scene"), "{error}");
    }
}
