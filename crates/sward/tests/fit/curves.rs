//! Recordings made here, of known frequency and damping ratio: with noise, drift, a pull before, gaps; and such as are no swing.

use std::f64::consts::TAU;

use sward::fit::{FEWEST, NotOneMode, Recording, RecordingError, Swing, swing};

use crate::Test;
use crate::common::Dice;

pub(crate) const TESTS: &[Test] = &[
    ("what_was_put_in_comes_out", what_was_put_in_comes_out),
    ("noise_drift_and_a_pull_change_little", noise_drift_and_a_pull_change_little),
    ("what_is_no_single_mode_is_refused", what_is_no_single_mode_is_refused),
    ("scale_and_origin_change_nothing", scale_and_origin_change_nothing),
    ("what_is_no_recording_is_refused", what_is_no_recording_is_refused),
    ("any_numbers_have_an_answer", any_numbers_have_an_answer),
    ("a_long_recording_takes_no_time", a_long_recording_takes_no_time),
];

/// A plant that is let go at rest, `time` \[s\] later.
fn let_go(frequency: f64, zeta: f64, time: f64) -> f64 {
    let (omega, share) = (TAU * frequency, (1.0 - zeta * zeta).sqrt());
    let turn = omega * share * time;
    (-zeta * omega * time).exp() * (turn.cos() + zeta / share * turn.sin())
}

fn recording(times: impl Iterator<Item = f64>, mut value: impl FnMut(f64) -> f64) -> Recording {
    let times: Vec<f64> = times.collect();
    let values = times.iter().map(|time| value(*time)).collect();
    Recording::new(times, values).unwrap_or_else(|error| panic!("{error}"))
}

/// Even samples.
fn even(count: u32, dt: f64) -> impl Iterator<Item = f64> {
    (0..count).map(move |k| f64::from(k) * dt)
}

fn found(recording: &Recording) -> Swing {
    swing(recording).unwrap_or_else(|error| panic!("{error}"))
}

/// Whether frequency and damping ratio are those, to these shares.
fn is(swing: &Swing, frequency: f64, zeta: f64, shares: [f64; 2]) -> bool {
    (swing.frequency / frequency - 1.0).abs() < shares[0] && (swing.damping_ratio / zeta - 1.0).abs() < shares[1]
}

fn what_was_put_in_comes_out() {
    for frequency in [0.05, 0.2, 1.7, 6.3, 40.0] {
        for zeta in [0.002, 0.02, 0.12, 0.36, 0.6] {
            let swing = found(&recording(even(1500, 1.0 / (50.0 * frequency)), |time| let_go(frequency, zeta, time)));
            assert!(is(&swing, frequency, zeta, [5e-4, 2e-3]) && swing.r_squared > 0.9999, "{frequency} Hz, {zeta}: {swing:?}");
            assert!(!is(&swing, 1.002 * frequency, zeta, [5e-4, 2e-3]), "control: another frequency");
            assert!(!is(&swing, frequency, 1.01 * zeta, [5e-4, 2e-3]), "control: another damping ratio");
            let damped = frequency * (1.0 - zeta * zeta).sqrt();
            assert!((swing.swings_at() / damped - 1.0).abs() < 5e-4 && (10.0..13.0).contains(&swing.swings()), "{swing:?}");
        }
    }
}

fn noise_drift_and_a_pull_change_little() {
    let mut dice = Dice(11);
    for (frequency, zeta) in [(0.2, 0.03), (0.28, 0.08), (1.7, 0.18), (3.0, 0.3)] {
        for (noise, slope, hold) in [(0.0, 0.2, 0.0), (0.02, 0.0, 0.0), (0.02, 0.1, 0.0), (0.0, 0.0, 3.3), (0.02, -0.1, 5.0)] {
            // Uneven: each sample up to half a step late, one in ten left out; a few odd ones.
            let mut times: Vec<f64> =
                even(900, 1.0 / (30.0 * frequency)).map(|time| time + 0.5 * dice.unit() / (30.0 * frequency)).collect();
            times.retain(|_| dice.unit() > 0.1);
            let made = recording(times.into_iter(), |time| {
                let since = time - hold / frequency;
                let plant = if since < 0.0 { 1.0 } else { let_go(frequency, zeta, since) };
                let odd = if dice.unit() < 0.003 { 0.3 } else { 0.0 };
                4.0 + plant + slope * frequency * time + noise * (dice.between(-1.0, 1.0) + dice.between(-1.0, 1.0)) + odd * noise
            });
            let swing = swing(&made).unwrap_or_else(|error| panic!("{frequency} {zeta} {noise} {slope} {hold}: {error}"));
            println!(
                "{frequency} Hz, {zeta}; noise {noise}, slope {slope}, held {hold}: {:.4} Hz, {:.4}",
                swing.frequency, swing.damping_ratio
            );
            assert!(is(&swing, frequency, zeta, [0.015, 0.06]), "{noise} {slope} {hold}: {swing:?}");
            assert!(!is(&swing, 1.03 * frequency, zeta, [0.015, 0.06]) && !is(&swing, frequency, 1.15 * zeta, [0.015, 0.06]), "control");
            assert!(noise > 0.0 || (swing.drift - slope * frequency).abs() < 1e-2 * frequency, "{swing:?}");
            assert!(swing.window[0] >= (hold - 0.5) / frequency, "while it is held it is not free: {swing:?}");
        }
    }
}

fn what_is_no_single_mode_is_refused() {
    let mut dice = Dice(3);
    let two = recording(even(600, 0.05), |time| let_go(0.5, 0.03, time) + 0.6 * let_go(0.83, 0.03, time));
    assert!(matches!(swing(&two), Err(NotOneMode::Unexplained { r_squared, .. }) if r_squared < 0.95), "{:?}", swing(&two));
    // As it swings less it swings slower.
    let slower = recording(even(140, 0.05), |time| (-0.6 * time).exp() * (TAU * (0.5 - 0.02 * time) * time).cos());
    assert!(matches!(swing(&slower), Err(NotOneMode::Changing { .. })), "{:?}", swing(&slower));
    let noise = recording(even(600, 0.05), |_| dice.unit());
    assert!(matches!(swing(&noise), Err(NotOneMode::Unexplained { .. })), "{:?}", swing(&noise));
    let still = recording(even(600, 0.05), |_| 3.0);
    assert_eq!(swing(&still), Err(NotOneMode::Still));
    let short = recording(even(40, 0.05), |time| let_go(0.5, 0.05, time));
    assert_eq!(swing(&short), Err(NotOneMode::Short));
    let creeping = recording(even(600, 0.05), |time| (-time).exp());
    assert!(swing(&creeping).is_err(), "{:?}", swing(&creeping));
    let line = recording(even(600, 0.05), |time| 3.0 * time - 1.0);
    assert!(swing(&line).is_err(), "{:?}", swing(&line));
    // Controls: the first mode of each alone.
    found(&recording(even(600, 0.05), |time| let_go(0.5, 0.03, time)));
    found(&recording(even(140, 0.05), |time| let_go(0.5, 0.25, time)));
}

fn scale_and_origin_change_nothing() {
    let made = |scale: f64, height: f64, start: f64| {
        let made = recording(even(400, 0.25).map(|time| time + start), |time| height + scale * let_go(0.21, 0.05, time - start));
        found(&made)
    };
    let usual = made(1.0, 0.0, 0.0);
    for (scale, height, start) in [(-1.0, 0.0, 0.0), (3e-7, 0.0, 0.0), (1e12, -1e12, 0.0), (1.0, 50.0, 1.7e9), (-2e-5, 1e-3, -40.0)] {
        let swing = made(scale, height, start);
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b.abs() + 1e-12;
        assert!(near(swing.frequency, usual.frequency) && near(swing.damping_ratio, usual.damping_ratio), "{swing:?}");
        assert!(
            (swing.amplitude / scale.abs() / usual.amplitude - 1.0).abs() < 1e-4
                && (swing.window[0] - start - usual.window[0]).abs() < 1e-6
        );
    }
}

fn what_is_no_recording_is_refused() {
    let times = || even(40, 0.1).collect::<Vec<f64>>();
    let with = |at: usize, time: f64, value: f64| {
        let (mut times, mut values) = (times(), vec![1.0; 40]);
        (times[at], values[at]) = (time, value);
        Recording::new(times, values)
    };
    for (bad, sample) in [
        (with(7, 0.7, f64::NAN), 7),
        (with(8, f64::INFINITY, 1.0), 8),
        (with(9, 0.9, 1e101), 9),
        (with(10, 0.1, 1.0), 10),
        (with(11, 1.0, 1.0), 11),
    ] {
        let error = bad.expect_err("refused");
        assert_eq!(error.sample(), Some(sample), "{error}");
    }
    assert_eq!(Recording::new(Vec::new(), Vec::new()), Err(RecordingError::TooFew { samples: 0 }));
    assert_eq!(Recording::new(times(), vec![1.0; 39]), Err(RecordingError::Unpaired { times: 40, values: 39 }));
    let few = times()[..FEWEST - 1].to_vec();
    assert_eq!(Recording::new(few.clone(), few), Err(RecordingError::TooFew { samples: FEWEST - 1 }));
    assert!(with(7, 0.7, 1e100).is_ok(), "control");
}

/// Whatever the numbers are: no panic, and what is found is finite.
fn any_numbers_have_an_answer() {
    let mut dice = Dice(77);
    let mut taken = 0;
    for case in 0..400 {
        let count = FEWEST + (dice.unit() * dice.unit() * 300.0) as usize;
        let size = |dice: &mut Dice| 10f64.powf(dice.between(-99.0, 99.0));
        let pace = if case % 3 == 0 { size(&mut dice) } else { 1.0 };
        let (mut time, mut times, mut values) = (dice.between(-1.0, 1.0), Vec::new(), Vec::new());
        for k in 0..count {
            let step = pace * if case % 5 == 0 { 10f64.powf(dice.between(-9.0, 3.0)) } else { 0.1 };
            time += step;
            times.push(time);
            values.push(match case % 7 {
                0 => size(&mut dice),
                1 => dice.unit(),
                2 => f64::from(k % 2 == 0),
                3 => f64::from(k == count / 2),
                4 => f64::from(k > count / 3),
                5 => (k as f64).powi(3),
                _ => let_go(0.3, 0.1, k as f64 * 0.2) + 0.1 * dice.unit(),
            });
        }
        let Ok(recording) = Recording::new(times, values) else { continue };
        taken += 1;
        if let Ok(swing) = swing(&recording) {
            let all =
                [swing.frequency, swing.damping_ratio, swing.amplitude, swing.drift, swing.r_squared, swing.swings(), swing.window[1]];
            assert!(all.iter().all(|number| number.is_finite()) && swing.frequency > 0.0, "case {case}: {swing:?}");
        }
    }
    assert!(taken > 200, "{taken}");
}

fn a_long_recording_takes_no_time() {
    let mut dice = Dice(5);
    let long = recording(even(1_000_000, 1e-3), |time| let_go(0.3, 0.02, time) + 0.02 * dice.between(-1.0, 1.0));
    let clock = std::time::Instant::now();
    let swing = found(&long);
    println!("a million samples: {:?}", clock.elapsed());
    assert!(is(&swing, 0.3, 0.02, [1e-3, 1e-2]), "{swing:?}");
    assert!(clock.elapsed().as_secs_f64() < 5.0, "{:?}", clock.elapsed());
}
