//! Direct bending: what a body does to the cell under it.
//!
//! Chen & Johan 2010, §4.3, §5.1–5.2, eq. 1, 10–12. Reads contacts, β, slope. Writes β, ω and both one step earlier. Twin: `bend.wgsl`.
//! Differs from the paper: exact solution instead of Euler, vector bend, held cells, floor under resting bodies (docs/papers.md).

use super::coefficients::{Coefficients, RATE_LIMIT, bend_limit};
use crate::interaction::{ABREAST, Hit};
use crate::math::{self, either, mask};

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

/// What a hit does to a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// How far it would push it in the step: Δ of methods §1.2, rad.
    pub delta: f32,
    /// How far it leans at least under the body: atan(depth/h_eff), rad.
    pub floor: f32,
}

/// What hits do to cells of such bends \[rad\], side by side.
#[inline(always)]
pub fn pushes<'a>(co: &Coefficients, asked: impl ExactSizeIterator<Item = ([f32; 2], &'a Hit)>) -> impl Iterator<Item = Push> {
    let (count, none) = (asked.len(), [0.0; ABREAST]);
    let (mut towards, mut way, mut speed, mut height, mut depth) = (none, none, none, [1.0; ABREAST], none);
    for (k, (bend, hit)) in asked.take(ABREAST).enumerate() {
        towards[k] = bend[0] * hit.direction[0] + bend[1] * hit.direction[1];
        way[k] = hit.along * co.step;
        (speed[k], height[k], depth[k]) = (hit.speed, hit.height, hit.depth);
    }
    let (mut delta, mut floor) = (none, none);
    for k in 0..ABREAST {
        let t = math::clamped(towards[k], -1.57, 1.57);
        let pushed = math::atan(math::tan(t) + way[k] / height[k]) - t;
        delta[k] = if speed[k] < HOLDING { 0.0 } else { pushed };
        floor[k] = math::atan(depth[k] / height[k]);
    }
    (0..count.min(ABREAST)).map(move |k| Push { delta: delta[k], floor: floor[k] })
}

#[inline(always)]
fn length(v: [f32; 2]) -> f32 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

#[inline(always)]
fn chosen(mask: u32, yes: [f32; 2], no: [f32; 2]) -> [f32; 2] {
    [either(mask, yes[0], no[0]), either(mask, yes[1], no[1])]
}

#[inline(always)]
fn scaled_to(v: [f32; 2], wanted: f32) -> [f32; 2] {
    let now = length(v);
    let factor = either(mask(now > 1e-12), wanted / math::upper(now, 1e-12), 1.0);
    [v[0] * factor, v[1] * factor]
}

/// `bend` turned towards the unit vector `direction` by at most the turn of one step; ties turn from +x to +z.
#[inline(always)]
fn turned(co: &Coefficients, bend: [f32; 2], direction: [f32; 2]) -> [f32; 2] {
    let size = length(bend);
    let dot = bend[0] * direction[0] + bend[1] * direction[1];
    let cross = bend[0] * direction[1] - bend[1] * direction[0];
    let sine = either(mask(cross >= 0.0), co.turn_sine, -co.turn_sine);
    let turned = [bend[0] * co.turn_cosine - bend[1] * sine, bend[0] * sine + bend[1] * co.turn_cosine];
    chosen(mask(dot >= size * co.turn_cosine), [direction[0] * size, direction[1] * size], turned)
}

/// β and ω of a cell under a body that would push it by `delta`, before the floor (the three cases of methods §1.2).
#[inline(always)]
fn driven(co: &Coefficients, bend: [f32; 2], d: [f32; 2], delta: f32, slope: [f32; 2]) -> [[f32; 2]; 2] {
    let dot = bend[0] * d[0] + bend[1] * d[1];
    let moved = [bend[0] + delta * d[0], bend[1] + delta * d[1]];
    let (along, over) = (mask(dot >= 0.0), mask(length(bend) < OVER_THE_TOP));
    let about = turned(co, bend, d);
    let farther = scaled_to(moved, math::upper(length(moved), length(bend)));
    let next = chosen(along, farther, chosen(over, moved, about));
    let turning = [(about[0] - bend[0]) / co.step, (about[1] - bend[1]) / co.step];
    let rate = chosen(along | over, [d[0] * delta / co.step, d[1] * delta / co.step], turning);
    let limit = bend_limit(slope, next);
    let next = chosen(mask(length(next) > limit), scaled_to(next, limit), next);
    let rate = chosen(mask(length(rate) > RATE_LIMIT), scaled_to(rate, RATE_LIMIT), rate);
    [next, rate]
}

/// The floor under a body: |β| ≥ min(θ_max, `floor`), approached along β itself, along the edge normal only if β has no direction.
#[inline(always)]
fn floored(co: &Coefficients, bend: [f32; 2], normal: [f32; 2], floor: f32, slope: [f32; 2]) -> [f32; 2] {
    let size = length(bend);
    let safe = math::upper(size, 1e-3);
    let along = chosen(mask(size < 1e-3), normal, [bend[0] / safe, bend[1] / safe]);
    let floor = math::lower(bend_limit(slope, along), floor);
    let wanted = math::lower(floor, size + co.approach);
    chosen(mask(size >= floor), bend, [along[0] * wanted, along[1] * wanted])
}

/// Which of the hits on a cell bends it, and which holds it down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// β before, rad.
    pub bend: [f32; 2],
    /// Gradient of the ground.
    pub slope: [f32; 2],
    /// How far the first pushes it, rad.
    pub delta: f32,
    /// How far it leans at least under the second, rad.
    pub floor: f32,
    /// The one with the largest push.
    pub strongest: Hit,
    /// The one with the highest floor.
    pub deepest: Hit,
    /// The number of the first among the hits, counted from 0.
    pub pusher: u32,
    /// That of the second.
    pub deeper: u32,
}

/// Contact of one cell with all bodies that reach it: the largest push wins (ties to the lower body), then the highest floor holds.
/// `hits` are in body order, each with what it does. `None` if nothing touches.
#[inline(always)]
pub fn touch<'a>(bend: [f32; 2], slope: [f32; 2], hits: impl Iterator<Item = (&'a Hit, Push)>) -> Option<Touch> {
    let mut strongest: Option<(f32, &Hit, u32)> = None;
    let mut deepest: Option<(f32, &Hit, u32)> = None;
    for (number, (hit, Push { delta, floor })) in (0..).zip(hits) {
        if strongest.is_none_or(|(best, ..)| delta > best) {
            strongest = Some((delta, hit, number));
        }
        if deepest.is_none_or(|(best, ..)| floor > best) {
            deepest = Some((floor, hit, number));
        }
    }
    let ((delta, hit, pusher), (floor, deep, deeper)) = (strongest?, deepest?);
    Some(Touch { bend, slope, delta, floor, strongest: *hit, deepest: *deep, pusher, deeper })
}

/// Contact of one cell, as [`pushes`], [`touch`] and [`held`] have it of many; `hits` are in body order.
pub fn contact(co: &Coefficients, bend: [f32; 2], slope: [f32; 2], hits: &[Hit]) -> Option<Held> {
    let pushes = hits.chunks(ABREAST).flat_map(|hits| pushes(co, hits.iter().map(|hit| (bend, hit))));
    held(co, &[touch(bend, slope, hits.iter().zip(pushes))?]).next()
}

/// What becomes of the first eight touched cells or fewer, side by side.
#[inline(always)]
pub fn held(co: &Coefficients, touches: &[Touch]) -> impl Iterator<Item = Held> {
    let none = [0.0; ABREAST];
    let (mut bend, mut slope, mut direction, mut normal) = ([none; 2], [none; 2], [none; 2], [none; 2]);
    let (mut delta, mut floor, mut speed, mut high, mut low) = (none, none, none, none, none);
    let (mut pusher, mut deeper) = ([0; ABREAST], [0; ABREAST]);
    for (k, touch) in touches.iter().take(ABREAST).enumerate() {
        for axis in 0..2 {
            (bend[axis][k], slope[axis][k]) = (touch.bend[axis], touch.slope[axis]);
            (direction[axis][k], normal[axis][k]) = (touch.strongest.direction[axis], touch.deepest.normal[axis]);
        }
        (delta[k], floor[k], speed[k]) = (touch.delta, touch.floor, touch.strongest.speed);
        (high[k], low[k]) = (touch.strongest.height, touch.deepest.height);
        (pusher[k], deeper[k]) = (touch.pusher, touch.deeper);
    }
    let (mut next, mut rate) = ([none; 2], [none; 2]);
    for k in 0..ABREAST {
        let (before, slope) = ([bend[0][k], bend[1][k]], [slope[0][k], slope[1][k]]);
        let still = mask(speed[k] < HOLDING);
        let [pushed, moving] = driven(co, before, [direction[0][k], direction[1][k]], delta[k], slope);
        let pushed = floored(co, chosen(still, before, pushed), [normal[0][k], normal[1][k]], floor[k], slope);
        (next[0][k], next[1][k]) = (pushed[0], pushed[1]);
        (rate[0][k], rate[1][k]) = (either(still, 0.0, moving[0]), either(still, 0.0, moving[1]));
    }
    (0..touches.len().min(ABREAST)).map(move |k| {
        // What does not push holds it down.
        let (by, height) = if delta[k] > 0.0 { (pusher[k], high[k]) } else { (deeper[k], low[k]) };
        Held { bend: [next[0][k], next[1][k]], rate: [rate[0][k], rate[1][k]], by, height }
    })
}
