//! Bodies from glTF files: small ones built here, and those of `../shared/data` where it exists (else their tests are ignored).

mod given;
mod glb;
mod mistakes;
mod moving;
mod splitting;

use std::path::PathBuf;

use libtest_mimic::{Arguments, Trial};

/// A named test; it fails by panicking.
type Test = (&'static str, fn());

/// The folder of bodies made by others: beside this checkout, or as `SWARD_SHARED` says.
fn shared() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    let folder = std::env::var_os("SWARD_SHARED").map_or_else(|| PathBuf::from(beside), PathBuf::from).join("data/bodies");
    folder.is_dir().then_some(folder)
}

fn main() -> std::process::ExitCode {
    let arguments = Arguments::from_args();
    let missing = shared().is_none();
    let trial = |(name, test): &Test| {
        let test = *test;
        Trial::test(*name, move || {
            test();
            Ok(())
        })
    };
    let mut trials: Vec<Trial> = [splitting::TESTS, moving::TESTS, mistakes::TESTS].concat().iter().map(trial).collect();
    trials.extend(given::TESTS.iter().map(|test| trial(test).with_ignored_flag(missing)));
    libtest_mimic::run(&arguments, trials).exit_code()
}
