//! A terrain from a picture: 16-bit grey for the heights, and a TOML file beside it for the metres.

use super::error::check;
use super::{MAX_SAMPLES, MAX_SIDE, Terrain, TerrainError};
use image::{ColorType, DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// What the sidecar says, in metres.
pub(super) struct Sidecar {
    columns: u32,
    rows: u32,
    spacing: [f64; 2],
    lowest: f64,
    highest: f64,
}

impl Terrain {
    /// A terrain from the bytes of a 16-bit grey PNG and the text of its sidecar.
    ///
    /// The sidecar holds `columns`, `rows`, `metres_per_pixel_x`, `metres_per_pixel_y`, `min_height_m` (grey 0) and
    /// `max_height_m` (grey 65535). Row 0 is the north edge (lowest z), column 0 the west edge (lowest x). All three
    /// axes are multiplied by `scale` (1e-4..=1e4); the middle of the grid comes to lie at `offset` (x, z) \[m\].
    ///
    /// Errors name the key, or say what the picture is.
    pub fn from_image(png_bytes: &[u8], sidecar_toml: &str, scale: f64, offset: [f64; 2]) -> Result<Self, TerrainError> {
        check("scale", scale, "0.0001 to 10000", (1e-4..=1e4).contains(&scale))?;
        let sidecar = Sidecar::parse(sidecar_toml)?;
        let grey = decode(png_bytes, sidecar.columns, sidecar.rows)?;
        let metres = (sidecar.highest - sidecar.lowest) / 65535.0;
        let height = |value: &u16| ((sidecar.lowest + f64::from(*value) * metres) * scale) as f32;
        placed(grey.iter().map(height).collect(), [sidecar.columns, sidecar.rows], sidecar.spacing, scale, offset)
    }
}

/// A grid of scaled heights, `spacing` \[m\] before scaling, its middle at `offset`.
pub(super) fn placed(heights: Vec<f32>, size: [u32; 2], spacing: [f64; 2], scale: f64, offset: [f64; 2]) -> Result<Terrain, TerrainError> {
    let spacing = spacing.map(|metres| metres * scale);
    let corner = [0, 1].map(|axis| offset[axis] - f64::from(size[axis] - 1) * 0.5 * spacing[axis]);
    Terrain::new(heights, size[0], size[1], spacing, corner)
}

impl Sidecar {
    /// Only the size of a pixel, m.
    pub(super) fn spacing_of(text: &str) -> Result<[f64; 2], TerrainError> {
        let table: toml::Table = text.parse().map_err(|e: toml::de::Error| TerrainError::Sidecar(e.to_string()))?;
        let metres = |key, example| {
            let value = number(&table, key, example)?;
            check(key, value, "0.001 to 1000000 m", (1e-3..=1e6).contains(&value))?;
            Ok(value)
        };
        Ok([metres("metres_per_pixel_x", "metres_per_pixel_x = 30")?, metres("metres_per_pixel_y", "metres_per_pixel_y = 30")?])
    }

    fn parse(text: &str) -> Result<Self, TerrainError> {
        let table: toml::Table = text.parse().map_err(|e: toml::de::Error| TerrainError::Sidecar(e.to_string()))?;
        let metres = |key, example| {
            let value = number(&table, key, example)?;
            check(key, value, "0.001 to 1000000 m", (1e-3..=1e6).contains(&value))?;
            Ok(value)
        };
        let height = |key, example| {
            let value = number(&table, key, example)?;
            check(key, value, "-1000000 to 1000000 m", (-1e6..=1e6).contains(&value))?;
            Ok(value)
        };
        let sidecar = Self {
            columns: side(&table, "columns", "columns = 403")?,
            rows: side(&table, "rows", "rows = 344")?,
            spacing: [
                metres("metres_per_pixel_x", "metres_per_pixel_x = 74.5732")?,
                metres("metres_per_pixel_y", "metres_per_pixel_y = 92.475")?,
            ],
            lowest: height("min_height_m", "min_height_m = 236")?,
            highest: height("max_height_m", "max_height_m = 1076")?,
        };
        let most = u64::from(sidecar.columns) * u64::from(sidecar.rows);
        check("rows", sidecar.rows, "so many that there are at most 33554432 samples", most <= MAX_SAMPLES.into())?;
        check("max_height_m", sidecar.highest, "at least `min_height_m`", sidecar.highest >= sidecar.lowest)?;
        Ok(sidecar)
    }
}

fn number(table: &toml::Table, key: &'static str, example: &'static str) -> Result<f64, TerrainError> {
    match table.get(key).ok_or(TerrainError::MissingKey { key, example })? {
        toml::Value::Integer(whole) => Ok(*whole as f64),
        toml::Value::Float(number) => Ok(*number),
        other => Err(TerrainError::Value { key, found: other.to_string(), allowed: "a number" }),
    }
}

fn side(table: &toml::Table, key: &'static str, example: &'static str) -> Result<u32, TerrainError> {
    let value = number(table, key, example)?;
    let good = (1.0..=f64::from(MAX_SIDE)).contains(&value) && value == value.floor();
    check(key, value, "a whole number from 1 to 16384", good)?;
    Ok(value as u32)
}

/// Width and height that a PNG's header announces; none if it has no header.
pub(crate) fn announced(png: &[u8]) -> Option<[u32; 2]> {
    let header = png.strip_prefix(b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR")?;
    let word = |at: usize| header.get(at..at + 4)?.try_into().ok().map(u32::from_be_bytes);
    Some([word(0)?, word(4)?])
}

/// Grey values, row-major. The announced size is compared before anything large is allocated.
fn decode(png_bytes: &[u8], columns: u32, rows: u32) -> Result<Vec<u16>, TerrainError> {
    let unreadable = |error: image::ImageError| TerrainError::Image(error.to_string());
    let [width, height] = announced(png_bytes).unwrap_or([columns, rows]);
    for (what, found, expected) in [("columns", width, columns), ("rows", height, rows)] {
        if found != expected {
            return Err(TerrainError::Size { what, found: found.into(), expected: expected.into() });
        }
    }
    let mut reader = ImageReader::with_format(Cursor::new(png_bytes), ImageFormat::Png);
    reader.limits(Limits::default());
    let decoder = reader.into_decoder().map_err(unreadable)?;
    if decoder.color_type() != ColorType::L16 {
        return Err(TerrainError::Colour { found: format!("{:?}", decoder.color_type()) });
    }
    Ok(DynamicImage::from_decoder(decoder).map_err(unreadable)?.into_luma16().into_raw())
}
