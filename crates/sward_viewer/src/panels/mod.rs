//! What lies around the picture.

pub mod help;
pub mod parameters;
pub mod scenes;
pub mod tools;
