//! What clip was asked for. Everything that can be wrong with it is said before anything runs.

use std::ops::Range;
use std::path::{Path, PathBuf};

use sward_clip::ClipError;

use super::RATE;
use crate::arguments::{self, LAST_FRAME};
use crate::failure::Failure;
use crate::output;
use crate::scenes::Opened;

/// How long a clip goes on after the moment that suits a picture of the scene, s.
const AFTERWARDS: f64 = 2.0;

/// A clip to make.
pub(super) struct Wanted {
    /// Its place.
    pub(super) file: PathBuf,
    /// Where its frames lie until it is whole.
    pub(super) folder: PathBuf,
    /// Its frames; frame 0 is time 0.
    pub(super) frames: Range<u32>,
    /// Frames a second.
    pub(super) rate: u32,
}

/// Whether a clip is meant, rather than a picture or a folder.
///
/// # Errors
/// What was typed contradicts itself.
pub(crate) fn is_wanted(arguments: &arguments::Render, opened: &Opened) -> Result<bool, Failure> {
    let name = &opened.name;
    if arguments.clip || arguments.output.as_deref().is_some_and(|path| output::ends_in(path, "mp4") && !path.is_dir()) {
        if arguments.aov.is_empty() {
            return Ok(true);
        }
        let help = format!("type --frames A..B -o {name}_frames/ for frames with outputs beside them");
        return Err(Failure::input("--aov writes beside pictures, and a clip keeps none", help));
    }
    if arguments.seconds.is_some() {
        let help = format!("type -o {name}.mp4 for a clip, or --frames A..B for a folder of frames");
        return Err(Failure::input("--seconds is the length of a clip, and none was asked for", help));
    }
    // One picture with motion has a frame before it, too.
    let paced = arguments.fps.is_some() && arguments.aov.is_empty();
    let alone = [("--fps", paced), ("--resume", arguments.resume), ("--save-every", arguments.save_every.is_some())];
    if arguments.frames.is_none()
        && let Some((option, _)) = alone.iter().find(|(_, given)| *given)
    {
        let help = format!("type -o {name}.mp4 for a clip, or --frames A..B for a folder of frames");
        return Err(Failure::input(format!("{option} is for a clip or a sequence, and one picture was asked for"), help));
    }
    Ok(false)
}

impl Wanted {
    /// The clip that was asked for.
    ///
    /// # Errors
    /// It cannot be made.
    pub(super) fn new(arguments: &arguments::Render, opened: &Opened) -> Result<Self, Failure> {
        let file = output::clip(arguments.output.as_deref(), &opened.name)?;
        if arguments.time.is_some() {
            let picture = file.with_extension("png");
            let help = format!("type -o {} for a picture, or --seconds S for how long the clip lasts", picture.display());
            return Err(Failure::input(format!("--time is the moment of a picture, but {} is a clip", file.display()), help));
        }
        check_size(arguments.size)?;
        let rate = arguments.fps.unwrap_or(RATE);
        let frames = match &arguments.frames {
            Some(frames) => frames.clone(),
            None => 0..count(arguments.seconds.unwrap_or(opened.time + AFTERWARDS), rate)?,
        };
        let folder = beside(&file);
        output::folder(&folder, false)?;
        Ok(Self { file, folder, frames, rate })
    }
}

/// The folder of a clip's frames: hello.mp4.frames beside hello.mp4.
fn beside(file: &Path) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(".frames");
    name.into()
}

/// Frames of a clip of so many seconds.
fn count(seconds: f64, rate: u32) -> Result<u32, Failure> {
    let frames = (seconds * f64::from(rate)).round();
    if frames < 1.0 {
        let help = format!("type at least --seconds {}", (1e4 / f64::from(rate)).ceil() / 1e4);
        return Err(Failure::input(format!("{seconds} s hold no frame at {rate} a second"), help));
    }
    if frames > f64::from(LAST_FRAME) {
        let help = format!("type at most --seconds {}, or a lower --fps", LAST_FRAME / rate);
        return Err(Failure::input(format!("{seconds} s are {frames} frames, but frames go up to {LAST_FRAME}"), help));
    }
    Ok(frames as u32)
}

fn check_size([width, height]: [u32; 2]) -> Result<(), Failure> {
    let even = |side: u32, least: u32| side.max(least).saturating_add(1) / 2 * 2;
    sward_clip::check([width, height]).map_err(|error| {
        let help = match &error {
            ClipError::TooLarge { .. } => "type a smaller --size, like 3840x2160".to_owned(),
            ClipError::TooSmall { least, .. } => format!("type --size {}x{}", even(width, *least), even(height, *least)),
            _ => format!("type --size {}x{}", even(width, 2), even(height, 2)),
        };
        Failure::input(error.to_string(), help)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_become_whole_frames() {
        assert_eq!(
            [(8.2, 24), (1.0, 30), (0.04, 24), (0.03, 24)].map(|(seconds, rate)| count(seconds, rate).ok()),
            [Some(197), Some(30), Some(1), Some(1)]
        );
        assert!(count(0.0, 24).is_err() && count(0.0004, 1000).is_err() && count(1e6, 24).is_err());
        let least = 0.0417;
        assert_eq!(count(least, 24).ok(), Some(1), "what is advised is accepted");
    }

    #[test]
    fn frames_lie_beside_the_clip() {
        assert_eq!(beside(Path::new("films/hello.mp4")), Path::new("films/hello.mp4.frames"));
    }
}
