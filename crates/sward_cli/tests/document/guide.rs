//! The book in `docs/`: what it lists, includes, links to and shows is there; its scenes step, its mistakes are refused, its Rust is of examples that run.

use std::collections::BTreeSet;
use std::path::Path;

use sward::scene::{Scene, response};
use sward::world::World;

use super::book::{anchored, fenced, headings, include, targets};
use crate::{expect_none, read, root};

/// What is wrong, each with the page it is on.
type Problems = Vec<String>;

/// A file as a page names it, counted from the root, if it is there.
fn named_by(page: &str, target: &str) -> Option<String> {
    let folder = Path::new(page).parent().unwrap_or(Path::new(""));
    let mut parts: Vec<&str> = Vec::new();
    let joined = folder.join(target);
    for part in joined.iter().filter_map(|part| part.to_str()) {
        match part {
            ".." => _ = parts.pop(),
            other => parts.push(other),
        }
    }
    let name = parts.join("/");
    root().join(&name).is_file().then_some(name)
}

/// Names of all files with an ending below a folder, counted from the root, in order.
fn files(folder: &str, ending: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in std::fs::read_dir(root().join(folder)).into_iter().flatten().flatten() {
        let name = format!("{folder}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            found.extend(files(&name, ending));
        } else if name.ends_with(ending) {
            found.insert(name);
        }
    }
    found
}

/// Pages of the book and their texts.
fn pages() -> Vec<(String, String)> {
    let pages = files("docs", ".md").into_iter().filter(|name| name != "docs/SUMMARY.md");
    pages.map(|name| (name.clone(), read(&name))).collect()
}

/// Chapters of the guide and their texts.
pub(crate) fn chapters() -> Vec<(String, String)> {
    let chapters: Vec<_> = pages().into_iter().filter(|(name, _)| name.starts_with("docs/guide/")).collect();
    assert!(chapters.len() >= 7, "only {} chapters", chapters.len());
    chapters
}

/// What holds of each chapter.
fn of_chapters(problems: impl Fn(&str, &str) -> Problems) -> Problems {
    chapters().iter().flat_map(|(name, text)| problems(name, text)).collect()
}

fn unlisted(summary: &str, pages: &BTreeSet<String>) -> Problems {
    let listed: BTreeSet<String> = targets(summary).into_iter().map(|target| format!("docs/{target}")).collect();
    let missing = listed.difference(pages).map(|page| format!("SUMMARY lists {page}, which is not there"));
    missing.chain(pages.difference(&listed).map(|page| format!("SUMMARY does not list {page}"))).collect()
}

fn lost_links(page: &str, text: &str) -> Problems {
    let lost = |target: &String| {
        let (path, anchor) = target.split_once('#').map_or((target.as_str(), None), |(path, anchor)| (path, Some(anchor)));
        let file = if path.is_empty() { Some(page.to_owned()) } else { named_by(page, path) };
        match (file, anchor) {
            (None, _) => true,
            (Some(_), None) => false,
            (Some(file), Some(anchor)) if file == page => !headings(text).iter().any(|heading| heading == anchor),
            (Some(file), Some(anchor)) => !headings(&read(&file)).iter().any(|heading| heading == anchor),
        }
    };
    let ours = targets(text).into_iter().filter(|target| !target.contains("://"));
    ours.filter(lost).map(|target| format!("{page}: {target} leads nowhere")).collect()
}

/// Rust is taken from examples that a test runs.
fn loose_rust(page: &str, text: &str) -> Problems {
    let mut problems = Vec::new();
    for (kind, inside) in fenced(text).into_iter().filter(|(kind, _)| kind.split(',').next() == Some("rust")) {
        let Some((path, anchor)) = include(&inside) else {
            problems.push(format!("{page}: Rust that nobody compiles, {kind}: {inside}"));
            continue;
        };
        let Some(file) = named_by(page, &path) else {
            problems.push(format!("{page}: there is no {path}"));
            continue;
        };
        if anchor.is_none_or(|anchor| anchored(&read(&file), &anchor).is_none()) {
            problems.push(format!("{page}: {inside} has no such part"));
        }
        let [_, of, _, example] = file.split('/').collect::<Vec<_>>()[..] else {
            problems.push(format!("{page}: {file} is no example"));
            continue;
        };
        let tests = files(&format!("crates/{of}/tests"), ".rs");
        if !tests.iter().any(|test| read(test).contains(&format!("examples/{example}"))) {
            problems.push(format!("{page}: no test runs {file}"));
        }
    }
    problems
}

/// A whole scene that cannot be stepped, or a response that is none.
fn wrong_scene(text: &str) -> Option<String> {
    if !text.trim_start().starts_with('(') {
        return response(text.trim()).err().map(|error| error.to_string());
    }
    let assets = sward_scenes::Near(root().join("scenes"));
    match Scene::parse(text, "guide").and_then(|scene| World::new(scene, &assets)) {
        Err(error) => Some(error.to_string()),
        Ok(mut world) => {
            (0..3).for_each(|_| world.step());
            (world.state.step != 3).then(|| "it does not step".to_owned())
        }
    }
}

fn wrong_scenes(page: &str, text: &str) -> Problems {
    let scenes = fenced(text).into_iter().filter(|(kind, _)| kind == "ron");
    scenes.filter_map(|(_, scene)| wrong_scene(&scene)).map(|why| format!("{page}: {why}")).collect()
}

/// What is said to be refused is, with the words that the page prints below it.
fn wrong_mistakes(page: &str, text: &str) -> Problems {
    let blocks = fenced(text);
    let mut problems = Vec::new();
    for (index, (_, scene)) in blocks.iter().enumerate().filter(|(_, (kind, _))| kind == "ron,refused") {
        let said = wrong_scene(scene).unwrap_or_default();
        let printed = blocks.get(index + 1).filter(|(kind, _)| kind == "text").map_or("", |(_, inside)| inside);
        let lines: Vec<&str> = printed.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
        if lines.is_empty() || !lines.iter().all(|line| said.contains(line)) {
            problems.push(format!("{page}: {scene} is answered by {said:?}"));
        }
    }
    problems
}

/// Each block is of a kind that is checked, and shell blocks hold commands that are.
fn unchecked(page: &str, text: &str) -> Problems {
    let mut problems = Vec::new();
    for (kind, inside) in fenced(text) {
        if !["ron", "ron,refused", "rust", "sh", "text"].contains(&kind.as_str()) {
            problems.push(format!("{page}: nobody checks a block of {kind:?}"));
        }
        for command in inside.lines().flat_map(|line| line.split(" && ")).filter(|line| kind == "sh" && !line.trim().is_empty()) {
            let known = match command.split_whitespace().collect::<Vec<_>>()[..] {
                ["cargo" | "sward", ..] => true,
                ["bash", script, ..] => root().join(script).is_file(),
                _ => false,
            };
            if !known {
                problems.push(format!("{page}: nobody checks {command}"));
            }
        }
    }
    problems
}

fn stray_pictures(shown: &BTreeSet<String>, pictures: &BTreeSet<String>, program: &str) -> Problems {
    let made = |picture: &&String| picture.rsplit('/').next().is_some_and(|name| program.contains(&format!("\"{name}\"")));
    let stray = pictures.difference(shown).map(|picture| format!("no chapter shows {picture}"));
    stray.chain(pictures.iter().filter(|picture| !made(picture)).map(|picture| format!("no program makes {picture}"))).collect()
}

#[test]
fn the_book_lists_every_page() {
    let pages: BTreeSet<String> = pages().into_iter().map(|(name, _)| name).collect();
    expect_none(unlisted(&read("docs/SUMMARY.md"), &pages));
    let wrong = unlisted("- [one](guide/nowhere.md)", &["docs/cli.md".to_owned()].into());
    assert_eq!(wrong, ["SUMMARY lists docs/guide/nowhere.md, which is not there", "SUMMARY does not list docs/cli.md"]);
}

#[test]
fn every_link_leads_somewhere() {
    let pages = pages();
    assert!(pages.iter().map(|(_, text)| targets(text).len()).sum::<usize>() > 50);
    expect_none(pages.iter().flat_map(|(name, text)| lost_links(name, text)));
    let wrong =
        lost_links("docs/guide/tuning.md", "# A b\n[a](#a-b) [b](#b) [c](../cli.md#measure) [d](../cli.md#paint) ![e](pictures/none.png)");
    assert_eq!(wrong.len(), 3, "{wrong:?}");
}

#[test]
fn rust_of_the_guide_is_of_examples_that_run() {
    let count = |text: &str| fenced(text).iter().filter(|(kind, _)| kind == "rust").count();
    assert!(chapters().iter().map(|(_, text)| count(text)).sum::<usize>() > 10);
    expect_none(of_chapters(loose_rust));
    let block = |inside: &str| loose_rust("docs/guide/loop.md", &format!("```rust\n{inside}\n```"));
    assert!(block("{{#include ../../crates/sward/examples/wind.rs:add}}").is_empty());
    let wrong = [
        "let x = 1;",
        "{{#include ../../crates/sward/examples/gone.rs:add}}",
        "{{#include ../../crates/sward/examples/wind.rs:gone}}",
        "{{#include ../../crates/sward/examples/wind.rs}}",
        "{{#include ../../crates/sward/src/world.rs:add}}",
    ];
    assert!(wrong.iter().all(|inside| !block(inside).is_empty()));
    assert!(!loose_rust("docs/guide/loop.md", "```rust,ignore\nlet x = 1;\n```").is_empty());
}

#[test]
fn scenes_of_the_guide_step() {
    let count = |text: &str| fenced(text).iter().filter(|(kind, _)| kind == "ron").count();
    assert!(chapters().iter().map(|(_, text)| count(text)).sum::<usize>() > 5);
    expect_none(of_chapters(wrong_scenes));
    let wrong = wrong_scenes("page", "```ron\n(version: 1, stands: [(species: Grass)])\n```\n```ron\nOscillator(frequency: -1)\n```");
    assert_eq!(wrong.len(), 2, "{wrong:?}");
    assert!(wrong_scenes("page", "```ron\nOscillator(frequency: 2)\n```").is_empty());
}

#[test]
fn mistakes_of_the_guide_are_refused_as_it_says() {
    let count = |text: &str| fenced(text).iter().filter(|(kind, _)| kind == "ron,refused").count();
    assert!(chapters().iter().map(|(_, text)| count(text)).sum::<usize>() >= 3);
    expect_none(of_chapters(wrong_mistakes));
    let page = |scene: &str, said: &str| format!("```ron,refused\n{scene}\n```\n\n```text\n{said}\n```");
    let bad = "(version: 1, stands: [(species: Grass)])";
    assert!(wrong_mistakes("page", &page(bad, "`Grass` is not known")).is_empty());
    let wrong = [page("(version: 1)", "`Grass` is not known"), page(bad, "something else"), page(bad, "")];
    assert!(wrong.iter().all(|text| !wrong_mistakes("page", text).is_empty()));
}

#[test]
fn every_block_of_the_guide_is_checked() {
    expect_none(of_chapters(unchecked));
    let wrong = unchecked("page", "```\na\n```\n```json\n{}\n```\n```sh\nsward show hello\nmake\nbash web/nothing && bash web/build\n```");
    assert_eq!(wrong.len(), 4, "{wrong:?}");
}

#[test]
fn every_picture_of_the_guide_is_shown_and_made() {
    let pictures = files("docs/guide/pictures", "");
    assert!(pictures.len() > 10, "only {} pictures", pictures.len());
    let shown: BTreeSet<String> = chapters()
        .iter()
        .flat_map(|(name, text)| targets(text).into_iter().filter_map(|target| named_by(name, &target)).collect::<Vec<_>>())
        .collect();
    expect_none(stray_pictures(&shown, &pictures, &read("crates/sward_raster/examples/guide/main.rs")));
    let bytes = |name: &String| std::fs::metadata(root().join(name)).map_or(0, |data| data.len());
    let all: u64 = pictures.iter().map(bytes).sum();
    assert!(all < 1_500_000, "{all} bytes of pictures");
    let wrong = stray_pictures(&BTreeSet::new(), &["docs/guide/pictures/none.svg".to_owned()].into(), "(\"other.svg\", other)");
    assert_eq!(wrong.len(), 2, "{wrong:?}");
}
