//! PNG files that cannot be terrains, winds or masks.

use std::io::Cursor;

use image::{DynamicImage, ImageBuffer, ImageFormat};

use crate::support::Place;
use crate::{refuses, takes};

const TERRAIN: &str = "(version: 1,\n terrain: Image(path: \"maps/hills.png\"))";
const WIND: &str = "(version: 1,\n wind: [Uniform(), Footprint(flow: Image(path: \"maps/whirl.png\"))])";
const MASK: &str = "(version: 1, stands: [(species: Lawn, cells: 16)],\n masks: [(path: \"maps/grey.png\", size: (9, 9))])";
const SIDECAR: &str = "columns = 6\nrows = 4\nmetres_per_pixel_x = 30\nmetres_per_pixel_y = 30\nmin_height_m = 0\nmax_height_m = 9\n";

fn png(picture: DynamicImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).expect("in memory");
    bytes.into_inner()
}

fn heights(width: u32, height: u32) -> Vec<u8> {
    png(ImageBuffer::from_fn(width, height, |x, y| image::Luma([(x * y) as u16])).into())
}

fn directions(side: u32) -> Vec<u8> {
    png(image::RgbImage::from_pixel(side, side, image::Rgb([255, 128, 200])).into())
}

fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xEDB8_8320 } else { crc >> 1 })
    })
}

/// The same file with another size in its header.
fn announcing(mut png: Vec<u8>, width: u32, height: u32) -> Vec<u8> {
    png[16..20].copy_from_slice(&width.to_be_bytes());
    png[20..24].copy_from_slice(&height.to_be_bytes());
    let sum = crc(&png[12..29]);
    png[29..33].copy_from_slice(&sum.to_be_bytes());
    png
}

/// A whole picture, harmed in ways that any PNG can be.
fn harmed(whole: &[u8]) -> Vec<(Vec<u8>, &'static str)> {
    let cut = |at: usize| whole[..at].to_vec();
    let mut flipped = whole.to_vec();
    let data = whole.windows(4).position(|name| name == b"IDAT").expect("it has data");
    flipped[data + 8] ^= 0x55;
    let mut length = whole.to_vec();
    length[data - 4..data].copy_from_slice(&u32::MAX.to_be_bytes());
    [cut(0), b"GIF89a".to_vec(), cut(7), cut(20), cut(data + 6), cut(whole.len() / 2 + 10), flipped, length]
        .map(|bytes| (bytes, "is not a readable PNG"))
        .into()
}

#[test]
fn terrains_that_are_no_png_are_refused() {
    let place = Place::new("bad_terrain_png");
    let at = "2:23";
    refuses(&place, TERRAIN, at, &["maps/hills.png: cannot be read", "type a path"]);
    place.write("maps/hills.png", heights(6, 4));
    refuses(&place, TERRAIN, at, &["maps/hills.toml: cannot be read", "metres_per_pixel_x"]);
    place.write("maps/hills.toml", SIDECAR);
    takes(&place, TERRAIN);
    let refuse = |bytes: &[u8], words: &[&str]| {
        place.write("maps/hills.png", bytes);
        refuses(&place, TERRAIN, "", &[&["test.ron:2:23: ", "maps/hills.png"], words].concat());
    };
    for (bytes, words) in harmed(&heights(6, 4)) {
        refuse(&bytes, &[words, "expected is a 16-bit grey PNG", "export it again"]);
    }
    for (width, height) in [(100_000, 4), (i32::MAX as u32, i32::MAX as u32), (6, 4_000_000)] {
        refuse(&announcing(heights(6, 4), width, height), &["are announced", "correct what announces them"]);
    }
    refuse(&announcing(heights(6, 4), 0, 4), &["export it again"]);
    refuse(&announcing(heights(6, 4), u32::MAX, u32::MAX), &["export it again"]);
    refuse(&directions(6), &["the terrain has 6 rows, but 4 are announced", "correct what announces them"]);
    refuse(&png(DynamicImage::new_rgb8(6, 4)), &["is Rgb8, needed is 16-bit grey", "gdal_translate"]);
    refuse(&png(DynamicImage::new_luma8(6, 4)), &["is L8, needed is 16-bit grey", "gdal_translate"]);
}

/// A picture that its text file agrees with, and that is too large for both.
#[test]
fn terrains_with_wrong_words_beside_them_are_refused() {
    let place = Place::new("bad_sidecar");
    place.write("maps/hills.png", heights(6, 4));
    let refuse = |text: &str, words: &[&str]| {
        place.write("maps/hills.toml", text);
        refuses(&place, TERRAIN, "", &[&["test.ron:2:23: ", "maps/hills.toml"], words].concat());
    };
    refuse("", &["lacks `columns`", "add a line like `columns = 403`"]);
    refuse("columns", &["not valid TOML", "line 1", "expected are lines like"]);
    refuse(&SIDECAR.replace("columns = 6", "columns = \"six\""), &["`columns` is \"six\", allowed is a number"]);
    refuse(&SIDECAR.replace("= 30", "= nan"), &["`metres_per_pixel_x` is NaN, allowed is 0.001 to 1000000 m"]);
    refuse(&SIDECAR.replace("= 30", "= -30"), &["`metres_per_pixel_x` is -30, allowed is 0.001 to 1000000 m"]);
    refuse(&SIDECAR.replace("= 9", "= -9"), &["`max_height_m` is -9, allowed is at least `min_height_m`"]);
    refuse(&SIDECAR.replace("columns = 6", "columns = 100000"), &["`columns` is 100000, allowed is a whole number from 1 to 16384"]);
    refuse(&SIDECAR.replace("columns = 6", "columns = 16384").replace("rows = 4", "rows = 16384"), &["at most 33554432 samples"]);
    refuse(&SIDECAR.replace("rows = 4", "rows = inf"), &["`rows` is inf, allowed is a whole number"]);
    place.write("maps/hills.toml", [0xff, 0xfe]);
    refuses(&place, TERRAIN, "2:23", &[]);
    place.write("maps/hills.toml", SIDECAR);
    takes(&place, TERRAIN);
}

#[test]
fn winds_that_are_no_png_are_refused() {
    let place = Place::new("bad_wind_png");
    refuses(&place, WIND, "2:48", &["maps/whirl.png: cannot be read", "type a path"]);
    place.write("maps/whirl.png", directions(16));
    takes(&place, WIND);
    let refuse = |bytes: &[u8], words: &[&str]| {
        place.write("maps/whirl.png", bytes);
        refuses(&place, WIND, "", &[&["test.ron:2:48: ", "maps/whirl.png"], words].concat());
    };
    for (bytes, words) in harmed(&directions(16)) {
        refuse(&bytes, &[words, "export it again as RGB"]);
    }
    for (width, height) in [(1, 1), (16, 8), (513, 513), (100_000, 100_000), (i32::MAX as u32, i32::MAX as u32)] {
        let words = format!("is {width} x {height} pixels, expected a square of 2 to 512 a side");
        refuse(&announcing(directions(16), width, height), &[&words, "export it smaller"]);
    }
}

#[test]
fn masks_that_are_no_png_are_refused() {
    let place = Place::new("bad_mask_png");
    refuses(&place, MASK, "2:17", &["maps/grey.png: cannot be read", "type a path"]);
    let help = "export it as a grey PNG of 8 or 16 bits, at most 2048 pixels a side";
    let refuse = |bytes: &[u8], words: &[&str]| {
        place.write("maps/grey.png", bytes);
        refuses(&place, MASK, "2:17", &[&["maps/grey.png: the mask is", help], words].concat());
    };
    let grey = png(image::GrayImage::from_fn(16, 16, |x, y| image::Luma([(x * 16 + y) as u8])).into());
    for whole in [&grey, &heights(16, 16)] {
        place.write("maps/grey.png", whole);
        takes(&place, MASK);
        for (bytes, _) in harmed(whole) {
            refuse(&bytes, &["not a readable PNG"]);
        }
    }
    for (width, height) in [(2049, 1), (1, 2049), (60_000, 60_000)] {
        refuse(&announcing(grey.clone(), width, height), &[&format!("{width} x {height} pixels, allowed are 1 to 2048 a side")]);
    }
    for (width, height) in [(0, 16), (i32::MAX as u32, i32::MAX as u32), (u32::MAX, u32::MAX)] {
        refuse(&announcing(grey.clone(), width, height), &["not a readable PNG"]);
    }
    refuse(&directions(16), &["Rgb8, needed is 8- or 16-bit grey"]);
}

/// Folders, devices and nothing at all where a file should be.
#[test]
fn things_that_are_no_files_are_refused() {
    let place = Place::new("no_files");
    std::fs::create_dir_all(place.0.join("maps/hills.png")).expect("writable");
    for path in ["maps/hills.png", "maps", "/", "..", "/dev/zero", "maps\\\\0", "\\u{0}"] {
        let scene = format!("(version: 1, terrain: Image(path: \"{path}\"))");
        refuses(&place, &scene, "1:35", &["cannot be read", "type a path"]);
        refuses(
            &place,
            &scene.replace("terrain: Image(path", "interactors: [(shape: Mesh(file").replace("))", "))])"),
            "1:47",
            &["cannot be read"],
        );
    }
}
