//! What the documents name exists: paths, commands and their options, environment variables, functions. And no text names a machine.

mod document;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use document::{blocks, commands, functions, machine_paths, paths, variables};

/// A document: its path counted from the root, and its text.
type Document = (String, String);

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn documents() -> Vec<Document> {
    let reference = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "docs/cli.md", "docs/projection.md", "docs/window.md"];
    reference.map(|name| (name.to_owned(), read(name))).into_iter().chain(document::guide::chapters()).collect()
}

/// All problems at once, so that one run shows them all.
fn expect_none(problems: impl IntoIterator<Item = String>) {
    let problems: Vec<String> = problems.into_iter().collect();
    assert!(problems.is_empty(), "\n{}", problems.join("\n"));
}

/// Why a command line cannot work, as far as names tell.
fn wrong(command: &[String]) -> Option<String> {
    let words: Vec<&str> = command.iter().map(String::as_str).collect();
    match words.split_first()? {
        (&"cargo", [name, rest @ ..]) => wrong_cargo(name, rest),
        (&"sward", rest) => wrong_sward(rest),
        _ => None,
    }
}

fn wrong_sward(arguments: &[&str]) -> Option<String> {
    let name = arguments.first().filter(|first| !first.starts_with('-'))?;
    let output = Command::new(env!("CARGO_BIN_EXE_sward")).args([name, "--help"]).output().expect("sward runs");
    let help = String::from_utf8_lossy(&output.stdout);
    if !output.status.success() || help.is_empty() {
        return Some(format!("sward has no command {name}"));
    }
    let known = |option: &str| help.split([' ', ',', '\n', '=', '<', '[']).any(|word| word == option);
    let options = arguments.iter().filter(|word| word.starts_with('-')).map(|word| word.split('=').next().unwrap_or(word));
    let unknown: Vec<&str> = options.filter(|option| !known(option)).collect();
    if unknown.is_empty() { None } else { Some(format!("sward {name} has no {}", unknown.join(", "))) }
}

fn wrong_cargo(name: &str, arguments: &[&str]) -> Option<String> {
    if !["bench", "build", "clippy", "doc", "fmt", "install", "package", "run", "test"].contains(&name) {
        return Some(format!("cargo has no command {name}"));
    }
    let missing = |pair: &&[&str]| match pair {
        ["-p" | "--package", package] => !root().join("crates").join(package).join("Cargo.toml").exists(),
        ["--path", path] => !root().join(path).exists(),
        ["--test" | "--example" | "--bench", target] => !has_target(target),
        _ => false,
    };
    if let Some(pair) = arguments.windows(2).find(missing) {
        return Some(format!("there is no {}", pair.join(" ")));
    }
    let own = arguments.iter().position(|word| *word == "--").map(|at| &arguments[at + 1..]);
    let window = arguments.windows(2).any(|pair| matches!(pair, ["-p" | "--package", "sward_viewer"]));
    if name == "run" && !window { own.and_then(wrong_sward) } else { None }
}

/// Whether a crate has a test, an example or a bench of this name.
fn has_target(target: &str) -> bool {
    let crates = std::fs::read_dir(root().join("crates")).expect("the folder of crates").flatten();
    let folders = crates.flat_map(|entry| ["tests", "examples", "benches"].map(|kind| entry.path().join(kind)));
    folders.into_iter().any(|folder| folder.join(format!("{target}.rs")).exists() || folder.join(target).join("main.rs").exists())
}

/// Paths may be counted from the root or from the document's own folder.
fn missing_paths((name, text): &Document) -> Vec<String> {
    let folder = root().join(Path::new(name).parent().unwrap_or(Path::new("")));
    paths(text).into_iter().filter(|path| !root().join(path).exists() && !folder.join(path).exists()).collect()
}

fn is_defined(file: &str, name: &str) -> bool {
    let text = std::fs::read_to_string(root().join("crates/sward/src").join(file)).unwrap_or_default();
    let goes_on = |rest: &str| rest.starts_with(|next: char| next.is_alphanumeric() || next == '_');
    ["fn", "struct", "enum"].iter().any(|kind| text.split(&format!("{kind} {name}")).skip(1).any(|rest| !goes_on(rest)))
}

/// Text files of the project, tracked or about to be, and their contents.
fn project_texts() -> Vec<Document> {
    let list = ["-c", "safe.directory=*", "ls-files", "--cached", "--others", "--exclude-standard", "-z"];
    let output = Command::new("git").args(list).current_dir(root()).output().expect("git runs");
    let names = String::from_utf8_lossy(&output.stdout).into_owned();
    let text = |name: &str| std::fs::read_to_string(root().join(name)).ok().map(|text| (name.to_owned(), text));
    names.split('\0').filter(|name| !name.is_empty()).filter_map(text).collect()
}

#[test]
fn every_path_exists() {
    let documents = documents();
    assert!(documents.iter().map(|(_, text)| paths(text).len()).sum::<usize>() > 10);
    let missing = |document: &Document| {
        missing_paths(document).into_iter().map(|path| format!("{}: there is no {path}", document.0)).collect::<Vec<_>>()
    };
    expect_none(documents.iter().flat_map(missing));
}

#[test]
fn every_command_is_known() {
    let mut problems = Vec::new();
    for (name, text) in documents() {
        problems.extend(commands(&text).iter().filter_map(|command| wrong(command)).map(|why| format!("{name}: {why}")));
    }
    assert!(documents().iter().map(|(_, text)| commands(text).len()).sum::<usize>() > 10);
    expect_none(problems);
}

#[test]
fn every_environment_variable_is_read_somewhere() {
    let texts = project_texts();
    let is_read = |name: &str| texts.iter().any(|(file, text)| file.ends_with(".rs") && text.contains(&format!("\"{name}\"")));
    let documents = documents();
    let named = documents.iter().flat_map(|(file, text)| variables(text).into_iter().map(move |name| (file, name)));
    expect_none(named.filter(|(_, name)| !is_read(name)).map(|(file, name)| format!("{file}: nothing reads {name}")));
}

/// `docs/papers.md` names `file.rs::function`, below the core's sources.
#[test]
fn every_function_of_the_papers_exists() {
    let functions = functions(&read("docs/papers.md"));
    assert!(functions.len() > 20, "only {} functions", functions.len());
    let missing = functions.into_iter().filter(|(file, name)| !is_defined(file, name));
    expect_none(missing.map(|(file, name)| format!("docs/papers.md: {file} has no {name}")));
    expect_none(missing_paths(&("docs/papers.md".to_owned(), read("docs/papers.md"))));
}

/// The scene in README is valid; its Rust is the documented example of `World`, which is a test.
#[test]
fn readme_examples_are_true() {
    let (scenes, examples) = (blocks(&read("README.md"), "ron"), blocks(&read("README.md"), "rust"));
    assert!(!scenes.is_empty() && !examples.is_empty());
    for scene in scenes {
        sward::scene::Scene::parse(&scene, "README.md").expect("the scene is valid");
    }
    let world = read("crates/sward/src/world.rs");
    let documented: BTreeSet<&str> = world.lines().filter_map(|line| line.trim().strip_prefix("/// ")).collect();
    let lines = examples.iter().flat_map(|block| block.lines()).filter(|line| !line.is_empty());
    expect_none(lines.filter(|line| !documented.contains(line)).map(|line| format!("not in the example of World: {line}")));
}

#[test]
fn no_text_names_a_machine() {
    let texts = project_texts();
    assert!(texts.len() > 50, "only {} files: not a clone?", texts.len());
    expect_none(texts.iter().flat_map(|(name, text)| machine_paths(text).into_iter().map(move |path| format!("{name}: {path}"))));
}

/// Each check must be able to fail.
#[test]
fn a_wrong_document_is_noticed() {
    let text = "See [this](docs/nowhere.md), `crates/sward/src/nothing.rs` and [that](README.md).\n```sh\nsward paint hello\n\
        sward render hello --crayon\ncargo test -p nobody\ncargo frobnicate\nsward scenes\ncargo test\n```\nSWARD_NOTHING=1 `a.rs::b`";
    assert_eq!(missing_paths(&("README.md".to_owned(), text.to_owned())), ["docs/nowhere.md", "crates/sward/src/nothing.rs"]);
    let wrong: Vec<String> = commands(text).iter().filter_map(|command| wrong(command)).collect();
    let expected =
        ["sward has no command paint", "sward render has no --crayon", "there is no -p nobody", "cargo has no command frobnicate"];
    assert_eq!(wrong, expected);
    assert_eq!(variables(text), ["SWARD_NOTHING"]);
    assert_eq!(functions(text), [("a.rs".to_owned(), "b".to_owned())]);
    assert!(!is_defined("world.rs", "nothing") && is_defined("world.rs", "step"));
    let folder = ["", "home", "me"].join("/");
    assert_eq!(machine_paths(&format!("see {folder}/file, not crates{folder}/file")), [format!("{folder}/file,")]);
}
