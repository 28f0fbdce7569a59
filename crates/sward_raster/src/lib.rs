//! The picture of a world with no GPU and no driver: a tiled rasteriser on the CPU.
//!
//! It follows the plan of `sward_wgpu` step by step: the same visible plants, solved once ([`sward::picture::prepare`]); the same
//! shadow map; bodies, plants, ground and sky in the same order, with the same shading functions (the Rust twins in
//! [`sward::shading`]), four samples a pixel at the same places, alpha as coverage, and tone mapping per sample. Differences that
//! remain are roundings, and filters whose precision graphics drivers choose themselves.
//!
//! Memory depends on the picture's size and `budget.visible_plants` and `visible_blades`. No threads are needed: the feature `parallel` only draws tiles at
//! the same time, and the picture does not depend on how many. No clocks, no files, no `unsafe`: it also runs in a browser.
//!
//! ```
//! use sward::{model::NoAssets, scene::Scene, world::World};
//! let scene = Scene::parse("(version: 1, stands: [(species: Lawn, cells: 16)], field: (patch_side: 8, patches: (3, 3)))", "lawn.ron")?;
//! let world = World::new(scene, &NoAssets)?;
//! let picture = sward_raster::Studio::new(&world).draw(&world, [32, 18]);
//! assert_eq!(picture.rgba8.len(), 32 * 18 * 4);
//! # Ok::<(), sward::scene::SceneError>(())
//! ```
#![forbid(unsafe_code)]

mod aov;
mod bins;
mod blades;
mod bodies;
mod clumps;
mod cut;
mod each;
mod ground;
mod growing;
mod layers;
mod leaf_picture;
mod leaves;
mod plants;
mod shadows;
mod sight;
mod sky;
mod studio;
mod surroundings;
mod tile;
mod trace;
mod triangle;

pub use growing::Thinning;
pub use studio::Studio;
