//! A cell at half its size: one axis of β and ω in 32 bits, where two numbers of 32 bits stand otherwise.
//!
//! Chen & Johan 2010, §7: state at half precision. Used by the GPU where a scene asks for `precision: Half`. Twin: `half.wgsl`, the same
//! bits on every device, since all of it is whole numbers.
//! Differs from the paper: not two halves of 16 bits (docs/papers.md). β takes 18 bits in even steps of 2⁻¹⁶ rad, ω the other 14: sign,
//! 5 bits of exponent, 8 of mantissa. The scheme's velocity is a difference of two βs, so β needs the same step near 1 rad as near 0;
//! ω dies away by a share of itself and needs the same digits at every size. Rounding is dithered: up as often as the part
//! lost is of a step. Rounded to the nearest, a force under half a step moves nothing, and plants stop short of rest.

use crate::math;

/// Largest bend \[rad\] that is kept; the limits leave π/2.
const LARGEST_BEND: f32 = 1.75;
/// Bits of 60 rad/s, the largest bending velocity.
const LARGEST_RATE: u32 = 0x4270_0000;
/// Bits of 2⁻²⁵ rad/s, below which ω is none.
const SMALLEST_RATE: u32 = 0x3300_0000;
/// What is taken off the bits of a rate, so that the smallest one has exponent 1.
const RATE_OFFSET: u32 = 0x3280_0000;

/// Dither of a cell, 16 bits for each axis, from its patch's number ([`patch_dither`]) and its place there (row-major index).
#[inline(always)]
pub fn dither(patch: u32, cell: u32) -> u32 {
    math::mixed(patch ^ cell)
}

/// The number from which a patch's cells get their dither in step `step`. Substeps share it.
pub fn patch_dither(patch: [i32; 2], step: u64) -> u32 {
    /// Tells these choices from others about the same patch.
    const PURPOSE: u32 = 0x4a1f;
    math::hash(step as u32, patch[0], patch[1], (step >> 32) as u32, PURPOSE)
}

/// β \[rad\] and ω [rad/s] of one axis in a word, by 16 bits of dither. What a word can hold exactly comes back exactly.
#[inline(always)]
pub fn pack(bend: f32, rate: f32, dither: u32) -> u32 {
    let fine = (math::clamped(bend, -LARGEST_BEND, LARGEST_BEND) * 8_388_608.0) as i32;
    let steps = (fine + ((dither >> 9) & 127) as i32) >> 7;
    let bits = rate.to_bits();
    let size = bits & 0x7fff_ffff;
    let size = if size < LARGEST_RATE { size } else { LARGEST_RATE };
    let code = (size.wrapping_sub(RATE_OFFSET).wrapping_add((dither & 511) << 6) >> 15) | ((bits >> 18) & 0x2000);
    ((steps as u32) << 14) | if size < SMALLEST_RATE { 0 } else { code }
}

/// β of a word, rad.
#[inline(always)]
pub fn bend(word: u32) -> f32 {
    (word as i32 >> 14) as f32 * (1.0 / 65_536.0)
}

/// ω of a word, rad/s.
#[inline(always)]
pub fn rate(word: u32) -> f32 {
    let size = word & 0x1fff;
    let bits = ((size << 15) + RATE_OFFSET) | ((word & 0x2000) << 18);
    if size == 0 { 0.0 } else { f32::from_bits(bits) }
}

/// Packs a patch: planes βx, βz, ωx, ωz of equal length become planes of words x, z. `patch` as of [`patch_dither`].
pub fn pack_patch(cells: &[f32], patch: u32) -> Vec<u32> {
    let area = cells.len() / 4;
    let word = |axis: usize, cell: usize| {
        pack(cells[axis * area + cell], cells[(2 + axis) * area + cell], dither(patch, cell as u32) >> (16 * axis))
    };
    (0..2).flat_map(|axis| (0..area).map(move |cell| word(axis, cell))).collect()
}

/// Unpacks what [`pack_patch`] made.
pub fn unpack_patch(words: &[u32]) -> Vec<f32> {
    words.iter().map(|word| bend(*word)).chain(words.iter().map(|word| rate(*word))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of every size, and dithers.
    fn cases() -> impl Iterator<Item = (f32, f32, u32)> {
        (0..20_000_u32).map(|k| {
            let unit = |purpose| math::unit(math::hash(5, 0, 0, k, purpose));
            let small = 0.5_f32.powi((24.0 * unit(1)) as i32);
            ((unit(2) - 0.5) * 3.0 * small, (unit(3) - 0.5) * 120.0 * small, math::hash(6, 0, 0, k, 4))
        })
    }

    #[test]
    fn numbers_come_back_within_a_step() {
        for (value, velocity, dither) in cases() {
            let word = pack(value, velocity, dither);
            assert!((bend(word) - value).abs() <= 1.0 / 65_536.0, "{value} became {}", bend(word));
            assert!((rate(word) - velocity).abs() <= velocity.abs() / 256.0 + 3e-8, "{velocity} became {}", rate(word));
        }
    }

    #[test]
    fn what_a_word_holds_comes_back_as_the_same_word() {
        for (value, velocity, dither) in cases() {
            let word = pack(value, velocity, dither);
            for again in [0, u32::MAX, dither.rotate_left(7)] {
                assert_eq!(pack(bend(word), rate(word), again), word, "{value} {velocity}");
            }
        }
        assert_eq!(pack(-0.0, -0.0, u32::MAX), 0);
    }

    #[test]
    fn dither_is_right_on_average() {
        for (value, velocity, seed) in cases().take(200) {
            let mean = |of: fn(u32) -> f32| -> f64 {
                (0..4096_u32).map(|k| f64::from(of(pack(value, velocity, math::hash(seed, 0, 0, k, 0))))).sum::<f64>() / 4096.0
            };
            // Sixteenths of a step; to the nearest, errors would reach eight of them.
            assert!((mean(bend) - f64::from(value)).abs() < 1.0 / 65_536.0 / 16.0, "{value}");
            let step = f64::from(velocity.abs()) / 256.0;
            assert!((mean(rate) - f64::from(velocity)).abs() < step / 16.0 + 3e-8, "{velocity}");
        }
    }

    #[test]
    fn nothing_leaves_the_range() {
        for wrong in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e9, -1e9] {
            let word = pack(wrong, wrong, 12345);
            assert!(bend(word).abs() <= LARGEST_BEND && rate(word).abs() <= 60.0, "{wrong}: {} {}", bend(word), rate(word));
        }
        assert_eq!((rate(pack(0.0, 60.0, 0)), rate(pack(0.0, -60.0, u32::MAX))), (60.0, -60.0));
    }

    #[test]
    fn patches_come_back() {
        let cells: Vec<f32> = (0..64).map(|k| k as f32 / 64.0).collect();
        let words = pack_patch(&cells, 7);
        assert_eq!(words.len(), 32);
        let back = unpack_patch(&words);
        assert!(back.iter().zip(&cells).all(|(a, b)| (a - b).abs() < 4e-3));
        assert_eq!(pack_patch(&back, 8), words);
        // A patch differs from another, and a step from the next.
        let numbers = [patch_dither([0, 0], 0), patch_dither([1, 0], 0), patch_dither([0, 1], 0), patch_dither([0, 0], 1)];
        assert!((0..4).all(|a| (0..a).all(|b| numbers[a] != numbers[b])), "{numbers:?}");
    }
}
