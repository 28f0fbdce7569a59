//! Pictures on the CPU: nothing but this program is needed.

mod support;
use support::Place;

const NONE: [(&str, &str); 1] = [("SWARD_ADAPTER", "none")];

/// Width and height in a PNG's header.
fn size_of(place: &Place, file: &str) -> [u32; 2] {
    let bytes = std::fs::read(place.0.join(file)).expect("the picture exists");
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]))
}

#[test]
fn without_an_adapter_the_first_picture_is_drawn_on_the_cpu() {
    let place = Place::new("first_on_cpu");
    let ran = place.sward_with(&[], &NONE);
    assert_eq!(ran.status, 0, "{}", ran.errors);
    assert_eq!(size_of(&place, "hello.png"), [960, 540]);
    assert!(ran.text.contains("drawn on the CPU") && ran.text.contains("Try next:"), "{}", ran.text);
    let note = "sward: no graphics adapter found; the picture is drawn on the CPU";
    assert_eq!(ran.errors.trim_end(), note, "one line says so");
    let bytes = std::fs::metadata(place.0.join("hello.png")).expect("it exists").len();
    assert!(bytes > 51_200, "{bytes} bytes are too few to show a meadow");
}

#[test]
fn auto_falls_back_to_what_cpu_draws() {
    let place = Place::with_small("fallback");
    let draw = |file: &str, options: &[&str]| {
        let ran = place.sward_with(&[&["render", "small.ron", "--size", "64x36", "--time", "0.2", "-o", file], options].concat(), &NONE);
        assert_eq!(ran.status, 0, "{}", ran.errors);
        assert_eq!(size_of(&place, file), [64, 36]);
        ran
    };
    assert_eq!(draw("auto.png", &[]).errors.lines().count(), 1);
    // What was asked for, or in silence, needs no note.
    let asked = draw("cpu.png", &["--draw", "cpu"]);
    assert!(asked.done().contains("simulated on the CPU, drawn on the CPU"));
    assert_eq!(draw("quiet.png", &["-q"]).done(), "");
    let bytes = |file: &str| std::fs::read(place.0.join(file)).expect("it exists");
    assert_eq!(bytes("auto.png"), bytes("cpu.png"));
    assert_eq!(bytes("auto.png"), bytes("quiet.png"));
    draw("later.png", &["--draw", "cpu", "--on", "cpu"]);
    assert_eq!(bytes("later.png"), bytes("cpu.png"));
}

#[test]
fn a_sequence_is_drawn_on_the_cpu() {
    let place = Place::with_small("frames_on_cpu");
    place.sward(&["render", "small.ron", "--size", "32x18", "--frames", "2..5", "--draw", "cpu", "-o", "clip/"]).done();
    assert_eq!(
        place.files(),
        ["clip", "clip/frame_0002.png", "clip/frame_0003.png", "clip/frame_0004.png", "clip/frames.json", "small.ron"]
    );
    let bytes = |frame: u32| std::fs::read(place.0.join(format!("clip/frame_000{frame}.png"))).expect("it exists");
    assert_ne!(bytes(2), bytes(4), "time passes");
}
