//! What can be wrong with a terrain.

use thiserror::Error;

/// Why a terrain could not be made.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum TerrainError {
    /// The sidecar is not TOML.
    #[error("the terrain's sidecar is not valid TOML: {0}; expected are lines like `metres_per_pixel_x = 30`")]
    Sidecar(String),
    /// The sidecar lacks a key.
    #[error("the terrain's sidecar lacks `{key}`; add a line like `{example}`")]
    MissingKey {
        /// The key.
        key: &'static str,
        /// A line that would do.
        example: &'static str,
    },
    /// A value in the sidecar, or an argument, cannot be used.
    #[error("the terrain's `{key}` is {found}, allowed is {allowed}")]
    Value {
        /// The key or argument.
        key: &'static str,
        /// What stands there.
        found: String,
        /// What may stand there.
        allowed: &'static str,
    },
    /// All edits together lie too far apart.
    #[error(
        "the terrain's `edits` is {} m x {} m, allowed is a rectangle round all of them of at most {most} square metres",
        .size[0], .size[1]
    )]
    Scattered {
        /// Sides of the rectangle round them, m.
        size: [f64; 2],
        /// Its largest area over this terrain, m².
        most: f64,
    },
    /// The image is not a readable PNG.
    #[error(
        "the terrain's image is not a readable PNG: {0}; expected is a 16-bit grey PNG, or a TIFF: export it again (gdal_translate -ot UInt16 -of PNG)"
    )]
    Image(String),
    /// The image is of another kind.
    #[error(
        "the terrain's image is {found}, needed is 16-bit grey without alpha (L16): export it again (gdal_translate -b 1 -ot UInt16 -of PNG)"
    )]
    Colour {
        /// What was found, such as `Rgb8`.
        found: String,
    },
    /// The TIFF cannot be used.
    #[error("the terrain's image {0}")]
    Tiff(String),
    /// Image and sidecar, or heights and size, disagree.
    #[error("the terrain has {found} {what}, but {expected} are announced; correct what announces them, or export it again")]
    Size {
        /// `columns`, `rows` or `heights`.
        what: &'static str,
        /// How many there are.
        found: u64,
        /// How many there should be.
        expected: u64,
    },
}

impl TerrainError {
    /// Whether the text file beside the picture is at fault.
    pub(crate) fn is_of_sidecar(&self) -> bool {
        const KEYS: [&str; 6] = ["columns", "rows", "metres_per_pixel_x", "metres_per_pixel_y", "min_height_m", "max_height_m"];
        match self {
            Self::Sidecar(_) | Self::MissingKey { .. } => true,
            Self::Value { key, .. } => KEYS.contains(key),
            _ => false,
        }
    }
}

pub(super) fn check(key: &'static str, found: impl std::fmt::Display, allowed: &'static str, good: bool) -> Result<(), TerrainError> {
    if good { Ok(()) } else { Err(TerrainError::Value { key, found: found.to_string(), allowed }) }
}
