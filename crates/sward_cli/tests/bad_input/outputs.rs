//! Places that cannot be written to are found before the work begins.

use crate::support::Place;

fn commands(picture: &str, folder: &str) -> [Vec<String>; 4] {
    let words = |line: &str| line.split(' ').map(str::to_owned).collect::<Vec<_>>();
    [
        words(&format!("render small.ron --on cpu --draw cpu --size 32x18 --time 0 -o {picture}")),
        words(&format!("render small.ron --on cpu --draw cpu --size 32x18 --frames 0..2 -o {folder}")),
        words(&format!("simulate small.ron --steps 1 -o {folder}")),
        words(&format!("bench small.ron --steps 1 --warm-up 0 --draw cpu --size 32x18 -o {folder}")),
    ]
}

fn refuse_all(place: &Place, picture: &str, folder: &str, words: &[&str]) {
    for command in commands(picture, folder) {
        let arguments: Vec<&str> = command.iter().map(String::as_str).collect();
        place.refuses(&arguments, &[&["help: ", "type", "-o"], words].concat());
    }
}

#[test]
fn places_that_cannot_be_written_to_are_refused() {
    let place = Place::with_small("unwritable");
    let long = "x".repeat(300);
    refuse_all(&place, &format!("{long}.png"), &long, &["cannot write to xxx"]);
    #[cfg(target_os = "linux")]
    refuse_all(&place, "/proc/small.png", "/proc/data", &["cannot write to /proc/"]);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        std::os::unix::fs::symlink("nowhere", place.0.join("dangling")).expect("writable");
        let command = &commands("", "dangling")[2];
        place.refuses(&command.iter().map(String::as_str).collect::<Vec<_>>(), &["dangling", "help: ", "-o"]);
        let locked = place.0.join("locked");
        std::fs::create_dir(&locked).expect("writable");
        let allow = |mode| std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(mode)).expect("it is ours");
        allow(0o555);
        // Root may write everywhere.
        let root = std::fs::write(locked.join("try"), "").is_ok();
        if !root {
            refuse_all(&place, "locked/a.png", "locked", &["cannot write to locked", "denied"]);
            refuse_all(&place, "locked/a.png", "locked/new", &["cannot write to locked", "denied"]);
        }
        allow(0o755);
    }
}

#[test]
fn places_inside_a_file_are_refused() {
    let place = Place::with_small("inside_a_file");
    for command in commands("small.ron/a.png", "small.ron/data") {
        let arguments: Vec<&str> = command.iter().map(String::as_str).collect();
        place.refuses(&arguments, &["the folder small.ron does not exist", "help: ", "mkdir -p small.ron"]);
    }
}

#[test]
fn places_that_can_be_written_to_are_taken() {
    let place = Place::with_small("writable");
    for command in commands("a.png", "new") {
        let arguments: Vec<&str> = command.iter().map(String::as_str).collect();
        place.sward(&arguments).done();
    }
    let files = place.files();
    assert!(["a.png", "new/frame_0001.png", "new/manifest.json", "new/bench.json"].iter().all(|file| files.contains(&(*file).to_owned())));
    assert!(!files.iter().any(|file| file.ends_with(".part")), "{files:?}");
}
