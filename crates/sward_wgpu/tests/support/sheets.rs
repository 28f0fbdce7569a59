//! Whole runs of stands whose billboards bodies deform, beside a GPU: sheets are the core's, places and pictures the device's.

use sward::world::World;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::runs::{Backend, Run, agree, world};

/// A walker, a box and a ball that vanishes, on hills, among limits of growth, in gusts.
const SHEETS: &str = r#"(version: 1, field: (patch_side: 16), terrain: Image(path: "assets/jacksboro.png", scale: 0.03125),
    stands: [(species: Meadow, cells: 40, response: Springs(recover: 1.2))], wind: [Natural()],
    exclusions: [(area: Road(points: [(-30, 2), (0, 3), (30, -4)], width: 2), soft: 0.8)],
    interactors: [
        (shape: Ellipsoid(radii: (0.25, 0.9, 0.25)), path: Circle(centre: (0, 2), radius: 3, speed: 1.5)),
        (shape: Box(size: (1, 1, 1.5)), clearance: 0.1, path: Keyframes(keys: [(time: 0, at: (-6, 3)), (time: 4, at: (6, 8))])),
        (shape: Sphere(radius: 1), path: Still(at: (5, 3)), from: 0.3, until: 1.7),
    ], camera: (eye: (0, 2, 0), target: (4, 1, 8)), budget: (patches: 9))"#;

/// Finer sheets, in a small pool, under a truck.
const CROWDED: &str =
    "(version: 1, field: (patch_side: 8), stands: [(species: Reed, cells: 24, response: Springs(columns: 5, rows: 4, recover: 1))],
    interactors: [(shape: Truck, path: Circle(centre: (0, 2), radius: 4, speed: 5))], budget: (sheets: 64))";

pub(crate) fn run(gpu: &Gpu) -> Verdict {
    let shows = |world: &World| world.state.stands[0].sheets.pool.taken().count() > 10;
    Run { name: "sheets", scene: SHEETS, shows }.check_for(gpu, 180)?;
    Run { name: "crowded", scene: CROWDED, shows: |world| world.state.stands[0].sheets.pool.evicted > 10 }.check_for(gpu, 60)?;
    // Control: recovery a tenth slower.
    let (mut cpu, mut other) = (world(SHEETS)?, world(SHEETS)?);
    if let Some(springs) = &mut other.model.stands[0].springs {
        springs.coefficients.recover *= 1.1;
        springs.coefficients.stiffness *= 0.5;
    }
    Backend::Cpu.run(gpu, &mut cpu, 90)?;
    Backend::on(gpu, &other)?.run(gpu, &mut other, 90)?;
    ensure(agree("other springs", &cpu, &other, false).is_err(), || "other springs are not found".to_owned())
}
