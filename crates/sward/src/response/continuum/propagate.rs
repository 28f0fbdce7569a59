//! Propagation: bending spreads through the field as a damped wave.
//!
//! Chen & Johan 2010, §4.4, eq. 2–6. A row of a patch at a time: [`rates`], then [`bends`]. Each reads the row and its neighbours now, and
//! the row's own past; writes the row one step on over its past. Twin: `propagate.wgsl`, which does both for one cell.
//! Differs from the paper: restoring term κ, limiter and rescale for stability, rest is (β_eq, 0) (docs/papers.md).

use std::ops::Range;

use super::coefficients::{Coefficients, RATE_LIMIT, bend_limit};
use crate::lanes::{Number, Scalar, Simd};

/// A vector field, β or ω, around a row of n cells; x and z.
#[derive(Clone, Copy)]
pub struct Rows<'a> {
    /// The row at lower z, n values.
    pub before: [&'a [f32]; 2],
    /// The row itself, with one cell of halo on each side: n + 2 values.
    pub middle: [&'a [f32]; 2],
    /// The row at higher z, n values.
    pub after: [&'a [f32]; 2],
}

/// Several cells side by side of one plane, and the sum over their four neighbours.
#[derive(Clone, Copy)]
struct Around<'a, S: Simd> {
    left: &'a [S::f32s],
    here: &'a [S::f32s],
    right: &'a [S::f32s],
    before: &'a [S::f32s],
    after: &'a [S::f32s],
}

impl<'a, S: Simd> Around<'a, S> {
    #[inline(always)]
    fn of(rows: &Rows<'a>, axis: usize, span: &Range<usize>) -> Self {
        let middle = rows.middle[axis];
        let (left, here, right) = (lanes::<S>(middle, 0, span), lanes::<S>(middle, 1, span), lanes::<S>(middle, 2, span));
        let (before, after) = (lanes::<S>(rows.before[axis], 0, span), lanes::<S>(rows.after[axis], 0, span));
        let count = here.len();
        Self { left: &left[..count], here, right: &right[..count], before: &before[..count], after: &after[..count] }
    }

    #[inline(always)]
    fn at(&self, simd: S, k: usize) -> (Number<S>, Number<S>) {
        let along = Number::of(simd, self.left[k]) + Number::of(simd, self.right[k]);
        let across = Number::of(simd, self.before[k]) + Number::of(simd, self.after[k]);
        (Number::of(simd, self.here[k]), along + across)
    }
}

/// A span of cells of a row, as many at a time as an instruction takes.
#[inline(always)]
fn lanes<'a, S: Simd>(row: &'a [f32], offset: usize, span: &Range<usize>) -> &'a [S::f32s] {
    S::as_simd_f32s(&row[offset + span.start..offset + span.end]).0
}

#[inline(always)]
fn lanes_mut<'a, S: Simd>(row: &'a mut [f32], span: &Range<usize>) -> &'a mut [S::f32s] {
    S::as_mut_simd_f32s(&mut row[span.start..span.end]).0
}

/// The cells of a row that fill instructions, and those left over.
fn spans<S: Simd>(n: usize) -> [Range<usize>; 2] {
    let whole = n / S::F32_LANES * S::F32_LANES;
    [0..whole, whole..n]
}

#[inline(always)]
fn squared<S: Simd>(x: Number<S>, z: Number<S>) -> Number<S> {
    x * x + z * z
}

/// One step of ω of a row, before limits, and what it means for β.
///
/// `old` holds ω one step earlier and receives ω one step on; `pace` receives (1 − λ) c/c⁻ (the rescale of methods §1.3) and c²Δt²/Δx²;
/// `squares` receives the bits of |ω|². n values each. Returns the largest of `squares`.
#[inline(always)]
pub fn rates<S: Simd>(simd: S, co: &Coefficients, rows: &Rows, old: [&mut [f32]; 2], pace: [&mut [f32]; 2], squares: &mut [u32]) -> u32 {
    let [whole, rest] = spans::<S>(squares.len());
    let ([old_x, old_z], [keep, spread]) = (old, pace);
    let most = rates_of(simd, co, rows, [old_x, old_z], [keep, spread], squares, whole);
    if rest.is_empty() { most } else { most.max(rates_of(Scalar, co, rows, [old_x, old_z], [keep, spread], squares, rest)) }
}

#[inline(always)]
fn rates_of<S: Simd>(
    simd: S,
    co: &Coefficients,
    rows: &Rows,
    [old_x, old_z]: [&mut [f32]; 2],
    [keeps, spreads]: [&mut [f32]; 2],
    squares: &mut [u32],
    span: Range<usize>,
) -> u32 {
    let all = |value: f32| Number::all(simd, value);
    let (base, gain, cap, one) = (all(co.base_speed), all(co.speed_gain), all(co.speed_cap), all(1.0));
    let (keep, spread) = (all(1.0 - co.damping), all(co.spread));
    let here = all(1.0 - 4.0 * co.rate_spread - co.rate_restoring);
    let (change, near) = (all(1.0 - co.rate_damping), all(co.rate_spread));
    let (x, z) = (Around::<S>::of(rows, 0, &span), Around::<S>::of(rows, 1, &span));
    let count = x.here.len();
    let (old_x, old_z) = (&mut lanes_mut::<S>(old_x, &span)[..count], &mut lanes_mut::<S>(old_z, &span)[..count]);
    let (keeps, spreads) = (&mut lanes_mut::<S>(keeps, &span)[..count], &mut lanes_mut::<S>(spreads, &span)[..count]);
    let squares = &mut S::as_mut_simd_u32s(&mut squares[span]).0[..count];
    let mut most = simd.splat_u32s(0);
    // No closures in here: they would stay outside, compiled for the baseline.
    for k in 0..count {
        let ((now_x, around_x), (now_z, around_z)) = (x.at(simd, k), z.at(simd, k));
        let (past_x, past_z) = (Number::of(simd, old_x[k]), Number::of(simd, old_z[k]));
        let speed = (base + gain * squared(now_x, now_z).sqrt()).lower(cap);
        let speed_before = (base + gain * squared(past_x, past_z).sqrt()).lower(cap);
        // A slower wave now than before would otherwise gain energy.
        let ratio = speed.where_less(speed_before, speed / speed_before, one);
        keeps[k] = (keep * ratio).values();
        spreads[k] = (speed * speed * spread).values();
        let next_x = here * now_x + (change * (now_x - past_x) + near * around_x);
        let next_z = here * now_z + (change * (now_z - past_z) + near * around_z);
        (old_x[k], old_z[k]) = (next_x.values(), next_z.values());
        squares[k] = squared(next_x, next_z).to_bits();
        most = simd.max_u32s(most, squares[k]);
    }
    largest(bytemuck::cast_slice(&[most]))
}

/// One step of β of a row, before limits, after [`rates`]; written as what changes, with fewer operations and less rounding than
/// (2 − λ)β − (1 − λ)β⁻.
///
/// `rest` is β_eq \[rad\], `pace` as left by [`rates`]; `old` holds β one step earlier and receives β one step on; `deviations` holds
/// the bits of |ω|² and receives those of each cell's [`deviation`]. n values each. Returns the bits of the largest |β|² and deviation.
#[inline(always)]
pub fn bends<S: Simd>(
    simd: S,
    co: &Coefficients,
    rows: &Rows,
    rest: [&[f32]; 2],
    pace: [&[f32]; 2],
    old: [&mut [f32]; 2],
    deviations: &mut [u32],
) -> [u32; 2] {
    let [whole, left_over] = spans::<S>(deviations.len());
    let [old_x, old_z] = old;
    let most = bends_of(simd, co, rows, rest, pace, [old_x, old_z], deviations, whole);
    if left_over.is_empty() {
        return most;
    }
    let others = bends_of(Scalar, co, rows, rest, pace, [old_x, old_z], deviations, left_over);
    [most[0].max(others[0]), most[1].max(others[1])]
}

#[inline(always)]
fn bends_of<S: Simd>(
    simd: S,
    co: &Coefficients,
    rows: &Rows,
    rest: [&[f32]; 2],
    pace: [&[f32]; 2],
    [old_x, old_z]: [&mut [f32]; 2],
    deviations: &mut [u32],
    span: Range<usize>,
) -> [u32; 2] {
    let (restoring, four) = (Number::all(simd, co.restoring), Number::all(simd, 4.0));
    let (x, z) = (Around::<S>::of(rows, 0, &span), Around::<S>::of(rows, 1, &span));
    let count = x.here.len();
    let (calm_x, calm_z) = (&lanes::<S>(rest[0], 0, &span)[..count], &lanes::<S>(rest[1], 0, &span)[..count]);
    let (keeps, spreads) = (&lanes::<S>(pace[0], 0, &span)[..count], &lanes::<S>(pace[1], 0, &span)[..count]);
    let (old_x, old_z) = (&mut lanes_mut::<S>(old_x, &span)[..count], &mut lanes_mut::<S>(old_z, &span)[..count]);
    let deviations = &mut S::as_mut_simd_u32s(&mut deviations[span]).0[..count];
    let (mut most, mut farthest) = (simd.splat_u32s(0), simd.splat_u32s(0));
    for k in 0..count {
        let ((now_x, around_x), (now_z, around_z)) = (x.at(simd, k), z.at(simd, k));
        let (calm_x, calm_z) = (Number::of(simd, calm_x[k]), Number::of(simd, calm_z[k]));
        let (keep, spread) = (Number::of(simd, keeps[k]), Number::of(simd, spreads[k]));
        let pulled_x = spread * (around_x - four * now_x) - restoring * (now_x - calm_x);
        let pulled_z = spread * (around_z - four * now_z) - restoring * (now_z - calm_z);
        let next_x = now_x + (keep * (now_x - Number::of(simd, old_x[k])) + pulled_x);
        let next_z = now_z + (keep * (now_z - Number::of(simd, old_z[k])) + pulled_z);
        (old_x[k], old_z[k]) = (next_x.values(), next_z.values());
        most = simd.max_u32s(most, squared(next_x, next_z).to_bits());
        deviations[k] = simd.max_u32s(deviations[k], squared(next_x - calm_x, next_z - calm_z).to_bits());
        farthest = simd.max_u32s(farthest, deviations[k]);
    }
    [largest(bytemuck::cast_slice(&[most])), largest(bytemuck::cast_slice(&[farthest]))]
}

/// The largest of some numbers, 0 of none.
#[inline(always)]
pub(super) fn largest(values: &[u32]) -> u32 {
    let mut most = 0;
    for value in values {
        most = if *value > most { *value } else { most };
    }
    most
}

/// Held cells keep β and ω (Dirichlet cells of the wave): `now` is the row as it was, `held` is nonzero where a body holds a cell.
#[inline(always)]
pub fn keep_held(now: [&[f32]; 4], held: &[u8], next: &mut [&mut [f32]; 4]) {
    for (plane, now) in next.iter_mut().zip(now) {
        for (i, held) in held.iter().enumerate() {
            plane[i] = if *held != 0 { now[i] } else { plane[i] };
        }
    }
}

/// |β| ≤ θ_max along β, |ω| ≤ 60 rad/s, by scaling. Returns the number of cells scaled.
#[inline(always)]
pub fn limit_row(next: &mut [&mut [f32]; 4], slope: [&[f32]; 2], held: &[u8]) -> u32 {
    let n = next[0].len();
    let mut clamped = 0;
    for i in 0..n {
        let held = !held.is_empty() && held[i] != 0;
        let bend = [next[0][i], next[1][i]];
        let ground = if slope[0].is_empty() { [0.0, 0.0] } else { [slope[0][i], slope[1][i]] };
        let (limit, size) = (bend_limit(ground, bend), (bend[0] * bend[0] + bend[1] * bend[1]).sqrt());
        let over = size > limit && !held;
        let scale = if over { limit / size } else { 1.0 };
        let rate = (next[2][i] * next[2][i] + next[3][i] * next[3][i]).sqrt();
        let fast = rate > RATE_LIMIT && !held;
        let rate_scale = if fast { RATE_LIMIT / rate } else { 1.0 };
        next[0][i] = if over { bend[0] * scale } else { bend[0] };
        next[1][i] = if over { bend[1] * scale } else { bend[1] };
        next[2][i] = if fast { next[2][i] * rate_scale } else { next[2][i] };
        next[3][i] = if fast { next[3][i] * rate_scale } else { next[3][i] };
        clamped += u32::from(over || fast);
    }
    clamped
}

/// A patch on its way to sleep: deviations from rest are multiplied by `keep` in [0, 1) (methods §1.6, released over 0.3 s).
#[inline(always)]
pub fn fade_row(next: &mut [&mut [f32]; 4], rest: [&[f32]; 2], keep: f32) {
    let n = next[0].len();
    for i in 0..n {
        next[0][i] = rest[0][i] + (next[0][i] - rest[0][i]) * keep;
        next[1][i] = rest[1][i] + (next[1][i] - rest[1][i]) * keep;
        next[2][i] *= keep;
        next[3][i] *= keep;
    }
}

/// Squared deviation of one cell from rest: max(|β − β_eq|², |ω|²).
#[inline(always)]
pub fn deviation(next: [f32; 4], rest: [f32; 2]) -> f32 {
    let (x, z) = (next[0] - rest[0], next[1] - rest[1]);
    let (bend, rate) = (x * x + z * z, next[2] * next[2] + next[3] * next[3]);
    if bend > rate { bend } else { rate }
}
