//! sward on the GPU.

#![forbid(unsafe_code)]

pub mod gpu;
pub mod picture;
pub mod render;
