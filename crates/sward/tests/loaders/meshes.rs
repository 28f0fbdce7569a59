//! Bodies from glTF: containers, JSON, numbers.

use serde_json::Value;
use sward::figure::Figure;
use sward::scene::Scene;

use crate::chance::Chance;
use crate::glb::{Glb, pack, post, table, walker};
use crate::glue::{Files, used};
use crate::{bytes, run, tree};

fn bodies() -> Vec<Glb> {
    vec![walker(), post(), table()]
}

/// A world with that body, playing its first clip; whether it was taken.
fn moved(file: &[u8]) -> bool {
    let Ok(figure) = Figure::read(file, &|_| Err("nothing is beside it".to_owned()), 3) else { return false };
    for time in [0.0, 0.3, 1e5] {
        let frames = figure.pose((!figure.clips.is_empty()).then_some(0), time);
        for posed in figure.parts.iter().filter_map(|part| part.posed(&frames[part.frame as usize])) {
            assert!(posed.under.iter().chain(&posed.gradient).all(|part| part.is_finite()), "{posed:?}");
        }
    }
    let clip = figure.clips.first().map_or_else(String::new, |clip| format!(", clip: {:?}", clip.name));
    let text = format!(
        "(version: 1, field: (patch_side: 8), stands: [(species: Lawn, cells: 16)], budget: (patches: 9),
         interactors: [(shape: Mesh(file: \"a.glb\", pieces: 3{clip}), path: Circle(radius: 2, speed: 3))])"
    );
    // A clip may be called anything, also what is no text in a scene.
    let Ok(scene) = Scene::parse(&text, "body.ron") else { return false };
    used(scene, &Files(vec![("a.glb", file.to_vec())]))
}

/// Damage to the JSON, to the numbers, or to the whole.
fn harmed(body: &Glb, others: &[Vec<u8>], chance: &mut Chance) -> Vec<u8> {
    let (mut json, mut binary) = (body.json.clone(), body.binary.clone());
    json["buffers"] = serde_json::json!([{"byteLength": binary.len()}]);
    let kind = chance.below(8);
    if kind < 4 {
        tree::mutate(&mut json, chance);
    }
    if (3..6).contains(&kind) {
        let length = binary.len();
        bytes::mutate(&mut binary, others, chance);
        if chance.one_in(2) {
            binary.resize(length, 0);
        }
    }
    let text = if chance.one_in(60) { deep(&json, chance) } else { json.to_string() };
    let mut file = if chance.one_in(10) { text.into_bytes() } else { pack(text.as_bytes(), &binary) };
    if kind >= 6 {
        bytes::mutate(&mut file, others, chance);
        if kind == 7 {
            bytes::seal_glb(&mut file);
        }
    }
    file
}

/// The JSON with something nested without end in it.
fn deep(json: &Value, chance: &mut Chance) -> String {
    let depth = 1 + chance.index(20_000);
    let (open, close) = *chance.pick(&[("[", "]"), ("{\"x\":", "}")]);
    let rest = json.to_string();
    format!("{{\"extras\":{}1{},{}", open.repeat(depth), close.repeat(depth), &rest[1..])
}

#[test]
fn bodies_never_panic() {
    let bodies = bodies();
    let files: Vec<Vec<u8>> = bodies.iter().map(Glb::bytes).collect();
    assert!(files.iter().all(|file| moved(file)), "control: unharmed files are taken");
    let tally = run("bodies", 0.12, |chance| moved(&harmed(chance.pick(&bodies), &files, chance)));
    tally.is_mixed(0.005);
}
