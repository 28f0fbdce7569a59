//! The small maths of state updates: the same bits on every CPU, the same formulas on the GPU.
//!
//! A step uses only `+ − × ÷ √`, compare-and-select, integer operations and what stands here. Everything is
//! branch-free (a compare that selects, no table, no call), so a loop over these functions vectorises and its
//! results do not depend on the width. Twin: `math.wgsl`, same names with the prefix `math_`, same coefficients
//! (a test reads them back from the text).
//!
//! Polynomials are minimax fits made for this file. Each doc gives the largest error against `f64`, as tested.

mod hash;
#[cfg(test)]
pub(crate) mod tests;
mod wide;

use std::f32::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LOG2_E, PI};

pub use hash::{hash, mixed, unit};
pub use wide::{atan2_f64, exp_f64, ln_f64, sin_cos_f64, wrapped, wrapped_angle};

/// The text of the WGSL twin; every other WGSL file of this crate may call it.
pub const WGSL: &str = include_str!("math.wgsl");

/// Adding this to an `f32` below 2²² rounds it to a whole number (ties to even), which is then in the low bits.
/// `f32::round` would be a library call on SSE2. WGSL has `round`, with the same result.
const ROUNDER: f32 = 12582912.0;

/// The argument range of [`exp`]: its results are normal numbers, neither zero nor infinite.
pub(crate) const EXP_RANGE: [f32; 2] = [-87.3, 88.0];
/// log₂e, then ln 2 as the sum of a short and a small number, so that `n · ln 2` loses nothing.
pub(crate) const EXP_REDUCTION: [f32; 3] = [LOG2_E, 0.69314575, 1.4286068e-6];
/// `eʳ ≈ 1 + r + r² P(r)` for |r| ≤ ln 2 / 2.
pub(crate) const EXP: [f32; 5] = [0.49999994, 0.1666652, 0.041668393, 0.00836878, 0.0013814496];
/// 2/π, then π/2 as a sum of three numbers, two of 11 bits each.
pub(crate) const QUARTER_TURN: [f32; 4] = [FRAC_2_PI, 1.5703125, 0.0004837513, 7.54979e-8];
/// A little above π/4, what is left of an angle of 1e4 after whole quarter turns; nonsense beyond the range is cut here.
pub(crate) const EIGHTH_TURN: f32 = 0.787;
/// `sin r ≈ r + r³ S(r²)` for |r| ≤ π/4.
pub(crate) const SIN: [f32; 3] = [-0.16666655, 0.008332173, -0.00019516656];
/// `cos r ≈ 1 − r²/2 + r⁴ C(r²)` for |r| ≤ π/4.
pub(crate) const COS: [f32; 3] = [0.041666646, -0.0013887362, 2.443773e-5];
/// tan π/8, tan 3π/8, π/4, π/2: where [`atan`] folds its argument, and by how much.
pub(crate) const ATAN_FOLDS: [f32; 4] = [0.41421357, 2.4142137, FRAC_PI_4, FRAC_PI_2];
/// `atan y ≈ y + y³ A(y²)` for |y| ≤ tan π/8.
pub(crate) const ATAN: [f32; 5] = [-0.33333316, 0.19998488, -0.14243802, 0.105956435, -0.060824987];
/// The smallest normal `f32`; [`cbrt`] of less is 0, since a GPU may flush it anyway.
pub(crate) const SMALLEST: f32 = 1.1754944e-38;

/// The smaller of two numbers: `b` unless `a < b` (so `b` where either is NaN).
#[inline(always)]
pub fn lower(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger of two numbers: `b` unless `a > b` (so `b` where either is NaN).
#[inline(always)]
pub fn upper(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// `x` brought into `low..=high`; NaN becomes `low`.
#[inline(always)]
pub fn clamped(x: f32, low: f32, high: f32) -> f32 {
    lower(upper(x, low), high)
}

/// All bits where something holds, else none: with it [`either`] needs no branch, and numbers side by side share instructions.
#[inline(always)]
pub(crate) fn mask(holds: bool) -> u32 {
    u32::from(holds).wrapping_neg()
}

/// `yes` where the mask has its bits, else `no`.
#[inline(always)]
pub(crate) fn either(mask: u32, yes: f32, no: f32) -> f32 {
    f32::from_bits((yes.to_bits() & mask) | (no.to_bits() & !mask))
}

/// A smooth step from 0 at `low` to 1 at `high` (`smoothstep` in WGSL).
#[inline(always)]
pub fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = clamped((x - low) / (high - low), 0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The whole number at or below x (`floor` in WGSL), 0 for NaN; beyond ±2³¹ the nearest `i32`.
#[inline(always)]
pub fn floored(x: f32) -> i32 {
    let towards_zero = x as i32;
    if (towards_zero as f32) > x { towards_zero.wrapping_sub(1) } else { towards_zero }
}

#[inline(always)]
fn magnitude(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0x7fff_ffff)
}

/// `eˣ`; x is first brought into −87.3..=88, so the result is always a normal number.
/// Relative error ≤ 1.2e-7.
#[inline(always)]
pub fn exp(x: f32) -> f32 {
    let x = clamped(x, EXP_RANGE[0], EXP_RANGE[1]);
    let shifted = x * EXP_REDUCTION[0] + ROUNDER;
    let n = shifted - ROUNDER;
    let r = (x - n * EXP_REDUCTION[1]) - n * EXP_REDUCTION[2];
    let p = EXP[0] + r * (EXP[1] + r * (EXP[2] + r * (EXP[3] + r * EXP[4])));
    let power_of_two = f32::from_bits(shifted.to_bits().wrapping_add(127) << 23);
    (1.0 + (r + r * r * p)) * power_of_two
}

/// `(sin x, cos x)` of an angle \[rad\], |x| ≤ 1e4. Absolute error ≤ 1e-7, and small results keep their digits
/// (relative error ≤ 1.3e-7 within one turn). Beyond the range, and for NaN, some pair within ±1 comes out.
#[inline(always)]
pub fn sin_cos(x: f32) -> (f32, f32) {
    let shifted = x * QUARTER_TURN[0] + ROUNDER;
    let n = shifted - ROUNDER;
    let rest = ((x - n * QUARTER_TURN[1]) - n * QUARTER_TURN[2]) - n * QUARTER_TURN[3];
    let r = clamped(rest, -EIGHTH_TURN, EIGHTH_TURN);
    let rr = r * r;
    let s = r + r * rr * (SIN[0] + rr * (SIN[1] + rr * SIN[2]));
    let c = (1.0 - 0.5 * rr) + rr * rr * (COS[0] + rr * (COS[1] + rr * COS[2]));
    let quarter = shifted.to_bits();
    let odd = quarter & 1 == 1;
    let sine = if odd { c } else { s };
    let cosine = if odd { s } else { c };
    let sine_sign = (quarter & 2) << 30;
    let cosine_sign = (quarter.wrapping_add(1) & 2) << 30;
    (f32::from_bits(sine.to_bits() ^ sine_sign), f32::from_bits(cosine.to_bits() ^ cosine_sign))
}

/// `tan x` of an angle \[rad\], |x| ≤ 1e4. Relative error ≤ 3e-7 for |x| ≤ 1.57 (where the crate uses it).
#[inline(always)]
pub fn tan(x: f32) -> f32 {
    let (s, c) = sin_cos(x);
    s / c
}

/// `atan x` \[rad\], any finite or infinite x. Relative error ≤ 2.1e-7.
#[inline(always)]
pub fn atan(x: f32) -> f32 {
    let a = magnitude(x);
    let middle = a > ATAN_FOLDS[0];
    let large = a > ATAN_FOLDS[1];
    let above = if large {
        -1.0
    } else if middle {
        a - 1.0
    } else {
        a
    };
    let below = if large {
        a
    } else if middle {
        a + 1.0
    } else {
        1.0
    };
    let start = if large {
        ATAN_FOLDS[3]
    } else if middle {
        ATAN_FOLDS[2]
    } else {
        0.0
    };
    let y = above / below;
    let yy = y * y;
    let p = ATAN[0] + yy * (ATAN[1] + yy * (ATAN[2] + yy * (ATAN[3] + yy * ATAN[4])));
    let angle = start + (y + y * yy * p);
    f32::from_bits(angle.to_bits() | (x.to_bits() & 0x8000_0000))
}

/// The angle \[rad, −π..=π\] of the vector (x, y), finite; 0 for the zero vector. Absolute error ≤ 4e-7.
#[inline(always)]
pub fn atan2(y: f32, x: f32) -> f32 {
    let (a, b) = (magnitude(x), magnitude(y));
    let steep = b > a;
    let above = if steep { a } else { b };
    let below = if steep { b } else { a };
    let flat = atan(above / if below > 0.0 { below } else { 1.0 });
    let quarter = if steep { FRAC_PI_2 - flat } else { flat };
    let half = if x < 0.0 { PI - quarter } else { quarter };
    if y < 0.0 { -half } else { half }
}

/// The cube root, for 1.2e-38 ≤ |x| ≤ 1e38; 0 below. Relative error ≤ 1.3e-7.
/// A guess from the exponent, then Halley's iteration twice.
#[inline(always)]
pub fn cbrt(x: f32) -> f32 {
    let bits = x.to_bits() & 0x7fff_ffff;
    let a = f32::from_bits(bits);
    let guess = f32::from_bits(bits / 3 + 0x2a51_17f6);
    let cube = guess * guess * guess;
    let better = guess + guess * ((a - cube) / (cube + cube + a));
    let cube = better * better * better;
    let root = better + better * ((a - cube) / (cube + cube + a));
    let root = if a < SMALLEST { 0.0 } else { root };
    f32::from_bits(root.to_bits() | (x.to_bits() & 0x8000_0000))
}
