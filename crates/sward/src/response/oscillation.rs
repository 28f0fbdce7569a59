//! A damped oscillator, exactly: where it is after any time, from any start.
//!
//! Grass interaction by instigators, methods §2: `x'' + 2γx' + ω₀²x = 0`. Used by the chain (§3.1) for each joint. Twin:
//! `oscillation.wgsl`. Differs from the article: starts with a velocity too, one form for all cases of damping, continuous where one
//! becomes another (docs/papers.md).

use crate::math;

/// The text of the WGSL twin; it needs `math.wgsl`.
pub const WGSL: &str = include_str!("oscillation.wgsl");

/// Largest damping γ, 1/s; more counts as this much.
pub const DAMPING_LIMIT: f32 = 1e6;
/// Largest ω₀², 1/s²; more counts as this much.
pub const STIFFNESS_LIMIT: f32 = 1e12;
/// Longest time, s; more counts as this much.
pub const TIME_LIMIT: f32 = 1e6;
/// Largest deviation and velocity at the start; more counts as this much.
pub const START_LIMIT: f32 = 1e9;
/// `|ω₀² − γ²|τ²` below which both cases are one series.
pub(super) const CRITICAL: f32 = 0.01;

/// `e^(−γτ)` times cosine and times sine over frequency: C and S of methods §2, decay included.
#[inline(always)]
fn decayed(gamma: f32, omega_squared: f32, tau: f32) -> [f32; 2] {
    let squared = omega_squared - gamma * gamma;
    let x = squared * tau * tau;
    let size = if x < 0.0 { -x } else { x };
    if size < CRITICAL {
        let decay = math::exp(-gamma * tau);
        return [decay * (1.0 + x * (x / 24.0 - 0.5)), decay * tau * (1.0 + x * (x / 120.0 - 1.0 / 6.0))];
    }
    if squared > 0.0 {
        let frequency = squared.sqrt();
        let (sine, cosine) = math::sin_cos(frequency * tau);
        let decay = math::exp(-gamma * tau);
        return [decay * cosine, decay * sine / frequency];
    }
    // Overdamped: the slow rate as a quotient, since γ − rate would cancel; both exponents are negative, so nothing overflows.
    let rate = (-squared).sqrt();
    let fast = gamma + rate;
    let (slowly, quickly) = (math::exp(-(omega_squared / fast) * tau), math::exp(-fast * tau));
    [0.5 * (slowly + quickly), 0.5 * (slowly - quickly) / rate]
}

/// What `tau` seconds do to (deviation, velocity): the two rows of a matrix, `[a, b, c, d]` with x' = a x + b v, v' = c x + d v.
///
/// `gamma` = γ ≥ 0 \[1/s\], `omega_squared` = ω₀² ≥ 0 \[1/s²\], `tau` ≥ 0 \[s\]; numbers beyond the limits above count as the limit,
/// NaN as 0. Precise while ω₀τ ≤ 1e4.
#[inline(always)]
pub fn transition(gamma: f32, omega_squared: f32, tau: f32) -> [f32; 4] {
    let gamma = math::clamped(gamma, 0.0, DAMPING_LIMIT);
    let omega_squared = math::clamped(omega_squared, 0.0, STIFFNESS_LIMIT);
    let [c, s] = decayed(gamma, omega_squared, math::clamped(tau, 0.0, TIME_LIMIT));
    [c + gamma * s, s, -omega_squared * s, c - gamma * s]
}

/// `[x, x']` after `tau` seconds of `x'' + 2γx' + ω₀²x = 0` from `deviation` and `velocity` (methods §2; any unit, and that per second).
/// Finite for every input: see [`transition`]; the start is brought within [`START_LIMIT`].
#[inline(always)]
pub fn advance(deviation: f32, velocity: f32, gamma: f32, omega_squared: f32, tau: f32) -> [f32; 2] {
    let [a, b, c, d] = transition(gamma, omega_squared, tau);
    let x = math::clamped(deviation, -START_LIMIT, START_LIMIT);
    let v = math::clamped(velocity, -START_LIMIT, START_LIMIT);
    [a * x + b * v, c * x + d * v]
}
