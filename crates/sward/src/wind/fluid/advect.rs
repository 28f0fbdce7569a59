//! Air carries its own velocity along: each cell looks up where its air came from.
//!
//! Stam 1999, §2.3: stable for any step. Twin: `advect.wgsl`.

use super::fft::Complex;
use super::real::Real;
use crate::math::floored;

/// Farthest that air comes from in a step, cells.
const FARTHEST: f32 = 64.0;

/// The flow after a step in which each cell's air moves `reach` cells for every m/s.
pub fn advect<T: Real>(from: &[Complex<T>], side: usize, reach: T, to: &mut [Complex<T>]) {
    let mask = side as i32 - 1;
    let limit = T::of(f64::from(FARTHEST));
    let bounded = |x: T| {
        if x > limit {
            limit
        } else if x > -limit {
            x
        } else {
            -limit
        }
    };
    for (index, out) in to.iter_mut().enumerate() {
        let (i, j) = ((index % side) as i32, (index / side) as i32);
        let [x, y] = from[index].map(|speed| bounded(speed * reach));
        let (left, low) = (floored(-x.wide() as f32), floored(-y.wide() as f32));
        let (fx, fy) = (-x - T::of(f64::from(left)), -y - T::of(f64::from(low)));
        let at = |di: i32, dj: i32| from[(((j + low + dj) & mask) * side as i32 + ((i + left + di) & mask)) as usize];
        let (a, b, c, d) = (at(0, 0), at(1, 0), at(0, 1), at(1, 1));
        for part in 0..2 {
            let (below, above) = (a[part] + (b[part] - a[part]) * fx, c[part] + (d[part] - c[part]) * fx);
            out[part] = below + (above - below) * fy;
        }
    }
}
