//! The same grass for every caller: frame rate and hitches do not change what it does.

use crate::common::world;
use sward::world::World;

/// A disk of meadow, bent and let go.
fn released(species: &str) -> World {
    world(&format!(
        "field: (patch_side: 8.0), stands: [(species: {species}, cells: 32)],
         interactors: [(shape: Box(size: (3.0, 1.0, 3.0)), path: Still(at: (4.0, 4.0)), until: 0.5)]"
    ))
}

fn bend(world: &World) -> f64 {
    let bend = world.bend_at(0, [4.4, 4.4]).expect("a stand");
    f64::from(bend[0].hypot(bend[1]))
}

/// When the parabola through three samples (time, value) crosses a value between the last two of them.
fn crossing(samples: [(f64, f64); 3], wanted: f64) -> f64 {
    let value = |time: f64| -> f64 {
        let share = |k: usize| (0..3).filter(|l| *l != k).map(|l| (time - samples[l].0) / (samples[k].0 - samples[l].0)).product::<f64>();
        (0..3).map(|k| samples[k].1 * share(k)).sum()
    };
    let (mut low, mut high) = (samples[1].0, samples[2].0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value(middle) > wanted { low = middle } else { high = middle }
    }
    low
}

/// Time at which the bend of a plant falls below a tenth of a radian for the first time after the release, between two calls.
fn recovery(species: &str, calls_per_second: f64) -> f64 {
    let mut world = released(species);
    let (mut clock, mut samples) = (0.0, [(-1.0, 0.0), (0.0, 0.0), (0.0, 0.0)]);
    for _ in 0..(6.0 * calls_per_second) as u32 {
        world.advance(1.0 / calls_per_second);
        clock += 1.0 / calls_per_second;
        // What a picture shows between two steps: the state's own time plus what is not stepped yet.
        assert!((world.time() + world.state.pending_seconds - clock).abs() < 1e-6);
        if world.time() > samples[2].0 {
            samples = [samples[1], samples[2], (world.time(), bend(&world))];
        }
        if samples[1].0 > 0.55 && samples[1].1 >= 0.1 && samples[2].1 < 0.1 {
            return crossing(samples, 0.1);
        }
    }
    f64::NAN
}

#[test]
fn recovery_takes_as_long_for_every_caller() {
    for species in ["Lawn", "Meadow"] {
        let times = [30.0, 60.0, 144.0, 1000.0].map(|rate| recovery(species, rate));
        println!("{species}: recovered at {times:.4?} s");
        for time in times {
            assert!((time / times[1] - 1.0).abs() < 1e-3, "{species}: {times:?}");
        }
    }
    assert!((recovery("Lawn", 60.0) / recovery("Meadow", 60.0) - 1.0).abs() > 1e-3, "control: another species takes another time");
}

#[test]
fn a_hitch_drops_steps_and_does_not_make_the_grass_ring() {
    let (mut smooth, mut hitched) = (released("Meadow"), released("Meadow"));
    (0..40).for_each(|_| _ = (smooth.advance(1.0 / 60.0), hitched.advance(1.0 / 60.0)));
    assert_eq!(hitched.advance(0.5), 4, "catch_up");
    assert_eq!(hitched.state.dropped_steps, 26);
    (0..4).for_each(|_| _ = smooth.advance(1.0 / 60.0));
    for _ in 0..120 {
        assert_eq!(smooth.state.step, hitched.state.step);
        assert_eq!(bend(&smooth).to_bits(), bend(&hitched).to_bits(), "step {}", smooth.state.step);
        assert_eq!(smooth.hash(), hitched.hash());
        smooth.advance(1.0 / 60.0);
        hitched.advance(1.0 / 60.0);
    }
    assert_eq!(smooth.state.dropped_steps, 0, "control: only the hitch drops steps");
}
