//! sward on the GPU.

#![forbid(unsafe_code)]

pub mod compare;
pub mod compute;
pub mod gpu;
mod past;
pub mod picture;
pub mod render;
pub mod stopwatch;
pub mod studio;
