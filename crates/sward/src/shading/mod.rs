//! How light meets leaves, ground and air.
//!
//! The functions are pure: no textures, no bindings. The WGSL texts are joined by plain concatenation, in the order of
//! [`WGSL`], before a host's own entry points.

pub mod clump;
mod clump_levels;
pub mod sky;

/// Noise, air, tone curve: what all other shading text uses.
pub const COMMON_WGSL: &str = include_str!("common.wgsl");
/// Sky, sun, clouds, hills on the horizon.
pub const SKY_WGSL: &str = include_str!("sky.wgsl");
/// Colour and light of plants.
pub const GRASS_WGSL: &str = include_str!("grass.wgsl");
/// Colour and light of the ground between and behind the plants.
pub const GROUND_WGSL: &str = include_str!("ground.wgsl");

/// All texts in the order they must be joined.
pub const WGSL: [&str; 4] = [COMMON_WGSL, SKY_WGSL, GRASS_WGSL, GROUND_WGSL];
