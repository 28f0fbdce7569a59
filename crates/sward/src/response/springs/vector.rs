//! Vectors of three numbers, and directions between directions.

use crate::math;

/// Cosine beyond which two directions count as opposite: between those there is no shortest way.
const OPPOSITE: f32 = -0.999_9;
/// Sine below which two directions are so near that the straight way between them will do.
const NEAR: f32 = 1e-3;

#[inline(always)]
pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn plus(a: [f32; 3], b: [f32; 3], share: f32) -> [f32; 3] {
    [a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]]
}

#[inline(always)]
pub(super) fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(super) fn size(a: [f32; 3]) -> f32 {
    dot(a, a).sqrt()
}

/// A vector at length 1; upright where it has none.
#[inline(always)]
pub(super) fn unit(a: [f32; 3]) -> [f32; 3] {
    let long = size(a);
    if long > 1e-9 { a.map(|part| part / long) } else { [0.0, 1.0, 0.0] }
}

#[inline(always)]
fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The direction a `share` of the way from one to another (0 to 1), evenly along the great circle; opposite ones by way of upright.
#[inline(always)]
pub(super) fn between(a: [f32; 3], b: [f32; 3], share: f32) -> [f32; 3] {
    if dot(a, b) < OPPOSITE {
        // Halfway is upright, or if both are that, level.
        let middle = if a[1] * a[1] < 0.5 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
        return if share < 0.5 { along(a, middle, 2.0 * share) } else { along(middle, b, 2.0 * share - 1.0) };
    }
    along(a, b, share)
}

#[inline(always)]
fn along(a: [f32; 3], b: [f32; 3], share: f32) -> [f32; 3] {
    let sine = size(cross(a, b));
    if sine < NEAR {
        return unit(plus(a, minus(b, a), share));
    }
    let angle = math::atan2(sine, dot(a, b));
    let (from, to) = (math::sin_cos(angle * (1.0 - share)).0 / sine, math::sin_cos(angle * share).0 / sine);
    unit(plus(a.map(|part| part * from), b, to))
}
