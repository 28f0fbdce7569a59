//! The light of scenes with surroundings is kept, found again, never trusted blindly, and never needed.

mod support;

use std::path::PathBuf;

use image::ImageEncoder;
use support::Place;

const SCENE: &str = r#"(
    version: 1,
    field: (patch_side: 8),
    stands: [(species: Meadow, cells: 32)],
    light: (environment: (file: "sky.hdr", volume: (reach: 4, layers: 4, samples: 32))),
)
"#;

/// A bright sky over dark ground, as Radiance RGBE.
fn sky(blue: f32) -> Vec<u8> {
    let pixels: Vec<[f32; 3]> = (0..32 * 16).map(|at| if at < 32 * 8 { [0.6, 0.8, blue] } else { [0.1, 0.1, 0.05] }).collect();
    let mut bytes = Vec::new();
    let encoder = image::codecs::hdr::HdrEncoder::new(&mut bytes);
    encoder.write_image(bytemuck::cast_slice(&pixels), 32, 16, image::ExtendedColorType::Rgb32F).expect("written to memory");
    bytes
}

fn place(name: &str) -> Place {
    let place = Place::new(name);
    place.write("scene.ron", SCENE);
    place.write("sky.hdr", sky(1.0));
    place
}

/// Draws, and returns what was said on stderr.
fn draw(place: &Place, more: &[&str]) -> String {
    let common = ["render", "scene.ron", "-o", "out.png", "--time", "0", "--size", "48x32", "--draw", "cpu", "--on", "cpu"];
    let ran = place.sward_with(&[&common, more].concat(), &[("XDG_CACHE_HOME", place.0.join("home").to_str().expect("a path"))]);
    assert_eq!(ran.status, 0, "{}", ran.errors);
    ran.errors
}

fn picture(place: &Place) -> Vec<u8> {
    std::fs::read(place.0.join("out.png")).expect("a picture")
}

/// Files of a folder.
fn kept(place: &Place, folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(place.0.join(folder)).into_iter().flatten();
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    files
}

#[test]
fn light_is_kept_and_found_again() {
    let place = place("kept");
    draw(&place, &["--cache", "light"]);
    let (files, first) = (kept(&place, "light"), picture(&place));
    assert_eq!(files.len(), 1, "{files:?}");
    // A mark inside tells a file that is read from one that is made anew.
    let written = std::fs::metadata(&files[0]).and_then(|about| about.modified()).expect("a time");
    assert_eq!(draw(&place, &["--cache", "light"]), "");
    assert_eq!(std::fs::metadata(&files[0]).and_then(|about| about.modified()).expect("a time"), written, "it was written again");
    assert_eq!(picture(&place), first);
    // Another scene, another file: so does another sky.
    place.write("sky.hdr", sky(0.3));
    draw(&place, &["--cache", "light"]);
    assert_eq!(kept(&place, "light").len(), 2);
    assert_ne!(picture(&place), first, "control: another sky looks the same");
}

#[test]
fn the_users_own_cache_folder_is_the_usual_place() {
    let place = place("usual");
    draw(&place, &[]);
    if cfg!(target_os = "linux") {
        assert_eq!(kept(&place, "home/sward").len(), 1);
    }
}

#[test]
fn nothing_is_kept_where_that_is_asked_for() {
    let place = place("nothing");
    draw(&place, &["--no-cache"]);
    assert!(!place.0.join("home").exists(), "{:?}", place.files());
    place.refuses(&["render", "scene.ron", "--cache", "light", "--no-cache"], &["cannot be used with"]);
}

#[test]
fn damaged_light_is_made_anew() {
    let place = place("damaged");
    draw(&place, &["--cache", "light"]);
    let (file, good) = (kept(&place, "light").remove(0), picture(&place));
    let whole = std::fs::read(&file).expect("kept");
    for damage in [Vec::new(), whole[..whole.len() / 2].to_vec(), [&whole[..100], &[whole[100] ^ 1], &whole[101..]].concat()] {
        std::fs::write(&file, damage).expect("written");
        let told = draw(&place, &["--cache", "light"]);
        assert!(told.contains("worked out anew"), "{told}");
        assert_eq!(picture(&place), good);
        assert_eq!(std::fs::read(&file).expect("kept"), whole, "it is whole again");
    }
}

/// A folder below a file can neither be read nor written.
#[test]
fn without_a_place_the_picture_still_comes() {
    let place = place("nowhere");
    place.write("file", "in the way");
    let told = draw(&place, &["--cache", "file/light"]);
    assert!(told.contains("cannot") && told.contains("--no-cache"), "{told}");
    assert!(!picture(&place).is_empty());
    assert_eq!(draw(&place, &["--cache", "light"]), "", "control: elsewhere nothing is said");
}

#[test]
fn bad_surroundings_are_refused_in_words() {
    let place = place("bad");
    let refuse = |words: &[&str]| place.refuses(&["render", "scene.ron", "-o", "out.png", "--no-cache"], words);
    place.write("sky.hdr", b"nothing of the kind");
    refuse(&["sky.hdr", "not a readable Radiance picture", "twice as wide as high"]);
    place.write("sky.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000000 +X 2000000000\n");
    refuse(&["2000000000 x 1000000000", "4096"]);
    let half = sky(1.0);
    place.write("sky.hdr", &half[..half.len() / 2]);
    refuse(&["sky.hdr", "not a readable"]);
    std::fs::remove_file(place.0.join("sky.hdr")).expect("removed");
    refuse(&["sky.hdr", "cannot be read"]);
    place.write("scene.ron", SCENE.replace("sky.hdr", ""));
    refuse(&["`file` is empty"]);
}
