//! All pictures of the guide, drawn from worlds that run: `cargo run --release -p sward_raster --example guide`.
//!
//! Without an argument they go to `docs/guide/pictures`, where the chapters look for them; otherwise into the folder named. A second argument picks
//! those whose names contain it.

mod curves;
mod field;
mod motions;
mod stills;
mod winds;

use std::path::{Path, PathBuf};

/// What a picture is written by.
type Written = Result<(), Box<dyn std::error::Error>>;
/// A picture: its file, and what writes it there.
type Figure = (&'static str, fn(&Path) -> Written);

const FIGURES: &[Figure] = &[
    ("first.jpg", stills::first),
    ("responses.jpg", stills::responses),
    ("representations.jpg", stills::representations),
    ("track.jpg", stills::track),
    ("gain.jpg", stills::gain),
    ("trail.jpg", stills::trail),
    ("painted.jpg", stills::painted),
    ("release.svg", motions::release),
    ("steady.svg", motions::steady),
    ("frequency.svg", motions::frequency),
    ("damping.svg", motions::damping),
    ("creep.svg", motions::creep),
    ("coupling.svg", motions::coupling),
    ("trail.svg", motions::trail),
    ("recover.svg", motions::recover),
    ("gain.svg", motions::gain),
    ("spread.svg", motions::spread),
    ("gusts.svg", motions::gusts),
    ("footprints.svg", winds::footprints),
    ("flow.svg", winds::flow),
];

fn main() -> Written {
    let here = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/guide/pictures");
    let folder = std::env::args_os().nth(1).map_or_else(here, PathBuf::from);
    let only = std::env::args().nth(2).unwrap_or_default();
    std::fs::create_dir_all(&folder)?;
    for (name, write) in FIGURES.iter().filter(|(name, _)| name.contains(&only)) {
        write(&folder.join(name))?;
        println!("{name}");
    }
    Ok(())
}
