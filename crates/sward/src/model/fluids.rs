//! Air that flows, compiled: the scene's fluids, and where their flows lie among what kernels read.

use crate::scene::{Scene, WindSource};
use crate::wind::fluid::{FluidSource, FluidState};
use crate::wind::{Source, WindField};

/// The planes of air of a scene, their flows behind `first` texels.
pub(super) fn of(scene: &Scene, mut first: u32) -> Vec<FluidSource> {
    let mut found = Vec::new();
    for source in &scene.wind {
        if let WindSource::Fluid(fluid) = source {
            let source = FluidSource::new(fluid, 1.0 / f64::from(scene.steps_per_second), first);
            first += source.texels() as u32;
            found.push(source);
        }
    }
    found
}

/// The wind of a scene when all sources blow as they usually do: for what goes by their strength alone.
pub(super) fn usual_wind(sources: &[Source], fluids: &[FluidSource]) -> WindField {
    let mut wind = WindField::at(sources, 0, 1.0, 1.0);
    wind.fluids = fluids.iter().map(|fluid| fluid.field(&FluidState::still(0), 0, 0.0, 1.0)).collect();
    wind
}
