//! What a script may ask of the window: one line of JSON after every picture.

use std::io::Write;
use std::path::PathBuf;

use serde::Serialize;

use crate::marks::Marks;

/// A body, as scripts see it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Where it is, m; `None` while it is away.
    pub at: Option<[f64; 2]>,
    /// Bend of the plants of the first stand that has some there, rad.
    pub bend: Option<[f32; 2]>,
    /// The same where it was a second and a half before; `None` where it has not moved away from there.
    pub track: Option<[f32; 2]>,
    /// The same far enough to the side of that place that it never touched it.
    pub beside: Option<[f32; 2]>,
}

/// What one who drives does, as scripts see it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Wheel {
    /// Heading, rad.
    pub yaw: f64,
    /// Along its heading, m/s.
    pub speed: f64,
    /// Between where it points and where it goes, rad.
    pub drift: f64,
}

/// What the window shows.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Status {
    /// The scene's name; empty while none is there yet.
    pub scene: String,
    /// Steps since its beginning.
    pub step: u64,
    /// The step that the picture shows.
    pub drawn: Option<u64>,
    /// The camera.
    pub camera: &'static str,
    /// From the camera to what it looks at, m.
    pub away: f64,
    /// Where cells move.
    pub backend: &'static str,
    /// Whether time stands still.
    pub paused: bool,
    /// The body at whose wheel somebody is.
    pub driving: Option<String>,
    /// Heading and speed of the body that is driven.
    pub wheel: Option<Wheel>,
    /// Bodies.
    pub bodies: Vec<Body>,
    /// What the last picture kept the window from answering for, ms: all of it, and without handing the picture to the driver, which may wait for the
    /// device.
    pub busy: [f64; 2],
    /// The longest of the second since the scene was there, ms.
    pub longest: f64,
    /// What is wrong.
    pub problem: Option<String>,
    /// What went well.
    pub notice: Option<String>,
    /// Pictures shown.
    pub pictures: u64,
    /// Whether something is being made ready.
    pub loading: bool,
    /// Whether there are two pictures side by side.
    pub split: bool,
    /// What overlays say.
    pub looked: Vec<String>,
    /// How far plants lean at the probe, rad.
    pub probe: Option<f64>,
    /// Where things are in the window.
    pub marks: Marks,
}

/// Where lines go.
#[derive(Debug)]
pub enum Log {
    /// To a file, which holds the last line only.
    File(PathBuf),
    /// To scripts of a page.
    #[cfg(target_arch = "wasm32")]
    Page,
}

impl Log {
    /// To a file, which holds the last line only.
    pub fn new(path: PathBuf) -> Self {
        Self::File(path)
    }

    /// Writes one.
    ///
    /// # Errors
    /// What the system says.
    pub fn write(&self, status: &Status) -> std::io::Result<()> {
        let path = match self {
            Self::File(path) => path,
            #[cfg(target_arch = "wasm32")]
            Self::Page => {
                crate::page::publish(&serde_json::to_string(status)?);
                return Ok(());
            }
        };
        // A reader sees the line before or this one, never half of it.
        let beside = path.with_extension("part");
        let mut file = std::fs::File::create(&beside)?;
        serde_json::to_writer(&mut file, status)?;
        file.write_all(b"\n")?;
        std::fs::rename(beside, path)
    }
}
