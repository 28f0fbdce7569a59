//! A window in which vegetation reacts: all shipped scenes and your own, vehicles to drive, cameras, and a look inside.
//!
//! One way: input → [`drive`], [`hand`], [`camera`] → [`stage`] (steps, draws) → [`overlay`], [`probe`], [`timing`] (look inside) → [`viewer`] (lays
//! out) → [`panels`].

#![forbid(unsafe_code)]

pub mod address;
pub mod camera;
pub mod clock;
pub mod compare;
pub mod drive;
#[cfg(any(feature = "gamepad", not(target_os = "linux")))]
pub mod gamepad;
pub mod hand;
pub mod loading;
pub mod marks;
pub mod overlay;
pub mod pace;
#[cfg(target_arch = "wasm32")]
pub mod page;
pub mod painter;
pub mod painting;
pub mod panels;
pub mod presets;
pub mod probe;
#[cfg(not(target_arch = "wasm32"))]
pub mod recording;
pub mod remembered;
pub mod sight;
pub mod source;
pub mod stage;
pub mod status;
pub mod thumbnails;
pub mod timing;
pub mod trails;
pub mod viewer;
