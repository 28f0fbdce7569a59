//! Commands that only answer: show, scenes, scene-format, completions, help.

mod support;
use support::Place;

/// Names of the scenes in the repository.
fn in_the_repository() -> Vec<String> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let entries = std::fs::read_dir(folder).expect("the repository has scenes");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .map(|path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert!(!names.is_empty());
    names
}

#[test]
fn scenes_lists_every_scene_of_the_repository() {
    let text = Place::new("scenes").sward(&["scenes"]).done();
    let mut names: Vec<&str> = text.lines().filter_map(|line| line.split_whitespace().next()).collect();
    names.sort_unstable();
    assert_eq!(names, in_the_repository());
    assert!(text.contains("Hello, meadow"));
}

#[test]
fn a_printed_scene_can_be_used() {
    let place = Place::new("printed");
    place.write("mine.ron", place.sward(&["scenes", "lawn"]).done());
    assert_eq!(place.sward(&["show", "mine.ron"]).done(), place.sward(&["show", "lawn"]).done());
}

#[test]
fn show_works_for_every_shipped_scene() {
    let place = Place::new("show");
    for name in in_the_repository() {
        let text = place.sward(&["show", &name]).done();
        let kinds = [("virtual blades", "have a state"), ("swings at", "after a body"), ("sheets of", "after a body")];
        if !text.contains("bytes a patch") {
            // Nothing but meshes.
            for word in ["Hz", "damping ratio", "leaves", "layers", "wind", "body", "budget"] {
                assert!(text.contains(word), "{name}: no `{word}` in\n{text}");
            }
            continue;
        }
        let own = kinds.iter().find(|(kind, _)| text.contains(kind)).map_or("substep", |(_, word)| word);
        let [rate, ratio] = if text.contains("sheets of") { ["springs of stiffness", "sweeps"] } else { ["Hz", "damping ratio"] };
        for word in [rate, ratio, own, "plants", "bytes a patch", "MB at most", "wind", "body", "budget", "segment"] {
            assert!(text.contains(word), "{name}: no `{word}` in\n{text}");
        }
    }
    assert!(place.files().is_empty());
}

#[test]
fn show_prints_the_numbers_of_the_paper() {
    let text = Place::new("paper").sward(&["show", "paper"]).done();
    // 88² patches of 120² cells; two time levels of four numbers of four bytes a cell.
    for word in ["88 x 88 patches of 54.864 m", "about 111 513 600 plants", "0.457 m", "460 800 bytes a patch", "in 225 patches"] {
        assert!(text.contains(word), "no `{word}` in\n{text}");
    }
}

/// A cell: eight numbers of four bytes, three more on hills or where something keeps plants away; half of the eight at half precision.
#[test]
fn show_counts_hills_limits_and_precision() {
    let place = Place::new("hills");
    let show = |stand: &str, more: &str| {
        let scene = format!("(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 64, cover: 1{stand})]{more})");
        place.write("hills.ron", scene);
        place.sward(&["show", "hills.ron"]).done()
    };
    let (hills, half) = (", detail: (amplitude: 0.5)", ", budget: (precision: Half, patches: 100)");
    let disc = ", exclusions: [(area: Disc(radius: 2)";
    for (stand, more, bytes, plants) in [
        ("", String::new(), "131 072 bytes", ", about 4 096 plants"),
        ("", hills.to_owned(), "180 224 bytes", ", about 4 096 plants"),
        ("", half.to_owned(), "65 536 bytes", ", about 4 096 plants"),
        ("", format!("{hills}{half}"), "114 688 bytes", ", about 4 096 plants"),
        ("", format!("{disc})]"), "180 224 bytes", ", at most about 4 096 plants"),
        ("", format!("{disc}, stands: [\"meadow\"])]"), "180 224 bytes", ", at most about 4 096 plants"),
        (", slope: (0, 0.4)", String::new(), "180 224 bytes", ", at most about 4 096 plants"),
    ] {
        let text = show(stand, &more);
        assert!(text.contains(bytes) && text.contains(plants), "no `{bytes}` or no `{plants}` in\n{text}");
        assert_eq!(text.contains("of cells at most on a GPU, "), more.contains("Half"), "{text}");
    }
}

#[test]
fn show_works_for_an_empty_scene() {
    let place = Place::new("empty");
    place.write("empty.ron", "(version: 1)");
    let text = place.sward(&["show", "empty.ron"]).done();
    for word in ["nothing grows", "calm air", "nothing pushes"] {
        assert!(text.contains(word), "no `{word}` in\n{text}");
    }
}

#[test]
fn scene_format_is_the_reference_page() {
    let text = Place::new("format").sward(&["scene-format"]).done();
    assert_eq!(text.trim_end(), sward::scene::reference().trim_end());
}

#[test]
fn completions_exist_for_every_shell() {
    let place = Place::new("completions");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = place.sward(&["completions", shell]).done();
        assert!(script.contains("simulate") && script.contains("sward"), "{shell}");
    }
}

#[test]
fn help_is_short_with_h_and_has_examples_with_help() {
    let place = Place::new("help");
    let (short, long) = (place.sward(&["-h"]).done(), place.sward(&["--help"]).done());
    assert!(short.lines().count() < 30, "{short}");
    assert!(long.contains("Examples:") && !short.contains("Examples:"));
    for command in ["render", "simulate", "compare", "show", "fit", "grow", "scenes", "scene-format", "completions"] {
        assert!(short.contains(command), "{command}");
        let about = place.sward(&[command, "--help"]).done();
        assert!(about.contains("Usage: sward"), "{command}");
    }
    assert!(place.sward(&["--version"]).done().starts_with("sward "));
    for status in ["0 done", "1 failed", "2 wrong input"] {
        assert!(short.contains(status), "{short}");
    }
}

#[test]
fn without_an_adapter_what_needs_one_fails_and_writes_nothing() {
    let place = Place::with_small("no_adapter");
    let commands: [&[&str]; 6] = [
        &["render", "small.ron", "--draw", "gpu"],
        &["render", "small.ron", "--on", "gpu"],
        &["render", "small.ron", "--on", "gpu", "--draw", "cpu"],
        &["render", "small.ron", "--draw", "gpu", "--frames", "0..2", "-o", "clip"],
        &["compare", "small.ron"],
        &["simulate", "small.ron", "--steps", "2", "--on", "gpu", "-o", "data"],
    ];
    for arguments in commands {
        let ran = place.sward_with(arguments, &[("SWARD_ADAPTER", "none")]);
        assert_eq!((ran.status, ran.text.as_str()), (1, ""), "{arguments:?}: {}", ran.errors);
        assert!(ran.errors.contains("no graphics adapter found"), "{}", ran.errors);
    }
    // Whoever names an adapter wants that one, not the CPU.
    let ran = place.sward_with(&["render", "small.ron"], &[("SWARD_ADAPTER", "nobody has this name")]);
    if ran.errors.contains("no graphics adapter found") {
        // Where there is none at all, the CPU draws.
        assert_eq!(ran.status, 0, "{}", ran.errors);
    } else {
        assert_eq!((ran.status, ran.text.as_str()), (2, ""), "{}", ran.errors);
        assert!(["SWARD_ADAPTER is \"nobody has this name\"", "help: "].iter().all(|words| ran.errors.contains(words)), "{}", ran.errors);
        assert_eq!(place.files(), ["small.ron"]);
    }
}

#[test]
fn grown_plants_are_written_and_shown() {
    let place = Place::new("grow");
    let said = place.sward(&["grow", "bush"]).done();
    assert!(said.contains("bush.glb: 1.5 m high, ") && said.contains("triangles, "), "{said}");
    place.sward(&["grow", "water-plant", "-o", "weed.glb", "--seed", "7", "--triangles", "5000", "--height", "0.4", "-q"]).done();
    assert_eq!(place.files(), ["bush.glb", "weed.glb"]);
    let bush = place.sward(&["show", "bush.glb"]).done();
    for word in ["1.50 m above its root", "leaves dark: leaf, ", "bark: wood, ", "each with a root", "two-sided"] {
        assert!(bush.contains(word), "no `{word}` in\n{bush}");
    }
    let weed = place.sward(&["show", "weed.glb"]).done();
    assert!(weed.contains("0.40 m above its root") && weed.contains(" and 0 of wood"), "{weed}");
    let again = Place::new("grow_again");
    again.sward(&["grow", "bush"]).done();
    let read = |place: &Place| std::fs::read(place.0.join("bush.glb")).expect("written");
    assert!(read(&place) == read(&again), "two runs write the same bytes");
    place.sward(&["grow", "bush", "--seed", "1"]).done();
    assert!(read(&place) != read(&again), "control: another seed is another plant");
}

/// A plant that swings at 0.3 Hz with a damping ratio of 0.05, four samples a second, a line each.
fn pull(name: &str, sign: &str, decimal: &str) -> String {
    let line = |k: u32| {
        let time = 0.25 * f64::from(k);
        let value = 1e-4 * (-0.05 * std::f64::consts::TAU * 0.3 * time).exp() * (std::f64::consts::TAU * 0.29962 * time).cos();
        format!("{name}{time:.2}{sign}{value:.9}\n").replace('.', decimal)
    };
    (0..160).map(line).collect()
}

#[test]
fn fit_measures_recordings() {
    let place = Place::new("fit");
    let good = ["0.2996", "0.3000", "0.0500", "response: Oscillator(frequency: 0.3, damping: 0.05), // "];
    let files = [
        ("plain.csv", pull("", ",", ".")),
        ("named.csv", format!("time_s,strain\n{}", pull("", ",", "."))),
        ("excel.csv", format!("\u{feff}Zeit;Dehnung\r\n{}", pull("", ";", ",").replace('\n', "\r\n"))),
        ("tabs.txt", pull("oak\t", "\t", ".")),
        (
            "several.csv",
            format!(
                "recording,time_s,strain\n{}still,0,1\n{}",
                pull("oak,", ",", "."),
                (1..40).map(|k| format!("still,{k},1\n")).collect::<String>()
            ),
        ),
    ];
    for (name, text) in files {
        place.write(name, text);
        let said = place.sward(&["fit", name]).done();
        assert!(good.iter().all(|word| said.contains(word)), "{name}: {said}");
        assert_eq!(said.contains("still     not a single mode: nothing moves"), name == "several.csv", "{said}");
    }
    let one = place.sward(&["fit", "several.csv", "--recording", "oak", "--to", "chain"]).done();
    assert!(!one.contains("still") && one.contains("response: Chain(damping: 0.05, frequency: 0.3), // oak"), "{one}");
    let json = place.sward(&["fit", "several.csv", "--json"]).done();
    let lines: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let number = |name: &str| lines[0][name].as_f64().expect("a number");
    assert!(
        (number("frequency_hz") - 0.3).abs() < 1e-4 && (number("damping_ratio") - 0.05).abs() < 1e-4 && number("r_squared") > 0.9999,
        "{json}"
    );
    assert_eq!((&lines[1]["single_mode"], &lines[1]["reason"]), (&false.into(), &"nothing moves".into()), "{json}");
    let slower = pull("", ",", ".")
        .lines()
        .enumerate()
        .map(|(k, line)| format!("{},{}\n", 0.3 * k as f64, line.split_once(',').expect("two").1))
        .collect::<String>();
    place.write("slower.csv", slower);
    let said = place.sward(&["fit", "slower.csv"]).done();
    assert!(said.contains("0.2500") && !said.contains("0.3000"), "control: {said}");
}

/// What is to be pasted is a stand's, and swings as is said.
#[test]
fn fit_prints_what_a_scene_takes() {
    let place = Place::new("fit_translates");
    let said = place.sward(&["fit", "--from", "chain", "--to", "continuum"]).done();
    for word in ["Chain      swings at", "Continuum  swings at", "explains", "// c0 and c_omega: ", "// gamma_top and gamma_recover: "] {
        assert!(said.contains(word), "no `{word}` in {said}");
    }
    let lines = said.lines().skip_while(|line| !line.starts_with("response: ")).collect::<Vec<_>>().join("\n");
    place.write("mine.ron", format!("(version: 1, stands: [(species: Meadow,\n{lines}\n)])"));
    let json = place.sward(&["fit", "--scene", "mine.ron", "--to", "oscillator", "--json"]).done();
    let again: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let swings_at = again["from"]["swings_at_hz"].as_f64().expect("a number");
    assert!(said.contains(&format!("Continuum  swings at {swings_at:.3} Hz")), "{said}{json}");
    let reed = place.sward(&["fit", "--from", "chain", "--to", "continuum", "--species", "reed"]).done();
    assert_ne!(reed, said, "control: another species");
    let rod = place.sward(&["fit", "--from", "oscillator", "--to", "chain", "--species", "reed"]).done();
    assert!(rod.contains("// this response cannot swing so"), "{rod}");
}
