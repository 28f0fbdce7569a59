//! Inputs with the steps before which they came: a run can be told by them alone, and happens again to the bit.

use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};

use super::Input;
use crate::model::Assets;
use crate::scene::{self, SceneError};
use crate::view::View;
use crate::world::World;

/// The format of logs that this version writes and reads.
const VERSION: u32 = 1;

/// What hosts did to a world.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Log {
    /// Format version.
    version: u32,
    /// Each input with the steps done before it, in order.
    pub inputs: Vec<(u64, Input)>,
    /// Steps done in the end.
    pub steps: u64,
    /// The host's camera, as last written down.
    #[serde(skip)]
    pub(super) seen: Option<View>,
    /// What was pinned, likewise.
    #[serde(skip)]
    pub(super) pinned: Vec<[f64; 2]>,
}

/// Why a log cannot be replayed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LogError {
    /// It is not one.
    #[error("line {line}, column {column}: {message}")]
    Text {
        /// Where, from 1.
        line: usize,
        /// Where, from 1.
        column: usize,
        /// What is wrong there.
        message: String,
    },
    /// Of another version of the format.
    #[error("this log has format version {0}, expected {VERSION}: record it again with this sward")]
    Version(u32),
    /// An input does not fit the world: that is not the one it was recorded from.
    #[error("before step {step}: {error}")]
    Input {
        /// Steps done.
        step: u64,
        /// Why not.
        error: Box<SceneError>,
    },
}

impl Log {
    /// The log as text that [`Log::parse`] reads back as an equal log.
    #[must_use]
    pub fn to_ron(&self) -> String {
        // Writing into a string fails only beyond the recursion limit, which no input reaches.
        scene::options().to_string_pretty(self, PrettyConfig::new().new_line("\n").depth_limit(2)).unwrap_or_default() + "\n"
    }

    /// Reads a log.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn parse(text: &str) -> Result<Self, LogError> {
        let log: Self = scene::options().from_str(text).map_err(|error| LogError::Text {
            line: error.span.start.line,
            column: error.span.start.col,
            message: error.code.to_string(),
        })?;
        if log.version != VERSION {
            return Err(LogError::Version(log.version));
        }
        Ok(log)
    }

    /// What came after so many steps, in order.
    pub fn due(&self, step: u64) -> impl Iterator<Item = &Input> {
        self.inputs.iter().filter(move |(at, _)| *at == step).map(|(_, input)| input)
    }

    /// Lets a world, which is where the log begins, do all of it again; `each` sees it after every step. Where a GPU steps, do what is [`Log::due`]
    /// ([`World::apply`]) before each step instead.
    ///
    /// # Errors
    /// An input that does not fit the world; it is where that happened.
    pub fn replay(&self, world: &mut World, assets: &dyn Assets, each: &mut dyn FnMut(&World)) -> Result<(), LogError> {
        let mut inputs = self.inputs.iter().peekable();
        loop {
            let step = world.state.step;
            while let Some((_, input)) = inputs.next_if(|(at, _)| *at <= step) {
                world.apply(input, assets).map_err(|error| LogError::Input { step, error: Box::new(error) })?;
            }
            if step >= self.steps {
                return Ok(());
            }
            world.step();
            each(world);
        }
    }
}

impl World {
    /// Writes down from now on what hosts do to the world, in [`World::log`]; what was written down before is forgotten.
    pub fn record(&mut self) {
        self.log = Some(Log { version: VERSION, steps: self.state.step, pinned: self.state.pinned.clone(), ..Log::default() });
    }
}
