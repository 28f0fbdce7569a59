//! Clips as this program alone can judge them.

use std::process::{Command, Stdio};
use std::time::Duration;

use crate::boxes::{boxes, inside, number, numbers};
use crate::support::Place;

/// A small clip; what follows says where, and how long.
const CLIP: [&str; 8] = ["render", "small.ron", "--size", "160x90", "--on", "cpu", "--draw", "cpu"];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&CLIP[..], more].concat()
}

/// Frames and units of time a second, as the boxes tell.
fn length(bytes: &[u8]) -> (usize, f64) {
    let time = inside(bytes, "moov/trak/mdia/mdhd");
    let seconds = f64::from(number(time, 16)) / f64::from(number(time, 12));
    (number(inside(bytes, "moov/trak/mdia/minf/stbl/stsz"), 8) as usize, seconds)
}

pub(crate) fn the_boxes_tell_what_was_asked_for() {
    let place = Place::with_small("clip_boxes");
    let said = place.sward(&with(&["--frames", "2..14", "-o", "a.mp4"])).done();
    for word in ["a.mp4", "12 frames", "24 a second", "160x90", "encoded in"] {
        assert!(said.contains(word), "no `{word}` in {said}");
    }
    assert_eq!(place.files(), ["a.mp4", "small.ron"], "the frames are gone");
    let bytes = std::fs::read(place.0.join("a.mp4")).expect("it is there");
    let kinds: Vec<String> = boxes(&bytes).into_iter().map(|(kind, _)| kind).collect();
    assert_eq!(kinds, ["ftyp", "moov", "mdat"], "a player needs not read to the end before it can begin");
    let (kind, frames) = (inside(&bytes, "ftyp"), inside(&bytes, "mdat"));
    assert!(kind[8..].chunks(4).any(|brand| brand == b"av01"), "{kind:?}");
    assert_eq!(length(&bytes), (12, 0.5));
    let movie = inside(&bytes, "moov/mvhd");
    assert_eq!(f64::from(number(movie, 16)) / f64::from(number(movie, 12)), 0.5);
    let track = inside(&bytes, "moov/trak/tkhd");
    assert_eq!([number(track, 76), number(track, 80)], [160 << 16, 90 << 16]);
    let table = |kind: &str| inside(&bytes, &format!("moov/trak/mdia/minf/stbl/{kind}"));
    // Twelve frames, each a 24th of a second.
    let time = inside(&bytes, "moov/trak/mdia/mdhd");
    assert_eq!(numbers(table("stts"), 4), [1, 12, number(time, 12) / 24]);
    assert_eq!(numbers(table("stss"), 4), [1, 1], "the first frame needs no others");
    assert_eq!(numbers(table("stsc"), 4), [1, 1, 12, 1]);
    let sizes = numbers(table("stsz"), 12);
    assert_eq!(sizes.iter().sum::<u32>() as usize, frames.len());
    let begin = number(table("stco"), 8) as usize;
    assert_eq!(bytes[begin..].as_ptr(), frames.as_ptr(), "the frames begin where the table says");
    let configuration = table("stsd/av01/av1C");
    assert_eq!(configuration[0], 0x81, "marker and version");
    assert_eq!(configuration[2] & 0b0111_1100, 0b0000_1100, "8 bits, colour, 4:2:0");
    // The sequence header is a unit of type 1, there and at the head of the first frame; no frame begins with a delimiter, type 2.
    assert_eq!(configuration[4] >> 3, 1);
    assert!(frames.starts_with(&configuration[4..]));
    let mut at = 0;
    for size in sizes {
        assert_ne!(frames[at] >> 3 & 15, 2);
        at += size as usize;
    }
    assert_eq!(table("stsd/av01/colr"), [&b"nclx"[..], &[0, 1, 0, 13, 0, 1, 0]].concat(), "BT.709, sRGB, BT.709, limited");
}

pub(crate) fn two_runs_write_the_same_bytes() {
    let place = Place::with_small("clip_twice");
    place.sward_with(&with(&["--frames", "0..6", "-o", "a.mp4"]), &[("RAYON_NUM_THREADS", "1")]).done();
    place.sward_with(&with(&["--frames", "0..6", "-o", "b.mp4"]), &[("RAYON_NUM_THREADS", "3")]).done();
    place.sward(&with(&["--frames", "1..7", "-o", "c.mp4"])).done();
    let [a, b, c] = ["a.mp4", "b.mp4", "c.mp4"].map(|file| std::fs::read(place.0.join(file)).expect("it is there"));
    assert!(a == b);
    assert!(a != c, "control: other frames are other bytes");
}

pub(crate) fn a_clip_lasts_as_long_as_was_asked_for() {
    let place = Place::with_small("clip_lasts");
    for (more, wanted) in [
        (&["--seconds", "0.25"][..], (6, 0.25)),
        (&["--seconds", "0.2", "--fps", "30"], (6, 0.2)),
        (&["--frames", "7..8", "--fps", "60"], (1, 1.0 / 60.0)),
    ] {
        place.sward(&with(&[more, &["--clip"]].concat())).done();
        let (frames, seconds) = length(&std::fs::read(place.0.join("small.mp4")).expect("named like the scene"));
        assert!(frames == wanted.0 && (seconds - wanted.1).abs() < 1e-9, "{more:?}: {frames} frames, {seconds} s");
    }
}

/// Killed while it draws or encodes: its frames are kept, the clip is not there, and in the end is what it would have been.
pub(crate) fn an_interrupted_clip_goes_on() {
    let place = Place::with_small("clip_killed");
    let twelve = ["--frames", "0..12", "--save-every", "0", "-o"];
    place.sward(&with(&[&twelve[..], &["whole.mp4"]].concat())).done();
    let whole = std::fs::read(place.0.join("whole.mp4")).expect("it is there");
    let drawn = || {
        let entries = std::fs::read_dir(place.0.join("cut.mp4.frames")).into_iter().flatten().flatten();
        entries.filter(|entry| entry.file_name().to_string_lossy().starts_with("frame_")).count()
    };
    let mut cut_short = 0;
    for wanted in [1, 5, 12] {
        let before = drawn();
        let mut command = Command::new(env!("CARGO_BIN_EXE_sward"));
        command.current_dir(&place.0).args(with(&[&twelve[..], &["cut.mp4", "--resume"]].concat()));
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the program starts");
        while drawn() < wanted && child.try_wait().expect("it is ours").is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().expect("it is ours");
        if child.wait().expect("it is ours").success() {
            break;
        }
        assert!(!place.0.join("cut.mp4").exists(), "what has the clip's name is whole");
        assert!(drawn() >= before.max(wanted), "no frame is lost");
        cut_short += 1;
    }
    assert!(cut_short > 0, "control: nothing was ever cut short");
    let said = place.sward(&with(&[&twelve[..], &["cut.mp4", "--resume"]].concat())).done();
    assert!(said.contains("of them there already"), "{said}");
    assert!(std::fs::read(place.0.join("cut.mp4")).expect("it is there") == whole);
    assert_eq!(place.files(), ["cut.mp4", "small.ron", "whole.mp4"], "nothing unfinished is left");
}

pub(crate) fn a_damaged_frame_is_named() {
    let place = Place::with_small("clip_damaged");
    place.sward(&with(&["--frames", "0..3", "--fps", "24", "-o", "a.mp4.frames/"])).done();
    place.write("a.mp4.frames/frame_0001.png", "not a picture");
    let ran = place.sward(&with(&["--frames", "0..3", "-o", "a.mp4", "--resume"]));
    assert_eq!(ran.status, 1, "{}", ran.errors);
    assert!(ran.errors.contains("frame_0001.png") && ran.errors.contains("remove it"), "{}", ran.errors);
    assert!(!place.0.join("a.mp4").exists());
    std::fs::remove_file(place.0.join("a.mp4.frames/frame_0001.png")).expect("it was there");
    let said = place.sward(&with(&["--frames", "0..3", "-o", "a.mp4", "--resume"])).done();
    assert!(said.contains("2 of them there already"), "{said}");
}

pub(crate) fn what_others_put_beside_the_frames_stays() {
    let place = Place::with_small("clip_others");
    place.write("a.mp4.frames/notes.txt", "mine");
    place.write("a.mp4.frames/frame_of_mind.png", "mine too");
    place.sward(&with(&["--frames", "0..2", "-o", "a.mp4"])).done();
    assert_eq!(place.files(), ["a.mp4", "a.mp4.frames", "a.mp4.frames/frame_of_mind.png", "a.mp4.frames/notes.txt", "small.ron"]);
}

pub(crate) fn contradictions_are_refused() {
    let place = Place::with_small("clip_refused");
    place.write("file.mp4.frames", "x");
    std::fs::create_dir(place.0.join("folder")).expect("writable");
    let cases: [(&[&str], &[&str]); 19] = [
        (&["-o", "a.mp4", "--time", "1"], &["--time is the moment of a picture", "a.png", "--seconds"]),
        (&["--clip", "--time", "1"], &["--time is the moment of a picture"]),
        (&["--clip", "-o", "a.png"], &["clips are MP4 files", "-o a.mp4", "leave --clip out"]),
        (&["--clip", "-o", "folder"], &["is a folder", "-o folder/small.mp4"]),
        (&["--clip", "-o", "new/"], &["is a folder", "small.mp4"]),
        (&["-o", "missing/a.mp4"], &["the folder missing does not exist", "mkdir -p missing"]),
        (&["-o", "file.mp4"], &["file.mp4.frames is a file"]),
        (&["-o", "a.mp4", "--seconds", "0"], &["no frame", "--seconds 0.0417"]),
        (&["-o", "a.mp4", "--seconds", "NaN"], &["seconds"]),
        (&["-o", "a.mp4", "--seconds", "-1"], &["seconds"]),
        (&["-o", "a.mp4", "--seconds", "1000000"], &["frames go up to", "--seconds 41666"]),
        (&["-o", "a.mp4", "--seconds", "1", "--frames", "0..2"], &["cannot be used with"]),
        (&["-o", "a.mp4", "--fps", "0"], &["1..=1000"]),
        (&["-o", "a.mp4", "--fps", "NaN"], &["--fps"]),
        (&["-o", "a.mp4", "--fps", "1001"], &["1..=1000"]),
        (&["--seconds", "1"], &["--seconds is the length of a clip", "-o small.mp4"]),
        (&["--resume"], &["--resume", "-o small.mp4", "--frames"]),
        (&["--save-every", "1"], &["--save-every", "-o small.mp4", "--frames"]),
        (&["--frames", "0..2", "-o", "a/", "--seconds", "1"], &["cannot be used with"]),
    ];
    for (more, words) in cases {
        place.refuses(&with(more), words);
    }
    let sizes = [
        ("15x90", "type --size 16x90"),
        ("160x8", "type --size 160x16"),
        ("161x90", "type --size 162x90"),
        ("960x541", "type --size 960x542"),
        ("16384x16384", "too large"),
    ];
    for (size, words) in sizes {
        place.refuses(&["render", "small.ron", "-o", "a.mp4", "--size", size], &[words, "clip"]);
    }
    #[cfg(target_os = "linux")]
    place.refuses(&with(&["-o", "/proc/a.mp4", "--frames", "0..2"]), &["cannot write to /proc/a.mp4", "type -o"]);
}
