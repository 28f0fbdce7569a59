//! Runs tests that need a graphics adapter: without any they are ignored, not passed; with `CI` set they fail. A message of the
//! validation layer (`SWARD_VALIDATION=1`) fails the test that ends next.

#[path = "mod.rs"]
mod support;

use std::sync::Arc;

use libtest_mimic::{Arguments, Completion, Failed, Trial};
use sward_wgpu::gpu::{Gpu, GpuError};

/// What a test answers.
pub(crate) type Verdict = Result<(), Failed>;
/// A named test on the adapter.
pub(crate) type Test = (&'static str, fn(&Gpu) -> Verdict);

/// Runs the tests on one device; those for which `skip` has a reason on this adapter are ignored.
pub(crate) fn run(tests: &[Test], skip: fn(&Gpu, &str) -> Option<String>) -> std::process::ExitCode {
    let mut arguments = Arguments::from_args();
    let watch = support::Watch::install();
    let gpu = Arc::new(Gpu::new());
    let demanded = std::env::var_os("CI").is_some();
    if let Ok(gpu) = &*gpu {
        let info = &gpu.adapter_info;
        eprintln!("adapter: {}, driver {} {}, {:?}", info.name, info.driver, info.driver_info, info.backend);
        if info.backend == wgpu::Backend::Gl {
            // wgpu panics when another thread keeps the one OpenGL context busy for six seconds.
            arguments.test_threads = Some(1);
        }
    }
    let trials = tests.iter().map(|&(name, test)| {
        let gpu = Arc::clone(&gpu);
        let body = move || match &*gpu {
            Ok(gpu) => {
                if let Some(reason) = skip(gpu, name) {
                    return Ok(Completion::ignored_with(reason));
                }
                test(gpu)?;
                gpu.check()?;
                let messages = watch.take();
                if messages.is_empty() { Ok(Completion::Completed) } else { Err(messages.join("\n").into()) }
            }
            Err(GpuError::NoAdapter) if !demanded => Ok(Completion::ignored_with("no graphics adapter")),
            Err(error) => Err(error.to_string().into()),
        };
        Trial::ignorable_test(name, body)
    });
    libtest_mimic::run(&arguments, trials.collect()).exit_code()
}

/// Fails with a message unless `holds`.
pub(crate) fn ensure(holds: bool, message: impl FnOnce() -> String) -> Verdict {
    if holds { Ok(()) } else { Err(message().into()) }
}
