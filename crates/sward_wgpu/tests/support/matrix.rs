//! Everything meets everything on a device, too.

use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::{Gpu, GpuError};

use crate::adapter::{Verdict, ensure};

#[path = "../../../sward/tests/live/matrix.rs"]
#[allow(dead_code, clippy::print_stdout)]
mod cells;

/// The cells of the matrix whose world a device steps; what is looked at is downloaded at each moment.
pub(crate) fn matrix(gpu: &Gpu) -> Verdict {
    let (mut step, mut failed) = (None, None);
    let wrong = cells::all(
        &mut |world, last| {
            let mut run = || -> Result<(), GpuError> {
                if world.state.step == 0 {
                    step = Some(GpuStep::new(gpu, world)?);
                }
                let Some(step) = step.as_mut() else { return Ok(()) };
                while world.state.step < last {
                    step.step(gpu, world)?;
                }
                step.download(gpu, world)
            };
            failed = run().err().or(failed.take());
        },
        true,
    );
    if let Some(error) = failed {
        return Err(error.into());
    }
    ensure(wrong.is_empty(), || format!("{wrong:#?}"))
}
