//! Blades of a picture, solved once each.
//!
//! The CPU side of `solve.wgsl` of `sward_wgpu`, function by function. Reads cells and wind, writes blades and the points of their strips.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

use super::blade_plan::{AROUND, BladeUniform, level, unseen};
use super::plan::PatchDraw;
use super::prepare::{Preparing, Who, ordered_cell};
use crate::geometry::billboard::CLEARANCE;
use crate::geometry::blade::{self, Stance, piece, piece_bend, raised};
use crate::math;
use crate::placement::{self, Growing, Plant};
use crate::wind::Phases;

/// A blade, solved: the head of its record in `solve.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Blade {
    /// Root, m relative to the frame origin.
    pub root: [f32; 3],
    /// Length, m.
    pub height: f32,
    /// Where it leans, rad from +x towards +z.
    pub yaw: f32,
    /// Widest, m.
    pub width: f32,
    /// Chance number in 0..1 for colour.
    pub tint: f32,
    /// Turn about its own length at the tip, rad.
    pub twist: f32,
    /// Gradient of the ground at its root, rise over run along x and z.
    pub slope: [f32; 2],
    /// Its patch, as a number of the plan's draws.
    pub draw: u32,
    /// Its place in the drawing order of the patch.
    pub rank: u32,
}

/// What the preparing of one stand's blades reads.
pub struct Blades<'a> {
    /// Cells, wind, ground.
    pub preparing: Preparing<'a>,
    /// Numbers of the picture.
    pub uniform: BladeUniform,
}

/// A blade before it is bent.
struct Grown {
    blade: Blade,
    /// Root, m from the corner of its patch.
    local: [f32; 2],
    /// Height of its plant, whole, m.
    tall: f32,
    /// Its place among the blades of its patch.
    index: u32,
    stance: Stance,
    /// How its plant leans by itself, rad along x and z.
    plant: [f32; 2],
    /// Distance to the eye, m.
    away: f32,
    level: usize,
}

impl Blades<'_> {
    /// Blades of one patch, one after the other; `found` gets each with its level and the points of its strip, root first.
    pub fn of_patch(&self, number: u32, draw: &PatchDraw, mut found: impl FnMut(&Blade, usize, &[Vec3])) {
        let phases = self.preparing.phases(draw);
        let growth = self.preparing.growth(draw);
        for rank in 0..draw.count {
            let Some(grown) = self.grown(draw, growth.as_deref(), [number, rank], true) else { continue };
            let mut points = [Vec3::ZERO; blade::MOST_PIECES + 1];
            let points = &mut points[..=self.uniform.pieces[grown.level] as usize];
            self.bend(draw, &phases, &grown, grown.level, points);
            found(&grown.blade, grown.level, points);
        }
    }

    /// All blades of one patch whether they would be drawn or not; `found` gets each with the points of its strip, root first.
    pub(super) fn all_of_patch(&self, draw: &PatchDraw, mut found: impl FnMut(&Blade, &[Vec3])) {
        let phases = self.preparing.phases(draw);
        let growth = self.preparing.growth(draw);
        let mut points = [Vec3::ZERO; blade::MOST_PIECES + 1];
        let points = &mut points[..=self.uniform.pieces[0] as usize];
        for rank in 0..draw.count {
            if let Some(grown) = self.grown(draw, growth.as_deref(), [0, rank], false) {
                self.bend(draw, &phases, &grown, 0, points);
                found(&grown.blade, points);
            }
        }
    }

    /// One blade of the picture after, as it was: with as many points as there, though it may not have been drawn.
    pub fn past(
        &self,
        draw: &PatchDraw,
        phases: &Phases,
        growth: Option<&[Growing]>,
        now: &Blade,
        level: usize,
        points: &mut [Vec3],
    ) -> Option<Blade> {
        let grown = self.grown(draw, growth, [now.draw, now.rank], false)?;
        self.bend(draw, phases, &grown, level, points);
        Some(grown.blade)
    }

    /// Number of the cell that a place of the drawing order lies in.
    pub fn cell(&self, rank: u32) -> u32 {
        let prepare = &self.preparing.uniform;
        let [i, j] = ordered_cell(rank & ((1 << (2 * prepare.bits)) - 1), prepare.bits);
        j * prepare.placement.cells + i
    }

    /// The plant a place of the drawing order belongs to, and the number of the blade.
    fn plant(&self, draw: &PatchDraw, growth: Option<&[Growing]>, rank: u32, cell: [u32; 2]) -> Option<(Plant, u32)> {
        let prepare = &self.preparing.uniform;
        let placed = placement::plant(&prepare.placement, draw.patch, cell)?;
        let index = cell[1] * prepare.placement.cells + cell[0];
        let placed = growth.map_or(Some(placed), |growth| placement::grown(placed, growth[index as usize]))?;
        Some((placed, rank >> (2 * prepare.bits)))
    }

    /// What grows at a place of the drawing order and, if `only_seen`, may be seen.
    fn grown(&self, draw: &PatchDraw, growth: Option<&[Growing]>, [number, rank]: [u32; 2], only_seen: bool) -> Option<Grown> {
        let (prepare, numbers) = (&self.preparing.uniform, &self.uniform);
        let cell = ordered_cell(rank & ((1 << (2 * prepare.bits)) - 1), prepare.bits);
        if cell.iter().any(|at| *at >= prepare.placement.cells) {
            return None;
        }
        let [a, b, c, stretch] = numbers.thinning;
        let place = (rank as f32 + 0.5) / (numbers.pieces[3] << (2 * prepare.bits)) as f32;
        let middle = [0, 1].map(|axis: usize| draw.offset[axis] + (cell[axis] as f32 + 0.5) * prepare.placement.spacing);
        let off = Vec2::new(middle[0] - numbers.eye[0], middle[1] - numbers.eye[2]).length();
        let nearest = math::upper(off - 0.71 * prepare.placement.spacing, 0.0);
        // Most candidates are too many wherever in their cell they stand.
        if only_seen && place > blade::density([a, b, c], 1.0, nearest * stretch) {
            return None;
        }
        let (placed, which) = self.plant(draw, growth, rank, cell)?;
        let random = |question: u32| placement::of_blade(&prepare.placement, draw.patch, cell, which, question);
        let [most_lean, most_curl, shortest, tuft] = numbers.stance;
        let local = [0, 1].map(|axis: usize| {
            let anywhere = (cell[axis] as f32 + random(axis as u32)) * prepare.placement.spacing;
            anywhere + (placed.root[axis] - anywhere) * tuft
        });
        let (ground, slope) = self.preparing.terrain.height_and_gradient(draw.anchor, local);
        let root = Vec3::new(draw.offset[0] + local[0], ground, draw.offset[1] + local[1]);
        let to_eye = Vec3::new(numbers.eye[0], numbers.eye[1], numbers.eye[2]) - root;
        let away = to_eye.length();
        let normal = Vec3::new(-slope[0], 1.0, -slope[1]).normalize();
        let thin = blade::density([a, b, c], normal.dot(to_eye) / math::upper(away, 1e-3), away * stretch);
        // The last ones to be drawn are small: so nothing pops.
        let stay = math::clamped((thin - place) / math::upper(numbers.shape[2] * thin, 1e-9), 0.0, 1.0);
        let tint = random(2);
        let [_, _, fade, gone] = numbers.distances;
        let left = 1.0 - math::smoothstep(fade, gone, away + (tint - 0.5) * 0.3 * (gone - fade));
        let height = placed.height * (shortest + (1.0 - shortest) * random(3)) * (0.15 + 0.85 * left);
        if only_seen && (stay <= 0.0 || left <= 0.0 || unseen(&numbers.seen, root, height + AROUND)) {
            return None;
        }
        let (yaw, lean) = placement::combed(random(4) * std::f32::consts::TAU, most_lean * random(7), placed.lean);
        let (sine, cosine) = math::sin_cos(yaw);
        let level = level(&numbers.distances, away);
        let widened = math::lower(1.0 / math::upper(thin, 1e-6).sqrt(), 2.5);
        let blade = Blade {
            root: root.to_array(),
            height,
            yaw,
            width: numbers.shape[0] * (0.7 + 0.6 * random(5)) * widened * stay * left,
            tint,
            twist: numbers.shape[1] * (2.0 * random(6) - 1.0),
            slope,
            draw: number,
            rank,
        };
        let stance = Stance { heading: [cosine, sine], lean, curl: most_curl * random(8) };
        let index = (which * prepare.placement.cells + cell[1]) * prepare.placement.cells + cell[0];
        Some(Grown { blade, local, tall: placed.height, index, stance, plant: placed.lean, away, level })
    }

    /// The points of a strip, root first, m relative to the frame origin.
    fn bend(&self, draw: &PatchDraw, phases: &Phases, grown: &Grown, level: usize, points: &mut [Vec3]) {
        let segments = (self.preparing.uniform.segments as usize).min(8);
        let mut bends = [[0.0; 2]; 8];
        let Stance { heading, lean, curl } = grown.stance;
        let who =
            Who { local: grown.local, tall: grown.tall, index: grown.index, heading, yaw: grown.blade.yaw, lean, curl, plant: grown.plant };
        self.preparing.bends(draw, phases, &who, &mut bends[..segments]);
        let (pieces, coarse) = (self.uniform.pieces[level], self.uniform.pieces[(level + 1).min(2)]);
        // Where the next number of pieces begins, the strip has its shape already: so nothing pops.
        let border = self.uniform.distances[level.min(1)];
        let morph = if level < 2 { math::smoothstep(0.7 * border, border, grown.away) } else { 0.0 };
        let length = grown.blade.height / pieces as f32;
        let mut at = Vec3::new(grown.local[0], grown.blade.root[1], grown.local[1]);
        let shift = Vec3::new(draw.offset[0], 0.0, draw.offset[1]);
        points[0] = at + shift;
        for k in 0..pieces {
            let way = piece(piece_bend(&bends[..segments], &grown.stance, k, [pieces, coarse], morph), length);
            let floor = |at: Vec3| self.preparing.terrain.height(draw.anchor, [at.x, at.z]) + CLEARANCE;
            let there = at + way;
            let least = floor(there);
            if there.y >= least {
                at = there;
            } else {
                at += raised(way, least - at.y);
                at.y = math::upper(at.y, floor(at));
            }
            points[k as usize + 1] = at + shift;
        }
    }
}

/// Unit ground vector along which a blade leans (x, z).
pub fn heading(blade: &Blade) -> Vec2 {
    let (sine, cosine) = math::sin_cos(blade.yaw);
    Vec2::new(cosine, sine)
}
