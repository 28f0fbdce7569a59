//! Blades are turned out of bodies and off the ground, joint by joint from the root.
//!
//! Belyaev et al. 2011, §3.4; methods §3.5. A joint turns until the middle, then the end of its segment is outside; what lies above is
//! carried along, and goes on from there. Twin: `push.wgsl`. Differs from the paper: any solid, several sweeps, the ground is one more body.

use super::blade::{ChainCoefficients, MOST_SEGMENTS};
use super::frame::{Frame, bend_towards, product, rotation, to_local};
use super::joint::{BEND_LIMIT, Bends, count, rest_turn};
use super::pressed::Pressed;
use crate::interaction::solid::{Nearness, SolidHead, nearness, stands_on};
use crate::math;
use crate::state::{NONE, Root};

/// Most sweeps from root to tip.
const SWEEPS: u32 = 16;
/// Times a point is taken out of each body in turn.
const ROUNDS: u32 = 2;
/// Sine of the angle below which a segment points straight at what it meets.
const STRAIGHT: f32 = 0.02;
/// Sweeps after which what has not found its way out is turned by the next lower joint.
const PATIENCE: u32 = 2;
/// How a blade lies down: sine and cosine of its tilt over the ground, halfway and nearly flat.
const TILTS: [(f32, f32); 2] = [(0.866_025_4, 0.5), (0.996_194_7, 0.087_155_74)];
/// Turns about the vertical that it tries, cosine and sine: by eighths, the small ones first.
const HEADINGS: [[f32; 2]; 8] = {
    const H: f32 = std::f32::consts::FRAC_1_SQRT_2;
    [[1.0, 0.0], [H, H], [H, -H], [0.0, 1.0], [0.0, -1.0], [-H, H], [-H, -H], [-1.0, 0.0]]
};
/// A tip no farther beside its root than this leans no way, m.
const UPRIGHT: f32 = 1e-6;
/// How far beyond a side a point is taken, m: so that it is not back with the next turn.
const SLACK: f32 = 1e-3;
/// How deep a point may lie, m: less than the millimetre that is promised.
pub const TOLERANCE: f32 = 5e-4;
/// How far above the ground blades keep, m.
const CLEAR: f32 = 1e-3;
/// A body less than this above a root leaves no room to pass below it, m.
const ROOM: f32 = 0.02;

/// Bodies that reach a patch.
#[derive(Clone, Copy)]
pub struct Obstacles<'a> {
    /// Moment by moment.
    pub heads: &'a [SolidHead],
    /// Their planes.
    pub planes: &'a [[f32; 4]],
}

/// How the bodies of a patch lie to one blade, worked out once: bits of the first 32 of them.
#[derive(Clone, Copy)]
pub struct Around {
    /// They can touch it.
    near: u32,
    /// They leave no room to pass below them.
    standing: u32,
    /// The moment of the step that counts; all if [`NONE`].
    moment: u32,
}

/// Solids with bits of their own; others are asked each time.
const BITS: usize = 32;

impl Obstacles<'_> {
    /// None: only the ground.
    pub const NONE: Obstacles<'static> = Obstacles { heads: &[], planes: &[] };

    /// Whether any of them can touch a blade.
    #[inline(always)]
    pub fn reach(&self, root: &Root) -> bool {
        self.heads.iter().any(|solid| reaches(solid, root))
    }

    /// How they lie to a blade.
    #[inline(always)]
    pub fn around(&self, root: &Root) -> Around {
        let mut around = Around { near: 0, standing: 0, moment: NONE };
        for (k, solid) in self.heads.iter().enumerate().take(BITS) {
            if reaches(solid, root) {
                around.near |= 1 << k;
                around.standing |= u32::from(stands_on(solid, self.planes, root.at, ROOM)) << k;
            }
        }
        around
    }

    /// The same of one moment of the step.
    #[inline(always)]
    fn at(&self, around: &Around, moment: u32) -> Around {
        let mut near = 0;
        for (k, solid) in self.heads.iter().enumerate().take(BITS) {
            near |= u32::from(solid.moment == moment) << k;
        }
        Around { near: around.near & near, moment, ..*around }
    }

    /// The next solid from number `k` on that may touch the blade; none is left once that is not below their number. Few of them do, so that
    /// those are not even looked at.
    #[inline(always)]
    fn next(&self, around: &Around, k: usize) -> usize {
        let left = if k < BITS { around.near >> k } else { 0 };
        if left != 0 { k + left.trailing_zeros() as usize } else { k.max(BITS) }
    }

    /// How a point lies to solid number `k`; far away from those that cannot touch the blade.
    #[inline(always)]
    fn nearness(&self, k: usize, around: &Around, root: &Root, at: [f32; 3]) -> Nearness {
        let solid = &self.heads[k];
        if k < BITS {
            return nearness(solid, self.planes, at, around.standing >> k & 1 == 1);
        }
        if !reaches(solid, root) || (around.moment != NONE && solid.moment != around.moment) {
            return Nearness::FAR;
        }
        nearness(solid, self.planes, at, stands_on(solid, self.planes, root.at, ROOM))
    }

    /// Whether a point lies too deep in any of them.
    #[inline(always)]
    fn is_deep(&self, around: &Around, root: &Root, at: [f32; 3]) -> bool {
        self.deep_in(around, root, at).is_some()
    }

    /// The first in which a point lies too deep.
    #[inline(always)]
    fn deep_in(&self, around: &Around, root: &Root, at: [f32; 3]) -> Option<u32> {
        let mut k = self.next(around, 0);
        while k < self.heads.len() {
            if self.nearness(k, around, root, at).distance < -TOLERANCE {
                return Some(k as u32);
            }
            k = self.next(around, k + 1);
        }
        None
    }
}

/// Whether a solid is within a blade's length of its root.
#[inline(always)]
fn reaches(solid: &SolidHead, root: &Root) -> bool {
    let near = |axis: usize| root.at[axis] >= solid.low[axis] - root.length && root.at[axis] <= solid.high[axis] + root.length;
    near(0) && near(2) && solid.low[1] <= root.at[1] + root.length
}

/// Where a point goes that lies too deep in the ground or in bodies: out of one after the other, twice, so that it leaves corners between them.
/// `None` if it lies nowhere too deep. With it the last of the bodies, or [`NONE`].
#[inline(always)]
fn free(obstacles: &Obstacles, around: &Around, root: &Root, at: [f32; 3]) -> Option<([f32; 3], u32)> {
    let [sx, sz] = root.slope;
    let rise = 1.0 / (1.0 + sx * sx + sz * sz).sqrt();
    let (mut there, mut by) = (at, NONE);
    let mut moved = false;
    for _ in 0..ROUNDS {
        let ground = (there[1] - root.at[1] - CLEAR - sx * (there[0] - root.at[0]) - sz * (there[2] - root.at[2])) * rise;
        if ground < -TOLERANCE {
            there = [there[0] + ground * sx * rise, there[1] - ground * rise, there[2] + ground * sz * rise];
            moved = true;
        }
        let mut k = obstacles.next(around, 0);
        while k < obstacles.heads.len() {
            let Nearness { distance, normal } = obstacles.nearness(k, around, root, there);
            if distance < -TOLERANCE {
                there = [0, 1, 2].map(|axis| there[axis] + (SLACK - distance) * normal[axis]);
                (moved, by) = (true, k as u32);
            }
            k = obstacles.next(around, k + 1);
        }
        if !moved {
            return None;
        }
    }
    Some((there, by))
}

/// The middle and the end of a segment of `length` m above `below` that points along `way`.
#[inline(always)]
fn points(below: [f32; 3], way: [f32; 3], length: f32) -> [[f32; 3]; 2] {
    [0.5, 1.0].map(|share: f32| [0, 1, 2].map(|axis| below[axis] + share * length * way[axis]))
}

/// Whether any segment of a blade, or its root, lies too deep in a body at any moment of the step. The ground alone does not count: wind may
/// press blades to it, and pictures lift them.
pub fn is_pushed(co: &ChainCoefficients, root: &Root, base: &Frame, obstacles: &Obstacles, around: &Around, bends: &Bends) -> bool {
    let deep = |at: [f32; 3]| obstacles.is_deep(around, root, at);
    if deep(root.at) {
        return true;
    }
    let (mut frame, mut at) = (*base, root.at);
    let length = root.length / co.segments as f32;
    for i in 0..count(co) {
        frame = product(&frame, &rotation([bends[i][0], bends[i][1] + rest_turn(co, root.curl, i)]));
        let [middle, end] = points(at, frame[2], length);
        if deep(middle) || deep(end) {
            return true;
        }
        at = end;
    }
    false
}

/// Turns a blade out of the bodies of a step, moment by moment. Returns which joints were turned, as bits, and where a body did it.
pub fn push(
    co: &ChainCoefficients,
    root: &Root,
    base: &Frame,
    obstacles: &Obstacles,
    around: &Around,
    bends: &mut Bends,
) -> (u32, Pressed) {
    let (mut turned, mut pressed) = (0, Pressed::NOT);
    let last = obstacles.heads.iter().map(|solid| solid.moment).max().unwrap_or(0);
    for moment in 0..=last {
        let around = obstacles.at(around, moment);
        // A body stands on the root: no joint can turn the blade out of it, so it lies flat under it.
        if let Some(solid) = obstacles.deep_in(&around, root, root.at) {
            *bends = lying(co, root, base, TILTS[1], HEADINGS[0], tip(co, root, base, bends));
            turned = (1 << co.segments) - 1;
            pressed = lying_under(solid, tip(co, root, base, bends));
            continue;
        }
        let mut moved = 1;
        for number in 0..SWEEPS {
            if moved != 0 {
                moved = sweep(co, root, base, (obstacles, &around), number / PATIENCE % co.segments, (bends, &mut pressed));
                turned |= moved;
            }
        }
        if moved != 0 && lies_down(co, root, base, (obstacles, &around), bends) {
            turned = (1 << co.segments) - 1;
            pressed = lying_under(pressed.solid, tip(co, root, base, bends));
        }
    }
    (turned, pressed)
}

/// A blade that lies under a body is touched halfway.
#[inline(always)]
fn lying_under(solid: u32, tip: [f32; 3]) -> Pressed {
    Pressed { solid, joint: 0, arm: tip.map(|part| 0.5 * part), normal: [0.0; 3] }
}

/// The bends with which a blade lies straight, tilted from the ground's normal, its tip turned by a heading from where `tip` is.
fn lying(co: &ChainCoefficients, root: &Root, base: &Frame, (sine, cosine): (f32, f32), [c, s]: [f32; 2], tip: [f32; 3]) -> Bends {
    // One that stands upright falls the way it faces.
    let upright = tip[0] * tip[0] + tip[2] * tip[2] < UPRIGHT * UPRIGHT;
    let [x, z] = if upright { [base[0][0], base[0][2]] } else { [tip[0], tip[2]] };
    let across = math::upper((x * x + z * z).sqrt(), 1e-9);
    let [x, z] = [x / across, z / across];
    let [x, z] = [c * x - s * z, s * x + c * z];
    let direction = [sine * x, cosine + sine * (root.slope[0] * x + root.slope[1] * z), sine * z];
    let size = dot(direction, direction).sqrt();
    let [a, b] = bend_towards(to_local(base, direction.map(|part| part / size)));
    let mut lying: Bends = [[0.0; 2]; MOST_SEGMENTS];
    for (i, bend) in lying.iter_mut().enumerate().take(count(co)) {
        let rest = rest_turn(co, root.curl, i);
        *bend = if i == 0 { [a, b - rest] } else { [0.0, -rest] };
    }
    lying
}

/// Where sweeps go to and fro in a corner between bodies, a blade lies down straight: the way its tip points, or the next one to that which is
/// free. Returns whether there is one; else the bends stay.
fn lies_down(co: &ChainCoefficients, root: &Root, base: &Frame, by: (&Obstacles, &Around), bends: &mut Bends) -> bool {
    let tip = tip(co, root, base, bends);
    for tilt in TILTS {
        for heading in HEADINGS {
            let mut lying = lying(co, root, base, tilt, heading, tip);
            if sweep(co, root, base, by, 0, (&mut lying, &mut { Pressed::NOT })) == 0 {
                *bends = lying;
                return true;
            }
        }
    }
    false
}

/// Where the tip is, m from the root.
#[inline(always)]
pub(super) fn tip(co: &ChainCoefficients, root: &Root, base: &Frame, bends: &Bends) -> [f32; 3] {
    let (mut frame, mut at) = (*base, [0.0; 3]);
    let length = root.length / co.segments as f32;
    for i in 0..count(co) {
        frame = product(&frame, &rotation([bends[i][0], bends[i][1] + rest_turn(co, root.curl, i)]));
        at = points(at, frame[2], length)[1];
    }
    at
}

/// The blade of a sweep: bends, and what follows from them.
struct Posture<'a> {
    co: &'a ChainCoefficients,
    curl: f32,
    /// m.
    length: f32,
    bends: &'a mut Bends,
    /// Frame below each joint, then of the last segment.
    frames: [Frame; MOST_SEGMENTS + 1],
    /// Where each joint is, then the tip.
    places: [[f32; 3]; MOST_SEGMENTS + 1],
}

impl Posture<'_> {
    /// Works segment `i` out from the one below.
    #[inline(always)]
    fn follow(&mut self, i: usize) {
        let [x, y] = self.bends[i];
        self.frames[i + 1] = product(&self.frames[i], &rotation([x, y + rest_turn(self.co, self.curl, i)]));
        self.places[i + 1] = points(self.places[i], self.frames[i + 1][2], self.length)[1];
    }

    /// Turns joint `j` so that `from` comes as far along the way to `to` as that one is: exactly on a plane there, where it can reach it.
    #[inline(always)]
    fn turn(&mut self, j: usize, from: [f32; 3], to: [f32; 3]) {
        let way = minus(to, from);
        let far = math::upper(dot(way, way).sqrt(), 1e-9);
        let normal = way.map(|part| part / far);
        let arm = minus(from, self.places[j]);
        let lever = math::upper(dot(arm, arm).sqrt(), 1e-9);
        let u = arm.map(|part| part / lever);
        let along = dot(normal, u);
        let wanted = math::clamped(along + far / lever, -1.0, 1.0);
        // Straight at the body there is no side to turn to but the blade's own.
        let across = |v: [f32; 3]| minus(v, normal.map(|part| part * dot(normal, v)));
        let (own, side) = (across(self.frames[j + 1][0]), across(u));
        let side = if dot(side, side) > STRAIGHT * STRAIGHT { side } else { own };
        let rest = (1.0 - wanted * wanted).sqrt() / math::upper(dot(side, side).sqrt(), 1e-9);
        let w = [0, 1, 2].map(|axis| wanted * normal[axis] + rest * side[axis]);
        // The rotation that takes u to w, of the segment's direction: no angle is needed.
        let d = self.frames[j + 1][2];
        let share = (dot(u, d) + dot(w, d)) / math::upper(1.0 + dot(u, w), 1e-3);
        let turned = [0, 1, 2].map(|axis| d[axis] - share * (u[axis] + w[axis]) + 2.0 * dot(u, d) * w[axis]);
        let size = math::upper(dot(turned, turned).sqrt(), 1e-9);
        let [x, y] = bend_towards(to_local(&self.frames[j], turned.map(|part| part / size)));
        let bend = [x, y - rest_turn(self.co, self.curl, j)];
        let bent = (bend[0] * bend[0] + bend[1] * bend[1]).sqrt();
        let share = if bent > BEND_LIMIT { BEND_LIMIT / bent } else { 1.0 };
        self.bends[j] = [bend[0] * share, bend[1] * share];
    }
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// One sweep from root to tip; what does not find its way out by its own joint is turned by one `lower` than that. Returns which joints were
/// turned, as bits.
#[inline(always)]
fn sweep(
    co: &ChainCoefficients,
    root: &Root,
    base: &Frame,
    (obstacles, around): (&Obstacles, &Around),
    lower: u32,
    (bends, pressed): (&mut Bends, &mut Pressed),
) -> u32 {
    let length = root.length / co.segments as f32;
    let (frames, places) = ([*base; MOST_SEGMENTS + 1], [root.at; MOST_SEGMENTS + 1]);
    let mut blade = Posture { co, curl: root.curl, length, bends, frames, places };
    let mut turned = 0;
    for i in 0..count(co) {
        blade.follow(i);
        for end in 0..2 {
            let point = points(blade.places[i], blade.frames[i + 1][2], length)[end];
            let Some((there, by)) = free(obstacles, around, root, point) else { continue };
            let j = i.saturating_sub(lower as usize);
            if by != NONE && j as u32 <= pressed.joint {
                let way = minus(there, point);
                let far = math::upper(dot(way, way).sqrt(), 1e-9);
                let (arm, normal) = (minus(there, blade.places[j]), way.map(|part| part / far));
                *pressed = Pressed { solid: by, joint: j as u32, arm, normal };
            }
            blade.turn(j, point, there);
            (j..=i).for_each(|k| blade.follow(k));
            turned |= 1 << j;
        }
    }
    turned
}
