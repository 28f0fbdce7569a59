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

#[inline(always)]
fn laplacian(middle: &[f32], before: &[f32], after: &[f32], i: usize) -> f32 {
    (middle[i] + middle[i + 2]) + (before[i] + after[i]) - 4.0 * middle[i + 1]
}

/// One step of a row before limits. `old` holds the row one step earlier and receives the row one step on.
#[inline(always)]
pub fn propagate_row(co: &Coefficients, input: &RowInput, old: &mut [&mut [f32]; 4]) -> RowPeak {
    let n = old[0].len();
    let [bx, bz, wx, wz] = input.middle.map(|plane| &plane[..n + 2]);
    let [ubx, ubz, uwx, uwz] = input.before.map(|plane| &plane[..n]);
    let [dbx, dbz, dwx, dwz] = input.after.map(|plane| &plane[..n]);
    let [ex, ez] = input.rest.map(|plane| &plane[..n]);
    let [obx, obz, owx, owz] = old;
    let (obx, obz, owx, owz) = (&mut obx[..n], &mut obz[..n], &mut owx[..n], &mut owz[..n]);
    let (past, rate_past) = (1.0 - co.damping, 1.0 - co.rate_damping);
    let (present, rate_present) = (2.0 - co.damping, 2.0 - co.rate_damping);
    let mut peak = RowPeak::default();
    for i in 0..n {
        let (bend_x, bend_z, rate_x, rate_z) = (bx[i + 1], bz[i + 1], wx[i + 1], wz[i + 1]);
        let speed = co.wave_speed(rate_x * rate_x + rate_z * rate_z);
        let speed_before = co.wave_speed(owx[i] * owx[i] + owz[i] * owz[i]);
        // A slower wave now than before would otherwise gain energy (methods §1.3, the rescale).
        let ratio = if speed < speed_before { speed / speed_before } else { 1.0 };
        let before_x = bend_x - (bend_x - obx[i]) * ratio;
        let before_z = bend_z - (bend_z - obz[i]) * ratio;
        let spread = speed * speed * co.spread;
        let next_x = present * bend_x - past * before_x + (spread * laplacian(bx, ubx, dbx, i) - co.restoring * (bend_x - ex[i]));
        let next_z = present * bend_z - past * before_z + (spread * laplacian(bz, ubz, dbz, i) - co.restoring * (bend_z - ez[i]));
        let next_wx =
            rate_present * rate_x - rate_past * owx[i] + (co.rate_spread * laplacian(wx, uwx, dwx, i) - co.rate_restoring * rate_x);
        let next_wz =
            rate_present * rate_z - rate_past * owz[i] + (co.rate_spread * laplacian(wz, uwz, dwz, i) - co.rate_restoring * rate_z);
        obx[i] = next_x;
        obz[i] = next_z;
        owx[i] = next_wx;
        owz[i] = next_wz;
        let bend = (next_x * next_x + next_z * next_z).to_bits();
        let rate = (next_wx * next_wx + next_wz * next_wz).to_bits();
        peak.bend = if bend > peak.bend { bend } else { peak.bend };
        peak.rate = if rate > peak.rate { rate } else { peak.rate };
    }
    peak
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
