//! A stand of plants that are meshes: where they stand, and the plane whose waves move them.
//!
//! Chen & Johan 2015, §3.3; methods §5. Differs from the paper: the plane stands in the ground along the wind, not where the viewer first looked from;
//! gusts over the ground are turned up into it.

use std::sync::Arc;

use super::history::Ring;
use super::plane::HarmonicCoefficients;
use super::touch::TOUCH_SIDE;
use super::view::Axes;
use crate::growth::Growth;
use crate::math::{clamped, lower, upper};
use crate::placement::PlacementParameters;
use crate::plan::Brush;
use crate::scene::{Harmonic, Layered, Layers, Place};
use crate::specimen::Specimen;
use crate::state::LayeredPlant;
use crate::wind::fluid::{FluidSource, FluidState};
use crate::wind::{Blowing, Source, WindField};

/// The compiled half of the response.
#[derive(Clone, Debug)]
pub struct HarmonicModel {
    /// Cells along a side of the plane.
    pub cells: u32,
    /// Side of a cell, m.
    pub cell: f32,
    /// The plane's axes.
    pub axes: Axes,
    /// Kernel numbers of the plane.
    pub coefficients: HarmonicCoefficients,
    /// Side of a cell of a touched plant's own plane, m.
    pub touch_cell: f32,
    /// Kernel numbers of that.
    pub touch_coefficients: HarmonicCoefficients,
    /// Velocity of leaves over that of a body that brushes past; 0: none does.
    pub touch: f32,
    /// Step, s.
    pub dt: f32,
    /// Which notes of the past hold what.
    pub ring: Ring,
    /// Speed of waves, m/s.
    pub speed: f32,
    /// Steps after which a touched plant has come to rest.
    pub settle: u32,
    /// Depth of the deepest plant, m.
    pub deep: f32,
    /// Wind sources along the plane.
    sources: Vec<Blowing>,
    /// Mean wind along it, m/s.
    mean: f32,
}

impl HarmonicModel {
    /// Of a stand whose largest plant is `size` \[m\] wide and high, in the wind of `sources`.
    pub fn new(harmonic: &Harmonic, size: [f32; 2], sources: &[Blowing], dt: f64) -> Self {
        let wind = WindField::before(sources, 0, 0.0, dt, 1.0).mean;
        let calm = wind == [0.0; 2];
        let heading = harmonic.heading.unwrap_or(if calm { 0.0 } else { crate::math::atan2(wind[1], wind[0]) });
        let (sine, cosine) = crate::math::sin_cos(heading);
        let axes = Axes { right: [cosine, 0.0, sine], up: [0.0, 1.0, 0.0], forward: [sine, 0.0, -cosine] };
        let cell = harmonic.side / harmonic.cells as f32;
        let kernel =
            |cell: f32| HarmonicCoefficients::new(harmonic.speed, harmonic.frequency, harmonic.damping, harmonic.gain, cell, dt as f32);
        let touch_cell = upper(upper(size[0], size[1]), 0.05) / TOUCH_SIDE as f32;
        // Down to a thousandth; whatever is left then is cut off.
        let rate = std::f32::consts::TAU * harmonic.frequency * clamped(harmonic.damping, 0.02, 1.0);
        let mut model = Self {
            cells: harmonic.cells,
            cell,
            axes,
            coefficients: kernel(cell),
            touch_cell,
            touch_coefficients: kernel(touch_cell).under(Brush::hold(dt as f32)),
            touch: harmonic.touch,
            dt: dt as f32,
            ring: Ring::new(dt),
            speed: harmonic.speed,
            settle: lower(7.0 / rate / dt as f32, 1e6) as u32 + 1,
            deep: size[0],
            sources: Vec::new(),
            mean: 0.0,
        };
        model.blow(sources);
        model
    }

    /// Other sources blow; the plane stands as it did.
    pub(crate) fn blow(&mut self, sources: &[Blowing]) {
        let turned = |blowing: &Blowing| {
            let source = match blowing.source {
                Source::Uniform { velocity } => Source::Uniform { velocity: [self.along(velocity), 0.0] },
                Source::Natural { velocity, turbulence } => {
                    // Gusts keep their strength however the plane stands to the wind, and run along it.
                    let speed = (velocity[0] * velocity[0] + velocity[1] * velocity[1]).sqrt();
                    Source::Natural { velocity: [if self.along(velocity) < 0.0 { -speed } else { speed }, 0.0], turbulence }
                }
            };
            Blowing { source, ..*blowing }
        };
        self.sources = sources.iter().map(turned).collect();
        self.mean = self.along(WindField::before(sources, 0, 0.0, 1.0, 1.0).mean);
    }

    /// The wind on the nodes of the plane, its middle of a cell each, `step` steps after the start: x along the plane's right, z up. It repeats with the
    /// plane.
    pub fn wind<'a>(&self, step: u64, dt: f64, fluids: impl Iterator<Item = (&'a FluidSource, &'a FluidState)>) -> WindField {
        let mut field = WindField::before(&self.sources, step, 0.0, dt, f64::from(self.cell));
        field.fluids = fluids.map(|(fluid, flow)| fluid.field_on(flow, step, f64::from(self.cell), self.mean)).collect();
        WindField { mean: [self.mean, 0.0], ..field.snapped(self.cells) }
    }

    /// A ground velocity \[m/s, x and z\] along the plane's right.
    pub fn along(&self, velocity: [f32; 2]) -> f32 {
        velocity[0] * self.axes.right[0] + velocity[1] * self.axes.right[2]
    }

    /// The same through the plane.
    pub fn through(&self, velocity: [f32; 2]) -> f32 {
        velocity[0] * self.axes.forward[0] + velocity[1] * self.axes.forward[2]
    }
}

/// A stand of meshes, compiled.
#[derive(Clone, Debug)]
pub struct LayeredStand {
    /// Unique name.
    pub name: String,
    /// Number in the scene.
    pub index: usize,
    /// How its plants sway and look, as written.
    pub layered: Layered,
    /// What moves them.
    pub harmonic: HarmonicModel,
    /// Their mesh.
    pub specimen: Arc<Specimen>,
    /// Plants with places of their own; none: they grow as `placement` says.
    pub places: Vec<Place>,
    /// Mass of the leaves of a plant over its height³, kg/m³.
    pub leaves: f32,
    /// Where plants stand.
    pub placement: PlacementParameters,
    /// Where they grow less, or not at all.
    pub growth: Growth,
    /// Patch side, m.
    pub patch_side: f64,
}

impl LayeredStand {
    /// Width and height of its largest plant, m.
    pub(crate) fn size(&self) -> [f32; 2] {
        largest(&self.specimen, &self.places, self.placement.height[1])
    }

    /// Mass of the leaves in a cell of the own plane of a plant \[kg\]: they fill an ellipse as wide and high as it is.
    pub fn cell_mass(&self, plant: &LayeredPlant) -> f32 {
        let scale = plant.height / upper(self.specimen.high[1], 1e-3);
        let wide = upper(self.specimen.high[0] - self.specimen.low[0], self.specimen.high[2] - self.specimen.low[2]) * scale;
        let cells = std::f32::consts::FRAC_PI_4 * wide * plant.height / (self.harmonic.touch_cell * self.harmonic.touch_cell);
        self.leaves * plant.height * plant.height * plant.height / upper(cells, 1.0)
    }

    /// How plants are drawn.
    pub fn layers(&self) -> &Layers {
        &self.layered.layers
    }
}

/// Width and height \[m\] of the largest plant of a specimen: of those with places of their own, and of those up to `tallest` \[m\].
pub(crate) fn largest(specimen: &Specimen, places: &[Place], tallest: f32) -> [f32; 2] {
    let tallest = places.iter().filter_map(|place| place.height).fold(tallest, upper);
    let scale = tallest / specimen.high[1].max(1e-3);
    let wide = (0..3).step_by(2).map(|axis| specimen.high[axis] - specimen.low[axis]).fold(0.0, upper);
    [wide * scale, tallest]
}
