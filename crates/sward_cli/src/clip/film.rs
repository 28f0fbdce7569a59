//! From frames in files to the file of a clip.

use std::fs::File;
use std::path::Path;

use sward_clip::{Clip, ClipError};

use crate::console::Console;
use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;

/// Encoded frames, and the clip before it is whole. An interrupted clip's are removed with all that is unfinished.
const UNFINISHED: [&str; 2] = [".frames.samples.part", ".frames.clip.part"];

/// Encodes `frames`, which are pictures of `size` pixels, `rate` a second, to `file`. `folder` is for what is unfinished, on the same disk.
///
/// # Errors
/// A frame is no picture of that size; the encoder fails; the disk is full.
pub(super) fn write(frames: &[&Path], size: [u32; 2], rate: u32, (folder, file): (&Path, &Path), console: &Console) -> Result<(), Failure> {
    let [samples, whole] = UNFINISHED.map(|name| folder.join(name));
    let failed = |error: ClipError| match error {
        ClipError::File(error) => output::cannot_write(file, &error),
        error => Failure::failed(error.to_string()),
    };
    let open = |path: &Path| {
        File::options().read(true).write(true).create(true).truncate(true).open(path).map_err(|error| output::cannot_write(path, &error))
    };
    let mut clip = Clip::new(size, rate, open(&samples)?).map_err(failed)?;
    let mut progress = Progress::new(frames.len() as u64, "frames encoded", console);
    for frame in frames {
        clip.push(&pixels(frame, size)?).map_err(failed)?;
        progress.advance();
    }
    clip.finish(open(&whole)?).map_err(failed)?;
    std::fs::rename(&whole, file).map_err(|error| output::cannot_write(file, &error))
}

/// A frame in RGB.
fn pixels(frame: &Path, [width, height]: [u32; 2]) -> Result<Vec<u8>, Failure> {
    let unfit = |why: String| {
        let help = "remove it and type the same once more with --resume: it is drawn again";
        Failure::failed(format!("{} {why}", frame.display())).help(help)
    };
    let picture = image::open(frame).map_err(|error| unfit(format!("cannot be read: {error}")))?.into_rgb8();
    if picture.dimensions() != (width, height) {
        return Err(unfit(format!("is not of {width}x{height} pixels")));
    }
    Ok(picture.into_raw())
}
