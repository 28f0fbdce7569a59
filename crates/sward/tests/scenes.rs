//! The shipped scenes, the reference page, and what an author sees after a mistake.

use proptest::prelude::*;
use std::path::{Path, PathBuf};
use sward::scene::{Scene, SceneError};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Name and text of every shipped scene.
fn shipped() -> Vec<(String, String)> {
    let folder = std::fs::read_dir(root().join("scenes")).expect("the repository has scenes");
    let mut scenes: Vec<(String, String)> = folder
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .map(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            (name, std::fs::read_to_string(&path).expect("readable"))
        })
        .collect();
    scenes.sort();
    assert!(!scenes.is_empty());
    scenes
}

fn error_of(text: &str) -> SceneError {
    Scene::parse(text, "test.ron").expect_err(text)
}

#[test]
fn shipped_scenes_are_valid_short_and_survive_writing() {
    let scenes = shipped();
    for name in ["hello", "lawn", "reed", "crossing", "paper", "endless"] {
        assert!(scenes.iter().any(|(file, _)| *file == format!("{name}.ron")), "{name}");
    }
    for (file, text) in &scenes {
        let scene = Scene::parse(text, file).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(Scene::parse(&scene.to_ron(), file).as_ref(), Ok(&scene));
        assert!(text.lines().count() <= 60 && text.starts_with("//"), "{file}");
        assert!(!scene.stands.is_empty() && !scene.title.is_empty(), "{file}");
        for stand in &scene.stands {
            stand.resolve().unwrap_or_else(|error| panic!("{file}: {error}"));
        }
    }
}

#[test]
fn the_field_of_the_paper_has_its_numbers() {
    let mut scenes = shipped().into_iter();
    let (file, text) = scenes.find(|(file, _)| file == "paper.ron").expect("shipped");
    let scene = Scene::parse(&text, &file).expect("valid");
    assert_eq!(scene.field.patches, Some([88, 88]));
    let cell = scene.field.patch_side / scene.stands[0].cells() as f32;
    assert!((cell - 0.4572).abs() < 1e-6, "{cell}");
}

#[test]
fn five_lines_are_a_scene() {
    let text = "(\n    version: 1,\n    stands: [(species: Meadow)],\n)\n";
    let scene = Scene::parse(text, "small.ron").expect("valid");
    assert_eq!((scene.seed, scene.steps_per_second, scene.budget.patches), (1, 60, 225));
    let meadow = scene.stands[0].resolve().expect("valid");
    assert_eq!(meadow.name, "meadow");
    assert_eq!((meadow.continuum.kappa, meadow.billboard.segments), (114.0, 4));
}

#[test]
fn an_author_overrides_part_of_a_species() {
    let text = "(version: 1, stands: [(species: Reed, name: \"bank\", height: (1.5, 2),
        response: Continuum(frequency: 0.8, damping: 0.4, mu: 0.5, lag: History),
        representation: Billboard(segments: 3))])";
    let scene = Scene::parse(text, "reed.ron").expect("valid");
    let reed = scene.stands[0].resolve().expect("valid");
    assert_eq!((reed.name.as_str(), reed.height, reed.billboard.segments), ("bank", [1.5, 2.0], 3));
    let continuum = reed.continuum;
    assert!((continuum.kappa - 25.266).abs() < 1e-3, "{}", continuum.kappa);
    assert_eq!((continuum.kappa_omega, continuum.mu), (continuum.kappa, 0.5));
    assert_eq!(continuum.c0, 2.5);
}

#[test]
fn billboards_that_bodies_deform_are_drawn_as_they_are() {
    let of = |more: &str| {
        let text = format!("(version: 1, stands: [(species: Meadow, response: Springs(columns: 4, rows: 5){more})])");
        Scene::parse(&text, "sheets.ron").expect("valid").stands[0].resolve().expect("valid")
    };
    for (given, width) in
        [("", 1.4 * 0.55), (", representation: Sheet(width: 0.4)", 0.4), (", representation: Sheet(rows: 5, width: 0.4)", 0.4)]
    {
        let sheet = of(given).sheet.expect("a sheet");
        assert_eq!([sheet.columns, sheet.rows], [4, 5], "{given}");
        assert!((sheet.width - width).abs() < 1e-6, "{given}: {}", sheet.width);
    }
    assert_eq!(of(", representation: Billboard()").sheet, None);
    assert_eq!(of(", representation: Blade()").sheet, None);
}

#[test]
fn a_stand_of_sheets_keeps_what_the_species_gives() {
    let text = "(version: 1, stands: [(species: Reed, representation: Sheet(rows: 5, points: 7)), (species: Reed, name: \"cards\")])";
    let scene = Scene::parse(text, "sheets.ron").expect("valid");
    let [sheets, cards] = [0, 1].map(|stand: usize| scene.stands[stand].resolve().expect("valid"));
    let sheet = sheets.sheet.clone().expect("a sheet");
    assert_eq!([sheet.columns, sheet.rows, sheet.points], [3, 5, 7]);
    assert_eq!((sheet.colour_tip, sheet.dryness), (cards.billboard.colour_tip, cards.billboard.dryness));
    assert_eq!((sheets.cards(), sheets.pieces(), sheets.segments()), (0, 6, cards.segments()));
    assert_eq!((cards.cards(), cards.pieces(), cards.sheet), (2, 7, None));
}

#[test]
fn a_star_is_not_convex_but_a_square_is_either_way_round() {
    let scene = |points: &str| format!("(version: 1, interactors: [(shape: Polygon(points: [{points}]))])");
    assert!(Scene::parse(&scene("(0, 0), (0, 1), (1, 1), (1, 0)"), "").is_ok());
    assert!(Scene::parse(&scene("(0, 0), (1, 0), (1, 1), (0, 1)"), "").is_ok());
    let star = "(0, 1), (-0.59, -0.81), (0.95, 0.31), (-0.95, 0.31), (0.59, -0.81)";
    assert!(error_of(&scene(star)).message.contains("convex"));
    assert!(error_of(&scene("(0, 0), (1, 0), (2, 0), (2, 1)")).message.contains("convex"));
}

/// `SWARD_ACCEPT=1 cargo test -p sward --test scenes` rewrites the page.
#[test]
fn the_reference_page_is_current() {
    let path = root().join("docs/scene-format.md");
    let page = sward::scene::reference();
    if std::env::var_os("SWARD_ACCEPT").is_some_and(|accept| accept == "1") {
        std::fs::create_dir_all(root().join("docs")).expect("writable");
        std::fs::write(&path, &page).expect("writable");
    }
    let stored = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    assert!(stored == page, "docs/scene-format.md is not current: run this test with SWARD_ACCEPT=1");
    for word in ["ContinuumOverrides", "frequency", "visible_plants", "turbulence", "Tussock"] {
        assert!(page.contains(word), "{word}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    /// Damaged scenes are refused or read, but never a panic, and errors point into the text.
    #[test]
    fn damaged_text_never_panics(
        which in any::<prop::sample::Index>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..4, ".{0,4}"), 1..6),
    ) {
        let mut scenes = shipped();
        let (_, mut text) = scenes.swap_remove(which.index(scenes.len()));
        for (place, kind, piece) in edits {
            let letters: Vec<char> = text.chars().collect();
            if letters.is_empty() {
                break;
            }
            let (before, after) = letters.split_at(place.index(letters.len()));
            let rest = match kind {
                0 => &after[1..],
                1 => &after[..0],
                2 => after,
                _ => &after[after.len().min(12)..],
            };
            text = before.iter().collect::<String>() + &piece + &rest.iter().collect::<String>();
        }
        if let Err(error) = Scene::parse(&text, "damaged.ron") {
            prop_assert!(error.line >= 1 && error.line as usize <= text.matches('\n').count() + 1);
            prop_assert!(text.get(error.span()).is_some());
            prop_assert!(!error.message.is_empty() && !error.to_string().is_empty());
        }
    }

    #[test]
    fn any_text_never_panics(text in "[(){}\\[\\]:,a-z\"/*# 0-9.]{0,60}") {
        let _ = Scene::parse(&text, "any.ron");
    }
}

#[test]
fn deep_nesting_is_refused() {
    let level = "Compound(parts: [(shape: ";
    let deep = format!("(version: 1, interactors: [(shape: {}", level.repeat(10_000));
    assert!(error_of(&deep).message.to_lowercase().contains("recursion"));
}
