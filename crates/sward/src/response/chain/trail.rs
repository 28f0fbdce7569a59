//! How late the tip of a blade follows its foot, of the full chain about upright. f64, + − × ÷ √ only.
//!
//! Not from a paper. What bends the foot of a blade, as a body does, leaves the tip behind: it follows by its own elasticity. Segments of small tilt
//! from upright obey A θ̈ + β K_s θ̇ + K θ = 0 (see `modes`; β as in `full`), the foot's tilt being given. The simplified chain knows nothing of
//! this: none of its segments feels how those below it speed up.

use super::blade::{Blade, MOST_SEGMENTS, calibrate};
use super::error::ChainError;
use super::modes::{Square, cholesky, first_mode, inertia, solved, springs, weight_lever};
use crate::math;

/// Steps in a swing of the first mode.
const STEPS: u32 = 4000;
/// Time in which the foot is turned over, in swings. Between a fiftieth and a quarter of one the tip is as late.
const PRESS: f64 = 0.05;

/// Tilts of the segments, rad.
type Tilts = [f64; MOST_SEGMENTS];

/// The foot of a blade over time, and how much later the tip is half-way.
#[derive(Clone, Debug, PartialEq)]
pub struct Trail {
    /// Time between two of the samples below, s.
    pub dt: f64,
    /// Tilt of the lowest segment over its largest.
    pub foot: Vec<f64>,
    /// Time by which the uppermost segment is later half-way than the lowest, s.
    pub lag: f64,
}

/// The blade as a linear system.
struct Linear {
    n: usize,
    inertia: Square,
    springs: Square,
    whole: Square,
    /// Of the inertia without the foot, and with it.
    factors: [Square; 2],
    beta: f64,
    period: f64,
}

/// A matrix without its first row and column.
fn without_foot(a: &Square, n: usize) -> Square {
    let mut inner = [[0.0; MOST_SEGMENTS]; MOST_SEGMENTS];
    for i in 1..n {
        inner[i - 1][..n - 1].copy_from_slice(&a[i][1..n]);
    }
    inner
}

impl Linear {
    fn of(blade: &Blade) -> Result<Self, ChainError> {
        calibrate(blade)?;
        let n = blade.segments as usize;
        let mode = first_mode(blade).ok_or(ChainError::Buckles)?;
        let (inertia, springs) = (inertia(blade), springs(blade));
        let mut whole = springs;
        for j in 0..n {
            whole[j][j] -= weight_lever(blade, j);
        }
        let inner = cholesky(&without_foot(&inertia, n), n - 1).ok_or(ChainError::Buckles)?;
        let factors = [inner, cholesky(&inertia, n).ok_or(ChainError::Buckles)?];
        let omega = std::f64::consts::TAU * mode.frequency;
        let beta = 2.0 * blade.damping_ratio / (omega * mode.spring_share);
        Ok(Self { n, inertia, springs, whole, factors, beta, period: 1.0 / mode.frequency })
    }

    /// Second derivatives of the tilts; that of the foot is `given` where it does not swing freely.
    fn pulled(&self, tilts: &Tilts, rates: &Tilts, given: Option<f64>) -> Tilts {
        let mut force = [0.0; MOST_SEGMENTS];
        for i in 0..self.n {
            for j in 0..self.n {
                force[i] -= self.whole[i][j] * tilts[j] + self.beta * self.springs[i][j] * rates[j];
            }
            force[i] -= self.inertia[i][0] * given.unwrap_or(0.0);
        }
        let Some(given) = given else { return solved(&self.factors[1], self.n, &force) };
        force.rotate_left(1);
        let mut found = solved(&self.factors[0], self.n - 1, &force);
        found.rotate_right(1);
        found[0] = given;
        found
    }

    /// Tilts and rates `h` later, by Runge and Kutta; the second derivative of the foot is given at the start, the middle and the end.
    fn later(&self, tilts: &mut Tilts, rates: &mut Tilts, given: Option<[f64; 3]>, h: f64) {
        let moved = |base: &Tilts, s: f64, by: &Tilts| std::array::from_fn(|i| base[i] + s * by[i]);
        let at = |k: usize| given.map(|given| given[k]);
        let r1 = *rates;
        let a1 = self.pulled(tilts, &r1, at(0));
        let r2 = moved(rates, 0.5 * h, &a1);
        let a2 = self.pulled(&moved(tilts, 0.5 * h, &r1), &r2, at(1));
        let r3 = moved(rates, 0.5 * h, &a2);
        let a3 = self.pulled(&moved(tilts, 0.5 * h, &r2), &r3, at(1));
        let r4 = moved(rates, h, &a3);
        let a4 = self.pulled(&moved(tilts, h, &r3), &r4, at(2));
        for i in 0..self.n {
            tilts[i] += h / 6.0 * (r1[i] + 2.0 * r2[i] + 2.0 * r3[i] + r4[i]);
            rates[i] += h / 6.0 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
        }
    }

    /// Tilts at rest with the foot at 1.
    fn held(&self) -> Option<Tilts> {
        let mut force: Tilts = std::array::from_fn(|i| if i < self.n { -self.whole[i][0] } else { 0.0 });
        force.rotate_left(1);
        let mut tilts = solved(&cholesky(&without_foot(&self.whole, self.n), self.n - 1)?, self.n - 1, &force);
        tilts.rotate_right(1);
        tilts[0] = 1.0;
        Some(tilts)
    }

    /// Second derivative at a time \[s\] of ½ − ½ cos(πt/T), with T of `press` swings, 1/s².
    fn turned(&self, press: f64, time: f64) -> f64 {
        let rate = std::f64::consts::PI / (press * self.period);
        0.5 * rate * rate * math::sin_cos_f64(rate * time).1
    }

    /// Two swings, and how much later than the foot the tip has gone half-way from `from` to `to`; `press` is the time in swings in which the foot is
    /// turned over, if it does not swing freely.
    fn run(&self, mut tilts: Tilts, [from, to]: [&Tilts; 2], press: Option<f64>) -> Trail {
        let (dt, tip) = (self.period / f64::from(STEPS), self.n - 1);
        let mut rates = [0.0; MOST_SEGMENTS];
        let mut trail = Trail { dt, foot: vec![tilts[0]], lag: 0.0 };
        let share = |tilts: &Tilts, i: usize| (tilts[i] - from[i]) / (to[i] - from[i]);
        let mut passed = [None; 2];
        for step in 0..2 * STEPS {
            let before = [0, tip].map(|i| share(&tilts, i));
            let time = f64::from(step) * dt;
            let given = press.map(|press| {
                let pressing = f64::from(step) + 0.5 < press * f64::from(STEPS);
                [0.0, 0.5, 1.0].map(|share| if pressing { self.turned(press, time + share * dt) } else { 0.0 })
            });
            self.later(&mut tilts, &mut rates, given, dt);
            trail.foot.push(tilts[0]);
            for (k, i) in [0, tip].into_iter().enumerate() {
                let after = share(&tilts, i);
                if passed[k].is_none() && after >= 0.5 {
                    passed[k] = Some(time + dt * (0.5 - before[k]) / (after - before[k]));
                }
            }
        }
        if let [Some(foot), Some(tip)] = passed {
            trail.lag = tip - foot;
        }
        trail
    }
}

/// How a blade follows its foot: while something turns the foot over, and after it has let the foot go. `None` where it is all foot, one segment.
///
/// # Errors
/// A blade that cannot stand, or numbers out of range.
pub fn trails(blade: &Blade) -> Result<Option<[Trail; 2]>, ChainError> {
    let linear = Linear::of(blade)?;
    if linear.n < 2 {
        return Ok(None);
    }
    let (upright, held) = ([0.0; MOST_SEGMENTS], linear.held().ok_or(ChainError::Buckles)?);
    let bending = linear.run(upright, [&upright, &held], Some(PRESS));
    Ok(Some([bending, linear.run(held, [&held, &upright], None)]))
}
