//! Plants made ready: soups built here, plants grown by code, and those of `../shared/data` where it exists (else their tests are ignored).

mod given;
#[allow(dead_code)] // Bodies need more of it.
#[path = "../figures/glb.rs"]
mod glb;
mod grown;
mod kept;
mod mistakes;
mod rules;
mod soups;

use std::path::PathBuf;

use libtest_mimic::{Arguments, Trial};
use sward::specimen::{Order, Specimen, SpecimenError};

/// A named test; it fails by panicking.
type Test = (&'static str, fn());

/// The folder of plants made by others: beside this checkout, or as `SWARD_SHARED` says.
fn shared() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    let folder = std::env::var_os("SWARD_SHARED").map_or_else(|| PathBuf::from(beside), PathBuf::from).join("data/plants");
    folder.is_dir().then_some(folder)
}

/// A file made ready, with nothing beside it.
fn ready(bytes: &[u8], order: &Order) -> Result<Specimen, SpecimenError> {
    Specimen::read(bytes, &|name| Err(format!("{name} is missing")), order, &mut |_| ())
}

/// A hash of all that a specimen holds.
fn bits(specimen: &Specimen) -> u64 {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let mut hasher = DefaultHasher::new();
    bytemuck::cast_slice::<_, u8>(&specimen.vertices).hash(&mut hasher);
    specimen.triangles.hash(&mut hasher);
    format!("{:?} {:?} {:?} {:?}", specimen.parts, specimen.finishes, specimen.low, specimen.high).hash(&mut hasher);
    hasher.finish()
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
    let built = [soups::TESTS, rules::TESTS, mistakes::TESTS, kept::TESTS, grown::TESTS].concat();
    let mut trials: Vec<Trial> = built.iter().map(trial).collect();
    trials.extend(given::TESTS.iter().map(|test| trial(test).with_ignored_flag(missing)));
    libtest_mimic::run(&arguments, trials).exit_code()
}
