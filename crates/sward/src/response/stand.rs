//! What a response reads of a stand: the compiled half of what an author wrote about it.

use super::chain::ChainModel;
use super::continuum::{self, Coefficients, LagCoefficients};
use super::oscillator::{self, OscillatorModel};
use super::springs::SpringsModel;
use crate::growth::Growth;
use crate::placement::{Growing, PlacementParameters};
use crate::scene::SpeciesModel;
use crate::state::{Ground, PatchKey};
use crate::terrain::Terrain;

/// A stand, compiled.
#[derive(Clone, Debug)]
pub struct StandModel {
    /// Unique name.
    pub name: String,
    /// Number in the scene.
    pub index: usize,
    /// Species with the stand's own overrides.
    pub species: SpeciesModel,
    /// Cells per patch side.
    pub cells: u32,
    /// Patch side, m.
    pub patch_side: f64,
    /// Cell side Δx, m.
    pub spacing: f64,
    /// Kernel numbers.
    pub coefficients: Coefficients,
    /// Substeps of the wave per step.
    pub substeps: u32,
    /// Kernel numbers of the upper segments.
    pub lag: LagCoefficients,
    /// ⅓ of the mass of a plant over its height, kg/m: times its height³ it is its moment of inertia about the root.
    pub inertia: f32,
    /// Where plants stand.
    pub placement: PlacementParameters,
    /// Where it grows less, or not at all.
    pub growth: Growth,
    /// Deviation that counts as rest, rad and rad/s.
    pub tolerance: f32,
    /// What moves it where it moves blade by blade.
    pub chain: Option<ChainModel>,
    /// What moves it where every plant swings by itself.
    pub oscillator: Option<OscillatorModel>,
    /// What deforms its billboards.
    pub springs: Option<SpringsModel>,
}

impl StandModel {
    /// The growth map of a patch: see [`Growth::map`].
    pub fn growth_map(&self, terrain: &Terrain, patch: PatchKey) -> Option<Box<[Growing]>> {
        self.growth.map(&self.placement, terrain, patch, self.patch_side)
    }

    /// Moment of inertia about its root of what stands in a cell on average \[kg·m²\].
    pub fn cell_inertia(&self) -> f32 {
        let height = self.coefficients.plant_height;
        self.placement.cover * self.inertia * height * height * height
    }

    /// Whether wind moves it at all.
    pub fn feels_wind(&self) -> bool {
        match (&self.chain, &self.oscillator) {
            // Its wind asks for no state.
            _ if self.springs.is_some() => false,
            (Some(chain), _) => chain.coefficients.drag > 0.0,
            (_, Some(oscillator)) => oscillator.coefficients.wind > 0.0,
            _ => self.species.continuum.wind > 0.0,
        }
    }

    /// The ground under the cells of a patch, as its response needs it.
    pub fn ground_of(&self, terrain: &Terrain, patch: PatchKey) -> Ground {
        if self.oscillator.is_some() { oscillator::ground_of(terrain, self, patch) } else { continuum::ground_of(terrain, self, patch) }
    }

    /// Steps after the last touch of bodies for which a patch stays awake, where plants settle by themselves.
    pub fn settle(&self) -> Option<u32> {
        let swings = self.oscillator.as_ref().map(|oscillator| oscillator.coefficients.settle);
        swings.or_else(|| self.springs.as_ref().map(|springs| springs.settle))
    }

    /// Height that no plant exceeds, m, where they count one by one; else their mean height.
    pub fn reach(&self) -> f64 {
        if self.oscillator.is_some() { f64::from(self.species.height[1]) } else { f64::from(self.coefficients.plant_height) }
    }

    /// Whether the ground under its cells is stored.
    pub fn stores_ground(&self, terrain: &Terrain) -> bool {
        match (&self.chain, &self.oscillator) {
            (Some(_), _) => false,
            _ if self.springs.is_some() => false,
            (_, Some(_)) => !terrain.is_flat(),
            _ => !self.is_level(terrain),
        }
    }

    /// All patches have the same level ground, with plants in every cell: then none is stored.
    pub fn is_level(&self, terrain: &Terrain) -> bool {
        terrain.is_flat() && self.growth.is_free()
    }
}
