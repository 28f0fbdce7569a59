//! The picture of a mask.

use std::io::Cursor;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

/// Most pixels along a side.
const MOST: u32 = 2048;

/// Shades of a mask, row by row: 0 is bare ground, 255 changes nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaskImage {
    /// Pixels along x.
    pub columns: u32,
    /// Pixels along z.
    pub rows: u32,
    /// Shades.
    pub shades: Vec<u8>,
}

impl MaskImage {
    /// A mask from a grey PNG of 8 or 16 bits, 1 to 2048 pixels a side. The size is looked at before pixels are read.
    ///
    /// # Errors
    /// What is wrong with the picture, and what was expected.
    pub fn from_png(bytes: &[u8]) -> Result<Self, String> {
        let unreadable = |error: image::ImageError| format!("the mask is not a readable PNG: {error}");
        let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
        let mut limits = Limits::default();
        limits.max_alloc = Some(64 << 20);
        reader.limits(limits);
        let decoder = reader.into_decoder().map_err(unreadable)?;
        let (columns, rows) = decoder.dimensions();
        if !(1..=MOST).contains(&columns) || !(1..=MOST).contains(&rows) {
            return Err(format!("the mask is {columns} x {rows} pixels, allowed are 1 to {MOST} a side"));
        }
        let shades = match DynamicImage::from_decoder(decoder).map_err(unreadable)? {
            DynamicImage::ImageLuma8(grey) => grey.into_raw(),
            DynamicImage::ImageLuma16(grey) => grey.into_raw().into_iter().map(|shade| (shade >> 8) as u8).collect(),
            other => return Err(format!("the mask is {:?}, needed is 8- or 16-bit grey without alpha (L8, L16)", other.color())),
        };
        Ok(Self { columns, rows, shades })
    }
}
