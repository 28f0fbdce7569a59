//! The same bits for every number of threads, every set of instructions, every caller, and in debug and release.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use sward::lanes::Lanes;
use sward::model::Folder;
use sward::scene::Scene;
use sward::world::World;

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
