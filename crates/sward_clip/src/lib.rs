//! Clips: frames to AV1 in an MP4 file, which browsers and players open. In Rust alone: no assembler and no library of the system.
//!
//! [`Clip`] takes one frame after another and writes a whole file at the end. The same frames make the same bytes, on every machine and
//! with any number of threads. The encoder is kept in a crate of its own because it takes long to build.

#![forbid(unsafe_code)]

mod boxes;
mod clip;
mod colour;
mod encoder;
mod error;
mod units;

pub use clip::{Clip, check};
pub use error::ClipError;
