//! The least tilt under a body against the article's formula, against a search, and against itself next door.

use sward::response::oscillator::least_tilt;

/// θ₀(d) of the article for radius 1 m, half-height h₀ and a body on the ground.
fn article(share: f64, half: f64) -> f64 {
    std::f64::consts::FRAC_PI_2 - (2.0 * half * share).atan2(1.0 - share * share)
}

/// What the article's lower surface would give with the sign it prints: the upper one.
fn misprinted(share: f64, half: f64) -> f64 {
    std::f64::consts::FRAC_PI_2 - (2.0 * half * share).atan2(share * share - 1.0)
}

/// The least tilt found by trying: a rod in f64, point by point.
fn tried(share: f64, clearance: f64, half: f64, rod: f64) -> f64 {
    let inside = |tilt: f64| {
        (0..=4000).any(|k| {
            let along = rod * f64::from(k) / 4000.0;
            let (x, y) = (share + along * tilt.sin(), -(half + clearance) + along * tilt.cos());
            x * x + y * y / (half * half) < 1.0 - 1e-9
        })
    };
    let clear = |k: &u32| !inside(f64::from(*k) * 1e-3);
    f64::from((0..=1571).find(clear).unwrap_or(1571)) * 1e-3
}

#[test]
fn for_long_rods_on_the_ground_it_is_the_articles() {
    let (mut worst, mut control): (f64, f64) = (0.0, 0.0);
    for half in [0.1, 0.3, 1.0, 3.0] {
        for k in 1..100 {
            let share = f64::from(k) / 100.0;
            let ours = f64::from(least_tilt(share as f32, 0.0, 1.0, half as f32, 100.0));
            worst = worst.max((ours - article(share, half)).abs());
            control = control.max((ours - misprinted(share, half)).abs());
        }
        // In the very middle a rod that all but lies touches the body within f32's rounding.
        assert!((f64::from(least_tilt(0.0, 0.0, 1.0, half as f32, 100.0)) - std::f64::consts::FRAC_PI_2).abs() < 1e-3);
        assert_eq!(least_tilt(1.0, 0.0, 1.0, half as f32, 100.0), 0.0);
    }
    println!("least tilt against the article: {worst:.1e} rad; as misprinted {control:.2}");
    assert!(worst < 1e-5, "{worst}");
    assert!(control > 1.0, "{control}");
}

#[test]
fn short_rods_and_raised_bodies_are_as_a_search_finds_them() {
    let (mut worst, mut control, mut cases): (f64, f64, u32) = (0.0, 0.0, 0);
    for half in [0.2, 0.5, 1.5] {
        for clearance in [0.0, 0.05, 0.2, 0.4] {
            for rod in [0.1, 0.3, 0.6, 1.2] {
                for share in [0.02, 0.2, 0.45, 0.7, 0.9, 0.98] {
                    let ours = f64::from(least_tilt(share as f32, clearance as f32, 1.0, half as f32, rod as f32));
                    let found = tried(share, clearance, half, rod);
                    worst = worst.max((ours - found).abs());
                    control = control.max((article(share, half) - found).abs());
                    cases += 1;
                }
            }
        }
    }
    println!("least tilt against a search in {cases} cases: {worst:.4} rad; the article's for long rods {control:.2}");
    assert!(worst < 2e-3, "{worst}");
    assert!(control > 0.5, "{control}");
}

/// Largest change of a tilt over 1/1000 of the way from the middle to the rim, from the ground up, and over the length of rods.
fn steepest(tilt: impl Fn(f32, f32, f32) -> f32) -> f32 {
    let mut steepest: f32 = 0.0;
    for (clearance, rod) in [(0.0, 0.4), (0.1, 0.4), (0.2, 1.0), (0.0, 0.05)] {
        for k in 0..1100 {
            let at = |k: i32| tilt(k as f32 / 1000.0, clearance, rod);
            steepest = steepest.max((at(k + 1) - at(k)).abs());
        }
    }
    for k in 0..1000 {
        let raised = |k: i32| tilt(0.5, k as f32 / 2000.0, 0.4);
        let longer = |k: i32| tilt(0.5, 0.1, 0.05 + k as f32 / 1000.0);
        steepest = steepest.max((raised(k + 1) - raised(k)).abs()).max((longer(k + 1) - longer(k)).abs());
    }
    steepest
}

#[test]
fn it_is_continuous_everywhere() {
    let ours = steepest(|share, clearance, rod| least_tilt(share, clearance, 1.0, 0.5, rod));
    // The plain rule: the tangent wherever the upright rod is inside.
    let plain = steepest(
        |share, clearance, rod| if least_tilt(share, clearance, 1.0, 0.5, rod) > 0.0 { article(f64::from(share), 0.5) as f32 } else { 0.0 },
    );
    println!("steepest per thousandth: {ours:.3} rad; plain rule {plain:.2}");
    // A tip just touched from above leaves sideways: a root, √(2·0.5 mm/0.4 m) = 0.05 at its very beginning.
    assert!(ours < 0.1, "{ours}");
    assert!(plain > 0.5, "{plain}");
}
