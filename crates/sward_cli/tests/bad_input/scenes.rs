//! Mistakes in the scene itself.

use crate::support::Place;
use crate::{refuses, takes};

/// Scene, line and column, what the error says.
type Mistake = (&'static str, &'static str, &'static [&'static str]);

const FIELDS: &[Mistake] = &[
    ("(version: 1,\n  satnds: [])", "2:3", &["no field `satnds`", "did you mean `stands`?"]),
    ("(version: 1, stands: [(\n species: Meadow, cels: 64)])", "2:19", &["no field `cels`", "did you mean `cells`?"]),
    ("(version: 1, stands: [(species: Medow)])", "1:33", &["`Medow` is not known", "did you mean `Meadow`?"]),
    ("(version: 1, wind: [Gusty()])", "1:21", &["`Gusty` is not known as `WindSource`", "known: Uniform, Natural, Footprint, Fluid"]),
    ("(version: 1, stands: [()])", "1:24", &["`species` is missing", "add `species: …`"]),
    ("(version: 1, stands: [(species: Lawn)]", "1:39", &["expected comma", "a comma or `)` is missing"]),
];

const NUMBERS: &[Mistake] = &[
    ("(version: 1, light: (\n fog: NaN))", "2:7", &["`fog` is NaN 1/m", "allowed 0 to 1"]),
    ("(version: 1, wind: [Uniform(velocity: (inf, 0))])", "1:46", &["`velocity` is inf m/s", "allowed -60 to 60"]),
    ("(version: 1, wind: [Fluid(cells: 100)])", "1:34", &["`cells` is 100", "allowed are powers of two", "64 or 128"]),
    ("(version: 1, field: (patch_side: 1e9))", "1:34", &["`patch_side`", "allowed 8 to 64"]),
    ("(version: 1, stands: [(species: Lawn, cells: 4096)])", "1:46", &["`cells` is 4096", "allowed"]),
    ("(version: 1, budget: (patches: 4000000000))", "1:32", &["`patches` is 4000000000", "allowed"]),
    ("(version: 1, seed: -1)", "1:21", &["integer is out of bounds", "negative"]),
    ("(version: 1, seed: 99999999999)", "1:20", &["integer is out of bounds", "too large"]),
];

const VERSIONS: &[Mistake] = &[
    ("(version: 2)", "1:11", &["needs a newer sward", "format version 2", "reads version 1"]),
    ("(version: 4294967296, novelty: ())", "1:11", &["needs a newer sward", "reads version 1"]),
    ("(version: 0)", "1:11", &["`version` is 0", "allowed 1 to 1"]),
    ("()", "1:2", &["`version` is missing", "begin the scene with `version: 1`"]),
];

/// Times of three keys, where, and what the error says.
const TIMES: &[(&str, &str, &[&str])] = &[
    ("0, 2, 1", "3:8", &["`time` is 1 s, but the key before it is at 2 s", "order the keys by increasing time"]),
    ("0, 1, 1", "3:8", &["`time` is 1 s, but the key before it is at 1 s", "order the keys by increasing time"]),
    ("0, NaN, 1", "2:8", &["`time` is NaN s", "allowed 0 to 1000000000"]),
    ("0, -1, 1", "2:8", &["`time` is -1 s", "allowed 0 to 1000000000"]),
    ("0, 1, inf", "3:8", &["`time` is inf s", "allowed 0 to 1000000000"]),
];

fn path_of(times: &str) -> String {
    times.split(", ").map(|time| format!("(time: {time}, at: (0, 1))")).collect::<Vec<_>>().join(",\n")
}

#[test]
fn mistakes_in_scenes_are_placed_and_explained() {
    let place = Place::new("bad_scenes");
    for (scene, at, words) in [FIELDS, NUMBERS, VERSIONS].concat() {
        // A range says by itself what to type.
        refuses(&place, scene, "", &[&[format!("test.ron:{at}: ").as_str()], words].concat());
    }
    takes(&place, "(version: 1, stands: [(species: Meadow, cells: 64)], wind: [Natural()], seed: 7, light: (fog: 0.5))");
}

#[test]
fn paths_with_times_out_of_order_are_refused() {
    let place = Place::new("bad_paths");
    let follow = |times: &str| format!("(version: 1, interactors: [(shape: Truck, path: Keyframes(keys: [{}]))])", path_of(times));
    let blow = |times: &str| format!("(version: 1, wind: [Footprint(path: Keyframes(keys: [{}]))])", path_of(times));
    for (times, at, words) in TIMES {
        for scene in [follow(times), blow(times)] {
            refuses(&place, &scene, "", &[&[format!("test.ron:{at}: ").as_str()], *words].concat());
        }
        let look = |time: &str| format!("(time: {time}, eye: (0, 1, 2), target: (0, 0, 0))");
        let keys = times.split(", ").map(look).collect::<Vec<_>>().join(",\n");
        refuses(&place, &format!("(version: 1, camera: (keys: [{keys}]))"), "", &[&[format!("test.ron:{at}: ").as_str()], *words].concat());
    }
    takes(&place, &follow("0, 1, 2"));
    takes(&place, &blow("0, 1, 2"));
    refuses(
        &place,
        "(version: 1, interactors: [(shape: Truck, path: Keyframes(keys: []))])",
        "1:65",
        &["`keys` is empty", "give a place at a time"],
    );
}

/// Nesting deeper than the reader follows ends in words, not in a full stack.
#[test]
fn scenes_without_an_end_are_refused() {
    let place = Place::new("deep_scenes");
    let deep = |open: &str, close: &str| format!("(version: 1, interactors: [(shape: {}{})])", open.repeat(100_000), close.repeat(100_000));
    for (open, close) in [("Compound(parts: [(shape: ", ")])"), ("[", "]"), ("(", ")"), ("Some(", ")")] {
        refuses(&place, &deep(open, close), "", &["test.ron:1:"]);
    }
    refuses(&place, &format!("(version: 1, title: \"{}\", x: 1)", "x".repeat(3_000_000)), "", &["test.ron:1:", "no field `x`"]);
    refuses(&place, &"/*".repeat(1_000_000), "", &["test.ron:1:"]);
    place.write("test.ron", vec![b' '; (16 << 20) + 1]);
    place.refuses(&["show", "test.ron"], &["test.ron is not a scene file", "help: ", "at most 16 MB"]);
}
