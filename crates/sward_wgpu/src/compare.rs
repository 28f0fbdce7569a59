//! How far two backends are apart, in numbers that one odd cell cannot hide or spoil.
//!
//! The same step on a CPU and on a GPU agrees in a tolerance, not in bits. The largest difference alone says little (one cell that
//! tips over the other way is no fault, a field that is a little off everywhere is one), so p99.9, rms and a count stand beside it.

/// Differences between two lists of numbers of the same meaning. All but the counts are in the unit of the numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Pairs compared.
    pub count: usize,
    /// The difference that 99.9 % of the pairs do not exceed.
    pub p999: f64,
    /// Root of the mean squared difference.
    pub rms: f64,
    /// Largest difference.
    pub max: f64,
    /// Pairs that differ by more than the outlier limit, or have no partner.
    pub outliers: usize,
}

/// The deviation that still counts as agreement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Most for [`Deviation::p999`].
    pub p999: f64,
    /// Most for [`Deviation::rms`].
    pub rms: f64,
    /// A larger difference is an outlier.
    pub outlier: f32,
    /// Most outliers, as a share of the pairs, 0 to 1.
    pub share: f64,
}

impl Deviation {
    /// Compares `a` with `b`, number by number. A difference over `outlier` is an outlier.
    ///
    /// A number that is not finite on either side, and a number without a partner, differ infinitely.
    pub fn of(a: &[f32], b: &[f32], outlier: f32) -> Self {
        let pairs = a.iter().zip(b).map(|(a, b)| difference(*a, *b));
        let alone = a.len().abs_diff(b.len());
        let mut differences: Vec<f64> = pairs.chain(std::iter::repeat_n(f64::INFINITY, alone)).collect();
        let count = differences.len();
        if count == 0 {
            return Self::default();
        }
        let rms = (differences.iter().map(|d| d * d).sum::<f64>() / count as f64).sqrt();
        let outliers = differences.iter().filter(|d| **d > f64::from(outlier)).count();
        // As many pairs as a thousandth, rounded down, may lie above.
        let rank = count - 1 - count / 1000;
        let (_, p999, above) = differences.select_nth_unstable_by(rank, f64::total_cmp);
        let p999 = *p999;
        let max = above.iter().fold(p999, |most, d| if *d > most { *d } else { most });
        Self { count, p999, rms, max, outliers }
    }

    /// Whether this is agreement. Nothing compared is none.
    pub fn within(&self, tolerance: &Tolerance) -> bool {
        let most = tolerance.share * self.count as f64;
        self.count > 0 && self.p999 <= tolerance.p999 && self.rms <= tolerance.rms && self.outliers as f64 <= most
    }
}

fn difference(a: f32, b: f32) -> f64 {
    if a.is_finite() && b.is_finite() { (f64::from(a) - f64::from(b)).abs() } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: Tolerance = Tolerance { p999: 1e-3, rms: 1e-4, outlier: 0.1, share: 1e-3 };

    fn field(count: usize) -> Vec<f32> {
        (0..count).map(|k| (k as f32 * 0.37).sin()).collect()
    }

    #[test]
    fn equal_lists_do_not_deviate() {
        let deviation = Deviation::of(&field(5000), &field(5000), 0.1);
        assert_eq!(deviation, Deviation { count: 5000, ..Deviation::default() });
        assert!(deviation.within(&TOLERANCE));
    }

    #[test]
    fn numbers_are_what_they_are_called() {
        let a = vec![0.0; 2000];
        let mut b = a.clone();
        (b[7], b[8], b[9]) = (3.0, -4.0, 0.05);
        let deviation = Deviation::of(&a, &b, 0.1);
        // Two of 2000 may lie above p99.9: the third largest is it.
        assert_eq!(deviation.p999, f64::from(0.05_f32));
        assert_eq!((deviation.max, deviation.outliers), (4.0, 2));
        assert!((deviation.rms - (25.0025_f64 / 2000.0).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn one_side_a_little_wrong_everywhere_is_found() {
        let a = field(5000);
        let b: Vec<f32> = a.iter().map(|value| value + 2e-3).collect();
        let deviation = Deviation::of(&a, &b, 0.1);
        assert_eq!(deviation.outliers, 0);
        assert!(!deviation.within(&TOLERANCE));
    }

    #[test]
    fn one_side_very_wrong_in_places_is_found() {
        let a = vec![0.0; 100_000];
        let mut b = a.clone();
        b[..101].fill(0.2);
        let deviation = Deviation::of(&a, &b, 0.1);
        assert_eq!(deviation.outliers, 101);
        assert!(!deviation.within(&Tolerance { p999: 1.0, rms: 1.0, ..TOLERANCE }));
        b[0] = 0.0;
        assert!(Deviation::of(&a, &b, 0.1).within(&Tolerance { p999: 1.0, rms: 1.0, ..TOLERANCE }));
    }

    #[test]
    fn what_is_not_a_number_or_has_no_partner_differs_infinitely() {
        let cases: [(&[f32], &[f32]); 4] =
            [(&[f32::NAN], &[0.0]), (&[f32::NAN], &[f32::NAN]), (&[f32::INFINITY], &[f32::INFINITY]), (&[1.0], &[1.0, 1.0])];
        for (a, b) in cases {
            let deviation = Deviation::of(a, b, 0.1);
            assert_eq!((deviation.max, deviation.outliers), (f64::INFINITY, 1), "{a:?} {b:?}");
            assert!(!deviation.within(&TOLERANCE));
        }
    }

    #[test]
    fn nothing_compared_is_no_agreement() {
        assert!(!Deviation::of(&[], &[], 0.1).within(&TOLERANCE));
    }
}
