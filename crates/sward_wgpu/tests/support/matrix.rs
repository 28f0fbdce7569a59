//! Everything meets everything, on the device; the controls run on the CPU.

use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};

#[allow(dead_code, clippy::duplicate_mod)]
#[path = "../../../sward/tests/live/matrix.rs"]
mod cells;

pub(crate) fn everything_meets_everything(gpu: &Gpu) -> Verdict {
    let mut device: Option<GpuStep> = None;
    let mut trouble = None;
    let wrong = cells::all(&mut |world: &mut World, last: u64| {
        let mut run = || -> Verdict {
            if world.state.step == 0 {
                device = Some(GpuStep::new(gpu, world)?);
            }
            let step = device.as_mut().ok_or("no device")?;
            while world.state.step < last {
                step.step(gpu, world)?;
            }
            Ok(step.download(gpu, world)?)
        };
        trouble = trouble.take().or(run().err());
    });
    if let Some(trouble) = trouble {
        return Err(trouble);
    }
    ensure(wrong.is_empty(), || format!("{wrong:#?}"))
}
