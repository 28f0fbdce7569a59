//! One step of one patch on the CPU: contact, then the wave row by row, then upper segments.
//!
//! The wave is written so that the compiler vectorises it; `pulp` picks the widest instructions of the machine at run time. Every
//! level computes the same bits.

use super::bend;
use super::coefficients::{Coefficients, RATE_LIMIT};
use super::propagate::{RowInput, RowPeak, deviation, fade_row, keep_held, largest, limit_row, propagate_row};
use super::rest::Rest;
use crate::activation::BAND;
use crate::interaction::{Contact, ContactEdge, contact_at};
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
    let side = cells as i32;
    let clip = |low: i32, size: i32| (low.clamp(0, side), low.saturating_add(size).clamp(0, side));
    let bounds = by.contacts.iter().map(|(contact, corner)| (clip(corner[0], contact.size[0]), clip(corner[1], contact.size[1])));
    let Some(((x0, x1), (z0, z1))) = bounds.reduce(|a, b| {
        let joined = |p: (i32, i32), q: (i32, i32)| (p.0.min(q.0), p.1.max(q.1));
        (joined(a.0, b.0), joined(a.1, b.1))
    }) else {
        return;
    };
    for j in z0..z1 {
        for i in x0..x1 {
            let cell = j as usize * cells + i as usize;
            let hits = by.contacts.iter().filter_map(|(contact, corner)| {
                let edges = &by.edges[contact.edge_first as usize..][..contact.edge_count as usize];
                let (u, v) = (i - corner[0], j - corner[1]);
                let covered = u >= 0 && v >= 0 && u < contact.size[0] && v < contact.size[1];
                if covered { contact_at(contact, edges, [u, v], ground.height(cells, cell), co.plant_height) } else { None }
            });
            let bend = [now[cell], now[area + cell]];
            if let Some(next) = bend::contact(co, bend, ground.slope(cells, cell), hits) {
                held[cell] = 1;
                for (plane, value) in [next.bend[0], next.bend[1], next.rate[0], next.rate[1]].into_iter().enumerate() {
                    now[plane * area + cell] = value;
                    old[plane * area + cell] = value;
                }
            }
        }
    }
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
    middle: [Vec<f32>; 4],
    outside: [Vec<f32>; 4],
    rest: [Vec<f32>; 2],
    columns: [Vec<f32>; 2],
    deviations: Vec<u32>,
}

impl Scratch {
    fn resize(&mut self, cells: usize) {
        self.middle.iter_mut().for_each(|row| row.resize(cells + 2, 0.0));
        self.outside.iter_mut().for_each(|row| row.resize(cells, 0.0));
        self.rest.iter_mut().for_each(|row| row.resize(cells, 0.0));
        self.columns.iter_mut().for_each(|column| column.resize(4 * cells, 0.0));
        self.deviations.resize(cells, 0);
    }
}

#[inline(always)]
fn plane_row(patch: &[f32], cells: usize, plane: usize, row: usize) -> &[f32] {
    &patch[(plane * cells + row) * cells..][..cells]
}

#[inline(always)]
fn planes(patch: &[f32], cells: usize, row: usize) -> [&[f32]; 4] {
    [plane_row(patch, cells, 0, row), plane_row(patch, cells, 1, row), plane_row(patch, cells, 2, row), plane_row(patch, cells, 3, row)]
}

#[inline(always)]
fn planes_mut(patch: &mut [f32], cells: usize, row: usize) -> Option<[&mut [f32]; 4]> {
    let mut rows = patch.chunks_exact_mut(cells).skip(row).step_by(cells);
    Some([rows.next()?, rows.next()?, rows.next()?, rows.next()?])
}

/// The row beyond the patch: of the awake neighbour, or at rest.
fn outside<'a>(wave: &Wave<'a>, side: usize, cells: usize, rows: &'a mut [Vec<f32>; 4]) -> [&'a [f32]; 4] {
    let (neighbour_row, j) = if side == 2 { (cells - 1, -1) } else { (0, cells as i32) };
    if let Some(neighbour) = wave.neighbours[side] {
        return planes(neighbour, cells, neighbour_row);
    }
    let [x, z, wx, wz] = rows;
    wave.rest.row(j, [x, z]);
    wx.fill(0.0);
    wz.fill(0.0);
    [x, z, wx, wz]
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

#[inline(always)]
fn fill_middle(wave: &Wave, cells: usize, j: usize, columns: &[Vec<f32>; 2], middle: &mut [Vec<f32>; 4]) {
    for plane in 0..4 {
        let row = &mut middle[plane];
        row[0] = columns[0][plane * cells + j];
        row[1..=cells].copy_from_slice(plane_row(wave.now, cells, plane, j));
        row[cells + 1] = columns[1][plane * cells + j];
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

#[inline(always)]
fn summarise(bits: &[u32], j: usize, summary: &mut [u32; 5]) {
    let cells = bits.len();
    let band = if BAND < cells { BAND } else { cells };
    let all = largest(bits);
    let (first, last) = (largest(&bits[..band]), largest(&bits[cells - band..]));
    let low = if j < BAND { all } else { 0 };
    let high = if j + BAND >= cells { all } else { 0 };
    for (sum, value) in summary.iter_mut().zip([all, first, last, low, high]) {
        *sum = if value > *sum { value } else { *sum };
    }
}

/// One substep of the wave over one patch: `old` holds the past and receives the future.
#[inline(always)]
pub fn step_patch(co: &Coefficients, cells: usize, wave: &Wave, old: &mut [f32], scratch: &mut Scratch) -> Summary {
    scratch.resize(cells);
    let (mut squares, mut clamped) = ([0_u32; 5], 0);
    let safe = [(wave.safe_limit * wave.safe_limit).to_bits(), (RATE_LIMIT * RATE_LIMIT * 0.9999).to_bits()];
    fill_columns(wave, cells, &mut scratch.columns);
    for j in 0..cells {
        fill_middle(wave, cells, j, &scratch.columns, &mut scratch.middle);
        let [rest_x, rest_z] = &mut scratch.rest;
        wave.rest.row(j as i32, [rest_x, rest_z]);
        let rest = [&scratch.rest[0][..cells], &scratch.rest[1][..cells]];
        let (first, last) = (j == 0, j + 1 == cells);
        let (before, after) = match (first, last) {
            (true, _) => (outside(wave, 2, cells, &mut scratch.outside), planes(wave.now, cells, j + 1)),
            (_, true) => (planes(wave.now, cells, j - 1), outside(wave, 3, cells, &mut scratch.outside)),
            _ => (planes(wave.now, cells, j - 1), planes(wave.now, cells, j + 1)),
        };
        let held = if wave.held.is_empty() { wave.held } else { &wave.held[j * cells..][..cells] };
        let [a, b, c, d] = &scratch.middle;
        let middle = [&a[..], &b[..], &c[..], &d[..]];
        let input = RowInput { middle, before, after, rest, held };
        let Some(mut next) = planes_mut(old, cells, j) else { continue };
        let peak: RowPeak = propagate_row(co, &input, &mut next);
        keep_held(&input, &mut next);
        if peak.bend > safe[0] || peak.rate > safe[1] {
            clamped += limit_row(&mut next, wave.ground.slope_row(cells, j), held);
        }
        if wave.keep < 1.0 {
            fade_row(&mut next, rest, wave.keep);
        }
        deviations(&next, rest, &mut scratch.deviations);
        summarise(&scratch.deviations, j, &mut squares);
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
