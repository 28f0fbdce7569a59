//! Pictures laid on the ground.

use std::io::Cursor;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use crate::math::clamped;

/// Most pixels along a side.
const MOST: u32 = 2048;

/// Pixels of a picture, row by row: row 0 lies along the edge of least z, column 0 along that of least x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Canvas {
    pub(super) columns: u32,
    pub(super) rows: u32,
}

impl Canvas {
    /// A PNG, not larger than allowed. The size is looked at before pixels are read.
    fn decoded(what: &str, bytes: &[u8]) -> Result<(Self, DynamicImage), String> {
        let unreadable = |error: image::ImageError| format!("the {what} is not a readable PNG: {error}");
        let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
        let mut limits = Limits::default();
        limits.max_alloc = Some(64 << 20);
        reader.limits(limits);
        let decoder = reader.into_decoder().map_err(unreadable)?;
        let (columns, rows) = decoder.dimensions();
        if !(1..=MOST).contains(&columns) || !(1..=MOST).contains(&rows) {
            return Err(format!("the {what} is {columns} x {rows} pixels, allowed are 1 to {MOST} a side"));
        }
        Ok((Self { columns, rows }, DynamicImage::from_decoder(decoder).map_err(unreadable)?))
    }

    /// The pixels of an RGB PNG of 8 bits.
    pub(super) fn colours(what: &str, bytes: &[u8]) -> Result<(Self, Vec<[u8; 3]>), String> {
        let (canvas, picture) = Self::decoded(what, bytes)?;
        match picture {
            DynamicImage::ImageRgb8(picture) => Ok((canvas, picture.pixels().map(|pixel| pixel.0).collect())),
            other => Err(format!("the {what} is {:?}, needed is 8-bit red, green and blue without alpha (Rgb8)", other.color())),
        }
    }

    /// The four pixels around a place, 0 to 1 along x and z, and how far it lies between them.
    pub(super) fn around(&self, at: [f32; 2]) -> ([u32; 4], [f32; 2]) {
        let size = [self.columns, self.rows];
        let place = [0, 1].map(|axis: usize| clamped(at[axis] * size[axis] as f32 - 0.5, 0.0, size[axis] as f32 - 1.0));
        let first = place.map(|along| along as u32);
        let next = [0, 1].map(|axis: usize| (first[axis] + 1).min(size[axis] - 1));
        let texel = |x: u32, z: u32| z * self.columns + x;
        let texels = [texel(first[0], first[1]), texel(next[0], first[1]), texel(first[0], next[1]), texel(next[0], next[1])];
        (texels, [place[0] - first[0] as f32, place[1] - first[1] as f32])
    }
}

/// Between four pixels around a place, as far as it lies between them.
pub(super) fn between([a, b, c, d]: [f32; 4], f: [f32; 2]) -> f32 {
    let (low, high) = (a + (b - a) * f[0], c + (d - c) * f[0]);
    low + (high - low) * f[1]
}

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
    /// A mask from a grey PNG of 8 or 16 bits, 1 to 2048 pixels a side; `what` it is called in an error.
    ///
    /// # Errors
    /// What is wrong with the picture, and what was expected.
    pub fn from_png(what: &str, bytes: &[u8]) -> Result<Self, String> {
        let (Canvas { columns, rows }, picture) = Canvas::decoded(what, bytes)?;
        let shades = match picture {
            DynamicImage::ImageLuma8(grey) => grey.into_raw(),
            DynamicImage::ImageLuma16(grey) => grey.into_raw().into_iter().map(|shade| (shade >> 8) as u8).collect(),
            other => return Err(format!("the {what} is {:?}, needed is 8- or 16-bit grey without alpha (L8, L16)", other.color())),
        };
        Ok(Self { columns, rows, shades })
    }

    /// The shade of a pixel, 0 to 1; white where there is none.
    pub(super) fn shade(&self, texel: u32) -> f32 {
        self.shades.get(texel as usize).map_or(1.0, |shade| f32::from(*shade) / 255.0)
    }

    /// The shade between pixels, 0 to 1; `at` is 0 to 1 along x and z.
    pub(super) fn at(&self, at: [f32; 2]) -> f32 {
        let (texels, f) = Canvas { columns: self.columns, rows: self.rows }.around(at);
        between(texels.map(|texel| self.shade(texel)), f)
    }
}
