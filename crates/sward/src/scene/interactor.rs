//! Interactors: moving bodies that push plants.

use super::parameters::parameters;
use super::path::{Path, Still};
use super::shape::{Shape, Sphere};

parameters! {
    /// A moving body that pushes plants.
    pub struct Interactor {
        /// A name, unique in the scene, for the camera to follow.
        name: String = String::new(), "";
        /// The body.
        shape: Shape = Shape::Sphere(Sphere::default()), "", required;
        /// Height of the body's lowest point above the ground; negative is sunk in.
        clearance: f32 = 0.0, "m" in -2.0..=1000.0;
        /// Where the body goes.
        path: Path = Path::Still(Still::default()), "";
        /// Time at which the body appears.
        from: f64 = 0.0, "s" in 0.0..=1000000000.0;
        /// Time at which the body disappears.
        until: f64 = 1e9, "s" in 0.0..=1000000000.0;
        /// Colour of its painted parts, linear RGB; without one, the next of six.
        colour: Option<[f32; 3]> = None, "" in 0.0..=1.0;
        /// Whether the body pitches and rolls with the terrain.
        follow_ground: bool = true, "";
    }
}
