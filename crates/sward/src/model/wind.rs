//! The wind, compiled: sources that are everywhere, those that have a place, and planes of air with where their flows lie among what kernels read.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{Assets, Model, read, tolerance};
use crate::scene::{self, Scene, SceneError, Trail, WindSource};
use crate::state::WindState;
use crate::wind::fluid::{FluidSource, FluidState};
use crate::wind::{Blowing, Flow, Images, Source, Tile, WindField};

/// Numbers of the images that files are, by their paths.
pub type Pictures = BTreeMap<String, u32>;

/// A source of wind that has a place.
#[derive(Clone, Debug)]
pub struct Blower {
    /// What the author wrote.
    pub source: scene::Footprint,
    /// Its place among the sources of the scene.
    pub place: usize,
    /// How the air moves.
    pub flow: Flow,
    /// The interactor it stays with.
    pub follow: Option<usize>,
}

impl WindState {
    /// Those of a scene in which all sources blow from the beginning.
    pub(crate) fn all(scene: &Scene) -> Vec<Self> {
        let mut number = 0;
        let state = |source: &WindSource| {
            let state = Self { number, levels: [1.0; 2], ..Self::default() };
            // Those of places have no gusts to tell apart.
            number += u32::from(!matches!(source, WindSource::Footprint(_)));
            state
        };
        scene.wind.iter().map(state).collect()
    }
}

/// Sources that are there, with their places.
fn there<'a>(scene: &'a Scene, winds: &'a [WindState]) -> impl Iterator<Item = (usize, &'a WindSource, &'a WindState)> {
    scene.wind.iter().zip(winds).enumerate().map(|(place, (source, state))| (place, source, state)).filter(|(.., state)| !state.vacant)
}

/// Sources that are everywhere, as strong as they are after `step` steps.
pub(super) fn sources(scene: &Scene, winds: &[WindState], step: f64) -> Vec<Blowing> {
    let blowing = |(place, source, state): (usize, &WindSource, &WindState)| {
        let source = match source {
            WindSource::Uniform(wind) => Source::Uniform { velocity: wind.velocity },
            WindSource::Natural(wind) => Source::Natural { velocity: wind.velocity, turbulence: wind.turbulence },
            WindSource::Fluid(wind) => Source::Uniform { velocity: wind.velocity },
            WindSource::Footprint(_) => return None,
        };
        Some(Blowing { source, number: state.number, level: state.level(step), place })
    };
    there(scene, winds).filter_map(blowing).collect()
}

/// Reads the picture that a source names, unless it is known.
pub(super) fn paint(
    source: &WindSource,
    place: usize,
    assets: &dyn Assets,
    images: &mut Images,
    pictures: &mut Pictures,
) -> Result<(), SceneError> {
    let WindSource::Footprint(scene::Footprint { flow: scene::Flow::Image(image), .. }) = source else { return Ok(()) };
    if !pictures.contains_key(&image.path) {
        let trail = Trail::default().key("wind").index(place).key("flow").key("path");
        let bytes = read(&image.path, &trail, assets)?;
        let number = images.add_png(&bytes).map_err(|why| SceneError::in_file(&image.path, why).named_by(trail))?;
        pictures.insert(image.path.clone(), number);
    }
    Ok(())
}

/// Sources that have a place; their pictures are known.
pub(super) fn blowers(scene: &Scene, winds: &[WindState], pictures: &Pictures) -> Vec<Blower> {
    let blower = |(place, source, _): (usize, &WindSource, &WindState)| {
        let WindSource::Footprint(source) = source else { return None };
        let flow = match &source.flow {
            scene::Flow::Outward => Flow::Outward,
            scene::Flow::Swirl => Flow::Swirl,
            scene::Flow::Image(image) => Flow::Image(*pictures.get(&image.path)?),
        };
        let follow = source.follow.as_ref().and_then(|name| scene.interactors.iter().position(|body| &body.name == name));
        Some(Blower { source: source.clone(), place, flow, follow })
    };
    there(scene, winds).filter_map(blower).collect()
}

/// The planes of air, their flows behind the noise and the images; those that were there before are not made again.
pub(super) fn fluids(scene: &Scene, winds: &[WindState], images: &Images, before: &[FluidSource]) -> Vec<FluidSource> {
    let mut first = (Tile::shipped().texels().len() + images.texels().len()) as u32;
    let mut found = Vec::new();
    for (place, source, state) in there(scene, winds) {
        let WindSource::Fluid(fluid) = source else { continue };
        let known = before.iter().find(|known| known.number == state.number).cloned();
        let new = || FluidSource::new(fluid, 1.0 / f64::from(scene.steps_per_second), first);
        let mut source = known.unwrap_or_else(new);
        (source.first, source.number, source.place) = (first, state.number, place);
        first += source.texels() as u32;
        found.push(source);
    }
    found
}

/// The wind when all sources blow as they usually do: for what goes by their strength alone.
pub(super) fn usual(sources: &[Blowing], fluids: &[FluidSource]) -> WindField {
    let full: Vec<Blowing> = sources.iter().map(|blowing| Blowing { level: 1.0, ..*blowing }).collect();
    let mut wind = WindField::before(&full, 0, 0.0, 1.0, 1.0);
    wind.fluids = fluids.iter().map(|fluid| fluid.field(&FluidState::still(0), 0, 0.0, 1.0)).collect();
    wind
}

/// Whether the wind changes with time by itself.
pub(super) fn is_gusty(sources: &[Blowing], fluids: &[FluidSource]) -> bool {
    let gusts = |blowing: &Blowing| matches!(blowing.source, Source::Natural { turbulence, .. } if turbulence > 0.0);
    sources.iter().any(gusts) || fluids.iter().any(FluidSource::is_gusty)
}

impl Model {
    /// Reads the picture that a source names, before it blows.
    pub(crate) fn paint_wind(&mut self, source: &WindSource, place: usize, assets: &dyn Assets) -> Result<(), SceneError> {
        paint(source, place, assets, Arc::make_mut(&mut self.images), &mut self.pictures)
    }

    /// Compiles the sources of a scene again, as they are after `step` steps.
    pub(crate) fn blow(&mut self, scene: &Scene, winds: &[WindState], step: u64) {
        self.sources = sources(scene, winds, step as f64);
        self.blowers = blowers(scene, winds, &self.pictures);
        self.fluids = fluids(scene, winds, &self.images, &self.fluids);
        self.gusty = is_gusty(&self.sources, &self.fluids);
        let usual = usual(&self.sources, &self.fluids);
        for stand in &mut self.stands {
            stand.tolerance = tolerance(&stand.species, stand.chain.as_ref(), stand.oscillator.as_ref(), &usual);
            if let Some(oscillator) = stand.oscillator.as_mut().filter(|_| varies(scene, winds)) {
                oscillator.heed_places(stand.patch_side);
            }
        }
        for stand in &mut self.layered {
            stand.harmonic.blow(&self.sources);
        }
        self.revision.wind += 1;
    }
}

/// Whether the wind is not the same everywhere and for ever, or once was not.
pub(super) fn varies(scene: &Scene, winds: &[WindState]) -> bool {
    let changed = winds.iter().any(|state| state.vacant || state.levels != [1.0; 2]);
    changed || scene.wind.iter().any(|source| !matches!(source, WindSource::Uniform(_)))
}
