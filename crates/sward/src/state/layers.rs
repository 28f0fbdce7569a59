//! Stands of meshes: the waves that move them, what these did lately, who is touched, and how plants in sight are cut into layers.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{PatchKey, SheetPool};

/// A plant of a stand of meshes: its patch, and the number of its cell there, or of its place in the scene.
pub type PlantKey = (PatchKey, u32);

/// Waves on a plane of square cells.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Waves {
    /// Cells along a side.
    pub(crate) side: usize,
    /// V of each cell \[m/s, along the plane's right and up\], row by row.
    pub now: Vec<[f32; 2]>,
    /// V one step before; of the next step while one is under way.
    pub old: Vec<[f32; 2]>,
}

/// A plant of a stand of meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayeredPlant {
    /// Which one.
    pub key: PlantKey,
    /// Its root, m.
    pub root: [f64; 3],
    /// Its height, m.
    pub height: f32,
    /// Its turn about +y, rad.
    pub yaw: f32,
    /// Colour variation, 0 to 1.
    pub tint: f32,
}

/// How a plant is cut into layers as an eye sees it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cut {
    /// The eye, m.
    pub eye: [f64; 3],
    /// Where it looks: unit, normal to the layers.
    pub forward: [f32; 3],
    /// What it sees of the plant: left, bottom, right and top on a plane 1 m before it, m.
    pub window: [f32; 4],
    /// Pixels of that metre.
    pub pixels: f32,
    /// Layers of the near, middle and far part.
    pub layers: [u8; 3],
    /// Step in which it was made.
    pub step: u64,
}

/// The cut that is shown, and the one that it takes over from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cuts {
    /// The newer.
    pub now: Cut,
    /// The older, while the newer fades in.
    pub before: Option<Cut>,
}

/// What a step changes of a stand of meshes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LayeredState {
    /// The plane that the wind moves.
    pub waves: Waves,
    /// What it did lately: V, note by note; see [`crate::response::harmonic::Ring`].
    pub notes: Vec<Vec<[f32; 2]>>,
    /// The mean wind that lags are made of, m/s along x and z.
    pub drift: [f32; 2],
    /// Plants with a plane of their own.
    pub pool: SheetPool,
    /// Steps since each of them was last touched.
    pub since: Vec<u32>,
    /// Their planes.
    pub touches: Vec<Waves>,
    /// How plants in sight are cut.
    pub cuts: BTreeMap<PlantKey, Cuts>,
    /// Plants cut so far, once at first sight and once for every turn of the view.
    pub cut: u64,
    /// Plants near the focuses, patch by patch; derived.
    #[serde(skip)]
    pub near: BTreeMap<PatchKey, Vec<LayeredPlant>>,
}

impl LayeredState {
    /// A plant near a focus.
    pub fn plant(&self, key: PlantKey) -> Option<&LayeredPlant> {
        let plants = self.near.get(&key.0)?;
        plants.binary_search_by_key(&key, |plant| plant.key).ok().map(|found| &plants[found])
    }
}
