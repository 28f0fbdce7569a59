//! The worlds of the guide's figures, and what is read from them.

use sward::model::Folder;
use sward::picture::standing::standing;
use sward::scene::Scene;
use sward::world::World;

/// Moment at which the bar is over the middle of the field, s.
pub(crate) const PASSED: f64 = 1.0;

/// A bar as wide as the field that drives over the middle after a second, so fast that all plants there are let go at nearly the same time.
pub(crate) const BAR: &str = "interactors: [(
    shape: Box(size: (28, 0.5, 0.6)), clearance: 0.1, until: 2,
    path: Keyframes(keys: [(time: 0, at: (0, -12)), (time: 2, at: (0, 12))]),
)]";

/// A small field of one stand; what `more` says of the scene besides.
pub(crate) fn field(stand: &str, more: &str) -> Result<World, Box<dyn std::error::Error>> {
    open(&format!("(version: 1, field: (patch_side: 8, patches: (3, 3)), stands: [({stand})], {more})"))
}

/// A scene from its text; files it names are those of the repository.
pub(crate) fn open(text: &str) -> Result<World, Box<dyn std::error::Error>> {
    let assets = Folder(concat!(env!("CARGO_MANIFEST_DIR"), "/../..").into());
    Ok(World::new(Scene::parse(text, "guide.ron")?, &assets)?)
}

/// Steps until a moment.
pub(crate) fn run(world: &mut World, until: f64) {
    while world.time() < until - 1e-9 {
        world.step();
    }
}

/// A place near the middle, all in one patch: finding plants that stand somewhere means looking at all of each patch.
const MIDDLE: [[f64; 2]; 2] = [[0.1, 0.1], [1.3, 1.3]];

/// How far the tips in the middle lean on average, rad along x and z.
pub(crate) fn lean(world: &World) -> [f64; 2] {
    let leans: Vec<[f64; 2]> = standing(world, 0, MIDDLE, 200).iter().map(|plant| plant.lean()).collect();
    [0, 1].map(|axis| leans.iter().map(|lean| lean[axis]).sum::<f64>() / leans.len().max(1) as f64)
}

/// How far the lowest and the highest segment of plants in the middle lean along z on average, rad.
pub(crate) fn ends(world: &World) -> [f64; 2] {
    let plants = standing(world, 0, MIDDLE, 200);
    let tilt = |from: [f64; 3], to: [f64; 3]| (to[2] - from[2]).atan2(to[1] - from[1]);
    let mut sums = [0.0; 2];
    for plant in &plants {
        if let ([root, first, ..], [.., last, tip]) = (&plant.points[..], &plant.points[..]) {
            sums[0] += tilt(*root, *first);
            sums[1] += tilt(*last, *tip);
        }
    }
    sums.map(|sum| sum / plants.len().max(1) as f64)
}

/// Numbers read after every step, from a moment to another, with the time since `PASSED`.
pub(crate) fn watch(world: &mut World, until: f64, mut read: impl FnMut(&World) -> f64) -> Vec<(f64, f64)> {
    let mut samples = vec![(world.time() - PASSED, read(world))];
    while world.time() < until - 1e-9 {
        // Thirty points a second are smooth.
        (0..2).for_each(|_| world.step());
        samples.push((world.time() - PASSED, read(world)));
    }
    samples
}
