//! The runs: small patches of 64² cells, everything that may differ between backends at least once.

use sward::scene::{Change, Edit, Raise};
use sward::world::World;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::runs::{Backend, Run, agree, world};

/// A pickup over hills, in gusts.
pub(crate) const TRUCK: &str = r#"(version: 1, field: (patch_side: 16),
    terrain: Image(path: "assets/jacksboro.png", scale: 0.03125), stands: [(species: Meadow, cells: 64)], wind: [Natural()],
    interactors: [(shape: Truck, path: Keyframes(keys: [(time: 0, at: (-10, 12)), (time: 2, at: (0, 2)), (time: 4, at: (12, -4))]))],
    camera: (eye: (0, 2, 0), target: (4, 1, 8)), budget: (patches: 9, focus_distance: 14, lag_distance: 20))"#;

/// A ball over turf that creeps back.
const LAWN: &str = "(version: 1, field: (patch_side: 8), stands: [(species: Lawn, cells: 64)],
    interactors: [(shape: Sphere(radius: 0.4), follow_ground: false, path: Circle(centre: (0, 2), radius: 2, speed: 1.5))])";

/// Bodies that cross, rest, appear, hover and turn on the spot.
const REED: &str = "(version: 1, field: (patch_side: 16), stands: [(species: Reed, cells: 64)], wind: [Uniform(velocity: (6, 2))],
    interactors: [
        (shape: Box(size: (2.4, 1.2, 4)), path: Keyframes(keys: [(time: 0, at: (-6, 4)), (time: 2, at: (0, 4)), (time: 2.5, at: (0, 4)), (time: 4, at: (6, 6))])),
        (shape: Ellipsoid(radii: (0.9, 0.6, 0.7)), path: Circle(centre: (2, 4), radius: 2.5, speed: -3)),
        (shape: Polygon(points: [(-1, -1), (1, -1), (0, 1.6)]), path: Keyframes(keys: [(time: 0, at: (-3, -2), yaw: 0), (time: 3, at: (-3, -2), yaw: 3)])),
        (shape: Sphere(radius: 0.5), clearance: 0.9, path: Circle(radius: 3, speed: 5)),
        (shape: Box(size: (1, 1, 1)), path: Still(at: (4, 0), yaw: 0.5), from: 0.5, until: 3),
    ], budget: (lag_distance: 24))";

/// A ball that comes, goes, and comes again when all have slept.
const TUSSOCK: &str = "(version: 1, field: (patch_side: 8), stands: [(species: Tussock, cells: 64)],
    interactors: [(shape: Sphere(radius: 0.6), path: Keyframes(keys: [
        (time: 0, at: (4, -3)), (time: 0.5, at: (4, 3)), (time: 0.6, at: (4, 3), clearance: 40), (time: 3.4, at: (4, 3), clearance: 40),
        (time: 3.5, at: (4, 4), clearance: 0), (time: 4, at: (4, 6))]))])";

/// Gusts alone, strong enough to reach the limits.
const WIND: &str = "(version: 1, field: (patch_side: 16), stands: [(species: Reed, cells: 64)],
    wind: [Uniform(velocity: (0, 3)), Natural(velocity: (14, 4), turbulence: 0.6)],
    camera: (eye: (8, 2, 8), target: (8, 1, 20)), budget: (patches: 9, focus_distance: 18, lag_distance: 18))";

/// So stiff that the wave takes two substeps.
pub(crate) const STIFF: &str = "(version: 1, field: (patch_side: 8),
    stands: [(species: Meadow, cells: 64, response: Continuum(kappa: 4000, lambda_theta: 0.05))],
    interactors: [(shape: Box(size: (1, 1, 2)), path: Circle(radius: 3, speed: 12))])";

/// Blades that a ball and a box touch, on hills, in gusts: only those have a state.
pub(crate) const TOUCHED: &str = r#"(version: 1, field: (patch_side: 8), terrain: Image(path: "assets/jacksboro.png", scale: 0.03125),
    stands: [(species: Meadow, cells: 8, response: VirtualInertia(), representation: Blade(blades: 4))], wind: [Natural()],
    interactors: [(shape: Sphere(radius: 0.5), path: Circle(centre: (0, 2), radius: 2, speed: 4)),
        (shape: Box(size: (1, 0.3, 1)), clearance: 0.2, path: Keyframes(keys: [(time: 0, at: (-6, 3)), (time: 4, at: (6, 4))]))],
    budget: (patches: 12, focus_distance: 12))"#;

/// Every blade with a state of its own; plants as billboards.
pub(crate) const CHAINS: &str =
    "(version: 1, field: (patch_side: 8, patches: (1, 1)), stands: [(species: Reed, cells: 8, response: Chain())], wind: [Natural(velocity: (6, 2))],
    interactors: [(shape: Ellipsoid(radii: (0.4, 0.7, 0.5)), path: Circle(centre: (4, 4), radius: 1, speed: 2))],
    budget: (patches: 12, focus_distance: 10))";

/// A camera that runs on while only nine patches may be awake.
const BUDGET: &str = "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 64)], wind: [Natural(velocity: (5, 2))],
    interactors: [(shape: Sphere(radius: 0.5), path: Circle(centre: (10, 4), radius: 7, speed: 9))],
    camera: (keys: [(time: 0, eye: (4, 2, 4), target: (4, 1, 12)), (time: 4, eye: (40, 2, 4), target: (40, 1, 12))]),
    budget: (patches: 9, focus_distance: 16, lag_distance: 16))";

/// Two stands of different cells on the same hills.
const TWO_STANDS: &str = r#"(version: 1, field: (patch_side: 16),
    terrain: Image(path: "assets/jacksboro.png", scale: 0.03125),
    stands: [(species: Meadow, cells: 64), (species: Tussock, cells: 40, cover: 0.2)], wind: [Uniform(velocity: (3, 1))],
    interactors: [(shape: Truck, path: Circle(centre: (4, 4), radius: 5, speed: 6))])"#;

/// Level ground with a road along which a truck swerves, and a hill that rises under it and its patches.
const ROAD: &str = "(version: 1, field: (patch_side: 16), stands: [(species: Meadow, cells: 64), (species: Lawn, cells: 40)],
    exclusions: [(area: Road(points: [(-30, 2), (0, 3), (30, -4)], width: 3), soft: 0.5, stands: [\"meadow\"])], wind: [Natural()],
    edits: [(time: 1, at: (2, 3), radius: 7, change: Raise(height: 0.8)), (time: 3, at: (9, 0), radius: 5, hardness: 0.3, change: Flatten())],
    interactors: [(shape: Truck, path: Keyframes(keys: [(time: 0, at: (-10, 2)), (time: 2, at: (0, 4.5)), (time: 4, at: (12, -2))]))],
    camera: (eye: (0, 2, 0), target: (4, 1, 8)), budget: (patches: 9, focus_distance: 14, lag_distance: 20))";

pub(crate) fn road_and_rising_ground(gpu: &Gpu) -> Verdict {
    Run { name: "road", scene: ROAD, shows: |world| world.state.stands.iter().all(|stand| stand.counters.resampled > 1) }.check(gpu)
}

/// Ground that was level until code raised it: on the GPU patches have none stored until then.
pub(crate) fn level_ground_is_raised(gpu: &Gpu) -> Verdict {
    let (mut cpu, mut other) = (world(LAWN)?, world(LAWN)?);
    let mut backend = Backend::on(gpu, &other)?;
    let edit = Edit { at: [0.0, 3.0], radius: 4.0, change: Change::Raise(Raise { height: 0.3 }), ..Edit::default() };
    for raised in [false, true, true] {
        Backend::Cpu.run(gpu, &mut cpu, 30)?;
        backend.run(gpu, &mut other, 30)?;
        agree("raised", &cpu, &other, true)?;
        ensure((cpu.state.stands[0].counters.resampled > 0) == raised, || "the edit is seen".to_owned())?;
        if cpu.state.step == 30 {
            cpu.edit(&edit)?;
            other.edit(&edit)?;
        }
    }
    let mut control = world(LAWN)?;
    Backend::Cpu.run(gpu, &mut control, 90)?;
    control.state.stands[0].counters = cpu.state.stands[0].counters;
    ensure(agree("control", &cpu, &control, false).is_err(), || "level ground gives the same".to_owned())
}

pub(crate) fn truck_on_hills(gpu: &Gpu) -> Verdict {
    Run { name: "truck", scene: TRUCK, shows: |world| !world.model.terrain.is_flat() && world.model.gusty }.check_for(gpu, 120)
}

pub(crate) fn lawn_and_sphere(gpu: &Gpu) -> Verdict {
    Run { name: "lawn", scene: LAWN, shows: |world| world.model.stands[0].lag.segments == 1 }.check_for(gpu, 120)
}

pub(crate) fn bodies_in_reed(gpu: &Gpu) -> Verdict {
    // The crate is gone at the end; the plough has come to rest.
    Run { name: "reed", scene: REED, shows: |world| world.state.bodies[4].pose.is_none() }.check(gpu)
}

pub(crate) fn sleeping_and_waking(gpu: &Gpu) -> Verdict {
    let shows = |world: &sward::world::World| world.state.stands[0].counters.slept > 0 && !world.state.stands[0].awake.is_empty();
    Run { name: "tussock", scene: TUSSOCK, shows }.check(gpu)
}

pub(crate) fn touched_blades(gpu: &Gpu) -> Verdict {
    let shows = |world: &World| world.state.stands[0].awake.values().any(|awake| awake.held > 0);
    Run { name: "touched", scene: TOUCHED, shows }.check_for(gpu, 24)?;
    // Control: blades that catch two percent more wind.
    let (mut cpu, mut other) = (world(TOUCHED)?, world(TOUCHED)?);
    if let Some(chain) = &mut other.model.stands[0].chain {
        chain.coefficients.drag *= 1.02;
    }
    Backend::Cpu.run(gpu, &mut cpu, 6)?;
    Backend::on(gpu, &other)?.run(gpu, &mut other, 6)?;
    ensure(agree("two percent more drag", &cpu, &other, false).is_err(), || "two percent more drag is not found".to_owned())
}

pub(crate) fn chains(gpu: &Gpu) -> Verdict {
    let shows = |world: &World| world.state.stands[0].awake.values().any(|awake| awake.held > 40);
    Run { name: "chains", scene: CHAINS, shows }.check_for(gpu, 9)
}

pub(crate) fn natural_wind(gpu: &Gpu) -> Verdict {
    Run { name: "wind", scene: WIND, shows: |world| world.state.stands[0].awake.len() > 3 }.check_for(gpu, 90)
}

pub(crate) fn each_lag(gpu: &Gpu) -> Verdict {
    for (name, lag) in [("cascade", "Cascade"), ("history", "History"), ("lookup", "Lookup")] {
        let scene = format!(
            "(version: 1, field: (patch_side: 8), stands: [(species: Reed, cells: 64, response: Continuum(lag: {lag}))],
            interactors: [(shape: Box(size: (1, 1, 2)), path: Circle(radius: 4, speed: 5))], camera: (eye: (0, 2, 0), target: (0, 1, 5)))"
        );
        let shows = |world: &sward::world::World| !world.state.stands[0].cells.lag.is_empty();
        Run { name, scene: &scene, shows }.check_for(gpu, 90)?;
    }
    Ok(())
}

pub(crate) fn substeps(gpu: &Gpu) -> Verdict {
    let shows = |world: &sward::world::World| world.model.stands[0].substeps > 1 && world.state.stands[0].counters.clamped > 0;
    Run { name: "stiff", scene: STIFF, shows }.check_for(gpu, 90)
}

pub(crate) fn small_budget(gpu: &Gpu) -> Verdict {
    Run { name: "budget", scene: BUDGET, shows: |world| world.state.stands[0].counters.released > 0 }.check(gpu)
}

pub(crate) fn two_stands(gpu: &Gpu) -> Verdict {
    Run { name: "two stands", scene: TWO_STANDS, shows: |world| world.state.stands.iter().all(|stand| !stand.awake.is_empty()) }
        .check_for(gpu, 120)
}
