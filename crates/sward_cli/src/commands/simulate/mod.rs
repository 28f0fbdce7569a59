//! `sward simulate`: the state as NumPy arrays, and a manifest that says what they are.

mod arrays;
mod manifest;

use sward_wgpu::gpu::Gpu;

use crate::arguments::Caching;
use crate::arguments::{self, Machine};
use crate::backend::Backend;
use crate::cache::Cache;
use crate::console::Console;
use crate::failure::Failure;
use crate::output;
use crate::progress::Progress;
use crate::scenes;
use manifest::{MANIFEST, Manifest};

/// Runs the steps and writes the folder.
pub(crate) fn run(arguments: &arguments::Simulate, console: &Console) -> Result<(), Failure> {
    let opened = scenes::open(&arguments.scene)?;
    let steps = arguments.steps;
    let every = arguments.every.unwrap_or(steps);
    if every > steps {
        let help = format!("type --every {steps} or less, or more --steps");
        return Err(Failure::input(format!("--every {every} is more than the {steps} steps to run"), help));
    }
    let folder = &arguments.output;
    output::folder(folder, false)?;
    let mut world = opened.world(&Cache::new(&Caching::default()), console)?;
    let gpu = if arguments.on == Machine::Gpu { Some(Gpu::new()?) } else { None };
    let mut backend = match &gpu {
        Some(gpu) => Backend::on_gpu(gpu, &world)?,
        None => Backend::Cpu,
    };
    output::make_folder(folder)?;
    output::remove(&folder.join(MANIFEST))?;
    let mut manifest = Manifest::new(&opened, steps, every, &gpu.as_ref().map_or("cpu".to_owned(), |gpu| gpu.adapter_info.name.clone()));
    let mut progress = Progress::new(u64::from(steps), "steps", console);
    for step in 1..=steps {
        backend.step(&mut world)?;
        if step % every == 0 || step == steps {
            backend.fetch(&mut world)?;
            arrays::write(&world, folder, &mut manifest.arrays)?;
        }
        progress.advance();
    }
    drop(progress);
    manifest.write(folder)?;
    let (count, place) = (manifest.arrays.len(), folder.join(MANIFEST));
    console.summary(&format!("{}: {count} arrays of {}, {steps} steps on {}", place.display(), opened.name, backend.name()))
}
