//! Terrains from PNG, TIFF and the words beside them; winds and masks from PNG.

use std::io::Cursor;

use image::{DynamicImage, ImageBuffer, ImageFormat};
use sward::scene::Scene;
use sward::terrain::Terrain;

use crate::chance::Chance;
use crate::files::{GEOGRAPHIC, MERCATOR, Tiff, compressed, float, whole};
use crate::glue::{Files, used};
use crate::{bytes, run, words};

/// Words beside [`heights`].
pub(crate) const SIDECAR: &str =
    "columns = 6\nrows = 4\nmetres_per_pixel_x = 30\nmetres_per_pixel_y = 30\nmin_height_m = 0\nmax_height_m = 9\n";

fn png(picture: DynamicImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).expect("in memory");
    bytes.into_inner()
}

/// 6 × 4 samples.
pub(crate) fn heights() -> Vec<u8> {
    png(ImageBuffer::from_fn(6, 4, |x, y| image::Luma([(x * 9000 + y * 77) as u16])).into())
}

/// A square of 8 pixels a side.
pub(crate) fn directions() -> Vec<u8> {
    png(image::RgbImage::from_fn(8, 8, |x, y| image::Rgb([(30 * x) as u8, (31 * y) as u8, 200])).into())
}

/// 5 × 3 shades of grey.
pub(crate) fn shades() -> Vec<u8> {
    png(image::GrayImage::from_fn(5, 3, |x, y| image::Luma([(60 * x + 20 * y) as u8])).into())
}

/// A small world on that ground; whether it was taken.
fn walked(path: &str, files: Vec<(&'static str, Vec<u8>)>) -> bool {
    let text = format!(
        "(version: 1, field: (patch_side: 8), terrain: Image(path: \"{path}\"), stands: [(species: Lawn, cells: 8)],
         interactors: [(shape: Sphere(radius: 1), path: Circle(radius: 3, speed: 4))], budget: (patches: 9))"
    );
    used(Scene::parse(&text, "ground.ron").expect("a scene"), &Files(files))
}

fn sealed(mut file: Vec<u8>, others: &[Vec<u8>], chance: &mut Chance) -> Vec<u8> {
    bytes::mutate(&mut file, others, chance);
    if !chance.one_in(4) {
        bytes::seal_png(&mut file);
    }
    file
}

#[test]
fn terrain_pngs_never_panic() {
    let files = [
        heights(),
        directions(),
        png(DynamicImage::new_luma16(6, 4)),
        png(DynamicImage::new_rgba16(6, 4)),
        png(DynamicImage::new_luma8(6, 4)),
    ];
    assert!(walked("a.png", vec![("a.png", heights()), ("a.toml", SIDECAR.as_bytes().to_vec())]), "control");
    let tally = run("terrain PNG", 0.08, |chance| {
        let file = sealed(chance.pick(&files).clone(), &files, chance);
        walked("a.png", vec![("a.png", file), ("a.toml", SIDECAR.as_bytes().to_vec())])
    });
    tally.is_mixed(0.005);
}

#[test]
fn terrain_words_never_panic() {
    let text = words::pieces(SIDECAR);
    let known: Vec<String> = text.iter().filter(|piece| piece.len() > 3).cloned().collect();
    let tally = run("terrain words", 0.06, |chance| {
        let mut list = text.clone();
        words::mutate(&mut list, &known, std::slice::from_ref(&text), chance);
        walked("a.png", vec![("a.png", heights()), ("a.toml", list.concat().into_bytes())])
    });
    tally.is_mixed(0.005);
}

#[test]
fn terrain_tiffs_never_panic() {
    let (real, counted): (Vec<f32>, Vec<i16>) = ((0..63).map(|k| (k % 17) as f32).collect(), (0..63).map(|k| k % 23).collect());
    let mut files = vec![
        float(Tiff::new(9, 7).pixel(1.0, 1.0).tie(0.0, 30.0).keys(GEOGRAPHIC).missing("3"), &real),
        whole(Tiff::new(9, 7).pixel(5.0, 5.0).keys(MERCATOR), &counted),
        compressed(Tiff::new(9, 7).pixel(5.0, 5.0), &counted),
    ];
    files.extend(Tiff::new(7, 9).pixel(2.0, 3.0).all_kinds(&[1.5; 63]).into_iter().map(|(_, file)| file));
    assert!(files.iter().all(|file| walked("a.tif", vec![("a.tif", file.clone())])), "control: unharmed files are taken");
    let tally = run("terrain TIFF", 0.16, |chance| {
        let mut file = chance.pick(&files).clone();
        bytes::mutate(&mut file, &files, chance);
        // The directory lies at the end: there most is decided.
        if chance.one_in(2) {
            let mut tail = file.split_off(file.len().saturating_sub(150));
            bytes::mutate(&mut tail, &files, chance);
            file.extend(tail);
        }
        if chance.one_in(8) {
            Terrain::from_tiff(&file, Some("metres_per_pixel_x = 3\nmetres_per_pixel_y = 4"), 1.0, [0.0; 2]).is_ok()
        } else {
            walked("a.tif", vec![("a.tif", file)])
        }
    });
    tally.is_mixed(0.005);
}

#[test]
fn wind_pngs_never_panic() {
    let files = [directions(), heights(), png(DynamicImage::new_rgba8(8, 8)), png(DynamicImage::new_luma16(2, 2))];
    let blown = |file: Vec<u8>| {
        let text = "(version: 1, field: (patch_side: 8), stands: [(species: Lawn, cells: 8)], budget: (patches: 9),
            wind: [Footprint(flow: Image(path: \"a.png\"), radius: 9, path: Circle(radius: 3, speed: 4))])";
        used(Scene::parse(text, "wind.ron").expect("a scene"), &Files(vec![("a.png", file)]))
    };
    assert!(blown(directions()), "control");
    let tally = run("wind PNG", 0.06, |chance| blown(sealed(chance.pick(&files).clone(), &files, chance)));
    tally.is_mixed(0.005);
}

#[test]
fn direction_pngs_never_panic() {
    let files = [directions(), shades(), png(DynamicImage::new_rgb8(1, 1)), png(DynamicImage::new_rgb16(3, 2))];
    let combed = |file: Vec<u8>| {
        let text = "(version: 1, field: (patch_side: 8), stands: [(species: Lawn, cells: 8)], budget: (patches: 9),
            masks: [(direction: \"a.png\", at: (-9, -7), size: (15, 20))],
            interactors: [(shape: Sphere(radius: 1), path: Circle(radius: 3, speed: 4))])";
        used(Scene::parse(text, "comb.ron").expect("a scene"), &Files(vec![("a.png", file)]))
    };
    assert!(combed(directions()) && !combed(shades()), "control");
    let tally = run("direction PNG", 0.04, |chance| combed(sealed(chance.pick(&files).clone(), &files, chance)));
    tally.is_mixed(0.005);
}

#[test]
fn mask_pngs_never_panic() {
    let files = [shades(), heights(), png(DynamicImage::new_luma8(1, 1)), png(DynamicImage::new_luma16(40, 2)), directions()];
    let grown = |file: Vec<u8>| {
        let text = "(version: 1, field: (patch_side: 8), stands: [(species: Lawn, cells: 8)], budget: (patches: 9),
            masks: [(path: \"a.png\", at: (-9, -7), size: (15, 20), outside: 0.5)],
            interactors: [(shape: Sphere(radius: 1), path: Circle(radius: 3, speed: 4))])";
        used(Scene::parse(text, "mask.ron").expect("a scene"), &Files(vec![("a.png", file)]))
    };
    assert!(files.iter().take(4).all(|file| grown(file.clone())) && !grown(directions()), "control");
    let tally = run("mask PNG", 0.06, |chance| grown(sealed(chance.pick(&files).clone(), &files, chance)));
    tally.is_mixed(0.005);
}
