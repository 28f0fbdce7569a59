//! Columns keep their lengths, and nothing lies below the ground.
//!
//! Methods §4; not in the paper, whose springs let pushed columns stretch. From root to tip every vertex is set to its distance
//! from the one below along the present direction, and those above are carried along. Twin: `lengths.wgsl`.

use super::sheet::{CLEAR, Sheet, SheetRoot, SpringsCoefficients};
use super::vector::{dot, minus, plus, size};
use crate::math;

/// The vertex at a segment's length from `below`, towards `at`; where that is below the ground, as high as it may be, along the same
/// horizontal direction.
#[inline(always)]
pub(super) fn placed(root: &SheetRoot, below: [f32; 3], at: [f32; 3], segment: f32) -> [f32; 3] {
    let way = minus(at, below);
    let long = size(way);
    let way = if long > 1e-9 { way.map(|part| part / long) } else { [0.0, 1.0, 0.0] };
    let there = plus(below, way, segment);
    if root.height(there) >= CLEAR { there } else { on_ground(root, below, way, segment) }
}

/// The point a segment away from `below` on the ground (and [`CLEAR`] above it), horizontally along `way`.
#[inline(always)]
pub(super) fn on_ground(root: &SheetRoot, below: [f32; 3], way: [f32; 3], segment: f32) -> [f32; 3] {
    let level = (way[0] * way[0] + way[2] * way[2]).sqrt();
    // Straight down there is no direction: down the slope, or along x.
    let [sx, sz] = root.slope;
    let steep = (sx * sx + sz * sz).sqrt();
    let (x, z) = if level > 1e-6 {
        (way[0] / level, way[2] / level)
    } else if steep > 1e-6 {
        (-sx / steep, -sz / steep)
    } else {
        (1.0, 0.0)
    };
    // A step r along (x, z) rises by rise · r; from `drop` above what is allowed: r² + (rise r − drop)² = segment².
    let (rise, drop) = (sx * x + sz * z, root.height(below) - CLEAR);
    let run = 1.0 + rise * rise;
    let inner = math::upper(rise * rise * drop * drop - run * (drop * drop - segment * segment), 0.0);
    let r = (rise * drop + inner.sqrt()) / run;
    let to = [x * r, rise * r - drop, z * r];
    // Where the ground is out of reach (the vertex below hangs higher than a segment), straight down at full length.
    let long = math::upper(size(to), 1e-9);
    plus(below, to, segment / long)
}

/// One pass over the column of a vertex of the lowest row.
#[inline(always)]
pub(super) fn pass_column(co: &SpringsCoefficients, root: &SheetRoot, sheet: &mut Sheet, column: usize) {
    let (columns, rows) = co.sides();
    let segment = root.segment(co);
    let mut carried = [0.0; 3];
    for row in 1..rows {
        let vertex = row * columns + column;
        let at = plus(sheet.at[vertex], carried, 1.0);
        let there = placed(root, sheet.at[vertex - columns], at, segment);
        carried = plus(carried, minus(there, at), 1.0);
        sheet.at[vertex] = there;
    }
}

/// One pass over all columns.
pub fn pass(co: &SpringsCoefficients, root: &SheetRoot, sheet: &mut Sheet) {
    for column in 0..co.sides().0 {
        pass_column(co, root, sheet, column);
    }
}

/// The direction along the ground below a direction, unit: where a column lies that keeps it. Upright has none: `otherwise` (x, z).
#[inline(always)]
pub(super) fn flat(root: &SheetRoot, way: [f32; 3], otherwise: [f32; 2]) -> [f32; 3] {
    let level = dot([way[0], 0.0, way[2]], [way[0], 0.0, way[2]]);
    let [x, z] = if level > 1e-4 { [way[0], way[2]] } else { otherwise };
    let long = math::upper((x * x + z * z).sqrt(), 1e-9);
    let (x, z) = (x / long, z / long);
    let rise = root.slope[0] * x + root.slope[1] * z;
    let run = (1.0 + rise * rise).sqrt();
    [x / run, rise / run, z / run]
}
