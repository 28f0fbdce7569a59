//! What moves the air: sources, bodies and obstacles.
//!
//! Methods §5. Twin: `force.wgsl`. Not in the paper: bodies, as a penalty on what air does otherwise than they, before the projection.

use super::fft::Complex;
use super::real::Real;

/// A place where air is pushed in this step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gust {
    /// Middle, m from the plane's corner.
    pub at: [f32; 2],
    /// Radius, m.
    pub radius: f32,
    /// Change of velocity in the middle, m/s.
    pub change: [f32; 2],
}

/// A round body, or a part of one, that holds or carries air in this step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// Middle, m from the plane's corner.
    pub at: [f32; 2],
    /// Half width and half height, m.
    pub half: [f32; 2],
    /// Its own velocity, m/s.
    pub velocity: [f32; 2],
    /// Share of the difference that is left after this step in its middle, 0 to 1: 0 holds all air.
    pub leaves: f32,
}

/// Square of the distance of a cell from a place, in radii, the nearest way round.
#[inline(always)]
fn away(index: usize, side: usize, cell: f32, at: [f32; 2], radii: [f32; 2]) -> f32 {
    let width = side as f32 * cell;
    let off = |along: usize, axis: usize| {
        let straight = (along as f32 + 0.5) * cell - at[axis];
        let round = straight - width * crate::math::floored(straight / width + 0.5) as f32;
        round / radii[axis]
    };
    let (x, y) = (off(index % side, 0), off(index / side, 1));
    x * x + y * y
}

/// 1 in the middle, 0 at the rim and beyond, smooth there.
#[inline(always)]
fn bump(away: f32) -> f32 {
    if away < 1.0 { (1.0 - away) * (1.0 - away) } else { 0.0 }
}

/// Adds gusts to a flow on cells of `cell` \[m\].
pub fn push<T: Real>(flow: &mut [Complex<T>], side: usize, cell: f32, gusts: &[Gust]) {
    for gust in gusts {
        for (index, velocity) in flow.iter_mut().enumerate() {
            let share = bump(away(index, side, cell, gust.at, [gust.radius; 2]));
            *velocity = [0, 1].map(|axis: usize| velocity[axis] + T::of(f64::from(share * gust.change[axis])));
        }
    }
}

/// Lets bodies drag the flow along.
pub fn drag<T: Real>(flow: &mut [Complex<T>], side: usize, cell: f32, bodies: &[Drag]) {
    for body in bodies {
        for (index, velocity) in flow.iter_mut().enumerate() {
            // Full inside two thirds of the body, none outside it.
            let inside = bump(away(index, side, cell, body.at, body.half)) * 3.2;
            let share = T::of(f64::from((1.0 - body.leaves) * if inside < 1.0 { inside } else { 1.0 }));
            *velocity = [0, 1].map(|axis: usize| velocity[axis] + (T::of(f64::from(body.velocity[axis])) - velocity[axis]) * share);
        }
    }
}
