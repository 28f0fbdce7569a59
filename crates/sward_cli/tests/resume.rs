//! Sequences that are killed at any moment go on: no finished frame is lost, none is ever half-written.

mod support;
use std::collections::BTreeMap;
use std::process::{Command, Stdio};
use std::time::Duration;

use support::Place;

const FRAMES: usize = 24;
const SEQUENCE: [&str; 13] =
    ["render", "small.ron", "--frames", "0..24", "--fps", "24", "--size", "96x54", "--on", "cpu", "--draw", "cpu", "-o"];

/// The frames of a folder: name and bytes.
fn frames(place: &Place, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let Ok(entries) = std::fs::read_dir(place.0.join(folder)) else { return BTreeMap::new() };
    let name = |entry: &std::fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
    let all = entries.flatten().filter(|entry| name(entry).starts_with("frame_"));
    all.map(|entry| (name(&entry), std::fs::read(entry.path()).expect("readable"))).collect()
}

#[test]
fn killed_at_any_moment_it_goes_on() {
    let place = Place::with_small("killed");
    place.sward(&[&SEQUENCE[..], &["whole"]].concat()).done();
    let whole = frames(&place, "whole");
    assert_eq!(whole.len(), FRAMES);
    let (mut seed, mut cut_short) = (12345_u64, 0);
    for attempt in 0..16 {
        let before = frames(&place, "cut").len();
        let mut command = Command::new(env!("CARGO_BIN_EXE_sward"));
        command.current_dir(&place.0).args(SEQUENCE).args(["cut", "--resume", "--save-every", "0"]);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the program starts");
        // Every other time a frame is waited for, on machines of any speed; then it may happen at any moment.
        while attempt % 2 == 0 && frames(&place, "cut").len() == before && child.try_wait().expect("it is ours").is_none() {
            std::thread::sleep(Duration::from_millis(2));
        }
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        std::thread::sleep(Duration::from_millis((seed >> 33) % 250));
        // Kill is SIGKILL: nothing of the program runs any more.
        child.kill().expect("it is ours");
        let ended = child.wait().expect("it is ours").success();
        let found = frames(&place, "cut");
        for (name, bytes) in &found {
            assert!(whole.get(name) == Some(bytes), "attempt {attempt}: {name} is not the frame it should be");
        }
        cut_short += u32::from(!ended && found.len() > before && found.len() < FRAMES);
        if ended {
            break;
        }
    }
    assert!(cut_short > 0, "control: nothing was ever cut short");
    let said = place.sward(&[&SEQUENCE[..], &["cut", "--resume"]].concat()).done();
    assert!(said.contains("there already"), "{said}");
    assert!(frames(&place, "cut") == whole, "the frames of the pieces are those of the whole");
    let left: Vec<String> = place.files().into_iter().filter(|file| file.contains(".part") || file.contains("frames.state")).collect();
    assert_eq!(left, [""; 0], "nothing unfinished is left");
}

/// A lost frame in the middle is drawn again, though the saved state is later.
#[test]
fn missing_frames_are_drawn_again() {
    let place = Place::with_small("missing_frames");
    place.sward(&[&SEQUENCE[..], &["clip"]].concat()).done();
    let whole = frames(&place, "clip");
    for lost in ["frame_0003.png", "frame_0011.png"] {
        std::fs::remove_file(place.0.join("clip").join(lost)).expect("it was there");
    }
    let said = place.sward(&[&SEQUENCE[..], &["clip", "--resume"]].concat()).done();
    assert!(said.contains("22 of them there already"), "{said}");
    assert!(frames(&place, "clip") == whole);
}

#[test]
fn frames_of_another_sequence_are_not_mixed() {
    let place = Place::with_small("mixed");
    place.sward(&[&SEQUENCE[..], &["clip"]].concat()).done();
    let before = frames(&place, "clip");
    let with = |from: &str, to: &str| SEQUENCE.map(|word| if word == from { to.to_owned() } else { word.to_owned() }).to_vec();
    for (arguments, words) in [(with("96x54", "64x36"), "they are 96x54 pixels"), (with("24", "12"), "there are 24 a second")] {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).chain(["clip", "--resume"]).collect();
        place.refuses(&arguments, &["of another sequence", words]);
    }
    place.write("small.ron", support::SMALL.replace("Natural()", "Uniform()"));
    let refused = place.sward(&[&SEQUENCE[..], &["clip", "--resume"]].concat());
    assert_eq!(refused.status, 2);
    assert!(refused.errors.contains("`small` has been changed since"), "{}", refused.errors);
    place.write("small.ron", support::SMALL);
    place.write("clip/frames.state", "SWARDSTATE\u{1}");
    std::fs::remove_file(place.0.join("clip/frame_0023.png")).expect("it was there");
    let refused = place.sward(&[&SEQUENCE[..], &["clip", "--resume"]].concat());
    assert_eq!((refused.status, refused.errors.contains("damaged")), (2, true), "{}", refused.errors);
    assert_eq!(frames(&place, "clip").len(), before.len() - 1);
}
