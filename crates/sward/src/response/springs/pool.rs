//! Which billboards have a sheet: only those that something touches or that still recover.
//!
//! Orthmann et al. 2009, §5.1 and §7 (60 000 billboards in 12 MB); methods §4. A sheet takes [`words`] words of 32 bits; whoever is
//! touched gets the lowest free place. Where none is free, the sheet nearest to having recovered makes room (of equal ones the lowest billboard); where none
//! recovers, the new contacts farthest from the focus are refused, and counted. Differs from the paper: billboards, not nodes of a tree.

use super::sheet::{MOST_VERTICES, Sheet, SheetRoot, SpringsCoefficients};
use super::step::HeldSheet;
pub use crate::state::{Billboard, SheetPool};
use crate::state::{Cells, NONE};

/// Words of a stored sheet: three for each vertex above the roots, one for four ways out, one for the steps since the last contact.
pub fn words(co: &SpringsCoefficients) -> usize {
    let (columns, rows) = co.sides();
    let vertices = columns * (rows - 1);
    3 * vertices + vertices.div_ceil(4) + 1
}

/// Bytes of a number of billboards, `sheets` of which have a sheet: roots, an index each, sheets.
pub fn bytes(co: &SpringsCoefficients, billboards: u64, sheets: u64) -> u64 {
    billboards * (size_of::<SheetRoot>() as u64 + 4) + sheets * 4 * words(co) as u64
}

/// Sheets that fit in `budget` bytes beside what all billboards take; no more than there are billboards.
pub fn sheets_within(co: &SpringsCoefficients, billboards: u64, budget: u64) -> u64 {
    (budget.saturating_sub(bytes(co, billboards, 0)) / (4 * words(co) as u64)).min(billboards)
}

/// Writes a sheet to its words; what does not fit is left out.
pub fn store(co: &SpringsCoefficients, held: &HeldSheet, to: &mut [u32]) {
    let (columns, rows) = co.sides();
    let vertices = columns..columns * rows;
    let points = held.stored.at[vertices.clone()].iter().flatten().map(|part| part.to_bits());
    let byte = |quad: &[u8], k: usize| u32::from(quad.get(k).copied().unwrap_or(0)) << (8 * k);
    let faces = held.faces[vertices].chunks(4).map(|quad| (0..4).fold(0, |word, k| word | byte(quad, k)));
    to.iter_mut().zip(points.chain(faces).chain([held.steps])).for_each(|(to, from)| *to = from);
}

/// The words of the sheet of a billboard, if it has one: cell `index` of the patch whose cells are in `slot`.
pub fn stored<'a>(co: &SpringsCoefficients, cells: &'a Cells, slot: u32, index: u32) -> Option<&'a [u32]> {
    let place = cells.now.get(slot as usize)?.get(index as usize)?.to_bits();
    let words = words(co);
    if place == NONE { None } else { cells.sheets.get(place as usize * words..)?.get(..words) }
}

/// Reads a sheet from its words; missing ones are 0.
pub fn load(co: &SpringsCoefficients, root: &SheetRoot, from: &[u32]) -> HeldSheet {
    let (columns, rows) = co.sides();
    let word = |k: usize| from.get(k).copied().unwrap_or(0);
    let count = columns * (rows - 1);
    let mut held = HeldSheet { stored: Sheet { at: [[0.0; 3]; MOST_VERTICES] }, steps: 0, faces: [0; MOST_VERTICES] };
    for column in 0..columns {
        held.stored.at[column] = root.foot(co, column);
    }
    for k in 0..count {
        held.stored.at[columns + k] = [0, 1, 2].map(|axis| f32::from_bits(word(3 * k + axis)));
        held.faces[columns + k] = (word(3 * count + k / 4) >> (8 * (k % 4))) as u8;
    }
    held.steps = word(3 * count + count.div_ceil(4));
    held
}
