//! Clocks, the speed of memory, and ratios that survive a noisy machine.

use std::hint::black_box;
use std::time::Instant;

use serde::Serialize;

/// Floats in each array of the triad: 64 MiB.
const TRIAD: usize = 1 << 24;

/// Seconds that some work takes, and what comes of it.
pub(crate) fn seconds<R>(work: impl FnOnce() -> R) -> (f64, R) {
    let begun = Instant::now();
    let result = work();
    (begun.elapsed().as_secs_f64().max(1e-9), result)
}

/// Milliseconds of each stage, in the order they were first met.
#[derive(Default)]
pub(crate) struct Stages(Vec<(&'static str, Vec<f64>)>);

/// One stage, summed up.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Row {
    pub(crate) stage: &'static str,
    pub(crate) p50_ms: f64,
    pub(crate) p95_ms: f64,
    pub(crate) samples: usize,
}

impl Stages {
    /// Runs and times some work.
    pub(crate) fn time<R>(&mut self, stage: &'static str, work: impl FnOnce() -> R) -> R {
        let (seconds, result) = seconds(work);
        self.add(stage, 1e3 * seconds);
        result
    }

    /// Adds a time taken elsewhere, ms.
    pub(crate) fn add(&mut self, stage: &'static str, milliseconds: f64) {
        match self.0.iter_mut().find(|(name, _)| *name == stage) {
            Some((_, times)) => times.push(milliseconds),
            None => self.0.push((stage, vec![milliseconds])),
        }
    }

    /// Medians and 95th percentiles.
    pub(crate) fn rows(mut self) -> Vec<Row> {
        let row = |(stage, times): &mut (&'static str, Vec<f64>)| {
            times.sort_by(f64::total_cmp);
            let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
            Row { stage, p50_ms: at(0.5), p95_ms: at(0.95), samples: times.len() }
        };
        self.0.iter_mut().map(row).collect()
    }
}

/// The speed of memory: a = b + s·c over three arrays, 12 bytes an element, on the threads of the step.
pub(crate) struct Triad {
    arrays: [Vec<f32>; 3],
    speeds: Vec<f64>,
}

impl Triad {
    /// Makes the arrays, touched once.
    pub(crate) fn new() -> Self {
        Self { arrays: [0.0, 1.0, 2.0].map(|value| vec![value; TRIAD]), speeds: Vec::new() }
    }

    /// Bytes a second of one pass.
    pub(crate) fn run(&mut self) -> f64 {
        let [a, b, c] = &mut self.arrays;
        let share = TRIAD.div_ceil(rayon::current_num_threads());
        let (seconds, ()) = seconds(|| {
            rayon::scope(|scope| {
                for ((a, b), c) in a.chunks_mut(share).zip(b.chunks(share)).zip(c.chunks(share)) {
                    scope.spawn(move |_| {
                        for ((a, b), c) in black_box(a).iter_mut().zip(b).zip(c) {
                            *a = b + 0.5 * c;
                        }
                    });
                }
            });
        });
        let speed = 12.0 * TRIAD as f64 / seconds;
        self.speeds.push(speed);
        speed
    }

    /// The median so far, or of eight passes, GB/s.
    pub(crate) fn speed(&mut self) -> f64 {
        while self.speeds.len() < 8 {
            self.run();
        }
        self.speeds.sort_by(f64::total_cmp);
        self.speeds[self.speeds.len() / 2] / 1e9
    }
}

/// The median of pair ratios and its 95 % interval.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Ratio {
    /// Median of the steps alone, GB/s.
    pub(crate) step_gb_per_s: f64,
    pub(crate) median: f64,
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) pairs: usize,
}

/// The median of some ratios and its 95 % interval.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Interval {
    pub(crate) median: f64,
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) pairs: usize,
}

/// `None` of none.
pub(crate) fn interval(mut ratios: Vec<f64>) -> Option<Interval> {
    ratios.sort_by(f64::total_cmp);
    let n = ratios.len();
    let median = *ratios.get(n / 2)?;
    // Ranks of the median's interval.
    let half = (0.98 * (n as f64).sqrt()).round() as usize;
    let (low, high) = (ratios[(n / 2).saturating_sub(half)], ratios[(n / 2 + half).min(n - 1)]);
    Some(Interval { median, low, high, pairs: n })
}

/// Of pairs (step, triad) in bytes a second; `None` of none.
pub(crate) fn ratio(pairs: &[[f64; 2]]) -> Option<Ratio> {
    let Interval { median, low, high, pairs: n } = interval(pairs.iter().map(|[step, triad]| step / triad).collect())?;
    let mut steps: Vec<f64> = pairs.iter().map(|[step, _]| *step).collect();
    steps.sort_by(f64::total_cmp);
    Some(Ratio { step_gb_per_s: steps[n / 2] / 1e9, median, low, high, pairs: n })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_and_intervals_are_those_of_the_pairs() {
        let pairs: Vec<[f64; 2]> = (1..=25).map(|k| [f64::from(k) * 1e9, 10e9]).collect();
        let ratio = ratio(&pairs).unwrap();
        assert_eq!((ratio.median, ratio.low, ratio.high, ratio.pairs), (1.3, 0.8, 1.8, 25));
        assert_eq!(ratio.step_gb_per_s, 13.0);
        assert!(super::ratio(&[]).is_none());
    }

    #[test]
    fn stages_are_timed_in_order() {
        let mut stages = Stages::default();
        for _ in 0..3 {
            stages.time("short", || ());
            stages.time("long", || std::thread::sleep(std::time::Duration::from_millis(5)));
        }
        let rows = stages.rows();
        assert_eq!(rows.iter().map(|row| (row.stage, row.samples)).collect::<Vec<_>>(), [("short", 3), ("long", 3)]);
        assert!(rows[1].p50_ms >= 5.0 && rows[0].p50_ms < 5.0, "{rows:?}");
    }
}
