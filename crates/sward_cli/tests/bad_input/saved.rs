//! Interrupted sequences whose files cannot be gone on from.

use crate::support::Place;

const SEQUENCE: [&str; 16] = [
    "render",
    "small.ron",
    "--frames",
    "0..3",
    "--fps",
    "30",
    "--size",
    "32x18",
    "--on",
    "cpu",
    "--draw",
    "cpu",
    "--save-every",
    "0",
    "-o",
    "clip",
];

/// A sequence whose last frame is missing, and its saved state.
fn interrupted(name: &str) -> (Place, Vec<u8>) {
    let place = Place::with_small(name);
    place.sward(&SEQUENCE).done();
    std::fs::remove_file(place.0.join("clip/frame_0002.png")).expect("it was drawn");
    let scene = sward::scene::Scene::parse(crate::support::SMALL, "small.ron").expect("a scene");
    let mut world = sward::world::World::new(scene, &sward::model::NoAssets).expect("a world");
    (0..3).for_each(|_| world.step());
    (place, world.save())
}

fn resumed() -> Vec<&'static str> {
    [&SEQUENCE[..], &["--resume"]].concat()
}

#[test]
fn settings_of_another_format_are_refused() {
    let (place, _) = interrupted("bad_settings");
    let text = std::fs::read_to_string(place.0.join("clip/frames.json")).expect("it is there");
    let refuse = |bytes: &[u8], words: &[&str]| {
        place.write("clip/frames.json", bytes);
        place.refuses(&resumed(), &[&["clip/frames.json", "help: ", "without --resume the sequence begins anew"], words].concat());
    };
    refuse(text.replace("\"version\": 1", "\"version\": 2").as_bytes(), &["it has format version 2, expected 1"]);
    refuse(b"{\"version\": 99, \"novelty\": true}", &["it has format version 99, expected 1"]);
    refuse(text.replace("\"version\": 1,", "").as_bytes(), &["it has no format version, expected \"version\": 1"]);
    refuse(text.replace("\"version\": 1", "\"version\": -1").as_bytes(), &["it has no format version"]);
    refuse(&text.as_bytes()[..text.len() / 2], &["line"]);
    refuse(b"", &["line 1 column 0"]);
    refuse(b"{\"version\": 1}", &["missing field"]);
    refuse(&[0xff, 0xfe], &["UTF-8"]);
    refuse("[".repeat(100_000).as_bytes(), &["recursion limit"]);
    place.write("clip/frames.json", text);
    place.sward(&resumed()).done();
}

#[test]
fn states_that_cannot_be_gone_on_from_are_refused() {
    let (place, state) = interrupted("bad_state");
    let refuse = |bytes: &[u8], words: &[&str]| {
        place.write("clip/frames.state", bytes);
        place.refuses(&resumed(), &[&["clip/frames.state", "help: ", "remove clip/frames.state"], words].concat());
    };
    let changed = |at: usize| {
        let mut bytes = state.clone();
        bytes[at] ^= 3;
        bytes
    };
    refuse(b"", &["not a saved state", "SWARDSTATE"]);
    refuse(b"(version: 1)", &["not a saved state", "SWARDSTATE"]);
    refuse(&changed(10), &["format version 11, expected 8", "save it again"]);
    refuse(&state[..12], &["damaged", "it ends too soon"]);
    refuse(&state[..state.len() - 1], &["damaged", "checksum"]);
    for at in [15, 22, 40, state.len() / 2, state.len() - 1] {
        refuse(&changed(at), &["damaged", "checksum"]);
    }
    place.write("clip/frames.state", &state);
    place.sward(&resumed()).done();
    assert!(place.files().contains(&"clip/frame_0002.png".to_owned()));
}
