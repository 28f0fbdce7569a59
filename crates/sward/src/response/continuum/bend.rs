//! Direct bending: what a body does to the cell under it.
//!
//! Chen & Johan 2010, §4.3, §5.1–5.2, eq. 1, 10–12. Reads contacts, β, slope. Writes β, ω and both one step earlier. Twin: `bend.wgsl`.
//! Differs from the paper: exact solution instead of Euler, vector bend, held cells, floor under resting bodies (docs/papers.md).

use super::coefficients::{Coefficients, HALF_PI, RATE_LIMIT, bend_limit};
use crate::interaction::Hit;
use crate::math;

/// A lean below this, rad, is pushed over the top instead of being turned round.
const OVER_THE_TOP: f32 = 0.35;
/// Slower bodies, m/s, hold what they stand on.
const HOLDING: f32 = 1e-4;

/// A held cell after contact: bend \[rad\] and bending velocity [rad/s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// β, also its own past.
    pub bend: [f32; 2],
    /// ω, also its own past.
    pub rate: [f32; 2],
    /// Which of the hits bends it: its number, counted from 0.
    pub by: u32,
    /// How high that one touches it, m.
    pub height: f32,
}

/// The push of one hit: Δ of methods §1.2, rad.
#[inline(always)]
pub fn push(co: &Coefficients, bend: [f32; 2], hit: &Hit) -> f32 {
    if hit.speed < HOLDING {
        return 0.0;
    }
    let t = math::clamped(bend[0] * hit.direction[0] + bend[1] * hit.direction[1], -1.57, 1.57);
    math::atan(math::tan(t) + hit.along * co.step / hit.height) - t
}

/// [`bend_limit`], known at once on level ground.
#[inline(always)]
fn limit_at(slope: [f32; 2], bend: [f32; 2]) -> f32 {
    if slope == [0.0; 2] { HALF_PI } else { bend_limit(slope, bend) }
}

#[inline(always)]
fn length(v: [f32; 2]) -> f32 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

#[inline(always)]
fn scaled_to(v: [f32; 2], wanted: f32) -> [f32; 2] {
    let now = length(v);
    if now > 1e-12 { [v[0] * (wanted / now), v[1] * (wanted / now)] } else { v }
}

/// `bend` turned towards the unit vector `direction` by at most the turn of one step; ties turn from +x to +z.
#[inline(always)]
fn turned(co: &Coefficients, bend: [f32; 2], direction: [f32; 2]) -> [f32; 2] {
    let size = length(bend);
    let dot = bend[0] * direction[0] + bend[1] * direction[1];
    if dot >= size * co.turn_cosine {
        return [direction[0] * size, direction[1] * size];
    }
    let cross = bend[0] * direction[1] - bend[1] * direction[0];
    let sine = if cross >= 0.0 { co.turn_sine } else { -co.turn_sine };
    [bend[0] * co.turn_cosine - bend[1] * sine, bend[0] * sine + bend[1] * co.turn_cosine]
}

/// Bend of a cell under the hit with the largest push, before the floor (the three cases of methods §1.2).
#[inline(always)]
fn driven(co: &Coefficients, bend: [f32; 2], hit: &Hit, delta: f32, slope: [f32; 2]) -> Held {
    let d = hit.direction;
    let dot = bend[0] * d[0] + bend[1] * d[1];
    let moved = [bend[0] + delta * d[0], bend[1] + delta * d[1]];
    let mut rate = [d[0] * delta / co.step, d[1] * delta / co.step];
    let mut next = if dot >= 0.0 {
        scaled_to(moved, math::upper(length(moved), length(bend)))
    } else if length(bend) < OVER_THE_TOP {
        moved
    } else {
        let next = turned(co, bend, d);
        rate = [(next[0] - bend[0]) / co.step, (next[1] - bend[1]) / co.step];
        next
    };
    let limit = limit_at(slope, next);
    if length(next) > limit {
        next = scaled_to(next, limit);
    }
    if length(rate) > RATE_LIMIT {
        rate = scaled_to(rate, RATE_LIMIT);
    }
    Held { bend: next, rate, by: 0, height: hit.height }
}

/// The floor under a body: |β| ≥ min(θ_max, atan(depth/h)), approached along β itself, along the edge normal only if β has no direction.
#[inline(always)]
fn floored(co: &Coefficients, bend: [f32; 2], deepest: &Hit, slope: [f32; 2]) -> [f32; 2] {
    let size = length(bend);
    let along = if size < 1e-3 { deepest.normal } else { [bend[0] / size, bend[1] / size] };
    let floor = math::lower(limit_at(slope, along), deepest.floor());
    if size >= floor {
        return bend;
    }
    let wanted = math::lower(floor, size + co.approach);
    [along[0] * wanted, along[1] * wanted]
}

/// Contact of one cell with all bodies that reach it: the largest push wins (ties to the lower body), then the highest floor holds.
/// `hits` are in body order. `None` if nothing touches.
#[inline(always)]
pub fn contact(co: &Coefficients, bend: [f32; 2], slope: [f32; 2], hits: impl Iterator<Item = Hit>) -> Option<Held> {
    let mut strongest: Option<(f32, Hit, u32)> = None;
    let mut deepest: Option<(Hit, u32)> = None;
    for (number, hit) in hits.enumerate() {
        let (delta, number) = (push(co, bend, &hit), number as u32);
        if strongest.as_ref().is_none_or(|(best, ..)| delta > *best) {
            strongest = Some((delta, hit, number));
        }
        if deepest.as_ref().is_none_or(|(best, _)| hit.floor() > best.floor()) {
            deepest = Some((hit, number));
        }
    }
    let ((delta, hit, pusher), (deepest, deeper)) = (strongest?, deepest?);
    let still = Held { bend, rate: [0.0, 0.0], by: 0, height: hit.height };
    let mut held = if hit.speed < HOLDING { still } else { driven(co, bend, &hit, delta, slope) };
    held.bend = floored(co, held.bend, &deepest, slope);
    // What does not push holds it down.
    (held.by, held.height) = if delta > 0.0 { (pusher, hit.height) } else { (deeper, deepest.height) };
    Some(held)
}
