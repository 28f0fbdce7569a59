//! A column that finds no way out lies down, as far as it must; and nothing jumps.
//!
//! Methods §4. Under a wide, fast body the way out is down: no push to the side frees a vertex whose root is under the body. Lying on the ground
//! always does, since a body ends there. Reads distance maps. Writes vertices. Twin: `lay.wgsl`. Not in the paper.

use super::lengths::{flat, on_ground, placed};
use super::push::{Faces, Maps, TOLERANCE, stride};
use super::sheet::{Sheet, SheetRoot, SpringsCoefficients};
use super::vector::{between, minus, plus, size, unit};
use crate::math;

/// Halvings in search of how far a segment turns: to 1/64.
const HALVINGS: u32 = 6;
/// Farthest a vertex moves in a step, as a share of a column's length.
pub const SPREAD: f32 = 0.34;
/// Where bodies are so fast that this is more: farthest it moves from moment to moment, as a share of the way of a body.
pub const AHEAD: f32 = 1.5;

/// The deepest vertex of a column, m.
#[inline(always)]
fn deepest(co: &SpringsCoefficients, root: &SheetRoot, maps: &Maps, moment: u32, sheet: &Sheet, column: usize) -> f32 {
    let (columns, rows) = co.sides();
    let mut most = 0.0;
    for row in 1..rows {
        most = math::upper(maps.depth(root, moment, sheet.at[row * columns + column]), most);
    }
    most
}

/// Columns that are still in a body lie down, the way they point or, upright ones, along `otherwise` (x, z): segment by segment from the root,
/// each just as far as frees it; a column that this does not free, whole.
pub fn lay(co: &SpringsCoefficients, root: &SheetRoot, maps: &Maps, moment: u32, sheet: &mut Sheet, faces: &Faces, otherwise: [f32; 2]) {
    let (columns, rows) = co.sides();
    for column in 0..columns {
        if deepest(co, root, maps, moment, sheet, column) <= TOLERANCE {
            continue;
        }
        let tip = minus(sheet.at[(rows - 1) * columns + column], sheet.at[column]);
        let fallen = flat(root, tip.map(|part| part / root.length), otherwise);
        lower(&Fall { co, root, maps, moment }, sheet, faces, column, fallen);
        if deepest(co, root, maps, moment, sheet, column) > TOLERANCE {
            for row in 1..rows {
                let vertex = row * columns + column;
                sheet.at[vertex] =
                    placed(root, sheet.at[vertex - columns], plus(sheet.at[vertex - columns], fallen, 1.0), root.segment(co));
            }
        }
    }
}

/// Turns each segment of a column towards the ground until its upper end is free, the way it points or the way out of the body, whichever moves
/// it less; what is above is carried along.
fn lower(by: &Fall, sheet: &mut Sheet, faces: &Faces, column: usize, fallen: [f32; 3]) {
    let (columns, rows) = by.co.sides();
    let mut carried = [0.0; 3];
    for row in 1..rows {
        let vertex = row * columns + column;
        let below = sheet.at[vertex - columns];
        let at = placed(by.root, below, plus(sheet.at[vertex], carried, 1.0), by.root.segment(by.co));
        let mut there = at;
        if by.maps.depth(by.root, by.moment, at) > TOLERANCE {
            let from = unit(minus(at, below));
            there = by.lowered(below, from, if from[0] * from[0] + from[2] * from[2] > 1e-2 { from } else { fallen });
            for kept in [faces[vertex], 0] {
                let Some([x, z]) = by.maps.way_out(by.root, by.moment, at, kept) else { continue };
                let other = by.lowered(below, from, [x, 0.0, z]);
                there = if size(minus(other, at)) < size(minus(there, at)) { other } else { there };
            }
        }
        carried = minus(there, sheet.at[vertex]);
        sheet.at[vertex] = there;
    }
}

/// What a column falls among.
struct Fall<'a> {
    co: &'a SpringsCoefficients,
    root: &'a SheetRoot,
    maps: &'a Maps<'a>,
    moment: u32,
}

impl Fall<'_> {
    /// Where a segment from `below` ends that is turned from a direction down to the ground along `heading` as far as frees its end.
    #[inline(always)]
    fn lowered(&self, below: [f32; 3], from: [f32; 3], heading: [f32; 3]) -> [f32; 3] {
        let segment = self.root.segment(self.co);
        let to = unit(minus(on_ground(self.root, below, heading, segment), below));
        let turned = |share: f32| placed(self.root, below, plus(below, between(from, to, share), 1.0), segment);
        let (mut stuck, mut free) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (stuck + free);
            let deep = self.maps.depth(self.root, self.moment, turned(middle)) > TOLERANCE;
            (stuck, free) = if deep { (middle, free) } else { (stuck, middle) };
        }
        turned(free)
    }
}

/// Moves that are too long end where they may: from root to tip a segment turns only so far from where it was, at one of `count` moments.
pub fn spread(co: &SpringsCoefficients, root: &SheetRoot, count: u32, before: &Sheet, sheet: &mut Sheet) {
    let (columns, rows) = co.sides();
    let (segment, most) = (root.segment(co), math::upper(SPREAD * root.length / count as f32, AHEAD * stride(root.length)));
    let wanted = *sheet;
    for vertex in columns..columns * rows {
        let (below, was) = (sheet.at[vertex - columns], before.at[vertex]);
        let (from, to) = (before.way(columns, vertex - columns), wanted.way(columns, vertex - columns));
        let turned = |share: f32| placed(root, below, plus(below, between(from, to, share), 1.0), segment);
        let far = |there: [f32; 3]| size(minus(there, was)) > most;
        let mut there = turned(1.0);
        if far(there) {
            let (mut near, mut beyond) = (0.0, 1.0);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (near + beyond);
                (near, beyond) = if far(turned(middle)) { (near, middle) } else { (middle, beyond) };
            }
            there = turned(near);
        }
        sheet.at[vertex] = there;
    }
}
