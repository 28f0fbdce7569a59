//! Vegetation that reacts.

#![forbid(unsafe_code)]

pub mod geometry;
pub mod shading;
