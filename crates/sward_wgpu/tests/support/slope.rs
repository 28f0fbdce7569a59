//! How memory grows.

/// How steeply samples (s, value) rise: the median over all pairs. What grows once, such as a buffer made larger for a part of the field that was not seen
/// before, does not count; what grows again and again does.
pub(crate) fn slope(samples: &[(f64, f64)]) -> f64 {
    let pairs = samples.iter().enumerate().flat_map(|(index, one)| samples[..index].iter().map(move |other| (one, other)));
    let mut slopes: Vec<f64> =
        pairs.filter(|(one, other)| one.0 > other.0).map(|(one, other)| (one.1 - other.1) / (one.0 - other.0)).collect();
    slopes.sort_by(f64::total_cmp);
    slopes.get(slopes.len() / 2).copied().unwrap_or(f64::NAN)
}
