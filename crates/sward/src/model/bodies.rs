//! Bodies, compiled: their convex pieces, and the figures of those that come from files.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::{Assets, read};
use crate::figure::{Figure, FigureError};
use crate::interaction::{FigureBody, Piece, pieces_of};
use crate::scene::{Interactor, MeshShape, Scene, SceneError, Shape, Trail, text_of};
use crate::state::BodyState;

/// A body, compiled.
#[derive(Clone, Debug)]
pub struct BodyModel {
    /// Another number for every body that ever was in a world: who draws bodies keeps what it made of one by this.
    pub serial: u64,
    /// A number that bodies of the same shape share, and others do not.
    pub shape: u64,
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

/// What makes bodies: files that were read once are known from then on, so that one that comes while a world runs is there at once.
#[derive(Clone, Debug, Default)]
pub struct Wardrobe {
    figures: BTreeMap<(String, u32), Arc<Figure>>,
    serial: u64,
}

impl Wardrobe {
    /// The bodies of a scene.
    pub(super) fn all(&mut self, scene: &Scene, assets: &dyn Assets) -> Result<Vec<BodyModel>, SceneError> {
        let bodies = scene.interactors.iter().enumerate();
        bodies.map(|(index, interactor)| self.body(interactor, index, assets)).collect()
    }

    /// A body; `index` is its place in the scene, for errors.
    ///
    /// # Errors
    /// A file that cannot be read, or is no such body.
    pub(crate) fn body(&mut self, interactor: &Interactor, index: usize, assets: &dyn Assets) -> Result<BodyModel, SceneError> {
        let figure = match &interactor.shape {
            Shape::Mesh(mesh) => {
                let shape = Trail::default().key("interactors").index(index).key("shape");
                let figure = self.figure(mesh, &shape, assets)?;
                Some(FigureBody::new(figure, mesh).map_err(|error| bad_body(mesh, &shape, &error))?)
            }
            _ => None,
        };
        let pieces = match &figure {
            Some(figure) => figure.pieces(0.0).into_iter().flatten().collect(),
            None => pieces_of(&interactor.shape),
        };
        self.serial += 1;
        Ok(BodyModel {
            serial: self.serial,
            shape: fingerprint(&text_of(&interactor.shape)),
            name: interactor.name.clone(),
            half: half_of(&interactor.shape, &pieces),
            reach: reach_of(&pieces),
            pieces,
            figure,
        })
    }

    /// Nobody: what stands where a body has been removed.
    pub(crate) fn nobody(&mut self) -> BodyModel {
        self.serial += 1;
        BodyModel {
            serial: self.serial,
            shape: 0,
            name: String::new(),
            pieces: Vec::new(),
            figure: None,
            half: [0.05; 2],
            reach: [0.05; 2],
        }
    }

    /// Each file is read and split once.
    fn figure(&mut self, mesh: &MeshShape, shape: &Trail, assets: &dyn Assets) -> Result<Arc<Figure>, SceneError> {
        let key = (mesh.file.clone(), mesh.pieces);
        if let Some(known) = self.figures.get(&key) {
            return Ok(Arc::clone(known));
        }
        let bytes = read(&mesh.file, &shape.clone().key("file"), assets)?;
        let beside = |name: &str| {
            let folder = Path::new(&mesh.file).parent().unwrap_or(Path::new(""));
            assets.read(&folder.join(name).to_string_lossy())
        };
        let figure = Figure::read(&bytes, &beside, mesh.pieces).map_err(|error| bad_body(mesh, shape, &error))?;
        let figure = Arc::new(figure);
        self.figures.insert(key, Arc::clone(&figure));
        Ok(figure)
    }
}

/// FNV-1a.
fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
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
