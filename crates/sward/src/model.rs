//! The compiled scene: everything a step reads and never changes, but for the ground where it is edited.

mod bodies;

mod limits;
mod maps;
mod specimens;
pub(crate) mod tuning;
mod wind;

use std::path::Path;
use std::sync::Arc;

pub use bodies::{BodyModel, Wardrobe};
use limits::{Named, NamedComb};
pub use maps::BodyMaps;
use specimens::Specimens;
pub use wind::{Blower, Pictures};

use crate::growth::{Growth, Limit, Tended};
use crate::placement::PlacementParameters;
pub use crate::response::StandModel;
use crate::response::chain::ChainModel;
use crate::response::continuum::{Coefficients, LagCoefficients};
use crate::response::harmonic::{HarmonicModel, LayeredStand, largest};
use crate::response::oscillator::OscillatorModel;
use crate::response::springs::SpringsModel;
use crate::scene::{Area, GustFrom, Path as ScenePath, Scene, SceneError, SpeciesModel, Terrain as SceneTerrain, Trail, WindSource};
use crate::shading::environment::Environment;
use crate::state::{Root, WindState};
use crate::store::{NoStore, Store};
use crate::terrain::{Detail, Terrain, TerrainError, is_tiff};
use crate::wind::fluid::FluidSource;
use crate::wind::{Blowing, Images, Tile, WindField};

/// Where a scene's files (terrain, bodies) come from.
pub trait Assets {
    /// The bytes of the file a scene names, or why it cannot be read.
    fn read(&self, path: &str) -> Result<Vec<u8>, String>;

    /// Where what takes long to make is kept.
    fn store(&self) -> &dyn Store {
        &NoStore
    }

    /// Hears how far what takes long has come, 0 to 1; `what` is it, in words like "growing plants".
    fn progress(&self, what: &'static str, share: f32) {
        let _ = (what, share);
    }

    /// Hears of trouble that changes nothing.
    fn note(&self, trouble: &str) {
        let _ = trouble;
    }
}

/// Largest file a scene may name, bytes.
const LARGEST_FILE: u64 = 512 << 20;

/// The bytes of a file that the value at `trail` names.
fn read(path: &str, trail: &Trail, assets: &dyn Assets) -> Result<Vec<u8>, SceneError> {
    let help = "type a path from the scene's folder, or from the folder above it, to a file of at most 512 MB";
    let refuse = |why| SceneError::in_file(path, format!("cannot be read: {why}")).named_by(trail.clone()).advise(help);
    assets.read(path).map_err(refuse)
}

/// Files below a folder.
#[derive(Clone, Debug)]
pub struct Folder(pub std::path::PathBuf);

impl Assets for Folder {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        let full = self.0.join(Path::new(path));
        let about = std::fs::metadata(&full).map_err(|error| format!("{}: {error}", full.display()))?;
        if !about.is_file() {
            return Err(format!("{} is not a file", full.display()));
        }
        if about.len() > LARGEST_FILE {
            return Err(format!("{}: {} MB, at most {} MB are read", full.display(), about.len() >> 20, LARGEST_FILE >> 20));
        }
        std::fs::read(&full).map_err(|error| format!("{}: {error}", full.display()))
    }
}

/// No files: for scenes on flat ground.
#[derive(Clone, Copy, Debug)]
pub struct NoAssets;

impl Assets for NoAssets {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        Err(format!("{path}: this scene was opened without a folder to read from"))
    }
}

/// Counts changes of a model while its world runs: whoever keeps something made from it looks whether that is still so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Revision {
    /// Of the bodies, but for where they are.
    pub bodies: u64,
    /// Of the sources of wind.
    pub wind: u64,
    /// Of how stands move.
    pub stands: u64,
}

/// The compiled scene.
#[derive(Clone, Debug)]
pub struct Model {
    /// Step, s.
    pub dt: f64,
    /// Steps per second.
    pub rate: u32,
    /// Patch side, m.
    pub patch_side: f64,
    /// First patch and one past the last, or `None` for an endless field.
    pub field: Option<[[i32; 2]; 2]>,
    /// Ground.
    pub terrain: Terrain,
    /// Stands of grass in the scene's order.
    pub stands: Vec<StandModel>,
    /// Stands of meshes in the scene's order.
    pub layered: Vec<LayeredStand>,
    /// What limits growth: exclusions, then masks.
    pub limits: Vec<Arc<Limit>>,
    /// Wind that is everywhere.
    pub sources: Vec<Blowing>,
    /// Wind of places.
    pub blowers: Vec<Blower>,
    /// Their images.
    pub images: Arc<Images>,
    /// Where those of files are among them.
    pub pictures: Pictures,
    /// Air that flows.
    pub fluids: Vec<FluidSource>,
    /// The wind changes with time.
    pub gusty: bool,
    /// Bodies in the scene's order.
    pub bodies: Vec<BodyModel>,
    /// What makes further ones.
    pub wardrobe: Wardrobe,
    /// What they look like from six sides.
    pub maps: BodyMaps,
    /// What has changed of all this since it was compiled.
    pub revision: Revision,
    /// The picture of the surroundings, where there is one.
    pub environment: Option<Arc<Environment>>,
}

/// Those of a list that hold for a stand.
fn named<T>(list: &[(Arc<T>, Vec<String>)], stand: &String) -> Vec<Arc<T>> {
    list.iter().filter(|(_, names)| names.is_empty() || names.contains(stand)).map(|(one, _)| Arc::clone(one)).collect()
}

/// What stands are compiled from, besides what is said of each.
struct Around<'a> {
    scene: &'a Scene,
    /// The wind as it usually blows.
    usual: &'a WindField,
    /// Whether it is not the same everywhere and for ever.
    varies: bool,
}

fn stand_models(around: &Around<'_>, limits: &[Named], combs: &[NamedComb]) -> Result<Vec<StandModel>, SceneError> {
    let mut stands = Vec::new();
    for (index, stand) in around.scene.stands.iter().enumerate().filter(|(_, stand)| !stand.is_layered()) {
        let species = stand.resolve()?;
        let (limits, combs) = (named(limits, &species.name), named(combs, &species.name));
        let growth = Growth { limits, slopes: stand.slope, combs, tended: Tended::default() };
        stands.push(stand_model(around, index, species, growth)?);
    }
    Ok(stands)
}

/// Stand number `index` of a scene, as a species.
fn stand_model(around: &Around<'_>, index: usize, species: SpeciesModel, growth: Growth) -> Result<StandModel, SceneError> {
    let scene = around.scene;
    let dt = 1.0 / f64::from(scene.steps_per_second);
    let patch_side = f64::from(scene.field.patch_side);
    let spacing = patch_side / f64::from(species.cells);
    let chain = chain_model(scene, index, &species, patch_side)?;
    let oscillator = OscillatorModel::of(&species, dt, patch_side, around.varies).transpose().map_err(|error| {
        let trail = Trail::default().key("stands").index(index).key("response");
        SceneError::in_file("", error.to_string()).named_by(trail)
    })?;
    let plant_height = 0.5 * (species.height[0] + species.height[1]);
    let (coefficients, substeps) = Coefficients::new(&species.continuum, dt, spacing, plant_height);
    Ok(StandModel {
        name: species.name.clone(),
        index,
        growth,
        lag: LagCoefficients::new(&species.continuum, species.segments(), dt),
        tolerance: tolerance(&species, chain.as_ref(), oscillator.as_ref(), around.usual),
        chain,
        oscillator,
        springs: SpringsModel::of(&species, dt, scene.budget.sheets),
        cells: species.cells,
        patch_side,
        spacing,
        coefficients,
        substeps,
        inertia: species.mass / (3.0 * plant_height),
        placement: placement_of(scene, index, &species),
        species,
    })
}

/// Where the plants of a stand stand.
fn placement_of(scene: &Scene, index: usize, species: &SpeciesModel) -> PlacementParameters {
    let (stand, side) = (&scene.stands[index], f64::from(scene.field.patch_side));
    PlacementParameters {
        seed: scene.seed.wrapping_mul(0x9E37_79B9).wrapping_add(index as u32),
        cells: species.cells,
        spacing: (side / f64::from(species.cells)) as f32,
        cover: stand.cover,
        height: species.height,
        clumping: stand.clumping,
        clumps: ((side / f64::from(stand.clump_size)).round() as u32).clamp(1, species.cells),
        lean: stand.lean,
        messiness: stand.messiness,
        unused: 0.0,
    }
}

/// Stands of meshes.
fn layered_stands(scene: &Scene, sources: &[Blowing], limits: &[Named], assets: &dyn Assets) -> Result<Vec<LayeredStand>, SceneError> {
    let dt = 1.0 / f64::from(scene.steps_per_second);
    let (mut stands, mut specimens) = (Vec::new(), Specimens::default());
    for (index, stand) in scene.stands.iter().enumerate() {
        let species = stand.resolve()?;
        let Some(layered) = species.layered.clone() else { continue };
        let specimen = specimens.of(&layered.layers.mesh, index, assets)?;
        stands.push(LayeredStand {
            name: stand.label(),
            index,
            harmonic: HarmonicModel::new(&layered.harmonic, largest(&specimen, &stand.places, species.height[1]), sources, dt),
            layered,
            specimen,
            places: stand.places.clone(),
            leaves: {
                let height = 0.5 * (species.height[0] + species.height[1]);
                species.mass / (height * height * height)
            },
            placement: placement_of(scene, index, &species),
            growth: Growth { limits: named(limits, &species.name), slopes: stand.slope, ..Growth::default() },
            patch_side: f64::from(scene.field.patch_side),
        });
    }
    Ok(stands)
}

/// Most bytes of the blades of one patch: what WebGPU lets a buffer bind.
const MOST_BLADE_BYTES: u64 = 128 << 20;

/// What moves a stand blade by blade, if it does.
fn chain_model(scene: &Scene, index: usize, species: &SpeciesModel, patch_side: f64) -> Result<Option<ChainModel>, SceneError> {
    let trail = |key| Trail::default().key("stands").index(index).key(key);
    let Some(chain) = ChainModel::of(species, patch_side) else { return Ok(None) };
    let chain = chain.map_err(|error| SceneError::in_file("", error.to_string()).named_by(trail("response")))?;
    let (cells, budget) = (species.cells, scene.budget.stateful_blades);
    let blades = chain.blades_of_patch(cells);
    // Its state, or where it stands: the wider of two buffers.
    let each = (4 * chain.planes()).max(size_of::<Root>()) as u64;
    let most = (MOST_BLADE_BYTES / each).min(u64::from(budget));
    if u64::from(blades) > most {
        let message = format!(
            "a patch has {cells} × {cells} cells of {} blades, {blades} in all; at most {most} can have a state",
            chain.stances.blades
        );
        let help = if u64::from(budget) > most || u64::from(blades) * each > MOST_BLADE_BYTES {
            "give the stand fewer cells, or its plants fewer blades".to_owned()
        } else {
            format!("write `budget: (stateful_blades: {blades})`, or give the stand fewer cells, or its plants fewer blades")
        };
        return Err(SceneError::in_file("", message).named_by(trail("response")).advise(&help));
    }
    Ok(Some(chain))
}

/// 1e-3 in still or steady air. In gusts plants trail β_eq by their inertia for ever, slow ones by nearly the whole swing, and some
/// cell of a patch always meets a rare gust: what gusts of four standard deviations make of the mean bend is rest there, and the
/// patch fades into β_eq.
fn tolerance(species: &SpeciesModel, chain: Option<&ChainModel>, oscillator: Option<&OscillatorModel>, wind: &WindField) -> f32 {
    let mean = (wind.mean[0] * wind.mean[0] + wind.mean[1] * wind.mean[1]).sqrt();
    let rare = 2.0 * (wind.gust_speed() - mean);
    let bend = |speed: f32| match chain {
        Some(chain) => chain.steady.lean(speed),
        None => {
            let response = oscillator.map_or(species.continuum.wind, |oscillator| oscillator.coefficients.wind);
            crate::wind::equilibrium([speed, 0.0], response)[0]
        }
    };
    let lull = if mean > rare { mean - rare } else { 0.0 };
    let (up, down) = (bend(mean + rare) - bend(mean), bend(mean) - bend(lull));
    crate::response::continuum::REST + if rare == 0.0 { 0.0 } else { crate::math::upper(up, down) }
}

fn load_terrain(terrain: &SceneTerrain, assets: &dyn Assets) -> Result<Terrain, SceneError> {
    let image = match terrain {
        SceneTerrain::Flat(flat) => return Ok(Terrain::flat(flat.height)),
        SceneTerrain::Image(image) => image,
    };
    let trail = Trail::default().key("terrain").key("path");
    let pixels = read(&image.path, &trail, assets)?;
    let sidecar = Path::new(&image.path).with_extension("toml");
    let sidecar = sidecar.to_string_lossy();
    let bad = |error: TerrainError| {
        let file = if error.is_of_sidecar() { &sidecar } else { image.path.as_str() };
        SceneError::in_file(file, error.to_string()).named_by(trail.clone())
    };
    if is_tiff(&pixels) {
        let text = assets.read(&sidecar).ok().and_then(|bytes| String::from_utf8(bytes).ok());
        return Terrain::from_tiff(&pixels, text.as_deref(), image.scale, image.offset).map_err(bad);
    }
    let help =
        "beside a PNG lies a text file with the lines columns, rows, metres_per_pixel_x, metres_per_pixel_y, min_height_m and max_height_m";
    let text = read(&sidecar, &trail, assets).map_err(|error| error.advise(help))?;
    let text = String::from_utf8(text).map_err(|_| bad(TerrainError::Sidecar("it is not text".to_owned())))?;
    Terrain::from_image(&pixels, &text, image.scale, image.offset).map_err(bad)
}

/// The picture of the surroundings.
fn environment(scene: &Scene, assets: &dyn Assets) -> Result<Option<Arc<Environment>>, SceneError> {
    let Some(given) = &scene.light.environment else { return Ok(None) };
    let trail = Trail::default().key("light").key("environment").key("file");
    let bytes = read(&given.file, &trail, assets)?;
    let help = "export it as an equirectangular Radiance picture (.hdr), twice as wide as high, at most 4096 pixels wide";
    let bad = |message: String| SceneError::in_file(&given.file, message).named_by(trail.clone()).advise(help);
    Ok(Some(Arc::new(Environment::from_hdr(&bytes, given.strength, given.turn).map_err(bad)?)))
}

/// The bumps on the ground, anchored to what they lie on.
fn detail_of(scene: &Scene) -> Detail {
    let origin = match &scene.terrain {
        SceneTerrain::Flat(_) => [0.0; 2],
        SceneTerrain::Image(image) => image.offset,
    };
    scene.detail.as_ref().map_or(Detail::NONE, |detail| Detail::new(detail, origin))
}

/// The scene with every position counted from the corner of its origin patch.
pub fn rebased(mut scene: Scene) -> Scene {
    let shift = scene.origin.map(|patch| f64::from(patch) * f64::from(scene.field.patch_side));
    let move_to = |at: &mut [f64; 2]| (at[0], at[1]) = (at[0] - shift[0], at[1] - shift[1]);
    let move_eye = |at: &mut [f64; 3]| (at[0], at[2]) = (at[0] - shift[0], at[2] - shift[1]);
    let move_path = |path: &mut ScenePath| match path {
        ScenePath::Still(path) => move_to(&mut path.at),
        ScenePath::Driven(path) => move_to(&mut path.at),
        ScenePath::Circle(path) => move_to(&mut path.centre),
        ScenePath::Keyframes(path) => path.keys.iter_mut().for_each(|key| move_to(&mut key.at)),
    };
    for interactor in &mut scene.interactors {
        move_path(&mut interactor.path);
    }
    for source in &mut scene.wind {
        match source {
            WindSource::Footprint(print) => move_path(&mut print.path),
            WindSource::Fluid(fluid) => fluid.gusts.iter_mut().for_each(|gust| {
                if let GustFrom::Place(place) = &mut gust.from {
                    move_to(&mut place.at);
                }
            }),
            WindSource::Uniform(_) | WindSource::Natural(_) => (),
        }
    }
    if scene.camera.follow.is_none() {
        move_eye(&mut scene.camera.eye);
        move_eye(&mut scene.camera.target);
        scene.camera.keys.iter_mut().for_each(|key| (move_eye(&mut key.eye), move_eye(&mut key.target)).0);
    }
    if let SceneTerrain::Image(image) = &mut scene.terrain {
        move_to(&mut image.offset);
    }
    for exclusion in &mut scene.exclusions {
        match &mut exclusion.area {
            Area::Box(rectangle) => move_to(&mut rectangle.at),
            Area::Disc(disc) => move_to(&mut disc.at),
            Area::Polygon(outline) => outline.points.iter_mut().for_each(move_to),
            Area::Road(road) => road.points.iter_mut().for_each(move_to),
        }
    }
    scene.stands.iter_mut().flat_map(|stand| &mut stand.places).for_each(|place| move_to(&mut place.at));
    scene.masks.iter_mut().for_each(|mask| move_to(&mut mask.at));
    scene.edits.iter_mut().for_each(|edit| move_to(&mut edit.at));
    scene
}

impl Model {
    /// Compiles a scene; files it names come from `assets`.
    pub fn compile(scene: &Scene, assets: &dyn Assets) -> Result<Self, SceneError> {
        let winds = WindState::all(scene);
        let sources = wind::sources(scene, &winds, 0.0);
        let field = scene.field.patches.map(|count| {
            let low = count.map(|n| -((n / 2) as i32));
            [low, [low[0] + count[0] as i32, low[1] + count[1] as i32]]
        });
        let mut terrain = load_terrain(&scene.terrain, assets)?.with_detail(detail_of(scene));
        let scattered = |error: TerrainError| SceneError::in_file("", error.to_string()).named_by(Trail::default().key("edits"));
        terrain.reserve_edits(&scene.edits).map_err(scattered)?;
        let limits = limits::of(scene, assets)?;
        let (mut images, mut pictures) = (Images::default(), Pictures::default());
        for (place, source) in scene.wind.iter().enumerate() {
            wind::paint(source, place, assets, &mut images, &mut pictures)?;
        }
        let blowers = wind::blowers(scene, &winds, &pictures);
        let fluids = wind::fluids(scene, &winds, &images, &[]);
        let usual = wind::usual(&sources, &fluids);
        let around = Around { scene, usual: &usual, varies: wind::varies(scene, &winds) };
        let stands = stand_models(&around, &limits, &limits::combs(scene, assets)?)?;
        let layered = layered_stands(scene, &sources, &limits, assets)?;
        let mut wardrobe = Wardrobe::default();
        let bodies = wardrobe.all(scene, assets)?;
        let texels = stands.iter().filter_map(|stand| stand.springs.as_ref()).map(|springs| springs.texels).max().unwrap_or(0);
        Ok(Self {
            dt: 1.0 / f64::from(scene.steps_per_second),
            rate: scene.steps_per_second,
            patch_side: f64::from(scene.field.patch_side),
            field,
            terrain,
            gusty: wind::is_gusty(&sources, &fluids),
            fluids,
            stands,
            layered,
            limits: limits.into_iter().map(|(limit, _)| limit).collect(),
            sources,
            blowers,
            images: Arc::new(images),
            pictures,
            maps: BodyMaps::of(&bodies, texels),
            bodies,
            wardrobe,
            revision: Revision::default(),
            environment: environment(scene, assets)?,
        })
    }

    /// What the kernels' `wind_tile_load` reads: the noise tile, then the images of footprints; room for flows ([`FluidSource::texel`]) follows.
    pub fn wind_texels(&self) -> Vec<[f32; 2]> {
        let flows = self.fluids.iter().map(FluidSource::texels).sum();
        [Tile::shipped().texels(), self.images.texels(), &vec![[0.0; 2]; flows]].concat()
    }
}
