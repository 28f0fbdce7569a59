//! The light among a scene's plants, worked out once: what goes in ([`Inputs`]), how ([`transport`]), and how it is kept ([`Store`]).
//!
//! Orthmann et al. 2009, §6.1: ambient occlusion of the scene in a volume, and irradiance "determined by sampling an environment map by
//! using the previously computed ambient occlusion information". The volume is [`crate::shading::volume`].
//!
//! Differs from the paper: plants are a haze of leaves of the density that their pictures have, not triangles, so that no ray can miss
//! them and no noise is left; what leaves and ground send on of the light is followed [`transport::BOUNCES`] times; the sun is kept apart.

mod inputs;
mod leaves;
mod relief;
mod room;
mod stored;
pub mod transport;
mod uniform;

use std::sync::Arc;

pub use inputs::Inputs;
pub use room::Room;
pub use stored::{StoredError, key_name};
pub use uniform::AmbientUniform;

use crate::shading::environment::Environment;
use crate::shading::volume::Volume;
pub use crate::store::{Found, NoStore, Store};
use crate::world::World;

/// The light of a scene with surroundings.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// The surroundings.
    pub environment: Arc<Environment>,
    /// What of their light arrives among the plants.
    pub volume: Volume,
}

impl Lighting {
    /// The light of a world; `None` where it has no surroundings.
    pub fn of(world: &World) -> Option<Self> {
        Self::stored(world, &NoStore, &mut |_| ()).map(|(lighting, _)| lighting)
    }

    /// The light of a world, from a store if it is there, else worked out and stored. `progress` hears of shares done, 0..=1. What is
    /// stored is named by a hash of all that goes in; a damaged file, or one of another version, is made anew.
    pub fn stored(world: &World, store: &dyn Store, progress: &mut dyn FnMut(f32)) -> Option<(Self, Found)> {
        let environment = Arc::clone(world.model.environment.as_ref()?);
        let inputs = Inputs::of(world)?;
        let key = inputs.key();
        let (mut found, name) = (Found::default(), key_name(key));
        let kept = match store.load(&name) {
            Ok(bytes) => bytes.map(|bytes| stored::read(&inputs, key, &bytes)),
            Err(why) => {
                found.trouble.push(why);
                None
            }
        };
        match kept {
            Some(Ok(volume)) => return Some((Self { environment, volume }, Found { stored: true, ..found })),
            Some(Err(error)) => found.trouble.push(format!("{name}: {error}")),
            None => (),
        }
        let volume = transport::volume(&inputs, progress);
        found.trouble.extend(store.save(&name, &stored::bytes(key, &volume)).err());
        Some((Self { environment, volume }, found))
    }
}
