//! Billboards on springs among bodies seen as depth cube maps. Every comparison has a control that fails. Tests with bodies made by others are
//! ignored where those are not there.

mod bodies;
mod cars;
mod field;
mod finite;
mod given;
mod maps;
mod mirror;
mod pools;
mod recovery;
mod standing;
mod surfaces;
mod twin;
mod walkers;

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
    let own = [
        maps::TESTS,
        walkers::TESTS,
        cars::TESTS,
        standing::TESTS,
        mirror::TESTS,
        recovery::TESTS,
        pools::TESTS,
        surfaces::TESTS,
        finite::TESTS,
        twin::TESTS,
    ];
    let mut trials: Vec<Trial> = own.concat().iter().map(trial).collect();
    trials.extend(given::TESTS.iter().map(|test| trial(test).with_ignored_flag(missing)));
    libtest_mimic::run(&arguments, trials).exit_code()
}
