//! Small TIFFs, written in memory.

use std::io::Cursor;

use tiff::encoder::colortype::{ColorType, Gray16, Gray32Float, Gray64Float, GrayI16, GrayI32, RGB8};
use tiff::encoder::{Compression, DeflateLevel, TiffEncoder, TiffValue};
use tiff::tags::Tag;

/// Keys of a geographic CRS in degrees, and of web mercator.
pub(crate) const GEOGRAPHIC: &[[u16; 2]] = &[[1024, 2], [1025, 1], [2048, 4326]];
pub(crate) const MERCATOR: &[[u16; 2]] = &[[1024, 1], [1025, 1], [3072, 3857]];

/// A file in the making: its size and tags.
#[derive(Clone, Default)]
pub(crate) struct Tiff {
    size: [u32; 2],
    doubles: Vec<(Tag, Vec<f64>)>,
    keys: Vec<u16>,
    missing: Option<String>,
    compression: Compression,
}

impl Tiff {
    pub(crate) fn new(columns: u32, rows: u32) -> Self {
        Self { size: [columns, rows], ..Self::default() }
    }

    pub(crate) fn pixel(mut self, x: f64, y: f64) -> Self {
        self.doubles.push((Tag::ModelPixelScaleTag, vec![x, y, 0.0]));
        self
    }

    /// The corner of the first pixel.
    pub(crate) fn tie(mut self, x: f64, y: f64) -> Self {
        self.doubles.push((Tag::ModelTiepointTag, vec![0.0, 0.0, 0.0, x, y, 0.0]));
        self
    }

    pub(crate) fn matrix(mut self, matrix: [f64; 16]) -> Self {
        self.doubles.push((Tag::ModelTransformationTag, matrix.to_vec()));
        self
    }

    pub(crate) fn keys(mut self, keys: &[[u16; 2]]) -> Self {
        self.keys = [1, 1, 0, keys.len() as u16].into_iter().chain(keys.iter().flat_map(|[key, value]| [*key, 0, 1, *value])).collect();
        self
    }

    pub(crate) fn missing(mut self, text: &str) -> Self {
        self.missing = Some(text.to_owned());
        self
    }

    fn write<C: ColorType>(&self, samples: &[C::Inner]) -> Vec<u8>
    where
        [C::Inner]: TiffValue,
    {
        let mut bytes = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut bytes).expect("in memory").with_compression(self.compression);
        let mut image = encoder.new_image::<C>(self.size[0], self.size[1]).expect("in memory");
        for (tag, values) in &self.doubles {
            image.encoder().write_tag(*tag, &values[..]).expect("in memory");
        }
        if !self.keys.is_empty() {
            image.encoder().write_tag(Tag::GeoKeyDirectoryTag, &self.keys[..]).expect("in memory");
        }
        if let Some(text) = &self.missing {
            image.encoder().write_tag(Tag::GdalNodata, text.as_str()).expect("in memory");
        }
        image.write_data(samples).expect("in memory");
        bytes.into_inner()
    }

    /// The same heights as samples of all kinds, with the kind's name.
    pub(crate) fn all_kinds(&self, heights: &[f64]) -> Vec<(&'static str, Vec<u8>)> {
        vec![
            ("i16", self.write::<GrayI16>(&heights.iter().map(|h| *h as i16).collect::<Vec<_>>())),
            ("u16", self.write::<Gray16>(&heights.iter().map(|h| *h as u16).collect::<Vec<_>>())),
            ("i32", self.write::<GrayI32>(&heights.iter().map(|h| *h as i32).collect::<Vec<_>>())),
            ("f32", self.write::<Gray32Float>(&heights.iter().map(|h| *h as f32).collect::<Vec<_>>())),
            ("f64", self.write::<Gray64Float>(heights)),
        ]
    }
}

pub(crate) fn float(tiff: Tiff, heights: &[f32]) -> Vec<u8> {
    tiff.write::<Gray32Float>(heights)
}

pub(crate) fn whole(tiff: Tiff, heights: &[i16]) -> Vec<u8> {
    tiff.write::<GrayI16>(heights)
}

pub(crate) fn compressed(mut tiff: Tiff, heights: &[i16]) -> Vec<u8> {
    tiff.compression = Compression::Deflate(DeflateLevel::Balanced);
    tiff.write::<GrayI16>(heights)
}

pub(crate) fn colour() -> Vec<u8> {
    Tiff::new(1, 1).pixel(1.0, 1.0).write::<RGB8>(&[1, 2, 3])
}

/// A small file whose header announces many samples.
pub(crate) fn bomb(columns: u32, rows: u32) -> Vec<u8> {
    let mut bytes = whole(Tiff::new(2, 2).pixel(1.0, 1.0), &[1, 2, 3, 4]);
    // Entries of 12 bytes begin with their tag: 256 is the width, 257 the height.
    for (tag, value) in [(256_u16, columns), (257, rows)] {
        let at = (0..bytes.len() - 12).find(|at| bytes[*at..].starts_with(&tag.to_le_bytes()) && bytes[*at + 4..*at + 8] == [1, 0, 0, 0]);
        let at = at.expect("an entry");
        bytes[at + 2..at + 4].copy_from_slice(&4_u16.to_le_bytes());
        bytes[at + 8..at + 12].copy_from_slice(&value.to_le_bytes());
    }
    bytes
}
