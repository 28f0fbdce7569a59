//! Stands that get other numbers for the response they have, while a world runs.

use super::wind::usual;
use super::{Around, Model, stand_model};
use crate::response::StandModel;
use crate::response::chain;
use crate::response::harmonic::HarmonicModel;
use crate::response::oscillator::OscillatorModel;
use crate::scene::{ChainOverrides, OscillatorOverrides, Response, Scene, SceneError, SpeciesModel, Trail};

/// A stand with other numbers, not yet in its place.
pub(crate) enum Tuned {
    /// Of grass: its place among those, and what it becomes.
    Grass(usize, Box<StandModel>),
    /// Of meshes, likewise.
    Meshes(usize, Box<HarmonicModel>),
}

/// The response of a species with all of it said, in the terms in which two of them can be mixed: frequency and damping ratio.
pub(crate) fn said(species: &SpeciesModel) -> Response {
    if let Some(layered) = &species.layered {
        return Response::Harmonic(layered.harmonic.said());
    }
    if let Some(springs) = &species.springs {
        return Response::Springs(springs.said());
    }
    if let Some(given) = &species.oscillator {
        let mean = 0.5 * (species.height[0] + species.height[1]);
        // What cannot stand is refused elsewhere.
        let model = OscillatorModel::of(species, 1.0, 1.0, false).and_then(Result::ok);
        let frequency = model.as_ref().map_or(given.oscillator.frequency, |model| model.frequency as f32);
        let damping = model.as_ref().map_or(given.oscillator.damping, |model| model.damping_ratio as f32);
        return Response::Oscillator(OscillatorOverrides {
            frequency: Some(frequency),
            damping: Some(damping),
            length: Some(given.length.unwrap_or(mean)),
            ..given.oscillator.said()
        });
    }
    if let Some(given) = &species.chain {
        let length = 0.5 * f64::from(species.height[0] + species.height[1]);
        let blade = chain::Blade::built(&given.chain, given.frequency, length, species.segments());
        let overrides = ChainOverrides { frequency: chain::first_frequency(&blade).map(|hertz| hertz as f32), ..given.chain.said() };
        return if given.all { Response::Chain(overrides) } else { Response::VirtualInertia(overrides) };
    }
    Response::Continuum(species.continuum.said())
}

impl Model {
    /// Stand number `index` of a scene with the numbers of a species, if its state fits them.
    pub(crate) fn tuned(&self, scene: &Scene, index: usize, species: SpeciesModel) -> Result<Tuned, SceneError> {
        let unfit = || {
            let message = "its state would be stored in another way, or its plants would stand elsewhere";
            let trail = Trail::default().key("stands").index(index).key("response");
            SceneError::in_file("", message.to_owned()).named_by(trail).advise("change the scene instead: that begins the stand anew")
        };
        if let Some(place) = self.stands.iter().position(|stand| stand.index == index) {
            let known = &self.stands[place];
            let varies = known.oscillator.as_ref().is_some_and(|oscillator| oscillator.coefficients.texels > 0);
            let around = Around { scene, usual: &usual(&self.sources, &self.fluids), varies };
            let mut next = stand_model(&around, index, species, known.growth.clone())?;
            let stances = |stand: &StandModel| stand.chain.as_ref().map(|chain| (chain.stances, chain.virtual_side));
            let maps = |stand: &StandModel| stand.springs.as_ref().map(|springs| springs.texels);
            let alike = next.layout() == known.layout() && next.placement == known.placement;
            if !alike || stances(&next) != stances(known) || maps(&next) != maps(known) {
                return Err(unfit());
            }
            if let (Some(next), Some(known)) = (&mut next.oscillator, &known.oscillator) {
                // Planned again, a step still begins from what the one before left.
                next.former = known.former.or(Some(known.coefficients));
                next.aired |= known.aired;
            }
            return Ok(Tuned::Grass(place, Box::new(next)));
        }
        let Some(place) = self.layered.iter().position(|stand| stand.index == index) else { return Err(unfit()) };
        let (known, Some(layered)) = (&self.layered[place], species.layered) else { return Err(unfit()) };
        let mut next = HarmonicModel::new(&layered.harmonic, known.size(), &self.sources, self.dt);
        let heading = layered.harmonic.heading == known.layered.harmonic.heading;
        let alike = heading && next.cells == known.harmonic.cells && next.ring == known.harmonic.ring;
        next.axes = known.harmonic.axes;
        next.blow(&self.sources);
        if alike { Ok(Tuned::Meshes(place, Box::new(next))) } else { Err(unfit()) }
    }

    /// Puts a stand in its place. Returns its place if its plants swing by themselves.
    pub(crate) fn put(&mut self, tuned: Tuned) -> Option<usize> {
        self.revision.stands += 1;
        match tuned {
            Tuned::Grass(place, stand) => {
                self.stands[place] = *stand;
                self.stands[place].oscillator.is_some().then_some(place)
            }
            Tuned::Meshes(place, harmonic) => {
                self.layered[place].harmonic = *harmonic;
                None
            }
        }
    }
}
