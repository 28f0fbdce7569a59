//! The springs that keep a sheet's shape: every vertex goes a share of the way on which its springs have their lengths at rest.
//!
//! Orthmann et al. 2009, §5.4, eq. 6–7; methods §4. Structural springs along rows and columns, shear springs across both diagonals. Reads and
//! writes vertices. Twin: `sweep.wgsl`. Differs from the paper: all vertices move at once (Jacobi), by the mean of what their springs ask
//! for, so left and right are alike; no Δt in eq. 7, so a sheet is as stiff at 144 Hz as at 30.

use super::sheet::{MOST_VERTICES, Sheet, SheetRoot, SpringsCoefficients, direction};
use super::vector::{minus, plus, size};
use crate::math;

/// Lengths at rest of the springs from a vertex to the next one along the row, up the column, and to the upper right and the upper left.
#[inline(always)]
fn lengths(co: &SpringsCoefficients, root: &SheetRoot) -> [f32; 4] {
    let along = minus(root.foot(co, 1), root.foot(co, 0));
    let up = direction(root.lean).map(|part| part * root.segment(co));
    [size(along), root.segment(co), size(plus(up, along, 1.0)), size(plus(up, along, -1.0))]
}

/// The neighbours of a vertex: columns and rows away, and which of the lengths at rest its spring has.
const NEIGHBOURS: [(i32, i32, usize); 8] = [(-1, 0, 0), (1, 0, 0), (0, -1, 1), (0, 1, 1), (1, 1, 2), (-1, -1, 2), (-1, 1, 3), (1, -1, 3)];

/// One sweep over all springs. `fixed` says which vertices do not move, beside the roots.
pub fn sweep(co: &SpringsCoefficients, root: &SheetRoot, sheet: &Sheet, fixed: &[bool; MOST_VERTICES]) -> Sheet {
    let (columns, rows) = co.sides();
    let lengths = lengths(co, root);
    let mut moved = *sheet;
    for vertex in (columns..columns * rows).filter(|vertex| !fixed[*vertex]) {
        let (column, row) = ((vertex % columns) as i32, (vertex / columns) as i32);
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for (right, up, kind) in NEIGHBOURS {
            let (there, above) = (column + right, row + up);
            if there < 0 || above < 0 || there >= columns as i32 || above >= rows as i32 {
                continue;
            }
            let other = (above * columns as i32 + there) as usize;
            let way = minus(sheet.at[vertex], sheet.at[other]);
            let long = math::upper(size(way), 1e-9);
            // What does not move leaves its partner all the way (r of eq. 7).
            let share = if above == 0 || fixed[other] { 1.0 } else { 0.5 };
            sum = plus(sum, way, -share * co.stiffness * (long - lengths[kind]) / long);
            count += 1.0;
        }
        moved.at[vertex] = plus(sheet.at[vertex], sum, 1.0 / count);
    }
    moved
}
