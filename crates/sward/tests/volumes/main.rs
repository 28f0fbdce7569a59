//! Light among plants: its oracles, what its hash hears of, and how it is kept. Tests on the picture of `../shared/data` are ignored where
//! it does not exist.

mod files;
mod given;
mod kept;
mod keys;
mod level;
mod scenes;
mod walls;

use std::path::PathBuf;

use libtest_mimic::{Arguments, Trial};

/// A named test; it fails by panicking.
type Test = (&'static str, fn());

/// The picture of a meadow made by others: beside this checkout, or as `SWARD_SHARED` says.
fn park() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    let file = std::env::var_os("SWARD_SHARED").map_or_else(|| PathBuf::from(beside), PathBuf::from).join("data/env/park.hdr");
    file.is_file().then_some(file)
}

fn main() -> std::process::ExitCode {
    let arguments = Arguments::from_args();
    let missing = park().is_none();
    let trial = |(name, test): &Test| {
        let test = *test;
        Trial::test(*name, move || {
            test();
            Ok(())
        })
    };
    let mut trials: Vec<Trial> = [level::TESTS, walls::TESTS, keys::TESTS, kept::TESTS, files::TESTS].concat().iter().map(trial).collect();
    trials.extend(given::TESTS.iter().map(|test| trial(test).with_ignored_flag(missing)));
    libtest_mimic::run(&arguments, trials).exit_code()
}
