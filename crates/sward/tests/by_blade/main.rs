//! Stands that move blade by blade: virtual blades, and blades that bodies have touched.

#[path = "../common/mod.rs"]
mod common;

#[path = "../figures/glb.rs"]
#[allow(dead_code)] // The other program uses all of it.
mod glb;

mod bodies;
mod field;
mod refused;
