//! Files that cannot be plants: words, not panics.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use serde_json::json;
use sward::specimen::grow::{Form, Grow};
use sward::specimen::{Order, Specimen};

use crate::rules::boxes;
use crate::{Test, ready};

pub(crate) const TESTS: &[Test] = &[
    ("broken_plants_are_explained", broken_plants_are_explained),
    ("small_files_cannot_fill_all_memory", small_files_cannot_fill_all_memory),
    ("cut_files_never_panic", cut_files_never_panic),
    ("changed_files_never_panic", changed_files_never_panic),
];

fn message(bytes: &[u8]) -> String {
    ready(bytes, &Order::default()).map_or_else(|error| error.to_string(), |plant| format!("ready: {} leaves", plant.leaves))
}

fn broken_plants_are_explained() {
    let changed = |list: &str, place: usize, key: &str, value: serde_json::Value| {
        let mut glb = boxes(&[json!({"name": "leaf"})]);
        glb.json[list][place][key] = value;
        message(&glb.bytes())
    };
    for (found, words) in [
        (changed("meshes", 0, "primitives", json!([])), "there are no triangles"),
        (changed("nodes", 0, "mesh", json!(5)), "nodes[0] points to meshes[5]"),
        (changed("accessors", 0, "count", json!(9)), "accessors[0] has 9 elements, which reach beyond"),
        (changed("accessors", 1, "componentType", json!(5122)), "indices are needed"),
        (changed("meshes", 0, "primitives", json!([{"attributes": {"POSITION": 0, "TEXCOORD_0": 0}}])), "is of type `VEC3`"),
        (changed("meshes", 0, "primitives", json!([{"attributes": {"POSITION": 0}, "material": 3}])), "points to materials[3]"),
        (changed("nodes", 0, "scale", json!([1e8, 1, 1])), "beyond ±1e7"),
        (changed("nodes", 0, "name", json!("fine")), "ready: 1 leaves"),
        (message(b"{}"), "asset.version"),
    ] {
        assert!(found.contains(words), "wanted {words:?}: {found}");
    }
}

/// Copies count as often as they stand there, before anything is read.
fn small_files_cannot_fill_all_memory() {
    let mut glb = boxes(&[json!({"name": "leaf"})]);
    let indices = glb.accessor(&[0, 1, 2].repeat(100_000), 5121, "SCALAR", 300_000);
    glb.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    let primitive = glb.json["meshes"][0]["primitives"][0].clone();
    let copies = |glb: &mut crate::glb::Glb, count: usize| {
        glb.json["meshes"][0]["primitives"] = json!(vec![&primitive; count]);
        message(&glb.bytes())
    };
    let found = copies(&mut glb, 1000);
    assert!(found.contains("100000000 triangles, at most 4494") && found.contains("join copies"), "{found}");
    assert_eq!(copies(&mut glb, 2), "ready: 1 leaves", "control: both are in one place");
    let mut sparse = boxes(&[json!({"name": "leaf"})]);
    sparse.json["accessors"][0] = json!({"componentType": 5126, "type": "VEC3", "count": 100_000_000, "sparse":
        {"count": 0, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}}});
    assert!(message(&sparse.bytes()).contains("has 100000000 elements"), "{}", message(&sparse.bytes()));
}

fn grown() -> Vec<u8> {
    let mut bytes = Vec::new();
    let plant = Grow { triangles: 2000, ..Grow::new(Form::Bush) };
    plant.mesh().expect("in range").write(&mut bytes).expect("in memory");
    bytes
}

/// Reads; what comes out points at what is there, and is finite.
fn used(bytes: &[u8]) -> bool {
    let Ok(plant) = ready(bytes, &Order::default()) else { return false };
    let sound = |plant: &Specimen| {
        let finite = |vertex: &sward::specimen::SpecimenVertex| {
            vertex.position.iter().chain(&vertex.root).all(|part| part.is_finite()) && (0.0..=1.0).contains(&vertex.shade())
        };
        plant.triangles.iter().flatten().all(|corner| (*corner as usize) < plant.vertices.len()) && plant.vertices.iter().all(finite)
    };
    assert!(sound(&plant));
    true
}

fn cut_files_never_panic() {
    let whole = grown();
    assert!(used(&whole), "control");
    let cuts = (0..200).map(|k| k * whole.len() / 200).chain(whole.len() - 8..whole.len());
    for length in cuts {
        assert!(!used(&whole[..length]), "{length}");
    }
}

fn changed_files_never_panic() {
    let mut files = vec![grown(), boxes(&[json!({"name": "leaf"}), json!({"name": "bark", "alphaMode": "MASK"})]).bytes()];
    // Most of the grown plant is numbers: its words get a turn of their own.
    let mut words = files[0].clone();
    words.truncate(2500);
    files.push(words);
    let strategy = (0..2_usize, any::<bool>(), prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6));
    let counts = std::cell::Cell::new((0, 0));
    let mut runner = TestRunner::new(Config { cases: 400, failure_persistence: None, ..Config::default() });
    let changed = runner.run(&strategy, |(file, early, changes)| {
        let mut bytes = files[file].clone();
        let within = if early { bytes.len().min(2500) } else { bytes.len() };
        changes.iter().for_each(|(at, value)| bytes[at.index(within)] = *value);
        let good = used(&bytes);
        let (a, b) = counts.get();
        counts.set((a + u32::from(good), b + u32::from(!good)));
        Ok(())
    });
    changed.unwrap_or_else(|error| panic!("{error}"));
    let (read, refused) = counts.get();
    println!("{read} changed files were read, {refused} refused");
    assert!(read > 20 && refused > 20);
}
