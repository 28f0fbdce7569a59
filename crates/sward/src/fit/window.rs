//! Where in a recording a plant swings by itself, and about how often.

use super::curve::Point;
use crate::math::sin_cos_f64;

/// Share of the largest deviation that a held plant keeps.
const HELD: f64 = 0.9;
/// Share below which it has been let go.
const LET_GO: f64 = 0.5;
/// Share of the largest deviation that still counts as motion.
const MOVING: f64 = 0.05;
/// Most bins of the search for a frequency.
const BINS: usize = 512;
/// Decays that it tries, over the whole span, as exponents.
const DECAYS: [f64; 3] = [0.7, 2.5, 7.0];
/// Frequencies that it tries for each whole number of swings in the span.
const PER_SWING: usize = 3;

/// The middle one.
fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// The middle one of three.
fn middle_of(a: f64, b: f64, c: f64) -> f64 {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    if c < low {
        low
    } else if c > high {
        high
    } else {
        c
    }
}

/// Takes the line off on which a plant ends up, through the middles of the last two quarters; gives its slope.
pub(super) fn settle(points: &mut [Point]) -> f64 {
    let quarter = |k: usize| &points[k * points.len() / 4..(k + 1) * points.len() / 4];
    let middle = |part: &[Point], axis: usize| median(part.iter().map(|point| point[axis]).collect());
    let [early, late] = [2, 3].map(|k| [0, 1].map(|axis| middle(quarter(k), axis)));
    let slope = (late[1] - early[1]) / (late[0] - early[0]);
    points.iter_mut().for_each(|point| point[1] -= late[1] + slope * (point[0] - late[0]));
    slope
}

/// The sample at which a plant is let go, and the last at which it moves much; `None` where it never moves. One odd sample in a row does not count.
pub(super) fn moving(points: &[Point]) -> Option<[usize; 2]> {
    let (away, last) = (|at: usize| points[at][1].abs(), points.len() - 1);
    let calm = |at: usize| if at == 0 || at == last { away(at) } else { middle_of(away(at - 1), away(at), away(at + 1)) };
    let away: Vec<f64> = (0..=last).map(calm).collect();
    let most = away.iter().fold(0.0, |most: f64, value| if *value > most { *value } else { most });
    let first = away.iter().position(|value| *value >= HELD * most).filter(|_| most > 0.0)?;
    let held = away[first..].iter().take_while(|value| **value >= LET_GO * most);
    let gone = first + held.enumerate().filter(|(_, value)| **value >= HELD * most).map(|(at, _)| at).last().unwrap_or(0);
    let last = away.iter().rposition(|value| *value >= MOVING * most).unwrap_or(gone);
    Some([gone, last])
}

/// Means of the samples in each `width` \[s\]; samples farther apart stay as they are.
pub(super) fn thinned(points: &[Point], width: f64) -> Vec<Point> {
    let bin = |point: &Point| ((point[0] - points[0][0]) / width) as u64;
    let mean = |bin: &[Point]| [0, 1].map(|axis: usize| bin.iter().map(|point| point[axis]).sum::<f64>() / bin.len() as f64);
    points.chunk_by(|a, b| bin(a) == bin(b)).map(mean).collect()
}

/// About how often the samples swing, Hz: the frequency and decay whose swing explains most, by least squares on bins of equal length.
pub(super) fn tone(points: &[Point]) -> Option<f64> {
    let (start, span) = (points.first()?[0], points.last()?[0] - points.first()?[0]);
    let count = points.len().min(BINS);
    let mut bins = vec![[0.0; 2]; count];
    for [time, value] in points {
        let bin = &mut bins[((time - start) / span * (count - 1) as f64 + 0.5) as usize];
        *bin = [bin[0] + value, bin[1] + 1.0];
    }
    let filled = bins.iter().filter(|bin| bin[1] > 0.0).count() as f64;
    let mean = bins.iter().filter(|bin| bin[1] > 0.0).map(|bin| bin[0] / bin[1]).sum::<f64>() / filled;
    let values: Vec<Option<f64>> = bins.iter().map(|bin| (bin[1] > 0.0).then(|| bin[0] / bin[1] - mean)).collect();
    let mut best = (0.0, None);
    for decay in DECAYS {
        let shrink: Vec<f64> = (0..count).map(|k| crate::math::exp_f64(-decay * k as f64 / (count - 1) as f64)).collect();
        for number in PER_SWING..=count / 2 * PER_SWING {
            let swings = number as f64 / PER_SWING as f64;
            let gain = explained(&values, &shrink, swings);
            if gain > best.0 {
                best = (gain, Some(swings / span));
            }
        }
    }
    best.1
}

/// Σ of squares that `swings` decaying swings over all bins explain.
fn explained(values: &[Option<f64>], shrink: &[f64], swings: f64) -> f64 {
    let (turn_sine, turn_cosine) = sin_cos_f64(std::f64::consts::TAU * swings / (values.len() - 1) as f64);
    let (mut sine, mut cosine) = (0.0, 1.0);
    let (mut aa, mut ab, mut bb, mut ay, mut by) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (value, shrink) in values.iter().zip(shrink) {
        if let Some(value) = value {
            let (a, b) = (cosine * shrink, sine * shrink);
            (aa, ab, bb, ay, by) = (aa + a * a, ab + a * b, bb + b * b, ay + a * value, by + b * value);
        }
        (sine, cosine) = (sine * turn_cosine + cosine * turn_sine, cosine * turn_cosine - sine * turn_sine);
    }
    let determinant = aa * bb - ab * ab;
    if determinant > 1e-9 * aa * bb { (ay * ay * bb - 2.0 * ay * by * ab + by * by * aa) / determinant } else { 0.0 }
}
