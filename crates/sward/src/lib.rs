//! Vegetation that reacts.
pub mod scene;
