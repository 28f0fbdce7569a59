//! Clocks and medians for machines that are never quiet.

use std::time::Instant;

/// Pairs measured, in ABBA order.
pub(crate) const PAIRS: usize = 24;

/// Seconds some work takes.
pub(crate) fn seconds(work: impl FnOnce()) -> f64 {
    let begun = Instant::now();
    work();
    begun.elapsed().as_secs_f64()
}

/// Seconds of A and of B, each run twice, in ABBA or BAAB order by the pair's number.
pub(crate) fn pair(number: usize, mut a: impl FnMut() -> f64, mut b: impl FnMut() -> f64) -> [f64; 2] {
    if number.is_multiple_of(2) {
        let (first, second, third, fourth) = (a(), b(), b(), a());
        [first + fourth, second + third]
    } else {
        let (first, second, third, fourth) = (b(), a(), a(), b());
        [second + third, first + fourth]
    }
}

/// The median, between the ends of its 95 % interval by ranks.
pub(crate) fn median(values: &mut [f64]) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    let half = (0.98 * (n as f64).sqrt()).round() as usize;
    [values[(n / 2).saturating_sub(half)], values[n / 2], values[(n / 2 + half).min(n - 1)]]
}
