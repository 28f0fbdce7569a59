//! The shipped species as chains: starting points of methods §8, of single blades; stands damp each other, so the continuum's differ.

use super::blade::{Blade, DragLaw};
use crate::scene::Species;

impl Blade {
    /// A typical blade of a species.
    pub fn of(species: &Species) -> Self {
        // Segments, half their length [m], mass [kg], stiffness at root and tip [N·m/rad], damping ratio, drag [N/(m/s)^p].
        let (segments, half_length, mass, [stiffness_root, stiffness_tip], damping_ratio, drag) = match species {
            Species::Lawn => (2, 0.0125, 1.25e-5, [4.4e-5, 3.1e-5], 0.25, 1.5e-5),
            Species::Meadow => (4, 0.05, 1.12e-4, [6e-3, 3.3e-3], 0.15, 1.6e-4),
            Species::Reed => (7, 0.0857, 4.3e-4, [0.20, 0.099], 0.10, 9e-4),
            Species::Tussock => (3, 0.05, 2e-4, [1.6e-2, 9.6e-3], 0.20, 5e-4),
        };
        let law = DragLaw::FourThirds;
        Self { segments, half_length, mass, stiffness_root, stiffness_tip, damping_ratio, drag, law, frequency: None }
    }
}
