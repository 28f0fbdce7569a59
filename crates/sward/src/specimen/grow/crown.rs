//! Bushes and trees: branches that bear branches, and leaves on the last.

use glam::Vec3;

use super::super::Kind;
use super::blade::{Leaf, leaf};
use super::branch::{Branch, Joint, above_ground, at, line};
use super::chance::{Chance, GOLDEN, leaning, ring};
use super::forms::Plan;
use super::mesh::{Grown, Piece};
use super::tube;
use crate::math::sin_cos;

/// What hears of branches.
trait Sink {
    fn wood(&mut self, joints: &[Joint], sides: u32);
    /// A stretch that bears leaves, from a share of its length to the tip.
    fn leafy(&mut self, joints: &[Joint], from: f32, length: f32, chance: Chance);
}

/// Counts before anything is made.
#[derive(Default)]
struct Counted {
    triangles: u64,
    /// Metres that bear leaves.
    leafy: f64,
}

impl Sink for Counted {
    fn wood(&mut self, joints: &[Joint], sides: u32) {
        self.triangles += tube::count(joints.len(), sides);
    }

    fn leafy(&mut self, _: &[Joint], from: f32, length: f32, _: Chance) {
        self.leafy += f64::from(length * (1.0 - from));
    }
}

struct Made<'a> {
    plan: &'a Plan,
    pieces: [Piece; 3],
    wood: Piece,
    /// Leaves a metre.
    density: f64,
    /// Metres so far.
    passed: f64,
    leaves: u64,
    /// Length of a leaf of mean size.
    size: f32,
}

impl Sink for Made<'_> {
    fn wood(&mut self, joints: &[Joint], sides: u32) {
        tube::tube(&mut self.wood, joints, sides, 0.0);
    }

    fn leafy(&mut self, joints: &[Joint], from: f32, length: f32, mut chance: Chance) {
        self.passed += f64::from(length * (1.0 - from));
        let due = (self.passed * self.density) as u64;
        let count = due - self.leaves;
        self.leaves = due;
        let around = chance.turn();
        for number in 0..count {
            // One at the tip, the others at the golden angle round the branch.
            let share = 1.0 - (1.0 - from) * (number as f32 + 0.4 * chance.next()) / count as f32;
            let joint = at(joints, share);
            let turn = around + number as f32 * GOLDEN;
            self.leaf(&joint, turn, if number == 0 { 0.25 } else { 0.95 }, &mut chance);
        }
    }
}

impl Made<'_> {
    fn leaf(&mut self, joint: &Joint, turn: f32, angle: f32, chance: &mut Chance) {
        let out = ring(joint.forward, joint.side, turn);
        let away = (joint.place - Vec3::Y * self.plan.middle).normalize_or(Vec3::Y);
        // Blades reach for the light, and hang by their weight.
        let along = leaning(joint.forward, joint.side, turn, angle + chance.within(-0.3, 0.3));
        let along = (along + away * 0.3 - Vec3::Y * chance.within(0.0, 0.45)).normalize_or(out);
        let face = Vec3::Y * 0.75 + away * 0.55 + chance.vector() * 0.5;
        let up = (face - along * along.dot(face)).normalize_or(joint.side);
        let length = self.size * chance.within(0.72, 1.28);
        let along = above_ground(joint.place, along, length);
        let up = (up - along * along.dot(up)).normalize_or(joint.side);
        let made = Leaf {
            base: joint.place + out * (joint.radius * 0.8),
            along,
            up,
            length,
            half: length * self.plan.half * chance.within(0.85, 1.15),
            fold: chance.within(0.12, 0.5),
            droop: chance.within(0.02, 0.3),
        };
        // Light leaves are outside and at the top, dark ones within.
        let reach = (joint.place - Vec3::Y * self.plan.middle).length() / self.plan.radius;
        let light = 0.35 * away.y + reach - 0.7 + chance.within(-0.45, 0.45);
        let which = if light > 0.62 { 2 } else { usize::from(light > 0.0) };
        leaf(&mut self.pieces[which], &made, self.plan.detail);
    }
}

/// How long the branch at a share of an oval crown's height is.
fn oval(share: f32) -> f32 {
    let away = (share - 0.3) / if share < 0.3 { 0.66 } else { 0.72 };
    let left = 1.0 - away * away;
    if left > 0.05 { left.sqrt() } else { 0.23 }
}

fn branch(plan: &Plan, own: &Branch, sink: &mut dyn Sink) {
    let Some(level) = plan.levels.get(own.level) else { return };
    let mut chance = Chance::new(own.key);
    let joints = line(own, &level.run, &mut chance);
    sink.wood(&joints, level.sides);
    if level.leafy > 0.0 {
        sink.leafy(&joints, 1.0 - level.leafy, own.length, Chance::new(chance.child(u32::MAX)));
    }
    if own.level + 1 == plan.levels.len() {
        return;
    }
    let count = (level.children + chance.next()) as u32;
    let thickness = plan.levels[own.level + 1].thickness;
    let around = chance.turn();
    for number in 0..count {
        let place = (number as f32 + chance.next()) / count as f32;
        let share = level.first + (0.98 - level.first) * place;
        let joint = at(&joints, share);
        let turn = around + number as f32 * GOLDEN + chance.within(-0.35, 0.35);
        let angle = level.angles[0] + (level.angles[1] - level.angles[0]) * share + chance.within(-0.18, 0.18);
        let profile = if level.oval { oval(place) } else { 1.0 - 0.6 * place };
        let length = own.length * level.ratio * profile * chance.within(0.78, 1.22);
        let radius = length * thickness;
        let most = joint.radius * 0.75;
        let child = Branch {
            start: joint.place,
            direction: leaning(joint.forward, joint.side, turn, angle),
            length,
            radius: if radius < most { radius } else { most },
            level: own.level + 1,
            key: chance.child(number),
        };
        branch(plan, &child, sink);
    }
}

/// All stems of a plant.
fn walk(plan: &Plan, seed: u32, sink: &mut dyn Sink) {
    let Some(level) = plan.levels.first() else { return };
    let mut chance = Chance::new(seed);
    for number in 0..plan.stems {
        // Evenly over a disc; the outer, the more it leans.
        let share = ((number as f32 + 0.5) / plan.stems as f32).sqrt();
        let (sine, cosine) = sin_cos(number as f32 * GOLDEN + chance.within(-0.3, 0.3));
        let out = Vec3::new(cosine, 0.0, sine);
        let lean = plan.lean * share + chance.within(-0.12, 0.12);
        let (sine, cosine) = sin_cos(lean);
        // Stems that lean are shorter, so that tips lie on a dome.
        let length = if plan.stems == 1 { 0.95 } else { 0.94 - 0.4 * share * share } * chance.within(0.88, 1.08);
        let stem = Branch {
            start: out * (plan.spread * share),
            direction: Vec3::Y * cosine + out * sine,
            length,
            radius: length * level.thickness,
            level: 0,
            key: chance.child(number),
        };
        branch(plan, &stem, sink);
    }
}

/// Grows a plant with so many triangles, as high as about 1.
pub(super) fn grown(plan: &Plan, seed: u32, triangles: u32) -> Grown {
    let mut plan = plan.clone();
    let mut counted = Counted::default();
    for _ in 0..12 {
        counted = Counted::default();
        walk(&plan, seed, &mut counted);
        // Leaves get half at least, so fewer twigs where those took more.
        if counted.triangles <= u64::from(triangles) / 2 {
            break;
        }
        plan.levels.iter_mut().for_each(|level| level.children *= 0.85);
    }
    let leaves = u64::from(triangles).saturating_sub(counted.triangles) / plan.detail.triangles();
    let area = plan.leaf_area / (if leaves > 0 { leaves as f32 } else { 1.0 });
    let size = (area / (plan.detail.area() * plan.half)).sqrt();
    let names = ["leaves dark", "leaves", "leaves light"];
    let piece = |k: usize| Piece::new(names[k], Kind::Leaf, plan.greens[k]);
    let mut made = Made {
        plan: &plan,
        pieces: [piece(0), piece(1), piece(2)],
        wood: Piece::new("bark", Kind::Wood, plan.bark),
        density: if counted.leafy > 0.0 { leaves as f64 / counted.leafy } else { 0.0 },
        passed: 0.0,
        leaves: 0,
        size,
    };
    walk(&plan, seed, &mut made);
    let Made { pieces: [dark, plain, light], wood, leaves, .. } = made;
    Grown { pieces: vec![dark, plain, light, wood], leaves }.without_empty()
}
