//! Chen & Johan 2010, §4.5, eq. 7–9: how upper segments trail.

use crate::common::world;
use sward::response::continuum::{LagCoefficients, cascade};
use sward::world::World;

const DT: f64 = 1.0 / 60.0;

/// A plant that is pressed down in 0.15 s, held, let go, and sways.
fn pressed(time: f64) -> f64 {
    if time < 0.0 {
        return 0.0;
    }
    let down = (time / 0.15).min(1.0);
    let down = 1.2 * down * down * (3.0 - 2.0 * down);
    let free = (time - 1.2).max(0.0);
    down * (-3.8 * free).exp() * (10.3 * free).cos()
}

/// Root-mean-square of the cascade's tip against the exact delay, over that of no lag at all; and the largest step of the tip.
fn cascade_error(gamma: f32, segments: u32, delay: f64) -> (f64, f64) {
    let mut species = world("stands: [(species: Meadow)]").model.stands[0].species.continuum.clone();
    (species.gamma_top, species.gamma_recover) = (gamma, gamma);
    let lag = LagCoefficients::new(&species, segments, DT);
    let mut upper = vec![0.0_f32; 2 * (segments as usize - 1)];
    let tip = upper.len() - 2;
    let (mut off, mut none, mut jump) = (0.0, 0.0, 0.0_f64);
    for step in 0..240 {
        let (time, before) = (f64::from(step) * DT, f64::from(upper[tip]));
        cascade(&lag, [&[pressed(time) as f32], &[0.0]], &mut upper);
        let exact = pressed(time - delay);
        off += (f64::from(upper[tip]) - exact).powi(2);
        none += (pressed(time) - exact).powi(2);
        jump = jump.max((f64::from(upper[tip]) - before).abs());
    }
    ((off / none).sqrt(), jump)
}

#[test]
fn the_cascade_follows_the_exact_delay() {
    for (name, gamma, segments) in [("meadow", 0.12, 4), ("reed", 0.30, 7), ("tussock", 0.05, 2)] {
        let (error, jump) = cascade_error(gamma, segments, f64::from(gamma));
        let control = cascade_error(gamma, segments, f64::from(gamma) * 3.0).0;
        println!(
            "{name}: {:.0} % of the exact delay's effect is missed, {:.0} % of thrice it, largest step {jump:.3} rad",
            error * 100.0,
            control * 100.0
        );
        assert!(error < 0.35, "{name}: {error}");
        assert!(control > 0.45, "control: another delay must not fit, {control}");
        assert!(jump < 0.25, "{name}: no jumps, {jump}");
    }
}

/// A bend of 1 rad let go at time 0, swaying at `frequency` [Hz] with damping ratio `ratio` below 1.
fn released(time: f64, frequency: f64, ratio: f64) -> f64 {
    if time < 0.0 {
        return 1.0;
    }
    let omega = std::f64::consts::TAU * frequency;
    let turn = omega * (1.0 - ratio * ratio).sqrt();
    (-ratio * omega * time).exp() * ((turn * time).cos() + ratio * omega / turn * (turn * time).sin())
}

/// Let go, a plant's tip is off the exact delay by less than 27 % of its own motion (root-mean-square).
#[test]
fn the_cascade_recovers_like_the_exact_delay() {
    for (name, frequency, ratio) in [("Meadow", 1.70, 0.36), ("Reed", 1.04, 0.43), ("Tussock", 3.18, 0.67)] {
        let stand = &world(&format!("stands: [(species: {name})]")).model.stands[0];
        let lag = stand.lag;
        let missed = |delay: f64| {
            let mut upper = vec![0.0_f32; 2 * (lag.segments as usize - 1)];
            upper.iter_mut().step_by(2).for_each(|value| *value = 1.0);
            let (tip, mut off, mut all) = (upper.len() - 2, 0.0, 0.0);
            for step in 0..240 {
                let time = f64::from(step) * DT;
                cascade(&lag, [&[released(time, frequency, ratio) as f32], &[0.0]], &mut upper);
                let exact = released(time - delay, frequency, ratio);
                off += (f64::from(upper[tip]) - exact).powi(2);
                all += exact * exact;
            }
            (off / all).sqrt()
        };
        let (own, none, thrice) = (missed(f64::from(lag.gamma_recover)), missed(0.0), missed(3.0 * f64::from(lag.gamma_recover)));
        println!(
            "{name}: off by {:.0} % of the motion; {:.0} % of no delay, {:.0} % of thrice it",
            own * 100.0,
            none * 100.0,
            thrice * 100.0
        );
        assert!(own < 0.27, "{name}: {own}");
        assert!(none > own && thrice > 0.4, "control: another delay must not fit better: {none}, {thrice}");
    }
}

fn rolling(lag: &str, species: &str) -> World {
    world(&format!(
        "field: (patch_side: 8.0), stands: [(species: {species}, cells: 16, response: Continuum(lag: {lag}))],
         interactors: [(shape: Sphere(radius: 0.8), path: Keyframes(keys: [(time: 0.0, at: (1.0, 4.0)), (time: 0.7, at: (7.0, 4.0))]))],
         camera: (eye: (4.0, 2.0, 4.0), target: (4.0, 0.0, 8.0))"
    ))
}

/// β of cell (i, j) of patch (0, 0), then of its upper segments.
fn spine_of(world: &World, cell: usize) -> Vec<[f32; 2]> {
    let stand = &world.state.stands[0];
    let Some(awake) = stand.awake.get(&[0, 0]) else { return Vec::new() };
    let pair = |planes: &[f32], first: usize| [planes[first * 256 + cell], planes[(first + 1) * 256 + cell]];
    let upper = &stand.cells.lag[awake.lag as usize];
    let mut bends = vec![pair(&stand.cells.now[awake.slot as usize], 0)];
    bends.extend((0..upper.len() / 512).map(|segment| pair(upper, segment * 2)));
    bends
}

#[test]
fn equation_7_history_is_the_bend_of_whole_steps_ago() {
    let mut world = rolling("History", "Meadow");
    let cell = 8 * 16 + 8;
    let mut past: Vec<[f32; 2]> = Vec::new();
    let (mut moved, mut wrong) = (0, 0);
    for _ in 0..120 {
        world.step();
        let bends = spine_of(&world, cell);
        past.push(bends[0]);
        // γ_top 0.12 s and γ_recover 0.06 s at segment i of 3 above the root: 0.04 i and 0.02 i seconds.
        for (segment, bend) in bends.iter().enumerate().skip(1) {
            let ago = |seconds: f64| past[past.len().saturating_sub(1 + (seconds * 60.0 + 0.5) as usize)];
            let size = |b: [f32; 2]| b[0] * b[0] + b[1] * b[1];
            let (top, recover) = (ago(0.04 * segment as f64), ago(0.02 * segment as f64));
            let expected = if size(bends[0]) < size(top) { recover } else { top };
            assert_eq!(*bend, expected, "segment {segment}, step {}", past.len());
            moved += u32::from(*bend != bends[0]);
            wrong += u32::from(*bend != ago(0.04 * segment as f64 + 1.0 / 60.0));
        }
    }
    assert!(moved > 50 && wrong > 50, "control: {moved}, {wrong}");
}

#[test]
fn a_steady_bend_is_straight_and_a_fast_one_trails() {
    for lag in ["Cascade", "History", "Lookup"] {
        let mut world = rolling(lag, "Reed");
        let cell = 8 * 16 + 8;
        let mut widest = 0.0_f32;
        for _ in 0..60 {
            world.step();
            let bends = spine_of(&world, cell);
            let tip = bends.last().expect("segments");
            widest = widest.max((tip[0] - bends[0][0]).abs());
            assert!(bends.iter().flatten().all(|value| value.is_finite() && value.abs() < 1.6), "{lag}");
        }
        assert!(widest > 0.05, "{lag} trails while it moves: {widest}");
        // A hold: the body parks elsewhere, the reed comes to rest and is straight.
        let mut straight = f32::MAX;
        for _ in 0..400 {
            world.step();
            let bends = spine_of(&world, cell);
            if bends.is_empty() {
                break;
            }
            straight = bends.iter().map(|bend| (bend[0] - bends[0][0]).abs() + (bend[1] - bends[0][1]).abs()).fold(0.0, f32::max);
        }
        assert!(straight < 5e-3, "{lag}: {straight}");
    }
}
