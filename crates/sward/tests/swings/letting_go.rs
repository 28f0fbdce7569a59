//! Letting go: plants swing back at their own frequency and damping, the same at every rate of steps, and cost nothing meanwhile.

use sward::response::oscillator::Blocks;
use sward::world::World;

use super::field::{Found, coefficients, field, length, touched};

const STAND: &str =
    "height: (0.4, 0.4), clumping: 0, response: Oscillator(frequency: 1.7, damping: 0.18, spread_stiffness: 0, spread_damping: 0)";

/// A ball that vanishes after a second, at `rate` steps a second, as it is at `time` s.
fn ball(rate: u32, until: f64, time: f64) -> World {
    let body = format!("interactors: [(shape: Sphere(radius: 2), path: Still(at: (2, 2)), until: {until})]");
    let mut world = field(STAND, &format!("steps_per_second: {rate}, {body}"));
    while world.time() < time - 1e-9 {
        world.step();
    }
    world
}

/// The plant that leans farthest.
fn farthest(world: &World) -> ((sward::state::PatchKey, u32), Found) {
    let most = |found: &Found| length(found.record.deviation);
    touched(world).into_iter().max_by(|a, b| most(&a.1).total_cmp(&most(&b.1))).expect("some are touched")
}

#[test]
fn it_swings_at_the_frequency_and_damping_asked_for() {
    let mut world = ball(240, 1.0, 1.0);
    let (key, start) = farthest(&world);
    let along = |world: &World| {
        let found = touched(world).into_iter().find(|(other, _)| *other == key).expect("still there").1;
        let (now, first) = (found.at(world, 0.0), start.record.deviation);
        f64::from((now[0] * first[0] + now[1] * first[1]) / length(first))
    };
    // Turning points: half a period apart, each less by e^(−πζ/√(1−ζ²)).
    let (mut before, mut last, mut turns) = (along(&world), along(&world), vec![(1.0, along(&world))]);
    for _ in 0..480 {
        world.step();
        let now = along(&world);
        if (last - before) * (now - last) < 0.0 {
            turns.push((world.time() - 1.0 / 240.0, last));
        }
        (before, last) = (last, now);
    }
    let period = 2.0 * (turns[4].0 - turns[0].0) / 4.0;
    let ratio = (turns[0].1 / turns[2].1).ln() / std::f64::consts::TAU;
    let damping = ratio / (1.0 + ratio * ratio).sqrt();
    let frequency = 1.0 / period / (1.0 - damping * damping).sqrt();
    println!("asked 1.7 Hz and 0.18, measured {frequency:.3} Hz and {damping:.4}");
    assert!((frequency - 1.7).abs() < 0.01, "{frequency}");
    assert!((damping - 0.18).abs() < 0.002, "{damping}");
}

/// Largest difference of the curves after the ball is gone between worlds of two rates, rad.
fn apart(a: u32, b: u32, until: [f64; 2]) -> f32 {
    let mut worst: f32 = 0.0;
    for quarter in 0..9 {
        let time = 1.25 + 0.25 * f64::from(quarter);
        // Both at the same moment, wherever their steps lie.
        let moments = [(a, until[0]), (b, until[1])].map(|(rate, until)| {
            let steps = (time * f64::from(rate)).ceil();
            let world = ball(rate, until, steps / f64::from(rate));
            (steps - time * f64::from(rate), world)
        });
        let [first, second] = &moments;
        let (one, other) = (touched(&first.1), touched(&second.1));
        assert!(one.len() > 30 && one.len() == other.len());
        for ((key, left), (same, right)) in one.iter().zip(&other) {
            assert_eq!(key, same);
            let (left, right) = (left.at(&first.1, first.0 as f32), right.at(&second.1, second.0 as f32));
            worst = worst.max(length([left[0] - right[0], left[1] - right[1]]));
        }
    }
    worst
}

#[test]
fn recovery_is_the_same_at_every_rate() {
    for until in [1.0, 1.0037] {
        for rate in [30, 144, 1000] {
            let worst = apart(60, rate, [until; 2]);
            println!("gone at {until} s: 60 against {rate} steps a second: {worst:.1e} rad");
            assert!(worst < 1e-4, "{rate}: {worst}");
        }
    }
    // Let go a single step of 1/60 s later it is another curve.
    let control = apart(60, 60, [1.0, 1.0 + 1.0 / 60.0]);
    assert!(control > 0.02, "{control}");
}

/// Between two steps a picture shows the same curve: no rate of frames changes it.
#[test]
fn frames_between_steps_lie_on_the_same_curve() {
    let (coarse, fine) = (ball(60, 1.0, 1.5), ball(960, 1.0, 1.5 - 7.0 / 960.0));
    let (one, other) = (touched(&coarse), touched(&fine));
    let worst = one.iter().zip(&other).map(|((_, a), (_, b))| {
        let (a, b) = (a.at(&coarse, 7.0 / 16.0), b.at(&fine, 0.0));
        length([a[0] - b[0], a[1] - b[1]])
    });
    let worst = worst.fold(0.0, f32::max);
    assert!(one.len() > 30 && worst < 1e-4, "{worst}");
}

#[test]
fn a_plant_let_go_costs_nothing_and_its_patch_sleeps_when_it_is_at_rest() {
    let during = ball(60, 1.0, 0.5).plan();
    let mut world = ball(60, 1.0, 1.0);
    let during = Blocks::of(&during.stands[0], 64);
    assert!(!during.blocks.is_empty());
    world.step();
    let settle = coefficients(&world).settle;
    let (mut steps, mut before) = (0, world.hash());
    while !world.state.stands[0].awake.is_empty() {
        let plan = world.plan();
        assert!(Blocks::of(&plan.stands[0], 64).blocks.is_empty(), "nothing is visited");
        let reports = world.respond(&plan);
        world.finish(reports);
        // No cell is written.
        let cells = world.state.stands[0].cells.now.clone();
        assert!(steps > settle + 100 || cells == world.state.stands[0].cells.now);
        before ^= world.hash();
        steps += 1;
        assert!(steps < settle + 200, "it never sleeps: {steps} {settle} {before}");
    }
    println!("asleep after {steps} steps; at rest by {settle}");
    assert!(steps >= settle, "not while a plant still swings: {steps} {settle}");
}

/// Nothing that a patch forgets as it falls asleep was to be seen.
#[test]
fn at_rest_means_less_than_a_milliradian() {
    for stand in ["response: Oscillator()", "response: Oscillator(damping: 4)", "response: Oscillator(damping: 1)"] {
        let body = "interactors: [(shape: Sphere(radius: 0.8), path: Circle(radius: 2, speed: 3), until: 1.0)]";
        let mut world = field(stand, body);
        (0..60).for_each(|_| world.step());
        let settle = coefficients(&world).settle;
        for _ in 0..settle {
            world.step();
        }
        let left = touched(&world).iter().map(|(_, found)| length(found.at(&world, 0.0))).fold(0.0, f32::max);
        let half = touched(&world).iter().map(|(_, found)| length(found.at(&world, 0.7 * settle as f32))).fold(0.0, f32::max);
        println!("{stand}: {left:.1e} rad left after {settle} steps, {half:.1e} after a third of them");
        assert!(left < 1e-3, "{left}");
        assert!(half > 1e-3, "it counts far too long: {half}");
    }
}

#[test]
fn a_cell_takes_sixteen_bytes() {
    let world = ball(60, 1.0, 0.5);
    let stand = &world.state.stands[0];
    assert!(!stand.awake.is_empty());
    assert!(stand.cells.now.iter().all(|slot| size_of_val(&slot[..]) == 16 * 64 * 64));
    assert!(stand.cells.old.iter().all(|slot| slot.is_empty()), "the wind is the same everywhere");
}
