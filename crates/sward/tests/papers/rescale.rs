//! Eq. 4 lets the wave speed follow |ω|. Where |ω| swings, that pumps the wave like a child on a swing; the rescale stops it.

use crate::common::{Dice, Torus};

const CELLS: usize = 16;
const DT: f64 = 1.0 / 60.0;
const SPACING: f64 = 0.5;
const TEXT: &str = "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 16, response: Continuum(c0: 1.0, mu: 1.5,
    lambda_theta: 0.01, kappa: 0.0, kappa_omega: 0.0))]";

/// ω_x at a step: every plant swings at the same rate.
fn swing(step: i32, radians_per_second: f64) -> f64 {
    8.0 * (radians_per_second * f64::from(step) * DT).cos()
}

/// Bend as the paper prints it, in f64, with or without the rescale.
struct Paper {
    now: Vec<f64>,
    old: Vec<f64>,
    rescaled: bool,
}

impl Paper {
    fn step(&mut self, step: i32, pace: f64, cap: f64) {
        let speed = |step: i32| (1.0 + 1.5 * swing(step, pace).abs()).min(cap);
        let ratio = if self.rescaled { (speed(step) / speed(step - 1)).min(1.0) } else { 1.0 };
        let spread = (speed(step) * DT / SPACING).powi(2);
        let now = &self.now;
        let at = |i: usize, j: usize| now[(j % CELLS) * CELLS + i % CELLS];
        for j in 0..CELLS {
            for i in 0..CELLS {
                let here = at(i, j);
                let around = at(i + 1, j) + at(i + CELLS - 1, j) + at(i, j + 1) + at(i, j + CELLS - 1);
                let past = here - (here - self.old[j * CELLS + i]) * ratio;
                self.old[j * CELLS + i] = 1.99 * here - 0.99 * past + spread * (around - 4.0 * here);
            }
        }
        std::mem::swap(&mut self.now, &mut self.old);
    }

    fn largest(&self) -> f64 {
        self.now.iter().fold(0.0, |most, value| most.max(value.abs()))
    }
}

#[test]
fn a_speed_that_follows_omega_pumps_the_wave_only_without_the_rescale() {
    let mut dice = Dice(3);
    let start: Vec<f64> = (0..CELLS * CELLS).map(|_| f64::from(dice.between(-1e-3, 1e-3) as f32)).collect();
    let (mut pumped, mut kernel_most) = (0.0_f64, 0.0_f64);
    for pace in [5.0, 8.0, 12.0, 16.0, 24.0] {
        let mut torus = Torus::new(TEXT);
        let cap = f64::from(torus.stand.coefficients.speed_cap);
        torus.fill(|_, plane, i, j| if plane == 0 { start[j * CELLS + i] as f32 } else { 0.0 });
        let paper = |rescaled| Paper { now: start.clone(), old: start.clone(), rescaled };
        let (mut with, mut without) = (paper(true), paper(false));
        for step in 0..720 {
            let area = CELLS * CELLS;
            torus.cells.now[0][2 * area..3 * area].fill(swing(step, pace) as f32);
            torus.cells.old[0][2 * area..3 * area].fill(swing(step - 1, pace) as f32);
            torus.step();
            with.step(step, pace, cap);
            without.step(step, pace, cap);
            if step < 60 {
                let off = torus.plane(0).iter().zip(&with.now).fold(0.0_f64, |most, (a, b)| most.max((f64::from(*a) - b).abs()));
                assert!(off < 1e-6, "step {step}: the kernel is the scheme with the rescale, {off}");
            }
        }
        let kernel = torus.plane(0).iter().fold(0.0, |most: f64, value| most.max(f64::from(value.abs())));
        println!("{pace} rad/s: largest bend {kernel:.1e}, without the rescale {:.1e}", without.largest());
        pumped = pumped.max(without.largest());
        kernel_most = kernel_most.max(kernel);
    }
    assert!(kernel_most < 2e-3, "{kernel_most}");
    assert!(pumped > 1.0, "control: without the rescale energy must be pumped, {pumped}");
}
