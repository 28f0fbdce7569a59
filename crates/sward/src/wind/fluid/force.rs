//! What moves the air: sources, bodies and obstacles.
//!
//! Methods §5. Twin: `force.wgsl`. Not in the paper: bodies, as a penalty on what air does otherwise than they, before the projection.

use super::fft::Complex;
use super::real::Real;
use crate::math::floored;

/// Share of a body's half width within which it holds air fully, as [`bump`] times this.
const HOLDS: f32 = 3.2;

/// A place where air is pushed in this step. The same bytes as in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Gust {
    /// Middle, m from the plane's corner.
    pub at: [f32; 2],
    /// Change of velocity in the middle, m/s.
    pub change: [f32; 2],
    /// Radius, m.
    pub radius: f32,
    /// Fills it to 32 bytes; 0.
    pub unused: [f32; 3],
}

/// An oval body, or a part of one, that holds or carries air in this step. The same bytes as in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Drag {
    /// Middle, m from the plane's corner.
    pub at: [f32; 2],
    /// Half width and half length, m.
    pub half: [f32; 2],
    /// Its own velocity, m/s.
    pub velocity: [f32; 2],
    /// cos and sin of its yaw, which turns its length from +z towards +x.
    pub turn: [f32; 2],
    /// Share of the difference that is left after this step in its middle, 0 to 1: 0 holds all air.
    pub leaves: f32,
    /// Fills it to 48 bytes; 0.
    pub unused: [f32; 3],
}

/// From `at` to the middle of a cell along one axis \[m\], the nearest way round.
#[inline(always)]
fn off(along: usize, side: usize, cell: f32, at: f32) -> f32 {
    let width = side as f32 * cell;
    let straight = (along as f32 + 0.5) * cell - at;
    straight - width * floored(straight / width + 0.5) as f32
}

/// 1 in the middle, 0 at the rim and beyond, smooth there; of the square of the distance in radii.
#[inline(always)]
fn bump(away: f32) -> f32 {
    if away < 1.0 { (1.0 - away) * (1.0 - away) } else { 0.0 }
}

impl Gust {
    /// Share of its change that reaches a place \[m from its middle\].
    #[inline(always)]
    fn share(&self, [x, y]: [f32; 2]) -> f32 {
        let (x, y) = (x / self.radius, y / self.radius);
        bump(x * x + y * y)
    }
}

impl Drag {
    /// Share of the difference that it takes at a place \[m from its middle\]: full inside two thirds of the body, none outside it.
    #[inline(always)]
    fn share(&self, [x, y]: [f32; 2]) -> f32 {
        let [cosine, sine] = self.turn;
        let (across, along) = ((cosine * x - sine * y) / self.half[0], (sine * x + cosine * y) / self.half[1]);
        let inside = bump(across * across + along * along) * HOLDS;
        (1.0 - self.leaves) * if inside < 1.0 { inside } else { 1.0 }
    }
}

/// Calls `change` for the cells of the rows within `reach` \[m\] of a place, with the way there from it \[m\].
#[inline(always)]
fn near<T: Real>(flow: &mut [Complex<T>], side: usize, cell: f32, at: [f32; 2], reach: f32, change: impl Fn([f32; 2], &mut Complex<T>)) {
    for (row, cells) in flow.chunks_exact_mut(side).enumerate() {
        let y = off(row, side, cell, at[1]);
        if y < reach && y > -reach {
            cells.iter_mut().enumerate().for_each(|(column, velocity)| change([off(column, side, cell, at[0]), y], velocity));
        }
    }
}

/// Adds gusts to a flow on cells of `cell` \[m\].
pub fn push<T: Real>(flow: &mut [Complex<T>], side: usize, cell: f32, gusts: &[Gust]) {
    for gust in gusts {
        near(flow, side, cell, gust.at, gust.radius, |from, velocity| {
            let share = gust.share(from);
            *velocity = [0, 1].map(|axis: usize| velocity[axis] + T::of(f64::from(share * gust.change[axis])));
        });
    }
}

/// Lets bodies drag the flow along.
pub fn drag<T: Real>(flow: &mut [Complex<T>], side: usize, cell: f32, bodies: &[Drag]) {
    for body in bodies {
        let reach = body.half[0] + body.half[1];
        near(flow, side, cell, body.at, reach, |from, velocity| {
            let share = T::of(f64::from(body.share(from)));
            *velocity = [0, 1].map(|axis: usize| velocity[axis] + (T::of(f64::from(body.velocity[axis])) - velocity[axis]) * share);
        });
    }
}
