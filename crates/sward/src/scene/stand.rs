//! Stands: plants of one species that share one response and one representation.

use super::billboard::BillboardOverrides;
use super::blade::BladeOverrides;
use super::chain::ChainOverrides;
use super::continuum::ContinuumOverrides;
use super::harmonic::HarmonicOverrides;
use super::layers::{LayersOverrides, Place};
use super::oscillator::OscillatorOverrides;
use super::parameters::{choices, parameters};
use super::sheet::SheetOverrides;
use super::springs::SpringsOverrides;

choices! {
    /// A kind of plant. It gives the defaults of height, response and representation.
    pub enum Species {
        /// Mown turf, 5 cm: creeps back slowly without swaying.
        Lawn,
        /// Meadow grass, 40 cm: sways and recovers in a few seconds.
        Meadow,
        /// Reed, 120 cm: tall, slow, with a whipping tip.
        Reed,
        /// Tussock grass, 30 cm: stiff and quick.
        Tussock,
        /// A leafy shrub, 1.4 m: a mesh that sways in layers.
        Shrub,
        /// A tree, 7 m: its crown sways in layers, its trunk stands.
        Tree,
        /// A water plant, 50 cm: sways slowly from root to tip.
        WaterPlant,
    }
}

choices! {
    /// How plants move.
    pub enum Response {
        /// Bending spreads through the stand as a wave.
        Continuum(ContinuumOverrides),
        /// Every plant swings by itself, pushed aside by bodies: exact at any frame rate, and free of cost until touched.
        Oscillator(OscillatorOverrides),
        /// Billboards are sheets that any body pushes out of its way, in its true shape; they keep their lengths, and recover.
        Springs(SpringsOverrides),
        /// Every blade near the camera or a body is a chain of segments on springs, with a state of its own.
        Chain(ChainOverrides),
        /// As `Chain`, but only blades that a body has touched have a state; virtual blades feel the wind for all others.
        VirtualInertia(ChainOverrides),
        /// Meshes sway with waves that the wind raises on a plane. Goes with the representation `Layers`.
        Harmonic(HarmonicOverrides),
    }
}

choices! {
    /// How a plant becomes triangles.
    pub enum Representation {
        /// Crossed cards with a picture of a clump.
        Billboard(BillboardOverrides),
        /// Blades: strips of triangles, every one by itself.
        Blade(BladeOverrides),
        /// One card with a picture of a clump, bent as a smooth surface.
        Sheet(SheetOverrides),
        /// A mesh of leaves and wood, cut into layers by their distance from the eye. Goes with the response `Harmonic`.
        Layers(LayersOverrides),
    }
}

parameters! {
    /// Plants of one species over the whole field.
    pub struct Stand {
        /// The kind of plant.
        species: Species = Species::Meadow, "", required;
        /// A name, unique in the scene. Without it the species in lower case.
        name: String = String::new(), "";
        /// Cells along a patch side, a multiple of 8; each cell can carry one plant. The cell size is patch_side / cells. Without it 128; of shrubs and
        /// trees 8.
        cells: Option<u32> = None, "cells" in 8..=256;
        /// Where single plants stand, of shrubs, trees and water plants; then none grow elsewhere.
        places: Vec<Place> = Vec::new(), "";
        /// Share of the cells that carry a plant.
        cover: f32 = 1.0, "" in 0.0..=1.0;
        /// How much height and cover differ from clump to clump.
        clumping: f32 = 0.35, "" in 0.0..=1.0;
        /// Width of a clump.
        clump_size: f32 = 5.0, "m" in 0.5..=100.0;
        /// Tilt along x and z of plants that nothing moves: how wind, a slope or a mower has combed them. Pictures of a mask's `direction` hold instead
        /// where they lie.
        lean: [f32; 2] = [0.0, 0.0], "rad" in -0.8..=0.8;
        /// How far each plant leans some way of its own: 1 is up to 0.6 rad.
        messiness: f32 = 0.0, "" in 0.0..=1.0;
        /// Least and greatest plant height. Without it the species' own.
        height: Option<[f32; 2]> = None, "m" in 0.01..=50.0;
        /// Mass of a plant of mean height, by which it pushes back at bodies. Without it the species' own. Blades that move one by one have masses of their own.
        mass: Option<f32> = None, "g" in 0.001..=1e6;
        /// Least and greatest steepness of the ground on which it grows, rise over run: 1 is 45 degrees. Without it anywhere.
        slope: Option<[f32; 2]> = None, "" in 0.0..=100.0;
        /// How the plants move, where it differs from the species.
        response: Option<Response> = None, "";
        /// How the plants look, where it differs from the species. With response `Springs` they are sheets unless this says otherwise.
        representation: Option<Representation> = None, "";
    }
}

impl Response {
    /// As it is written in a scene, on one line.
    #[must_use]
    pub fn to_ron(&self) -> String {
        super::line_of(self)
    }
}

impl Stand {
    /// Cells along a patch side.
    #[must_use]
    pub fn cells(&self) -> u32 {
        self.cells.unwrap_or(if self.is_layered() { 8 } else { 128 })
    }

    /// The stand's name, or its species in lower case.
    #[must_use]
    pub fn label(&self) -> String {
        match self.name.as_str() {
            "" => format!("{:?}", self.species).to_lowercase(),
            name => name.to_owned(),
        }
    }
}
