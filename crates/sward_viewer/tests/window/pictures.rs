//! What screenshots are asked.

use image::RgbImage;
use serde_json::Value;

/// A part of a screenshot.
pub(crate) fn part(picture: &RgbImage, mark: &Value) -> RgbImage {
    let side = |index: usize| mark[index].as_f64().unwrap_or(0.0).max(0.0) as u32;
    image::imageops::crop_imm(picture, side(0), side(1), side(2), side(3)).to_image()
}

/// Mean difference of two pictures of one size, code values.
pub(crate) fn difference(a: &RgbImage, b: &RgbImage) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions());
    let sum: u64 = a.iter().zip(b.iter()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / a.len().max(1) as f64
}

/// Standard deviation of all code values: 0 of an empty picture.
pub(crate) fn variety(picture: &RgbImage) -> f64 {
    let count = picture.len().max(1) as f64;
    let mean = picture.iter().map(|value| f64::from(*value)).sum::<f64>() / count;
    (picture.iter().map(|value| (f64::from(*value) - mean).powi(2)).sum::<f64>() / count).sqrt()
}
