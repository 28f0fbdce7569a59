//! The smooth surface through a sheet's vertices, for drawing.
//!
//! Orthmann et al. 2009, §8 (asked for there as future work: "higher order interpolation during rendering"); methods §4. Catmull–Rom along
//! rows and columns: through every vertex, without kinks. Reads a sheet. Twin: `surface.wgsl`.

use super::sheet::{CLEAR, Sheet, SheetRoot, SpringsCoefficients};
use super::vector::plus;
use crate::math;

/// Weights of four points in a row, the place a `share` of the way from the second to the third.
#[inline(always)]
fn weights(t: f32) -> [f32; 4] {
    let (tt, ttt) = (t * t, t * t * t);
    [0.5 * (2.0 * tt - ttt - t), 0.5 * (3.0 * ttt - 5.0 * tt) + 1.0, 0.5 * (t + 4.0 * tt - 3.0 * ttt), 0.5 * (ttt - tt)]
}

/// Weights of the points `k − 1` to `k + 2` of `count`, k = ⌊at⌋, where those beyond an end continue it straight.
#[inline(always)]
fn spans(at: f32, count: usize) -> (usize, [f32; 4]) {
    let at = math::clamped(at, 0.0, (count - 1) as f32);
    let k = (math::floored(at) as usize).min(count - 2);
    let mut w = weights(at - k as f32);
    if k == 0 {
        w = [0.0, w[1] + 2.0 * w[0], w[2] - w[0], w[3]];
    }
    if k + 2 == count {
        w = [w[0], w[1] - w[3], w[2] + 2.0 * w[3], 0.0];
    }
    (k, w)
}

/// A point of the surface, m from the patch's corner: `across` from column 0 to the last, `up` from row 0 to the last, both in whole vertices
/// and between. Above the ground, as vertices are.
#[inline(always)]
pub fn point(co: &SpringsCoefficients, root: &SheetRoot, sheet: &Sheet, across: f32, up: f32) -> [f32; 3] {
    let (columns, rows) = co.sides();
    let ((i, right), (j, above)) = (spans(across, columns), spans(up, rows));
    let mut at = [0.0; 3];
    for (row, v) in above.iter().enumerate() {
        for (column, u) in right.iter().enumerate() {
            // Where the weight is 0 the index may lie beside the sheet.
            let (column, row) = ((i + column).clamp(1, columns) - 1, (j + row).clamp(1, rows) - 1);
            at = plus(at, sheet.at[row * columns + column], u * v);
        }
    }
    let low = CLEAR * math::clamped(up, 0.0, 1.0) - root.height(at);
    if low > 0.0 { [at[0], at[1] + low, at[2]] } else { at }
}
