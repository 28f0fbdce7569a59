//! What makes air neither come from nowhere nor go there, and what makes it spread.
//!
//! Stam 1999, §2.4; methods §5. Twin: `project.wgsl`. Both components travel through one transform, as a complex number: x the real part, y the
//! imaginary one.
//! Differs from the paper: the projection takes away just that flow whose central differences make the divergence. The usual five-point one leaves 20
//! to 50 % of it for ever.

use super::fft::{Complex, Fft};
use super::real::Real;
use crate::math::{exp_f64, sin_cos_f64};

/// The spectral half of a step, for one size.
#[derive(Clone, Debug)]
pub struct Spectrum<T> {
    /// The transform of its rows and columns.
    pub fft: Fft<T>,
    side: usize,
    /// sin(2πm/n): the central difference of wave m.
    pub slopes: Vec<T>,
    /// What is left of wave m after a step of spreading.
    pub lasts: Vec<T>,
}

impl<T: Real> Spectrum<T> {
    /// For `side` × `side` cells of `cell` \[m\]; air of `viscosity` \[m²/s\] spreads for `dt` \[s\].
    pub fn new(side: usize, cell: f64, viscosity: f64, dt: f64) -> Self {
        let wave = |m: usize| std::f64::consts::TAU * m as f64 / side as f64;
        let slope = |m: usize| if (2 * m).is_multiple_of(side) { 0.0 } else { sin_cos_f64(wave(m)).0 };
        let lasts = |m: usize| {
            let number = wave(m.min(side - m)) / cell;
            exp_f64(-viscosity * number * number * dt)
        };
        Self {
            fft: Fft::new(side),
            side,
            slopes: (0..side).map(|m| T::of(slope(m))).collect(),
            lasts: (0..side).map(|m| T::of(lasts(m))).collect(),
        }
    }

    /// Takes the divergence out of a flow; `spreads`: it spreads, too.
    pub fn project(&self, flow: &mut [Complex<T>], spreads: bool) {
        self.fft.square(flow, false);
        let n = self.side;
        for row in 0..n {
            for column in 0..n {
                let (here, there) = (row * n + column, (n - row) % n * n + (n - column) % n);
                if here <= there {
                    // It lies transposed: rows are waves along x.
                    (flow[here], flow[there]) = self.pair([row, column], flow[here], flow[there], spreads);
                }
            }
        }
        self.fft.square(flow, true);
    }

    /// A wave and the one that goes the other way.
    #[inline(always)]
    fn pair(&self, [x, y]: [usize; 2], here: Complex<T>, there: Complex<T>, spreads: bool) -> (Complex<T>, Complex<T>) {
        let half = T::of(0.5);
        // The two components, each of a real flow.
        let mut u = [(here[0] + there[0]) * half, (here[1] - there[1]) * half];
        let mut v = [(here[1] + there[1]) * half, (there[0] - here[0]) * half];
        let (sx, sy) = (self.slopes[x], self.slopes[y]);
        let size = sx * sx + sy * sy;
        if size > T::default() {
            for part in 0..2 {
                let along = (sx * u[part] + sy * v[part]) / size;
                (u[part], v[part]) = (u[part] - sx * along, v[part] - sy * along);
            }
        }
        if spreads {
            let last = self.lasts[x] * self.lasts[y];
            (u, v) = (u.map(|part| part * last), v.map(|part| part * last));
        }
        ([u[0] - v[1], u[1] + v[0]], [u[0] + v[1], v[0] - u[1]])
    }
}

/// Root mean square of the divergence \[1/s\] of a flow \[m/s\] on `side` × `side` cells of `cell` \[m\], by central differences.
pub fn divergence<T: Real>(flow: &[Complex<T>], side: usize, cell: f64) -> f64 {
    let at = |i: usize, j: usize| flow[j % side * side + i % side].map(Real::wide);
    let squares = (0..side * side).map(|k| {
        let (i, j) = (k % side, k / side);
        let across = at(i + 1, j)[0] - at(i + side - 1, j)[0] + at(i, j + 1)[1] - at(i, j + side - 1)[1];
        let divergence = across / (2.0 * cell);
        divergence * divergence
    });
    (squares.sum::<f64>() / (side * side) as f64).sqrt()
}
