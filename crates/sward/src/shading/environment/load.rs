//! The file of a picture of the surroundings.

use std::io::Cursor;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use super::MOST_COLUMNS;

/// Fewest columns.
const FEWEST_COLUMNS: u32 = 8;
/// Brightest radiance: half-precision numbers end at 65504.
const BRIGHTEST: f32 = 65000.0;

/// A number that is no radiance is none.
pub(super) fn bright(value: f32) -> f32 {
    if value > 0.0 { if value < BRIGHTEST { value } else { BRIGHTEST } } else { 0.0 }
}

/// Columns, rows, and linear RGB of an equirectangular Radiance picture. The size is looked at before pixels are read.
pub(super) fn pixels(bytes: &[u8]) -> Result<(u32, u32, Vec<[f32; 3]>), String> {
    let unreadable = |error: image::ImageError| format!("the surroundings are not a readable Radiance picture (.hdr): {error}");
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Hdr);
    let mut limits = Limits::default();
    limits.max_alloc = Some(256 << 20);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(unreadable)?;
    let (columns, rows) = decoder.dimensions();
    if !(FEWEST_COLUMNS..=MOST_COLUMNS).contains(&columns) || columns != rows.saturating_mul(2) {
        return Err(format!(
            "the surroundings are {columns} x {rows} pixels; needed is a picture twice as wide as high, {FEWEST_COLUMNS} to {MOST_COLUMNS} wide"
        ));
    }
    match DynamicImage::from_decoder(decoder).map_err(unreadable)? {
        DynamicImage::ImageRgb32F(picture) => Ok((columns, rows, picture.into_raw().as_chunks::<3>().0.to_vec())),
        other => Err(format!("the surroundings are {:?}, needed is RGB radiance", other.color())),
    }
}
