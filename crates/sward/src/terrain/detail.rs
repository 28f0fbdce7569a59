//! Detail below the samples: octaves of gradient noise, smooth to the second derivative.
//!
//! Perlin, *Improving Noise* (2002): gradients at the corners of a lattice, faded by 6t⁵ − 15t⁴ + 10t³. The gradients are hashes (uniform in
//! a square, so an octave stays within ±1), each octave has a lattice twice as fine. Places are a cell and the way through it, so
//! the noise is as exact far away as at home. Twin: `detail.wgsl`.

use crate::math::{clamped, floored, hash};
use crate::scene;

/// What gradients are hashed for; the octave is added.
const PURPOSE: u32 = 0xde7a_1100;

/// Makes three times the root mean square of one octave 1.
const THREE_RMS: f32 = 1.92;

/// The text of the WGSL twin. It needs `math.wgsl`.
pub const DETAIL_WGSL: &str = include_str!("detail.wgsl");

/// What the kernels must know of the noise; the same layout as `TerrainDetail` in WGSL.
#[derive(Debug, Clone, Copy, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct TerrainDetail {
    /// 1 / side of the coarsest lattice, 1/m.
    pub inverse_wavelength: f32,
    /// Factor of the coarsest octave, m.
    pub amplitude: f32,
    /// Height of an octave as a share of the one before.
    pub roughness: f32,
    /// Octaves; 0: no detail.
    pub octaves: u32,
    /// Seed.
    pub seed: u32,
    /// Not used; keeps the size a multiple of 16 bytes.
    pub unused: [u32; 3],
}

/// The detail of a terrain and where it is anchored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detail {
    /// For the kernels.
    pub kernel: TerrainDetail,
    /// Side of the coarsest lattice, m.
    wavelength: f64,
    /// Ground position of a lattice point, m.
    origin: [f64; 2],
}

impl Detail {
    /// Level everywhere.
    pub const NONE: Self = Self {
        kernel: TerrainDetail { inverse_wavelength: 1.0, amplitude: 0.0, roughness: 0.0, octaves: 0, seed: 0, unused: [0; 3] },
        wavelength: 1.0,
        origin: [0.0; 2],
    };

    /// The noise a scene asks for, with a lattice point at `origin` \[m\].
    pub fn new(detail: &scene::Detail, origin: [f64; 2]) -> Self {
        let (mut sum, mut share) = (0.0, 1.0);
        for _ in 0..detail.octaves {
            (sum, share) = (sum + share * share, share * detail.roughness);
        }
        let kernel = TerrainDetail {
            inverse_wavelength: (1.0 / f64::from(detail.wavelength)) as f32,
            amplitude: if sum > 0.0 { THREE_RMS * detail.amplitude / sum.sqrt() } else { 0.0 },
            roughness: detail.roughness,
            octaves: if detail.amplitude > 0.0 { detail.octaves } else { 0 },
            seed: detail.seed,
            unused: [0; 3],
        };
        Self { kernel, wavelength: f64::from(detail.wavelength), origin }
    }

    /// Lattice cell of a ground position \[m\], and the way through it. Cells wrap after 2³² of them.
    fn place(&self, ground: [f64; 2]) -> ([i32; 2], [f64; 2]) {
        let mut cell = [0; 2];
        let mut way = [0.0; 2];
        for axis in 0..2 {
            let place = (ground[axis] - self.origin[axis]) / self.wavelength;
            let place = if place.is_finite() { place } else { 0.0 };
            let whole = place.floor();
            (cell[axis], way[axis]) = (whole as i64 as i32, place - whole);
        }
        (cell, way)
    }

    /// The same for the kernels.
    pub fn anchor(&self, ground: [f64; 2]) -> ([i32; 2], [f32; 2]) {
        let (cell, way) = self.place(ground);
        (cell, way.map(|part| part as f32))
    }

    /// Height \[m\] and slope \[m/m\] at `local` metres from an anchor.
    pub(super) fn at(&self, cell: [i32; 2], way: [f32; 2], local: [f32; 2]) -> (f32, [f32; 2]) {
        let (mut first, mut rest) = (cell, way);
        for axis in 0..2 {
            let place = way[axis] + local[axis] * self.kernel.inverse_wavelength;
            let whole = floored(place);
            first[axis] = cell[axis].wrapping_add(whole);
            rest[axis] = clamped(place - whole as f32, 0.0, 1.0);
        }
        octaves_f32(&self.kernel, self.kernel.inverse_wavelength, first, rest)
    }

    /// Height \[m\] and slope \[m/m\] at a ground position \[m\], in f64.
    pub(super) fn at_ground(&self, ground: [f64; 2]) -> (f64, [f64; 2]) {
        let (cell, way) = self.place(ground);
        octaves_f64(&self.kernel, 1.0 / self.wavelength, cell, way)
    }
}

impl TerrainDetail {
    /// Height \[m\] at `local` metres from an anchor, where octaves finer than `resolved` metres fade out: for pictures.
    pub fn seen(&self, (cell, way): ([i32; 2], [f32; 2]), local: [f32; 2], resolved: f32) -> f32 {
        let place = [0, 1].map(|axis| way[axis] + local[axis] * self.inverse_wavelength);
        let whole = place.map(floored);
        let rest = [0, 1].map(|axis| clamped(place[axis] - whole[axis] as f32, 0.0, 1.0));
        let (mut sum, mut weight, mut scale) = (0.0, self.amplitude, 1.0);
        for octave in 0..self.octaves {
            let inner = rest.map(|part| floored(part * scale));
            let corner = [0, 1].map(|axis| cell[axis].wrapping_add(whole[axis]).wrapping_shl(octave).wrapping_add(inner[axis]));
            let t = [0, 1].map(|axis| rest[axis] * scale - inner[axis] as f32);
            let seen = clamped(2.0 - resolved * scale * self.inverse_wavelength, 0.0, 1.0);
            sum += seen * weight * noise_f32(self.seed, octave, corner, t).0;
            weight *= self.roughness;
            scale *= 2.0;
        }
        sum
    }
}

/// Gradient at a lattice point of an octave: parts in −1..1, exact in either precision.
fn gradient(seed: u32, octave: u32, point: [i32; 2]) -> [f32; 2] {
    let bits = hash(seed, point[0], point[1], octave, PURPOSE);
    [(bits & 0xffff) as f32 * (1.0 / 32768.0) - 1.0, (bits >> 16) as f32 * (1.0 / 32768.0) - 1.0]
}

/// Noise in one precision: of one octave at the way `t` through a cell (value, slope per cell), and the sum of all.
macro_rules! noise {
    ($octaves:ident, $noise:ident, $float:ty, $floor:expr) => {
        fn $noise(seed: u32, octave: u32, cell: [i32; 2], t: [$float; 2]) -> ($float, [$float; 2]) {
            let fade = t.map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
            let rise = t.map(|t| 30.0 * t * t * (t * (t - 2.0) + 1.0));
            let mut value = [0.0; 4];
            let mut slope = [[0.0; 2]; 4];
            for k in 0..4 {
                let step = [(k & 1) as i32, (k >> 1) as i32];
                let g = gradient(seed, octave, [cell[0].wrapping_add(step[0]), cell[1].wrapping_add(step[1])]);
                slope[k] = [g[0] as $float, g[1] as $float];
                value[k] = slope[k][0] * (t[0] - step[0] as $float) + slope[k][1] * (t[1] - step[1] as $float);
            }
            let across = |a: $float, b: $float| a + (b - a) * fade[0];
            let (low, high) = (across(value[0], value[1]), across(value[2], value[3]));
            let along = |a: $float, b: $float| a + (b - a) * fade[1];
            let inner = |axis: usize| along(across(slope[0][axis], slope[1][axis]), across(slope[2][axis], slope[3][axis]));
            let x = inner(0) + rise[0] * along(value[1] - value[0], value[3] - value[2]);
            let z = inner(1) + rise[1] * (high - low);
            (along(low, high), [x, z])
        }

        fn $octaves(detail: &TerrainDetail, per_metre: $float, cell: [i32; 2], way: [$float; 2]) -> ($float, [$float; 2]) {
            let (mut height, mut slope) = (0.0, [0.0; 2]);
            let (mut weight, mut scale) = (detail.amplitude as $float, 1.0);
            for octave in 0..detail.octaves {
                let (mut inner, mut t) = (cell, way);
                for axis in 0..2 {
                    let place = way[axis] * scale;
                    let whole = $floor(place);
                    inner[axis] = cell[axis].wrapping_shl(octave).wrapping_add(whole);
                    t[axis] = place - whole as $float;
                }
                let (value, rise) = $noise(detail.seed, octave, inner, t);
                height += weight * value;
                slope = [slope[0] + weight * scale * per_metre * rise[0], slope[1] + weight * scale * per_metre * rise[1]];
                weight *= detail.roughness as $float;
                scale *= 2.0;
            }
            (height, slope)
        }
    };
}

noise!(octaves_f32, noise_f32, f32, floored);
noise!(octaves_f64, noise_f64, f64, |place: f64| place.floor() as i32);
