//! How light meets leaves, ground and air.
//!
//! The functions are pure: no textures, no bindings; each `x.wgsl` has its Rust twin beside it, `x.rs`. The WGSL texts are joined by plain concatenation, in the order of
//! [`WGSL`], before a host's own entry points.

pub mod blade;
pub mod body;
pub mod clump;
mod clump_levels;
pub mod common;
pub mod crown;
pub mod environment;
pub mod foliage;
pub mod grass;
pub mod ground;
pub mod look;
pub mod sky;
pub mod volume;
pub mod water;

/// Noise, air, tone curve: what all other shading text uses.
pub const COMMON_WGSL: &str = include_str!("common.wgsl");
/// Sky, sun, clouds, hills on the horizon.
pub const SKY_WGSL: &str = include_str!("sky.wgsl");
/// Colour and light of plants.
pub const GRASS_WGSL: &str = include_str!("grass.wgsl");
/// Colour and light of the ground between and behind the plants.
pub const GROUND_WGSL: &str = include_str!("ground.wgsl");

/// A pixel of a plant's card.
pub const FOLIAGE_WGSL: &str = include_str!("foliage.wgsl");
/// Light on bodies.
pub const BODY_WGSL: &str = include_str!("body.wgsl");

/// All texts in the order they must be joined.
pub const WGSL: [&str; 12] = [
    COMMON_WGSL,
    SKY_WGSL,
    GRASS_WGSL,
    GROUND_WGSL,
    FOLIAGE_WGSL,
    BODY_WGSL,
    blade::WGSL,
    crown::WGSL,
    environment::WGSL,
    volume::WGSL,
    volume::lit::WGSL,
    water::WGSL,
];
