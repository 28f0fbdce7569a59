//! A saved state continues as if it had never stopped, and no bytes can hurt.

use std::path::Path;

use proptest::prelude::*;
use sward::model::{Folder, NoAssets};
use sward::saved::{SavedError, VERSION};
use sward::scene::Scene;
use sward::world::World;

fn shipped(name: &str) -> World {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut scene = Scene::parse(&std::fs::read_to_string(root.join(format!("scenes/{name}.ron"))).unwrap(), name).unwrap();
    scene.stands.iter_mut().for_each(|stand| stand.cells = Some(stand.cells().min(32)));
    scene.budget.patches = 12;
    World::new(scene, &Folder(root)).unwrap()
}

fn small(more: &str) -> World {
    let text = format!(
        "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 8{more})], wind: [Natural(velocity: (3, 1))],
         interactors: [(shape: Sphere(radius: 0.6), path: Circle(radius: 4, speed: 3))], budget: (patches: 9, focus_distance: 8))"
    );
    World::new(Scene::parse(&text, "small.ron").unwrap(), &NoAssets).unwrap()
}

fn run(world: &mut World, steps: u32) -> u64 {
    (0..steps).for_each(|_| world.step());
    world.hash()
}

#[test]
fn continuing_equals_never_having_stopped() {
    let make = |name: &str| if name == "history" { small(", response: Continuum(lag: History)") } else { shipped(name) };
    for name in ["hello", "crossing", "reed", "downwash", "history", "footsteps", "stamp", "walkers", "eddies", "aquarium"] {
        let mut first = make(name);
        run(&mut first, 137);
        let saved = first.save();
        let expected = run(&mut first, 150);
        let mut second = make(name);
        let fresh = run(&mut second, 150);
        second.restore(&saved).unwrap();
        assert_eq!(second.save(), saved, "{name}: saving what was loaded gives the same bytes");
        assert_eq!(run(&mut second, 150), expected, "{name}");
        assert_eq!(second.save(), first.save(), "{name}: upper segments, bodies and counters too");
        assert_ne!(fresh, expected, "control: {name} from the start is another state");
    }
}

#[test]
fn other_versions_scenes_and_damage_are_refused() {
    let mut world = small("");
    run(&mut world, 40);
    let (saved, before) = (world.save(), world.hash());
    assert_eq!(world.restore(b"(version: 1)"), Err(SavedError::NotOne));
    let mut other = saved.clone();
    other[10] += 1;
    assert_eq!(world.restore(&other), Err(SavedError::Version(VERSION + 1)));
    for cut in [10, 13, 21, 22, saved.len() / 2, saved.len() - 1] {
        assert!(matches!(world.restore(&saved[..cut]), Err(SavedError::Damaged(_))), "cut at {cut}");
    }
    let mut changed = saved.clone();
    let middle = changed.len() / 2;
    changed[middle] ^= 4;
    assert!(matches!(world.restore(&changed), Err(SavedError::Damaged(_))));
    assert_eq!(world.hash(), before, "the world is as it was");
    let wider = "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 16)],
        interactors: [(shape: Sphere(radius: 0.6))])";
    let mut wider = World::new(Scene::parse(wider, "wider.ron").unwrap(), &NoAssets).unwrap();
    let error = wider.restore(&saved).unwrap_err();
    assert_eq!(error.to_string(), "this state was saved from another scene: cells a patch side 8 in it, 16 in the scene");
    assert_eq!(small("").restore(&saved), Ok(()), "control: the right scene takes it");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if cfg!(debug_assertions) { 400 } else { 4000 }))]

    /// Whatever a damaged payload holds: it is refused, or what comes of it steps on without a panic.
    #[test]
    fn damaged_payloads_never_panic(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12), early in any::<bool>(), swings in any::<bool>()) {
        let make = || small(if swings { ", response: Oscillator()" } else { "" });
        let mut world = make();
        run(&mut world, 3);
        let mut payload = world.save().split_off(22);
        let reach = if early { payload.len().min(400) } else { payload.len() };
        for (index, byte) in changes {
            payload[index.index(reach)] = byte;
        }
        if world.restore_payload(&payload).is_ok() {
            run(&mut world, 3);
        }
    }
}
