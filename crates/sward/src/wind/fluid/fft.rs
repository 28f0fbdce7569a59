//! Fast Fourier transform of rows whose length is a power of two: radix 2, from one array to the other and back (Stockham), so nothing is put
//! in another order afterwards.
//!
//! Cooley & Tukey 1965; the arrangement after Stockham 1966. Twin: `fft.wgsl`.

use super::real::Real;
use crate::math::sin_cos_f64;

/// A complex number, real part first.
pub(super) type Complex<T> = [T; 2];

/// Product of two complex numbers.
#[inline(always)]
pub(super) fn times<T: Real>([a, b]: Complex<T>, [c, d]: Complex<T>) -> Complex<T> {
    [a * c - b * d, a * d + b * c]
}

/// The transform of one length.
#[derive(Clone, Debug)]
pub struct Fft<T> {
    length: usize,
    /// e^(−2πi k/n) for k below n/2.
    pub turns: Vec<Complex<T>>,
}

impl<T: Real> Fft<T> {
    /// For rows of `length` numbers, a power of two; others are rounded up to one.
    pub fn new(length: usize) -> Self {
        let length = length.max(1).next_power_of_two();
        let turn = |k: usize| {
            let (sine, cosine) = sin_cos_f64(std::f64::consts::TAU * k as f64 / length as f64);
            [T::of(cosine), T::of(-sine)]
        };
        Self { length, turns: (0..length / 2).map(turn).collect() }
    }

    /// Σ x_j e^(∓2πi jk/n) for all k, of one row; `inverse` takes + and divides by n. `other` is room for as many numbers.
    pub fn row(&self, row: &mut [Complex<T>], other: &mut [Complex<T>], inverse: bool) {
        debug_assert!(row.len() == self.length && other.len() == self.length);
        let half = self.length / 2;
        let mut swapped = false;
        let mut groups = half;
        while groups > 0 {
            let (from, to): (&[_], &mut [_]) = if swapped { (&*other, &mut *row) } else { (&*row, &mut *other) };
            // `groups` butterflies share a turn; each of their outputs lies `groups` apart.
            for k in 0..half / groups {
                let [cosine, sine] = self.turns[k * groups];
                let turn = [cosine, if inverse { -sine } else { sine }];
                for j in 0..groups {
                    let (a, b) = (from[2 * k * groups + j], times(from[(2 * k + 1) * groups + j], turn));
                    to[k * groups + j] = [a[0] + b[0], a[1] + b[1]];
                    to[k * groups + j + half] = [a[0] - b[0], a[1] - b[1]];
                }
            }
            swapped = !swapped;
            groups /= 2;
        }
        if swapped {
            row.copy_from_slice(other);
        }
        if inverse {
            let share = T::of(1.0 / self.length as f64);
            row.iter_mut().for_each(|value| *value = value.map(|part| part * share));
        }
    }

    /// Rows, then columns, of a square; `inverse` as in [`Fft::row`]. The result lies transposed; so does that of a transposed one, hence upright.
    pub fn square(&self, square: &mut [Complex<T>], inverse: bool) {
        let n = self.length;
        let mut other = vec![Complex::<T>::default(); n];
        square.chunks_exact_mut(n).for_each(|row| self.row(row, &mut other, inverse));
        transpose(square, n);
        square.chunks_exact_mut(n).for_each(|row| self.row(row, &mut other, inverse));
    }
}

/// Rows become columns, in tiles that the cache holds.
fn transpose<T: Copy>(square: &mut [T], n: usize) {
    const TILE: usize = 16;
    for top in (0..n).step_by(TILE) {
        for left in (top..n).step_by(TILE) {
            for i in top..(top + TILE).min(n) {
                for j in left.max(i + 1)..(left + TILE).min(n) {
                    square.swap(i * n + j, j * n + i);
                }
            }
        }
    }
}
