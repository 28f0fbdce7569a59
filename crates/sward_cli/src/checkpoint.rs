//! What a sequence of frames needs to go on after it was interrupted: the settings its frames depend on, and a state of the simulation.
//!
//! Both lie in the folder of the frames. Every file is whole or not there: it is written under another name and then renamed.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use sward::world::World;

use crate::aov::{Description, Outputs};
use crate::backend::Backend;
use crate::failure::Failure;
use crate::output;
use crate::scenes::Opened;

const SETTINGS: &str = "frames.json";
const STATE: &str = "frames.state";

/// What all frames of a folder have in common.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Settings {
    /// Name of the scene.
    scene: String,
    /// A hash of what its author wrote.
    fingerprint: String,
    width: u32,
    height: u32,
    frames_per_second: u32,
    /// Outputs of each pixel beside the frames.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    aov: Option<Description>,
}

impl Settings {
    /// Those of a sequence.
    pub(crate) fn new(opened: &Opened, size: [u32; 2], fps: u32, aov: Option<&Outputs>) -> Self {
        let words = format!("{:?}", opened.scene);
        let hash = words.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
        let [width, height] = size;
        Self {
            scene: opened.name.clone(),
            fingerprint: format!("{hash:016x}"),
            width,
            height,
            frames_per_second: fps,
            aov: aov.map(|aov| aov.description().clone()),
        }
    }

    /// What differs from those of another sequence, in words.
    fn difference(&self, other: &Self) -> Option<String> {
        let size = |settings: &Self| format!("{}x{}", settings.width, settings.height);
        if self.scene != other.scene {
            return Some(format!("they show `{}`", other.scene));
        }
        if self.fingerprint != other.fingerprint {
            return Some(format!("`{}` has been changed since", self.scene));
        }
        if size(self) != size(other) {
            return Some(format!("they are {} pixels", size(other)));
        }
        if self.frames_per_second != other.frames_per_second {
            return Some(format!("there are {} a second", other.frames_per_second));
        }
        (self.aov != other.aov).then(|| "other outputs of --aov lie beside them".to_owned())
    }
}

/// The folder of a sequence.
pub(crate) struct Checkpoint {
    folder: PathBuf,
    settings: Settings,
    /// Time between two saved states.
    every: Duration,
    saved: Instant,
    /// Whether frames of an earlier run are kept.
    resume: bool,
}

impl Checkpoint {
    /// Looks at the folder; writes nothing.
    ///
    /// # Errors
    /// With `resume`: the folder holds frames of another sequence.
    pub(crate) fn open(folder: &Path, settings: Settings, every: f64, resume: bool) -> Result<Self, Failure> {
        if resume && let Ok(text) = std::fs::read_to_string(folder.join(SETTINGS)) {
            let shown = folder.display();
            let found: Settings = serde_json::from_str(&text).map_err(|error| {
                let help = format!("without --resume the sequence begins anew; or remove {}", folder.join(SETTINGS).display());
                Failure::input(format!("{} does not say what frames lie beside it: {error}", folder.join(SETTINGS).display()), help)
            })?;
            if let Some(difference) = settings.difference(&found) {
                let help = "type what was typed then, or another folder: -o DIR/";
                return Err(Failure::input(format!("the frames in {shown} are of another sequence: {difference}"), help));
            }
        }
        let every = Duration::try_from_secs_f64(every).unwrap_or(Duration::MAX);
        Ok(Self { folder: folder.to_owned(), settings, every, saved: Instant::now(), resume })
    }

    /// Makes the folder ready: says what its frames will be, and clears away what an interrupted run left unfinished.
    ///
    /// # Errors
    /// The folder cannot be written to.
    pub(crate) fn begin(&self) -> Result<(), Failure> {
        output::remove_unfinished(&self.folder)?;
        if !self.resume {
            output::remove(&self.folder.join(STATE))?;
        }
        let text = serde_json::to_string_pretty(&self.settings).unwrap_or_default();
        output::write_whole(&self.folder.join(SETTINGS), |writer| writeln!(writer, "{text}"))
    }

    /// Whether a frame of these files needs not be drawn again.
    pub(crate) fn has<'a>(&self, mut files: impl Iterator<Item = &'a PathBuf>) -> bool {
        self.resume && files.all(|file| file.is_file())
    }

    /// Puts the world where an interrupted run left off, if that is not after step `before`.
    ///
    /// # Errors
    /// The saved state cannot be used.
    pub(crate) fn restore(&self, world: &mut World, before: u64) -> Result<(), Failure> {
        let path = self.folder.join(STATE);
        let Some(bytes) = self.resume.then(|| std::fs::read(&path).ok()).flatten() else { return Ok(()) };
        let mut later = world.clone();
        later.restore(&bytes).map_err(|error| {
            Failure::input(format!("{}: {error}", path.display()), format!("remove {}: the steps are then run again", path.display()))
        })?;
        if later.state.step <= before {
            *world = later;
        }
        Ok(())
    }

    /// Saves the state if the last one is old enough.
    ///
    /// # Errors
    /// The folder cannot be written to.
    pub(crate) fn save(&mut self, world: &mut World, backend: &mut Backend<'_>) -> Result<(), Failure> {
        if self.saved.elapsed() < self.every {
            return Ok(());
        }
        backend.fetch(world)?;
        let bytes = world.save();
        output::write_whole(&self.folder.join(STATE), |writer| writer.write_all(&bytes))?;
        self.saved = Instant::now();
        Ok(())
    }

    /// All frames are there: the state is needed no more.
    ///
    /// # Errors
    /// The state cannot be removed.
    pub(crate) fn finish(&self) -> Result<(), Failure> {
        output::remove(&self.folder.join(STATE))
    }
}
