//! Settings of the response that lets whole meshes sway: waves on a plane, driven by the wind.
//!
//! Chen & Johan 2015, §3.3; methods §5.

use super::parameters::{parameters, parameters_with_overrides};

parameters_with_overrides! {
    /// How shrubs, crowns and water plants sway: as one sheet of waves on an upright plane that repeats.
    pub struct Harmonic, HarmonicOverrides {
        /// Cells along a side of the plane, a power of two.
        cells: u32 = 64, "cells" in 16..=512;
        /// Side of the plane; it repeats beyond.
        side: f32 = 8.0, "m" in 1.0..=500.0;
        /// Heading of the plane's right, 0 = +x, towards +z. Without it along the wind.
        heading: Option<f32> = None, "rad" in -7.0..=7.0;
        /// How fast motion spreads over the plane.
        speed: f32 = 1.5, "m/s" in 0.0..=50.0;
        /// How often a plant that is let go swings.
        frequency: f32 = 0.9, "Hz" in 0.05..=10.0;
        /// How soon it comes to rest: 1 does not swing at all.
        damping: f32 = 0.18, "" in 0.0..=2.0;
        /// Velocity of leaves over that of a steady wind.
        gain: f32 = 0.6, "" in 0.0..=10.0;
        /// The same over that of a body that brushes past them; 0: bodies leave them alone.
        touch: f32 = 1.0, "" in 0.0..=10.0;
    }
    extra {}
}
