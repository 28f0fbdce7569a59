//! The same scene again changes no bit of what follows.

use std::path::{Path, PathBuf};

use super::run;
use sward::model::Folder;
use sward::scene::Scene;
use sward::world::World;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A shipped scene on coarser cells, so that steps are fast.
fn scene(name: &str) -> Scene {
    let file = root().join(format!("scenes/{name}.ron"));
    let mut scene = Scene::parse(&std::fs::read_to_string(file).unwrap(), name).unwrap();
    scene.stands.iter_mut().for_each(|stand| stand.cells = Some(stand.cells().min(32)));
    scene.budget.patches = 12;
    scene
}

#[test]
fn the_same_scene_again_changes_no_bit() {
    for name in ["hello", "footsteps", "stamp", "crown", "eddies", "blades", "road"] {
        let scene = scene(name);
        let mut untouched = World::new(scene.clone(), &Folder(root())).unwrap();
        run(&mut untouched, 70);
        let mut world = untouched.clone();
        let kept = world.rescene(scene.clone(), &Folder(root())).unwrap();
        assert!(kept.is_all(), "{name}: {kept:?}");
        assert_eq!((kept.bodies.len(), kept.stands.len()), (scene.interactors.len(), scene.stands.len()), "{name}");
        assert!(world.save() == untouched.save(), "{name}: everything that is saved is the same");
        for part in 0..3 {
            assert_eq!(run(&mut world, 20), run(&mut untouched, 20), "{name}, part {part}");
        }
        assert!(world.save() == untouched.save(), "{name}: upper segments, bodies and counters too");
        let mut fresh = World::new(scene, &Folder(root())).unwrap();
        assert_ne!(run(&mut fresh, 60), world.hash(), "control: {name} from the start is another state");
    }
}
