//! What can go wrong with a clip.

/// Why a clip cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ClipError {
    /// A side is too short.
    #[error("{width}x{height} is too small for a clip: a side has at least {least} pixels")]
    TooSmall {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Pixels of the shortest side there can be.
        least: u32,
    },
    /// More than AV1's highest level has.
    #[error("{width}x{height} is too large for a clip: AV1 goes up to {widest} pixels in width, {highest} in height and {most} in all")]
    TooLarge {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Largest width, pixels.
        widest: u32,
        /// Largest height, pixels.
        highest: u32,
        /// Most pixels of a frame.
        most: u64,
    },
    /// Two by two pixels share one sample of colour.
    #[error("a clip has one sample of colour for two by two pixels, and {width}x{height} has an odd side")]
    Odd {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    /// No frames a second, or too many.
    #[error("{0} frames a second cannot be encoded: 1 to 1000 can")]
    Rate(u32),
    /// The frame's bytes are not those of its size.
    #[error("a frame has {found} bytes where {wanted} are wanted: 3 for every pixel")]
    Frame {
        /// Bytes that came.
        found: usize,
        /// Bytes that should have.
        wanted: usize,
    },
    /// A clip of no frame.
    #[error("a clip has at least one frame")]
    Empty,
    /// The encoder gave up.
    #[error("the clip cannot be encoded: {0}")]
    Encoder(String),
    /// A file cannot be read or written.
    #[error("{0}")]
    File(#[from] std::io::Error),
}
