//! Responses against what their papers and the algebra say. Every comparison has a control that fails.

#[path = "../common/mod.rs"]
mod common;

mod chain;
mod direct;
mod dispersion;
mod energy;
mod held;
mod lags;
mod limits;
mod mirror;
mod rescale;
mod wind;
