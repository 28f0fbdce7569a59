//! What a response reads of a stand: the compiled half of what an author wrote about it.

use super::continuum::{Coefficients, LagCoefficients};
use crate::placement::PlacementParameters;
use crate::scene::SpeciesModel;

/// A stand, compiled.
#[derive(Clone, Debug)]
pub struct StandModel {
    /// Unique name.
    pub name: String,
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
    /// Where plants stand.
    pub placement: PlacementParameters,
    /// Deviation that counts as rest, rad and rad/s.
    pub tolerance: f32,
}
