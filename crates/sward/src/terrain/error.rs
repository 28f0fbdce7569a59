//! What can be wrong with a terrain.

use thiserror::Error;

/// Why a terrain could not be made.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum TerrainError {
    /// The sidecar is not TOML.
    #[error("the terrain's sidecar is not valid TOML: {0}")]
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
    /// The image is not a readable PNG.
    #[error("the terrain's image is not a readable PNG: {0}")]
    Image(String),
    /// The image is of another kind.
    #[error("the terrain's image is {found}, needed is 16-bit grey without alpha (L16)")]
    Colour {
        /// What was found, such as `Rgb8`.
        found: String,
    },
    /// The TIFF cannot be used.
    #[error("the terrain's image {0}")]
    Tiff(String),
    /// Image and sidecar, or heights and size, disagree.
    #[error("the terrain has {found} {what}, but {expected} are announced")]
    Size {
        /// `columns`, `rows` or `heights`.
        what: &'static str,
        /// How many there are.
        found: u64,
        /// How many there should be.
        expected: u64,
    },
}

pub(super) fn check(key: &'static str, found: impl std::fmt::Display, allowed: &'static str, good: bool) -> Result<(), TerrainError> {
    if good { Ok(()) } else { Err(TerrainError::Value { key, found: found.to_string(), allowed }) }
}
