//! Outputs of each pixel beside a picture (`--aov`): which, in which files, and what they mean.

mod draw;
mod files;

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use sward::picture::aov::Aov;
use sward::picture::identity::Identity;
use sward::world::World;

use crate::failure::Failure;
use crate::output;
pub(crate) use draw::Memory;

/// An output of each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub(crate) enum Output {
    /// Distance along the axis of view, m
    Depth,
    /// To where the same point was in the frame before, pixels
    Motion,
    /// Number of the plant
    Plant,
}

/// How outputs are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// A NumPy array for each output
    Npy,
    /// All outputs of a picture in one OpenEXR file
    Exr,
}

/// What is written beside each picture.
#[derive(Clone, Debug)]
pub(crate) struct Outputs {
    wanted: Vec<Output>,
    format: Format,
    description: Description,
}

/// What the outputs are, for whoever reads them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Description {
    format: String,
    outputs: Vec<Entry>,
    /// How numbers of plants are put together.
    numbers: Numbers,
}

/// One output.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Entry {
    name: String,
    meaning: String,
    unit: String,
    /// What its file's name ends with, in place of .png.
    file: String,
    dtype: String,
    /// Of an EXR file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    channels: Vec<String>,
}

/// `cell | (x mod 2^patch_bits) << cell_bits | (z mod 2^patch_bits) << (cell_bits + patch_bits) | (stand + 1) << (cell_bits +
/// 2 patch_bits)`; without a stand, 0 is ground or sky and k body k.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Numbers {
    cell_bits: u32,
    patch_bits: u32,
    /// In order, from 0.
    stands: Vec<Stand>,
    /// In order, from 1.
    bodies: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Stand {
    name: String,
    /// Along a patch side; cell = j · cells + i.
    cells: u32,
}

impl Output {
    fn name(self) -> &'static str {
        ["depth", "motion", "plant"][self as usize]
    }

    fn channels(self) -> &'static [&'static str] {
        [&["Z"][..], &["motion.X", "motion.Y"], &["plant"]][self as usize]
    }

    fn entry(self, format: Format) -> Entry {
        let (meaning, unit, dtype) = match self {
            Self::Depth => ("distance along the axis of view; infinite for the sky", "m", "<f4"),
            Self::Motion => (
                "(x right, y down) from the pixel to where the same point was in the frame before; 65536 where it was unseen",
                "pixels",
                "<f4",
            ),
            Self::Plant => ("number of the plant: see numbers", "", "<u4"),
        };
        let (file, channels) = match format {
            Format::Npy => (format!("{}.npy", self.name()), Vec::new()),
            Format::Exr => ("exr".to_owned(), self.channels().iter().map(|name| (*name).to_owned()).collect()),
        };
        let [name, meaning, unit, dtype] = [self.name(), meaning, unit, dtype].map(str::to_owned);
        Entry { name, meaning, unit, file, dtype, channels }
    }
}

impl Outputs {
    /// What was asked for, of a world; `None` if nothing was.
    ///
    /// # Errors
    /// Plants of this scene cannot be told apart by their numbers.
    pub(crate) fn new(wanted: &[Output], format: Format, world: &World) -> Result<Option<Self>, Failure> {
        let mut wanted = wanted.to_vec();
        wanted.sort();
        wanted.dedup();
        if wanted.is_empty() {
            return Ok(None);
        }
        let identity = Identity::of(world);
        if wanted.contains(&Output::Plant) && !identity.is_unique() {
            let stands = world.model.stands.len();
            let message =
                format!("the plants of {stands} stands with up to {} bits of cells cannot be numbered in 32 bits", identity.cell_bits);
            return Err(Failure::input(
                message,
                "leave `plant` out of --aov; or give the scene fewer stands, fewer `cells`, or larger patches",
            ));
        }
        let stand = |(stand, cells): (&sward::model::StandModel, &u32)| Stand { name: stand.name.clone(), cells: *cells };
        let numbers = Numbers {
            cell_bits: identity.cell_bits,
            patch_bits: identity.patch_bits,
            stands: world.model.stands.iter().zip(&identity.cells).map(stand).collect(),
            bodies: world.model.bodies.iter().map(|body| body.name.clone()).collect(),
        };
        let outputs = wanted.iter().map(|output| output.entry(format)).collect();
        let name = if format == Format::Npy { "npy" } else { "exr" };
        Ok(Some(Self { wanted, format, description: Description { format: name.to_owned(), outputs, numbers } }))
    }

    /// What the outputs are.
    pub(crate) fn description(&self) -> &Description {
        &self.description
    }

    /// The files beside a picture.
    pub(crate) fn paths(&self, picture: &Path) -> Vec<PathBuf> {
        match self.format {
            Format::Exr => vec![picture.with_extension("exr")],
            Format::Npy => self.wanted.iter().map(|output| picture.with_extension(format!("{}.npy", output.name()))).collect(),
        }
    }

    /// The file that says beside a single picture what its outputs are.
    pub(crate) fn description_path(picture: &Path) -> PathBuf {
        picture.with_extension("aov.json")
    }

    /// Writes the files beside a picture.
    ///
    /// # Errors
    /// A file cannot be written.
    pub(crate) fn write(&self, picture: &Path, aov: &Aov) -> Result<(), Failure> {
        match self.format {
            Format::Exr => output::write_whole(&picture.with_extension("exr"), |writer| files::write_exr(writer, aov, &self.wanted)),
            Format::Npy => self
                .paths(picture)
                .iter()
                .zip(&self.wanted)
                .try_for_each(|(path, wanted)| output::write_whole(path, |writer| files::write_npy(writer, aov, *wanted))),
        }
    }

    /// Says beside a single picture what its outputs are.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(crate) fn describe(&self, picture: &Path) -> Result<(), Failure> {
        output::write_whole(&Self::description_path(picture), |writer| {
            use std::io::Write;
            serde_json::to_writer_pretty(&mut *writer, &self.description).map_err(std::io::Error::other)?;
            writer.write_all(b"\n")
        })
    }
}
