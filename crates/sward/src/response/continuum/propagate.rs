//! Propagation: bending spreads through the field as a damped wave.
//!
//! Chen & Johan 2010, §4.4, eq. 2–6. One row of a patch: reads β and ω of the row and its neighbours now, and the row's own past;
//! writes the row one step on over its past. Twin: `propagate.wgsl`, which does the same for one cell.
//! Differs from the paper: restoring term κ, limiter and rescale for stability, rest is (β_eq, 0) (docs/papers.md).

use std::ops::Range;

use super::coefficients::{Coefficients, RATE_LIMIT, bend_limit};
use crate::lanes::{Number, Simd};

/// Rows of β and ω of the present: planes βx, βz, ωx, ωz.
pub type Planes<'a> = [&'a [f32]; 4];

/// What a row reads.
pub struct RowInput<'a> {
    /// The row itself, with one cell of halo on each side: n + 2 values a plane.
    pub middle: Planes<'a>,
    /// The row at lower z, n values a plane.
    pub before: Planes<'a>,
    /// The row at higher z, n values a plane.
    pub after: Planes<'a>,
    /// β_eq of the row, rad: x and z, n values each.
    pub rest: [&'a [f32]; 2],
    /// Nonzero where a body holds the cell; empty if none is held.
    pub held: &'a [u8],
}

/// The largest squares met in a row, as bits (squares are not negative, so bits order like numbers and NaN is largest).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RowPeak {
    /// |β|².
    pub bend: u32,
    /// |ω|².
    pub rate: u32,
    /// Deviation from rest, see [`deviation`].
    pub deviation: u32,
}

/// What a row writes.
pub struct RowOutput<'a> {
    /// The row one step earlier; becomes the row one step on. n values a plane.
    pub old: [&'a mut [f32]; 4],
    /// Bits of each cell's [`deviation`], n.
    pub deviations: &'a mut [u32],
    /// Working space: what ω means for β in the same step, n values each.
    pub pace: [&'a mut [f32]; 2],
}

/// One step of a row before limits, written as what changes: fewer operations and less rounding than (2 − λ)β − (1 − λ)β⁻.
#[inline(always)]
pub fn propagate_row<S: Simd>(simd: S, co: &Coefficients, input: &RowInput, output: &mut RowOutput) -> RowPeak {
    let n = output.deviations.len();
    let whole = n / S::F32_LANES * S::F32_LANES;
    let (rate, (bend, deviation)) = (rates(simd, co, input, output, 0..whole), bends(simd, co, input, output, 0..whole));
    let peak = RowPeak { bend, rate, deviation };
    if whole == n {
        return peak;
    }
    let simd = pulp::Scalar;
    let (rate, (bend, deviation)) = (rates(simd, co, input, output, whole..n), bends(simd, co, input, output, whole..n));
    RowPeak { bend: peak.bend.max(bend), rate: peak.rate.max(rate), deviation: peak.deviation.max(deviation) }
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

/// Cells of one plane now, and the sum over their four neighbours.
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
    fn of(input: &RowInput<'a>, plane: usize, span: &Range<usize>) -> Self {
        let middle = input.middle[plane];
        let (left, here, right) = (lanes::<S>(middle, 0, span), lanes::<S>(middle, 1, span), lanes::<S>(middle, 2, span));
        let (before, after) = (lanes::<S>(input.before[plane], 0, span), lanes::<S>(input.after[plane], 0, span));
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

/// ω of a span of cells, and what it means for β: `pace` receives (1 − λ) c/c⁻ (the rescale of methods §1.3) and c²Δt²/Δx²;
/// `deviations` receives |ω|². Returns the bits of the largest |ω|².
#[inline(always)]
fn rates<S: Simd>(simd: S, co: &Coefficients, input: &RowInput, output: &mut RowOutput, span: Range<usize>) -> u32 {
    let all = |value: f32| Number::all(simd, value);
    let (base, gain, cap, one) = (all(co.base_speed), all(co.speed_gain), all(co.speed_cap), all(1.0));
    let (keep, spread) = (all(1.0 - co.damping), all(co.spread));
    let here = all(1.0 - 4.0 * co.rate_spread - co.rate_restoring);
    let (change, near) = (all(1.0 - co.rate_damping), all(co.rate_spread));
    let (x, z) = (Around::<S>::of(input, 2, &span), Around::<S>::of(input, 3, &span));
    let count = x.here.len();
    let [_, _, old_x, old_z] = &mut output.old;
    let (old_x, old_z) = (&mut lanes_mut::<S>(old_x, &span)[..count], &mut lanes_mut::<S>(old_z, &span)[..count]);
    let [keeps, spreads] = &mut output.pace;
    let (keeps, spreads) = (&mut lanes_mut::<S>(keeps, &span)[..count], &mut lanes_mut::<S>(spreads, &span)[..count]);
    let squares = &mut S::as_mut_simd_u32s(&mut output.deviations[span]).0[..count];
    let mut peak = simd.splat_u32s(0);
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
        peak = simd.max_u32s(peak, squares[k]);
    }
    largest(bytemuck::cast_slice(&[peak]))
}

/// β of a span of cells, after [`rates`]. Returns the bits of the largest |β|² and of the largest [`deviation`].
#[inline(always)]
fn bends<S: Simd>(simd: S, co: &Coefficients, input: &RowInput, output: &mut RowOutput, span: Range<usize>) -> (u32, u32) {
    let (restoring, four) = (Number::all(simd, co.restoring), Number::all(simd, 4.0));
    let (x, z) = (Around::<S>::of(input, 0, &span), Around::<S>::of(input, 1, &span));
    let count = x.here.len();
    let [rest_x, rest_z] = input.rest.map(|row| &lanes::<S>(row, 0, &span)[..count]);
    let [old_x, old_z, _, _] = &mut output.old;
    let (old_x, old_z) = (&mut lanes_mut::<S>(old_x, &span)[..count], &mut lanes_mut::<S>(old_z, &span)[..count]);
    let [keeps, spreads] = &output.pace;
    let (keeps, spreads) = (&lanes::<S>(keeps, 0, &span)[..count], &lanes::<S>(spreads, 0, &span)[..count]);
    let deviations = &mut S::as_mut_simd_u32s(&mut output.deviations[span]).0[..count];
    let mut peaks = [simd.splat_u32s(0); 2];
    for k in 0..count {
        let ((now_x, around_x), (now_z, around_z)) = (x.at(simd, k), z.at(simd, k));
        let (calm_x, calm_z) = (Number::of(simd, rest_x[k]), Number::of(simd, rest_z[k]));
        let (keep, spread) = (Number::of(simd, keeps[k]), Number::of(simd, spreads[k]));
        let pulled_x = spread * (around_x - four * now_x) - restoring * (now_x - calm_x);
        let pulled_z = spread * (around_z - four * now_z) - restoring * (now_z - calm_z);
        let next_x = now_x + (keep * (now_x - Number::of(simd, old_x[k])) + pulled_x);
        let next_z = now_z + (keep * (now_z - Number::of(simd, old_z[k])) + pulled_z);
        (old_x[k], old_z[k]) = (next_x.values(), next_z.values());
        let away = squared(next_x - calm_x, next_z - calm_z);
        peaks[0] = simd.max_u32s(peaks[0], squared(next_x, next_z).to_bits());
        deviations[k] = simd.max_u32s(deviations[k], away.to_bits());
        peaks[1] = simd.max_u32s(peaks[1], deviations[k]);
    }
    let [bend, deviation] = peaks.map(|peak| largest(bytemuck::cast_slice(&[peak])));
    (bend, deviation)
}

#[inline(always)]
fn squared<S: Simd>(x: Number<S>, z: Number<S>) -> Number<S> {
    x * x + z * z
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

/// Held cells keep β and ω (Dirichlet cells of the wave).
#[inline(always)]
pub fn keep_held(input: &RowInput, next: &mut [&mut [f32]; 4]) {
    for (plane, now) in next.iter_mut().zip(input.middle) {
        for (i, held) in input.held.iter().enumerate() {
            plane[i] = if *held != 0 { now[i + 1] } else { plane[i] };
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
