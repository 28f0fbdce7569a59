//! What can be wrong with a plant.

use thiserror::Error;

use crate::figure::FigureError;

/// Why a file could not become a plant.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SpecimenError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FigureError),
    /// A rule names a material that is not there.
    #[error("no material is called `{asked}`; {known}")]
    Material {
        /// What the rule names.
        asked: String,
        /// What there is, in words.
        known: String,
    },
    /// A rule names a material twice.
    #[error("the material `{0}` is said to be both leaves and wood; leave it in one list")]
    Both(String),
    /// The plant is far too small or large.
    #[error("as scaled, the plant is {size} m across, allowed 0.01 to 200 m; type scale: {scale}")]
    Size {
        /// Longest side, m.
        size: String,
        /// A factor that would do.
        scale: String,
    },
    /// Nothing of it is above its root, so it has no height to scale.
    #[error(
        "nothing of the plant is above its root, so it cannot be scaled to a height; put its root at the origin, +y up, or type scale:"
    )]
    NoHeight,
    /// A plant that cannot be grown.
    #[error("{what} is {found}, allowed {allowed}")]
    Grow {
        /// Of which number.
        what: &'static str,
        /// What it is.
        found: String,
        /// What it may be.
        allowed: &'static str,
    },
    /// The machine has too little memory.
    #[error("there is no memory for its {0} triangles; simplify it before exporting (Blender: Decimate)")]
    Memory(u64),
}
