//! From state to shape: how plants and bodies become triangles.
//!
//! To add a representation: a file pair `x.rs` + `x.wgsl`, a variant of [`crate::scene::Representation`] and an arm in the renderer.

pub mod billboard;
pub mod blade;
pub mod card;
pub mod figure;
pub mod layers;
pub mod mesh;
pub mod relief;
pub mod rings;
pub mod sheet;
pub mod truck;
pub mod warp;
mod wheel;
