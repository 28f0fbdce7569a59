//! Stands that move blade by blade: virtual blades, and blades that bodies have touched.

#[path = "../common/mod.rs"]
mod common;

mod bodies;
mod field;
mod refused;
