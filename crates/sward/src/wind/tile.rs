//! The noise tile: gradient noise with two channels, baked once, the same bits everywhere.
//!
//! The baked, bilinear tile is what counts; the twins only read it.

use crate::math::{hash, sin_cos, unit};
use std::sync::{Arc, OnceLock};

/// Texels along one side of the tile.
pub const TILE_SIDE: usize = 64;
/// Standard deviation of each channel over the tile's texels; gradient noise has it by nature, the tile exactly.
pub const TILE_DEVIATION: f32 = 0.218;
/// Lattice cells along one side.
const CELLS: usize = 8;
/// The seed of the shipped tile, and what its hashes decide, per channel.
const SEED: u32 = 1;
const GRADIENT: [u32; 2] = [0x6741_0000, 0x6741_0001];

/// A square of noise that repeats without a seam.
#[derive(Debug, Clone, PartialEq)]
pub struct Tile {
    texels: Box<[[f32; 2]]>,
}

impl Tile {
    /// The tile of every wind, baked on first use.
    pub fn shipped() -> Arc<Self> {
        static SHIPPED: OnceLock<Arc<Tile>> = OnceLock::new();
        SHIPPED.get_or_init(|| Arc::new(Self::bake(SEED))).clone()
    }

    /// Texels (two channels, without unit), row-major, [`TILE_SIDE`]², `row * TILE_SIDE + column`; u goes along a row.
    pub fn texels(&self) -> &[[f32; 2]] {
        &self.texels
    }

    /// Bilinear noise at a phase (u, v): the top 6 bits are the texel, the next 24 the way to the next one.
    #[inline(always)]
    pub fn sample(&self, phase: [u32; 2]) -> [f32; 2] {
        let [u, v] = phase.map(|p| (p >> 26) as usize);
        let [s, t] = phase.map(|p| ((p >> 2) & 0x00ff_ffff) as i32 as f32 * (1.0 / 16777216.0));
        let (next_u, next_v) = ((u + 1) % TILE_SIDE, (v + 1) % TILE_SIDE);
        let texel = |column, row| self.texels[row * TILE_SIDE + column];
        let [a, b, c, d] = [texel(u, v), texel(next_u, v), texel(u, next_v), texel(next_u, next_v)];
        let mut noise = [0.0; 2];
        for channel in 0..2 {
            let near = a[channel] + (b[channel] - a[channel]) * s;
            let far = c[channel] + (d[channel] - c[channel]) * s;
            noise[channel] = near + (far - near) * t;
        }
        noise
    }

    /// Gradient noise on a lattice of 8 × 8 cells, brought to mean 0 and [`TILE_DEVIATION`].
    fn bake(seed: u32) -> Self {
        let channels = GRADIENT.map(|purpose| {
            let mut values = raw(seed, purpose);
            let (mean, deviation) = statistics(&values);
            for value in &mut values {
                *value = ((f64::from(*value) - mean) * f64::from(TILE_DEVIATION) / deviation) as f32;
            }
            values
        });
        Self { texels: channels[0].iter().zip(&channels[1]).map(|(a, b)| [*a, *b]).collect() }
    }
}

/// One channel before it is adjusted: unit gradients of random heading on the lattice, blended by the quintic.
pub(super) fn raw(seed: u32, purpose: u32) -> Vec<f32> {
    let mut gradients = [[0.0; 2]; CELLS * CELLS];
    for (index, gradient) in gradients.iter_mut().enumerate() {
        let heading = unit(hash(seed, 0, 0, index as u32, purpose)) * std::f32::consts::TAU;
        let (s, c) = sin_cos(heading);
        *gradient = [c, s];
    }
    let texel = |index: usize| {
        let place = [index % TILE_SIDE, index / TILE_SIDE].map(|i| (i as f32 + 0.5) * (CELLS as f32 / TILE_SIDE as f32));
        lattice_noise(&gradients, place)
    };
    (0..TILE_SIDE * TILE_SIDE).map(texel).collect()
}

/// Gradient noise at a place in lattice cells, 0..8.
fn lattice_noise(gradients: &[[f32; 2]], place: [f32; 2]) -> f32 {
    let cell = place.map(|along| along as usize);
    let way = [place[0] - cell[0] as f32, place[1] - cell[1] as f32];
    let fade = way.map(|t| t * t * t * ((t * 6.0 - 15.0) * t + 10.0));
    let mut sum = 0.0;
    for (j, across) in [1.0 - fade[1], fade[1]].into_iter().enumerate() {
        for (i, along) in [1.0 - fade[0], fade[0]].into_iter().enumerate() {
            let gradient = gradients[(cell[1] + j) % CELLS * CELLS + (cell[0] + i) % CELLS];
            let rise = gradient[0] * (way[0] - i as f32) + gradient[1] * (way[1] - j as f32);
            sum += along * across * rise;
        }
    }
    sum
}

/// Mean and standard deviation.
pub(super) fn statistics(values: &[f32]) -> (f64, f64) {
    let count = values.len() as f64;
    let mut mean = 0.0;
    for value in values {
        mean += f64::from(*value) / count;
    }
    let mut variance = 0.0;
    for value in values {
        let away = f64::from(*value) - mean;
        variance += away * away / count;
    }
    (mean, variance.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::upper;

    fn channel(texels: &[[f32; 2]], which: usize) -> Vec<f32> {
        texels.iter().map(|texel| texel[which]).collect()
    }

    #[test]
    fn gradient_noise_deviates_by_what_the_tile_promises() {
        let raw_deviation: f64 = (0..40).map(|seed| statistics(&raw(seed, 7)).1 / 40.0).sum();
        println!("deviation of unadjusted noise: {raw_deviation:.4}");
        assert!((raw_deviation - f64::from(TILE_DEVIATION)).abs() < 0.005, "{raw_deviation}");
        let tile = Tile::shipped();
        assert_eq!(tile.texels().len(), TILE_SIDE * TILE_SIDE);
        let [a, b] = [0, 1].map(|which| channel(tile.texels(), which));
        for values in [&a, &b] {
            let (mean, deviation) = statistics(values);
            assert!(mean.abs() < 1e-7 && (deviation - f64::from(TILE_DEVIATION)).abs() < 1e-7);
        }
        let product: f64 = a.iter().zip(&b).map(|(a, b)| f64::from(a * b)).sum::<f64>() / a.len() as f64;
        let correlation = product / f64::from(TILE_DEVIATION * TILE_DEVIATION);
        println!("correlation of the channels: {correlation:.3}");
        assert!(correlation.abs() < 0.1, "the channels are not independent: {correlation}");
    }

    #[test]
    fn the_tile_is_continuous_everywhere_and_over_its_seam() {
        let tile = Tile::shipped();
        let jump = |a: [u32; 2], b: [u32; 2]| {
            let (a, b) = (tile.sample(a), tile.sample(b));
            upper((a[0] - b[0]).abs(), (a[1] - b[1]).abs())
        };
        for texel in 0..64u32 {
            for i in 0..50 {
                let (line, along) = (texel << 26, hash(4, 0, 0, i, texel));
                assert!(jump([line, along], [line.wrapping_sub(4), along]) < 1e-6, "u jumps at {line}");
                assert!(jump([along, line], [along, line.wrapping_sub(4)]) < 1e-6, "v jumps at {line}");
            }
        }
        assert_eq!(tile.sample([5 << 26, 63 << 26]), tile.texels()[63 * 64 + 5]);
        let rough = (0..200).any(|i| jump([i << 24, 9 << 20], [(i + 4) << 24, 9 << 20]) > 0.02);
        assert!(rough, "a level tile proves nothing");
    }

    #[test]
    fn the_shipped_tile_has_the_same_bits_everywhere() {
        let bits = Tile::shipped().texels().iter().flatten().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits.into_iter().fold(0, |sum, value| hash(sum, 0, 0, value, 0)), 1293439458);
    }
}
