//! What can be typed. Numbers are checked here, so that a wrong one stops before anything runs.

mod bench;

use std::ops::Range;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use sward::specimen::grow::HEIGHTS;

use crate::aov;
pub(crate) use bench::{Bench, Paper};

/// Largest side of a picture, pixels.
const LARGEST_SIDE: u32 = 16384;
/// Latest time that can be asked for, s: eleven days of simulation.
const LATEST: f64 = 1e6;
/// Most steps.
const MOST: u32 = 100_000_000;
/// Last frame: nine hours of film.
pub(crate) const LAST_FRAME: u32 = 1_000_000;

const AFTER: &str = "Without a command, `sward` renders the scene `hello` to hello.png in the current folder.\n\
    Exit status: 0 done, 1 failed, 2 wrong input (then nothing is written).";

const EXAMPLES: &str = "Examples:\n  \
    sward                                        a first picture: hello.png\n  \
    sward scenes                                 what scenes there are\n  \
    sward render reed -o reed.png --time 4       one picture\n  \
    sward render hello -o hello.mp4              a clip\n  \
    sward render hello --frames 0..90 -o clip/   three seconds, frame by frame\n  \
    sward simulate lawn --steps 600 -o data/     the state as NumPy arrays\n  \
    sward show my_scene.ron                      what a scene contains and costs\n  \
    sward fit pull.csv                           how a measured plant swings\n  \
    sward grow bush                              a plant made by code: bush.glb\n\n\
    Environment:\n  \
    SWARD_ADAPTER=part of a name                 which graphics adapter to use; none: do without\n\n";

/// Vegetation that reacts: render, simulate, compare and inspect scenes.
#[derive(Debug, Parser)]
#[command(name = "sward", version, after_help = AFTER, after_long_help = format!("{EXAMPLES}{AFTER}"))]
pub(crate) struct Arguments {
    /// Print errors only: no progress, no summary
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// What to do
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Draw a scene: one picture, a clip, or a sequence of frames
    #[command(after_long_help = "Examples:\n  \
        sward render hello\n  \
        sward render reed -o reed.png --time 4 --size 1920x1080\n  \
        sward render hello -o hello.mp4 --seconds 5\n  \
        sward render hello --frames 0..90 --fps 30 -o clip/\n  \
        sward render hello --frames 0..90 -o data/ --aov depth,motion,plant")]
    Render(Render),
    /// Run a scene and write its state as NumPy arrays with a manifest
    #[command(after_long_help = "Examples:\n  \
        sward simulate lawn --steps 600 -o data/\n  \
        sward simulate hello --steps 600 --every 60 -o data/ --on gpu\n\n\
        data/manifest.json lists every array: name, file, shape, axes, unit, step and time.")]
    Simulate(Simulate),
    /// Run a scene on the CPU and on the GPU, and say how far they are apart
    #[command(
        after_long_help = "Examples:\n  sward compare hello --steps 240\n  sward compare hello --precision half\n\nExit status 1 means: further apart than the tolerance."
    )]
    Compare(Compare),
    /// Measure what a scene costs on this machine, stage by stage
    #[command(after_long_help = bench::EXAMPLES)]
    Bench(Bench),
    /// Say what a scene contains and what it costs, or what a plant's file holds; needs no graphics adapter
    #[command(after_long_help = "Examples:\n  sward show hello\n  sward show my_scene.ron\n  sward show oak.glb")]
    Show(Show),
    /// Say how often a plant swings and how it is damped: of a recording, or one response from another
    #[command(after_long_help = "Examples:\n  \
        sward fit pull.csv                           frequency, damping ratio, residual, and what to write into a scene\n  \
        sward fit pulls.csv --recording T3_P1        one of several\n  \
        sward fit --from chain --to continuum        the continuum that sways as single blades do\n  \
        sward fit --scene reed --to oscillator       of a scene's first stand\n\n\
        A recording is a text file with the columns recording,time,value or time,value, of a plant that was pulled and let go.")]
    Fit(Fit),
    /// Grow a plant, and write it as a .glb
    #[command(after_long_help = "Examples:\n  \
        sward grow bush\n  \
        sward grow tree -o lime.glb --seed 3 --triangles 80000 --height 8\n\n\
        The same seed grows the same plant on every machine. `sward show lime.glb` says what is in it.")]
    Grow(Grow),
    /// List the scenes that come with sward, or print the text of one
    #[command(after_long_help = "Examples:\n  sward scenes\n  sward scenes hello > my_scene.ron")]
    Scenes(Scenes),
    /// Print the reference page of the scene format (Markdown)
    SceneFormat,
    /// Print a script that completes commands when you press Tab
    #[command(after_long_help = "Example:\n  sward completions bash > ~/.local/share/bash-completion/completions/sward")]
    Completions(Completions),
}

/// Where what takes long is kept from run to run.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct Caching {
    /// Folder where prepared plants, and the light of scenes with a picture of their surroundings, are kept; by default sward in the user's cache folder
    #[arg(long, value_name = "FOLDER")]
    pub(crate) cache: Option<PathBuf>,
    /// Keep nothing: work all that out every time
    #[arg(long, conflicts_with = "cache")]
    pub(crate) no_cache: bool,
}

/// `sward render`.
#[derive(Debug, Args)]
pub(crate) struct Render {
    /// A shipped scene's name (see `sward scenes`) or the path of a .ron file
    pub(crate) scene: String,
    /// Picture (FILE.png), clip (FILE.mp4) or, with --frames, folder; by default named like the scene
    #[arg(short, long, value_name = "FILE.png|FILE.mp4|DIR/")]
    pub(crate) output: Option<PathBuf>,
    /// Make a clip (MP4 with AV1), also without -o FILE.mp4
    #[arg(long)]
    pub(crate) clip: bool,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "960x540", value_parser = size)]
    pub(crate) size: [u32; 2],
    /// Moment of the picture, in seconds; by default one that suits the scene
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frames", allow_negative_numbers = true)]
    pub(crate) time: Option<f64>,
    /// Frames to draw: the first and one past the last; frame 0 is time 0
    #[arg(long, value_name = "A..B", value_parser = frames)]
    pub(crate) frames: Option<Range<u32>>,
    /// How long the clip lasts, from time 0; by default as long as suits the scene
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frames", allow_negative_numbers = true)]
    pub(crate) seconds: Option<f64>,
    /// Frames per second, by default 24 in a clip and 30 in a sequence; of one picture with --aov, how long ago the frame before was
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) fps: Option<u32>,
    /// Go on with a sequence or a clip that was interrupted: frames that are there are kept
    #[arg(long)]
    pub(crate) resume: bool,
    /// Seconds between two saved states, which --resume goes on from; by default 10
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub(crate) save_every: Option<f64>,
    /// Outputs of each pixel to write beside every picture, like depth,motion,plant
    #[arg(long, value_name = "LIST", value_enum, value_delimiter = ',')]
    pub(crate) aov: Vec<aov::Output>,
    /// How those are stored
    #[arg(long, value_enum, default_value_t = aov::Format::Npy, requires = "aov")]
    pub(crate) aov_format: aov::Format,
    /// Where the simulation runs
    #[arg(long, value_enum, default_value_t = Where::Auto)]
    pub(crate) on: Where,
    /// What draws the picture
    #[arg(long, value_enum, default_value_t = Draw::Auto)]
    pub(crate) draw: Draw,
    /// Where what takes long is kept
    #[command(flatten)]
    pub(crate) caching: Caching,
}

impl Render {
    /// Seconds between two saved states.
    pub(crate) fn save_every(&self) -> f64 {
        self.save_every.unwrap_or(10.0)
    }
}

/// `sward simulate`.
#[derive(Debug, Args)]
pub(crate) struct Simulate {
    /// A shipped scene's name (see `sward scenes`) or the path of a .ron file
    pub(crate) scene: String,
    /// Steps to run
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST)))]
    pub(crate) steps: u32,
    /// Write the state after every K steps, and after the last one; by default only after the last one
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST)))]
    pub(crate) every: Option<u32>,
    /// Folder to write to; it is made if it is missing
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// Where the simulation runs
    #[arg(long, value_enum, default_value_t = Machine::Cpu)]
    pub(crate) on: Machine,
}

/// `sward compare`.
#[derive(Debug, Args)]
pub(crate) struct Compare {
    /// A shipped scene's name (see `sward scenes`) or the path of a .ron file
    #[arg(required_unless_present = "reference")]
    pub(crate) scene: Option<String>,
    /// Instead of a scene: single blades of all species, as simplified chains and without a state, against the full chain
    #[arg(long, conflicts_with_all = ["scene", "steps", "precision"])]
    pub(crate) reference: bool,
    /// Steps to run
    #[arg(long, value_name = "N", default_value_t = 240, value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST)))]
    pub(crate) steps: u32,
    /// How the GPU stores cells: 32 bytes each, or 16; by default what the scene says
    #[arg(long, value_enum)]
    pub(crate) precision: Option<Precision>,
}

/// `sward show`.
#[derive(Debug, Args)]
pub(crate) struct Show {
    /// A shipped scene's name (see `sward scenes`), the path of a .ron file, or that of a plant: .glb or .gltf
    pub(crate) scene: String,
}

/// `sward fit`.
#[derive(Debug, Args)]
pub(crate) struct Fit {
    /// A recording: a text file with the columns recording,time,value or time,value, the time in seconds
    #[arg(value_name = "RECORDING.csv", required_unless_present_any = ["from", "scene"], conflicts_with_all = ["from", "scene"])]
    pub(crate) recording_file: Option<PathBuf>,
    /// Which recording of the file; by default all of them
    #[arg(long, value_name = "NAME", requires = "recording_file")]
    pub(crate) recording: Option<String>,
    /// The response that is measured, in place of a recording
    #[arg(long, value_enum, value_name = "RESPONSE", requires = "to")]
    pub(crate) from: Option<Kind>,
    /// The response whose numbers are printed; of a recording by default oscillator and harmonic
    #[arg(long, value_enum, value_name = "RESPONSE")]
    pub(crate) to: Option<Kind>,
    /// The species whose response is measured
    #[arg(long, value_enum, default_value_t = Species::Meadow, conflicts_with_all = ["recording_file", "scene"])]
    pub(crate) species: Species,
    /// A scene whose stand is measured instead: a shipped scene's name or the path of a .ron file; --from may be left out then
    #[arg(long, value_name = "SCENE", requires = "to")]
    pub(crate) scene: Option<String>,
    /// The name of that stand; by default the first one
    #[arg(long, value_name = "NAME", requires = "scene")]
    pub(crate) stand: Option<String>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// How plants move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    /// Bending spreads as a wave
    Continuum,
    /// Every plant a rod on a spring
    Oscillator,
    /// Billboards that bodies deform; they do not swing
    Springs,
    /// Every blade a chain of segments
    Chain,
    /// As chain, without a state until touched
    VirtualInertia,
    /// Meshes that sway in layers
    Harmonic,
}

/// A kind of plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Species {
    /// Mown turf, 5 cm
    Lawn,
    /// Meadow grass, 40 cm
    Meadow,
    /// Reed, 120 cm
    Reed,
    /// Tussock grass, 30 cm
    Tussock,
    /// A leafy shrub, 1.4 m
    Shrub,
    /// A tree, 7 m
    Tree,
    /// A water plant, 50 cm
    WaterPlant,
}

impl From<Species> for sward::scene::Species {
    fn from(species: Species) -> Self {
        match species {
            Species::Lawn => Self::Lawn,
            Species::Meadow => Self::Meadow,
            Species::Reed => Self::Reed,
            Species::Tussock => Self::Tussock,
            Species::Shrub => Self::Shrub,
            Species::Tree => Self::Tree,
            Species::WaterPlant => Self::WaterPlant,
        }
    }
}

/// `sward grow`.
#[derive(Debug, Args)]
pub(crate) struct Grow {
    /// What kind of plant
    #[arg(value_enum)]
    pub(crate) form: Form,
    /// Where to; by default named like the kind, in the current folder
    #[arg(short, long, value_name = "FILE.glb")]
    pub(crate) output: Option<PathBuf>,
    /// Which plant of the kind
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u32,
    /// About how many triangles, within 10 %
    #[arg(long, value_name = "N", default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(2000..=64_000_000))]
    pub(crate) triangles: u32,
    /// Height in metres, 0.05 to 60; by default 1.5 for a bush, 7.5 for a tree, 0.5 for a water plant
    #[arg(long, value_name = "M", value_parser = height, allow_negative_numbers = true)]
    pub(crate) height: Option<f32>,
}

/// What grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Form {
    /// Round, dense from the ground up
    Bush,
    /// A trunk and a full crown
    Tree,
    /// Ribbons and feathery stems, all soft
    WaterPlant,
}

/// `sward scenes`.
#[derive(Debug, Args)]
pub(crate) struct Scenes {
    /// Print this scene's text, to start a scene of your own
    pub(crate) name: Option<String>,
}

/// `sward completions`.
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell you use
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

/// Where the simulation runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Where {
    /// The GPU if there is a hardware one, else the CPU
    Auto,
    /// The CPU: the same bits on every machine
    Cpu,
    /// The graphics adapter, also a software one
    Gpu,
}

/// What draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Draw {
    /// The graphics adapter if there is one, else the CPU
    Auto,
    /// The graphics adapter, also a software one
    Gpu,
    /// The CPU: nothing but this program is needed
    Cpu,
}

/// How a GPU stores cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Precision {
    /// 32 bytes a cell
    Full,
    /// 16 bytes a cell, rounded in every step
    Half,
}

impl From<Precision> for sward::scene::Precision {
    fn from(precision: Precision) -> Self {
        match precision {
            Precision::Full => Self::Full,
            Precision::Half => Self::Half,
        }
    }
}

/// Where the simulation runs, where results must not depend on what the machine has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Machine {
    /// The CPU: the same bits on every machine
    Cpu,
    /// The graphics adapter: the same numbers within a tolerance
    Gpu,
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let wanted = "type width x height, like 960x540";
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(|| wanted.to_owned())?;
    let side = |text: &str| match text.parse::<u32>() {
        Ok(side) if (1..=LARGEST_SIDE).contains(&side) => Ok(side),
        Ok(_) => Err(format!("a side has 1 to {LARGEST_SIDE} pixels: {wanted}")),
        Err(_) => Err(wanted.to_owned()),
    };
    Ok([side(width)?, side(height)?])
}

fn height(text: &str) -> Result<f32, String> {
    let [low, high] = HEIGHTS;
    match text.parse::<f32>() {
        Ok(height) if (low..=high).contains(&height) => Ok(height),
        Ok(_) => Err(format!("a plant is {low} to {high} m high: type metres, like 1.5")),
        Err(_) => Err("type metres, like 1.5".to_owned()),
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if (0.0..=LATEST).contains(&time) => Ok(time),
        Ok(_) => Err(format!("a time is 0 to {LATEST} seconds, like 2.5")),
        Err(_) => Err("type seconds, like 2.5".to_owned()),
    }
}

fn frames(text: &str) -> Result<Range<u32>, String> {
    let wanted = "type the first frame and one past the last, like 0..90";
    let (first, end) = text.split_once("..").ok_or_else(|| wanted.to_owned())?;
    let number = |text: &str| match text.parse::<u32>() {
        Ok(frame) if frame <= LAST_FRAME => Ok(frame),
        Ok(_) => Err(format!("frames go up to {LAST_FRAME}: {wanted}")),
        Err(_) => Err(wanted.to_owned()),
    };
    let (first, end) = (number(first)?, number(end)?);
    match first.cmp(&end) {
        std::cmp::Ordering::Less => Ok(first..end),
        std::cmp::Ordering::Equal => Err(format!("that is no frame at all; for one frame type {first}..{}", first + 1)),
        std::cmp::Ordering::Greater => Err(format!("that runs backwards; type {end}..{first}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn sizes_have_two_sides_in_range() {
        assert_eq!(size("960x540"), Ok([960, 540]));
        assert_eq!(size("1X16384"), Ok([1, 16384]));
        for wrong in ["", "x", "960", "960x", "0x540", "960x0", "16385x1", "-1x5", "9.5x5", "960x540x2", "99999999999x1"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn times_are_finite_and_not_negative() {
        assert_eq!((seconds("0"), seconds("2.5")), (Ok(0.0), Ok(2.5)));
        for wrong in ["", "-1", "-0.1", "NaN", "inf", "1e9", "soon"] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn frames_run_forwards() {
        assert_eq!(frames("0..90"), Ok(0..90));
        for wrong in ["", "..", "0", "0..", "..9", "5..5", "9..0", "-1..5", "0..=5", "0..1000001", "0..4294967295"] {
            assert!(frames(wrong).is_err(), "{wrong}");
        }
        assert!(frames("9..0").is_err_and(|advice| advice.contains("0..9")));
    }
}
