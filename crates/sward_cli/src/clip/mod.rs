//! Clips: a film as one file, which `sward_clip` encodes.
//!
//! Frames are drawn first, as a sequence in a folder beside the clip, so that an interrupted clip goes on like an interrupted sequence.
//! Then they are encoded, and the folder goes. The clip gets its name when it is whole.

mod film;
mod wanted;

use std::path::Path;
use std::time::Instant;

use crate::arguments;
use crate::cache::Cache;
use crate::checkpoint::{self, Checkpoint, Settings};
use crate::commands::render;
use crate::console::Console;
use crate::failure::Failure;
use crate::scenes::Opened;

use wanted::Wanted;
pub(crate) use wanted::is_wanted;

/// Frames a second, if nothing else is asked for.
const RATE: u32 = 24;

/// Makes the clip that was asked for.
pub(crate) fn run(arguments: &arguments::Render, opened: &Opened, console: &Console) -> Result<(), Failure> {
    let Wanted { file, folder, frames, rate } = Wanted::new(arguments, opened)?;
    let (world, fingerprint) = opened.world_and_fingerprint(&Cache::new(&arguments.caching), console)?;
    let settings = Settings::new(opened, fingerprint, arguments.size, rate, None);
    let checkpoint = Checkpoint::open(&folder, settings, arguments.save_every(), arguments.resume)?;
    let shots = render::shots(opened, frames, rate, &folder);
    let sequence = Some((folder.clone(), checkpoint));
    let drawn = render::draw(
        world,
        &shots,
        sequence,
        None,
        arguments.size,
        (arguments.on, arguments.draw),
        &Cache::new(&arguments.caching),
        console,
    )?;
    let begun = Instant::now();
    let paths: Vec<&Path> = shots.iter().map(render::Shot::path).collect();
    film::write(&paths, arguments.size, rate, (&folder, &file), console)?;
    checkpoint::remove_sequence(&folder)?;
    let (seconds, count) = (begun.elapsed().as_secs_f64(), paths.len());
    let [width, height] = arguments.size;
    let kept = drawn.kept();
    console.summary(&format!(
        "{}: {}, {count} frames{kept}, {rate} a second, {width}x{height}; simulated on {}, drawn on {} in {:.1} s, encoded in {seconds:.1} s",
        file.display(),
        opened.name,
        drawn.on,
        drawn.artist,
        drawn.seconds,
    ))
}
