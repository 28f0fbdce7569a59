//! A branch's middle line: bent, tapering, with a frame that does not twist.

use glam::Vec3;

use super::chance::{Chance, square_to};

/// A place on a branch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    pub(super) place: Vec3,
    /// Unit, towards the tip.
    pub(super) forward: Vec3,
    /// Unit, square to it.
    pub(super) side: Vec3,
    pub(super) radius: f32,
}

/// A branch to be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branch {
    pub(super) start: Vec3,
    pub(super) direction: Vec3,
    pub(super) length: f32,
    pub(super) radius: f32,
    pub(super) level: usize,
    pub(super) key: u32,
}

/// Lowest place that a branch heads for; the plant is as high as about 1.
const GROUND: f32 = 0.035;

/// A direction that does not lead below the ground within a length.
pub(super) fn above_ground(place: Vec3, direction: Vec3, length: f32) -> Vec3 {
    let least = (GROUND - place.y) / length;
    let least = if least > 0.95 { 0.95 } else { least };
    if direction.y >= least { direction } else { Vec3::new(direction.x, least, direction.z).normalize_or(Vec3::Y) }
}

/// How branches of a level run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) segments: u32,
    /// How far it turns upwards on its whole length; below 0 it hangs.
    pub(super) rise: f32,
    /// How far it bends aside, at random.
    pub(super) bend: f32,
    /// Radius at the tip as a share of that at the start.
    pub(super) tip: f32,
    /// How much wider it begins, as a share.
    pub(super) flare: f32,
}

/// The joints of a branch from start to tip, `segments + 1` of them.
pub(super) fn line(branch: &Branch, run: &Run, chance: &mut Chance) -> Vec<Joint> {
    let step = 1.0 / run.segments as f32;
    // Two bends that pass into each other make an S.
    let (first, last) = (chance.vector() * run.bend, chance.vector() * run.bend);
    let mut forward = above_ground(branch.start, branch.direction.normalize_or(Vec3::Y), branch.length);
    let mut side = square_to(forward);
    let mut place = branch.start;
    let mut joints = Vec::with_capacity(run.segments as usize + 1);
    for k in 0..=run.segments {
        let t = k as f32 * step;
        let flare = 1.0 - t * 7.0;
        let flare = if flare > 0.0 { run.flare * flare * flare } else { 0.0 };
        let radius = branch.radius * (1.0 - (1.0 - run.tip) * t + flare);
        joints.push(Joint { place, forward, side, radius });
        place += forward * (branch.length * step);
        let turn = first * (1.0 - t) + last * t + Vec3::Y * run.rise;
        forward = above_ground(place, (forward + turn * step).normalize_or(forward), branch.length * (1.0 - t + step));
        side = (side - forward * forward.dot(side)).normalize_or(square_to(forward));
    }
    joints
}

/// The place at a share of the way from start to tip.
pub(super) fn at(joints: &[Joint], share: f32) -> Joint {
    let along = share * (joints.len() - 1) as f32;
    let first = (along as usize).min(joints.len() - 2);
    let (a, b, t) = (joints[first], joints[first + 1], along - first as f32);
    let forward = (a.forward + (b.forward - a.forward) * t).normalize_or(a.forward);
    let side = a.side - forward * forward.dot(a.side);
    Joint {
        place: a.place + (b.place - a.place) * t,
        forward,
        side: side.normalize_or(square_to(forward)),
        radius: a.radius + (b.radius - a.radius) * t,
    }
}
