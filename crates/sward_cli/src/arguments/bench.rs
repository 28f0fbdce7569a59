//! What can be typed after `sward bench`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Caching, Draw, MOST, Machine, Precision, size};

/// Shown below the options.
pub(super) const EXAMPLES: &str = "Examples:\n  \
    sward bench hello\n  \
    sward bench hello --on gpu -o figures/\n  \
    sward bench hello --project                  milliseconds on three GPUs, worked out\n  \
    sward bench --papers                         the papers' tables again, on this machine\n  \
    sward bench --papers grassland\n  \
    sward bench --recovery                       how long grass takes to stand up, by the rate of frames\n\n\
    figures/bench.json and bench.csv hold p50 and p95 of every stage; the JSON also counters, memory and the machine.\n\
    --papers writes papers.json and papers.csv there, --recovery recovery.json and recovery.csv.";

/// `sward bench`.
#[derive(Debug, Args)]
pub(crate) struct Bench {
    /// A shipped scene's name (see `sward scenes`) or the path of a .ron file
    #[arg(required_unless_present_any = ["papers", "recovery"])]
    pub(crate) scene: Option<String>,
    /// Instead of a scene: the scenes of the papers, with their sizes, counts and resolutions, and their printed figures beside ours; or one paper's
    #[arg(
        long,
        value_name = "NAME",
        value_enum,
        num_args = 0..=1,
        default_missing_value = "all",
        conflicts_with_all = ["scene", "recovery", "project", "steps", "warm_up", "size", "precision"]
    )]
    pub(crate) papers: Option<Paper>,
    /// Instead of a scene: how long bent grass takes to stand up by the laws of others and by ours, at 30 to 1000 frames a second
    #[arg(long, conflicts_with_all = ["scene", "project", "steps", "warm_up", "size", "on", "draw", "precision"])]
    pub(crate) recovery: bool,
    /// Instead of measuring: work out from what is counted how many milliseconds each stage would take on three GPUs, a projection
    #[arg(long, conflicts_with_all = ["size", "on", "draw"])]
    pub(crate) project: bool,
    /// Steps that are timed
    #[arg(long, value_name = "N", default_value_t = 120, value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST)))]
    pub(crate) steps: u32,
    /// Steps before those
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(0..=i64::from(MOST)))]
    pub(crate) warm_up: u32,
    /// Width and height of the pictures that are timed, in pixels
    #[arg(long, value_name = "WxH", default_value = "960x540", value_parser = size)]
    pub(crate) size: [u32; 2],
    /// Where the simulation runs; by default on the CPU, with --papers on the GPU if there is a hardware one
    #[arg(long, value_enum)]
    pub(crate) on: Option<Machine>,
    /// What draws the pictures
    #[arg(long, value_enum, default_value_t = Draw::Auto)]
    pub(crate) draw: Draw,
    /// How the GPU stores cells: 32 bytes each, or 16; by default what the scene says
    #[arg(long, value_enum)]
    pub(crate) precision: Option<Precision>,
    /// Where what takes long is kept
    #[command(flatten)]
    pub(crate) caching: Caching,
    /// Folder for the figures, as JSON and CSV
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// With --papers: pairs of frames, in ABBA order, behind each ratio; by default 4 on a software adapter and on the CPU, 24 on a hardware one
    #[arg(long, value_name = "N", requires = "papers", conflicts_with_all = ["scene", "recovery"], value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) pairs: Option<u32>,
    /// With --papers, for tests: share of the papers' counts and pixels
    #[arg(long, value_name = "SHARE", requires = "papers", conflicts_with_all = ["scene", "recovery"], hide = true, value_parser = share)]
    pub(crate) scale: Option<f64>,
}

/// Whose tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Paper {
    /// All of them
    All,
    /// Chen & Johan 2010: the field of a racing game
    Continuum,
    /// Belyaev, Laevsky & Chukanov 2011: a million blades
    Grassland,
    /// Orthmann, Rezk-Salama & Kolb 2009: 60 000 billboards
    Billboards,
    /// Chen & Johan 2015: plants of 80 thousand and 50 million faces in layers
    Layers,
    /// The article on instigators, which prints a curve and no times
    Instigator,
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(share) if share > 0.0 && share <= 1.0 => Ok(share),
        _ => Err("a share is more than 0 and at most 1, like 0.01".to_owned()),
    }
}
