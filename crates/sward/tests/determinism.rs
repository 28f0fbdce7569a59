//! The same bits for every number of threads, every set of instructions, every caller, and in debug and release.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use sward::lanes::Lanes;
use sward::math::{hash, unit};
use sward::model::Folder;
use sward::scene::{Change, Circle, Edit, Interactor, Natural, Path as Way, Scene, Shape, Sphere, WindSource, response};
use sward::world::{Log, World};

const STEPS: u32 = 300;
/// Shipped scenes that go into the golden file: hills, gusts, several stands; many bodies; a gale; blade by blade; plants that swing; sheets;
/// sheets and skinned bodies; air that flows.
const SCENES: [&str; 9] = ["hello", "crossing", "reed", "grassland", "footsteps", "stamp", "walkers", "eddies", "crown"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A shipped scene on coarser cells, so that three hundred steps take a second or two.
fn world(name: &str) -> World {
    let file = root().join("scenes").join(format!("{name}.ron"));
    let mut scene = Scene::parse(&std::fs::read_to_string(&file).expect("shipped"), name).expect("valid");
    scene.stands.iter_mut().for_each(|stand| stand.cells = Some(if stand.cells() > 64 { 64 } else { stand.cells().min(32) }));
    scene.budget.focus_distance = 24.0;
    scene.budget.patches = 12;
    World::new(scene, &Folder(root())).expect("valid")
}

fn after(name: &str, lanes: Lanes, threads: usize) -> u64 {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        let mut world = world(name);
        world.lanes = lanes;
        (0..STEPS).for_each(|_| world.step());
        let moves = world.state.layered.iter().any(|stand| stand.waves.now.iter().flatten().any(|part| *part != 0.0));
        assert!(moves || world.state.stands.iter().any(|stand| !stand.awake.is_empty()), "{name}: something is awake");
        world.hash()
    })
}

#[test]
fn hashes_equal_the_golden_ones() {
    let mut text = String::from("# World::hash() after 300 steps. Re-mint with SWARD_ACCEPT=1 only when the change is meant.\n");
    for name in SCENES {
        writeln!(text, "{name} {:016x}", after(name, Lanes::default(), 2)).expect("a string");
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/determinism.golden");
    if std::env::var_os("SWARD_ACCEPT").is_some_and(|value| value == "1") {
        std::fs::write(&file, &text).expect("writable");
    }
    let golden = std::fs::read_to_string(&file).expect("tests/determinism.golden; SWARD_ACCEPT=1 writes it");
    assert_eq!(golden.replace("\r\n", "\n"), text, "expected (left) and actual (right) differ; SWARD_ACCEPT=1 accepts");
}

#[test]
fn threads_and_instructions_do_not_change_a_bit() {
    let expected = after("crossing", Lanes::Baseline, 1);
    for lanes in Lanes::available() {
        assert_eq!(after("crossing", lanes, 1), expected, "{lanes:?}");
    }
    for threads in [2, 5] {
        assert_eq!(after("crossing", Lanes::default(), threads), expected, "{threads} threads");
    }
    let mut other = world("crossing");
    other.scene.interactors[0].clearance += 0.1;
    (0..STEPS).for_each(|_| other.step());
    assert_ne!(other.hash(), expected, "control: another scene has another hash");
}

/// Callers at odd rates reach the same steps; only when does not matter.
#[test]
fn wall_clock_slices_do_not_change_a_bit() {
    let mut steady = world("crossing");
    let hashes: Vec<u64> = (0..100).map(|_| (steady.step(), steady.hash()).1).collect();
    for slices in [vec![1.0 / 30.0], vec![1.0 / 144.0], vec![0.001], vec![0.013, 0.002, 0.031]] {
        let (mut world, mut calls) = (world("crossing"), 0);
        while world.state.step < 90 {
            let before = world.state.step;
            let steps = world.advance(slices[calls % slices.len()]);
            assert_eq!(world.state.step - before, u64::from(steps));
            calls += 1;
        }
        assert_eq!(world.state.dropped_steps, 0);
        assert_eq!(world.hash(), hashes[world.state.step as usize - 1], "{slices:?}");
        assert_ne!(world.hash(), hashes[world.state.step as usize], "control: a step more is another state");
    }
}

/// Steps of a replay: fewer where all debug checks are on.
const REPLAYED: u64 = if cfg!(debug_assertions) { 400 } else { 10_000 };

/// A small world of which each response of grass has a stand.
fn lived_at_first() -> Scene {
    let text = "(version: 1, field: (patch_side: 8, patches: (2, 2)), camera: (eye: (3, 2, 1), target: (3, 0.5, 4)),
        budget: (patches: 9, focus_distance: 1),
        stands: [(species: Meadow, cells: 8), (species: Tussock, cells: 8, response: Oscillator()),
                 (species: Meadow, name: \"sheets\", cells: 8, cover: 0.3, response: Springs()),
                 (species: Reed, cells: 8, cover: 0.1, response: VirtualInertia(), representation: Blade(blades: 2))],
        wind: [Natural(velocity: (2, 1))])";
    Scene::parse(text, "meddled.ron").expect("valid")
}

/// A run in which hosts do something every twenty steps: bodies come, jump and go, wind changes, grass is cut
/// and tuned. The numbers are drawn from the step.
fn meddled() -> (World, Log) {
    let mut world = World::new(lived_at_first(), &Folder(root())).expect("valid");
    world.record();
    let (mut bodies, mut winds) = (Vec::new(), Vec::new());
    while world.state.step < REPLAYED {
        let drawn = |purpose: u32| f64::from(unit(hash(7, world.state.step as i32, 0, 0, purpose)));
        let (at, what) = ([8.0 * drawn(0), 8.0 * drawn(1)], (8.0 * drawn(2)) as u32);
        match what {
            0 | 1 if bodies.len() < 3 => {
                let shape = Shape::Sphere(Sphere { radius: 0.2 + 0.3 * drawn(3) as f32 });
                let path = Way::Circle(Circle { centre: at, radius: 1.5, speed: 2.0, ..Circle::default() });
                bodies.push(world.add_body(Interactor { shape, path, ..Interactor::default() }, &Folder(root())).expect("a ball"));
            }
            2 if !bodies.is_empty() => assert!(world.remove_body(bodies.remove(0))),
            3 if !bodies.is_empty() => assert!(world.teleport(bodies[0], at, drawn(3), 0.0)),
            4 if winds.len() < 2 => {
                let gust = WindSource::Natural(Natural { velocity: [4.0 * drawn(3) as f32 - 2.0, 1.0], ..Natural::default() });
                winds.push(world.add_wind(gust, 0.5, &Folder(root())).expect("a wind"));
            }
            5 if !winds.is_empty() => assert!(world.remove_wind(winds.remove(0), 0.5)),
            6 => {
                let change = if drawn(3) < 0.5 { Change::Burn } else { Change::Regrow(Default::default()) };
                world.edit(&Edit { at, radius: 1.0, change, ..Edit::default() }).expect("an edit");
            }
            _ => world.tune(0, response("Continuum(frequency: 2)").expect("a response"), 0.3).expect("tuned"),
        }
        (0..20).for_each(|_| world.step());
    }
    let log = world.log.take().expect("recorded");
    (world, log)
}

/// Ten thousand steps of a recorded run, lived on four threads and replayed from its text on one: the same to the bit; what bodies feel and events, too.
#[test]
fn a_recorded_run_is_the_same_for_ever() {
    let on = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let (mut lived, log) = on(4).install(meddled);
    let inputs = Log::parse(&log.to_ron()).expect("a log");
    assert!(inputs.inputs.len() > REPLAYED as usize / 50, "control: hosts did something");
    let mut again = on(1).install(|| {
        let mut world = World::new(lived_at_first(), &Folder(root())).expect("valid");
        inputs.replay(&mut world, &Folder(root()), &mut |_| ()).expect("replayed");
        world
    });
    assert_eq!(again.hash(), lived.hash());
    assert!(again.save() == lived.save(), "other bytes");
    assert_eq!(again.take_events(), lived.take_events());
    // Control: a hundred steps, and one input less.
    let first = |mut log: Log| {
        log.steps = 100;
        let mut world = World::new(lived_at_first(), &Folder(root())).expect("valid");
        log.replay(&mut world, &Folder(root()), &mut |_| ()).map(|()| world.hash()).ok()
    };
    let mut less = inputs.clone();
    less.inputs.remove(0);
    assert_ne!(first(less), first(inputs), "control: one input less");
}
