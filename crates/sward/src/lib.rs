//! Vegetation that reacts: grass bends under bodies, passes the push to its neighbours, leaves a track and recovers.
//!
//! Start at [`world::World`]: a [`scene::Scene`] an author wrote, a [`model::Model`] compiled from it, a [`state::State`] that steps
//! change. This crate has no GPU and no window; `sward_wgpu` runs the same step as compute shaders and draws the picture.
#![forbid(unsafe_code)]

pub mod activation;
pub mod figure;
pub mod fit;
pub mod geometry;
pub mod growth;
pub mod interaction;
pub mod lanes;
pub mod math;
pub mod model;
pub mod picture;
pub mod placement;
pub mod plan;
pub mod response;
pub mod saved;
pub mod scene;
pub mod shading;
pub mod specimen;
pub mod state;
pub mod store;
pub mod terrain;
pub mod view;
pub mod wind;
pub mod world;
