//! The closed form of an oscillator against integration.

use sward::response::oscillation::advance;

/// Runge–Kutta of fourth order on x'' + 2γx' + ω₀²x = 0.
fn integrated(start: [f64; 2], gamma: f64, omega_squared: f64, tau: f64) -> [f64; 2] {
    let fastest = 2.0 * gamma + omega_squared.sqrt();
    let count = (tau * fastest * 60.0) as u32 + 200;
    let h = tau / f64::from(count);
    let slope = |[x, v]: [f64; 2]| [v, -2.0 * gamma * v - omega_squared * x];
    let along = |s: [f64; 2], by: [f64; 2], h: f64| [s[0] + h * by[0], s[1] + h * by[1]];
    let mut s = start;
    for _ in 0..count {
        let a = slope(s);
        let b = slope(along(s, a, 0.5 * h));
        let c = slope(along(s, b, 0.5 * h));
        let d = slope(along(s, c, h));
        s = [0, 1].map(|k| s[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
    }
    s
}

/// Largest difference from integration, relative to what the start could grow to, over damping ratios, times and starts.
fn worst(ratios: &[f64], form: impl Fn([f64; 2], f64, f64, f64) -> [f64; 2]) -> f64 {
    let mut worst: f64 = 0.0;
    let mut count = 0;
    for omega in [1.0, 6.3, 40.0] {
        for ratio in ratios {
            for phase in [0.0, 0.05, 0.3, 1.0, 3.0, 6.0] {
                for start in [[1.0, 0.0], [0.0, omega], [-0.5, 2.0 * omega], [0.3, -omega]] {
                    // The numbers the f32 form is really given.
                    let (gamma, squared, tau) = ((ratio * omega) as f32, (omega * omega) as f32, (phase / omega) as f32);
                    let start = start.map(|s| f64::from(s as f32));
                    let exact = integrated(start, f64::from(gamma), f64::from(squared), f64::from(tau));
                    let found = form(start, f64::from(gamma), f64::from(squared), f64::from(tau));
                    let size = start[0].abs() + start[1].abs() / omega;
                    worst = worst.max((found[0] - exact[0]).abs() / size).max((found[1] - exact[1]).abs() / (size * omega));
                    count += 1;
                }
            }
        }
    }
    assert!(count >= 72);
    worst
}

fn ours([x, v]: [f64; 2], gamma: f64, squared: f64, tau: f64) -> [f64; 2] {
    advance(x as f32, v as f32, gamma as f32, squared as f32, tau as f32).map(f64::from)
}

const CASES: [(&str, &[f64]); 4] = [
    ("undamped", &[0.0]),
    ("underdamped", &[0.05, 0.2, 0.5, 0.9]),
    ("critical", &[0.99, 0.999, 0.9999, 0.999_999, 1.0, 1.000_001, 1.0001, 1.001, 1.01]),
    ("overdamped", &[1.1, 1.5, 2.5, 5.0, 20.0]),
];

#[test]
fn the_closed_form_is_the_equation_in_all_cases() {
    for (case, ratios) in CASES {
        let error = worst(ratios, ours);
        println!("{case}: {error:.2e}");
        assert!(error <= 1e-6, "{case}: {error:.2e}");
    }
}

#[test]
fn a_start_without_its_velocity_or_a_wrong_case_would_show() {
    let still = |[x, _]: [f64; 2], gamma, squared, tau| ours([x, 0.0], gamma, squared, tau);
    let undamped = |start, _, squared, tau| ours(start, 0.0, squared, tau);
    for (case, ratios) in &CASES[1..] {
        assert!(worst(ratios, still) > 1e-3, "{case}");
        assert!(worst(ratios, undamped) > 1e-3, "{case}");
    }
}

#[test]
fn nothing_jumps_at_the_critical_point() {
    // Over the border between cosine and hyperbolic cosine, and over both borders of the series.
    let jump = |squared: f64, apart: f64| {
        let at = |squared: f64| advance(0.7, -3.0, 10.0, squared as f32, 0.1);
        let (below, above) = (at(squared * (1.0 - apart)), at(squared * (1.0 + apart)));
        f64::from((below[0] - above[0]).abs()).max(f64::from((below[1] - above[1]).abs()) * 0.1)
    };
    for squared in [99.0, 100.0, 101.0] {
        assert!(jump(squared, 1e-6) < 2e-6, "{squared}: {:.2e}", jump(squared, 1e-6));
        assert!(jump(squared, 1e-2) > 1e-4, "the comparison must notice a real change");
    }
}

#[test]
fn every_number_gives_a_finite_answer() {
    let odd = [0.0, -0.0, 1.0, -1.0, 1e-30, 1e30, -1e30, f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
    let mut count = 0;
    for x in odd {
        for v in odd {
            for gamma in odd {
                for squared in odd {
                    for tau in odd {
                        let found = advance(x, v, gamma, squared, tau);
                        assert!(found.iter().all(|f| f.is_finite()), "{x} {v} {gamma} {squared} {tau}: {found:?}");
                        count += 1;
                    }
                }
            }
        }
    }
    assert_eq!(count, 161_051);
}
