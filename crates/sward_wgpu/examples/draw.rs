//! A loop that steps and draws on a graphics device, and asks it questions: `cargo run --release -p sward_wgpu --example draw`.

use sward::model::NoAssets;
use sward::scene::Scene;
use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    run(&Gpu::new()?)
}

pub(crate) fn run(gpu: &Gpu) -> Result<(), Box<dyn std::error::Error>> {
    let text = "(version: 1, field: (patch_side: 8, patches: (5, 5)), stands: [(species: Meadow, cells: 32)],
                 interactors: [(shape: Sphere(radius: 0.8), path: Driven())])";
    // ANCHOR: begin
    let mut world = World::new(Scene::parse(text, "draw.ron")?, &NoAssets)?;
    let mut step = GpuStep::new(gpu, &world)?;
    let mut studio = Studio::new(gpu, &world)?;
    // ANCHOR_END: begin
    let (mut drawn, mut latest) = (Vec::new(), 0);
    for frame in 0..10 {
        // ANCHOR: frame
        // The seconds since the last frame; here 24 frames a second.
        let steps = world.take_steps(1.0 / 24.0);
        world.drive(0, [f64::from(frame) * 0.1 - 1.5, 0.0], 0.0, 0.0);
        for _ in 0..steps {
            step.step(gpu, &mut world)?;
        }
        let picture = studio.draw_before(gpu, &world, CellsAt::Gpu(&step), world.behind(), [160, 90])?;
        // ANCHOR_END: frame
        drawn.push(picture);
        // ANCHOR: ask
        step.ask(gpu, &world, &[[-1.2, 0.1], [3.0, 3.0]])?;
        while let Some(answers) = step.answer(gpu)? {
            println!("frame {frame}: {:.2} m and {:.2} m high after step {}", answers.cover[0], answers.cover[1], answers.step);
            latest = answers.step;
        }
        // ANCHOR_END: ask
    }
    assert!(world.state.step >= 24 && latest + 12 > world.state.step, "{latest} of {}", world.state.step);
    assert!(drawn.first() != drawn.last());
    Ok(())
}
