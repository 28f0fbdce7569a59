//! What a window remembers from one time to the next.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Where it is kept among what eframe keeps.
pub const KEY: &str = "sward";

/// What is remembered. What is missing in what was written by an older sward has its usual value.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Remembered {
    /// Pixels drawn for each of the window's.
    pub fineness: Option<f32>,
    /// Share of the distance up to which every plant is drawn.
    pub near: Option<f32>,
    /// Whether cells move on the graphics device.
    pub on_gpu: bool,
    /// The scene that was open: a shipped one's name, or a file's path.
    pub scene: Option<String>,
    /// Whether curves are shown: milliseconds, the probe.
    pub curves: [bool; 2],
    /// One's own presets: names, and scenes.
    pub presets: BTreeMap<String, String>,
}
