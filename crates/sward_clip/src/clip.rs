//! A clip in the making.

use std::fs::File;
use std::io::{BufWriter, Seek, Write};

use crate::boxes::{self, Film};
use crate::colour::Planes;
use crate::encoder::{Encoder, Sample};
use crate::error::ClipError;

/// Shortest side that the encoder takes, pixels.
const LEAST: u32 = 16;
/// Largest width and height and most pixels of a frame: those of AV1's highest level (Annex A.3).
const WIDEST: u32 = 16384;
const HIGHEST: u32 = 8704;
const MOST: u64 = 35_651_584;
/// Most frames a second.
const FASTEST: u32 = 1000;

/// Whether frames of `width` by `height` pixels can be a clip: even sides from 16 pixels on, within AV1's highest level.
///
/// # Errors
/// They cannot, and why.
pub fn check([width, height]: [u32; 2]) -> Result<(), ClipError> {
    if width < LEAST || height < LEAST {
        return Err(ClipError::TooSmall { width, height, least: LEAST });
    }
    if width > WIDEST || height > HIGHEST || u64::from(width) * u64::from(height) > MOST {
        return Err(ClipError::TooLarge { width, height, widest: WIDEST, highest: HIGHEST, most: MOST });
    }
    if width % 2 != 0 || height % 2 != 0 {
        return Err(ClipError::Odd { width, height });
    }
    Ok(())
}

/// A clip in the making: frames go in, a file comes out at the end.
pub struct Clip {
    size: [u32; 2],
    rate: u32,
    encoder: Encoder,
    /// The samples, one after another. Nothing is known yet of those that follow, so the boxes before them cannot be written.
    samples: BufWriter<File>,
    sizes: Vec<u32>,
    /// Samples that can be shown without others, counted from 1.
    keys: Vec<u32>,
}

impl Clip {
    /// For frames of `width` by `height` pixels, `rate` a second (1 to 1000). `samples` is an empty file, open to read and write, for what
    /// is encoded before the whole is; of no use afterwards.
    ///
    /// # Errors
    /// [`check`] refuses the size, or the rate is out of range.
    pub fn new(size: [u32; 2], rate: u32, samples: File) -> Result<Self, ClipError> {
        check(size)?;
        if !(1..=FASTEST).contains(&rate) {
            return Err(ClipError::Rate(rate));
        }
        let encoder = Encoder::new(size, rate)?;
        Ok(Self { size, rate, encoder, samples: BufWriter::new(samples), sizes: Vec::new(), keys: Vec::new() })
    }

    /// Adds a frame: rows from the top, red, green and blue in sRGB, 8 bits each.
    ///
    /// # Errors
    /// The bytes are not those of a frame of that size; the encoder fails; the disk is full.
    pub fn push(&mut self, rgb: &[u8]) -> Result<(), ClipError> {
        let [width, height] = self.size.map(|side| side as usize);
        if rgb.len() != 3 * width * height {
            return Err(ClipError::Frame { found: rgb.len(), wanted: 3 * width * height });
        }
        let samples = self.encoder.push(&Planes::new(rgb, width))?;
        self.keep(&samples)
    }

    /// Writes the whole clip.
    ///
    /// # Errors
    /// There was no frame; the encoder fails; the disk is full.
    pub fn finish(mut self, mut file: File) -> Result<(), ClipError> {
        let rest = self.encoder.finish()?;
        self.keep(&rest)?;
        if self.sizes.is_empty() {
            return Err(ClipError::Empty);
        }
        let [width, height] = self.size.map(|side| side as u16);
        let (configuration, sequence_header) = self.encoder.headers();
        let (sizes, keys) = (&self.sizes[..], &self.keys[..]);
        let film = Film { width, height, rate: self.rate, configuration: &configuration, sequence_header, sizes, keys };
        file.write_all(&boxes::before_frames(&film))?;
        let mut samples = self.samples.into_inner().map_err(std::io::IntoInnerError::into_error)?;
        samples.rewind()?;
        std::io::copy(&mut samples, &mut file)?;
        Ok(())
    }

    fn keep(&mut self, samples: &[Sample]) -> Result<(), ClipError> {
        for sample in samples {
            self.samples.write_all(&sample.bytes)?;
            self.sizes.push(sample.bytes.len() as u32);
            if sample.key {
                self.keys.push(self.sizes.len() as u32);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_even_and_those_of_av1() {
        for good in [[960, 540], [16, 16], [160, 90], [16384, 2176], [4096, 8704]] {
            assert!(check(good).is_ok(), "{good:?}");
        }
        for wrong in [[15, 16], [16, 14], [961, 540], [960, 541], [4096, 8706], [16384, 2178], [16386, 16], [u32::MAX, u32::MAX]] {
            assert!(check(wrong).is_err(), "{wrong:?}");
        }
    }
}
