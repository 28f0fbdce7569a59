//! One step of one patch on the CPU: contact, then the wave row by row, then upper segments.
//!
//! The wave is written so that the compiler vectorises it; `pulp` picks the widest instructions of the machine at run time. Every
//! level computes the same bits.

use super::bend;
use super::coefficients::{Coefficients, RATE_LIMIT};
use super::propagate::{RowInput, RowOutput, deviation, fade_row, keep_held, largest, limit_row, propagate_row};
use super::rest::Rest;
use crate::activation::BAND;
use crate::interaction::{Contact, ContactEdge, Hit, contact_at};
use crate::lanes::Simd;
use crate::state::{Ground, Summary};

/// Contacts that reach a patch.
pub struct PatchContacts<'a> {
    /// Contacts with their footprint's corner cell counted from the patch's own corner.
    pub contacts: &'a [(Contact, [i32; 2])],
    /// Edge list of the step.
    pub edges: &'a [ContactEdge],
}

/// Bends the cells under bodies. `now` and `old` are the patch's two time levels; held cells get 1 in `held`.
pub fn touch_patch(
    co: &Coefficients,
    cells: usize,
    by: &PatchContacts,
    ground: &Ground,
    now: &mut [f32],
    old: &mut [f32],
    held: &mut [u8],
) {
    let area = cells * cells;
    let mut hits = hits_of(co, cells, by, ground);
    // Stable: hits of a cell stay in body order.
    hits.sort_by_key(|(cell, _)| *cell);
    for same in hits.chunk_by(|a, b| a.0 == b.0) {
        let cell = same[0].0;
        let bend = [now[cell], now[area + cell]];
        if let Some(next) = bend::contact(co, bend, ground.slope(cells, cell), same.iter().map(|(_, hit)| *hit)) {
            held[cell] = 1;
            for (plane, value) in [next.bend[0], next.bend[1], next.rate[0], next.rate[1]].into_iter().enumerate() {
                now[plane * area + cell] = value;
                old[plane * area + cell] = value;
            }
        }
    }
}

/// Cells that bodies reach, body by body: only those within a footprint's own bounds are looked at.
fn hits_of(co: &Coefficients, cells: usize, by: &PatchContacts, ground: &Ground) -> Vec<(usize, Hit)> {
    let side = cells as i32;
    let within = |low: i32, size: i32| low.clamp(0, side)..low.saturating_add(size).clamp(0, side);
    let mut hits = Vec::new();
    for (contact, corner) in by.contacts {
        let edges = &by.edges[contact.edge_first as usize..][..contact.edge_count as usize];
        for j in within(corner[1], contact.size[1]) {
            for i in within(corner[0], contact.size[0]) {
                let cell = j as usize * cells + i as usize;
                let hit = contact_at(contact, edges, [i - corner[0], j - corner[1]], ground.height(cells, cell), co.plant_height);
                hits.extend(hit.map(|hit| (cell, hit)));
            }
        }
    }
    hits
}

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
    /// 1 where a body holds a cell; empty if none.
    pub held: &'a [u8],
    /// Share of the deviation kept: 1, less while the patch fades.
    pub keep: f32,
}

/// Working rows of one thread.
#[derive(Default)]
pub struct Scratch {
    /// The row before, the row itself and the row after, plane by plane, each with a cell of halo at both ends.
    rows: [[Vec<f32>; 4]; 3],
    rest: [Vec<f32>; 2],
    columns: [Vec<f32>; 2],
    pace: [Vec<f32>; 2],
    deviations: Vec<u32>,
}

impl Scratch {
    fn resize(&mut self, cells: usize) {
        self.rows.iter_mut().flatten().for_each(|row| row.resize(cells + 2, 0.0));
        self.rest.iter_mut().chain(&mut self.pace).for_each(|row| row.resize(cells, 0.0));
        self.columns.iter_mut().for_each(|column| column.resize(4 * cells, 0.0));
        self.deviations.resize(cells, 0);
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

/// Gathers row `j`, −1 ≤ j ≤ cells, with its halo: of the patch, of an awake neighbour, or at rest. A row is gathered a row ahead of
/// its use, in the pieces it is used in: otherwise the processor would wait for its own stores.
#[inline(always)]
fn fill_row<S: Simd>(wave: &Wave, cells: usize, j: i32, columns: &[Vec<f32>; 2], row: &mut [Vec<f32>; 4]) {
    let (from, at) = match j {
        -1 => (wave.neighbours[2], cells - 1),
        j if j < cells as i32 => (Some(wave.now), j as usize),
        _ => (wave.neighbours[3], 0),
    };
    let Some(from) = from else {
        let [x, z, wx, wz] = row;
        wave.rest.row(j, [&mut x[1..=cells], &mut z[1..=cells]]);
        wx.fill(0.0);
        wz.fill(0.0);
        return;
    };
    for plane in 0..4 {
        let (source, row) = (plane_row(from, cells, plane, at), &mut row[plane]);
        let (pieces, tail) = S::as_simd_f32s(source);
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

/// Adds a row to a summary: `all` is the largest of its deviations `bits`.
#[inline(always)]
fn summarise(all: u32, bits: &[u32], j: usize, summary: &mut [u32; 5]) {
    let cells = bits.len();
    let band = if BAND < cells { BAND } else { cells };
    let (first, last) = (largest(&bits[..band]), largest(&bits[cells - band..]));
    let low = if j < BAND { all } else { 0 };
    let high = if j + BAND >= cells { all } else { 0 };
    for (sum, value) in summary.iter_mut().zip([all, first, last, low, high]) {
        *sum = if value > *sum { value } else { *sum };
    }
}

/// One substep of the wave over one patch: `old` holds the past and receives the future.
#[inline(always)]
pub fn step_patch<S: Simd>(simd: S, co: &Coefficients, cells: usize, wave: &Wave, old: &mut [f32], scratch: &mut Scratch) -> Summary {
    scratch.resize(cells);
    let (mut squares, mut clamped) = ([0_u32; 5], 0);
    let safe = [(wave.safe_limit * wave.safe_limit).to_bits(), (RATE_LIMIT * RATE_LIMIT * 0.9999).to_bits()];
    fill_columns(wave, cells, &mut scratch.columns);
    fill_row::<S>(wave, cells, -1, &scratch.columns, &mut scratch.rows[1]);
    fill_row::<S>(wave, cells, 0, &scratch.columns, &mut scratch.rows[2]);
    for j in 0..cells {
        scratch.rows.rotate_left(1);
        let [before, middle, after] = &mut scratch.rows;
        fill_row::<S>(wave, cells, j as i32 + 1, &scratch.columns, after);
        let [rest_x, rest_z] = &mut scratch.rest;
        if j == 0 || !matches!(wave.rest, Rest::Uniform(_)) {
            wave.rest.row(j as i32, [rest_x, rest_z]);
        }
        let rest = [&scratch.rest[0][..cells], &scratch.rest[1][..cells]];
        let held = if wave.held.is_empty() { wave.held } else { &wave.held[j * cells..][..cells] };
        let input = RowInput {
            middle: middle.each_ref().map(|row| &row[..]),
            before: before.each_ref().map(|row| &row[1..=cells]),
            after: after.each_ref().map(|row| &row[1..=cells]),
            rest,
            held,
        };
        let Some(old) = planes_mut(old, cells, j) else { continue };
        let [keep, spread] = &mut scratch.pace;
        let mut output = RowOutput { old, deviations: &mut scratch.deviations, pace: [keep, spread] };
        let mut peak = propagate_row(simd, co, &input, &mut output);
        let RowOutput { old: mut next, deviations: bits, .. } = output;
        keep_held(&input, &mut next);
        let over = peak.bend > safe[0] || peak.rate > safe[1];
        if over {
            clamped += limit_row(&mut next, wave.ground.slope_row(cells, j), held);
        }
        if wave.keep < 1.0 {
            fade_row(&mut next, rest, wave.keep);
        }
        if over || wave.keep < 1.0 || !held.is_empty() {
            deviations(&next, rest, bits);
            peak.deviation = largest(bits);
        }
        summarise(peak.deviation, bits, j, &mut squares);
    }
    let [largest, borders @ ..] = squares.map(f32::from_bits);
    Summary { largest, borders, clamped }
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
