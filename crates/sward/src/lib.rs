//! Vegetation that reacts.
