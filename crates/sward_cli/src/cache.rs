//! Volumes of light and plants kept from run to run: files in the platform's cache folder, or in one of the user's choice.

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use sward::picture::volume::Lighting;
use sward::store::Store;
use sward::world::World;

use crate::arguments::Caching;
use crate::console::Console;
use crate::progress::Progress;

/// A larger file is no volume, bytes: 128 × 128 × 32 voxels take 25 MB.
const LARGEST: u64 = 32 << 20;
/// A larger file is no plant, bytes: 64 million triangles with three vertices each take 7.3 GB.
const LARGEST_PLANT: u64 = 8 << 30;
/// Parts in which progress is told.
const PARTS: u64 = 100;

/// A folder of volumes and plants.
#[derive(Clone, Debug)]
pub(crate) struct Cache {
    /// `None` keeps nothing.
    folder: Option<PathBuf>,
}

impl Cache {
    /// As the user says; without a word the platform's cache folder, where there is one.
    pub(crate) fn new(wanted: &Caching) -> Self {
        if wanted.no_cache {
            return Self { folder: None };
        }
        Self { folder: wanted.cache.clone().or_else(|| dirs::cache_dir().map(|folder| folder.join("sward"))) }
    }

    /// The light of a world that has surroundings: stored, or worked out and stored. Trouble with files is told and no more: the picture
    /// does not depend on them.
    pub(crate) fn lighting(&self, world: &World, console: &Console) -> Option<Lighting> {
        world.model.environment.as_ref()?;
        let mut progress = Progress::new(PARTS, "parts of the light", console);
        let mut done = 0;
        let mut tell = |share: f32| {
            while done < (share * PARTS as f32) as u64 {
                progress.advance();
                done += 1;
            }
        };
        let (lighting, found) = Lighting::stored(world, self, &mut tell)?;
        drop(progress);
        for trouble in found.trouble {
            console.note(&format!("{trouble}; the light was worked out anew"));
        }
        Some(lighting)
    }
}

impl Store for Cache {
    fn load(&self, name: &str) -> Result<Option<Vec<u8>>, String> {
        let Some(folder) = &self.folder else { return Ok(None) };
        let path = folder.join(name);
        let file = match File::open(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            file => file.map_err(|error| told("read", &path, &error))?,
        };
        let mut bytes = Vec::new();
        let most = if name.ends_with(".plant") { LARGEST_PLANT } else { LARGEST };
        file.take(most).read_to_end(&mut bytes).map_err(|error| told("read", &path, &error))?;
        Ok(Some(bytes))
    }

    fn save(&self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let path = folder.join(name);
        let partial = folder.join(format!(".{name}.{}.part", std::process::id()));
        let written = std::fs::create_dir_all(folder)
            .and_then(|()| File::create(&partial))
            .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()))
            .and_then(|()| std::fs::rename(&partial, &path));
        written.map_err(|error| {
            // The first error is the one to tell.
            let _ = std::fs::remove_file(&partial);
            told("keep", &path, &error)
        })
    }
}

fn told(what: &str, path: &Path, error: &std::io::Error) -> String {
    format!("cannot {what} {}: {error} (--cache FOLDER names another place, --no-cache none)", path.display())
}
