//! Runs tests that need a graphics adapter: without any they are ignored, not passed; with `CI` set they fail. A message of the
//! validation layer (`SWARD_VALIDATION=1`) fails the test that ends next.

#[path = "mod.rs"]
mod support;

use std::sync::Arc;

use libtest_mimic::{Arguments, Failed, Trial};
use sward_wgpu::gpu::{Gpu, GpuError};

/// What a test answers.
pub(crate) type Verdict = Result<(), Failed>;
/// A named test on the adapter.
pub(crate) type Test = (&'static str, fn(&Gpu) -> Verdict);

/// Runs the tests on one device; those that `skip` names on this adapter are ignored.
pub(crate) fn run(tests: &[Test], skip: fn(&Gpu, &str) -> bool) -> std::process::ExitCode {
    let arguments = Arguments::from_args();
    let watch = support::Watch::install();
    let gpu = Arc::new(Gpu::new());
    let demanded = std::env::var_os("CI").is_some();
    let trials = tests.iter().map(|(name, test)| {
        let ignored = match &*gpu {
            Ok(gpu) => skip(gpu, name),
            Err(GpuError::NoAdapter) => !demanded,
            Err(_) => false,
        };
        let (gpu, test) = (Arc::clone(&gpu), *test);
        let body = move || match &*gpu {
            Ok(gpu) => {
                test(gpu)?;
                gpu.check()?;
                let messages = watch.take();
                if messages.is_empty() { Ok(()) } else { Err(messages.join("\n").into()) }
            }
            Err(error) => Err(error.to_string().into()),
        };
        Trial::test(*name, body).with_ignored_flag(ignored)
    });
    libtest_mimic::run(&arguments, trials.collect()).exit_code()
}

/// Fails with a message unless `holds`.
pub(crate) fn ensure(holds: bool, message: impl FnOnce() -> String) -> Verdict {
    if holds { Ok(()) } else { Err(message().into()) }
}
