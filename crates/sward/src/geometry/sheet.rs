//! A sheet drawn as a grid of points: where its corners stand, and which way they face. Twin: `sheet.wgsl`.
//!
//! Orthmann et al. 2009, §5.2 and §8. What lies spreads on the ground, as cards do ([`crate::geometry::card`]): a sheet bent along its own
//! width would otherwise lie on edge, and hardly be seen.

use glam::Vec3;

use crate::math;

/// Corners of sheets in WGSL.
pub const WGSL: &str = include_str!("sheet.wgsl");

/// How high the tip of a lying sheet is stacked, as a share of its height: half to one and a half times this, by its chance number.
const LIFT: f32 = 0.18;

/// A corner of the grid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SheetCorner {
    /// Where it stands, m.
    pub place: Vec3,
    /// Along the rows, unit.
    pub across: Vec3,
    /// Out of the sheet, unit.
    pub facing: Vec3,
    /// How much the sheet lies down there, 0..=1.
    pub lying: f32,
}

/// The points of the grid around one of them, m; at a rim the point itself stands for what is missing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Around {
    /// The point.
    pub here: Vec3,
    /// Beside it, towards the first column.
    pub left: Vec3,
    /// Beside it, towards the last column.
    pub right: Vec3,
    /// Below it.
    pub low: Vec3,
    /// Above it.
    pub high: Vec3,
}

impl Around {
    /// Of the point in a `column` and `row` of a grid of `pieces` along each side, whose points are `at(index)`, row by row.
    pub fn of(pieces: usize, [column, row]: [usize; 2], at: impl Fn(usize) -> Vec3) -> Self {
        let point = |column: usize, row: usize| at(row * (pieces + 1) + column);
        Self {
            here: point(column, row),
            left: point(column.saturating_sub(1), row),
            right: point((column + 1).min(pieces), row),
            low: point(column, row.saturating_sub(1)),
            high: point(column, (row + 1).min(pieces)),
        }
    }
}

/// What a corner needs to know of its plant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SheetOf {
    /// Middle of the foot, m.
    pub root: Vec3,
    /// Width, m.
    pub width: f32,
    /// Height, m.
    pub height: f32,
    /// Chance number in 0..1.
    pub tint: f32,
}

/// The corner at a point. `side`: from −1 at the first column to 1 at the last; `along`: from 0 at the root to 1; `keep`: share of its size that
/// a fading plant keeps.
pub fn corner(of: &SheetOf, around: &Around, [side, along]: [f32; 2], keep: f32) -> SheetCorner {
    let tangent = (around.high - around.low + Vec3::new(0.0, 1e-5, 0.0)).normalize();
    let carried = (around.right - around.left + Vec3::new(1e-5, 0.0, 0.0)).normalize();
    let level = (Vec3::new(-tangent.z, 0.0, tangent.x) + Vec3::new(1e-4, 0.0, 0.0)).normalize();
    let spread = if carried.dot(level) > 0.0 { level } else { -level };
    let lying = math::smoothstep(0.35, 0.95, 1.0 - tangent.y);
    let across = carried.lerp(spread, lying).normalize();
    let spreading = (across * (1.0 + 0.35 * lying) - carried) * (0.5 * of.width * keep * side);
    let lift = lying * LIFT * of.height * along * (0.5 + of.tint);
    let place = of.root + (around.here - of.root) * keep + spreading + Vec3::new(0.0, lift, 0.0);
    let facing = (across.cross(tangent) + Vec3::new(0.0, 0.0, 1e-6)).normalize();
    SheetCorner { place, across, facing, lying }
}
