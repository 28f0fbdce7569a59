//! The full chain against energy, statics and its own modes.

use super::{distance, species};
use sward::response::chain::{Blade, FullChain, UPRIGHT, first_mode};

/// Largest change of energy over 3 s of a large, skew motion, relative to the motion's own energy.
fn energy_drift(blade: &Blade) -> f64 {
    let mut chain = FullChain::new(blade, &UPRIGHT).unwrap();
    let rest = chain.energy();
    for i in 0..blade.segments as usize {
        let (tilt, yaw) = (0.3 + 0.25 * i as f64, 0.4 * i as f64);
        chain.directions[i] = [tilt.sin() * yaw.cos(), tilt.cos(), tilt.sin() * yaw.sin()];
        // Across the direction: round the vertical.
        chain.rates[i] = [-2.0 * chain.directions[i][2], 0.0, 2.0 * chain.directions[i][0]];
    }
    let start = chain.energy();
    let mut drift: f64 = 0.0;
    for _ in 0..18_000 {
        chain.step([0.0; 3], 1.0 / 6000.0);
        drift = drift.max((chain.energy() - start).abs());
    }
    drift / (start - rest)
}

#[test]
fn energy_stays_without_damping_and_drag() {
    for (name, mut blade) in species() {
        blade.drag = 0.0;
        let damped = energy_drift(&blade);
        blade.damping_ratio = 0.0;
        let free = energy_drift(&blade);
        println!("{name}: {free:.1e} of the energy comes or goes, damped {damped:.1e}");
        assert!(free < 1e-4, "{name}: {free:.1e}");
        assert!(damped > 0.1, "{name}: damping must show: {damped:.1e}");
    }
}

/// Where the tip rests in a steady wind along x \[m/s\]: moments about each joint, in the plane, by damped iteration.
fn at_rest(blade: &Blade, wind: f64, weight: f64) -> [f64; 3] {
    let (n, l) = (blade.segments as usize, blade.half_length);
    let drag = blade.drag * wind.powf(4.0 / 3.0);
    let mut tilt = vec![0.0f64; n];
    let places = |tilt: &[f64]| {
        let mut joints = vec![[0.0, 0.0]];
        for t in tilt {
            let last = joints[joints.len() - 1];
            joints.push([last[0] + 2.0 * l * t.sin(), last[1] + 2.0 * l * t.cos()]);
        }
        joints
    };
    for _ in 0..20_000 {
        let joints = places(&tilt);
        let mut below = 0.0;
        for i in 0..n {
            let mut moment = 0.0;
            for k in i..n {
                let centre = [0, 1].map(|axis| 0.5 * (joints[k][axis] + joints[k + 1][axis]) - joints[i][axis]);
                moment += centre[1] * drag + centre[0] * weight;
            }
            let wanted = below + moment / blade.stiffness(i);
            tilt[i] += 0.05 * (wanted - tilt[i]);
            below = tilt[i];
        }
    }
    let tip = places(&tilt)[n];
    [tip[0], tip[1], 0.0]
}

#[test]
fn a_steady_wind_leans_it_as_statics_says() {
    for (name, blade) in species() {
        let mut chain = FullChain::new(&blade, &UPRIGHT).unwrap();
        for _ in 0..60 * 15 {
            chain.step([5.0, 0.0, 0.0], 1.0 / 60.0);
        }
        let tip = chain.joints()[blade.segments as usize];
        let exact = at_rest(&blade, 5.0, blade.mass * 9.81);
        let light = at_rest(&blade, 5.0, 0.0);
        let error = distance(tip, exact) / exact[0];
        println!("{name}: tip {:.4} m in 5 m/s, off by {error:.1e}", tip[0]);
        assert!(error < 1e-3, "{name}: {tip:?}, statics {exact:?}");
        assert!(distance(tip, light) / exact[0] > 2e-3, "{name}: weight must show");
    }
}

/// Slower frequency of two rods end on end, Hz: the double pendulum of the textbook, upside down, from its own matrices.
fn two_rods(blade: &Blade) -> f64 {
    let (m, length) = (blade.mass, 2.0 * blade.half_length);
    let (a, b, d) = (4.0 / 3.0 * m * length * length, 0.5 * m * length * length, 1.0 / 3.0 * m * length * length);
    let weight = m * 9.81 * length;
    let (p, q, r) = (blade.stiffness(0) + blade.stiffness(1) - 1.5 * weight, -blade.stiffness(1), blade.stiffness(1) - 0.5 * weight);
    // det(K − λM) = 0, the smaller root.
    let (square, linear, constant) = (a * d - b * b, -(p * d + r * a - 2.0 * q * b), p * r - q * q);
    let lambda = (-linear - (linear * linear - 4.0 * square * constant).sqrt()) / (2.0 * square);
    lambda.sqrt() / std::f64::consts::TAU
}

#[test]
fn the_first_mode_of_two_rods_is_the_textbooks() {
    let (_, lawn) = species()[0];
    for mass in [1e-6, 1.25e-5, 3e-5] {
        let blade = Blade { mass, ..lawn };
        let (found, exact) = (first_mode(&blade).unwrap().frequency, two_rods(&blade));
        println!("{mass:e} kg: {found:.6} Hz, textbook {exact:.6} Hz");
        assert!((found / exact - 1.0).abs() < 1e-9);
        assert!((found / two_rods(&Blade { mass: mass * 1.001, ..lawn }) - 1.0).abs() > 1e-5, "a heavier blade must fail");
    }
    assert_eq!(first_mode(&Blade { mass: 1e-3, ..lawn }), None, "one that buckles has no first mode");
}

/// Frequency of the motion that starts in the first mode, Hz, from the times at which the tip passes upright.
fn measured(blade: &Blade, shape: &[f64]) -> f64 {
    let mut chain = FullChain::new(blade, &UPRIGHT).unwrap();
    for (direction, tilt) in chain.directions.iter_mut().zip(shape) {
        *direction = [(0.01 * tilt).sin(), (0.01 * tilt).cos(), 0.0];
    }
    let n = blade.segments as usize;
    let dt = 1e-3;
    let (mut passes, mut last) = (Vec::new(), chain.joints()[n][0]);
    for i in 1..20_000 {
        chain.step([0.0; 3], dt);
        let now = chain.joints()[n][0];
        if last * now < 0.0 {
            passes.push((f64::from(i) - now / (now - last)) * dt);
        }
        last = now;
        if passes.len() == 7 {
            break;
        }
    }
    3.0 / (passes[6] - passes[0])
}

#[test]
fn it_sways_at_the_frequency_of_its_first_mode() {
    for (name, mut blade) in species() {
        blade.drag = 0.0;
        blade.damping_ratio = 0.0;
        let mode = first_mode(&blade).unwrap();
        let found = measured(&blade, &mode.shape);
        println!("{name}: {:.4} Hz by the mode, {found:.4} Hz by the motion", mode.frequency);
        assert!((found / mode.frequency - 1.0).abs() < 1e-3, "{name}");
        blade.mass *= 1.02;
        assert!((found / first_mode(&blade).unwrap().frequency - 1.0).abs() > 1e-3, "{name}: a heavier blade must fail");
    }
}

/// What is left of the energy of the first mode after one of its periods.
fn left(blade: &Blade) -> f64 {
    let mode = first_mode(blade).unwrap();
    let mut chain = FullChain::new(blade, &UPRIGHT).unwrap();
    let rest = chain.energy();
    for (direction, tilt) in chain.directions.iter_mut().zip(&mode.shape) {
        *direction = [(0.02 * tilt).sin(), (0.02 * tilt).cos(), 0.0];
    }
    let start = chain.energy() - rest;
    let period = 1.0 / (mode.frequency * (1.0 - blade.damping_ratio * blade.damping_ratio).sqrt());
    for _ in 0..200 {
        chain.step([0.0; 3], period / 200.0);
    }
    (chain.energy() - rest) / start
}

#[test]
fn its_joints_damp_the_first_mode_by_the_ratio_asked_for() {
    for (name, mut blade) in species() {
        blade.drag = 0.0;
        let zeta = blade.damping_ratio;
        let found = left(&blade).ln();
        let exact = |zeta: f64| -2.0 * std::f64::consts::TAU * zeta / (1.0 - zeta * zeta).sqrt();
        println!("{name}: energy falls by e^{found:.3} in a period, by its damping ratio e^{:.3}", exact(zeta));
        assert!((found / exact(zeta) - 1.0).abs() < 0.02, "{name}");
        assert!((found / exact(zeta * 1.05) - 1.0).abs() > 0.02, "{name}: another ratio must fail");
    }
}
