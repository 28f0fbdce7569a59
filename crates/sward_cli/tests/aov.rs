//! Outputs of each pixel beside pictures: their files, and that pieces of a sequence fit together.

mod support;
use std::collections::BTreeMap;

use exr::prelude::FlatSamples;
use support::Place;

const SEQUENCE: [&str; 10] = ["render", "small.ron", "--fps", "24", "--size", "64x36", "--draw", "cpu", "--aov", "depth,motion,plant"];

/// The files of frames in a folder.
fn frames(place: &Place, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let inside = place.files().into_iter().filter_map(|file| Some(file.strip_prefix(&format!("{folder}/frame_"))?.to_owned()));
    inside.map(|name| (name.clone(), std::fs::read(place.0.join(format!("{folder}/frame_{name}"))).expect("readable"))).collect()
}

fn sequence<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&SEQUENCE[..], more].concat()
}

/// Shape in an array's header, and its numbers as words of four bytes.
fn array(place: &Place, file: &str) -> (String, Vec<u32>) {
    let bytes = std::fs::read(place.0.join(file)).expect("the array exists");
    assert_eq!(&bytes[..6], b"\x93NUMPY");
    let begin = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = String::from_utf8_lossy(&bytes[10..begin]).into_owned();
    let shape = header.split("'shape': (").nth(1).and_then(|rest| rest.split(')').next()).expect("a shape").to_owned();
    (shape, bytes[begin..].as_chunks::<4>().0.iter().map(|word| u32::from_le_bytes(*word)).collect())
}

#[test]
fn arrays_lie_beside_frames() {
    let place = Place::with_small("aov_arrays");
    place.sward(&sequence(&["--frames", "0..3", "-o", "clip"])).done();
    let names: Vec<String> = frames(&place, "clip").into_keys().collect();
    let kinds = ["depth.npy", "motion.npy", "plant.npy", "png"];
    let wanted: Vec<String> = (0..3).flat_map(|frame| kinds.map(|kind| format!("000{frame}.{kind}"))).collect();
    assert_eq!(names, wanted);
    let (shape, depth) = array(&place, "clip/frame_0002.depth.npy");
    assert_eq!((shape.trim_end_matches([',', ' ']), depth.len()), ("36, 64", 36 * 64));
    assert!(depth.iter().all(|bits| f32::from_bits(*bits) >= 0.05));
    assert!(depth.iter().any(|bits| f32::from_bits(*bits).is_infinite()), "there is sky");
    let (shape, motion) = array(&place, "clip/frame_0002.motion.npy");
    assert_eq!((shape.trim_end_matches([',', ' ']), motion.len()), ("36, 64, 2", 36 * 64 * 2));
    assert!(motion.iter().any(|bits| f32::from_bits(*bits).abs() > 0.1), "gusts and a ball move plants");
    let (_, motion) = array(&place, "clip/frame_0000.motion.npy");
    assert!(motion.iter().all(|bits| f32::from_bits(*bits) == 0.0), "nothing is before the first frame");
    let (_, plant) = array(&place, "clip/frame_0002.plant.npy");
    let text = std::fs::read_to_string(place.0.join("clip/frames.json")).expect("it is there");
    let settings: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let bits = |name: &str| settings["aov"]["numbers"][name].as_u64().expect("a number");
    let stands: Vec<u64> = plant.iter().map(|number| u64::from(*number) >> (bits("cell_bits") + 2 * bits("patch_bits"))).collect();
    assert!([0, 1, 2].iter().all(|stand| stands.contains(stand)) && stands.iter().all(|stand| *stand < 3), "both stands and the ground");
    assert!(plant.contains(&1), "the ball is body 1");
}

/// Each piece begins with the motion since the frame before it, which another run drew.
#[test]
fn pieces_fit_together_and_go_on() {
    let place = Place::with_small("aov_pieces");
    place.sward(&sequence(&["--frames", "0..6", "-o", "whole"])).done();
    let whole = frames(&place, "whole");
    place.sward(&sequence(&["--frames", "0..3", "-o", "pieces"])).done();
    place.sward(&sequence(&["--frames", "3..6", "-o", "pieces"])).done();
    assert!(frames(&place, "pieces") == whole, "two pieces are the whole");
    // A frame that lacks one of its files is drawn again, with all of them.
    for lost in ["0002.motion.npy", "0004.png"] {
        std::fs::remove_file(place.0.join(format!("whole/frame_{lost}"))).expect("it was there");
    }
    let said = place.sward(&sequence(&["--frames", "0..6", "-o", "whole", "--resume"])).done();
    assert!(said.contains("4 of them there already"), "{said}");
    assert!(frames(&place, "whole") == whole, "the lost files are there again");
    let other = sequence(&["--frames", "0..6", "-o", "whole", "--resume", "--aov-format", "exr"]);
    place.refuses(&other, &["of another sequence", "--aov"]);
}

/// Name of each channel, and its samples as words of four bytes.
fn channels(place: &Place, file: &str) -> BTreeMap<String, Vec<u32>> {
    let image = exr::prelude::read_first_flat_layer_from_file(place.0.join(file)).expect("OpenEXR");
    let words = |samples: &FlatSamples| match samples {
        FlatSamples::F32(values) => values.iter().map(|value| value.to_bits()).collect(),
        FlatSamples::U32(values) => values.clone(),
        FlatSamples::F16(_) => panic!("half of the bits are lost"),
    };
    let list = image.layer_data.channel_data.list.iter();
    list.map(|channel| (channel.name.to_string(), words(&channel.sample_data))).collect()
}

/// Both formats hold the same bits.
#[test]
fn images_hold_what_arrays_hold() {
    let place = Place::with_small("aov_exr");
    let single = ["--time", "1", "-o", "one.png"];
    place.sward(&sequence(&single)).done();
    place.sward(&sequence(&[&single[..], &["--aov-format", "exr"]].concat())).done();
    let channels = channels(&place, "one.exr");
    assert_eq!(channels.keys().collect::<Vec<_>>(), ["Z", "motion.X", "motion.Y", "plant"]);
    let [depth, motion, plant] = ["depth", "motion", "plant"].map(|name| array(&place, &format!("one.{name}.npy")).1);
    let axis = |first: usize| motion.iter().skip(first).step_by(2).copied().collect::<Vec<_>>();
    assert!([&depth, &plant, &axis(0)].iter().all(|values| values.len() == 64 * 36));
    for (name, array) in [("Z", depth), ("motion.X", axis(0)), ("motion.Y", axis(1)), ("plant", plant)] {
        assert!(channels[name] == array, "{name} is not what the array holds");
    }
    assert!(channels["motion.X"] != axis(1), "control: the two axes can be told apart");
}

#[test]
fn one_picture_has_outputs_too() {
    let place = Place::with_small("aov_single");
    let single = ["render", "small.ron", "--time", "1", "--size", "64x36", "--draw", "cpu", "-o", "one.png", "--aov", "motion,depth"];
    place.sward(&[&single[..], &["--aov-format", "exr", "--fps", "24"]].concat()).done();
    assert_eq!(place.files(), ["one.aov.json", "one.exr", "one.png", "small.ron"]);
    let bytes = std::fs::read(place.0.join("one.exr")).expect("it is there");
    assert_eq!(&bytes[..4], &[0x76, 0x2f, 0x31, 0x01], "OpenEXR");
    place.sward(&single).done();
    let (_, motion) = array(&place, "one.motion.npy");
    assert!(motion.iter().any(|bits| f32::from_bits(*bits).abs() > 0.1), "the frame before is one interval ago");
}

/// Before the work: a folder in the way, and a name that is too long for an output but not for the picture.
#[test]
fn outputs_that_cannot_be_written_are_refused() {
    let place = Place::with_small("aov_in_the_way");
    for (folder, more) in [
        ("one.motion.npy", &["-o", "one.png", "--time", "0"][..]),
        ("one.exr", &["-o", "one.png", "--time", "0", "--aov-format", "exr"]),
        ("one.aov.json", &["-o", "one.png", "--time", "0"]),
        ("clip/frame_0001.plant.npy", &["--frames", "0..2", "-o", "clip"]),
        ("clip/frame_0001.png", &["--frames", "0..2", "-o", "clip"]),
    ] {
        std::fs::create_dir_all(place.0.join(folder)).expect("writable");
        place.refuses(&sequence(more), &[folder, "is a folder", "help: ", "-o"]);
        std::fs::remove_dir(place.0.join(folder)).expect("nothing is in it");
    }
    let long = format!("{}.png", "x".repeat(236));
    place.refuses(&sequence(&["--time", "0", "-o", &long]), &["cannot write to xxx", ".npy", "help: "]);
    std::fs::create_dir_all(place.0.join("one.exr")).expect("writable");
    place.sward(&sequence(&["--time", "0", "-o", "one.png"])).done();
}

#[test]
fn wrong_outputs_are_refused() {
    let place = Place::with_small("aov_refused");
    place.refuses(&["render", "small.ron", "--aov", "depth,colour"], &["colour", "depth", "motion", "plant"]);
    place.refuses(&["render", "small.ron", "--aov-format", "exr"], &["--aov"]);
    place.refuses(&["render", "small.ron", "--fps", "24"], &["--frames"]);
    place.refuses(&["render", "small.ron", "-o", "small.mp4", "--aov", "depth"], &["a clip keeps none", "--frames"]);
    let stand = |index: u32| format!("(species: Reed, cells: 256, name: \"{index}\"),");
    let stands: String = (0..64).map(stand).collect();
    place.write("many.ron", format!("(version: 1, field: (patch_side: 8), stands: [{stands}])"));
    place.refuses(&["render", "many.ron", "--draw", "cpu", "--aov", "plant"], &["cannot be numbered", "leave `plant` out"]);
}
