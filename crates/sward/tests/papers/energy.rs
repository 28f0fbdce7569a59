//! The scheme of eq. 5 loses energy and never gains it; a faster cap on the wave would.

use crate::common::{Dice, Torus};

const CELLS: usize = 32;

/// A random field in plane 0, at rest, of size 0.1; `smooth` has long waves only.
fn disturbed(text: &str, smooth: bool) -> Torus {
    let mut torus = Torus::new(text);
    let mut dice = Dice(7);
    let values: Vec<f32> = (0..CELLS * CELLS).map(|_| dice.between(-0.1, 0.1) as f32).collect();
    let turn = |k: usize| (k as f64 / CELLS as f64 * std::f64::consts::TAU).sin();
    torus.fill(|_, plane, i, j| match (plane, smooth) {
        (0, true) => (0.05 * (turn(i) + turn(2 * j + i) + turn(3 * j))) as f32,
        (0, false) => values[j * CELLS + i],
        _ => 0.0,
    });
    torus
}

/// Energy between the last two steps, of velocity v = β_{n+1} − β_n and stiffness K = r − C²∇², r what stands for κΔt²:
/// ½Σ(v² + β_{n+1} K β_n + λ β_n v), which the scheme multiplies by exactly 1 − λ. (Without its last part it may rise where v turns:
/// by −½Σ λ(v² + v v') from one step to the next.)
fn energy(torus: &Torus, spread: f64, restoring: f64, lambda: f64) -> f64 {
    let (after, before) = (torus.plane(0), &torus.cells.old[0][..CELLS * CELLS]);
    let at = |i: usize, j: usize| f64::from(before[(j % CELLS) * CELLS + i % CELLS]);
    let mut sum = 0.0;
    for j in 0..CELLS {
        for i in 0..CELLS {
            let (new, old) = (f64::from(after[j * CELLS + i]), at(i, j));
            let around = at(i + 1, j) + at(i + CELLS - 1, j) + at(i, j + 1) + at(i, j + CELLS - 1);
            let stiff = restoring * old - spread * (around - 4.0 * old);
            let velocity = new - old;
            sum += 0.5 * (velocity * velocity + new * stiff + lambda * old * velocity);
        }
    }
    sum
}

#[test]
fn staggered_energy_falls_by_exactly_lambda_a_step_and_never_rises() {
    for (kappa, lambda) in [(0.0, 0.05), (114.0, 0.12), (400.0, 0.05)] {
        let text = format!(
            "field: (patch_side: 8.0), stands: [(species: Meadow, cells: {CELLS}, response: Continuum(c0: 3.0, mu: 0.0,
             lambda_theta: {lambda:.2}, kappa: {kappa:.1}))]"
        );
        let spread = (3.0_f64 / 60.0 / 0.25).powi(2);
        for smooth in [true, false] {
            let mut torus = disturbed(&text, smooth);
            let restoring = f64::from(torus.stand.coefficients.restoring);
            torus.step();
            let mut before = energy(&torus, spread, restoring, lambda);
            let mut misses = 0;
            for step in 0..80 {
                assert_eq!(torus.step().clamped, 0);
                let now = energy(&torus, spread, restoring, lambda);
                assert!(now > 0.0 && (now / before - (1.0 - lambda)).abs() < 1e-4, "step {step}: {} for {lambda}", now / before);
                misses += u32::from((now / before - (1.0 - lambda * 1.1)).abs() < 1e-4);
                before = now;
            }
            assert_eq!(misses, 0, "control: another λ must not fit");
        }
    }
}

#[test]
fn the_cap_is_needed_and_the_undamped_one_blows_up() {
    for lambda in [0.05, 0.5, 0.9] {
        let grown = |cap: Option<f32>| {
            let text = format!(
                "field: (patch_side: 8.0), stands: [(species: Meadow, cells: {CELLS}, response: Continuum(c0: 10.0, mu: 0.0,
                 lambda_theta: {lambda:.2}, kappa: 0.0, kappa_omega: 100.0))]"
            );
            let mut torus = disturbed(&text, false);
            torus.cells.now[0].iter_mut().chain(torus.cells.old[0].iter_mut()).for_each(|value| *value *= 1e-5);
            torus.stand.coefficients.base_speed = 1e3;
            torus.stand.coefficients.speed_cap = cap.unwrap_or(torus.stand.coefficients.speed_cap);
            (0..240).for_each(|_| _ = torus.step());
            torus.largest()
        };
        let undamped = 0.25 * 60.0 * 0.5_f32.sqrt();
        let (ours, control) = (grown(None), grown(Some(undamped)));
        println!("λ {lambda}: largest bend {ours:.1e} under our cap, {control:.1e} under the undamped one");
        assert!(ours < 2e-6, "λ {lambda}: {ours}");
        assert!(control > 1.0, "control: λ {lambda}: {control}");
    }
}
