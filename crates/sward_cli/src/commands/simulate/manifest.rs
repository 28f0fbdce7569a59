//! What the arrays are.

use std::io::{Error, Write};
use std::path::Path;

use serde::Serialize;

use crate::failure::Failure;
use crate::output;
use crate::scenes::Opened;

/// Name of the file.
pub(super) const MANIFEST: &str = "manifest.json";

/// The whole file.
#[derive(Serialize)]
pub(super) struct Manifest {
    /// Version of sward.
    sward: &'static str,
    scene: String,
    title: String,
    seed: u32,
    /// Patch whose corner is (0, 0) of all positions and patches below.
    origin_patch: [i32; 2],
    /// m
    patch_side: f32,
    steps_per_second: u32,
    steps: u32,
    every: u32,
    /// `cpu`, or the adapter's name.
    on: String,
    /// Every array, in order of time.
    pub(super) arrays: Vec<Array>,
}

/// One array.
#[derive(Serialize)]
pub(super) struct Array {
    /// `<stand>/beta`, `<stand>/omega`, `<stand>/patches`, of stands that move blade by blade `<stand>/virtual_blades` and `<stand>/blades`, `bodies` or `wind`.
    pub(super) name: String,
    /// What the numbers mean.
    pub(super) meaning: &'static str,
    /// Beside the manifest.
    pub(super) file: String,
    /// As NumPy writes it.
    pub(super) dtype: &'static str,
    pub(super) shape: Vec<u64>,
    /// What each index counts.
    pub(super) axes: Vec<&'static str>,
    pub(super) unit: &'static str,
    /// Steps done.
    pub(super) step: u64,
    /// s
    pub(super) time: f64,
    /// What each column of the last axis is, where they differ.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) columns: Vec<Column>,
    /// What each row of the first axis is, where they have names.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) rows: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) grid: Option<Grid>,
}

/// A column.
#[derive(Serialize)]
pub(super) struct Column {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
}

/// Where the samples of an array lie on the ground.
#[derive(Serialize)]
pub(super) struct Grid {
    /// Position (x, z) of the first sample, m from the corner of the origin patch.
    pub(super) first: [f64; 2],
    /// Distance of two samples along both axes, m.
    pub(super) spacing: f64,
}

impl Manifest {
    /// Of a run without arrays yet.
    pub(super) fn new(opened: &Opened, steps: u32, every: u32, on: &str) -> Self {
        let scene = &opened.scene;
        Self {
            sward: env!("CARGO_PKG_VERSION"),
            scene: opened.name.clone(),
            title: scene.title.clone(),
            seed: scene.seed,
            origin_patch: scene.origin,
            patch_side: scene.field.patch_side,
            steps_per_second: scene.steps_per_second,
            steps,
            every,
            on: on.to_owned(),
            arrays: Vec::new(),
        }
    }

    /// Writes it, after the arrays it lists.
    pub(super) fn write(&self, folder: &Path) -> Result<(), Failure> {
        output::write_whole(&folder.join(MANIFEST), |writer| {
            serde_json::to_writer_pretty(&mut *writer, self).map_err(Error::other)?;
            writer.write_all(b"\n")
        })
    }
}
