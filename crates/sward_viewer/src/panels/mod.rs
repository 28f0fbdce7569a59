//! What lies around the picture.

pub mod help;
pub mod look;
pub mod painting;
pub mod parameters;
pub mod plots;
pub mod presets;
pub mod scenes;
pub mod tools;
