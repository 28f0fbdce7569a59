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
use crate::fingerprint::Fingerprint;
use crate::output;
use crate::scenes::Opened;

const SETTINGS: &str = "frames.json";
const STATE: &str = "frames.state";
/// Format version of the settings.
const VERSION: u32 = 1;

/// What all frames of a folder have in common.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Settings {
    /// Format version of the file: 1.
    version: u32,
    /// Name of the scene.
    scene: String,
    /// A hash of what its author wrote, and of the files it names.
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
    pub(crate) fn new(opened: &Opened, fingerprint: Fingerprint, size: [u32; 2], fps: u32, aov: Option<&Outputs>) -> Self {
        let [width, height] = size;
        Self {
            version: VERSION,
            scene: opened.name.clone(),
            fingerprint: fingerprint.to_string(),
            width,
            height,
            frames_per_second: fps,
            aov: aov.map(|aov| aov.description().clone()),
        }
    }

    /// Those of an earlier run; `None` where there was none.
    fn read(path: &Path) -> Result<Option<Self>, Failure> {
        let help = "without --resume the sequence begins anew";
        let refuse = |why: String| Failure::input(format!("{} does not say what frames lie beside it: {why}", path.display()), help);
        let text = match std::fs::read_to_string(path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(refuse(error.to_string())),
            Ok(text) => text,
        };
        // The version first: other fields may be others in another one.
        let parsed = serde_json::from_str(&text).and_then(|value: serde_json::Value| {
            let version = value.get("version").and_then(serde_json::Value::as_u64);
            if version == Some(VERSION.into()) { Self::deserialize(value).map(Ok) } else { Ok(Err(version)) }
        });
        match parsed {
            Ok(Ok(settings)) => Ok(Some(settings)),
            Ok(Err(Some(version))) => Err(refuse(format!("it has format version {version}, expected {VERSION}"))),
            Ok(Err(None)) => Err(refuse(format!("it has no format version, expected \"version\": {VERSION}"))),
            Err(error) => Err(refuse(error.to_string())),
        }
    }

    /// What differs from those of another sequence, in words.
    fn difference(&self, other: &Self) -> Option<String> {
        let size = |settings: &Self| format!("{}x{}", settings.width, settings.height);
        if self.scene != other.scene {
            return Some(format!("they show `{}`", other.scene));
        }
        if self.fingerprint != other.fingerprint {
            return Some(format!("`{}` or a file it names has been changed since", self.scene));
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
    /// Whether frames of an earlier run are not drawn again.
    resume: bool,
    /// Whether frames of an earlier run are of this sequence.
    agrees: bool,
}

impl Checkpoint {
    /// Looks at the folder; writes nothing.
    ///
    /// # Errors
    /// With `resume`: the folder holds frames of another sequence, or of which nothing is known.
    pub(crate) fn open(folder: &Path, settings: Settings, every: f64, resume: bool) -> Result<Self, Failure> {
        let found = Settings::read(&folder.join(SETTINGS));
        let agrees = matches!(&found, Ok(Some(found)) if settings.difference(found).is_none());
        if resume && !agrees {
            let shown = folder.display();
            if let Some(difference) = found?.and_then(|found| settings.difference(&found)) {
                let help = "type what was typed then, or another folder: -o DIR/";
                return Err(Failure::input(format!("the frames in {shown} are of another sequence: {difference}"), help));
            }
            if folder.join(STATE).exists() || !output::frames(folder)?.is_empty() {
                let help = "without --resume the sequence begins anew, and these frames are removed; or type another folder: -o DIR/";
                return Err(Failure::input(format!("there are frames in {shown}, but no {SETTINGS} says what they are of"), help));
            }
        }
        let every = Duration::try_from_secs_f64(every).unwrap_or(Duration::MAX);
        Ok(Self { folder: folder.to_owned(), settings, every, saved: Instant::now(), resume, agrees })
    }

    /// Makes the folder ready: clears away what an interrupted run left unfinished and frames of other sequences, which no later run shall
    /// take for this one's, and says what its frames will be.
    ///
    /// # Errors
    /// The folder cannot be written to.
    pub(crate) fn begin(&self) -> Result<(), Failure> {
        output::remove_unfinished(&self.folder)?;
        if !self.resume {
            output::remove(&self.folder.join(STATE))?;
        }
        // Before the settings: whoever interrupts this leaves other settings, or none, beside what is left of those frames.
        if !self.agrees {
            output::remove_frames(&self.folder)?;
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
        if !self.resume {
            return Ok(());
        }
        let help = format!("remove {}: the steps are then run again", path.display());
        let refuse = |why: String| Failure::input(format!("{}: {why}", path.display()), help);
        let bytes = match std::fs::read(&path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(()),
            Err(error) => return Err(refuse(error.to_string())),
            Ok(bytes) => bytes,
        };
        let mut later = world.clone();
        if let Err(error) = later.restore(&bytes) {
            return Err(refuse(error.to_string()));
        }
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

/// Removes a sequence whose clip is whole, and its folder if nothing else is in it.
///
/// # Errors
/// A file cannot be removed.
pub(crate) fn remove_sequence(folder: &Path) -> Result<(), Failure> {
    output::remove_unfinished(folder)?;
    output::remove_frames(folder)?;
    output::remove(&folder.join(SETTINGS))?;
    // What others put there stays, and so does the folder.
    let _ = std::fs::remove_dir(folder);
    Ok(())
}
