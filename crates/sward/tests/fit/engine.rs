//! A plant of a world, pulled by hand or by a body and let go, as a recording.

use sward::fit::{Recording, Swing, response_of};
use sward::model::NoAssets;
use sward::response::oscillator::{Own, Record};
use sward::scene::{HarmonicOverrides, OscillatorOverrides, Response, Scene, Species, Stand};
use sward::world::World;

/// Steps between two samples: four a second, as loggers have it.
const EVERY: u64 = 15;

fn world(stand: Stand, rest: Scene) -> World {
    let scene = Scene { stands: vec![stand], ..rest };
    scene.validate().unwrap_or_else(|error| panic!("{error}"));
    World::new(scene, &NoAssets).unwrap_or_else(|error| panic!("{error}"))
}

/// Until a thousandth is left, or 60 s.
fn samples(swing: &Swing) -> u64 {
    let decay = swing.damping_ratio * swing.frequency * std::f64::consts::TAU;
    (4.0 * (7.0 / decay).clamp(4.0 / swing.frequency, 60.0)) as u64
}

fn recorded(swing: &Swing, world: &mut World, mut value: impl FnMut(&World) -> f32) -> Recording {
    let (mut times, mut values) = (Vec::new(), Vec::new());
    for sample in 0..samples(swing) {
        times.push(0.25 * sample as f64);
        values.push(f64::from(value(world)));
        (0..EVERY).for_each(|_| world.step());
    }
    Recording::new(times, values).unwrap_or_else(|error| panic!("{error}"))
}

/// A plant as high as the tree, or as plants that are no meshes may be, under a ball that vanishes: the world's steps push it and let it go.
pub(crate) fn oscillator(swing: &Swing, height: f64) -> Recording {
    let kind = Response::Oscillator(OscillatorOverrides { spread_stiffness: Some(0.0), spread_damping: Some(0.0), ..Default::default() });
    let height = height.min(5.0) as f32;
    let stand = Stand {
        species: Species::Reed,
        height: Some([height, height]),
        cells: Some(16),
        response: Some(response_of(&kind, swing)),
        clumping: 0.0,
        ..Stand::default()
    };
    let ball = "(version: 1, field: (patch_side: 16), interactors: [(shape: Sphere(radius: 3), path: Still(at: (8, 8)), until: 0.5)])";
    let mut world = world(stand, Scene::parse(ball, "ball.ron").expect("valid"));
    (0..30).for_each(|_| world.step());
    let (cell, first) = farthest(&world);
    assert!(size(first) > 0.02, "the ball pushes nothing: {first:?}");
    recorded(swing, &mut world, move |world| {
        let now = deviation(world, cell);
        (now[0] * first[0] + now[1] * first[1]) / size(first)
    })
}

fn size(bend: [f32; 2]) -> f32 {
    (bend[0] * bend[0] + bend[1] * bend[1]).sqrt()
}

/// Where the plant of a cell is, rad.
fn deviation(world: &World, (slot, cell): (usize, usize)) -> [f32; 2] {
    let stand = &world.model.stands[0];
    let co = &stand.oscillator.as_ref().expect("it swings").coefficients;
    let record = Record::load(&world.state.stands[0].cells.now[slot], (stand.cells * stand.cells) as usize, cell);
    record.at(co, &Own::of(co, 0x8000_8000, stand.species.height[0]), world.state.step as u32, 0.0)
}

/// The cell whose plant leans farthest.
fn farthest(world: &World) -> ((usize, usize), [f32; 2]) {
    let cells = (world.model.stands[0].cells as usize).pow(2);
    let all = world.state.stands[0].awake.values().flat_map(|awake| (0..cells).map(move |cell| (awake.slot as usize, cell)));
    let most = all.max_by(|a, b| size(deviation(world, *a)).total_cmp(&size(deviation(world, *b)))).expect("some are awake");
    (most, deviation(world, most))
}

/// Leaves of a tree on a plane that all move alike, and then nothing moves them any more.
pub(crate) fn harmonic(swing: &Swing, height: f64) -> Recording {
    let kind = Response::Harmonic(HarmonicOverrides { cells: Some(16), ..HarmonicOverrides::default() });
    let tree = "(version: 1, stands: [(species: Tree, places: [(at: (0, 30))], representation: Layers(mesh: Grown(triangles: 2000)))])";
    let scene = Scene::parse(tree, "tree.ron").expect("valid");
    let height = height as f32;
    let stand = Stand { height: Some([height, height]), response: Some(response_of(&kind, swing)), ..scene.stands[0].clone() };
    let mut world = world(stand, Scene { camera: scene.camera.clone(), ..Scene::default() });
    let waves = &mut world.state.layered[0].waves;
    waves.now.fill([0.3, 0.0]);
    waves.old.fill([0.3, 0.0]);
    recorded(swing, &mut world, |world| world.state.layered[0].waves.now[37][0])
}
