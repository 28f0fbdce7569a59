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
        let earlier: Vec<String> = frames(&place, "cut").into_keys().collect();
        let before = earlier.len();
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
        assert!(earlier.iter().all(|name| found.contains_key(name)), "attempt {attempt}: {earlier:?} were there, now {:?}", found.keys());
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
    assert!(refused.errors.contains("`small` or a file it names has been changed since"), "{}", refused.errors);
    place.write("small.ron", support::SMALL);
    place.write("clip/frames.state", "SWARDSTATE\u{1}");
    std::fs::remove_file(place.0.join("clip/frame_0023.png")).expect("it was there");
    let refused = place.sward(&[&SEQUENCE[..], &["clip", "--resume"]].concat());
    assert_eq!((refused.status, refused.errors.contains("damaged")), (2, true), "{}", refused.errors);
    assert_eq!(frames(&place, "clip").len(), before.len() - 1);
}

/// Frames of another scene are gone before the first of this one is drawn, so that none is taken for this one's later.
#[test]
fn another_sequence_begins_anew() {
    let place = Place::with_small("anew");
    place.sward(&[&SEQUENCE[..], &["clip"]].concat()).done();
    let other = frames(&place, "clip");
    place.write("small.ron", support::SMALL.replace("budget:", "light: (fog: 0.5),\n    budget:"));
    place.sward(&[&SEQUENCE[..], &["whole"]].concat()).done();
    let whole = frames(&place, "whole");
    assert!(whole.iter().all(|(name, bytes)| other[name] != *bytes), "control: the two scenes can be told apart");
    let mut command = Command::new(env!("CARGO_BIN_EXE_sward"));
    command.current_dir(&place.0).args(SEQUENCE).arg("clip");
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the program starts");
    while std::fs::read(place.0.join("clip/frame_0000.png")).ok().as_ref() != whole.get("frame_0000.png") {
        assert!(child.try_wait().expect("it is ours").is_none(), "its first frame is that of the whole");
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().expect("it is ours");
    assert!(!child.wait().expect("it is ours").success(), "control: it was cut short");
    assert!(frames(&place, "clip").len() < FRAMES, "the other frames are gone");
    place.sward(&[&SEQUENCE[..], &["clip", "--resume"]].concat()).done();
    assert!(frames(&place, "clip") == whole);
}

/// Without settings nobody knows what the frames are of.
#[test]
fn frames_without_settings_are_not_gone_on_from() {
    let place = Place::with_small("no_settings");
    let two = SEQUENCE.map(|word| if word == "0..24" { "0..2" } else { word });
    let resumed = [&two[..], &["clip", "--resume"]].concat();
    for file in ["frame_0003.png", "frame_0003.depth.npy", "frame_0003.exr", "frames.state"] {
        place.write(&format!("clip/{file}"), "of whatever");
        place.refuses(&resumed, &["no frames.json says what they are of", "help: ", "without --resume", "-o DIR/"]);
        std::fs::remove_file(place.0.join("clip").join(file)).expect("it was there");
    }
    let foreign = ["clip/frame_0030.txt", "clip/frame_of_mind.png", "clip/frame_.png"];
    foreign.iter().for_each(|file| place.write(file, "of others"));
    place.sward(&resumed).done();
    // Neither missing settings nor unreadable ones let frames stay that may be of anything.
    for settings in [None, Some("{")] {
        std::fs::remove_file(place.0.join("clip/frames.json")).expect("it was written");
        settings.iter().for_each(|text| place.write("clip/frames.json", text));
        ["clip/frame_0099.png", "clip/frame_0099.motion.npy"].iter().for_each(|file| place.write(file, "of whatever"));
        place.sward(&[&two[..], &["clip"]].concat()).done();
        assert!(!place.files().iter().any(|file| file.contains("0099")), "{:?}", place.files());
    }
    assert!(foreign.iter().all(|file| place.files().contains(&(*file).to_owned())), "what others put there stays");
}

/// The control of all the above: a saved state is what the next frames are drawn from.
#[test]
fn a_saved_state_is_gone_on_from() {
    let place = Place::with_small("state");
    place.sward(&[&SEQUENCE[..], &["clip"]].concat()).done();
    let whole = frames(&place, "clip");
    let mut world =
        sward::world::World::new(sward::scene::Scene::parse(support::SMALL, "").expect("valid"), &sward::model::NoAssets).expect("valid");
    let last = (FRAMES as f64 - 1.0) / 24.0;
    let steps = (last * f64::from(world.scene.steps_per_second)).floor() as u64;
    (0..steps).for_each(|_| world.step());
    let redrawn = |world: &mut sward::world::World| {
        std::fs::remove_file(place.0.join("clip/frame_0023.png")).expect("it was there");
        place.write("clip/frames.state", world.save());
        place.sward(&[&SEQUENCE[..], &["clip", "--resume"]].concat()).done();
        frames(&place, "clip")
    };
    assert!(redrawn(&mut world) == whole, "a state of this sequence changes nothing");
    // One that no run of this scene comes to.
    for cells in world.state.stands.iter_mut().flat_map(|stand| stand.cells.now.iter_mut()) {
        cells.iter_mut().for_each(|value| *value = 0.0);
    }
    let other = redrawn(&mut world);
    assert!(other["frame_0023.png"] != whole["frame_0023.png"], "the state was not used");
    assert!(other.iter().all(|(name, bytes)| name == "frame_0023.png" || whole[name] == *bytes));
}

/// The state is saved on the way to the first frame, too.
#[test]
fn steps_before_the_first_frame_are_not_run_again() {
    let place = Place::with_small("on_the_way");
    let late = SEQUENCE.map(|word| if word == "0..24" { "240..241" } else { word });
    let mut command = Command::new(env!("CARGO_BIN_EXE_sward"));
    command.current_dir(&place.0).args(late).args(["clip", "--save-every", "0"]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the program starts");
    while !place.0.join("clip/frames.state").exists() {
        assert!(child.try_wait().expect("it is ours").is_none(), "a state is there before the frame");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("it is ours");
    child.wait().expect("it is ours");
    assert!(frames(&place, "clip").is_empty() && place.0.join("clip/frames.state").exists());
    place.sward(&[&late[..], &["clip", "--resume"]].concat()).done();
    place.sward(&[&late[..], &["whole"]].concat()).done();
    assert!(frames(&place, "clip").len() == 1 && frames(&place, "clip") == frames(&place, "whole"));
}

/// Files that a scene names are part of what its frames are of.
#[test]
fn frames_of_other_files_are_not_mixed() {
    let place = Place::new("other_files");
    place.write("small.ron", support::SMALL.replace("version: 1,", "version: 1, terrain: Image(path: \"dem.png\"),"));
    let sidecar = "columns = 8\nrows = 8\nmetres_per_pixel_x = 30\nmetres_per_pixel_y = 30\nmin_height_m = 0\nmax_height_m = 9\n";
    let terrain = |height: u16, sidecar: &str| {
        let image = image::ImageBuffer::from_fn(8, 8, |x, y| image::Luma([if (x, y) == (3, 3) { height } else { 0 }]));
        image.save(place.0.join("dem.png")).expect("writable");
        place.write("dem.toml", sidecar);
    };
    terrain(10, sidecar);
    place.sward(&[&SEQUENCE[..], &["clip"]].concat()).done();
    let resumed = [&SEQUENCE[..], &["clip", "--resume"]].concat();
    assert!(place.sward(&resumed).done().contains("24 of them there already"));
    for (height, sidecar) in [(11, sidecar), (10, &sidecar.replace("= 9", "= 8"))] {
        terrain(height, sidecar);
        place.refuses(&resumed, &["`small` or a file it names has been changed since", "help: "]);
    }
    terrain(10, sidecar);
    assert!(place.sward(&resumed).done().contains("24 of them there already"), "control: the same bytes are the same terrain");
}
