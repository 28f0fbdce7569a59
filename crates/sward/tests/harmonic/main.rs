//! Waves of vegetation on a plane, as cameras see them, layer by layer.

use std::f64::consts::TAU;

mod plants;

use sward::geometry::warp::{Warp, offset};
use sward::response::harmonic::{Axes, HarmonicCoefficients, Ring, Waves, drifted, lags, seen};

const DT: f32 = 1.0 / 60.0;

/// A plane wave swings as the scheme's own dispersion relation says.
#[test]
fn a_plane_wave_has_its_frequency() {
    let (side, wave) = (32, 3);
    let co = HarmonicCoefficients::new(2.0, 0.8, 0.0, 1.0, 0.25, DT);
    let shape = |i: usize| (TAU * (wave * i) as f64 / side as f64).cos();
    let turn = 2.0 - f64::from(co.restoring) - 2.0 * f64::from(co.spread) * (1.0 - (TAU * wave as f64 / side as f64).cos());
    let phase = (turn / 2.0).acos();
    let mut waves = Waves::new(side);
    for k in 0..side * side {
        waves.now[k] = [shape(k % side) as f32, 0.0];
        waves.old[k] = [(shape(k % side) * phase.cos()) as f32, 0.0];
    }
    let still = vec![[0.0; 2]; side * side];
    for step in 1..=240 {
        waves.step(&co, &still);
        let expected = (phase * f64::from(step)).cos();
        let worst = (0..side).map(|i| (f64::from(waves.now[5 * side + i][0]) - shape(i) * expected).abs()).fold(0.0, f64::max);
        assert!(worst < 2e-4, "step {step}: {worst}");
    }
    // Control: another speed is another frequency.
    let other = HarmonicCoefficients::new(2.1, 0.8, 0.0, 1.0, 0.25, DT);
    assert!(other.spread > 1.05 * co.spread);
}

#[test]
fn it_follows_the_wind_and_rests_without() {
    let co = HarmonicCoefficients::new(2.0, 1.0, 0.2, 0.7, 0.25, DT);
    let mut waves = Waves::new(16);
    let wind = vec![[3.0, -1.0]; 256];
    let mut most = 0.0f32;
    for _ in 0..1200 {
        waves.step(&co, &wind);
        most = most.max(waves.now[9][0]);
    }
    assert!((waves.now[9][0] - 2.1).abs() < 1e-3 && (waves.now[9][1] + 0.7).abs() < 1e-3 && most > 2.5, "{:?} {most}", waves.now[9]);
    (0..1200).for_each(|_| waves.step(&co, &vec![[0.0; 2]; 256]));
    assert!(waves.now.iter().flatten().all(|part| part.abs() < 1e-4));
}

/// Any numbers of a scene leave it finite for ever.
#[test]
fn it_never_blows_up() {
    for (speed, frequency, damping, cell) in
        [(50.0, 10.0, 0.0, 0.01), (500.0, 0.1, 2.0, 0.02), (0.0, 30.0, 0.5, 4.0), (10.0, 0.0, 1.0, 0.05), (10.0, 0.05, 0.0, 0.05)]
    {
        let co = HarmonicCoefficients::new(speed, frequency, damping, 1.0, cell, 1.0 / 30.0);
        let mut waves = Waves::new(16);
        let mut seed = 1u32;
        for _ in 0..3000 {
            let wind: Vec<[f32; 2]> = (0..256)
                .map(|_| {
                    seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    [(seed >> 8) as f32 / 1e6 - 8.0, (seed >> 16) as f32 / 4e3 - 8.0]
                })
                .collect();
            waves.step(&co, &wind);
        }
        let most = waves.now.iter().flatten().fold(0.0f32, |most, part| most.max(part.abs()));
        println!("{speed} m/s, {frequency} Hz: {most:.1}");
        assert!(waves.now.iter().flatten().all(|part| part.is_finite()) && most < 1e4, "{most}");
    }
}

fn axes(yaw: f32, pitch: f32) -> Axes {
    let ((sy, cy), (sp, cp)) = (yaw.sin_cos(), pitch.sin_cos());
    Axes { right: [cy, 0.0, sy], up: [sy * sp, cp, -cy * sp], forward: [-sy * cp, sp, cy * cp] }
}

#[test]
fn no_view_makes_motion_more_or_less() {
    let (plane, velocity) = (axes(0.4, 0.2), [1.7f32, -0.6]);
    let size = velocity[0].hypot(velocity[1]);
    for k in 0..200 {
        let camera = axes(0.37 * k as f32, (0.61 * k as f32).sin());
        let [x, y, z] = seen(velocity, &plane, &camera);
        assert!(((x * x + y * y + z * z).sqrt() - size).abs() < 1e-5);
    }
    assert_eq!(seen(velocity, &plane, &plane).map(|part| (part * 1e5).round()), [1.7e5, -6e4, 0.0]);
    // The paper's eq. 2 with an angle of 45 degrees, for comparison: both components get W_x and W_z with the same sign.
    let (w, c) = ([1.7f32, -0.6, 1.0], std::f32::consts::FRAC_1_SQRT_2);
    let printed = [w[0] * c + w[2] * c, w[1], w[0] * c + w[2] * c];
    let was = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
    assert!((printed.iter().map(|part| part * part).sum::<f32>().sqrt() - was).abs() > 0.5, "control");
}

#[test]
fn the_layer_that_the_wind_meets_first_shows_the_present() {
    let depths = [0.0, 0.5, 1.0, 2.0];
    for away in [-4.0, -0.3, 0.0, 0.3, 4.0] {
        let found = lags(&depths, away);
        assert!(found.iter().all(|lag| (0.0..=3.0).contains(lag)) && found.contains(&0.0), "{away}: {found:?}");
        let sorted = found.windows(2).all(|pair| if away >= 0.0 { pair[0] <= pair[1] } else { pair[0] >= pair[1] });
        assert!(sorted, "{away}: {found:?}");
    }
    assert!(lags(&depths, 0.0).iter().all(|lag| *lag == 0.0));
}

/// Whatever the wind does, from wherever plants are seen: no lag that is shown runs faster than half a second a second.
#[test]
fn lags_change_slowly() {
    let depths = [0.0, 0.4, 0.9, 1.5, 2.2];
    let worst = |dt: f32, follow: &dyn Fn([f32; 2], [f32; 2]) -> [f32; 2]| {
        let mut drift = [3.0, 0.0];
        let mut worst = 0.0_f32;
        for step in 0..2000 {
            // Calm, gales, and storms that turn round at once.
            let wind = match step / 100 % 5 {
                0 => [0.0, 0.0],
                1 => [14.0, -3.0],
                2 => [-14.0, 3.0],
                3 => [0.4, 0.1],
                _ => [(step % 7) as f32 - 3.0, (step % 5) as f32 - 2.0],
            };
            let next = follow(drift, wind);
            for view in 0..16 {
                let (sine, cosine) = (0.39 * view as f32).sin_cos();
                let of = |drift: [f32; 2]| lags(&depths, drift[0] * cosine + drift[1] * sine);
                for (before, after) in of(drift).iter().zip(of(next)) {
                    worst = worst.max((after - before).abs() / dt);
                }
            }
            drift = next;
        }
        worst
    };
    let found = worst(DT, &|drift, wind| drifted(drift, wind, 2.2, DT));
    println!("{found:.3} s/s");
    assert!(found <= 0.5 + 1e-3, "{found}");
    let low_passed = worst(DT, &|drift, wind| [0, 1].map(|axis: usize| drift[axis] + (wind[axis] - drift[axis]) * DT / 2.0));
    assert!(low_passed > 1.0, "control: {low_passed}");
    // It arrives.
    let mut drift = [0.0; 2];
    (0..12_000).for_each(|_| drift = drifted(drift, [3.0, -1.0], 2.2, DT));
    assert!((drift[0] - 3.0).abs() < 1e-2 && (drift[1] + 1.0).abs() < 1e-2, "{drift:?}");
}

/// The ring gives back what was noted, at any rate of steps: exactly at notes, between them in a straight line.
#[test]
fn the_ring_remembers() {
    for rate in [30.0, 60.0, 100.0, 144.0, 1000.0] {
        let ring = Ring::new(1.0 / rate);
        let mut notes = vec![0.0_f64; ring.notes as usize];
        let steps = (4.0 * rate) as u64;
        for step in 1..=steps {
            notes[ring.present(step) as usize] = step as f64;
            let known = (1.5 * rate).min(step as f64) as u64;
            for ago in
                [0.0, 0.3, 1.0, 2.5, 0.4 * rate, 1.37 * rate].into_iter().filter(|ago| *ago < known as f64 - 2.0 * f64::from(ring.every))
            {
                let moment = ring.moment(step, ago as f32);
                let [younger, older] = moment.notes.map(|note| notes[note as usize]);
                let found = younger + (older - younger) * f64::from(moment.share);
                assert!((found - (step as f64 - ago)).abs() < 1e-3, "{rate}/s, step {step}, {ago} steps ago: {found}");
            }
        }
        let oldest = ring.moment(steps, 1e6);
        assert!(oldest.share <= 1.0 && notes[oldest.notes[1] as usize] <= steps as f64 - 1.4 * rate, "{rate}: {oldest:?}");
        assert!(f64::from(ring.notes) / rate * f64::from(ring.every) < 2.0, "{rate}: {ring:?}");
    }
}

#[test]
fn roots_keep_their_place_and_far_layers_move_less() {
    let warp = |depth: f32, rigidity: f32| Warp::new([3.0, 3.0, 1.5], 0.5, depth, rigidity);
    let velocity = [4.0, 1.0, -2.0];
    assert_eq!(offset(&warp(1.0, 2.0), velocity, 0.0), [0.0, 0.0]);
    let (top, middle) = (offset(&warp(1.0, 2.0), velocity, 1.0), offset(&warp(1.0, 2.0), velocity, 0.5));
    assert!((top[0] - 0.5 * 3.0 * 4.0 / 60.0).abs() < 1e-6 && (top[1] - 0.5 * (3.0 - 3.0) / 60.0).abs() < 1e-6, "{top:?}");
    assert!((middle[0] / top[0] - 0.25).abs() < 1e-5);
    assert_eq!(offset(&warp(1.0, 0.0), velocity, 0.0), top);
    assert!((offset(&warp(0.0, 2.0), velocity, 1.0)[0] / top[0] - 2.0).abs() < 1e-5);
}
