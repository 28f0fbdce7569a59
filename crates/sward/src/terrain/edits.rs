//! What has been added to the ground since it was made: a grid of its own over any terrain, level or not.
//!
//! Samples a quarter of a metre apart, joined by the same splines as the terrain's; outside them nothing is added. The grid grows in
//! blocks with what is edited, so its memory goes by the rectangle round all edits, never by the field. Detail stays on top. Twins:
//! `terrain_edit` of `terrain.wgsl`, `relief_edit` of `relief.wgsl`.

use serde::{Deserialize, Serialize};

use super::surface::{surface_f32, surface_f64};
use super::{MAX_SAMPLES, TerrainError};
use crate::math::{clamped, floored};
use crate::scene::{Change, Edit};

/// Distance of samples, m.
pub const EDIT_SPACING: f64 = 0.25;
/// Most samples: 32 MiB.
pub const MAX_EDIT_SAMPLES: u64 = 1 << 23;
/// The grid grows by this many samples: 16 m.
const BLOCK: i64 = 64;
/// Samples round an edit that stay 0, so that the splines end smoothly.
const MARGIN: i64 = 3;
/// Changes remembered one by one for who follows them; who is farther behind takes all.
const REMEMBERED: usize = 256;

/// A rectangle of samples: first column and row, columns and rows.
pub type Patch = [u32; 4];

/// Heights added to a terrain.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Edits {
    /// Number of the first column and row, counted from the origin.
    first: [i64; 2],
    /// Columns and rows.
    size: [u32; 2],
    /// Heights added \[m\], row by row.
    heights: Vec<f32>,
    /// Changes since the start.
    #[serde(skip)]
    changes: u64,
    /// Changes after which the grid was another: those before it are not to be followed one by one.
    #[serde(skip)]
    laid: u64,
    /// The last changes.
    #[serde(skip)]
    recent: Vec<Patch>,
}

/// The grid as shaders of pictures address it.
#[derive(Debug, Clone, Copy, Default)]
pub struct EditFrame {
    /// Samples per metre, not used, sample position of the frame origin.
    pub mapping: [f32; 4],
    /// Columns, rows.
    pub size: [u32; 2],
}

impl Edits {
    /// Nothing has been edited.
    pub fn is_none(&self) -> bool {
        self.heights.is_empty()
    }

    /// Columns and rows.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Heights added \[m\], row by row.
    pub fn heights(&self) -> &[f32] {
        &self.heights
    }

    /// Changes since the start.
    pub fn changes(&self) -> u64 {
        self.changes
    }

    /// What has changed since there were `changes`; `None`: everything, the grid itself.
    pub fn since(&self, changes: u64) -> Option<&[Patch]> {
        let behind = usize::try_from(self.changes.checked_sub(changes)?).ok()?;
        if changes < self.laid || behind > self.recent.len() { None } else { Some(&self.recent[self.recent.len() - behind..]) }
    }

    /// Most samples over a terrain of `base` of them: both share one buffer.
    fn most(base: usize) -> u64 {
        MAX_EDIT_SAMPLES.min(u64::from(MAX_SAMPLES).saturating_sub(base as u64))
    }

    /// A saved grid in place of this one; `None` if it is none. `base`: samples of the terrain below.
    pub(super) fn replaced(&self, saved: Edits, base: usize) -> Option<Self> {
        let [columns, rows] = saved.size.map(u64::from);
        let near = saved.first.iter().all(|first| (-(1 << 40)..=1 << 40).contains(first));
        let sound = near && columns <= MAX_EDIT_SAMPLES && rows <= MAX_EDIT_SAMPLES && columns * rows == saved.heights.len() as u64;
        let low = saved.heights.iter().all(|height| height.abs() <= 1e5);
        // More than either had: who follows one of them sees that this is another.
        let changes = self.changes.max(saved.changes) + 1;
        (sound && low && columns * rows <= Self::most(base)).then_some(Self { changes, laid: changes, recent: Vec::new(), ..saved })
    }

    /// Makes room for a square round `at` \[m\]; `base`: samples of the terrain below.
    pub(super) fn reserve(&mut self, at: [f64; 2], radius: f64, base: usize) -> Result<(), TerrainError> {
        let low = at.map(|at| ((at - radius) / EDIT_SPACING).floor() as i64);
        let high = at.map(|at| ((at + radius) / EDIT_SPACING).ceil() as i64);
        self.cover(low, high, base)
    }

    /// Makes room for samples from `low` to `high`, both counted from the origin.
    fn cover(&mut self, mut low: [i64; 2], mut high: [i64; 2], base: usize) -> Result<(), TerrainError> {
        for axis in 0..2 {
            low[axis] = (low[axis] - MARGIN).div_euclid(BLOCK) * BLOCK;
            high[axis] = ((high[axis] + MARGIN).div_euclid(BLOCK) + 1) * BLOCK;
            if !self.is_none() {
                low[axis] = low[axis].min(self.first[axis]);
                high[axis] = high[axis].max(self.first[axis] + i64::from(self.size[axis]));
            }
        }
        let size = [0, 1].map(|axis| (high[axis] - low[axis]) as u64);
        let most = Self::most(base);
        if size[0].saturating_mul(size[1]) > most {
            let size = size.map(|samples| samples as f64 * EDIT_SPACING);
            return Err(TerrainError::Scattered { size, most: most as f64 * EDIT_SPACING * EDIT_SPACING });
        }
        let size = size.map(|samples| samples as u32);
        if size != self.size || low != self.first {
            self.lay(low, size);
        }
        Ok(())
    }

    /// Whether both add the same heights at the same places.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.first == other.first && self.size == other.size && self.heights == other.heights
    }

    /// Adds what `edited` adds beyond `usual`. Errors: all together would lie too far apart; then nothing has changed.
    pub(super) fn add_beyond(&mut self, edited: &Self, usual: &Self, base: usize) -> Result<(), TerrainError> {
        let shift = [0, 1].map(|axis| edited.first[axis] - usual.first[axis]);
        let place = |index: usize| [index as i64 % i64::from(edited.size[0]), index as i64 / i64::from(edited.size[0])];
        let near = |along: i64| along.clamp(-1, 1 << 30) as i32;
        let beyond = |index: usize| {
            let at = place(index);
            edited.heights[index] - usual.sample(near(at[0] + shift[0]), near(at[1] + shift[1]))
        };
        let more: Vec<(usize, f32)> =
            (0..edited.heights.len()).map(|index| (index, beyond(index))).filter(|(_, height)| *height != 0.0).collect();
        let (mut low, mut high) = ([i64::MAX; 2], [i64::MIN; 2]);
        for (index, _) in &more {
            for (axis, along) in place(*index).into_iter().enumerate() {
                (low[axis], high[axis]) = (low[axis].min(along + edited.first[axis]), high[axis].max(along + edited.first[axis]));
            }
        }
        if more.is_empty() {
            return Ok(());
        }
        self.cover(low, high, base)?;
        for (index, height) in more {
            let [column, row] = [0, 1].map(|axis| (place(index)[axis] + edited.first[axis] - self.first[axis]) as usize);
            let own = &mut self.heights[row * self.size[0] as usize + column];
            *own = clamped(*own + height, -1e5, 1e5);
        }
        self.changes = self.changes.max(edited.changes) + 1;
        self.laid = self.changes;
        self.recent.clear();
        Ok(())
    }

    fn lay(&mut self, first: [i64; 2], size: [u32; 2]) {
        let mut heights = vec![0.0; (size[0] * size[1]) as usize];
        let shift = [0, 1].map(|axis| (self.first[axis] - first[axis]) as usize);
        for (row, line) in self.heights.chunks_exact(self.size[0].max(1) as usize).enumerate() {
            let start = (row + shift[1]) * size[0] as usize + shift[0];
            heights[start..start + line.len()].copy_from_slice(line);
        }
        (self.first, self.size, self.heights) = (first, size, heights);
        self.changes += 1;
        self.laid = self.changes;
        self.recent.clear();
    }

    /// Changes the samples under a brush, for which there is room; `base` is the height without edits and detail at a place \[m\].
    pub(super) fn apply(&mut self, edit: &Edit, base: impl Fn([f64; 2]) -> f64) {
        let radius = f64::from(edit.radius);
        let hardness = f64::from(edit.hardness);
        let target = match &edit.change {
            // What grows is not of the ground.
            Change::Raise(_) | Change::Cut(_) | Change::Burn | Change::Regrow(_) => 0.0,
            Change::Flatten(flatten) => flatten.height.map_or_else(|| base(edit.at) + self.at_ground(edit.at).0, f64::from),
        };
        let span = |axis: usize| {
            let ends = [edit.at[axis] - radius, edit.at[axis] + radius].map(|at| (at / EDIT_SPACING) as i64 - self.first[axis]);
            let last = i64::from(self.size[axis]) - 1;
            [(ends[0] - 1).clamp(0, last) as u32, (ends[1] + 1).clamp(0, last) as u32]
        };
        let ([x0, x1], [z0, z1]) = (span(0), span(1));
        for row in z0..=z1 {
            for column in x0..=x1 {
                let place = [column, row].map(i64::from);
                let ground = [0, 1].map(|axis| (place[axis] + self.first[axis]) as f64 * EDIT_SPACING);
                let way = [0, 1].map(|axis| (ground[axis] - edit.at[axis]) / radius);
                let away = (way[0] * way[0] + way[1] * way[1]).sqrt();
                let slope = if away > hardness { (away - hardness) / (1.0 - hardness) } else { 0.0 };
                if slope >= 1.0 {
                    continue;
                }
                let weight = (1.0 - slope * slope) * (1.0 - slope * slope);
                let height = &mut self.heights[(row * self.size[0] + column) as usize];
                let more = match &edit.change {
                    Change::Raise(raise) => f64::from(raise.height),
                    Change::Flatten(_) => target - base(ground) - f64::from(*height),
                    Change::Cut(_) | Change::Burn | Change::Regrow(_) => 0.0,
                };
                *height = clamped((f64::from(*height) + more * weight) as f32, -1e5, 1e5);
            }
        }
        self.changes += 1;
        if self.recent.len() == REMEMBERED {
            self.recent.remove(0);
        }
        self.recent.push([x0, z0, x1 - x0 + 1, z1 - z0 + 1]);
    }

    /// Sample before a ground position \[m\], counted from the grid's first, and the way to the next.
    fn place(&self, ground: [f64; 2]) -> ([i32; 2], [f64; 2]) {
        let (mut index, mut fraction) = ([0; 2], [0.0; 2]);
        for axis in 0..2 {
            let samples = ground[axis] / EDIT_SPACING;
            let samples = if samples.is_finite() { samples } else { 0.0 };
            let whole = samples.floor();
            index[axis] = (whole as i64).saturating_sub(self.first[axis]).clamp(-(1 << 30), 1 << 30) as i32;
            fraction[axis] = samples - whole;
        }
        (index, fraction)
    }

    /// The same for the kernels.
    pub(super) fn anchor(&self, ground: [f64; 2]) -> ([i32; 2], [f32; 2]) {
        let (index, fraction) = self.place(ground);
        (index, fraction.map(|part| part as f32))
    }

    /// A sample; 0 outside.
    fn sample(&self, column: i32, row: i32) -> f32 {
        let inside = column >= 0 && row >= 0 && column < self.size[0] as i32 && row < self.size[1] as i32;
        if inside { self.heights[row as usize * self.size[0] as usize + column as usize] } else { 0.0 }
    }

    /// 4 × 4 samples; `None` where all are 0.
    fn neighbourhood(&self, first: [i32; 2]) -> Option<[[f32; 4]; 4]> {
        if (0..2).any(|axis| first[axis] < -2 || first[axis] > self.size[axis] as i32) {
            return None;
        }
        Some([-1, 0, 1, 2].map(|j| [-1, 0, 1, 2].map(|i| self.sample(first[0] + i, first[1] + j))))
    }

    /// Height \[m\] and slope \[m/m\] added at `local` metres from an anchor.
    pub(super) fn at(&self, index: [i32; 2], fraction: [f32; 2], local: [f32; 2]) -> (f32, [f32; 2]) {
        let per_metre = (1.0 / EDIT_SPACING) as f32;
        let (mut first, mut way) = ([0; 2], [0.0; 2]);
        for axis in 0..2 {
            let place = fraction[axis] + local[axis] * per_metre;
            let whole = floored(place);
            first[axis] = index[axis].saturating_add(whole);
            way[axis] = clamped(place - whole as f32, 0.0, 1.0);
        }
        let Some(samples) = self.neighbourhood(first) else { return (0.0, [0.0; 2]) };
        let (height, [x, z]) = surface_f32(&samples, way);
        (height, [x * per_metre, z * per_metre])
    }

    /// Height \[m\] and slope \[m/m\] added at a ground position \[m\], in f64.
    pub(super) fn at_ground(&self, ground: [f64; 2]) -> (f64, [f64; 2]) {
        let (first, way) = self.place(ground);
        let Some(samples) = self.neighbourhood(first) else { return (0.0, [0.0; 2]) };
        let (height, [x, z]) = surface_f64(&samples, way);
        (height, [x / EDIT_SPACING, z / EDIT_SPACING])
    }

    /// How a frame at `origin` \[m\] addresses the samples.
    pub fn frame(&self, origin: [f64; 2]) -> EditFrame {
        let at = |axis: usize| (origin[axis] / EDIT_SPACING - self.first[axis] as f64) as f32;
        EditFrame { mapping: [(1.0 / EDIT_SPACING) as f32, 0.0, at(0), at(1)], size: self.size }
    }
}
