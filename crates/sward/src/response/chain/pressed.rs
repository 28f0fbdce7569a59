//! What a body feels of a blade that it has pushed aside.
//!
//! Not in the paper. The lowest joint that a body has turned holds as its spring and the weight above it have it; that moment acts where the body touches the blade, along
//! the way by which the body pushed it, so the body's own way does as much work on the blade as its springs take up (docs/papers.md). Springs and weight are those of the
//! full chain. Twin: `pressed.wgsl`.

use super::blade::ChainCoefficients;
use super::frame::{Frame, product, rotation, to_world};
use super::joint::{Bends, count, rest_turn};
use super::push::tip;
use crate::interaction::reaction::{CRUSHED, Felt, cross};
use crate::math;
use crate::state::{NONE, Root};

/// A push along a blade turns it as if by at least the root of this share of its arm.
const SLANTED: f32 = 0.01;

/// Where a body last pushed a blade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressed {
    /// Which of the obstacles did, or [`NONE`].
    pub solid: u32,
    /// The lowest joint that it turned.
    pub joint: u32,
    /// From that joint to where it touches the blade, m.
    pub arm: [f32; 3],
    /// Where it pushed it to, unit; zero where the blade lies under it.
    pub normal: [f32; 3],
}

impl Pressed {
    /// Nothing did.
    pub const NOT: Self = Self { solid: NONE, joint: u32::MAX, arm: [0.0; 3], normal: [0.0; 3] };
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Stiffness of a joint of the full chain, N·m/rad: that of the simplified one leans as N segments pull.
#[inline(always)]
fn stiffness(co: &ChainCoefficients, joint: usize) -> f32 {
    let above = (count(co) - joint) as f32;
    co.joints[joint].stiffness * above * above
}

/// Energy of its springs, J.
#[inline(always)]
pub fn spring_energy(co: &ChainCoefficients, bends: &Bends) -> f32 {
    let mut energy = 0.0;
    for (i, [x, y]) in bends.iter().enumerate().take(count(co)) {
        energy += 0.5 * stiffness(co, i) * (x * x + y * y);
    }
    energy
}

/// Whether a blade leans farther than what is crushed does.
#[inline(always)]
fn is_down(co: &ChainCoefficients, root: &Root, base: &Frame, bends: &Bends) -> bool {
    let tip = tip(co, root, base, bends);
    let (_, cosine) = math::sin_cos(CRUSHED);
    tip[1] < cosine * math::upper(dot(tip, tip).sqrt(), 1e-9)
}

/// What the body feels about `about` (m, as the root's): the blade stood as `before` has it before the step, and stands as `bends` now.
#[inline(always)]
pub fn felt(co: &ChainCoefficients, root: &Root, base: &Frame, pressed: &Pressed, before: &Bends, bends: &Bends, about: [f32; 3]) -> Felt {
    let length = root.length / co.segments as f32;
    let (mut frame, mut at) = (*base, root.at);
    let (mut joint, mut moment, mut lever) = (root.at, [0.0; 3], [0.0; 3]);
    // Weight pulls at the middles of all segments above the joint; its moment has no part about the vertical.
    for i in 0..count(co) {
        if i as u32 == pressed.joint {
            let spring = stiffness(co, i);
            (joint, moment) = (at, to_world(&frame, [spring * bends[i][0], spring * bends[i][1], 0.0]));
        }
        frame = product(&frame, &rotation([bends[i][0], bends[i][1] + rest_turn(co, root.curl, i)]));
        if i as u32 >= pressed.joint {
            let middle = [0, 1, 2].map(|axis| at[axis] + 0.5 * length * frame[2][axis] - joint[axis]);
            lever = [0, 1, 2].map(|axis| lever[axis] + middle[axis]);
        }
        at = [0, 1, 2].map(|axis| at[axis] + length * frame[2][axis]);
    }
    let fallen = cross(lever, [0.0, -co.weight, 0.0]);
    let needed = [0, 1, 2].map(|axis| moment[axis] - fallen[axis]);
    // Along the push, or square to a blade that lies.
    let along = if dot(pressed.normal, pressed.normal) > 0.0 { pressed.normal } else { unit(cross(needed, pressed.arm)) };
    let turn = cross(pressed.arm, along);
    let size = math::upper(dot(needed, turn) / math::upper(dot(turn, turn), SLANTED * dot(pressed.arm, pressed.arm) + 1e-8), 0.0);
    let force = along.map(|part| -size * part);
    let arm = [0, 1, 2].map(|axis| joint[axis] + pressed.arm[axis] - about[axis]);
    let fell = is_down(co, root, base, bends) && !is_down(co, root, base, before);
    Felt { force, moment: cross(arm, force), crushed: if fell { spring_energy(co, bends) } else { 0.0 } }
}

#[inline(always)]
fn unit(v: [f32; 3]) -> [f32; 3] {
    let size = math::upper(dot(v, v).sqrt(), 1e-12);
    v.map(|part| part / size)
}
