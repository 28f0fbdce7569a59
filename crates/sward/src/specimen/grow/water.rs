//! Water plants: a tuft of ribbons, and stems with whorls of feathery leaves. All of it is soft, so all of it is leaf.

use glam::Vec3;

use super::super::Kind;
use super::branch::{Branch, Joint, Run, at, line};
use super::chance::{Chance, GOLDEN, leaning, ring};
use super::mesh::{Grown, MeshVertex, Piece};
use super::tube;
use crate::math::sin_cos;

/// Whorls of a stem, where there are triangles enough.
const WHORLS: f32 = 17.0;
/// Feathers of a whorl.
const FEATHERS: u32 = 5;
/// Ribbons of a rosette.
const ROSETTE: u32 = 8;

/// What so many triangles allow.
struct Plan {
    ribbons: u32,
    /// Pieces of a ribbon, of four triangles each.
    pieces: u32,
    stems: u32,
    /// Strips of a feather, of two triangles each.
    strips: u32,
    /// Radius of the tuft; the plant is as high as about 1.
    radius: f32,
}

impl Plan {
    fn new(triangles: u32) -> Self {
        let triangles = triangles as f32;
        let (pieces, strips) = match triangles as u32 {
            0..12_000 => (8, 5),
            12_000..40_000 => (12, 7),
            40_000..200_000 => (20, 9),
            200_000..2_000_000 => (32, 11),
            _ => (48, 17),
        };
        let ribbons = 0.4 * triangles / (4 * pieces) as f32;
        let stems = 0.6 * triangles / (WHORLS * FEATHERS as f32 * 2.0 * strips as f32);
        let stems = if stems < 4.0 { 4.0 } else { stems };
        // Where there is no end of triangles the tuft becomes a bed.
        let wide = (stems + 12.0).sqrt() * 0.065;
        let ribbons = if ribbons > 30.0 * stems { 30.0 * stems } else { ribbons };
        Self { ribbons: ribbons as u32, pieces, stems: stems as u32, strips, radius: wide }
    }

    /// A place in the tuft.
    fn spot(&self, number: u32, of: u32, chance: &mut Chance) -> (Vec3, Vec3) {
        let share = ((number as f32 + chance.next()) / of as f32).sqrt();
        let turn = (number % 4096) as f32 * GOLDEN + chance.within(-0.4, 0.4);
        let (sine, cosine) = sin_cos(turn);
        let out = Vec3::new(cosine, 0.0, sine);
        (out * (self.radius * share), out * share)
    }
}

/// Share of a ribbon's length in which it ends.
const TIP: f32 = 0.1;

/// Bends a ribbon to and fro, more towards its tip.
fn waved(joints: &mut [Joint], chance: &mut Chance) {
    let (aside, phase) = (chance.within(0.016, 0.045), chance.turn());
    let waves = chance.within(5.0, 10.0);
    let around = chance.turn();
    let count = joints.len() as f32 - 1.0;
    for (k, joint) in joints.iter_mut().enumerate() {
        let t = k as f32 / count;
        let out = ring(joint.forward, joint.side, around);
        let (sine, cosine) = sin_cos(phase + waves * t);
        joint.place += out * (aside * sine * t);
        joint.forward = (joint.forward + out * (aside * (waves * cosine * t + sine))).normalize_or(joint.forward);
        joint.side = (joint.side - joint.forward * joint.forward.dot(joint.side)).normalize_or(joint.side);
    }
}

/// A ribbon: a strip creased along its middle, narrow at both ends, turning as it rises.
fn ribbon(piece: &mut Piece, joints: &[Joint], half: f32, twist: f32) {
    let first = piece.vertices.len() as u32;
    let count = joints.len() - 1;
    for (k, joint) in joints[..count].iter().enumerate() {
        let t = k as f32 / count as f32;
        let taper = if t > 1.0 - TIP { 0.35 + 0.65 * (1.0 - t) / TIP } else { 1.0 };
        let width = half * (0.55 + 0.45 * if t < 0.3 { t / 0.3 } else { 1.0 }) * taper.sqrt();
        let side = ring(joint.forward, joint.side, twist * t);
        let up = side.cross(joint.forward);
        for across in [-1.0, 0.0, 1.0] {
            let lift = if across == 0.0 { 0.0 } else { 0.28 * width };
            let place = joint.place + side * (width * across) + up * lift;
            let normal = (up - side * (0.28 * across)).normalize_or(up);
            piece.vertices.push(MeshVertex { position: place.to_array(), normal: normal.to_array(), uv: [t + 0.5 + 0.5 * across, t] });
        }
        // The middle of the first ring is the root: nothing else has so small a u + v.
        if let Some(vertex) = piece.vertices.last_mut().filter(|_| k == 0) {
            vertex.uv[1] += 0.1;
        }
    }
    let tip = joints[count];
    let up = ring(tip.forward, tip.side, twist).cross(tip.forward);
    piece.vertices.push(MeshVertex { position: tip.place.to_array(), normal: up.to_array(), uv: [1.5, 1.0] });
    for ring in 0..count as u32 {
        let (here, next) = (first + 3 * ring, first + 3 * ring + 3);
        if ring + 1 == count as u32 {
            piece.triangles.extend([[here, here + 1, next], [here + 1, here + 2, next]]);
            break;
        }
        for k in [0, 1] {
            piece.triangles.extend([[here + k, here + k + 1, next + k], [here + k + 1, next + k + 1, next + k]]);
        }
    }
}

/// A feather: strips that spread from one vertex.
fn feather(piece: &mut Piece, base: Vec3, along: Vec3, up: Vec3, length: f32, strips: u32, chance: &mut Chance) {
    let side = along.cross(up).normalize_or(Vec3::X);
    let up = side.cross(along);
    let root = piece.vertices.len() as u32;
    piece.vertices.push(MeshVertex { position: base.to_array(), normal: up.to_array(), uv: [0.0, 0.0] });
    for strip in 0..strips {
        let place = (strip as f32 + 0.5) / strips as f32 * 2.0 - 1.0;
        let (sine, cosine) = sin_cos(place * 1.15 + chance.within(-0.08, 0.08));
        let own = along * cosine + side * sine + up * chance.within(-0.12, 0.2);
        let long = length * (1.0 - 0.3 * place * place) * chance.within(0.85, 1.1);
        let half = 0.028 * length * (1.0 + 5.0 / strips as f32);
        let across = (side * cosine - along * sine) * half;
        let lift = up * (0.12 * long);
        let first = piece.vertices.len() as u32;
        for (place, uv) in [
            (base + own * (0.6 * long) + across + lift, [0.7, 0.5]),
            (base + own * long + lift * 1.6, [1.0, 1.0]),
            (base + own * (0.6 * long) - across + lift, [0.5, 0.7]),
        ] {
            piece.vertices.push(MeshVertex { position: place.to_array(), normal: up.to_array(), uv });
        }
        piece.triangles.extend([[root, first, first + 1], [root, first + 1, first + 2]]);
    }
}

struct Made {
    pieces: [Piece; 3],
    leaves: u64,
}

impl Made {
    fn ribbons(&mut self, plan: &Plan, seed: u32) {
        for number in 0..plan.ribbons {
            let mut chance = Chance::new(Chance::new(seed).child(number));
            let rosettes = plan.ribbons.div_ceil(ROSETTE);
            let mut own = Chance::new(Chance::new(seed ^ 0x5eed).child(number / ROSETTE));
            let (start, _) = plan.spot(number / ROSETTE, rosettes, &mut own);
            let out = ring(Vec3::Y, Vec3::X, number as f32 * GOLDEN + own.turn());
            let start = start + out * chance.within(0.004, 0.012);
            // The inner ones are young and upright, the outer long; at the surface they turn over and float.
            let age = chance.next();
            let run = Run { segments: plan.pieces, rise: 0.3 - 1.9 * age * age, bend: 0.5, tip: 1.0, flare: 0.0 };
            let direction = Vec3::Y + out * (0.05 + 0.28 * age) + chance.vector() * 0.1;
            let length = 0.6 + 0.75 * age + chance.within(-0.1, 0.1);
            let mut joints = line(&Branch { start, direction, length, radius: 0.0, level: 0, key: 0 }, &run, &mut chance);
            waved(&mut joints, &mut chance);
            let which = if chance.next() < 0.6 { 0 } else { 1 };
            ribbon(&mut self.pieces[which], &joints, chance.within(0.008, 0.0115), chance.within(-1.8, 1.8));
            self.leaves += 1;
        }
    }

    /// Stems, the feathers on all of them being `feathers`.
    fn stems(&mut self, plan: &Plan, seed: u32, feathers: u64) {
        let mut given = 0;
        for number in 0..plan.stems {
            let mut chance = Chance::new(Chance::new(!seed).child(number));
            let (start, out) = plan.spot(number, plan.stems, &mut chance);
            let run = Run { segments: plan.pieces / 2 + 4, rise: 0.4, bend: 0.6, tip: 0.5, flare: 0.0 };
            let direction = Vec3::Y + out * chance.within(0.05, 0.4) + chance.vector() * 0.12;
            let length = chance.within(0.45, 0.85);
            let joints = line(&Branch { start, direction, length, radius: 0.0055, level: 0, key: 0 }, &run, &mut chance);
            tube::tube(&mut self.pieces[1], &joints, 4, 0.0);
            // The lowest ring's first corner must be the root, not its equals.
            self.leaves += 1;
            let due = feathers * u64::from(number + 1) / u64::from(plan.stems);
            let own = (due - given) as u32;
            given = due;
            self.whorls(plan, &joints, own, length, &mut chance);
        }
    }

    fn whorls(&mut self, plan: &Plan, joints: &[Joint], feathers: u32, length: f32, chance: &mut Chance) {
        let whorls = feathers.div_ceil(FEATHERS);
        for whorl in 0..whorls {
            let own = FEATHERS.min(feathers - whorl * FEATHERS);
            let place = (whorl as f32 + 0.5) / whorls as f32;
            // Close together towards the tip, where leaves are young and small.
            let share = 0.06 + 0.935 * (place * (1.5 - 0.5 * place));
            let joint = at(joints, share);
            let size = 0.14 * length.sqrt() * (1.0 - 0.5 * share * share);
            let turn = whorl as f32 * GOLDEN;
            for number in 0..own {
                let around = turn + (number as f32 + chance.within(-0.15, 0.15)) * (std::f32::consts::TAU / own as f32);
                let angle = 1.0 - 0.45 * share * share + chance.within(-0.15, 0.15);
                let along = leaning(joint.forward, joint.side, around, angle);
                let base = joint.place + ring(joint.forward, joint.side, around) * (joint.radius * 0.8);
                let which = if share + chance.within(-0.15, 0.15) > 0.72 { 2 } else { 1 };
                feather(&mut self.pieces[which], base, along, joint.forward, size * chance.within(0.85, 1.15), plan.strips, chance);
                self.leaves += 1;
            }
        }
    }
}

/// Grows a water plant with so many triangles, as high as about 1.
pub(super) fn grown(seed: u32, triangles: u32) -> Grown {
    let plan = Plan::new(triangles);
    let greens = [[0.045, 0.13, 0.02], [0.06, 0.15, 0.03], [0.13, 0.2, 0.04]];
    let piece = |name: &str, k: usize| Piece::new(name, Kind::Leaf, greens[k]);
    let mut made = Made { pieces: [piece("leaves ribbon", 0), piece("leaves", 1), piece("leaves young", 2)], leaves: 0 };
    made.ribbons(&plan, seed);
    let stems = u64::from(plan.stems) * tube::count(plan.pieces as usize / 2 + 5, 4);
    let taken = made.pieces.iter().map(|piece| piece.triangles.len() as u64).sum::<u64>() + stems;
    let feathers = u64::from(triangles).saturating_sub(taken) / u64::from(2 * plan.strips);
    made.stems(&plan, seed, feathers);
    Grown { pieces: made.pieces.into(), leaves: made.leaves }.without_empty()
}
