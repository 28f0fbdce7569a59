//! Plants grown by code: the same from the same seed on every machine.
//!
//! Not in the paper, which takes models from elsewhere. Branches bear branches at the golden angle, level by level, each a bent tapering tube;
//! the last bear leaves of a few triangles. How many twigs there are follows from the triangles asked for, and leaves take what twigs leave
//! over, so that the number comes out. Random choices are hashes of who asks; arithmetic is [`crate::math`]'s.

mod blade;
mod branch;
mod chance;
mod crown;
mod forms;
mod mesh;
mod tube;
mod water;

pub use mesh::{Grown, MeshVertex, Piece};

use super::{Size, Specimen, SpecimenError};

/// Fewest and most triangles of a grown plant.
pub const TRIANGLES: [u32; 2] = [2000, 64_000_000];
/// Least and greatest height of a grown plant, m.
pub const HEIGHTS: [f32; 2] = [0.05, 60.0];

/// What kind of plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// Round, many stems, dense from the ground up.
    Bush,
    /// A trunk and a full crown.
    Tree,
    /// Ribbons and feathery stems, all soft.
    WaterPlant,
}

impl Form {
    /// Its height where none is asked for, m.
    pub fn height(self) -> f32 {
        match self {
            Self::Bush => 1.5,
            Self::Tree => 7.5,
            Self::WaterPlant => 0.5,
        }
    }
}

/// A plant to grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grow {
    /// What kind.
    pub form: Form,
    /// Which of the kind.
    pub seed: u32,
    /// About how many triangles, within 10 %; in [`TRIANGLES`].
    pub triangles: u32,
    /// Its top above its root, m; in [`HEIGHTS`].
    pub height: f32,
}

impl Grow {
    /// A plant of 20 000 triangles, as high as its kind grows.
    pub fn new(form: Form) -> Self {
        Self { form, seed: 0, triangles: 20_000, height: form.height() }
    }

    /// Its mesh.
    ///
    /// # Errors
    /// Numbers out of range.
    pub fn mesh(&self) -> Result<Grown, SpecimenError> {
        if !(TRIANGLES[0]..=TRIANGLES[1]).contains(&self.triangles) {
            let found = self.triangles.to_string();
            return Err(SpecimenError::Grow { what: "the number of triangles", found, allowed: "2000 to 64000000" });
        }
        if !(HEIGHTS[0]..=HEIGHTS[1]).contains(&self.height) {
            let found = format!("{} m", self.height);
            return Err(SpecimenError::Grow { what: "the height", found, allowed: "0.05 to 60 m" });
        }
        let mut grown = match self.form {
            Form::Bush => crown::grown(&forms::bush(self.triangles), self.seed, self.triangles),
            Form::Tree => crown::grown(&forms::tree(self.triangles), self.seed, self.triangles),
            Form::WaterPlant => water::grown(self.seed, self.triangles),
        };
        grown.scale_to(self.height);
        Ok(grown)
    }

    /// The plant, ready. `progress` hears of shares done, 0..=1.
    ///
    /// # Errors
    /// Numbers out of range, or no memory.
    pub fn specimen(&self, progress: &mut dyn FnMut(f32)) -> Result<Specimen, SpecimenError> {
        self.mesh()?.specimen(Size::Scale(1.0), progress)
    }
}
