//! Blades without a state: the moments of one virtual blade bend all real ones around it.
//!
//! Belyaev et al. 2011, §3.3; methods §3.4. A vertical blade per place of the wind runs as [`super::step`]; the moments that would hold
//! it where it is are stored, and a real blade, planted as it may be, is where they and its own weight hold it.
//! Twin: `virtual_inertia.wgsl`. Differs from the paper: moments are turned into the real blade's base, and Newton's factor makes three
//! turns enough (docs/papers.md).

use super::blade::{ChainCoefficients, MOST_SEGMENTS};
use super::frame::{Frame, product, rotation, to_local, to_world};
use super::joint::{BEND_LIMIT, Bends, count, rest_turn};
use crate::math;

/// Turns of the equilibrium per segment.
const TURNS: u32 = 3;
/// Least slope of the equilibrium: a segment near falling over still moves by no more than four times what is missing.
const LEAST_SLOPE: f32 = 0.25;

/// Moment of the weight of a segment in frame `turned`, N·m: l × TᵀG across the segment.
#[inline(always)]
fn weight_moment(co: &ChainCoefficients, turned: &Frame) -> [f32; 2] {
    let moment = co.half_length * co.weight;
    [moment * turned[1][1], -moment * turned[0][1]]
}

/// What holds a virtual blade in these bends beside springs and weight, N·m: `m_i = k̂_i ψ_i − l × T_iᵀG` in segment i's own axes.
/// `base` is the virtual blade's: [`super::UPRIGHT`].
pub fn moments(co: &ChainCoefficients, base: &Frame, bends: &Bends) -> Bends {
    let mut held = [[0.0; 2]; MOST_SEGMENTS];
    let mut frame = *base;
    for i in 0..count(co) {
        frame = product(&frame, &rotation(bends[i]));
        let weight = weight_moment(co, &frame);
        let spring = co.joints[i].stiffness;
        held[i] = [spring * bends[i][0] - weight[0], spring * bends[i][1] - weight[1]];
    }
    held
}

/// A virtual blade's moment for a real one: turned by the difference of the two bases, `T₀ᵀ T₀ᵛ m`, what lies across the segment.
#[inline(always)]
pub fn turned(base: &Frame, virtual_base: &Frame, moment: [f32; 2]) -> [f32; 2] {
    let [x, y, _] = to_local(base, to_world(virtual_base, [moment[0], moment[1], 0.0]));
    [x, y]
}

/// Where `moments` (turned into the blade's base) and weight hold a blade that curls at rest as [`super::rest_turn`] says: three damped
/// Newton turns per segment from ψ = 0.
pub fn pose(co: &ChainCoefficients, base: &Frame, curl: f32, moments: &Bends) -> Bends {
    let mut bends = [[0.0; 2]; MOST_SEGMENTS];
    let mut below = *base;
    let lever = co.half_length * co.weight;
    for i in 0..count(co) {
        let spring = co.joints[i].stiffness;
        let heavy = lever / spring;
        let rest = rest_turn(co, curl, i);
        let mut bend = [0.0; 2];
        let mut turn = rotation([0.0, rest]);
        // How far each axis below rises, and with it each of the segment's own.
        let rise = [below[0][1], below[1][1], below[2][1]];
        for _ in 0..TURNS {
            let own = to_local(&turn, rise);
            let weight = [lever * own[1], -lever * own[0]];
            let slope = math::upper(1.0 - heavy * own[2], LEAST_SLOPE);
            for axis in 0..2 {
                bend[axis] += ((moments[i][axis] + weight[axis]) / spring - bend[axis]) / slope;
            }
            let size = (bend[0] * bend[0] + bend[1] * bend[1]).sqrt();
            let share = if size > BEND_LIMIT { BEND_LIMIT / size } else { 1.0 };
            bend = [bend[0] * share, bend[1] * share];
            turn = rotation([bend[0], bend[1] + rest]);
        }
        bends[i] = bend;
        below = product(&below, &turn);
    }
    bends
}
