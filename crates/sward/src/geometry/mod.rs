//! From state to shape: how a plant becomes joints and triangles.
//!
//! To add a representation: a file pair `x.rs` + `x.wgsl`, a variant of [`crate::scene::Representation`] and an arm in the renderer.

pub mod billboard;
