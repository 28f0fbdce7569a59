//! `sward bench` measures what it says it measures.

mod support;
use support::Place;

fn measured(place: &Place, scene: &str, folder: &str) -> serde_json::Value {
    let arguments = ["bench", scene, "--steps", "12", "--warm-up", "3", "--size", "48x27", "--draw", "cpu", "-o", folder];
    let table = place.sward(&arguments).done();
    for word in ["stage", "p50 ms", "contact", "picture", "triad", "MB of state", "at full precision"] {
        assert!(table.contains(word), "no `{word}` in\n{table}");
    }
    let report: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(place.0.join(folder).join("bench.json")).expect("written")).expect("JSON");
    // Where no cell is touched there is no speed to tell.
    assert_eq!(table.contains("response: "), report["counters"]["cell_steps"] != 0, "{table}");
    report
}

#[test]
fn bench_counts_the_same_work_every_time_and_times_every_stage() {
    let place = Place::with_small("bench");
    let (first, second) = (measured(&place, "small.ron", "first"), measured(&place, "small.ron", "second"));
    assert_eq!(first["counters"], second["counters"]);
    assert_eq!(first["memory"], second["memory"]);
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    assert!(number(&first["counters"]["cell_steps"]) > 0.0 && number(&first["triad_gb_per_s"]) > 0.1);
    assert_eq!(number(&first["memory"]["state"]), 32.0 * number(&first["memory"]["cells_awake"]));
    let stages = first["stages"].as_array().expect("a list");
    let samples: Vec<(&str, u64)> =
        stages.iter().map(|row| (row["stage"].as_str().expect("a name"), row["samples"].as_u64().expect("a count"))).collect();
    let named = ["plan: bodies, wind, activation", "rest", "contact", "wave", "upper segments", "file reports"].map(|name| (name, 12));
    let expected: Vec<(&str, u64)> = named.into_iter().chain([("picture", 5)]).collect();
    assert_eq!(samples, expected);
    assert!(stages.iter().all(|row| number(&row["p50_ms"]) > 0.0 && number(&row["p95_ms"]) >= number(&row["p50_ms"])));
    let csv = std::fs::read_to_string(place.0.join("first/bench.csv")).expect("written");
    assert_eq!(csv.lines().count(), 1 + stages.len());
    assert!(csv.lines().skip(1).all(|line| line.starts_with("\"small\",\"the CPU\",\"")), "{csv}");
    assert_eq!(first["precision"], "full");
    let named = std::fs::read_to_string("/proc/cpuinfo").is_ok_and(|text| text.contains("model name"));
    assert_eq!(first["processor"].as_str().is_some_and(|name| !name.is_empty()), named);
    // Without wind and bodies everything sleeps: no cell is touched.
    place.write("still.ron", "(version: 1, stands: [(species: Meadow)])");
    let still = measured(&place, "still.ron", "still");
    assert!(number(&first["ns_per_cell"]) > 0.0 && still["ns_per_cell"].is_null());
    assert_eq!((number(&still["counters"]["cell_steps"]), number(&still["memory"]["state"])), (0.0, 0.0));
}

/// A stand that moves blade by blade has stages of its own, and none of the continuum's.
#[test]
fn blade_by_blade_has_stages_of_its_own() {
    let place = Place::new("bench_blades");
    let stand = "(species: Meadow, cells: 8, response: VirtualInertia(), representation: Blade(blades: 1))";
    place.write(
        "blades.ron",
        format!("(version: 1, field: (patch_side: 8), stands: [{stand}], wind: [Natural()], budget: (focus_distance: 8))"),
    );
    let table = place.sward(&["bench", "blades.ron", "--steps", "3", "--warm-up", "1", "--size", "16x9", "--draw", "cpu"]).done();
    assert!(table.contains("virtual blades") && table.contains("blades with a state") && !table.contains("wave"), "{table}");
}

/// So has air that flows.
#[test]
fn flowing_air_has_a_stage() {
    let place = Place::new("bench_air");
    let scene = "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 8)], wind: [Fluid(cells: 16), Fluid(cells: 32)])";
    place.write("air.ron", scene);
    let table = place.sward(&["bench", "air.ron", "--steps", "3", "--warm-up", "1", "--size", "16x9", "--draw", "cpu"]).done();
    assert!(table.contains("air that flows") && table.contains("wave"), "{table}");
    let still = place.sward(&["bench", "lawn", "--steps", "1", "--warm-up", "0", "--size", "16x9", "--draw", "cpu"]).done();
    assert!(!still.contains("air that flows"), "control: {still}");
}

#[test]
fn the_threads_are_those_of_the_step() {
    let place = Place::with_small("bench_threads");
    for threads in ["1", "3"] {
        let arguments = ["bench", "small.ron", "--steps", "1", "--warm-up", "0", "--size", "16x9", "--draw", "cpu"];
        let ran = place.sward_with(&arguments, &[("RAYON_NUM_THREADS", threads)]);
        assert!(ran.status == 0 && ran.text.contains(&format!(" {threads} threads")), "{}{}", ran.text, ran.errors);
    }
}

/// Commas and quotes in a scene's name do not become columns.
#[test]
fn names_are_quoted_in_csv() {
    let place = Place::new("bench_quoted");
    place.write("a, \"b\".ron", support::SMALL);
    measured(&place, "a, \"b\".ron", "data");
    let csv = std::fs::read_to_string(place.0.join("data/bench.csv")).expect("written");
    assert!(csv.lines().skip(1).all(|line| line.starts_with("\"a, \"\"b\"\"\",\"the CPU\",")), "{csv}");
}

/// What was measured is said, though the place for it is gone.
#[test]
fn figures_that_cannot_be_written_are_said() {
    let place = Place::with_small("bench_unwritten");
    std::fs::create_dir_all(place.0.join("data/bench.json")).expect("writable");
    let arguments = ["bench", "small.ron", "--steps", "1", "--warm-up", "0", "--size", "16x9", "--draw", "cpu", "-o", "data"];
    let ran = place.sward(&arguments);
    assert!(ran.status == 1 && ran.text.contains("triad") && ran.errors.contains("bench.json"), "{}{}", ran.text, ran.errors);
}

/// The figures a run wrote.
fn figures(place: &Place, file: &str) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(place.0.join(file)).expect("written")).expect("JSON")
}

/// Without any adapter, and the same every time.
#[test]
fn a_projection_is_counted_not_measured() {
    let place = Place::with_small("bench_project");
    let run = |folder: &str, more: &[&str]| {
        let arguments = [&["bench", "small.ron", "--project", "--steps", "6", "--warm-up", "3", "-o", folder], more].concat();
        let ran = place.sward_with(&arguments, &[("SWARD_ADAPTER", "none")]);
        assert_eq!((ran.status, ran.errors.as_str()), (0, ""));
        for word in ["PROJECTION, not a measurement", "4070 Ti", "wave_pass", "contact_pass", "all stages"] {
            assert!(ran.text.contains(word), "no `{word}` in\n{}", ran.text);
        }
        figures(&place, &format!("{folder}/projection.json"))
    };
    let (first, second, half) = (run("first", &[]), run("second", &[]), run("half", &["--precision", "half"]));
    assert_eq!(first, second);
    let sum = |report: &serde_json::Value, of: &str| {
        let stages = report["stages"].as_array().expect("a list");
        stages.iter().map(|stage| stage[of].as_f64().expect("a number")).sum::<f64>()
    };
    assert_eq!(sum(&first, "invocations"), sum(&half, "invocations"));
    assert!(sum(&first, "bytes") > sum(&half, "bytes"), "control: cells are smaller");
    let totals = |report: &serde_json::Value| (0..3).map(|at| report["total_ms"][at].as_f64().expect("ms")).collect::<Vec<_>>();
    assert!(totals(&first).windows(2).all(|pair| pair[0] > pair[1] && pair[1] > 0.0), "{first}");
    assert!(totals(&first).iter().zip(totals(&half)).all(|(full, half)| *full >= half));
    let csv = std::fs::read_to_string(place.0.join("first/projection.csv")).expect("written");
    assert_eq!(csv.lines().count(), 1 + 3 * first["stages"].as_array().map_or(0, Vec::len));
}

/// A sleeping scene does nothing on any device.
#[test]
fn nothing_takes_no_time_elsewhere() {
    let place = Place::new("bench_project_still");
    place.write("still.ron", "(version: 1, stands: [(species: Meadow)])");
    let text = place.sward(&["bench", "still.ron", "--project", "--steps", "3", "--warm-up", "0"]).done();
    assert!(text.contains("all stages") && text.contains("0.0000 ms") && !text.contains("wave_pass"), "{text}");
}

/// Every paper's scene, at a thousandth of its counts and pixels and told so.
#[test]
fn papers_stand_beside_ours() {
    let place = Place::new("bench_papers");
    let small = ["--scale", "0.002", "--pairs", "1", "--draw", "cpu", "-o", "data"];
    let text = place.sward(&[&["bench", "--papers"], &small[..]].concat()).done();
    for word in
        ["GeForce 8600 GTS", "Radeon HD 6870", "GeForce 8800 GTX", "GeForce GTX 275", "its formula", "here: the CPU", "not to be compared"]
    {
        assert!(text.contains(word), "no `{word}` in\n{text}");
    }
    let report = figures(&place, "data/papers.json");
    let tables = report["tables"].as_array().expect("a list");
    assert_eq!(tables.len(), 5);
    for table in tables {
        let list = |of: &str| table[of].as_array().expect("a list").clone();
        let columns = list("columns").len();
        assert!(list("lines").iter().all(|line| line["values"].as_array().is_some_and(|values| values.len() == columns)), "{table}");
        let is_ours = |line: &&serde_json::Value| line["ours"] == true;
        let lines = list("lines");
        let ours: Vec<_> = lines.iter().filter(is_ours).collect();
        assert!(!ours.is_empty() && ours.len() < lines.len(), "both theirs and ours: {table}");
        assert!(
            ours.iter().all(|line| line["values"].as_array().is_some_and(|all| all.iter().all(|value| value.as_f64() > Some(0.0)))),
            "{table}"
        );
    }
    // As the papers print them, whatever was measured.
    let printed = &tables[1]["lines"][2]["values"];
    assert_eq!((printed[0].as_f64(), printed[2].as_f64()), (Some(180.0), Some(150.0)));
    assert!(std::fs::read_to_string(place.0.join("data/papers.csv")).expect("written").lines().count() > 40);
    let one = place.sward(&["bench", "--papers", "instigator"]).done();
    assert!(one.contains("d = 9.5") && !one.contains("GeForce") && !one.contains("not to be compared"), "{one}");
}

#[test]
fn recovery_is_told_for_every_law() {
    let place = Place::new("bench_recovery");
    let text = place.sward(&["bench", "--recovery", "-o", "data"]).done();
    // README's figures: 1.5 s become 1.0 to 2.05 s.
    let row = text.lines().find(|line| line.starts_with("linear, stored in 10 bits")).expect("listed");
    assert!(row.contains(" 1.500 ") && row.contains(" 2.046 ") && row.contains(" 1.023 "), "{row}");
    let ours = text.lines().skip_while(|line| *line != "ours").count();
    assert_eq!(ours, 4, "{text}");
    let csv = std::fs::read_to_string(place.0.join("data/recovery.csv")).expect("written");
    assert_eq!(csv.lines().count(), 1 + 8 * 7);
    assert_eq!(figures(&place, "data/recovery.json")["laws"].as_array().map(Vec::len), Some(8));
}

#[test]
fn what_does_not_go_together_is_refused() {
    let place = Place::with_small("bench_refused");
    let cases: [(&[&str], &str); 9] = [
        (&["bench"], "SCENE"),
        (&["bench", "small.ron", "--papers"], "--papers"),
        (&["bench", "small.ron", "--recovery"], "--recovery"),
        (&["bench", "--papers", "--recovery"], "--recovery"),
        (&["bench", "--papers", "--steps", "5"], "--steps"),
        (&["bench", "--papers", "nonsense"], "grassland"),
        (&["bench", "small.ron", "--pairs", "3"], "--pairs"),
        (&["bench", "--project"], "SCENE"),
        (&["bench", "small.ron", "--project", "--on", "gpu"], "--on"),
    ];
    for (arguments, word) in cases {
        place.refuses(arguments, &[word]);
    }
}
