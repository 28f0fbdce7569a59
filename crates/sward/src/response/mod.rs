//! Responses: how plants move.
//!
//! To add one: a folder or file pair `x.rs` + `x.wgsl`, a variant of [`crate::scene::Response`] and an arm where the world steps.

pub mod chain;
pub mod continuum;
pub(crate) mod each;
pub mod harmonic;
pub(crate) mod layout;
pub mod oscillation;
pub mod oscillator;
pub mod springs;
mod stage;
mod stand;

pub use stage::Stage;
pub use stand::StandModel;
