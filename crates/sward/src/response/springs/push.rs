//! Vertices go out of bodies, by the way that is shortest and stays above the ground.
//!
//! Orthmann et al. 2009, §5.3, eq. 4–5; methods §4. Reads distance maps. Writes vertices, and by which face each of them left. Twin:
//! `push.wgsl`.
//! Differs from the paper: the face of first contact is kept; a body ends at the ground, so lying flat there is one more way out; the way goes
//! to the tangent plane of what the face sees (eq. 4–5 multiply the normal in twice).

use super::sheet::{CLEAR, MOST_VERTICES, Sheet, SheetRoot, SpringsCoefficients};
use super::vector::plus;
use crate::interaction::distance_map::{DistanceMapHead, sides};
use crate::math;

/// How deep a vertex may lie before it is pushed, m.
pub const TOLERANCE: f32 = 5e-4;
/// How far beyond a surface it is pushed, m: so that it is not back in with the next rounding.
const SLACK: f32 = 2e-4;
/// The lowest of a body's height above the ground that is the ground's, m: there grass lies under it.
pub const TRODDEN: f32 = 2.0 * CLEAR;
/// The way out that leads down to the ground; the faces are 1 to 6, none is 0.
const DOWN: u8 = 7;

/// Farthest a body moves between two moments of a step, m.
const STRIDE: f32 = 0.05;
/// The same, as a share of a column's length.
const STRIDE_SHARE: f32 = 0.25;
/// Most moments of a step.
pub const MOST_MOMENTS: u32 = 8;

/// Farthest a body moves between two moments of a step among columns of `length` m, m.
pub(super) fn stride(length: f32) -> f32 {
    math::upper(math::lower(STRIDE, STRIDE_SHARE * length), 1e-4)
}

/// At how many moments of a step a body is taken that moves `way` m in it, the last one its end, for columns of `length` m: a fast one would
/// pass vertices by, or leave them no time to lie down.
pub fn moments(way: f32, length: f32) -> u32 {
    // Hair's breadths more than a whole number are rounding.
    let count = math::clamped(way / stride(length) - 1e-3, 0.0, (MOST_MOMENTS - 1) as f32);
    math::floored(count) as u32 + 1
}

/// Bodies that reach a patch, as maps.
#[derive(Clone, Copy)]
pub struct Maps<'a> {
    /// Moment by moment.
    pub heads: &'a [DistanceMapHead],
    /// Of all maps.
    pub texels: &'a [[f32; 4]],
}

/// By which way each vertex left a body, as in [`exit`].
pub type Faces = [u8; MOST_VERTICES];

impl Maps<'_> {
    /// None.
    pub const NONE: Maps<'static> = Maps { heads: &[], texels: &[] };

    /// Whether any of them can touch a billboard: its cube's ball comes within a column's length of the foot.
    #[inline(always)]
    pub fn reach(&self, root: &SheetRoot) -> bool {
        self.heads.iter().any(|head| {
            let off = [0, 1, 2].map(|axis: usize| head.centre[axis] - root.at[axis]);
            let [x, z] = root.half_width;
            let far = 1.733 * head.centre[3] + root.length + (x * x + z * z).sqrt();
            off[0] * off[0] + off[1] * off[1] + off[2] * off[2] < far * far
        })
    }

    /// The last moment of the step; those from [`MOST_MOMENTS`] on do not count.
    #[inline(always)]
    pub fn last(&self) -> u32 {
        self.heads.iter().map(|head| head.moment).max().unwrap_or(0).min(MOST_MOMENTS - 1)
    }

    /// How deep a point lies in any of them at one moment, m, 0 outside: the shortest of its ways out, the ground's among them.
    #[inline(always)]
    pub fn depth(&self, root: &SheetRoot, moment: u32, at: [f32; 3]) -> f32 {
        let mut most = 0.0;
        let height = root.height(at);
        if height <= TRODDEN {
            return 0.0;
        }
        for head in self.heads.iter().filter(|head| head.moment == moment) {
            let Some(sides) = sides(head, self.texels, at) else { continue };
            let mut least = height - TRODDEN;
            for side in &sides {
                least = math::lower(-side.depth, least);
            }
            most = math::upper(least, most);
        }
        most
    }

    /// Whether a point lies on the ground under any of them: trodden down, no spring moves it.
    #[inline(always)]
    pub(super) fn is_under(&self, root: &SheetRoot, moment: u32, at: [f32; 3]) -> bool {
        root.height(at) <= TRODDEN + 2.0 * TOLERANCE
            && self.heads.iter().any(|head| head.moment == moment && sides(head, self.texels, at).is_some())
    }

    /// The level direction (x, z) of the way out of a point at one moment; none where it lies in no body or only down leads out.
    #[inline(always)]
    pub(super) fn way_out(&self, root: &SheetRoot, moment: u32, at: [f32; 3], kept: u8) -> Option<[f32; 2]> {
        for head in self.heads.iter().filter(|head| head.moment == moment) {
            if let Some((there, _)) = exit(head, self.texels, root, at, kept) {
                let (x, z) = (there[0] - at[0], there[2] - at[2]);
                let long = (x * x + z * z).sqrt();
                return if long > 1e-6 { Some([x / long, z / long]) } else { None };
            }
        }
        None
    }

    /// The deepest vertex of a sheet at one moment, m.
    #[inline(always)]
    pub fn deepest(&self, co: &SpringsCoefficients, root: &SheetRoot, moment: u32, sheet: &Sheet) -> f32 {
        let (columns, rows) = co.sides();
        let mut most = 0.0;
        for at in &sheet.at[columns..columns * rows] {
            most = math::upper(self.depth(root, moment, *at), most);
        }
        most
    }
}

/// Where a point goes that lies in a body, and by which way; `None` if it lies nowhere deeper than [`TOLERANCE`]. `kept` is the way by which it
/// left last: taken again as long as it leads nowhere below the ground.
#[inline(always)]
pub fn exit(head: &DistanceMapHead, texels: &[[f32; 4]], root: &SheetRoot, at: [f32; 3], kept: u8) -> Option<([f32; 3], u8)> {
    let height = root.height(at);
    if height <= TRODDEN {
        return None;
    }
    let sides = sides(head, texels, at)?;
    let down = [at[0], at[1] - height + CLEAR, at[2]];
    let (mut way, mut there, mut least) = (DOWN, down, height - TRODDEN);
    let mut deep = least;
    for (face, side) in sides.iter().enumerate() {
        let out = plus(at, head.to_world(side.normal), SLACK - side.depth);
        deep = math::lower(-side.depth, deep);
        if root.height(out) < CLEAR {
            continue;
        }
        if face as u8 + 1 == kept {
            (way, there) = (kept, out);
            least = -1.0;
        } else if -side.depth < least {
            (way, there, least) = (face as u8 + 1, out, -side.depth);
        }
    }
    if deep <= TOLERANCE {
        return None;
    }
    Some(if kept == DOWN { (down, DOWN) } else { (there, way) })
}

/// Every vertex above the roots out of each body of one moment in turn. Returns whether any of them moved.
pub fn push(co: &SpringsCoefficients, root: &SheetRoot, maps: &Maps, moment: u32, sheet: &mut Sheet, faces: &mut Faces) -> bool {
    let (columns, rows) = co.sides();
    let mut moved = false;
    for head in maps.heads.iter().filter(|head| head.moment == moment) {
        for vertex in columns..columns * rows {
            if let Some((there, way)) = exit(head, maps.texels, root, sheet.at[vertex], faces[vertex]) {
                sheet.at[vertex] = there;
                faces[vertex] = way;
                moved = true;
            }
        }
    }
    moved
}
