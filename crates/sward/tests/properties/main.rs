//! What must hold for every scene: patches, energy of memory, activation, placement, growth, edits, footprints, callers, far places.

#[path = "../common/mod.rs"]
mod common;

mod activation;
mod callers;
mod combs;
mod downwash;
mod edits;
mod far;
mod finite;
mod flips;
mod fluids;
mod footprints;
mod growth;
mod halved;
mod layers;
mod patches;
mod paths;
mod placement;
mod residents;
mod standing;
mod tiled;
