//! What hosts do to a world between two steps: as calls, and as data that can be kept, sent and replayed.
//!
//! | file | what |
//! |---|---|
//! | `bodies` | bodies come, go, jump, take other paths |
//! | `wind` | sources of wind come, go, change |
//! | `tuning` | responses glide to other numbers |
//! | `growth` | what grows is cut, burnt, grows again |
//! | `log` | inputs with their steps, recorded and replayed |

mod bodies;
mod growth;
mod log;
mod tuning;
mod wind;

use serde::{Deserialize, Serialize};

use super::World;
use crate::model::Assets;
use crate::scene::{Edit, Interactor, Path, Response, Scene, SceneError, WindSource};
use crate::view::View;
pub use log::{Log, LogError};

/// Longest that a change takes, s.
const LONGEST: f64 = 3600.0;

/// Whole steps of so many seconds; none of what is no time.
fn steps_of(seconds: f64, dt: f64) -> u64 {
    let seconds = if seconds > 0.0 { seconds } else { 0.0 };
    ((if seconds < LONGEST { seconds } else { LONGEST }) / dt).round() as u64
}

/// Something that a host does to a world between two steps. Each stands for the call of the same name, which says more.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Input {
    /// [`World::add_body`].
    AddBody(Interactor),
    /// [`World::remove_body`].
    RemoveBody(usize),
    /// [`World::lead`].
    Lead {
        /// Its number.
        body: usize,
        /// Its new path.
        path: Path,
    },
    /// [`World::drive`].
    Drive {
        /// Its number.
        body: usize,
        /// Ground position, m.
        at: [f64; 2],
        /// Turn about +y, rad.
        yaw: f64,
        /// Height above the ground, m.
        clearance: f64,
    },
    /// [`World::teleport`].
    Teleport {
        /// Its number.
        body: usize,
        /// Ground position, m.
        at: [f64; 2],
        /// Turn about +y, rad.
        yaw: f64,
        /// Height above the ground, m.
        clearance: f64,
    },
    /// [`World::take_over`].
    TakeOver(usize),
    /// [`World::add_wind`].
    AddWind {
        /// What blows.
        source: WindSource,
        /// Seconds until it is at its strength.
        fade: f64,
    },
    /// [`World::change_wind`].
    ChangeWind {
        /// Its number.
        wind: usize,
        /// What blows instead.
        source: WindSource,
        /// Seconds from one to the other.
        fade: f64,
    },
    /// [`World::remove_wind`].
    RemoveWind {
        /// Its number.
        wind: usize,
        /// Seconds until it is gone.
        fade: f64,
    },
    /// [`World::tune`].
    Tune {
        /// Its number in the scene.
        stand: usize,
        /// The same method with other numbers.
        response: Response,
        /// Seconds until they hold.
        over: f64,
    },
    /// [`World::edit`].
    Edit(Edit),
    /// [`State::pinned`](crate::state::State::pinned): places to care about, m; none: the camera's.
    Pin(Vec<[f64; 2]>),
    /// [`World::viewed`]: the host's camera; `None` is the scene's.
    View(Option<View>),
    /// [`World::rescene`], with a scene as its author wrote it.
    Scene(Box<Scene>),
}

impl World {
    /// Does what an input says. Returns the number of the body or source of wind that has come.
    ///
    /// # Errors
    /// As the call of the same name; so, too, where that would answer that there is no such body or source.
    pub fn apply(&mut self, input: &Input, assets: &dyn Assets) -> Result<Option<usize>, SceneError> {
        let done = |done: bool, what: &str, number: usize| {
            if done { Ok(None) } else { Err(SceneError::in_file("", format!("there is no {what} number {number} to do this to"))) }
        };
        match input.clone() {
            Input::AddBody(body) => return self.add_body(body, assets).map(Some),
            Input::RemoveBody(body) => return done(self.remove_body(body), "body", body),
            Input::Lead { body, path } => self.lead(body, path)?,
            Input::Drive { body, at, yaw, clearance } => return done(self.drive(body, at, yaw, clearance), "driven body", body),
            Input::Teleport { body, at, yaw, clearance } => return done(self.teleport(body, at, yaw, clearance), "body", body),
            Input::TakeOver(body) => return done(self.take_over(body).is_some(), "body", body),
            Input::AddWind { source, fade } => return self.add_wind(source, fade, assets).map(Some),
            Input::ChangeWind { wind, source, fade } => return self.change_wind(wind, source, fade, assets).map(Some),
            Input::RemoveWind { wind, fade } => return done(self.remove_wind(wind, fade), "source of wind", wind),
            Input::Tune { stand, response, over } => self.tune(stand, response, over)?,
            Input::Edit(edit) => self.edit(&edit)?,
            Input::Pin(places) => self.state.pinned = places,
            Input::View(view) => self.viewed = view,
            Input::Scene(scene) => {
                self.rescene(*scene, assets)?;
            }
        }
        Ok(None)
    }

    /// Writes an input down, where they are recorded.
    pub(super) fn note(&mut self, input: impl FnOnce() -> Input) {
        let step = self.state.step;
        if let Some(log) = &mut self.log {
            log.inputs.push((step, input()));
        }
    }

    /// Writes down where the host's camera is, and what is pinned, if that has changed: both are set without a call.
    pub(super) fn note_view(&mut self) {
        let Some(log) = &mut self.log else { return };
        if log.seen != self.viewed {
            log.seen = self.viewed;
            log.inputs.push((self.state.step, Input::View(self.viewed)));
        }
        if log.pinned != self.state.pinned {
            log.pinned = self.state.pinned.clone();
            log.inputs.push((self.state.step, Input::Pin(self.state.pinned.clone())));
        }
        log.steps = self.state.step + 1;
    }
}
