//! How plants and bodies become triangles.

pub mod mesh;
pub mod truck;
mod wheel;
