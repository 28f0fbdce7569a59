//! The ground as pictures see it: a height field in frame space. Twin: `relief.wgsl`.
//!
//! The same Catmull-Rom surface as [`crate::terrain`], mirrored outside; addressed from the frame origin, so that one grid of vertices
//! can reach for kilometres.

use crate::math::floored;
use crate::terrain::{Detail, EditFrame, TerrainDetail};

/// Ground height in WGSL. The host declares `fn relief_load(index: i32) -> f32`.
pub const WGSL: &str = include_str!("relief.wgsl");

/// A height field: row-major samples in metres.
#[derive(Clone, Debug)]
pub struct Relief {
    /// Heights, metres, `columns × rows`, row-major.
    pub heights: Vec<f32>,
    /// Samples along x.
    pub columns: u32,
    /// Samples along z.
    pub rows: u32,
    /// Metres between samples in x and z.
    pub spacing: [f64; 2],
    /// Ground position (x, z) of the first sample, metres.
    pub corner: [f64; 2],
    /// Noise on top.
    pub detail: Detail,
}

impl Relief {
    /// Level ground at `height` metres.
    pub fn flat(height: f32) -> Self {
        Self { heights: vec![height], columns: 1, rows: 1, spacing: [1.0; 2], corner: [0.0; 2], detail: Detail::NONE }
    }

    /// How a frame at `origin` addresses the samples; reduced to one mirrored period so that f32 stays exact far away.
    pub fn frame(&self, origin: [f64; 2]) -> ReliefFrame {
        let at = |axis: usize, count: u32| {
            let period = 2.0 * f64::from(count.max(2) - 1);
            ((origin[axis] - self.corner[axis]) / self.spacing[axis]).rem_euclid(period) as f32
        };
        ReliefFrame {
            mapping: [(1.0 / self.spacing[0]) as f32, (1.0 / self.spacing[1]) as f32, at(0, self.columns), at(1, self.rows)],
            size: [self.columns, self.rows],
            detail: self.detail.kernel,
            detail_anchor: self.detail.anchor(origin),
        }
    }
}

/// The terrain's samples as shaders address them.
#[derive(Clone, Copy, Debug)]
pub struct ReliefFrame {
    /// Samples per metre in x and z, then the sample position of the frame origin.
    pub mapping: [f32; 4],
    /// Columns and rows.
    pub size: [u32; 2],
    /// Noise on top.
    pub detail: TerrainDetail,
    /// The frame origin's cell of the noise, and the way through it.
    pub detail_anchor: ([i32; 2], [f32; 2]),
}

/// Reflection about the outermost samples.
fn mirror(index: i32, count: i32) -> i32 {
    let period = (2 * (count - 1)).max(1);
    let wrapped = index.rem_euclid(period);
    wrapped.min(period - wrapped)
}

fn weights(f: f32) -> [f32; 4] {
    let g = f * f;
    let h = g * f;
    [0.5 * (-f + 2.0 * g - h), 0.5 * (2.0 - 5.0 * g + 3.0 * h), 0.5 * (f + 4.0 * g - 3.0 * h), 0.5 * (h - g)]
}

/// Noise on top of the samples at `p`, m, for a camera at `camera` (x, z). Far off, where the grid of the ground is coarse, it fades out
/// octave by octave; that goes by the distance alone, so that neighbouring rings of the grid agree on their rim.
pub fn detail(frame: &ReliefFrame, camera: [f32; 2], p: [f32; 2]) -> f32 {
    let away = [p[0] - camera[0], p[1] - camera[1]];
    let resolved = ((away[0] * away[0] + away[1] * away[1]).sqrt() / 24.0 - 1.0).max(0.0);
    frame.detail.seen(frame.detail_anchor, p, resolved)
}

/// Height that edits add at `p` (x, z), m in frame space; `load` gives a sample by column and row. Twin: `relief_edit`.
pub fn edit(frame: &EditFrame, p: [f32; 2], load: impl Fn(i32, i32) -> f32) -> f32 {
    let size = frame.size.map(|count| count as i32);
    let at = [0, 1].map(|axis| p[axis] * frame.mapping[0] + frame.mapping[2 + axis]);
    let corner = at.map(floored);
    if size[0] == 0 || (0..2).any(|axis| corner[axis] < -2 || corner[axis] > size[axis]) {
        return 0.0;
    }
    let (wx, wz) = (weights(at[0] - corner[0] as f32), weights(at[1] - corner[1] as f32));
    let mut sum = 0.0;
    for j in 0..4 {
        for i in 0..4 {
            let (column, row) = (corner[0] + i - 1, corner[1] + j - 1);
            if column >= 0 && row >= 0 && column < size[0] && row < size[1] {
                sum += wx[i as usize] * wz[j as usize] * load(column, row);
            }
        }
    }
    sum
}

/// Height of the samples at `p` (x, z), metres in frame space; `load` gives a sample, m.
pub fn height(frame: &ReliefFrame, p: [f32; 2], load: impl Fn(i32) -> f32) -> f32 {
    let size = frame.size.map(|count| count as i32);
    if frame.size[0].saturating_mul(frame.size[1]) <= 1 {
        return load(0);
    }
    let at = [0, 1].map(|axis| p[axis] * frame.mapping[axis] + frame.mapping[2 + axis]);
    let corner = at.map(floored);
    let (wx, wz) = (weights(at[0] - corner[0] as f32), weights(at[1] - corner[1] as f32));
    let columns = [0, 1, 2, 3].map(|i| mirror(corner[0].wrapping_add(i - 1), size[0]));
    let mut sum = 0.0;
    for j in 0..4 {
        let start = mirror(corner[1].wrapping_add(j - 1), size[1]) * size[0];
        let mut row = 0.0;
        for i in 0..4 {
            row += wx[i] * load(start + columns[i]);
        }
        sum += wz[j as usize] * row;
    }
    sum
}
