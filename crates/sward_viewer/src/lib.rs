//! A window in which vegetation reacts: all shipped scenes and your own, vehicles to drive, cameras, and a look inside.
//!
//! One way: input → [`drive`], [`camera`] → [`stage`] (steps, draws) → [`viewer`] (lays out) → [`panels`].

#![forbid(unsafe_code)]

pub mod camera;
pub mod clock;
pub mod drive;
pub mod loading;
pub mod panels;
pub mod source;
pub mod stage;
pub mod status;
pub mod viewer;
