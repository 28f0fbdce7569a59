//! A world as bytes with all that it needs besides files: its scene as it has become, and its state.
//!
//! `SWARDWORLD`, length of the scene's text (u64), the text, then the state as [`World::save`] has it.

use crate::model::Assets;
use crate::saved::SavedError;
use crate::scene::{Scene, SceneError};
use crate::world::World;

const MAGIC: &[u8; 10] = b"SWARDWORLD";

/// Why a saved world cannot be loaded.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LoadError {
    /// The bytes are something else.
    #[error("this is not a saved world: it does not begin with SWARDWORLD")]
    NotOne,
    /// Cut off or changed.
    #[error("this saved world is damaged: {0}")]
    Damaged(&'static str),
    /// Its scene cannot be opened, or a file that it names.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Its state is none.
    #[error(transparent)]
    State(#[from] SavedError),
}

impl World {
    /// The world as bytes: its scene with all bodies, wind and responses as they are now, and its state. Where a GPU steps, download its cells first.
    pub fn save_world(&self) -> Vec<u8> {
        let text = self.scene.to_ron();
        let length = (text.len() as u64).to_le_bytes();
        self.save_after([&MAGIC[..], &length, text.as_bytes()].concat())
    }

    /// A world that goes on as the saved one would have, to the bit. Files that its scene names come from `assets`.
    ///
    /// # Errors
    /// Something else than a saved world, damage, another version, or a file that is missing.
    pub fn load(bytes: &[u8], assets: &dyn Assets) -> Result<Self, LoadError> {
        let rest = bytes.strip_prefix(MAGIC).ok_or(LoadError::NotOne)?;
        let damaged = || LoadError::Damaged("it ends too soon");
        let (length, rest) = rest.split_first_chunk::<8>().ok_or_else(damaged)?;
        let length = usize::try_from(u64::from_le_bytes(*length)).ok().filter(|length| *length <= rest.len()).ok_or_else(damaged)?;
        let (text, state) = rest.split_at(length);
        let text = std::str::from_utf8(text).map_err(|_| LoadError::Damaged("its scene is not text"))?;
        let mut world = Self::compiled(Scene::parse(text, "saved world")?, assets)?;
        world.restore(state)?;
        Ok(world)
    }
}
