//! Vegetation that reacts.

#![forbid(unsafe_code)]

pub mod math;
pub mod terrain;
pub mod wind;
