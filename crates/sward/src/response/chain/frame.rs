//! Rotations of a chain: three columns, the segment's own axes seen in the world.
//!
//! Local z runs along a segment, root to tip; x and y are across it. World +y is up.

use crate::math;

/// A rotation by its columns: `frame[2]` is where local z points.
pub type Frame = [[f32; 3]; 3];

/// A vertical blade that is not turned: its x is the world's x, its y the world's −z, its z the world's y (up).
pub const UPRIGHT: Frame = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];

/// The base T₀ of a blade planted with its face towards `yaw` \[rad, from +x towards +z\] and leaning that way by `tilt` \[rad from
/// upright\]: the dummy segment of Belyaev et al. 2011, §3.1.
pub fn planted(yaw: f32, tilt: f32) -> Frame {
    let (s, c) = math::sin_cos(yaw);
    let (lean, rise) = math::sin_cos(tilt);
    [[c * rise, -lean, s * rise], [s, 0.0, -c], [c * lean, rise, s * lean]]
}

/// M(ψ): the rotation by |ψ| about (ψ_x, ψ_y, 0), exactly.
#[inline(always)]
pub fn rotation([a, b]: [f32; 2]) -> Frame {
    let angle = math::upper((a * a + b * b).sqrt(), 1e-9);
    let (half_sine, half_cosine) = math::sin_cos(0.5 * angle);
    // sin θ/θ and (1 − cos θ)/θ² by half angles: no cancellation at small θ, and no case of its own at 0.
    let (sine, cosine) = (half_sine / angle, half_cosine);
    let s = 2.0 * sine * cosine;
    let c = 2.0 * sine * sine;
    [[1.0 - c * b * b, c * a * b, -s * b], [c * a * b, 1.0 - c * a * a, s * a], [s * b, -s * a, 1.0 - c * (a * a + b * b)]]
}

/// A vector of a frame's axes, seen in the world.
#[inline(always)]
pub fn to_world(frame: &Frame, v: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|axis| frame[0][axis] * v[0] + frame[1][axis] * v[1] + frame[2][axis] * v[2])
}

/// A vector of the world, seen in a frame's axes.
#[inline(always)]
pub fn to_local(frame: &Frame, v: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|column| frame[column][0] * v[0] + frame[column][1] * v[1] + frame[column][2] * v[2])
}

/// First `inner`, then `outer`.
#[inline(always)]
pub fn product(outer: &Frame, inner: &Frame) -> Frame {
    inner.map(|column| to_world(outer, column))
}

/// The rotation vector (across z, no twist) that brings z to `direction`, a unit vector in the same axes: M of it points there.
#[inline(always)]
pub fn bend_towards(direction: [f32; 3]) -> [f32; 2] {
    let [x, y, z] = direction;
    let across = (x * x + y * y).sqrt();
    let share = math::atan2(across, z) / math::upper(across, 1e-9);
    [-y * share, x * share]
}
