//! A hash of a scene and of every file it names: whether the same would be simulated again.

use std::cell::{Cell, RefCell};
use std::fmt;

use sward::model::Assets;
use sward::scene::Scene;
use sward::store::Store;

use crate::cache::Cache;
use crate::console::Console;
use crate::progress::Progress;

/// Parts in which progress is told.
const PARTS: u64 = 100;

/// FNV-1a of 64 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    /// That of a scene without files.
    pub(crate) fn of(scene: &Scene) -> Self {
        Self(0xcbf2_9ce4_8422_2325).and(format!("{scene:?}").as_bytes())
    }

    fn and(self, bytes: &[u8]) -> Self {
        Self(bytes.iter().fold(self.0, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)))
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// Files whose bytes are taken into a fingerprint as they are read.
pub(crate) struct Witness<'a> {
    assets: &'a dyn Assets,
    seen: Cell<Fingerprint>,
    cache: &'a Cache,
    console: &'a Console,
    /// What takes long, how many of its parts are done, and the bar that tells.
    long: RefCell<Option<(&'static str, u64, Progress)>>,
}

impl<'a> Witness<'a> {
    /// Of a scene's files.
    pub(crate) fn new(scene: &Scene, assets: &'a dyn Assets, cache: &'a Cache, console: &'a Console) -> Self {
        Self { assets, seen: Cell::new(Fingerprint::of(scene)), cache, console, long: RefCell::default() }
    }

    /// The fingerprint so far.
    pub(crate) fn seen(&self) -> Fingerprint {
        self.seen.get()
    }
}

impl Assets for Witness<'_> {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        let bytes = self.assets.read(path)?;
        let length = (bytes.len() as u64).to_le_bytes();
        self.seen.set(self.seen.get().and(path.as_bytes()).and(&length).and(&bytes));
        Ok(bytes)
    }

    fn store(&self) -> &dyn Store {
        self.cache
    }

    fn progress(&self, what: &'static str, share: f32) {
        let mut long = self.long.borrow_mut();
        if long.as_ref().is_none_or(|(other, done, _)| *other != what || *done == PARTS) {
            *long = Some((what, 0, Progress::new(PARTS, what, self.console)));
        }
        if let Some((_, done, bar)) = &mut *long {
            while *done < (share * PARTS as f32) as u64 {
                bar.advance();
                *done += 1;
            }
        }
    }

    fn note(&self, trouble: &str) {
        self.console.note(trouble);
    }
}
