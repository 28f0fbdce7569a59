//! A stand that moves blade by blade, compiled.

use super::blade::{Blade, ChainCoefficients, calibrate};
use super::error::ChainError;
use super::steady::Steady;
use crate::scene::SpeciesModel;

/// How the blades of a plant stand by themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stances {
    /// Blades of a plant; 1 where plants are drawn as billboards, and then it stands upright.
    pub blades: u32,
    /// Most lean at the root, rad.
    pub lean: f32,
    /// Most curl, rad.
    pub curl: f32,
    /// Shortest blade, as a share of its plant.
    pub shortest: f32,
    /// How near to the plant's root they stand, 0 to 1.
    pub tuft: f32,
    /// Most turn about the vertical, rad.
    pub turn: f32,
}

/// What moves the blades of a stand.
#[derive(Clone, Debug)]
pub struct ChainModel {
    /// Kernel numbers.
    pub coefficients: ChainCoefficients,
    /// How a blade stands in steady wind.
    pub steady: Steady,
    /// Virtual blades along a patch side, a multiple of 8.
    pub virtual_side: u32,
    /// All blades near a focus have a state, not only those that bodies touch.
    pub all: bool,
    /// How blades stand.
    pub stances: Stances,
}

/// Most virtual blades along a patch side.
const MOST_VIRTUAL: u32 = 256;

impl ChainModel {
    /// Of a species; `None` if it does not move blade by blade.
    ///
    /// # Errors
    /// A blade that cannot stand, or numbers out of range.
    pub fn of(species: &SpeciesModel, patch_side: f64) -> Option<Result<Self, ChainError>> {
        let by_blade = species.chain.as_ref()?;
        let length = 0.5 * f64::from(species.height[0] + species.height[1]);
        let blade = Blade::built(&by_blade.chain, by_blade.frequency, length, species.segments());
        let upright = Stances { blades: 1, lean: 0.0, curl: 0.0, shortest: 1.0, tuft: 1.0, turn: 0.0 };
        let stances = species.blade.as_ref().map_or(upright, |blade| Stances {
            blades: blade.blades,
            lean: blade.lean,
            curl: blade.curl,
            shortest: blade.shortest,
            tuft: blade.tuft,
            turn: std::f32::consts::TAU,
        });
        let wanted = (patch_side / f64::from(by_blade.chain.virtual_spacing)).ceil() as u32;
        Some(calibrate(&blade).map(|coefficients| Self {
            steady: Steady::of(&coefficients),
            coefficients,
            virtual_side: wanted.next_multiple_of(8).min(MOST_VIRTUAL),
            all: by_blade.all,
            stances,
        }))
    }

    /// Numbers of a blade with a state: of each joint ψ and ω, and ψ a step before; its hold, and that a step before.
    pub fn planes(&self) -> usize {
        6 * self.coefficients.segments as usize + 2
    }

    /// Blades of a patch of `cells` cells a side.
    pub fn blades_of_patch(&self, cells: u32) -> u32 {
        self.stances.blades * cells * cells
    }
}
