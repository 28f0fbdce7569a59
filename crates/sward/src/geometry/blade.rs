//! Blades: strips of triangles along a curve.
//!
//! Belyaev et al. 2011, §2.1 and §2.2; methods §3.6. A blade is a chain of pieces of equal length, so its length is right by
//! construction, whatever bends it and however many pieces it has. Twin: `blade.wgsl`.
//! Differs from the paper: directions are interpolated, not joints (docs/papers.md).

use glam::Vec3;

use crate::geometry::billboard::segment;
use crate::math;

/// Blades in WGSL; needs `math` and `billboard` before it.
pub const WGSL: &str = include_str!("blade.wgsl");

/// Most pieces of a strip.
pub const MOST_PIECES: usize = 12;
/// Farthest that a blade bends, rad.
const FARTHEST: f32 = 2.2;

/// How a blade stands by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stance {
    /// Unit ground vector it leans along (x, z).
    pub heading: [f32; 2],
    /// Lean at the root, rad.
    pub lean: f32,
    /// How much farther the tip leans, rad.
    pub curl: f32,
}

/// Bend of a blade at a share `along` of its length, rad: that of its segments, changing evenly from middle to middle, and its own.
pub fn bend(bends: &[[f32; 2]], stance: &Stance, along: f32) -> [f32; 2] {
    let last = bends.len() - 1;
    let at = math::clamped(along * bends.len() as f32 - 0.5, 0.0, last as f32);
    let below = at as usize;
    let above = if below < last { below + 1 } else { last };
    let way = at - below as f32;
    let own = stance.lean + stance.curl * along * along;
    let axis = |k: usize| bends[below][k] + (bends[above][k] - bends[below][k]) * way + stance.heading[k] * own;
    let bend = [axis(0), axis(1)];
    let size = (bend[0] * bend[0] + bend[1] * bend[1]).sqrt();
    let scale = if size > FARTHEST { FARTHEST / size } else { 1.0 };
    [bend[0] * scale, bend[1] * scale]
}

/// Bend of piece `piece` of `pieces`, rad; with `morph` 1 the strip has the shape of one of `coarse` pieces, fewer or as many.
pub fn piece_bend(bends: &[[f32; 2]], stance: &Stance, piece: u32, [pieces, coarse]: [u32; 2], morph: f32) -> [f32; 2] {
    let own = bend(bends, stance, (piece as f32 + 0.5) / pieces as f32);
    if morph <= 0.0 {
        return own;
    }
    // The coarse pieces it lies along, and how much of it along the first.
    let first = piece * coarse / pieces;
    let second = if first + 1 < coarse { first + 1 } else { first };
    let border = ((first + 1) * pieces) as f32 / coarse as f32;
    let share = math::clamped(border - piece as f32, 0.0, 1.0);
    let a = bend(bends, stance, (first as f32 + 0.5) / coarse as f32);
    let b = bend(bends, stance, (second as f32 + 0.5) / coarse as f32);
    [0, 1].map(|axis| own[axis] + (b[axis] + (a[axis] - b[axis]) * share - own[axis]) * morph)
}

/// The way along a piece of `length` m bent by `bend`.
pub fn piece(bend: [f32; 2], length: f32) -> Vec3 {
    segment(bend, length).into()
}

/// A piece that rises by at least `least` m: turned up until it does, if it is long enough, else lifted.
pub fn raised(way: Vec3, least: f32) -> Vec3 {
    if way.y >= least {
        return way;
    }
    let across = (way.x * way.x + way.z * way.z).sqrt();
    let left = way.length_squared() - least * least;
    if left <= 0.0 || across < 1e-6 {
        return Vec3::new(way.x, least, way.z);
    }
    let scale = left.sqrt() / across;
    Vec3::new(way.x * scale, least, way.z * scale)
}

/// Width of a blade at a share of its length, as a share of its widest.
pub fn profile(along: f32) -> f32 {
    (0.72 + 0.28 * math::smoothstep(0.0, 0.3, along)) * (1.0 - along * along * along)
}

/// Unit vector across a blade that stands flat to its `heading` before it is bent: carried along with the `tangent` (unit), then turned
/// about it by `twist` rad.
pub fn across(heading: [f32; 2], tangent: Vec3, twist: f32) -> Vec3 {
    let side = Vec3::new(-heading[1], 0.0, heading[0]);
    let carried = side - side.dot(tangent) / math::upper(1.0 + tangent.y, 0.1) * (tangent + Vec3::Y);
    let (sine, cosine) = math::sin_cos(twist);
    (carried * cosine + tangent.cross(carried) * sine).normalize_or(Vec3::X)
}

/// Share of blades drawn (§2.2, eq. 3 and 4): 1 − F of the paper. `facing` = n·r of the ground's normal and the direction to the eye, unit;
/// `distance` to it, m; `terms` = (a₁, a₂, a₃).
pub fn density(terms: [f32; 3], facing: f32, distance: f32) -> f32 {
    let facing = if facing < 0.0 { -facing } else { facing };
    let rim = 1.0 - facing;
    let squared = rim * rim;
    let fourth = squared * squared;
    let t = fourth * fourth;
    let seen = (1.0 - t) * facing + t;
    math::clamped(seen / math::upper(terms[0] + terms[1] * distance + terms[2] * distance * distance, 1e-6), 0.0, 1.0)
}
