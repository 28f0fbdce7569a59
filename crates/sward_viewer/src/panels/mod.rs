//! What lies around the picture.

pub mod help;
pub mod scenes;
pub mod tools;
