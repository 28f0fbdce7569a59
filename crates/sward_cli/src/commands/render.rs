//! `sward render`: one picture, or a sequence of frames; clips are made of these in [`crate::clip`].

use std::fs::File;
use std::io::{BufWriter, Error};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Instant;

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use sward::picture::Picture;
use sward::world::World;

use crate::aov::{Memory, Outputs};
use crate::arguments::{self, Draw, Where};
use crate::artist::{self, Artist};
use crate::backend::Backend;
use crate::cache::Cache;
use crate::checkpoint::{Checkpoint, Settings};
use crate::clip;
use crate::console::Console;
use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;
use crate::scenes::{self, Opened};

/// Frames a second of a sequence, if nothing else is asked for.
const RATE: u32 = 30;

/// A picture to take.
pub(crate) struct Shot {
    /// The first step not before that moment.
    step: u64,
    /// How much of a step the moment lies before it.
    behind: f64,
    /// The moment of the frame before, likewise; of the first frame, its own.
    before: (u64, f64),
    /// Where it goes.
    path: PathBuf,
    /// Where its outputs of each pixel go.
    beside: Vec<PathBuf>,
}

impl Shot {
    /// A picture at a moment given in steps, as is that of the frame before.
    fn new(steps: f64, before: f64, path: PathBuf) -> Self {
        let (step, behind) = moment(steps);
        Self { step, behind, before: moment(before), path, beside: Vec::new() }
    }
}

impl Shot {
    /// Where it goes.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }
}

/// What was done, for the summary.
pub(crate) struct Done {
    /// What drew.
    pub(crate) artist: String,
    /// Where the simulation ran.
    pub(crate) on: String,
    /// Time of the work, s.
    pub(crate) seconds: f64,
    /// Frames of an earlier run that were kept.
    kept: usize,
}

impl Done {
    /// How many frames were there already, in words that follow `frames`.
    pub(crate) fn kept(&self) -> String {
        if self.kept == 0 { String::new() } else { format!(", {} of them there already", self.kept) }
    }
}

/// Draws what was asked for.
pub(crate) fn run(arguments: &arguments::Render, console: &Console) -> Result<(), Failure> {
    let opened = scenes::open(&arguments.scene)?;
    if clip::is_wanted(arguments, &opened)? {
        return clip::run(arguments, &opened, console);
    }
    let rate = opened.scene.steps_per_second;
    let (world, fingerprint) = opened.world_and_fingerprint(&Cache::new(&arguments.caching), console)?;
    let outputs = Outputs::new(&arguments.aov, arguments.aov_format, &world)?;
    let (mut shots, sequence, place) = match &arguments.frames {
        None => {
            let path = output::picture(arguments.output.as_deref(), &opened.name)?;
            if let Some(outputs) = &outputs {
                outputs.paths(&path).iter().chain([&Outputs::description_path(&path)]).try_for_each(|file| output::beside(file))?;
            }
            let shot = single(&opened, arguments.time, arguments.fps.unwrap_or(RATE), path.clone());
            (vec![shot], None, path)
        }
        Some(frames) => {
            let folder = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{}_frames", opened.name)));
            output::folder(&folder, true)?;
            let fps = arguments.fps.unwrap_or(RATE);
            let settings = Settings::new(&opened, fingerprint, arguments.size, fps, outputs.as_ref());
            let checkpoint = Checkpoint::open(&folder, settings, arguments.save_every(), arguments.resume)?;
            (shots(&opened, frames.clone(), fps, &folder), Some((folder.clone(), checkpoint)), folder)
        }
    };
    if let Some(outputs) = &outputs {
        shots.iter_mut().for_each(|shot| shot.beside = outputs.paths(&shot.path));
    }
    let done = draw(
        world,
        &shots,
        sequence,
        outputs.as_ref(),
        arguments.size,
        (arguments.on, arguments.draw),
        &Cache::new(&arguments.caching),
        console,
    )?;
    let [width, height] = arguments.size;
    let what = match (shots.len(), shots.last()) {
        (1, Some(shot)) => format!("at {:.2} s", (shot.step as f64 - shot.behind) / f64::from(rate)),
        (frames, _) => format!("{frames} frames{}", done.kept()),
    };
    let (place, Done { artist, on, seconds, .. }) = (place.display(), done);
    console.summary(&format!("{place}: {}, {what}, {width}x{height}; simulated on {on}, drawn on {artist} in {seconds:.1} s", opened.name))
}

/// One picture at `time` in seconds, or at the scene's own moment; the frame before would be one of `fps`.
pub(crate) fn single(opened: &Opened, time: Option<f64>, fps: u32, path: PathBuf) -> Shot {
    let rate = f64::from(opened.scene.steps_per_second);
    let steps = time.unwrap_or(opened.time) * rate;
    Shot::new(steps, (steps - rate / f64::from(fps)).max(0.0), path)
}

/// The frames of a sequence, in order of time.
pub(crate) fn shots(opened: &Opened, frames: Range<u32>, fps: u32, folder: &Path) -> Vec<Shot> {
    let rate = opened.scene.steps_per_second;
    let steps = |frame: u32| f64::from(frame) * f64::from(rate) / f64::from(fps);
    let shot = |frame: u32| Shot::new(steps(frame), steps(frame.saturating_sub(1)), folder.join(format!("frame_{frame:04}.png")));
    frames.map(shot).collect()
}

/// The first whole step not before a moment given in steps, and how far before it that lies.
fn moment(steps: f64) -> (u64, f64) {
    // Decimal seconds are seldom whole steps to the last digit.
    let near = steps.round();
    if (steps - near).abs() < 1e-6 { (near as u64, 0.0) } else { (steps.ceil() as u64, steps.ceil() - steps) }
}

/// Takes the shots, which are in order of time. Makes the folder of a sequence once everything that can be checked has been.
pub(crate) fn draw(
    mut world: World,
    shots: &[Shot],
    sequence: Option<(PathBuf, Checkpoint)>,
    outputs: Option<&Outputs>,
    size: [u32; 2],
    (on, draw): (Where, Draw),
    cache: &Cache,
    console: &Console,
) -> Result<Done, Failure> {
    let begun = Instant::now();
    let files = |shot: &'_ Shot| [std::slice::from_ref(&shot.path), &shot.beside].concat();
    shots.iter().try_for_each(|shot| files(shot).iter().try_for_each(|file| output::file(file)))?;
    let gpu = artist::adapter(draw, on, console)?;
    let mut artist = Artist::choose(draw, gpu.as_ref(), &world, size, (cache, console))?;
    let missing: Vec<&Shot> =
        shots.iter().filter(|shot| !sequence.as_ref().is_some_and(|(_, kept)| kept.has(files(shot).iter()))).collect();
    if let (Some((_, checkpoint)), Some(first)) = (&sequence, missing.first()) {
        checkpoint.restore(&mut world, if outputs.is_some() { first.before.0 } else { first.step })?;
    }
    let mut backend = Backend::choose(on, gpu.as_ref(), &world)?;
    let mut checkpoint = match sequence {
        None => None,
        Some((folder, checkpoint)) => {
            output::make_folder(&folder)?;
            checkpoint.begin()?;
            Some(checkpoint)
        }
    };
    let steps = missing.last().map_or(0, |shot| shot.step.saturating_sub(world.state.step));
    let mut progress = Progress::new(steps + missing.len() as u64, "steps and pictures", console);
    let (mut memory, mut remembered) = (Memory::default(), None);
    for shot in &missing {
        if outputs.is_some() && remembered != Some(shot.before) {
            advance_to(&mut world, shot.before.0, &mut backend, checkpoint.as_mut(), &mut progress)?;
            artist.remember(&mut memory, &mut world, &mut backend, shot.before.1)?;
        }
        // A state past the frame before would be of no use to a run that has that frame still to remember.
        let on_the_way = checkpoint.as_mut().filter(|_| outputs.is_none());
        advance_to(&mut world, shot.step, &mut backend, on_the_way, &mut progress)?;
        let picture = match outputs {
            None => artist.draw(&mut world, &mut backend, shot.behind, size)?,
            Some(outputs) => {
                let (picture, aov) = artist.draw_aov(&mut memory, &mut world, &mut backend, shot.behind, size)?;
                outputs.write(&shot.path, &aov)?;
                if checkpoint.is_none() {
                    outputs.describe(&shot.path)?;
                }
                picture
            }
        };
        remembered = Some((shot.step, shot.behind));
        output::write_whole(&shot.path, |writer| write_png(writer, &picture))?;
        if let Some(checkpoint) = &mut checkpoint {
            checkpoint.save(&mut world, &mut backend)?;
        }
        progress.advance();
    }
    if let Some(checkpoint) = &checkpoint {
        checkpoint.finish()?;
    }
    let (artist, on) = (artist.name().to_owned(), backend.name().to_owned());
    Ok(Done { artist, on, seconds: begun.elapsed().as_secs_f64(), kept: shots.len() - missing.len() })
}

/// Steps until there, saving the state on the way when it is time.
fn advance_to(
    world: &mut World,
    step: u64,
    backend: &mut Backend<'_>,
    mut checkpoint: Option<&mut Checkpoint>,
    progress: &mut Progress,
) -> Result<(), Failure> {
    while world.state.step < step {
        backend.step(world)?;
        progress.advance();
        if let Some(checkpoint) = &mut checkpoint {
            checkpoint.save(world, backend)?;
        }
    }
    Ok(())
}

/// As RGB: a picture is opaque.
fn write_png(writer: &mut BufWriter<File>, picture: &Picture) -> std::io::Result<()> {
    let rgb: Vec<u8> = picture.rgba8.chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied().collect();
    let encoder = PngEncoder::new(writer);
    encoder.write_image(&rgb, picture.width, picture.height, ExtendedColorType::Rgb8).map_err(Error::other)
}

#[cfg(test)]
mod tests {
    use super::moment;

    #[test]
    fn frames_between_steps_are_drawn_between_steps() {
        assert_eq!([0, 1, 2, 90].map(|frame| moment(f64::from(frame) * 60.0 / 30.0)), [(0, 0.0), (2, 0.0), (4, 0.0), (180, 0.0)]);
        assert_eq!([0, 1, 2, 3].map(|frame| moment(f64::from(frame) * 60.0 / 24.0)), [(0, 0.0), (3, 0.5), (5, 0.0), (8, 0.5)]);
        assert_eq!(moment(6.2 * 60.0), (372, 0.0));
    }
}
