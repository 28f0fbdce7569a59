//! The compiled scene: everything a step reads and never changes, but for the ground where it is edited.

mod fluids;
mod limits;
mod maps;
mod specimens;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use limits::{Named, NamedComb};
pub use maps::BodyMaps;
use specimens::Specimens;

use crate::figure::{Figure, FigureError};
use crate::growth::{Growth, Limit};
use crate::interaction::{FigureBody, Piece, pieces_of};
use crate::placement::PlacementParameters;
pub use crate::response::StandModel;
use crate::response::chain::ChainModel;
use crate::response::continuum::{Coefficients, LagCoefficients};
use crate::response::harmonic::{HarmonicModel, LayeredStand};
use crate::response::oscillator::OscillatorModel;
use crate::response::springs::SpringsModel;
use crate::scene::{
    Area, GustFrom, MeshShape, Path as ScenePath, Scene, SceneError, Shape, SpeciesModel, Terrain as SceneTerrain, Trail, WindSource,
};
use crate::shading::environment::Environment;
use crate::state::{BodyState, Root};
use crate::store::{NoStore, Store};
use crate::terrain::{Detail, Terrain, TerrainError, is_tiff};
use crate::wind::fluid::FluidSource;
use crate::wind::{Flow, Images, Source, Tile, WindField};

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

/// A body, compiled.
#[derive(Clone, Debug)]
pub struct BodyModel {
    /// Name, as in the scene.
    pub name: String,
    /// Convex pieces; of a mesh with a clip, those of its first moment.
    pub pieces: Vec<Piece>,
    /// The glTF figure of a mesh.
    pub figure: Option<FigureBody>,
    /// Half width and half length of its base, m.
    pub half: [f64; 2],
    /// Half width and half length of all of it, m.
    pub reach: [f64; 2],
}

impl BodyModel {
    /// Whether its parts move against each other.
    pub fn is_animated(&self) -> bool {
        self.figure.as_ref().is_some_and(FigureBody::is_animated)
    }

    /// The pieces of an animated body before and after the last step; none of another.
    pub fn pieces_between(&self, state: &BodyState) -> Vec<[Piece; 2]> {
        let Some(figure) = self.figure.as_ref().filter(|figure| figure.is_animated() && state.pose.is_some()) else { return Vec::new() };
        let [from, to] = state.clock;
        let from = if figure.is_smooth(from, to) { from } else { to };
        let pairs = figure.pieces(from).into_iter().zip(figure.pieces(to));
        pairs.filter_map(|pair| Some([pair.0?, pair.1?])).collect()
    }
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
    /// Wind sources.
    pub sources: Vec<Source>,
    /// Wind of places.
    pub blowers: Vec<Blower>,
    /// Their images.
    pub images: Arc<Images>,
    /// Air that flows.
    pub fluids: Vec<FluidSource>,
    /// The wind changes with time.
    pub gusty: bool,
    /// Bodies in the scene's order.
    pub bodies: Vec<BodyModel>,
    /// What they look like from six sides.
    pub maps: BodyMaps,
    /// The picture of the surroundings, where there is one.
    pub environment: Option<Arc<Environment>>,
}

/// A source of wind that has a place.
#[derive(Clone, Debug)]
pub struct Blower {
    /// What the author wrote.
    pub source: crate::scene::Footprint,
    /// How the air moves.
    pub flow: Flow,
    /// The interactor it stays with.
    pub follow: Option<usize>,
}

/// The scene's footprints and the pictures they name.
fn blowers(scene: &Scene, assets: &dyn Assets) -> Result<(Vec<Blower>, Images), SceneError> {
    let (mut list, mut images) = (Vec::new(), Images::default());
    for (index, source) in scene.wind.iter().enumerate() {
        let WindSource::Footprint(source) = source else { continue };
        let flow = match &source.flow {
            crate::scene::Flow::Outward => Flow::Outward,
            crate::scene::Flow::Swirl => Flow::Swirl,
            crate::scene::Flow::Image(image) => {
                let trail = Trail::default().key("wind").index(index).key("flow").key("path");
                let bytes = read(&image.path, &trail, assets)?;
                Flow::Image(images.add_png(&bytes).map_err(|why| SceneError::in_file(&image.path, why).named_by(trail))?)
            }
        };
        let follow = source.follow.as_ref().and_then(|name| scene.interactors.iter().position(|body| &body.name == name));
        list.push(Blower { source: source.clone(), flow, follow });
    }
    Ok((list, images))
}

fn half_of(shape: &Shape, pieces: &[Piece]) -> [f64; 2] {
    if matches!(shape, Shape::Truck) {
        return [0.8, 1.45];
    }
    reach_of(pieces)
}

fn reach_of(pieces: &[Piece]) -> [f64; 2] {
    [0, 1].map(|axis: usize| pieces.iter().flat_map(|piece| &piece.outline).map(|p| p[axis].abs()).fold(0.05, f64::max))
}

/// Why a file cannot be this body, with the value of the scene that is at fault.
fn bad_body(mesh: &MeshShape, shape: &Trail, error: &FigureError) -> SceneError {
    let (field, help) = match error {
        FigureError::Clip { .. } => ("clip", None),
        FigureError::Size { .. } => ("scale", None),
        FigureError::Data { .. } | FigureError::Json(_) => ("file", Some("export it again; a glTF validator says more")),
        _ => ("file", None),
    };
    let bad = SceneError::in_file(&mesh.file, error.to_string()).named_by(shape.clone().key(field));
    help.map_or(bad.clone(), |help| bad.advise(help))
}

/// The bodies of a scene; each file is read and split once.
fn body_models(scene: &Scene, assets: &dyn Assets) -> Result<Vec<BodyModel>, SceneError> {
    let mut figures: BTreeMap<(&str, u32), Arc<Figure>> = BTreeMap::new();
    let mut bodies = Vec::new();
    for (index, interactor) in scene.interactors.iter().enumerate() {
        let figure = match &interactor.shape {
            Shape::Mesh(mesh) => {
                let shape = Trail::default().key("interactors").index(index).key("shape");
                let bad = |error: FigureError| bad_body(mesh, &shape, &error);
                let figure = match figures.get(&(mesh.file.as_str(), mesh.pieces)) {
                    Some(known) => Arc::clone(known),
                    None => {
                        let bytes = read(&mesh.file, &shape.clone().key("file"), assets)?;
                        let beside = |name: &str| {
                            let folder = Path::new(&mesh.file).parent().unwrap_or(Path::new(""));
                            assets.read(&folder.join(name).to_string_lossy())
                        };
                        Arc::new(Figure::read(&bytes, &beside, mesh.pieces).map_err(bad)?)
                    }
                };
                figures.insert((&mesh.file, mesh.pieces), Arc::clone(&figure));
                Some(FigureBody::new(figure, mesh).map_err(bad)?)
            }
            _ => None,
        };
        let pieces = match &figure {
            Some(figure) => figure.pieces(0.0).into_iter().flatten().collect(),
            None => pieces_of(&interactor.shape),
        };
        bodies.push(BodyModel {
            name: interactor.name.clone(),
            half: half_of(&interactor.shape, &pieces),
            reach: reach_of(&pieces),
            pieces,
            figure,
        });
    }
    Ok(bodies)
}

/// Those of a list that hold for a stand.
fn named<T>(list: &[(Arc<T>, Vec<String>)], stand: &String) -> Vec<Arc<T>> {
    list.iter().filter(|(_, names)| names.is_empty() || names.contains(stand)).map(|(one, _)| Arc::clone(one)).collect()
}

fn stand_models(scene: &Scene, usual: &WindField, limits: &[Named], combs: &[NamedComb]) -> Result<Vec<StandModel>, SceneError> {
    let dt = 1.0 / f64::from(scene.steps_per_second);
    let patch_side = f64::from(scene.field.patch_side);
    let mut stands: Vec<StandModel> = Vec::new();
    for (index, stand) in scene.stands.iter().enumerate().filter(|(_, stand)| !stand.is_layered()) {
        let species = stand.resolve()?;
        let spacing = patch_side / f64::from(species.cells);
        let chain = chain_model(scene, index, &species, patch_side)?;
        let oscillator = OscillatorModel::of(&species, dt, patch_side, scene.wind.iter().any(varies)).transpose().map_err(|error| {
            let trail = Trail::default().key("stands").index(index).key("response");
            SceneError::in_file("", error.to_string()).named_by(trail)
        })?;
        let plant_height = 0.5 * (species.height[0] + species.height[1]);
        let (coefficients, substeps) = Coefficients::new(&species.continuum, dt, spacing, plant_height);
        let placement = placement_of(scene, index, &species);
        let growth = Growth { limits: named(limits, &species.name), slopes: stand.slope, combs: named(combs, &species.name) };
        stands.push(StandModel {
            name: stand.label(),
            index,
            growth,
            lag: LagCoefficients::new(&species.continuum, species.segments(), dt),
            tolerance: tolerance(&species, chain.as_ref(), oscillator.as_ref(), usual),
            chain,
            oscillator,
            springs: SpringsModel::of(&species, dt, scene.budget.sheets),
            cells: species.cells,
            species,
            patch_side,
            spacing,
            coefficients,
            substeps,
            placement,
        });
    }
    Ok(stands)
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
fn layered_stands(scene: &Scene, sources: &[Source], limits: &[Named], assets: &dyn Assets) -> Result<Vec<LayeredStand>, SceneError> {
    let dt = 1.0 / f64::from(scene.steps_per_second);
    let (mut stands, mut specimens) = (Vec::new(), Specimens::default());
    for (index, stand) in scene.stands.iter().enumerate() {
        let species = stand.resolve()?;
        let Some(layered) = species.layered.clone() else { continue };
        let specimen = specimens.of(&layered.layers.mesh, index, assets)?;
        let places = stand.places.iter().filter_map(|place| place.height);
        let tallest = places.fold(species.height[1], crate::math::upper);
        let scale = tallest / specimen.high[1].max(1e-3);
        let wide = (0..3).step_by(2).map(|axis| specimen.high[axis] - specimen.low[axis]).fold(0.0, crate::math::upper);
        stands.push(LayeredStand {
            name: stand.label(),
            index,
            harmonic: HarmonicModel::new(&layered.harmonic, [wide * scale, tallest], sources, dt),
            layered,
            specimen,
            places: stand.places.clone(),
            placement: placement_of(scene, index, &species),
            growth: Growth { limits: named(limits, &species.name), slopes: stand.slope, combs: Vec::new() },
            patch_side: f64::from(scene.field.patch_side),
        });
    }
    Ok(stands)
}

/// Whether a source of wind is not the same everywhere and for ever.
fn varies(source: &WindSource) -> bool {
    !matches!(source, WindSource::Uniform(_))
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
        let sources: Vec<Source> = scene
            .wind
            .iter()
            .filter_map(|source| match source {
                WindSource::Uniform(wind) => Some(Source::Uniform { velocity: wind.velocity }),
                WindSource::Natural(wind) => Some(Source::Natural { velocity: wind.velocity, turbulence: wind.turbulence }),
                WindSource::Fluid(wind) => Some(Source::Uniform { velocity: wind.velocity }),
                WindSource::Footprint(_) => None,
            })
            .collect();
        let field = scene.field.patches.map(|count| {
            let low = count.map(|n| -((n / 2) as i32));
            [low, [low[0] + count[0] as i32, low[1] + count[1] as i32]]
        });
        let mut terrain = load_terrain(&scene.terrain, assets)?.with_detail(detail_of(scene));
        let scattered = |error: TerrainError| SceneError::in_file("", error.to_string()).named_by(Trail::default().key("edits"));
        terrain.reserve_edits(&scene.edits).map_err(scattered)?;
        let limits = limits::of(scene, assets)?;
        let (blowers, images) = blowers(scene, assets)?;
        let fluids = fluids::of(scene, (Tile::shipped().texels().len() + images.texels().len()) as u32);
        let usual = fluids::usual_wind(&sources, &fluids);
        let stands = stand_models(scene, &usual, &limits, &limits::combs(scene, assets)?)?;
        let layered = layered_stands(scene, &sources, &limits, assets)?;
        let bodies = body_models(scene, assets)?;
        let texels = stands.iter().filter_map(|stand| stand.springs.as_ref()).map(|springs| springs.texels).max().unwrap_or(0);
        Ok(Self {
            dt: 1.0 / f64::from(scene.steps_per_second),
            rate: scene.steps_per_second,
            patch_side: f64::from(scene.field.patch_side),
            field,
            terrain,
            gusty: sources.iter().any(|source| matches!(source, Source::Natural { turbulence, .. } if *turbulence > 0.0))
                || fluids.iter().any(FluidSource::is_gusty),
            fluids,
            stands,
            layered,
            limits: limits.into_iter().map(|(limit, _)| limit).collect(),
            sources,
            blowers,
            images: Arc::new(images),
            maps: BodyMaps::of(&bodies, texels),
            bodies,
            environment: environment(scene, assets)?,
        })
    }

    /// What the kernels' `wind_tile_load` reads: the noise tile, then the images of footprints; room for flows ([`FluidSource::texel`]) follows.
    pub fn wind_texels(&self) -> Vec<[f32; 2]> {
        let flows = self.fluids.iter().map(FluidSource::texels).sum();
        [Tile::shipped().texels(), self.images.texels(), &vec![[0.0; 2]; flows]].concat()
    }
}
