//! Bad input of every kind: an error that names file and place and says what was expected and what to type, status 2, nothing written.

mod bodies;
mod outputs;
mod pictures;
mod saved;
mod scenes;
mod tiffs;

#[path = "../support/mod.rs"]
mod support;

use support::Place;

/// How a message says what to type instead, where no help follows it: by a range, or by what to do with a file.
const ADVICE: [&str; 10] = [
    "allowed ",
    "; export ",
    ": export it ",
    "; copy or export ",
    "; make it smaller",
    "; correct ",
    "; add ",
    "; expected are ",
    "leave ",
    "; join ",
];

/// Messages that say what is wrong and no more.
const BARE: [&str; 4] =
    ["not with \"glTF\" (.glb) or \"{\" (.gltf)", "it has no JSON chunk", "unclosed block comment", "expected identifier"];

/// Runs `scene` with whatever files lie beside it: it is refused at a line and column of the scene, with all `words` and what to type.
/// Without `at`, the place is among the words.
fn refuses(place: &Place, scene: &str, at: &str, words: &[&str]) {
    place.write("test.ron", scene);
    let position = format!("test.ron:{at}: ");
    let words = [&[position.as_str()][..usize::from(!at.is_empty())], words].concat();
    let said = place.refuses(&["simulate", "test.ron", "--steps", "1", "-o", "data"], &words);
    // The lines below are the scene's.
    let message = said.split('╭').next().unwrap_or_default();
    let advised = said.contains("help: ") || ADVICE.iter().any(|words| message.contains(words));
    assert!(
        advised != BARE.iter().any(|words| message.contains(words)),
        "what to type is not said, or is said of what is listed as bare:\n{said}"
    );
}

/// The same scene is taken once its file is whole: what is refused above is refused for its fault.
fn takes(place: &Place, scene: &str) {
    place.write("test.ron", scene);
    place.sward(&["simulate", "test.ron", "--steps", "1", "-o", "control"]).done();
    assert!(place.files().contains(&"control/manifest.json".to_owned()));
    std::fs::remove_dir_all(place.0.join("control")).expect("it is there");
}
