//! What lies around the picture.

pub mod help;
pub mod look;
pub mod parameters;
pub mod plots;
pub mod scenes;
pub mod tools;
