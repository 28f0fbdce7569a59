//! How pulled plants swing: curves made here, the plants of scenes, and the trees of `../shared/data` where they are (else their tests are
//! ignored).

#[path = "../common/mod.rs"]
mod common;
mod curves;
mod engine;
mod presses;
mod translations;
mod trees;

use libtest_mimic::{Arguments, Trial};

/// A named test; it fails by panicking.
type Test = (&'static str, fn());

fn main() -> std::process::ExitCode {
    let arguments = Arguments::from_args();
    let missing = trees::folder().is_none();
    let trial = |(name, test): &Test| {
        let test = *test;
        Trial::test(*name, move || {
            test();
            Ok(())
        })
    };
    let mut trials: Vec<Trial> = [curves::TESTS, translations::TESTS, presses::TESTS].concat().iter().map(trial).collect();
    trials.extend(trees::TESTS.iter().map(|test| trial(test).with_ignored_flag(missing)));
    libtest_mimic::run(&arguments, trials).exit_code()
}
