//! The scene an author writes: terrain, stands, wind, interactors, camera, light and budget.
//!
//! A scene is a RON file of format version 1. Everything but `version` has a default, so this is a whole scene:
//!
//! ```
//! let text = "(
//!     version: 1,
//!     stands: [(species: Meadow)],
//! )";
//! let scene = sward::scene::Scene::parse(text, "hello.ron")?;
//! assert_eq!(scene.stands[0].label(), "meadow");
//! # Ok::<(), sward::scene::SceneError>(())
//! ```
//!
//! Unknown names and numbers out of range are errors that say where and what to type instead:
//!
//! ```
//! use sward::scene::Scene;
//! let error = Scene::parse("(version: 1, light: (azimut: 1.0))", "dusk.ron").unwrap_err();
//! assert!(error.to_string().starts_with("dusk.ron:1:22: `Light` has no field `azimut`"));
//! assert!(error.help.unwrap().contains("did you mean `azimuth`?"));
//! ```
//!
//! Lengths are metres, times seconds, angles radians; +y is up and ground positions are (x, z).

mod billboard;
mod blade;
mod budget;
mod camera;
mod chain;
mod continuum;
mod detail;
mod edit;
mod environment;
mod error;
mod exclusion;
mod explain;
mod field;
mod fluid;
mod harmonic;
pub mod inspect;
mod interactor;
mod layers;
mod light;
mod locate;
mod oscillator;
mod parameters;
mod path;
mod presets;
mod reference;
mod rules;
mod shape;
mod sheet;
mod springs;
mod stand;
mod terrain;
mod value;
mod wind;

#[cfg(test)]
mod tests;

use ron::extensions::Extensions;
use ron::ser::PrettyConfig;

pub use billboard::{Billboard, BillboardOverrides};
pub use blade::{Blade, BladeOverrides};
pub use budget::{Beyond, Budget, Precision};
pub use camera::{Camera, CameraKey};
pub use chain::{BladeByBlade, Chain, ChainOverrides, DragPower};
pub use continuum::{Continuum, ContinuumOverrides, Lag};
pub use detail::Detail;
pub use edit::{Change, Cut, Edit, Flatten, Raise, Regrow};
pub use environment::{Environment, LightVolume};
pub use error::{Problem, SceneError, Trail};
pub use exclusion::{Area, Disc, Exclusion, Mask, Outline, Rectangle, Road};
pub use field::Field;
pub use fluid::{Fluid, Gust, GustFrom, GustPlace, MAX_FLUIDS, MAX_GUSTS};
pub use harmonic::{Harmonic, HarmonicOverrides};
pub use inspect::Inspector;
pub use interactor::Interactor;
pub use layers::{Follow, Form, Grown, Layers, LayersOverrides, Place, PlantFile, PlantMesh};
pub use light::Light;
pub use oscillator::{Oscillator, OscillatorOverrides, Swinging};
pub use path::{Circle, Driven, Key, Keyframes, Path, Still};
pub use presets::{Layered, SpeciesModel};
pub use reference::{Reference, reference};
pub use shape::{BoxShape, Compound, Ellipsoid, MeshShape, Part, Polygon, Shape, Sphere};
pub use sheet::{Sheet, SheetOverrides};
pub use springs::{Recovery, Springs, SpringsOverrides};
pub use stand::{Representation, Response, Species, Stand};
pub use terrain::{Flat, Image, Terrain};
pub use value::{FieldInfo, Value};
pub use wind::{Flow, FlowImage, Footprint, MAX_FOOTPRINTS, Natural, Uniform, WindSource};

use parameters::parameters;

/// The newest scene format this version reads.
pub const FORMAT_VERSION: u32 = 1;

parameters! {
    /// Everything an author writes.
    pub struct Scene {
        /// Format version of the file: 1.
        version: u32 = FORMAT_VERSION, "" in 1..=1, required;
        /// A name for people.
        title: String = String::new(), "";
        /// Seed of every random choice: where plants stand and how they differ.
        seed: u32 = 1, "";
        /// Patch whose corner the scene is counted from: authored positions stay where they are, but far from (0, 0) they lose no
        /// precision. A scene whose positions and origin move together stays the same, bit for bit.
        origin: [i32; 2] = [0, 0], "patches" in -1000000..=1000000;
        /// Fixed simulation steps per second.
        steps_per_second: u32 = 60, "1/s" in 30..=1000;
        /// How the ground is cut into patches.
        field: Field = Field::default(), "";
        /// The shape of the ground.
        terrain: Terrain = Terrain::Flat(Flat::default()), "";
        /// Bumps added to the ground.
        detail: Option<Detail> = None, "";
        /// Changes of the ground while the scene runs.
        edits: Vec<Edit> = Vec::new(), "";
        /// What grows.
        stands: Vec<Stand> = Vec::new(), "";
        /// Where nothing grows: roads, buildings.
        exclusions: Vec<Exclusion> = Vec::new(), "";
        /// Pictures that say how much grows where; at most 8.
        masks: Vec<Mask> = Vec::new(), "";
        /// The sources whose sum is the wind; none is calm air.
        wind: Vec<WindSource> = Vec::new(), "";
        /// The bodies that push plants.
        interactors: Vec<Interactor> = Vec::new(), "";
        /// Where the picture is taken from.
        camera: Camera = Camera::default(), "";
        /// Sun, sky and air.
        light: Light = Light::default(), "";
        /// Upper limits of work and memory.
        budget: Budget = Budget::default(), "";
    }
}

impl Scene {
    /// Reads and checks a scene. `file` is the name that errors carry.
    ///
    /// # Errors
    /// The first thing wrong, with its place in the text.
    pub fn parse(text: &str, file: &str) -> Result<Self, SceneError> {
        let refuse = |problem| SceneError::from_problem(problem, text, file);
        rules::not_newer(text).map_err(refuse)?;
        let scene = Self::read(text).map_err(|error| SceneError::from_reader(&error, text, file))?;
        scene.problem().map_or(Ok(scene), |problem| Err(refuse(problem)))
    }

    /// Checks a scene built in code as strictly as one that was read. Its errors have no place, but the path of the field.
    ///
    /// # Errors
    /// The first thing wrong.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.problem().map_or(Ok(()), |problem| Err(problem.into()))
    }

    /// The scene as text that [`Scene::parse`] reads back as an equal scene. What equals its default is left out.
    #[must_use]
    pub fn to_ron(&self) -> String {
        let mut text = text_of_with(self, PrettyConfig::new().new_line("\n"));
        text.push('\n');
        text
    }

    /// Reads without the checks that concern more than one number.
    fn read(text: &str) -> Result<Self, ron::error::SpannedError> {
        options().from_str(text)
    }

    /// Checks a body that takes place `place` of the interactors, or the next one, while the scene runs.
    pub(crate) fn check_body(&self, place: usize, body: &Interactor) -> Result<(), SceneError> {
        Ok(rules::body_in(self, place, body)?)
    }

    /// Checks a path for body number `place`.
    pub(crate) fn check_path(&self, place: usize, path: &Path) -> Result<(), SceneError> {
        Ok(rules::path_of(place, path)?)
    }

    /// Checks sources in place of the scene's own.
    pub(crate) fn check_wind(&self, sources: &Vec<WindSource>) -> Result<(), SceneError> {
        Ok(rules::winds_in(sources, &self.interactors)?)
    }

    /// Checks a stand that takes place `place`.
    pub(crate) fn check_stand(&self, place: usize, stand: &Stand) -> Result<(), SceneError> {
        Ok(rules::stand_in(place, stand)?)
    }

    fn problem(&self) -> Option<Problem> {
        self.check(&Trail::default()).and_then(|()| rules::check(self)).err()
    }
}

/// A response as scenes write it, like `Continuum(frequency: 1.2)`: for hosts that tune stands ([`crate::world::World::tune`]).
///
/// # Errors
/// What is wrong with the text.
pub fn response(text: &str) -> Result<Response, SceneError> {
    let response: Response = options().from_str(text).map_err(|error| SceneError::from_reader(&error, text, "response"))?;
    response.check(&Trail::default().key("response"))?;
    Ok(response)
}

/// The dialect of RON that scenes are written in: no `Some(…)`, no doubled brackets.
pub(crate) fn options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_NEWTYPES | Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// A value as it would be written in a scene, on one line.
pub(crate) fn text_of<T: Value>(value: &T) -> String {
    options().to_string(value).unwrap_or_default()
}

/// The same for people, with spaces.
fn line_of<T: Value>(value: &T) -> String {
    text_of_with(value, PrettyConfig::new().compact_structs(true).compact_maps(true))
}

fn text_of_with<T: Value>(value: &T, style: PrettyConfig) -> String {
    // Writing into a string fails only beyond the recursion limit, which no scene type reaches.
    options().to_string_pretty(value, style).unwrap_or_default()
}
