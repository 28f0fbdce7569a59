//! Frequency and damping ratio of a plant that was pulled and let go, or why it is not one mode.
//!
//! Not from a paper. A window is looked for after the release: of all starts within two swings the earliest that explains as much as the best one
//! does, since the first swing is still that of the rope, of all branches, and of large bends. Damping that grows with the swing is so measured
//! early, where there is most of it.

use super::curve::{Point, Shape, explained, refined};
use super::recording::Recording;
use super::window::{moving, settle, thinned, tone};

/// Longest window, in swings.
const LONGEST: f64 = 12.0;
/// Shortest window, in swings: fewer do not tell damping from drift.
pub const FEWEST_SWINGS: f64 = 2.5;
/// Latest start, in swings after the release.
const LATEST: f64 = 2.25;
/// Starts that are tried in a swing.
const STARTS: f64 = 30.0;
/// Samples kept of a swing.
const SAMPLES: f64 = 40.0;
/// R² by which a start may be worse than the best one.
const AS_GOOD: f64 = 0.001;
/// R² that one mode has at least.
pub const LEAST_EXPLAINED: f64 = 0.95;
/// R² from which what comes after the first swing is clear enough to be asked for its frequency.
const CLEAR: f64 = 0.8;
/// How far e^(st) may move after the first swing, as a share of |s|: one mode keeps frequency and damping ratio.
const SAME: f64 = 0.1;

/// A damped swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// Frequency without damping, as scenes give it, Hz. It swings at [`Swing::swings_at`].
    pub frequency: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Largest deviation of the curve at the start of the window, unit of the recording.
    pub amplitude: f64,
    /// Slope of the line on which it rides, unit of the recording per second.
    pub drift: f64,
    /// R²: share of what moves about that line that the curve explains.
    pub r_squared: f64,
    /// First and last moment of the window, s of the recording.
    pub window: [f64; 2],
}

impl Swing {
    /// How often it swings, damped, Hz; 0 where it creeps back.
    #[must_use]
    pub fn swings_at(&self) -> f64 {
        Shape { omega: std::f64::consts::TAU * self.frequency, zeta: self.damping_ratio }.swings_at()
    }

    /// Swings in the window.
    #[must_use]
    pub fn swings(&self) -> f64 {
        (self.window[1] - self.window[0]) * self.swings_at()
    }
}

/// Why a recording is not a single mode.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotOneMode {
    /// It does not move.
    #[error("nothing moves")]
    Still,
    /// It ends too soon.
    #[error("it does not swing {FEWEST_SWINGS} times after it is let go")]
    Short,
    /// Something else moves as well.
    #[error("the best single swing, at {frequency:.3} Hz, explains {:.1} % of the motion; one mode explains {:.0} %", 100.0 * r_squared, 100.0 * LEAST_EXPLAINED)]
    Unexplained {
        /// How often that swings, Hz.
        frequency: f64,
        /// Its R².
        r_squared: f64,
    },
    /// It does not keep its frequency.
    #[error(
        "it swings at {:.3} Hz with a damping ratio of {:.2}, after the first swing at {:.3} Hz with {:.2}; one mode keeps both",
        early[0], early[1], late[0], late[1]
    )]
    Changing {
        /// How often it swings in the window \[Hz\], and the damping ratio.
        early: [f64; 2],
        /// The same after the first swing.
        late: [f64; 2],
    },
}

/// A window and what was found in it.
struct Tried {
    points: Vec<Point>,
    start: f64,
    shape: Shape,
    parts: [f64; 4],
    r_squared: f64,
}

/// A window of samples, the curve near `near` that suits it best.
fn tried(window: &[Point], near: Shape, octaves: f64) -> Tried {
    let start = window[0][0];
    let points: Vec<Point> = window.iter().map(|[time, value]| [time - start, *value]).collect();
    let (shape, solved) = refined(&points, near, octaves, true);
    let r_squared = explained(&points, &solved);
    Tried { points, start, shape, parts: solved.parts, r_squared }
}

/// The part of samples in order of time within \[from, to\].
fn between(points: &[Point], from: f64, to: f64) -> &[Point] {
    let first = points.partition_point(|point| point[0] < from);
    &points[first..points.partition_point(|point| point[0] <= to).max(first)]
}

/// About how often a plant swings that is let go at the first of some samples, Hz: after the first swing, if it still does so clearly.
fn usual(points: &[Point]) -> Option<f64> {
    let about = tone(points)?;
    let points = thinned(points, 1.0 / (SAMPLES * about));
    let later = between(&points, points[0][0] + 1.0 / about, f64::INFINITY);
    if later.len() < super::recording::FEWEST {
        return Some(about);
    }
    let one = tried(later, Shape { omega: std::f64::consts::TAU * about, zeta: 0.05 }, 0.5);
    let swings_at = one.shape.swings_at();
    Some(if one.r_squared >= CLEAR && swings_at > 0.5 * about { swings_at } else { about })
}

/// The windows of a plant let go at `gone` \[s\] that swings about `frequency` \[Hz\] long enough, by their start.
fn windows(points: &[Point], gone: f64, frequency: f64) -> Vec<Tried> {
    let mut found: Vec<Tried> = Vec::new();
    let mut near = Shape { omega: std::f64::consts::TAU * frequency, zeta: 0.05 };
    let mut next = gone;
    for [start, _] in between(points, gone, gone + LATEST / frequency) {
        let window = between(points, *start, start + LONGEST / frequency);
        if *start < next || window.len() < super::recording::FEWEST {
            continue;
        }
        next = start + 1.0 / (STARTS * frequency);
        let one = tried(window, near, 1.0);
        let span = one.points[one.points.len() - 1][0];
        if span * one.shape.swings_at() >= FEWEST_SWINGS {
            near.zeta = one.shape.zeta;
            found.push(one);
        }
    }
    found
}

/// How a plant that was pulled and let go swings.
///
/// ```
/// use sward::fit::{Recording, swing};
/// let times: Vec<f64> = (0..400).map(|k| 0.05 * f64::from(k)).collect();
/// let values = times.iter().map(|t| 0.3 * (-0.2 * t).exp() * (std::f64::consts::TAU * 0.5 * t).cos() + 0.1).collect();
/// let found = swing(&Recording::new(times, values)?)?;
/// assert!((found.swings_at() - 0.5).abs() < 1e-6 && (found.damping_ratio - 0.0635).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// What moves is not one damped mode, or not long enough to tell.
pub fn swing(recording: &Recording) -> Result<Swing, NotOneMode> {
    let (mut points, scale) = scaled(recording).ok_or(NotOneMode::Still)?;
    let slope = settle(&mut points);
    let [gone, last] = moving(&points).ok_or(NotOneMode::Still)?;
    // Half as long again as it moves much, for what is left then still tells damping.
    let enough = (last + (last - gone) / 2).max(gone + 2 * super::recording::FEWEST).min(points.len() - 1);
    let frequency = usual(&points[gone..=enough]).ok_or(NotOneMode::Short)?;
    // A recording that has its largest deviation within a swing begins with the release.
    let release = if points[gone][0] - points[0][0] < 1.0 / frequency { 0.0 } else { points[gone][0] };
    let found = windows(&thinned(&points, 1.0 / (SAMPLES * frequency)), release, frequency);
    let best = found.iter().fold(f64::NEG_INFINITY, |best, one| if one.r_squared > best { one.r_squared } else { best });
    let one = found.iter().find(|one| one.r_squared >= best - AS_GOOD).ok_or(NotOneMode::Short)?;
    judged(one)?;
    let [value, rate, _, drift] = one.parts;
    let (omega, zeta) = (one.shape.omega, one.shape.zeta);
    // The curve is e^(−γt) (value cos + sway sin).
    let sway = rate / (1.0 - zeta * zeta).sqrt();
    let from = recording.times()[0] + one.start;
    Ok(Swing {
        frequency: omega / std::f64::consts::TAU,
        damping_ratio: zeta,
        amplitude: (value * value + sway * sway).sqrt() * scale,
        drift: (drift + slope) * scale,
        r_squared: one.r_squared,
        window: [from, from + one.points[one.points.len() - 1][0]],
    })
}

/// The samples with time from the first one, and values from the first one over their largest; `None` where all are equal.
fn scaled(recording: &Recording) -> Option<(Vec<Point>, f64)> {
    let (times, values) = (recording.times(), recording.values());
    let (start, zero) = (times[0], values[0]);
    let scale = values.iter().fold(0.0, |most: f64, value| if (value - zero).abs() > most { (value - zero).abs() } else { most });
    let points = times.iter().zip(values).map(|(time, value)| [time - start, (value - zero) / scale]).collect();
    (scale > 0.0).then_some((points, scale))
}

/// Whether a window holds one mode.
fn judged(one: &Tried) -> Result<(), NotOneMode> {
    let frequency = one.shape.swings_at();
    if one.r_squared < LEAST_EXPLAINED {
        return Err(NotOneMode::Unexplained { frequency, r_squared: one.r_squared });
    }
    let later = between(&one.points, 1.0 / frequency, f64::INFINITY);
    if later.len() < super::recording::FEWEST {
        return Ok(());
    }
    let later = tried(later, one.shape, 1.0);
    if later.r_squared >= CLEAR && later.shape.apart(&one.shape) > SAME {
        let both = |shape: &Shape| [shape.swings_at(), shape.zeta];
        return Err(NotOneMode::Changing { early: both(&one.shape), late: both(&later.shape) });
    }
    Ok(())
}
