//! A column that finds no way out lies down, as far as it must; and nothing jumps.
//!
//! Methods §4. Under a wide, fast body the way out is down: no push to the side frees a vertex whose root is under the body. Lying flat along the
//! ground always does, since a body ends there. Reads distance maps. Writes vertices. Twin: `lay.wgsl`. Not in the paper.

use super::lengths::{flat, pass_column};
use super::push::{Maps, TOLERANCE};
use super::sheet::{MOST_SIDE, Sheet, SheetRoot, SpringsCoefficients};
use super::vector::{between, minus, plus, size};
use crate::math;

/// Halvings in search of how far a column lies down: to 1/64.
const HALVINGS: u32 = 6;
/// Farthest a vertex moves in a moment of a step, as a share of a column's length.
pub const SPREAD: f32 = 0.3;

/// Directions of a column's segments.
type Ways = [[f32; 3]; MOST_SIDE];

#[inline(always)]
fn ways(co: &SpringsCoefficients, sheet: &Sheet, column: usize) -> Ways {
    let (columns, rows) = co.sides();
    let mut ways = [[0.0, 1.0, 0.0]; MOST_SIDE];
    for row in 0..rows - 1 {
        ways[row] = sheet.way(columns, row * columns + column);
    }
    ways
}

/// Sets a column a `share` of the way from directions to others, above the ground.
#[inline(always)]
fn turn(co: &SpringsCoefficients, root: &SheetRoot, sheet: &mut Sheet, column: usize, (from, to): (&Ways, &Ways), share: f32) {
    let (columns, rows) = co.sides();
    for row in 0..rows - 1 {
        let vertex = row * columns + column;
        sheet.at[vertex + columns] = plus(sheet.at[vertex], between(from[row], to[row], share), root.segment(co));
    }
    pass_column(co, root, sheet, column);
}

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

/// Columns that are still in a body lie down, straight the way their tips point, just as far as frees them. An upright one falls along
/// `otherwise` (x, z).
pub fn lay(co: &SpringsCoefficients, root: &SheetRoot, maps: &Maps, moment: u32, sheet: &mut Sheet, otherwise: [f32; 2]) {
    let (columns, rows) = co.sides();
    for column in 0..columns {
        if deepest(co, root, maps, moment, sheet, column) <= TOLERANCE {
            continue;
        }
        let from = ways(co, sheet, column);
        let tip = minus(sheet.at[(rows - 1) * columns + column], sheet.at[column]);
        let to = [flat(root, tip.map(|part| part / root.length), otherwise); MOST_SIDE];
        let (mut stuck, mut free) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (stuck + free);
            turn(co, root, sheet, column, (&from, &to), middle);
            let deep = deepest(co, root, maps, moment, sheet, column) > TOLERANCE;
            (stuck, free) = if deep { (middle, free) } else { (stuck, middle) };
        }
        turn(co, root, sheet, column, (&from, &to), free);
    }
}

/// Moves of more than [`SPREAD`] column lengths end there: a column turns only so far from where it was.
pub fn spread(co: &SpringsCoefficients, root: &SheetRoot, before: &Sheet, sheet: &mut Sheet) {
    let (columns, rows) = co.sides();
    for column in 0..columns {
        let mut far = 0.0;
        for row in 1..rows {
            let vertex = row * columns + column;
            far = math::upper(size(minus(sheet.at[vertex], before.at[vertex])), far);
        }
        let most = SPREAD * root.length;
        if far > most {
            let (from, to) = (ways(co, before, column), ways(co, sheet, column));
            turn(co, root, sheet, column, (&from, &to), most / far);
        }
    }
}
