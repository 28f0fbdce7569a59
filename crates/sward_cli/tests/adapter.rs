//! What needs a graphics adapter. Without one these tests are ignored, not passed; with `CI` set they fail.

mod support;
use libtest_mimic::{Arguments, Failed, Trial};
use support::Place;
use sward_wgpu::gpu::Gpu;

fn main() {
    let arguments = Arguments::from_args();
    let missing = Gpu::new().is_err() && std::env::var_os("CI").is_none();
    let tests: [(&str, fn()); 10] = [
        ("without_arguments_a_first_picture_is_made", without_arguments_a_first_picture_is_made),
        ("render_writes_one_picture_of_the_asked_size", render_writes_one_picture_of_the_asked_size),
        ("render_writes_a_sequence_of_frames", render_writes_a_sequence_of_frames),
        ("render_refuses_what_the_adapter_cannot_draw", render_refuses_what_the_adapter_cannot_draw),
        ("more_cells_than_a_buffer_holds_are_refused", more_cells_than_a_buffer_holds_are_refused),
        ("compare_finds_agreement", compare_finds_agreement),
        ("compare_shows_what_half_precision_costs", compare_shows_what_half_precision_costs),
        ("bench_times_every_pass_on_the_device", bench_times_every_pass_on_the_device),
        ("compare_does_not_call_nothing_agreement", compare_does_not_call_nothing_agreement),
        ("simulate_writes_the_same_shapes_on_the_gpu", simulate_writes_the_same_shapes_on_the_gpu),
    ];
    let trials = tests.map(|(name, test)| Trial::test(name, move || ran(test)).with_ignored_flag(missing));
    libtest_mimic::run(&arguments, trials.into()).exit();
}

fn ran(test: fn()) -> Result<(), Failed> {
    test();
    Ok(())
}

/// Runs `sward` and returns what it said. Drivers may grumble on stderr, so only the status counts.
fn said(place: &Place, arguments: &[&str]) -> String {
    let ran = place.sward(arguments);
    assert_eq!(ran.status, 0, "{arguments:?}: {}{}", ran.text, ran.errors);
    ran.text
}

/// Width and height in a PNG's header.
fn size_of(place: &Place, file: &str) -> [u32; 2] {
    let bytes = std::fs::read(place.0.join(file)).expect("the picture exists");
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]))
}

fn without_arguments_a_first_picture_is_made() {
    let place = Place::new("hello");
    let text = said(&place, &[]);
    assert_eq!(size_of(&place, "hello.png"), [960, 540]);
    for word in ["hello.png", "960x540", "drawn on", "Try next:"] {
        assert!(text.contains(word), "no `{word}` in\n{text}");
    }
    assert_eq!(text.lines().filter(|line| line.starts_with("  sward ")).count(), 3, "{text}");
}

fn render_writes_one_picture_of_the_asked_size() {
    let place = Place::with_small("render");
    for on in ["auto", "cpu", "gpu"] {
        let text = said(&place, &["render", "small.ron", "--size", "64x36", "--time", "0.1", "--on", on, "--draw", "gpu"]);
        assert!(text.contains("small.png") && text.contains("64x36") && text.contains("0.10 s"), "{text}");
        assert_eq!(size_of(&place, "small.png"), [64, 36]);
    }
    // Cells stepped on the GPU, drawn on the CPU.
    let text = said(&place, &["render", "small.ron", "--size", "64x36", "--time", "0.1", "--on", "gpu", "--draw", "cpu"]);
    assert!(text.contains("drawn on the CPU") && !text.contains("simulated on the CPU"), "{text}");
    assert_eq!(said(&place, &["render", "small.ron", "--size", "8x8", "--time", "0", "-o", "a.png", "-q"]), "");
    assert_eq!(place.files(), ["a.png", "small.png", "small.ron"]);
}

fn render_writes_a_sequence_of_frames() {
    let place = Place::with_small("frames");
    said(&place, &["render", "small.ron", "--size", "32x18", "--frames", "2..5", "--fps", "24", "-o", "clip/"]);
    assert_eq!(
        place.files(),
        ["clip", "clip/frame_0002.png", "clip/frame_0003.png", "clip/frame_0004.png", "clip/frames.json", "small.ron"]
    );
    assert_eq!(size_of(&place, "clip/frame_0004.png"), [32, 18]);
}

fn render_refuses_what_the_adapter_cannot_draw() {
    Place::with_small("too_large").refuses(&["render", "small.ron", "--size", "16384x16"], &["too large", "--size"]);
}

fn more_cells_than_a_buffer_holds_are_refused() {
    let place = Place::new("too_many_cells");
    let simulate = |species: &str, patches: u32| {
        let text = format!(
            "(version: 1, field: (patch_side: 8), stands: [(species: {species}, cells: 256)], wind: [Natural()],
             budget: (patches: {patches}, focus_distance: 90))"
        );
        place.write("many.ron", text);
        place.sward(&["simulate", "many.ron", "--steps", "1", "--on", "gpu", "-o", "data"])
    };
    // Lawn has one segment; those above it, near a camera, need room of their own.
    let cases =
        [("Lawn", ["do not fit one buffer", "ower budget.patches"]), ("Meadow", ["buffer of upper segments", "ower budget.lag_distance"])];
    for (species, words) in cases {
        let ran = simulate(species, if species == "Lawn" { 512 } else { 120 });
        assert_eq!((ran.status, ran.text.as_str()), (2, ""), "{}", ran.errors);
        for words in words.into_iter().chain(["help: ", "--on cpu"]) {
            assert!(ran.errors.contains(words), "{species}: no `{words}` in {}", ran.errors);
        }
        assert_eq!(place.files(), ["data", "many.ron"], "no array and no manifest");
    }
    let control = simulate("Meadow", 16);
    assert_eq!(control.status, 0, "{}", control.errors);
}

fn compare_finds_agreement() {
    let text = said(&Place::with_small("compare"), &["compare", "small.ron", "--steps", "40"]);
    for word in ["activation", "bend", "rate", "upper segments", "p99.9", "outliers", "Tolerance"] {
        assert!(text.contains(word), "no `{word}` in\n{text}");
    }
    assert!(!text.contains("over the tolerance"), "{text}");
}

fn compare_shows_what_half_precision_costs() {
    let place = Place::with_small("compare_half");
    let compared = |precision| said(&place, &["compare", "small.ron", "--steps", "40", "--precision", precision]);
    let (half, full) = (compared("half"), compared("full"));
    assert!(half.contains("at half precision") && !half.contains("over the tolerance"), "{half}");
    assert!(!full.contains("at half precision"), "{full}");
    let numbers = |text: &str| text.lines().filter(|line| line.contains(" bend ")).map(str::to_owned).collect::<Vec<_>>();
    assert!(!numbers(&half).is_empty() && numbers(&half) != numbers(&full), "{half}{full}");
}

fn bench_times_every_pass_on_the_device() {
    let place = Place::with_small("bench_gpu");
    let measured = |precision: &str| -> serde_json::Value {
        let arguments =
            ["bench", "small.ron", "--steps", "12", "--warm-up", "3", "--size", "48x27", "--on", "gpu", "--draw", "gpu", "-o", precision];
        said(&place, &[&arguments[..], &["--precision", precision]].concat());
        serde_json::from_str(&std::fs::read_to_string(place.0.join(precision).join("bench.json")).expect("written")).expect("JSON")
    };
    let (full, half) = (measured("full"), measured("half"));
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    for (report, each, precision) in [(&full, 32.0, "full"), (&half, 16.0, "half")] {
        assert_eq!(report["precision"], precision);
        assert_eq!(number(&report["memory"]["state"]), each * number(&report["memory"]["cells_awake"]));
        assert!(number(&report["memory"]["state_allocated"]) >= number(&report["memory"]["state"]));
        assert!(number(&report["counters"]["bytes_moved"]) > 1.4 * each * number(&report["counters"]["cell_steps"]));
        assert!(number(&report["half_to_full"]["median"]) > 0.0);
        let passes: Vec<&str> =
            report["device_stages"].as_array().expect("a list").iter().filter_map(|row| row["stage"].as_str()).collect();
        // An adapter without a clock times none.
        assert!(passes.is_empty() || ["wave_pass", "prepare", "shadow"].iter().all(|pass| passes.contains(pass)), "{passes:?}");
    }
    assert_eq!(full["counters"]["cell_steps"], half["counters"]["cell_steps"]);
    // The wave moves three times 8 bytes less; contact moves the same.
    let moved = |report: &serde_json::Value| number(&report["counters"]["bytes_moved"]);
    assert!(moved(&full) - moved(&half) >= 24.0 * number(&full["counters"]["cell_steps"]));
}

fn compare_does_not_call_nothing_agreement() {
    let place = Place::new("compare_nothing");
    place.write("still.ron", "(version: 1, stands: [(species: Meadow, cells: 8)])");
    let ran = place.sward(&["compare", "still.ron", "--steps", "4"]);
    assert_eq!(ran.status, 1, "{}", ran.text);
    assert!(ran.errors.contains("nothing was compared"), "{}", ran.errors);
}

fn simulate_writes_the_same_shapes_on_the_gpu() {
    let place = Place::with_small("simulate_gpu");
    let arrays = |on: &str| {
        said(&place, &["simulate", "small.ron", "--steps", "8", "--on", on, "-o", on]);
        let text = std::fs::read_to_string(place.0.join(on).join("manifest.json")).expect("there is a manifest");
        let manifest: serde_json::Value = serde_json::from_str(&text).expect("valid JSON");
        assert!(manifest["arrays"].as_array().is_some_and(|arrays| !arrays.is_empty()));
        manifest["arrays"].clone()
    };
    assert_eq!(arrays("cpu"), arrays("gpu"));
}
