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

/// Runs `scene` with whatever files lie beside it: it is refused at a line and column of the scene, with all `words`.
fn refuses(place: &Place, scene: &str, at: &str, words: &[&str]) {
    place.write("test.ron", scene);
    let position = format!("test.ron:{at}: ");
    let words = [&[position.as_str(), "help: "][..usize::from(!at.is_empty())], words].concat();
    place.refuses(&["simulate", "test.ron", "--steps", "1", "-o", "data"], &words);
}

/// The same scene is taken once its file is whole: what is refused above is refused for its fault.
fn takes(place: &Place, scene: &str) {
    place.write("test.ron", scene);
    place.sward(&["simulate", "test.ron", "--steps", "1", "-o", "control"]).done();
    assert!(place.files().contains(&"control/manifest.json".to_owned()));
    std::fs::remove_dir_all(place.0.join("control")).expect("it is there");
}
