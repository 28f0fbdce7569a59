//! A chain of one segment is a pendulum upside down: (4/3) m l² θ'' = −kθ − cθ' + m g l sin θ.

use super::{blade, coefficients, distance, tip};
use sward::response::chain::{Blade, ChainState, FullChain, UPRIGHT, step};

/// Tilt over time: Runge–Kutta of fourth order, 20 substeps per entry.
fn pendulum(blade: &Blade, start: f64, dt: f64, count: usize) -> Vec<f64> {
    let l = blade.half_length;
    let inertia = 4.0 / 3.0 * blade.mass * l * l;
    let weight = blade.mass * 9.81 * l;
    let omega = ((blade.stiffness(0) - weight) / inertia).sqrt();
    let damping = 2.0 * blade.damping_ratio * omega;
    let slope = |[x, v]: [f64; 2]| [v, (-blade.stiffness(0) * x + weight * x.sin()) / inertia - damping * v];
    let along = |s: [f64; 2], by: [f64; 2], h: f64| [s[0] + h * by[0], s[1] + h * by[1]];
    let mut s = [start, 0.0];
    let h = dt / 20.0;
    let next = |_: usize| {
        for _ in 0..20 {
            let a = slope(s);
            let b = slope(along(s, a, 0.5 * h));
            let c = slope(along(s, b, 0.5 * h));
            let d = slope(along(s, c, h));
            s = [0, 1].map(|k| s[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
        }
        s[0]
    };
    (0..count).map(next).collect()
}

/// A blade whose weight matters: half of what the spring holds.
fn heavy() -> Blade {
    let mut blade = blade(1, 0.2, 2e-3, [8e-3, 8e-3], 0.05, 0.0);
    blade.drag = 0.0;
    blade
}

/// Largest distance of the tip from the pendulum's over 5 s, in lengths, for the full chain and for the simplified one.
fn apart(blade: &Blade, oracle: &Blade, start: f64, dt: f64) -> [f64; 2] {
    let count = (5.0 / dt) as usize;
    let mut full = FullChain::new(blade, &UPRIGHT).unwrap();
    full.directions[0] = [start.sin(), start.cos(), 0.0];
    let co = coefficients(blade);
    let mut state = ChainState::default();
    state.joints[0][1] = start as f32;
    let mut worst = [0.0f64; 2];
    for angle in pendulum(oracle, start, dt, count) {
        let length = blade.length();
        let exact = [length * angle.sin(), length * angle.cos(), 0.0];
        full.step([0.0; 3], dt);
        state = step(&co, &UPRIGHT, 0.0, [0.0; 3], dt as f32, &state);
        worst[0] = worst[0].max(distance(full.joints()[1], exact) / length);
        worst[1] = worst[1].max(distance(tip(&co, &UPRIGHT, &state), exact) / length);
    }
    worst
}

#[test]
fn one_segment_is_a_pendulum_small_and_large() {
    let blade = heavy();
    let mut lighter = blade;
    lighter.mass *= 0.97;
    for (start, dt, allowed) in [(0.01, 1.0 / 60.0, 1e-5), (0.6, 1.0 / 240.0, 2e-3), (1.4, 1.0 / 240.0, 2e-2)] {
        let [full, simplified] = apart(&blade, &blade, start, dt);
        println!("{start} rad: full {full:.1e}, simplified {simplified:.1e} of the length");
        assert!(full < 1e-5, "{start}: {full:.1e}");
        assert!(simplified < allowed, "{start}: {simplified:.1e}");
        let control = apart(&blade, &lighter, start, dt);
        assert!(control[0] > 1e-4 && control[1] > allowed, "a lighter pendulum must fail: {control:?}");
    }
}
