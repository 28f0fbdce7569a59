//! The ground: a height field, smooth to its first derivative, without an edge.
//!
//! Samples are joined by bicubic Catmull-Rom splines, so height and slope are continuous. Outside its samples the field is
//! mirrored about the outermost ones, for ever. Kernels work in `f32` relative to a [`TerrainAnchor`], which the CPU computes
//! in `f64`, so the ground is as exact 250 km away as at home. Twin: `terrain.wgsl`.

mod detail;
mod edits;
mod error;
mod geotiff;
mod load;
mod surface;
#[cfg(test)]
mod tests;

use crate::math::{clamped, floored};
use crate::scene::Edit;
pub use detail::{DETAIL_WGSL, Detail, TerrainDetail};
pub use edits::{EDIT_SPACING, EditFrame, Edits, MAX_EDIT_SAMPLES, Patch};
pub use error::TerrainError;
use error::check;
pub use geotiff::is_tiff;
pub(crate) use load::announced;
use surface::{mirrored, period, surface_f32, surface_f64};

/// The text of the WGSL twin. It needs `math.wgsl` and a function `terrain_load(index: i32) -> f32` from its host.
pub const WGSL: &str = concat!(include_str!("terrain/detail.wgsl"), "\n", include_str!("terrain.wgsl"));

/// Most samples along one side of a [`Terrain`].
pub const MAX_SIDE: u32 = 16384;
/// Most samples of a [`Terrain`]: 128 MiB of `f32`, what WebGPU grants one binding.
pub const MAX_SAMPLES: u32 = 1 << 25;

/// A height field on the ground plane; see the module's page. Read-only.
#[derive(Debug, Clone, PartialEq)]
pub struct Terrain {
    /// Heights \[m\], row-major, `row * columns + column`; columns go along +x, rows along +z. All finite.
    heights: Vec<f32>,
    columns: u32,
    rows: u32,
    /// Distance of samples in x and z \[m\].
    spacing: [f64; 2],
    /// Ground position of sample (0, 0) \[m\].
    corner: [f64; 2],
    /// 1 / spacing, for the kernels \[1/m\].
    inverse_spacing: [f32; 2],
    /// Samples that had no data.
    filled: u32,
    /// Noise on top.
    detail: Detail,
    /// What has been added since.
    edits: Edits,
}

/// A place on the terrain from which kernels measure: a sample and the way to the next one.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct TerrainAnchor {
    /// Column and row of the sample before it, within one mirrored period 0..2(n − 1) per axis.
    pub index: [i32; 2],
    /// The way from there to the next column and row, 0..=1.
    pub fraction: [f32; 2],
    /// Cell of the detail's coarsest lattice.
    pub detail_cell: [i32; 2],
    /// The way through it, 0..=1.
    pub detail_way: [f32; 2],
    /// Column and row before it among the edits, counted from their first.
    pub edit_index: [i32; 2],
    /// The way from there, 0..=1.
    pub edit_fraction: [f32; 2],
}

/// What the kernels must know besides the heights; the same layout as `TerrainGrid` in WGSL.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct TerrainGrid {
    /// Samples along x and z.
    pub size: [i32; 2],
    /// Samples per metre along x and z.
    pub inverse_spacing: [f32; 2],
    /// Noise on top.
    pub detail: TerrainDetail,
    /// Samples of the edits along x and z; 0: none.
    pub edit_size: [i32; 2],
    /// Where they begin, after the terrain's own.
    pub edit_first: i32,
    /// Of them per metre.
    pub edit_inverse_spacing: f32,
}

impl Default for Terrain {
    /// Flat ground at height 0.
    fn default() -> Self {
        Self::flat(0.0)
    }
}

impl Terrain {
    /// Level ground everywhere; a height \[m\] that is not finite becomes 0.
    pub fn flat(height: f32) -> Self {
        let height = if height.is_finite() { height } else { 0.0 };
        Self {
            heights: vec![height],
            columns: 1,
            rows: 1,
            spacing: [1.0; 2],
            corner: [0.0; 2],
            inverse_spacing: [1.0; 2],
            filled: 0,
            detail: Detail::NONE,
            edits: Edits::default(),
        }
    }

    /// A terrain from `columns × rows` heights \[m\] (row-major, columns along +x), their `spacing` in x and z \[m\] and
    /// the ground position of the first one. Errors: sizes that disagree or exceed [`MAX_SIDE`] or [`MAX_SAMPLES`],
    /// numbers that are not finite, a spacing outside 1e-3..=1e6 m.
    pub fn new(heights: Vec<f32>, columns: u32, rows: u32, spacing: [f64; 2], corner: [f64; 2]) -> Result<Self, TerrainError> {
        check("columns", columns, "1 to 16384", (1..=MAX_SIDE).contains(&columns))?;
        check(
            "rows",
            rows,
            "1 to 16384, with at most 33554432 samples in all",
            (1..=MAX_SIDE).contains(&rows) && rows <= MAX_SAMPLES / columns,
        )?;
        let (found, expected) = (heights.len() as u64, u64::from(columns) * u64::from(rows));
        if found != expected {
            return Err(TerrainError::Size { what: "heights", found, expected });
        }
        for axis in 0..2 {
            check("spacing", spacing[axis], "0.001 to 1000000 m", (1e-3..=1e6).contains(&spacing[axis]))?;
            check("corner", corner[axis], "a finite number of metres", corner[axis].is_finite())?;
        }
        if let Some(height) = heights.iter().find(|height| !height.is_finite()) {
            check("height", height, "a finite number of metres", false)?;
        }
        let inverse_spacing = spacing.map(|metres| (1.0 / metres) as f32);
        Ok(Self { heights, columns, rows, spacing, corner, inverse_spacing, filled: 0, detail: Detail::NONE, edits: Edits::default() })
    }

    /// The same terrain with noise on top.
    pub fn with_detail(self, detail: Detail) -> Self {
        Self { detail, ..self }
    }

    /// The noise on top.
    pub fn detail(&self) -> &Detail {
        &self.detail
    }

    /// Heights of the samples \[m\], row-major, `row * columns + column`; without detail.
    pub fn heights(&self) -> &[f32] {
        &self.heights
    }

    /// The ground is level everywhere.
    pub fn is_flat(&self) -> bool {
        self.edits.is_none() && self.detail.kernel.octaves == 0 && self.heights.iter().all(|height| *height == self.heights[0])
    }

    /// What has been added since the terrain was made.
    pub fn edits(&self) -> &Edits {
        &self.edits
    }

    /// How often the ground has been changed since it was made.
    pub fn changes(&self) -> u64 {
        self.edits.changes()
    }

    /// Makes room for edits, so that none of them can fail for want of it. Errors: they lie too far apart.
    pub fn reserve_edits(&mut self, edits: &[Edit]) -> Result<(), TerrainError> {
        let base = self.heights.len();
        let mut edits = edits.iter().filter(|edit| edit.change.is_of_ground());
        edits.try_for_each(|edit| self.edits.reserve(edit.at, f64::from(edit.radius), base))
    }

    /// Changes the ground under a brush; its time is not looked at. The answer is the least and greatest x and z \[m\] between which
    /// heights or slopes have changed. Errors: all edits together lie too far apart.
    pub fn edit(&mut self, edit: &Edit) -> Result<[[f64; 2]; 2], TerrainError> {
        self.reserve_edits(std::slice::from_ref(edit))?;
        let mut edits = std::mem::take(&mut self.edits);
        edits.apply(edit, |ground| self.surface_at(ground).0);
        self.edits = edits;
        let reach = f64::from(edit.radius) + 3.0 * EDIT_SPACING;
        Ok([edit.at.map(|at| at - reach), edit.at.map(|at| at + reach)])
    }

    /// Puts saved edits in place of those there are; false, and nothing changes, if they are none.
    pub(crate) fn put_edits(&mut self, saved: Edits) -> bool {
        let replaced = self.edits.replaced(saved, self.heights.len());
        let sound = replaced.is_some();
        self.edits = replaced.unwrap_or_else(|| std::mem::take(&mut self.edits));
        sound
    }

    /// Adds what `edited` has beyond `usual`, both edits of one terrain; false, and nothing changes, if all would lie too far apart.
    pub(crate) fn add_beyond(&mut self, edited: &Edits, usual: &Edits) -> bool {
        self.edits.add_beyond(edited, usual, self.heights.len()).is_ok()
    }

    /// The same terrain as it was before any edit.
    pub(crate) fn unedited(&self) -> Self {
        Self { edits: Edits::default(), ..self.clone() }
    }

    /// Whether both are the same ground before any edit.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let frame = |terrain: &Self| (terrain.columns, terrain.rows, terrain.spacing, terrain.corner);
        frame(self) == frame(other) && self.detail == other.detail && self.heights == other.heights
    }

    /// Whether both are the same ground, edits included.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        self.is_like(other) && self.edits.is_like(&other.edits)
    }

    /// How many samples had no data in their file and took the height of the nearest that had.
    pub fn filled(&self) -> u32 {
        self.filled
    }

    /// Samples along x.
    pub fn columns(&self) -> u32 {
        self.columns
    }

    /// Samples along z.
    pub fn rows(&self) -> u32 {
        self.rows
    }

    /// Distance of samples in x and z \[m\].
    pub fn spacing(&self) -> [f64; 2] {
        self.spacing
    }

    /// Ground position of the first sample \[m\], the lowest x and z.
    pub fn corner(&self) -> [f64; 2] {
        self.corner
    }

    /// What the GPU must know besides [`Terrain::heights`].
    pub fn grid(&self) -> TerrainGrid {
        TerrainGrid {
            size: [self.columns as i32, self.rows as i32],
            inverse_spacing: self.inverse_spacing,
            detail: self.detail.kernel,
            edit_size: self.edits.size().map(|count| count as i32),
            edit_first: self.heights.len() as i32,
            edit_inverse_spacing: (1.0 / EDIT_SPACING) as f32,
        }
    }

    /// The anchor at a ground position (x, z) \[m\].
    pub fn anchor(&self, ground: [f64; 2]) -> TerrainAnchor {
        let (index, fraction) = self.place(ground);
        let (detail_cell, detail_way) = self.detail.anchor(ground);
        let (edit_index, edit_fraction) = self.edits.anchor(ground);
        TerrainAnchor { index, fraction: fraction.map(|part| part as f32), detail_cell, detail_way, edit_index, edit_fraction }
    }

    /// Height \[m\] at `local` metres (x, z) from the anchor.
    pub fn height(&self, anchor: TerrainAnchor, local: [f32; 2]) -> f32 {
        self.height_and_gradient(anchor, local).0
    }

    /// Slope \[m/m\] along x and z at `local` metres (x, z) from the anchor.
    pub fn gradient(&self, anchor: TerrainAnchor, local: [f32; 2]) -> [f32; 2] {
        self.height_and_gradient(anchor, local).1
    }

    /// Height \[m\] and slope along x and z \[m/m\] at `local` metres (x, z) from the anchor.
    /// Exact to 1e-4 m for heights below 2 km and |local| ≤ 64 m.
    pub fn height_and_gradient(&self, anchor: TerrainAnchor, local: [f32; 2]) -> (f32, [f32; 2]) {
        let mut first = [0; 2];
        let mut way = [0.0; 2];
        for axis in 0..2 {
            let place = anchor.fraction[axis] + local[axis] * self.inverse_spacing[axis];
            let whole = floored(place);
            first[axis] = anchor.index[axis].wrapping_add(whole);
            way[axis] = clamped(place - whole as f32, 0.0, 1.0);
        }
        let (height, slope) = surface_f32(&self.neighbourhood(first), way);
        let mut height = height;
        let mut slope = [slope[0] * self.inverse_spacing[0], slope[1] * self.inverse_spacing[1]];
        if !self.edits.is_none() {
            let (above, rise) = self.edits.at(anchor.edit_index, anchor.edit_fraction, local);
            (height, slope) = (height + above, [slope[0] + rise[0], slope[1] + rise[1]]);
        }
        if self.detail.kernel.octaves == 0 {
            return (height, slope);
        }
        let (above, rise) = self.detail.at(anchor.detail_cell, anchor.detail_way, local);
        (height + above, [slope[0] + rise[0], slope[1] + rise[1]])
    }

    /// Height \[m\] at a ground position (x, z) \[m\], in `f64`.
    pub fn height_at(&self, x: f64, z: f64) -> f64 {
        self.height_and_gradient_at(x, z).0
    }

    /// Height \[m\] and slope along x and z \[m/m\] at a ground position \[m\], in `f64`.
    pub fn height_and_gradient_at(&self, x: f64, z: f64) -> (f64, [f64; 2]) {
        let (mut height, mut slope) = self.surface_at([x, z]);
        if !self.edits.is_none() {
            let (above, rise) = self.edits.at_ground([x, z]);
            (height, slope) = (height + above, [slope[0] + rise[0], slope[1] + rise[1]]);
        }
        if self.detail.kernel.octaves == 0 {
            return (height, slope);
        }
        let (above, rise) = self.detail.at_ground([x, z]);
        (height + above, [slope[0] + rise[0], slope[1] + rise[1]])
    }

    /// Height \[m\] and slope \[m/m\] of the samples alone, in f64.
    fn surface_at(&self, ground: [f64; 2]) -> (f64, [f64; 2]) {
        let (index, fraction) = self.place(ground);
        let (height, slope) = surface_f64(&self.neighbourhood(index), fraction);
        (height, [slope[0] / self.spacing[0], slope[1] / self.spacing[1]])
    }

    /// Column and row before a ground position, within one mirrored period, and the way to the next.
    fn place(&self, ground: [f64; 2]) -> ([i32; 2], [f64; 2]) {
        let mut index = [0; 2];
        let mut fraction = [0.0; 2];
        for axis in 0..2 {
            let samples = (ground[axis] - self.corner[axis]) / self.spacing[axis];
            let samples = if samples.is_finite() { samples } else { 0.0 };
            let whole = samples.floor();
            let samples_along = [self.columns, self.rows][axis] as i32;
            index[axis] = (whole as i64).rem_euclid(i64::from(period(samples_along))) as i32;
            fraction[axis] = samples - whole;
        }
        (index, fraction)
    }

    /// The 4 × 4 samples around the way from `first` to the next column and row.
    fn neighbourhood(&self, first: [i32; 2]) -> [[f32; 4]; 4] {
        let size = [self.columns as i32, self.rows as i32];
        let mut samples = [[0.0; 4]; 4];
        for (j, row) in samples.iter_mut().enumerate() {
            let start = mirrored(first[1].wrapping_add(j as i32 - 1), size[1]) * size[0];
            for (i, sample) in row.iter_mut().enumerate() {
                let column = mirrored(first[0].wrapping_add(i as i32 - 1), size[0]);
                *sample = self.heights[(start + column) as usize];
            }
        }
        samples
    }
}
