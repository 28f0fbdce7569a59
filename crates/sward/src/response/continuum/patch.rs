//! The wave of one patch on the CPU, row by row.
//!
//! The wave is written so that the compiler vectorises it; `pulp` picks the widest instructions of the machine at run time. Every
//! level computes the same bits.

use std::ops::Range;

use super::coefficients::{Coefficients, RATE_LIMIT};
use super::propagate::{Rows, bends, deviation, fade_row, keep_held, largest, limit_row, rates};
use super::rest::Rest;
use crate::activation::BAND;
use crate::lanes::Simd;
use crate::state::{Ground, Summary};

/// What the wave of one patch reads.
pub struct Wave<'a> {
    /// The patch now: 4·cells² values.
    pub now: &'a [f32],
    /// Neighbours now along −x, +x, −z, +z; `None` where one sleeps.
    pub neighbours: [Option<&'a [f32]>; 4],
    /// β_eq.
    pub rest: &'a Rest,
    /// Ground.
    pub ground: &'a Ground,
    /// |β| below which no limit can bind, rad.
    pub safe_limit: f32,
    /// Cells that bodies hold, in order.
    pub held: &'a [u32],
    /// Share of the deviation kept: 1, less while the patch fades.
    pub keep: f32,
}

/// Most rows, and most cells, worked on at a time, first their ω, then their β: so few places in memory are read at once, each for long
/// enough that the processor fetches ahead, and what the first pass leaves for the second stays in the cache.
const BLOCK: usize = 64;
const BLOCK_CELLS: usize = 8192;

/// Rows of a block.
fn block_rows(cells: usize) -> usize {
    if cells * BLOCK > BLOCK_CELLS { BLOCK_CELLS / cells } else { BLOCK }
}

/// The row before, the row itself and the row after of a vector field; x and z, each with a cell of halo at both ends.
#[derive(Default)]
struct Ring([[Vec<f32>; 2]; 3]);

/// Working rows of one thread.
#[derive(Default)]
pub struct Scratch {
    bends: Ring,
    rates: Ring,
    rest: [Vec<f32>; 2],
    columns: [Vec<f32>; 2],
    /// Of each row of a block, what `rates` leaves for `bends`.
    pace: [Vec<f32>; 2],
    deviations: Vec<u32>,
    /// Mask of a row's held cells, and how many of the patch's are in rows done.
    held: Vec<u8>,
    held_done: usize,
}

impl Scratch {
    fn resize(&mut self, cells: usize) {
        self.bends.0.iter_mut().chain(&mut self.rates.0).flatten().for_each(|row| row.resize(cells + 2, 0.0));
        self.rest.iter_mut().for_each(|row| row.resize(cells, 0.0));
        self.columns.iter_mut().for_each(|column| column.resize(4 * cells, 0.0));
        self.pace.iter_mut().for_each(|rows| rows.resize(block_rows(cells) * cells, 0.0));
        self.deviations.resize(block_rows(cells) * cells, 0);
        self.held.resize(cells, 0);
    }
}

#[inline(always)]
fn plane_row(patch: &[f32], cells: usize, plane: usize, row: usize) -> &[f32] {
    &patch[(plane * cells + row) * cells..][..cells]
}

#[inline(always)]
fn planes_mut(patch: &mut [f32], cells: usize, row: usize) -> Option<[&mut [f32]; 4]> {
    let mut rows = patch.chunks_exact_mut(cells).skip(row).step_by(cells);
    Some([rows.next()?, rows.next()?, rows.next()?, rows.next()?])
}

/// The halo columns at −x and +x, planes of `cells` values: of the awake neighbours, or at rest. Gathered at once, since one by one
/// each would wait for memory.
#[inline(always)]
fn fill_columns(wave: &Wave, cells: usize, columns: &mut [Vec<f32>; 2]) {
    for (which, column, i) in [(0, cells - 1, -1), (1, 0, cells as i32)] {
        let out = &mut columns[which];
        match wave.neighbours[which] {
            Some(neighbour) => {
                for row in 0..4 * cells {
                    out[row] = neighbour[row * cells + column];
                }
            }
            None => {
                out.fill(0.0);
                for j in 0..cells {
                    let rest = wave.rest.at(i, j as i32);
                    (out[j], out[cells + j]) = (rest[0], rest[1]);
                }
            }
        }
    }
}

impl Ring {
    /// Gathers row `j`, −1 ≤ j ≤ cells, with its halo as the row after: of the patch, of an awake neighbour, or at rest. `first` is the
    /// plane of x. A row is gathered a row ahead of its use, in the pieces it is used in: otherwise the processor would wait for its own
    /// stores.
    #[inline(always)]
    fn push<S: Simd>(&mut self, wave: &Wave, cells: usize, j: i32, first: usize, columns: &[Vec<f32>; 2]) {
        self.0.rotate_left(1);
        let [_, _, row] = &mut self.0;
        let (from, at) = match j {
            -1 => (wave.neighbours[2], cells - 1),
            j if j < cells as i32 => (Some(wave.now), j as usize),
            _ => (wave.neighbours[3], 0),
        };
        let Some(from) = from else {
            let [x, z] = row;
            match first {
                0 => wave.rest.row(j, [&mut x[1..=cells], &mut z[1..=cells]]),
                _ => [x, z].into_iter().for_each(|row| row.fill(0.0)),
            }
            return;
        };
        for axis in 0..2 {
            let (plane, row) = (first + axis, &mut row[axis]);
            let (pieces, tail) = S::as_simd_f32s(plane_row(from, cells, plane, at));
            let (places, places_tail) = S::as_mut_simd_f32s(&mut row[1..=cells]);
            for (place, piece) in places.iter_mut().zip(pieces) {
                *place = *piece;
            }
            places_tail.copy_from_slice(tail);
            // Beyond the patch nothing reads the corners.
            row[0] = columns[0][plane * cells + at];
            row[cells + 1] = columns[1][plane * cells + at];
        }
    }

    #[inline(always)]
    fn rows(&self, cells: usize) -> Rows<'_> {
        let [before, middle, after] = &self.0;
        Rows {
            before: [&before[0][1..=cells], &before[1][1..=cells]],
            middle: [&middle[0], &middle[1]],
            after: [&after[0][1..=cells], &after[1][1..=cells]],
        }
    }
}

/// Bits of the squared deviations of a row: not negative, so they order like numbers, and what is no number is largest.
#[inline(always)]
fn deviations(next: &[&mut [f32]; 4], rest: [&[f32]; 2], bits: &mut [u32]) {
    let n = bits.len();
    let [bx, bz, wx, wz] = [&next[0][..n], &next[1][..n], &next[2][..n], &next[3][..n]];
    let [ex, ez] = [&rest[0][..n], &rest[1][..n]];
    for i in 0..n {
        bits[i] = deviation([bx[i], bz[i], wx[i], wz[i]], [ex[i], ez[i]]).to_bits();
    }
}

/// A summary in the making.
struct Sum {
    /// Bits of the largest deviations: of the patch, and of its bands along −x, +x, −z, +z.
    squares: [u32; 5],
    clamped: u32,
}

impl Sum {
    /// Adds row `j`: `all` is the largest of its deviations `bits`.
    #[inline(always)]
    fn add(&mut self, all: u32, bits: &[u32], j: usize) {
        let cells = bits.len();
        let band = if BAND < cells { BAND } else { cells };
        let (first, last) = (largest(&bits[..band]), largest(&bits[cells - band..]));
        let low = if j < BAND { all } else { 0 };
        let high = if j + BAND >= cells { all } else { 0 };
        for (sum, value) in self.squares.iter_mut().zip([all, first, last, low, high]) {
            *sum = if value > *sum { value } else { *sum };
        }
    }
}

/// One substep of the wave over one patch: `old` holds the past and receives the future.
#[inline(always)]
pub fn step_patch<S: Simd>(simd: S, co: &Coefficients, cells: usize, wave: &Wave, old: &mut [f32], scratch: &mut Scratch) -> Summary {
    scratch.resize(cells);
    scratch.held_done = 0;
    let mut sum = Sum { squares: [0; 5], clamped: 0 };
    fill_columns(wave, cells, &mut scratch.columns);
    for j in [-1, 0] {
        scratch.rates.push::<S>(wave, cells, j, 2, &scratch.columns);
        scratch.bends.push::<S>(wave, cells, j, 0, &scratch.columns);
    }
    let (mut block, most) = (0, block_rows(cells));
    while block < cells {
        let rows = block..if block + most < cells { block + most } else { cells };
        block = rows.end;
        let fastest = block_rates(simd, co, cells, wave, old, scratch, rows.clone());
        block_bends(simd, co, cells, wave, old, scratch, rows, fastest, &mut sum);
    }
    let [largest, borders @ ..] = sum.squares.map(f32::from_bits);
    Summary { largest, borders, clamped: sum.clamped, held: 0 }
}

/// ω of some rows. Returns the bits of the largest |ω|² of each.
#[inline(always)]
fn block_rates<S: Simd>(
    simd: S,
    co: &Coefficients,
    cells: usize,
    wave: &Wave,
    old: &mut [f32],
    scratch: &mut Scratch,
    rows: Range<usize>,
) -> [u32; BLOCK] {
    let mut fastest = [0; BLOCK];
    for (k, j) in rows.enumerate() {
        scratch.rates.push::<S>(wave, cells, j as i32 + 1, 2, &scratch.columns);
        let Some([_, _, x, z]) = planes_mut(old, cells, j) else { continue };
        let within = k * cells..(k + 1) * cells;
        let [keep, spread] = &mut scratch.pace;
        let pace = [&mut keep[within.clone()], &mut spread[within.clone()]];
        fastest[k] = rates(simd, co, &scratch.rates.rows(cells), [x, z], pace, &mut scratch.deviations[within]);
    }
    fastest
}

/// The mask of row `j`: 1 where a cell is held; empty where none is. `done` counts the held cells of the rows before.
#[inline(always)]
fn held_row<'a>(held: &[u32], done: &mut usize, cells: usize, j: usize, mask: &'a mut [u8]) -> &'a [u8] {
    let (first, end) = (j * cells, (j + 1) * cells);
    let row = held[*done..].iter().map(|cell| *cell as usize).take_while(|cell| *cell < end);
    let count = row.clone().count();
    if count == 0 {
        return &[];
    }
    *done += count;
    mask.fill(0);
    row.for_each(|cell| mask[cell - first] = 1);
    mask
}

/// β of some rows, then what holds, limits and fades β and ω.
#[inline(always)]
fn block_bends<S: Simd>(
    simd: S,
    co: &Coefficients,
    cells: usize,
    wave: &Wave,
    old: &mut [f32],
    scratch: &mut Scratch,
    rows: Range<usize>,
    fastest: [u32; BLOCK],
    sum: &mut Sum,
) {
    let safe = [(wave.safe_limit * wave.safe_limit).to_bits(), (RATE_LIMIT * RATE_LIMIT * 0.9999).to_bits()];
    for (k, j) in rows.enumerate() {
        scratch.bends.push::<S>(wave, cells, j as i32 + 1, 0, &scratch.columns);
        if j == 0 || !matches!(wave.rest, Rest::Uniform(_)) {
            let [rest_x, rest_z] = &mut scratch.rest;
            wave.rest.row(j as i32, [rest_x, rest_z]);
        }
        let rest = [&scratch.rest[0][..cells], &scratch.rest[1][..cells]];
        let within = k * cells..(k + 1) * cells;
        let pace = [&scratch.pace[0][within.clone()], &scratch.pace[1][within.clone()]];
        let bits = &mut scratch.deviations[within];
        let Some([x, z, rate_x, rate_z]) = planes_mut(old, cells, j) else { continue };
        let [most, mut deviation] = bends(simd, co, &scratch.bends.rows(cells), rest, pace, [&mut *x, &mut *z], bits);
        let mut next = [x, z, rate_x, rate_z];
        let held = held_row(wave.held, &mut scratch.held_done, cells, j, &mut scratch.held);
        keep_held([0, 1, 2, 3].map(|plane| plane_row(wave.now, cells, plane, j)), held, &mut next);
        let over = most > safe[0] || fastest[k] > safe[1];
        if over {
            sum.clamped += limit_row(&mut next, wave.ground.slope_row(cells, j), held);
        }
        if wave.keep < 1.0 {
            fade_row(&mut next, rest, wave.keep);
        }
        if over || wave.keep < 1.0 || !held.is_empty() {
            deviations(&next, rest, bits);
            deviation = largest(bits);
        }
        sum.add(deviation, bits, j);
    }
}

/// A patch that wakes: both time levels at rest.
pub fn wake_patch(cells: usize, rest: &Rest, now: &mut [f32], old: &mut [f32]) {
    for j in 0..cells {
        if let Some([x, z, wx, wz]) = planes_mut(now, cells, j) {
            rest.row(j as i32, [x, z]);
            wx.fill(0.0);
            wz.fill(0.0);
        }
    }
    old.copy_from_slice(now);
}
