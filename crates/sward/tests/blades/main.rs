//! Blades: lengths, ground, thinning, budget.

#[path = "../common/mod.rs"]
mod common;

mod solved;
mod standing;
mod strips;
mod thinning;
