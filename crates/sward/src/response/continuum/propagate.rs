//! Propagation: bending spreads through the field as a damped wave.
//!
//! Chen & Johan 2010, §4.4, eq. 2–6. One row of a patch: reads β and ω of the row and its neighbours now, and the row's own past;
//! writes the row one step on over its past. Twin: `propagate.wgsl`, which does the same for one cell.
//! Differs from the paper: restoring term κ, limiter and rescale for stability, rest is (β_eq, 0) (docs/papers.md).

use super::coefficients::{Coefficients, RATE_LIMIT, bend_limit};

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
}

/// Cells worked on at a time. Their results are gathered on the stack, which overlaps nothing, so the compiler need not check whether
/// the rows do.
const CHUNK: usize = 16;

/// One step of a row before limits. `old` holds the row one step earlier and receives the row one step on.
#[inline(always)]
pub fn propagate_row(co: &Coefficients, input: &RowInput, old: &mut [&mut [f32]; 4]) -> RowPeak {
    let n = old[0].len();
    let mut peaks = [[0_u32; CHUNK]; 2];
    let mut first = 0;
    while first + CHUNK <= n {
        propagate_chunk::<CHUNK>(co, input, old, first, &mut peaks);
        first += CHUNK;
    }
    while first + 8 <= n {
        propagate_chunk::<8>(co, input, old, first, &mut peaks);
        first += 8;
    }
    while first < n {
        propagate_chunk::<1>(co, input, old, first, &mut peaks);
        first += 1;
    }
    RowPeak { bend: largest(&peaks[0]), rate: largest(&peaks[1]) }
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

#[inline(always)]
fn part<const N: usize>(row: &[f32], first: usize) -> [f32; N] {
    let mut part = [0.0; N];
    part.copy_from_slice(&row[first..first + N]);
    part
}

/// N cells of a plane from `first` on, and Δx² times their Laplacian.
#[inline(always)]
fn here_and_around<const N: usize>(input: &RowInput, plane: usize, first: usize) -> ([f32; N], [f32; N]) {
    let (left, here, right) =
        (part::<N>(input.middle[plane], first), part::<N>(input.middle[plane], first + 1), part::<N>(input.middle[plane], first + 2));
    let (before, after) = (part::<N>(input.before[plane], first), part::<N>(input.after[plane], first));
    let mut laplacian = [0.0; N];
    for i in 0..N {
        laplacian[i] = (left[i] + right[i]) + (before[i] + after[i]) - 4.0 * here[i];
    }
    (here, laplacian)
}

/// N cells from `first` on. Written without closures: they would stay outside, compiled for the baseline.
#[inline(always)]
fn propagate_chunk<const N: usize>(
    co: &Coefficients,
    input: &RowInput,
    old: &mut [&mut [f32]; 4],
    first: usize,
    peaks: &mut [[u32; CHUNK]; 2],
) {
    let (bx, around_bx) = here_and_around::<N>(input, 0, first);
    let (bz, around_bz) = here_and_around::<N>(input, 1, first);
    let (wx, around_wx) = here_and_around::<N>(input, 2, first);
    let (wz, around_wz) = here_and_around::<N>(input, 3, first);
    let (obx, obz) = (part::<N>(old[0], first), part::<N>(old[1], first));
    let (owx, owz) = (part::<N>(old[2], first), part::<N>(old[3], first));
    let (ex, ez) = (part::<N>(input.rest[0], first), part::<N>(input.rest[1], first));
    let (past, rate_past) = (1.0 - co.damping, 1.0 - co.rate_damping);
    let (present, rate_present) = (2.0 - co.damping, 2.0 - co.rate_damping);
    let mut next = [[0.0_f32; N]; 4];
    for i in 0..N {
        let speed = co.wave_speed(wx[i] * wx[i] + wz[i] * wz[i]);
        let speed_before = co.wave_speed(owx[i] * owx[i] + owz[i] * owz[i]);
        // A slower wave now than before would otherwise gain energy (methods §1.3, the rescale).
        let ratio = if speed < speed_before { speed / speed_before } else { 1.0 };
        let before_x = bx[i] - (bx[i] - obx[i]) * ratio;
        let before_z = bz[i] - (bz[i] - obz[i]) * ratio;
        let spread = speed * speed * co.spread;
        next[0][i] = present * bx[i] - past * before_x + (spread * around_bx[i] - co.restoring * (bx[i] - ex[i]));
        next[1][i] = present * bz[i] - past * before_z + (spread * around_bz[i] - co.restoring * (bz[i] - ez[i]));
        next[2][i] = rate_present * wx[i] - rate_past * owx[i] + (co.rate_spread * around_wx[i] - co.rate_restoring * wx[i]);
        next[3][i] = rate_present * wz[i] - rate_past * owz[i] + (co.rate_spread * around_wz[i] - co.rate_restoring * wz[i]);
    }
    for i in 0..N {
        let bend = (next[0][i] * next[0][i] + next[1][i] * next[1][i]).to_bits();
        let rate = (next[2][i] * next[2][i] + next[3][i] * next[3][i]).to_bits();
        peaks[0][i] = if bend > peaks[0][i] { bend } else { peaks[0][i] };
        peaks[1][i] = if rate > peaks[1][i] { rate } else { peaks[1][i] };
    }
    for plane in 0..4 {
        old[plane][first..first + N].copy_from_slice(&next[plane]);
    }
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
