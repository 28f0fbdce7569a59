//! Modules import one way only, and what updates the state uses no arithmetic that differs between machines.

use std::path::{Path, PathBuf};

/// Every module of the crate, earlier stages first; those of one line may know each other.
const STAGES: [&[&str]; 18] = [
    &["math", "lanes", "store"],
    &["scene"],
    &["terrain"],
    &["figure"],
    &["specimen"],
    &["placement"],
    &["growth"],
    &["wind"],
    &["interaction"],
    &["state"],
    &["plan", "activation"],
    &["response"],
    &["geometry"],
    &["shading"],
    &["model", "view"],
    &["world"],
    &["saved", "picture"],
    &["fit"],
];

/// Calls whose result depends on the machine, the compiler or the sign of zero.
const FORBIDDEN: [&str; 19] = [
    "mul_add",
    ".sin()",
    ".cos()",
    ".tan()",
    ".atan()",
    ".atan2(",
    ".sin_cos()",
    ".exp()",
    ".exp2()",
    ".ln()",
    ".log2()",
    ".powf(",
    ".powi(",
    ".cbrt()",
    ".hypot(",
    "f32::min",
    "f32::max",
    "f32::clamp",
    "fast_",
];

/// Every Rust file below a folder, as (path from `src`, text).
fn sources(folder: &str) -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut open, mut found) = (vec![root.join(folder)], Vec::new());
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(std::fs::read_dir(&path).expect("readable").map(|entry| entry.expect("readable").path()));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let name: PathBuf = path.strip_prefix(&root).expect("below src").into();
            found.push((name.to_string_lossy().replace('\\', "/"), std::fs::read_to_string(&path).expect("readable")));
        }
    }
    found.sort();
    found
}

/// The text without comments and without the tests at its end.
fn code(text: &str) -> String {
    let body = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    body.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// Stage of a module's name.
fn stage(module: &str) -> Option<usize> {
    STAGES.iter().position(|names| names.contains(&module))
}

/// Imports of later stages in a file, as messages.
fn wrong_imports(file: &str, text: &str) -> Vec<String> {
    let own = file.split(['/', '.']).next().unwrap_or_default();
    if own == "lib" {
        return Vec::new();
    }
    let Some(own_stage) = stage(own) else { return vec![format!("{file}: `{own}` is in no stage of one_way.rs")] };
    let text = code(text).replace("$crate::", "crate::");
    let mut wrong = Vec::new();
    for (at, _) in text.match_indices("crate::") {
        let rest = &text[at + "crate::".len()..];
        let modules: Vec<&str> = match rest.strip_prefix('{') {
            // `use crate::{a::b, c}`: every path of the group, nested groups apart.
            Some(group) => group.split(';').next().unwrap_or_default().split([',', '{', '}']).map(str::trim).collect(),
            None => vec![rest],
        };
        for module in modules.iter().map(|module| module.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default()) {
            if stage(module).is_some_and(|later| later > own_stage) {
                wrong.push(format!("{file} imports `{module}`, a later stage"));
            }
        }
    }
    wrong
}

/// Forbidden calls in a file, and `.min(`, `.max(`, `.clamp(` of float literals.
fn wrong_calls(file: &str, text: &str) -> Vec<String> {
    let text = code(text);
    let mut wrong: Vec<String> =
        FORBIDDEN.iter().filter(|call| text.contains(**call)).map(|call| format!("{file} uses `{call}`")).collect();
    for call in [".min(", ".max(", ".clamp("] {
        for (at, _) in text.match_indices(call) {
            let argument = text[at + call.len()..].split(')').next().unwrap_or_default();
            let float = argument.as_bytes().windows(3).any(|w| w[0].is_ascii_digit() && w[1] == b'.' && w[2].is_ascii_digit());
            if float {
                wrong.push(format!("{file} uses `{call}{argument})` on floats"));
            }
        }
    }
    wrong
}

#[test]
fn stages_import_earlier_stages_only() {
    let files = sources("");
    assert!(files.len() > 40, "{} files", files.len());
    let wrong: Vec<String> = files.iter().flat_map(|(file, text)| wrong_imports(file, text)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    for stage in STAGES.iter().copied().flatten() {
        assert!(files.iter().any(|(file, _)| file.split(['/', '.']).next() == Some(stage)), "{stage} is gone");
    }
}

#[test]
fn a_later_import_would_be_found() {
    for control in [
        "use crate::world::World;",
        "use crate::{math, response::continuum};",
        "fn f(m: &crate::model::Model) {}",
        "macro_rules! m { () => { $crate::world::World } }",
    ] {
        assert_eq!(wrong_imports("wind/noise.rs", control).len(), 1, "{control}");
    }
    assert!(wrong_imports("wind/noise.rs", "use crate::math::hash; // not crate::world").is_empty());
    assert_eq!(wrong_imports("novelty.rs", "").len(), 1, "an unknown module is an error");
}

#[test]
fn state_updates_use_only_our_own_arithmetic() {
    let folders = [
        "response",
        "interaction",
        "wind",
        "placement.rs",
        "growth",
        "geometry/layers.rs",
        "world",
        "view.rs",
        "activation.rs",
        "terrain/detail.rs",
        "terrain/edits.rs",
        "figure/clip.rs",
        "figure/hull.rs",
        "figure/part.rs",
        "figure/split.rs",
        "figure/thin.rs",
        "figure/tree.rs",
        "fit",
        "specimen/components.rs",
        "specimen/grow",
        "specimen/shade.rs",
    ];
    let files: Vec<(String, String)> = folders.into_iter().flat_map(sources).filter(|(file, _)| !file.ends_with("tests.rs")).collect();
    assert!(files.len() > 15, "{} files", files.len());
    let wrong: Vec<String> = files.iter().flat_map(|(file, text)| wrong_calls(file, text)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn a_call_of_the_standard_library_would_be_found() {
    for control in
        ["let y = x.mul_add(a, b);", "x.sin() + 1.0", "y.exp()", "a.powf(1.5)", "f32::min(a, b)", "a.max(0.0)", "x.clamp(-1.0, 1.0)"]
    {
        assert_eq!(wrong_calls("response/x.rs", control).len(), 1, "{control}");
    }
    let harmless = "let n = count.min(3); // x.sin()\nlet m = a.max(b);\n#[cfg(test)]\nmod tests { fn f() { x.cos() } }";
    assert!(wrong_calls("response/x.rs", harmless).is_empty());
}
