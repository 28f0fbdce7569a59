//! Which patches show blades, and how many: room is set aside before any blade is solved.
//!
//! Belyaev et al. 2011, §2.2; methods §3.6. Memory depends on `budget.visible_blades`, never on the field.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3};

use super::plan::{PatchDraw, Seen, Sighted, bits, draw, sighted};
use crate::geometry::blade::density;
use crate::response::StandModel;
use crate::scene::Blade;
use crate::shading::look::Look;
use crate::world::World;

/// Numbers of pieces a strip may have.
pub const LEVELS: usize = 3;
/// Candidates looked at by one workgroup.
pub const GROUP: u32 = 64;
/// Blades drawn by one instance.
pub const BLADES_PER_INSTANCE: u32 = 64;
/// The `vec4`s of a blade before its points.
pub const HEAD: u32 = 3;
/// Squares along a patch side that are counted apart: of patches under the eye, near it, and others.
const SQUARES: [usize; 3] = [32, 16, 4];
/// How near that is, m.
const NEAR: f64 = 32.0;
/// Room beyond what is expected: a square is counted at its middle.
const MARGIN: f64 = 1.2;
/// Around a root, beyond the height of its blade, m: what is a little out of sight may still cast a shadow.
pub const AROUND: f32 = 0.5;
/// Share of the blades drawn that are on their way in or out: so nothing pops.
pub const BAND: f32 = 0.25;
/// Blades there is room for in any case.
const SPARE: f64 = 256.0;
/// Most `vec4`s of a stand's records: 128 MiB, what WebGPU lets a buffer bind.
const MOST_RECORDS: f64 = (1 << 23) as f64;
/// Farthest that distances are stretched to keep within the budget.
const MOST_STRETCH: f32 = 1e6;
/// Least b of the thinning: so little that nothing is left out because of it, and a short budget can still thin by distance.
const LEAST_THINNING: f32 = 1e-4;

/// `Blades` of `solve.wgsl` of `sward_wgpu`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct BladeUniform {
    /// Frame space to clip space: blades out of sight are left out.
    pub seen: Mat4,
    /// Eye by which blades thin out, m in frame space; w unused.
    pub eye: [f32; 4],
    /// Most lean and curl, rad; shortest; tuft.
    pub stance: [f32; 4],
    /// a, b, c of the thinning; how many times distances count in it.
    pub thinning: [f32; 4],
    /// Distances of the second and third number of pieces, m; those where plants begin to shrink and are gone, m.
    pub distances: [f32; 4],
    /// Numbers of pieces; blades of a plant.
    pub pieces: [u32; 4],
    /// Blades there is room for, per number of pieces; patches.
    pub rooms: [u32; 4],
    /// Where the records of each number of pieces begin, `vec4`s; whether they hold a second set of points.
    pub firsts: [u32; 4],
    /// Widest, m; most twist, rad; share of the blades drawn that are on their way in or out; unused.
    pub shape: [f32; 4],
}

impl BladeUniform {
    /// `vec4`s of a record.
    pub fn stride(&self, level: usize) -> u32 {
        let points = self.pieces[level] + 1;
        HEAD + points + if self.firsts[3] > 0 { 1 + points } else { 0 }
    }

    /// `vec4`s of all records.
    pub fn records(&self) -> u32 {
        self.firsts[2] + self.rooms[2] * self.stride(2)
    }
}

/// What is drawn of a stand of blades.
#[derive(Clone, Debug)]
pub struct BladePlan {
    /// Near to far; `first` is the first workgroup of each.
    pub draws: Vec<PatchDraw>,
    /// Of all of them.
    pub workgroups: u32,
    /// Numbers for preparing.
    pub uniform: BladeUniform,
}

/// Whether a ball lies outside the picture's sides or behind the eye. Twin: `blades_unseen` in `solve.wgsl`.
pub fn unseen(seen: &Mat4, centre: Vec3, radius: f32) -> bool {
    let clip = *seen * centre.extend(1.0);
    let [x, y] = [0, 1].map(|row| seen.row(row).truncate().length());
    let beyond = |at: f32, stretch: f32| (if at < 0.0 { -at } else { at }) > clip.w + radius * (stretch + 1.0);
    clip.w < -radius || beyond(clip.x, x) || beyond(clip.y, y)
}

/// Number of pieces at a distance, as a level.
pub fn level(distances: &[f32; 4], away: f32) -> usize {
    usize::from(away >= distances[0]) + usize::from(away >= distances[1])
}

fn uniform(blade: &Blade, seen: &Mat4, eye: Vec3, look: &Look) -> BladeUniform {
    BladeUniform {
        seen: *seen,
        eye: eye.extend(0.0).to_array(),
        stance: [blade.lean, blade.curl, blade.shortest, blade.tuft],
        thinning: [blade.thinning[0], blade.thinning[1].max(LEAST_THINNING), blade.thinning[2], 1.0],
        distances: [blade.piece_distances[0], blade.piece_distances[1], look.fade[0], look.fade[1]],
        pieces: [blade.pieces[0], blade.pieces[1], blade.pieces[2], blade.blades],
        rooms: [0; 4],
        firsts: [0; 4],
        shape: [blade.width, blade.twist, BAND, 0.0],
    }
}

/// Numbers for blades that are not drawn but asked about: all of them, whole, in their largest number of pieces.
pub(super) fn everywhere(blade: &Blade, look: &Look) -> BladeUniform {
    let near = uniform(blade, &Mat4::IDENTITY, Vec3::ZERO, look);
    BladeUniform { distances: [1e8, 2e8, 3e8, 4e8], ..near }
}

/// A square of a patch in sight.
struct Square {
    /// n·r at its middle.
    facing: f32,
    /// Distance of its middle, m.
    away: f32,
    /// Blades that could grow in it.
    candidates: f64,
}

/// The squares in sight of a stand's patches.
fn squares(world: &World, stand: &StandModel, list: &[Sighted], origin: [i32; 2], numbers: &BladeUniform) -> Vec<Square> {
    let side = world.model.patch_side;
    let origin = origin.map(|patch| f64::from(patch) * side);
    // Clumps leave half of what they may.
    let cover = f64::from(stand.placement.cover * (1.0 - 0.5 * stand.placement.clumping));
    let all = f64::from(stand.cells * stand.cells * numbers.pieces[3]) * cover;
    let mut found = Vec::new();
    for sighted in list {
        let count = SQUARES[usize::from(sighted.distance > 1.0) + usize::from(sighted.distance > NEAR)];
        let square = side / count as f64;
        let radius = 0.35 * square as f32 + stand.species.height[1] + AROUND;
        for k in 0..count * count {
            let at = [(0, k % count), (1, k / count)]
                .map(|(axis, along): (usize, usize)| f64::from(sighted.patch[axis]) * side + (along as f64 + 0.5) * square);
            let (ground, [x, z]) = world.model.terrain.height_and_gradient_at(at[0], at[1]);
            let centre = Vec3::new((at[0] - origin[0]) as f32, ground as f32, (at[1] - origin[1]) as f32);
            let to_eye = Vec3::new(numbers.eye[0], numbers.eye[1], numbers.eye[2]) - centre;
            let away = to_eye.length();
            if away - radius < numbers.distances[3] && !unseen(&numbers.seen, centre, radius) {
                let normal = Vec3::new(-x as f32, 1.0, -z as f32).normalize();
                let candidates = all / (count * count) as f64;
                found.push(Square { facing: normal.dot(to_eye) / away.max(1e-3), away, candidates });
            }
        }
    }
    found
}

/// Room for the blades that squares are expected to show, per number of pieces, where distances count `stretch` times.
fn expected(squares: &[Square], numbers: &BladeUniform, stretch: f32) -> [f64; LEVELS] {
    let [a, b, c, _] = numbers.thinning;
    let mut blades = [SPARE; LEVELS];
    for square in squares {
        let share = density([a, b, c], square.facing, square.away * stretch);
        blades[level(&numbers.distances, square.away)] += MARGIN * square.candidates * f64::from(share);
    }
    blades
}

/// Decides what is drawn of all stands of blades in a picture whose camera is `projection`; `None` for stands of billboards. `then`:
/// whether the records hold points of the picture before, too. Where the budget or what a buffer holds is short (sooner with
/// `then`, whose records are longer), blades thin out sooner, not near the eye.
pub fn plan(world: &World, seen: &Seen, looks: &[Look], projection: &Mat4, then: bool) -> Vec<Option<BladePlan>> {
    let eye = Vec3::from(seen.eye(world.model.patch_side));
    let stands: Vec<_> = (world.model.stands.iter().zip(looks))
        .map(|(stand, look)| {
            let numbers = uniform(stand.species.blade.as_ref()?, projection, eye, look);
            let numbers = BladeUniform { firsts: [0, 0, 0, u32::from(then)], ..numbers };
            let list = sighted(world, seen.view, f64::from(look.fade[1]));
            let squares = squares(world, stand, &list, seen.origin, &numbers);
            Some((numbers, list, squares))
        })
        .collect();
    let fits = |stretch: f32| {
        let mut total = 0.0;
        stands.iter().flatten().all(|(numbers, _, squares)| {
            let blades = expected(squares, numbers, stretch);
            total += blades.iter().sum::<f64>();
            (0..LEVELS).map(|level| blades[level] * f64::from(numbers.stride(level))).sum::<f64>() < MOST_RECORDS
        }) && total <= f64::from(world.scene.budget.visible_blades)
    };
    let least = (1.0 / seen.near.max(1e-3)) as f32;
    let (mut short, mut stretch) = (least, least);
    while !fits(stretch) && stretch < MOST_STRETCH {
        (short, stretch) = (stretch, 2.0 * stretch);
    }
    // To a hundredth.
    for _ in 0..if stretch > least { 6 } else { 0 } {
        let middle = (short * stretch).sqrt();
        (short, stretch) = if fits(middle) { (short, middle) } else { (middle, stretch) };
    }
    let settled = stands.iter().enumerate().map(|(index, stand)| {
        let (numbers, list, squares) = stand.as_ref()?;
        let rooms = expected(squares, numbers, stretch).map(|blades| blades as u32);
        Some(settle(world, index, seen.origin, list, BladeUniform { thinning: with_last(numbers.thinning, stretch), ..*numbers }, rooms))
    });
    settled.collect()
}

fn with_last([a, b, c, _]: [f32; 4], last: f32) -> [f32; 4] {
    [a, b, c, last]
}

/// Sets records and workgroups aside.
fn settle(world: &World, index: usize, origin: [i32; 2], list: &[Sighted], mut numbers: BladeUniform, rooms: [u32; LEVELS]) -> BladePlan {
    let stand = &world.model.stands[index];
    numbers.rooms = [rooms[0], rooms[1], rooms[2], list.len() as u32];
    for level in 1..LEVELS {
        numbers.firsts[level] = numbers.firsts[level - 1] + rooms[level - 1] * numbers.stride(level - 1);
    }
    let places = u64::from(numbers.pieces[3]) << (2 * bits(stand.cells));
    let [a, b, c, stretch] = numbers.thinning;
    let (mut draws, mut workgroups) = (Vec::new(), 0);
    for patch in list {
        // Of what grows there, no more can be seen than its nearest point would show from above.
        let share = density([a, b, c], 1.0, patch.distance as f32 * stretch);
        let count = (f64::from(share) * places as f64).ceil() as u32;
        draws.push(draw(world, &world.state.stands[index], patch.patch, origin, workgroups, count));
        workgroups += count.div_ceil(GROUP);
    }
    BladePlan { draws, workgroups, uniform: numbers }
}

/// The plan of a picture's blades in a world of another moment: the same patches, order and shares, on the same ground, with that moment's
/// cells and eye.
pub fn plan_then(then: &World, index: usize, seen: &Seen, look: &Look, now: &BladePlan) -> Option<BladePlan> {
    let stand = &then.model.stands[index];
    let blade = stand.species.blade.as_ref()?;
    let own = uniform(blade, &now.uniform.seen, Vec3::from(seen.eye(then.model.patch_side)), look);
    let thinning = with_last(own.thinning, now.uniform.thinning[3]);
    let uniform = BladeUniform { thinning, rooms: now.uniform.rooms, firsts: now.uniform.firsts, ..own };
    let draws = now.draws.iter().map(|now| PatchDraw {
        anchor: now.anchor,
        growth: now.growth,
        ..draw(then, &then.state.stands[index], now.patch, seen.origin, now.first, now.count)
    });
    Some(BladePlan { draws: draws.collect(), workgroups: now.workgroups, uniform })
}
