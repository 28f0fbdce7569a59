//! A billboard as a sheet of vertices: where it is rooted, how far its vertices are apart at rest.
//!
//! Orthmann et al. 2009, §5.2 and §5.4; methods §4. Columns stand side by side, rows from the root up; a column is a polyline of segments
//! of equal length, its lowest vertex fixed on the ground. Vertices are m from the patch's corner (heights absolute). Twin: `sheet.wgsl`.

use bytemuck::{Pod, Zeroable};

use super::vector::{minus, plus, size, unit};
use crate::math;

/// Most columns and most rows of a sheet.
pub const MOST_SIDE: usize = 9;
/// Most vertices of a sheet.
pub const MOST_VERTICES: usize = MOST_SIDE * MOST_SIDE;
/// How far above the ground vertices keep, m.
pub const CLEAR: f32 = 1e-3;

/// What all billboards of a stand share. The same bytes as in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SpringsCoefficients {
    /// Columns of a sheet, 2 to 9.
    pub columns: u32,
    /// Rows, 2 to 9.
    pub rows: u32,
    /// Sweeps over the springs in a step, 0 to 16.
    pub iterations: u32,
    /// 1: recovery follows the paper's t³, else t²(3 − 2t).
    pub cubic: u32,
    /// k of eq. 6, 0 to 1: share of its change of length that a spring takes back.
    pub stiffness: f32,
    /// Recover time, s, > 0.
    pub recover: f32,
    /// Step, s.
    pub dt: f32,
    /// 0.
    pub unused: u32,
}

impl SpringsCoefficients {
    /// The values a step reads, each brought within its range; what is not a number becomes the least.
    pub fn new([columns, rows]: [u32; 2], iterations: u32, stiffness: f32, recover: f32, dt: f32) -> Self {
        let most = MOST_SIDE as u32;
        Self {
            columns: columns.clamp(2, most),
            rows: rows.clamp(2, most),
            iterations: iterations.min(16),
            cubic: 0,
            stiffness: math::clamped(stiffness, 0.0, 1.0),
            recover: math::clamped(recover, 1e-3, 1e3),
            dt: math::clamped(dt, 1e-5, 1.0),
            unused: 0,
        }
    }

    /// Columns and rows, within what a sheet can have.
    #[inline(always)]
    pub fn sides(&self) -> (usize, usize) {
        ((self.columns as usize).clamp(2, MOST_SIDE), (self.rows as usize).clamp(2, MOST_SIDE))
    }
}

/// Where a billboard stands. The same bytes as in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SheetRoot {
    /// Middle of its foot, m from the patch's corner; y is absolute.
    pub at: [f32; 3],
    /// Length of a column, m; 0 where none stands.
    pub length: f32,
    /// From the middle of the foot to the last column's, along x and z, m.
    pub half_width: [f32; 2],
    /// Gradient of the ground, along x and z.
    pub slope: [f32; 2],
    /// Lean at rest: tilt from upright along x and z, rad.
    pub lean: [f32; 2],
    /// 0.
    pub unused: [f32; 2],
}

impl SheetRoot {
    /// How high a point is above the ground around the root, m.
    #[inline(always)]
    pub fn height(&self, at: [f32; 3]) -> f32 {
        at[1] - self.at[1] - self.slope[0] * (at[0] - self.at[0]) - self.slope[1] * (at[2] - self.at[2])
    }

    /// The foot of a column, m: on the ground.
    #[inline(always)]
    pub fn foot(&self, co: &SpringsCoefficients, column: usize) -> [f32; 3] {
        let share = 2.0 * column as f32 / (co.sides().0 - 1) as f32 - 1.0;
        let [x, z] = self.half_width.map(|part| part * share);
        [self.at[0] + x, self.at[1] + self.slope[0] * x + self.slope[1] * z, self.at[2] + z]
    }

    /// Length of a segment, m.
    #[inline(always)]
    pub fn segment(&self, co: &SpringsCoefficients) -> f32 {
        self.length / (co.sides().1 - 1) as f32
    }
}

/// The direction of a tilt from upright along x and z, rad: unit, continuous at 0.
#[inline(always)]
pub(super) fn direction([x, z]: [f32; 2]) -> [f32; 3] {
    let tilt = (x * x + z * z).sqrt();
    let (sine, cosine) = math::sin_cos(math::lower(tilt, 3.0));
    let share = if tilt > 1e-6 { sine / tilt } else { 1.0 };
    [x * share, cosine, z * share]
}

/// Vertices of a billboard, row by row from the roots up; what lies beyond columns × rows is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheet {
    /// m from the patch's corner; heights absolute.
    pub at: [[f32; 3]; MOST_VERTICES],
}

impl Sheet {
    /// A sheet whose columns' segments point along `way(column, segment)`, unit.
    #[inline(always)]
    pub fn of(co: &SpringsCoefficients, root: &SheetRoot, way: impl Fn(usize, usize) -> [f32; 3]) -> Self {
        let (columns, rows) = co.sides();
        let segment = root.segment(co);
        let mut sheet = Self { at: [[0.0; 3]; MOST_VERTICES] };
        for column in 0..columns {
            sheet.at[column] = root.foot(co, column);
            for row in 1..rows {
                sheet.at[row * columns + column] = plus(sheet.at[(row - 1) * columns + column], way(column, row - 1), segment);
            }
        }
        sheet
    }

    /// Tilt from upright of the line between the middle vertices of two rows, rad along x and z: the tilt of its direction.
    pub fn tilt(&self, co: &SpringsCoefficients, rows: [usize; 2]) -> [f32; 2] {
        let (columns, most) = co.sides();
        let [low, high] = rows.map(|row| self.at[row.min(most - 1) * columns + columns / 2]);
        let [x, y, z] = minus(high, low);
        let level = (x * x + z * z).sqrt();
        let share = math::atan2(level, y) / math::upper(level, 1e-9);
        [x * share, z * share]
    }

    /// Direction of the segment above a vertex, unit.
    #[inline(always)]
    pub(super) fn way(&self, columns: usize, vertex: usize) -> [f32; 3] {
        unit(minus(self.at[vertex + columns], self.at[vertex]))
    }

    /// Largest change of a segment's length, as a share of it.
    pub fn stretch(&self, co: &SpringsCoefficients, root: &SheetRoot) -> f32 {
        let (columns, rows) = co.sides();
        let mut most = 0.0;
        for vertex in 0..columns * (rows - 1) {
            let change = size(minus(self.at[vertex + columns], self.at[vertex])) / root.segment(co) - 1.0;
            most = math::upper(most, if change < 0.0 { -change } else { change });
        }
        most
    }
}
