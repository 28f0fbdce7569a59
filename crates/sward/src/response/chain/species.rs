//! A blade from what an author wrote about it.

use super::blade::{Blade, DragLaw};
use crate::scene::{Chain, DragPower, Species};

impl Blade {
    /// A blade `length` m long of `segments` segments, made of what `chain` says, with that first frequency \[Hz\] if one is given.
    pub fn built(chain: &Chain, frequency: Option<f32>, length: f64, segments: u32) -> Self {
        let piece = length / f64::from(segments.max(1));
        let law = match chain.drag_power {
            DragPower::Linear => DragLaw::Linear,
            DragPower::FourThirds => DragLaw::FourThirds,
            DragPower::FiveThirds => DragLaw::FiveThirds,
            DragPower::Square => DragLaw::Square,
        };
        Self {
            segments,
            half_length: 0.5 * piece,
            mass: f64::from(chain.mass) * piece,
            stiffness_root: f64::from(chain.rigidity_root) / piece,
            stiffness_tip: f64::from(chain.rigidity_tip) / piece,
            damping_ratio: f64::from(chain.damping),
            drag: f64::from(chain.drag) * piece,
            law,
            frequency: frequency.map(f64::from),
        }
    }

    /// A typical blade of a species (methods §8).
    pub fn of(species: &Species) -> Self {
        let segments = match species {
            Species::Lawn => 2,
            Species::Meadow => 4,
            Species::Reed => 7,
            Species::Tussock => 3,
            Species::Shrub | Species::Tree | Species::WaterPlant => 4,
        };
        let [low, high] = species.height();
        Self::built(&species.chain(), None, 0.5 * f64::from(low + high), segments)
    }
}
