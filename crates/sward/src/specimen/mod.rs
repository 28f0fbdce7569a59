//! Plants from any triangles: a mesh made ready for layers, once.
//!
//! Chen & Johan 2015, §3.2: leaves and rigid wood are told apart by material, leaves are what hangs together, and each has a root vertex.
//! Layers then take whole leaves: a triangle belongs where its leaf's root is.
//! Reads: a glTF file ([`Specimen::read`]) or a plant grown by code ([`grow`]). Writes: nothing that a step changes.
//! Differs from the paper: vertices that only lie in one place hang together too, since exporters split them at seams; union-find takes the
//! place of its breadth-first search, and finds the same. Wood is not split.
//!
//! **Memory**, besides the file: 32 bytes a vertex and 12 a triangle for the specimen, and for a while 22 more a vertex, or 8 a vertex and 12 a
//! triangle where that is more. A vertex that no triangle uses is not kept. With three vertices a triangle, the most there can be, that is 174 bytes
//! a triangle; of grown plants, with 1.2 to 2 vertices, 75 to 120. Time is linear.

mod components;
mod error;
mod finishes;
pub mod grow;
mod levels;
mod progress;
mod read;
mod rule;
mod shade;
mod soup;
mod stored;
mod vertex;
mod write;

use std::ops::Range;

pub use error::SpecimenError;
pub use levels::levels;
pub use rule::Rule;
pub use stored::StoredError;
pub use vertex::SpecimenVertex;

use crate::figure::container::{self, Opened};
use crate::store::{Found, Store};

/// Most triangles of a plant.
pub const MOST_TRIANGLES: u64 = 64 << 20;

/// What a part is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Moves in the wind; split into leaves with a root each.
    Leaf,
    /// Stands still.
    Wood,
}

/// What a part looks like.
#[derive(Clone, Debug, PartialEq)]
pub struct Finish {
    /// Leaf or wood.
    pub kind: Kind,
    /// Factor of the picture's colour, or the colour itself, linear RGB, 0..=1.
    pub colour: [f32; 3],
    /// Index into [`Specimen::pictures`].
    pub picture: Option<usize>,
    /// The picture's alpha from which on a texel is there, 0..=1; 0 where all are.
    pub cutoff: f32,
    /// Whether its back is seen too.
    pub two_sided: bool,
    /// The material's name in the file.
    pub name: String,
}

/// A base colour picture, as in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// RGBA, row by row from above; colour coded as sRGB. Transparent texels keep their colour.
    pub texels: Vec<[u8; 4]>,
}

/// Triangles of one finish.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Which of [`Specimen::triangles`].
    pub triangles: Range<u32>,
    /// Index into [`Specimen::finishes`].
    pub finish: usize,
}

/// A plant's mesh made ready: leaves and wood told apart, every leaf with its root. Metres, +y up, the plant's root at the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Specimen {
    /// Corners; those of leaves first.
    pub vertices: Vec<SpecimenVertex>,
    /// Three corners each, counter-clockwise seen from outside, part by part.
    pub triangles: Vec<[u32; 3]>,
    /// All leaf parts, then all wood parts; one for each finish that is used.
    pub parts: Vec<Part>,
    /// One for each part, in the same order.
    pub finishes: Vec<Finish>,
    /// Pictures that finishes use.
    pub pictures: Vec<Picture>,
    /// How many leaves there are.
    pub leaves: u32,
    /// Lowest corner of the box around it, m.
    pub low: [f32; 3],
    /// Highest corner of that box, m.
    pub high: [f32; 3],
}

/// How large a plant shall be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// Metres a file unit, > 0.
    Scale(f32),
    /// Its top above its root, m, > 0.
    Height(f32),
}

/// What is to be made of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Order {
    /// Which materials are leaves, which wood.
    pub rule: Rule,
    /// How large.
    pub size: Size,
}

impl Default for Order {
    /// By the materials' names, as large as in the file.
    fn default() -> Self {
        Self { rule: Rule::default(), size: Size::Scale(1.0) }
    }
}

/// Reads a file beside the glTF file, by name.
pub type Neighbour<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

impl Specimen {
    /// Makes a `.glb` or `.gltf` ready. `progress` hears of shares done, 0..=1, at least every 1 %.
    ///
    /// Meshes stand where their nodes put them without a clip; skinned ones as bound. Smooth normals are computed where there are none.
    ///
    /// # Errors
    /// What is wrong with the file, and where in it.
    pub fn read(bytes: &[u8], neighbour: Neighbour<'_>, order: &Order, progress: &mut dyn FnMut(f32)) -> Result<Self, SpecimenError> {
        Self::made(&container::open(bytes, neighbour)?, order, progress)
    }

    fn made(opened: &Opened<'_>, order: &Order, progress: &mut dyn FnMut(f32)) -> Result<Self, SpecimenError> {
        let mut progress = progress::Told::new(progress);
        let soup = read::soup(opened, &order.rule, &mut progress.part(0.0, 0.4))?;
        soup.ready(order.size, &mut progress.part(0.4, 1.0))
    }

    /// The same, from a store if it is there, else made and stored. What is stored is named by a sum over all that goes in, neighbouring files
    /// too; damaged bytes, or those of another version, are found out and the specimen made anew. While it is stored there is a second copy of it.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn stored(
        bytes: &[u8],
        neighbour: Neighbour<'_>,
        order: &Order,
        store: &dyn Store,
        progress: &mut dyn FnMut(f32),
    ) -> Result<(Self, Found), SpecimenError> {
        let opened = container::open(bytes, neighbour)?;
        let key = stored::key(bytes, &opened, order)?;
        let mut found = Found::default();
        let name = stored::name(key);
        let kept = match store.load(&name) {
            Ok(bytes) => bytes.map(|bytes| stored::read(key, &bytes)),
            Err(why) => {
                found.trouble.push(why);
                None
            }
        };
        match kept {
            Some(Ok(specimen)) => return Ok((specimen, Found { stored: true, ..found })),
            Some(Err(error)) => found.trouble.push(format!("{name}: {error}")),
            None => (),
        }
        let specimen = Self::made(&opened, order, progress)?;
        found.trouble.extend(store.save(&name, &stored::bytes(key, &specimen)).err());
        Ok((specimen, found))
    }

    /// Triangles of all parts of a kind.
    pub fn count(&self, kind: Kind) -> u64 {
        let parts = self.parts.iter().filter(|part| self.finishes[part.finish].kind == kind);
        parts.map(|part| u64::from(part.triangles.end - part.triangles.start)).sum()
    }
}
