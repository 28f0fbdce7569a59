//! `f64` angles for the poses of bodies and cameras: CPU only, the same bits on every platform.
//!
//! The standard library's functions differ between platforms in the last digit, and a replay must not.

/// Adding this to an `f64` below 2⁵¹ rounds it to a whole number, ties to even.
const ROUNDER: f64 = 6755399441055744.0;
/// π/2 as a sum of two numbers of 30 bits each and a rest.
const QUARTER_TURN: [f64; 3] = [1.570796325802803, 9.920935791635221e-10, 5.170182981794105e-19];
/// Taylor coefficients of sin, from r³ on.
const SIN: [f64; 7] =
    [-1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362880.0, -1.0 / 39916800.0, 1.0 / 6227020800.0, -1.0 / 1307674368000.0];
/// Taylor coefficients of cos, from r² on.
const COS: [f64; 8] = [
    -1.0 / 2.0,
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40320.0,
    -1.0 / 3628800.0,
    1.0 / 479001600.0,
    -1.0 / 87178291200.0,
    1.0 / 20922789888000.0,
];

/// `(sin x, cos x)` of an angle \[rad\], |x| ≤ 1e6. Absolute error ≤ 3e-16. Beyond the range, and for NaN, some pair
/// within ±1 comes out.
pub fn sin_cos_f64(x: f64) -> (f64, f64) {
    let shifted = x * std::f64::consts::FRAC_2_PI + ROUNDER;
    let n = shifted - ROUNDER;
    let rest = ((x - n * QUARTER_TURN[0]) - n * QUARTER_TURN[1]) - n * QUARTER_TURN[2];
    let r = if (-0.7855..=0.7855).contains(&rest) { rest } else { 0.0 };
    let rr = r * r;
    let s = r + r * rr * polynomial(&SIN, rr);
    let c = 1.0 + rr * polynomial(&COS, rr);
    match shifted.to_bits() & 3 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// The angle \[rad, −π..=π\] of the vector (x, y), as `atan2(y, x)`; 0 for the zero vector. Absolute error ≤ 1e-15.
pub fn atan2_f64(y: f64, x: f64) -> f64 {
    if x == 0.0 && y == 0.0 {
        return 0.0;
    }
    let angle = atan(y / if x < 0.0 { -x } else { x + 0.0 });
    match (x < 0.0, y < 0.0) {
        (true, true) => -std::f64::consts::PI - angle,
        (true, false) => std::f64::consts::PI - angle,
        _ => angle,
    }
}

fn atan(x: f64) -> f64 {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, SQRT_2};
    let a = if x < 0.0 { -x } else { x };
    let (start, y) = if a > SQRT_2 + 1.0 {
        (FRAC_PI_2, -1.0 / a)
    } else if a > SQRT_2 - 1.0 {
        (FRAC_PI_4, (a - 1.0) / (a + 1.0))
    } else {
        (0.0, a)
    };
    // Half the angle: then eleven terms of Gregory's series reach the last digit.
    let half = y / (1.0 + (1.0 + y * y).sqrt());
    let squared = half * half;
    let mut series = 0.0;
    for k in (0..11).rev() {
        series = 1.0 / (2 * k + 1) as f64 - squared * series;
    }
    let angle = start + 2.0 * half * series;
    if x < 0.0 { -angle } else { angle }
}

fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    let mut sum = 0.0;
    for &c in coefficients.iter().rev() {
        sum = sum * x + c;
    }
    sum
}

/// `x` brought into [0, period) by whole periods. `period` > 0.
pub fn wrapped(x: f64, period: f64) -> f64 {
    let rest = x - period * (x / period).floor();
    if rest < period { rest } else { 0.0 }
}

/// An angle brought into [−π, π), rad.
pub fn wrapped_angle(angle: f64) -> f64 {
    wrapped(angle + std::f64::consts::PI, std::f64::consts::TAU) - std::f64::consts::PI
}

/// eˣ from + − × ÷ alone, the same on every machine; relative error below 1e-14 for |x| ≤ 700. Smaller x gives 0, larger the
/// value at 700.
pub fn exp_f64(x: f64) -> f64 {
    if x < -700.0 {
        return 0.0;
    }
    let x = if x > 700.0 { 700.0 } else { x };
    let twos = (x * std::f64::consts::LOG2_E).round();
    let rest = x - twos * std::f64::consts::LN_2;
    let mut sum = 1.0;
    for k in (1..=18).rev() {
        sum = 1.0 + rest / f64::from(k) * sum;
    }
    sum * f64::from_bits(((1023 + twos as i64) as u64) << 52)
}

/// Natural logarithm of a positive number by Newton steps on [`exp_f64`]; relative error below 1e-13 for 1e-300..1e300.
pub fn ln_f64(x: f64) -> f64 {
    let exponent = ((x.to_bits() >> 52) & 0x7ff) as i64 - 1023;
    let mut y = exponent as f64 * std::f64::consts::LN_2;
    for _ in 0..6 {
        let e = exp_f64(y);
        y += 2.0 * (x - e) / (x + e);
    }
    y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_of_bodies_are_exact_to_twelve_digits() {
        let mut worst = [0.0f64; 3];
        for i in 0..=200_000 {
            let x = (f64::from(i) - 100_000.0) * 9.87654321;
            let (s, c) = sin_cos_f64(x);
            worst[0] = worst[0].max((s - x.sin()).abs()).max((c - x.cos()).abs());
            let near = x * 1e-5;
            let (s, c) = sin_cos_f64(near);
            worst[1] = worst[1].max((s - near.sin()).abs()).max((c - near.cos()).abs());
            worst[2] = worst[2].max((atan2_f64(s * 7.0, c * 7.0) - (s * 7.0).atan2(c * 7.0)).abs());
        }
        println!("sin_cos_f64 {:.2e} far, {:.2e} near; atan2_f64 {:.2e}", worst[0], worst[1], worst[2]);
        assert!(worst[0] <= 3e-16 && worst[1] <= 3e-16 && worst[2] <= 1e-15, "{worst:?}");
    }
}
