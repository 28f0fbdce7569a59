//! A footprint's directions and strengths from a picture.

use std::io::Cursor;

use image::{ImageDecoder, ImageFormat, ImageReader, Limits};

use super::footprint::Images;
use crate::terrain::announced;

/// Most pixels along a side.
const MOST: u32 = 512;
/// Shorter than this, of 1, a direction is none.
const NO_DIRECTION: f32 = 0.02;

impl Images {
    /// Adds a square PNG, 2 to 512 pixels a side: red and green are the direction along x and z (0 is −1, 255 is +1), blue the
    /// strength. Row 0 lies towards −z, column 0 towards −x. The answer is the image's number.
    ///
    /// # Errors
    /// What is wrong with the picture, and what was expected.
    pub fn add_png(&mut self, bytes: &[u8]) -> Result<u32, String> {
        let unreadable = |error: image::ImageError| format!("is not a readable PNG: {error}; export it again as RGB");
        let fits = |[width, height]: [u32; 2]| {
            let fits = width == height && (2..=MOST).contains(&width);
            let wanted = format!("expected a square of 2 to {MOST} a side: export it smaller, like 256 x 256");
            if fits { Ok(()) } else { Err(format!("is {width} x {height} pixels, {wanted}")) }
        };
        announced(bytes).map_or(Ok(()), fits)?;
        let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
        let mut limits = Limits::default();
        limits.max_alloc = Some(64 << 20);
        reader.limits(limits);
        let decoder = reader.into_decoder().map_err(unreadable)?;
        let (width, height) = decoder.dimensions();
        fits([width, height])?;
        let picture = image::DynamicImage::from_decoder(decoder).map_err(unreadable)?.into_rgb8();
        let texel = |pixel: &image::Rgb<u8>| {
            let [x, z] = [pixel.0[0], pixel.0[1]].map(|value| f32::from(value) / 127.5 - 1.0);
            let length = (x * x + z * z).sqrt();
            let strength = f32::from(pixel.0[2]) / 255.0;
            if length < NO_DIRECTION { [0.0; 2] } else { [x / length * strength, z / length * strength] }
        };
        let texels: Vec<[f32; 2]> = picture.pixels().map(texel).collect();
        Ok(self.add(width, &texels))
    }
}
