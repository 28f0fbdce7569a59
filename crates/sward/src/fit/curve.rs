//! The curve of one mode, fitted: a damped swing, and a line on which it rides.
//!
//! x(t) = a C(t) + b ω S(t) + c + d t, with C and S of x'' + 2ζωx' + ω²x = 0 (methods §2). For given ω and ζ the rest is linear least squares;
//! what these leave is a function of ω and ζ alone (variable projection), and Levenberg's and Marquardt's method makes it least.

use crate::math::{exp_f64, ln_f64, sin_cos_f64};

/// A sample: time from the start of the window \[s\], value.
pub(super) type Point = [f64; 2];

/// Damping ratios that are looked for.
const RATIOS: [f64; 2] = [1e-4, 20.0];
/// Below this |1 − ζ²|ω²t² both cases of damping are one series.
const CRITICAL: f64 = 1e-3;
/// Step of the differences that slopes are taken from, of ln ω and ln ζ.
const NUDGE: f64 = 1e-6;
/// Most trials of a refinement.
const TRIALS: usize = 60;
/// Largest change of ln ω and ln ζ in one trial.
const STRIDE: f64 = 0.5;

/// How a mode swings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    /// ω, without damping, rad/s.
    pub(super) omega: f64,
    /// ζ.
    pub(super) zeta: f64,
}

impl Shape {
    /// How often it swings, damped, Hz; 0 where it creeps.
    pub(super) fn swings_at(&self) -> f64 {
        let share = 1.0 - self.zeta * self.zeta;
        if share > 0.0 { self.omega * share.sqrt() / std::f64::consts::TAU } else { 0.0 }
    }

    /// How far s of e^(st) is from that of another shape, as a share of its |s| = ω.
    pub(super) fn apart(&self, other: &Self) -> f64 {
        let turn = std::f64::consts::TAU * (self.swings_at() - other.swings_at());
        let decay = self.zeta * self.omega - other.zeta * other.omega;
        (turn * turn + decay * decay).sqrt() / other.omega
    }

    /// C and ωS at a time \[s\].
    fn at(&self, time: f64) -> [f64; 2] {
        let (gamma, own) = (self.zeta * self.omega, self.omega * time);
        let squared = (1.0 - self.zeta * self.zeta) * own * own;
        if squared.abs() < CRITICAL {
            let decay = exp_f64(-gamma * time);
            return [decay * (1.0 + squared * (squared / 24.0 - 0.5)), decay * own * (1.0 + squared * (squared / 120.0 - 1.0 / 6.0))];
        }
        let turn = squared.abs().sqrt();
        if squared > 0.0 {
            let ((sine, cosine), decay) = (sin_cos_f64(turn), exp_f64(-gamma * time));
            return [decay * cosine, decay * sine * own / turn];
        }
        // Both exponents negative, the slow rate without a difference that cancels.
        let fast = gamma * time + turn;
        let (slowly, quickly) = (exp_f64(-own * own / fast), exp_f64(-fast));
        [0.5 * (slowly + quickly), 0.5 * (slowly - quickly) * own / turn]
    }
}

/// The linear part for one shape.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    /// What is left of each sample.
    pub(super) left: Vec<f64>,
    /// Value at the start, velocity part, height and slope of the line: a, b, c, d of the curve.
    pub(super) parts: [f64; 4],
    /// Σ of the squares of what is left.
    pub(super) squares: f64,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Least squares for one shape, column by column made upright to those before; without `line` the rest is 0.
pub(super) fn solved(points: &[Point], shape: &Shape, line: bool) -> Solved {
    let mut columns: Vec<Vec<f64>> =
        if line { vec![vec![1.0; points.len()], points.iter().map(|[t, _]| *t).collect()] } else { Vec::new() };
    let swing: Vec<[f64; 2]> = points.iter().map(|[t, _]| shape.at(*t)).collect();
    columns.extend([0, 1].map(|part| swing.iter().map(|both| both[part]).collect()));
    let count = columns.len();
    let mut left: Vec<f64> = points.iter().map(|[_, value]| *value).collect();
    let (mut rise, mut along) = ([[0.0; 4]; 4], [0.0; 4]);
    for j in 0..count {
        let (before, rest) = columns.split_at_mut(j);
        let column = &mut rest[0];
        let size = dot(column, column).sqrt();
        for (i, other) in before.iter().enumerate() {
            rise[i][j] = dot(other, column);
            column.iter_mut().zip(other).for_each(|(value, unit)| *value -= rise[i][j] * unit);
        }
        let own = dot(column, column).sqrt();
        // A column that says nothing new has no part.
        if own > 1e-9 * size {
            rise[j][j] = own;
            column.iter_mut().for_each(|value| *value /= own);
            along[j] = dot(column, &left);
            left.iter_mut().zip(column.iter()).for_each(|(value, unit)| *value -= along[j] * unit);
        } else {
            column.iter_mut().for_each(|value| *value = 0.0);
        }
    }
    let mut found = [0.0; 4];
    for j in (0..count).rev() {
        let others: f64 = (j + 1..count).map(|k| rise[j][k] * found[k]).sum();
        found[j] = if rise[j][j] > 0.0 { (along[j] - others) / rise[j][j] } else { 0.0 };
    }
    let parts = if line { [found[2], found[3], found[0], found[1]] } else { [found[0], found[1], 0.0, 0.0] };
    let squares = dot(&left, &left);
    Solved { left, parts, squares }
}

/// The shape near `start` that leaves least, its frequency within `octaves` of it either way.
pub(super) fn refined(points: &[Point], start: Shape, octaves: f64, line: bool) -> (Shape, Solved) {
    let middle = ln_f64(start.omega);
    let (low, high) =
        ([middle - octaves * std::f64::consts::LN_2, ln_f64(RATIOS[0])], [middle + octaves * std::f64::consts::LN_2, ln_f64(RATIOS[1])]);
    let shape_of = |place: [f64; 2]| Shape { omega: exp_f64(place[0]), zeta: exp_f64(place[1]) };
    let mut place = [middle, ln_f64(start.zeta)];
    let mut best = solved(points, &start, line);
    let mut damping = 1e-3;
    let mut slopes = None;
    for _ in 0..TRIALS {
        let [down, across] = slopes.get_or_insert_with(|| {
            [0, 1].map(|axis: usize| {
                let mut aside = place;
                aside[axis] += NUDGE;
                let moved = solved(points, &shape_of(aside), line).left;
                moved.iter().zip(&best.left).map(|(moved, left)| (moved - left) / NUDGE).collect::<Vec<f64>>()
            })
        });
        let (aa, ab, bb) = (dot(down, down) * (1.0 + damping), dot(down, across), dot(across, across) * (1.0 + damping));
        let (ar, br) = (dot(down, &best.left), dot(across, &best.left));
        let determinant = aa * bb - ab * ab;
        if determinant.is_nan() || determinant <= 0.0 {
            break;
        }
        let step = [(ab * br - bb * ar) / determinant, (ab * ar - aa * br) / determinant];
        let trial = [0, 1].map(|axis: usize| (place[axis] + step[axis].clamp(-STRIDE, STRIDE)).clamp(low[axis], high[axis]));
        let found = solved(points, &shape_of(trial), line);
        let moved = (trial[0] - place[0]).abs() + (trial[1] - place[1]).abs();
        if found.squares < best.squares {
            (place, best, slopes, damping) = (trial, found, None, damping * 0.2);
        } else {
            damping *= 6.0;
        }
        if moved < 1e-9 {
            break;
        }
    }
    (shape_of(place), best)
}

/// R²: the share that the swing explains of what moves about the line.
pub(super) fn explained(points: &[Point], solved: &Solved) -> f64 {
    let [_, _, height, slope] = solved.parts;
    let swinging: Vec<f64> = points.iter().map(|[t, value]| value - height - slope * t).collect();
    let mean = swinging.iter().sum::<f64>() / swinging.len().max(1) as f64;
    let whole: f64 = swinging.iter().map(|value| (value - mean) * (value - mean)).sum();
    if whole > 0.0 { 1.0 - solved.squares / whole } else { 0.0 }
}
