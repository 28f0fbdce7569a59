use super::*;
use crate::math::{hash, tests::validate, unit};
use image::DynamicImage;
use std::io::Cursor;

/// Rough ground: independent samples up to 40 m.
fn rough() -> Terrain {
    let heights = (0..7 * 5).map(|i| 40.0 * unit(hash(1, 0, 0, i, 9))).collect();
    Terrain::new(heights, 7, 5, [3.0, 2.0], [-4.0, 10.0]).unwrap()
}

fn jacksboro(scale: f64, offset: [f64; 2]) -> Terrain {
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/jacksboro");
    let png = std::fs::read(format!("{assets}.png")).unwrap();
    let sidecar = std::fs::read_to_string(format!("{assets}.toml")).unwrap();
    Terrain::from_image(&png, &sidecar, scale, offset).unwrap()
}

/// Points spread over a square around a middle, without pattern.
fn points(middle: [f64; 2], reach: f64) -> impl Iterator<Item = [f64; 2]> {
    let along = |i, purpose| f64::from(unit(hash(2, 0, 0, i, purpose))) * 2.0 - 1.0;
    (0..2000).map(move |i| [middle[0] + reach * along(i, 1), middle[1] + reach * along(i, 2)])
}

#[test]
fn samples_are_met_exactly_and_mirrored_outside() {
    let terrain = rough();
    for row in -9..14i32 {
        for column in -13..20i32 {
            let (x, z) = (f64::from(column) * 3.0 - 4.0, f64::from(row) * 2.0 + 10.0);
            let index = mirrored(row, 5) * 7 + mirrored(column, 7);
            let sample = terrain.heights()[index as usize];
            assert_eq!(terrain.height_at(x, z), f64::from(sample));
            assert_eq!(terrain.height(terrain.anchor([x, z]), [0.0; 2]), sample);
        }
    }
    let row: Vec<i32> = (-5..9).map(|i| mirrored(i, 4)).collect();
    assert_eq!(row, [1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 0, 1, 2]);
}

#[test]
fn height_and_slope_are_continuous_across_sample_and_mirror_lines() {
    let terrain = rough();
    let mut steepest: f64 = 0.0;
    for line in -20..30 {
        for t in 0..40 {
            let along = f64::from(t) * 0.73 - 10.0;
            let (x, z) = (f64::from(line) * 3.0 - 4.0, f64::from(line) * 2.0 + 10.0);
            for (a, b) in [([x - 1e-7, along], [x + 1e-7, along]), ([along, z - 1e-7], [along, z + 1e-7])] {
                let (low, low_slope) = terrain.height_and_gradient_at(a[0], a[1]);
                let (high, high_slope) = terrain.height_and_gradient_at(b[0], b[1]);
                assert!((low - high).abs() < 1e-4, "height jumps at {a:?}");
                for axis in 0..2 {
                    assert!((low_slope[axis] - high_slope[axis]).abs() < 1e-4, "slope jumps at {a:?}");
                    steepest = steepest.max(low_slope[axis].abs());
                }
            }
        }
    }
    assert!(steepest > 5.0, "the ground is too smooth to prove anything: {steepest}");
}

#[test]
fn the_slope_at_a_mirror_line_is_level_across_it() {
    let terrain = rough();
    for i in 0..50 {
        let along = f64::from(i) * 0.37;
        for x in [-4.0, 14.0] {
            assert!(terrain.height_and_gradient_at(x, along).1[0].abs() < 1e-12);
        }
        for z in [10.0, 18.0] {
            assert!(terrain.height_and_gradient_at(along, z).1[1].abs() < 1e-12);
        }
    }
}

#[test]
fn slope_is_the_difference_of_heights() {
    let terrain = rough();
    for [x, z] in points([5.0, 14.0], 40.0) {
        let step = 1e-4;
        let along_x = (terrain.height_at(x + step, z) - terrain.height_at(x - step, z)) / (2.0 * step);
        let along_z = (terrain.height_at(x, z + step) - terrain.height_at(x, z - step)) / (2.0 * step);
        let slope = terrain.height_and_gradient_at(x, z).1;
        assert!((slope[0] - along_x).abs() < 2e-3 && (slope[1] - along_z).abs() < 2e-3, "at {x}, {z}");
        let ours = terrain.gradient(terrain.anchor([x, z]), [0.0; 2]);
        assert!((f64::from(ours[0]) - slope[0]).abs() < 1e-4 && (f64::from(ours[1]) - slope[1]).abs() < 1e-4);
    }
}

/// Largest error \[m\] of the `f32` kernel against the `f64` surface up to 64 m from anchors around a place.
fn kernel_error(terrain: &Terrain, middle: [f64; 2]) -> f64 {
    let mut worst: f64 = 0.0;
    for (ground, away) in points(middle, 1000.0).zip(points([0.0; 2], 64.0)) {
        let local = away.map(|metres| metres as f32);
        let exact = terrain.height_at(ground[0] + f64::from(local[0]), ground[1] + f64::from(local[1]));
        worst = worst.max((f64::from(terrain.height(terrain.anchor(ground), local)) - exact).abs());
    }
    worst
}

#[test]
fn kernels_are_exact_far_from_home() {
    let far = [256_000.0, -256_000.0];
    let worst = [
        kernel_error(&jacksboro(1.0, [0.0; 2]), [500.0, 300.0]),
        kernel_error(&jacksboro(1.0, far), far),
        kernel_error(&jacksboro(1.0 / 32.0, far), far),
        kernel_error(&jacksboro(1.0 / 32.0, [0.0; 2]), far),
    ];
    println!("{worst:?} m");
    assert!(worst.iter().all(|metres| *metres < 1e-4), "{worst:?}");
    let terrain = jacksboro(1.0, far);
    let absolute = |[x, z]: [f64; 2]| terrain.height_at((x as f32).into(), (z as f32).into()) - terrain.height_at(x, z);
    assert!(points(far, 1000.0).any(|p| absolute(p).abs() > 1e-4), "absolute f32 positions must be too coarse");
}

#[test]
fn the_shipped_terrain_lies_as_its_sidecar_says() {
    let terrain = jacksboro(0.5, [100.0, -50.0]);
    assert_eq!((terrain.columns(), terrain.rows()), (403, 344));
    assert_eq!(terrain.spacing(), [74.5732 * 0.5, 92.475 * 0.5]);
    assert!((terrain.corner()[0] - (100.0 - 201.0 * 74.5732 * 0.5)).abs() < 1e-9);
    assert!((terrain.corner()[1] - (-50.0 - 171.5 * 92.475 * 0.5)).abs() < 1e-9);
    let lowest = terrain.heights().iter().copied().fold(f32::MAX, f32::min);
    let highest = terrain.heights().iter().copied().fold(f32::MIN, f32::max);
    assert_eq!([lowest, highest], [118.0, 538.0]);
}

#[test]
fn flat_ground_is_exactly_flat() {
    let terrain = Terrain::flat(12.3);
    for place in [[0.0, 0.0], [1e9, -3.7], [f64::NAN, f64::INFINITY]] {
        for local in [[0.0, 0.0], [5.5, -7e3], [f32::NAN, f32::INFINITY]] {
            assert_eq!(terrain.height_and_gradient(terrain.anchor(place), local), (12.3, [0.0; 2]));
        }
    }
    assert_eq!(Terrain::flat(f32::NAN), Terrain::default());
    let odd = rough().height_and_gradient(rough().anchor([0.0; 2]), [f32::NEG_INFINITY, 3e38]);
    assert!(odd.0.is_finite());
}

const SIDECAR: &str = "columns = 5\nrows = 4\nmetres_per_pixel_x = 2.5\nmetres_per_pixel_y = 3\nmin_height_m = -10\nmax_height_m = 20.0\n";

fn png(image: DynamicImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

fn small() -> Vec<u8> {
    let ramp = image::ImageBuffer::from_fn(5, 4, |x, y| image::Luma([(x * 13_000 + y * 700) as u16]));
    png(DynamicImage::ImageLuma16(ramp))
}

fn load(bytes: &[u8], sidecar: &str) -> Result<Terrain, TerrainError> {
    Terrain::from_image(bytes, sidecar, 1.0, [0.0; 2])
}

#[test]
fn errors_name_the_key_or_what_was_found() {
    let terrain = load(&small(), SIDECAR).unwrap();
    assert_eq!(terrain.heights()[6], (-10.0 + 13_700.0 / 65535.0 * 30.0) as f32);
    let message = |bytes: &[u8], sidecar: &str| load(bytes, sidecar).unwrap_err().to_string();
    for key in ["columns", "rows", "metres_per_pixel_x", "metres_per_pixel_y", "min_height_m", "max_height_m"] {
        let others = |text: &str| text.lines().filter(|l| !l.starts_with(key)).fold(String::new(), |a, l| a + l + "\n");
        assert!(message(&small(), &others(SIDECAR)).contains(&format!("lacks `{key}`")));
        for value in ["'wide'", "nan", "-1e9", "true", "1e300"] {
            let wrong = others(SIDECAR) + key + " = " + value;
            assert!(message(&small(), &wrong).contains(&format!("`{key}` is")), "{wrong}");
        }
    }
    assert!(message(&small(), &SIDECAR.replace("columns = 5", "columns = 6")).contains("5 columns, but 6"));
    assert!(message(&small(), &SIDECAR.replace("-10", "21")).contains("at least `min_height_m`"));
    assert!(message(&small(), "columns = = 3").contains("not valid TOML"));
    assert!(message(&png(DynamicImage::new_rgb8(5, 4)), SIDECAR).contains("is Rgb8"));
    assert!(message(&png(DynamicImage::new_luma8(5, 4)), SIDECAR).contains("is L8"));
    assert!(message(b"not a picture", SIDECAR).contains("not a readable PNG"));
    for (scale, offset) in [(0.0, [0.0; 2]), (f64::NAN, [0.0; 2]), (1.0, [f64::INFINITY, 0.0])] {
        assert!(Terrain::from_image(&small(), SIDECAR, scale, offset).is_err());
    }
    assert!(Terrain::new(vec![0.0; 5], 2, 3, [1.0; 2], [0.0; 2]).is_err());
    assert!(Terrain::new(vec![f32::NAN], 1, 1, [1.0; 2], [0.0; 2]).is_err());
}

#[test]
fn damaged_pictures_are_errors_not_panics() {
    let whole = small();
    let mut refused = 0;
    for at in 0..whole.len() {
        refused += usize::from(load(&whole[..at], SIDECAR).is_err());
        for flip in [1, 0x80, 0xff] {
            let mut damaged = whole.clone();
            damaged[at] ^= flip;
            let _ = load(&damaged, SIDECAR);
        }
    }
    assert!(refused > whole.len() / 2, "{refused} of {} truncations refused", whole.len());
}

#[test]
fn the_twin_is_valid() {
    let host = "fn terrain_load(index: i32) -> f32 { return f32(index); }";
    validate(&[crate::math::WGSL, WGSL, host]).unwrap();
    assert!(validate(&[crate::math::WGSL, WGSL]).is_err());
}

/// Detail over flat ground, 4 octaves from 3 m down, 0.5 m high.
fn bumpy(origin: [f64; 2]) -> Terrain {
    let detail = crate::scene::Detail { amplitude: 0.5, wavelength: 3.0, octaves: 4, roughness: 0.6, seed: 5 };
    Terrain::flat(0.0).with_detail(Detail::new(&detail, origin))
}

#[test]
fn detail_is_as_high_as_asked_for() {
    let terrain = bumpy([0.0; 2]);
    assert!(!terrain.is_flat() && Terrain::flat(0.0).is_flat());
    let heights: Vec<f64> = points([3.0, -8.0], 500.0).map(|[x, z]| terrain.height_at(x, z)).collect();
    let most = heights.iter().fold(0.0_f64, |most, height| most.max(height.abs()));
    let mean = heights.iter().sum::<f64>() / heights.len() as f64;
    let rms = (heights.iter().map(|height| height * height).sum::<f64>() / heights.len() as f64).sqrt();
    println!("most {most} m, mean {mean} m, rms {rms} m of an amplitude of 0.5 m");
    assert!((0.4..0.75).contains(&most) && mean.abs() < 0.01 && (rms - 0.5 / 3.0).abs() < 0.012);
    let none = crate::scene::Detail { amplitude: 0.0, ..Default::default() };
    assert!(Terrain::flat(0.0).with_detail(Detail::new(&none, [0.0; 2])).is_flat());
}

#[test]
fn detail_is_smooth_to_its_second_derivative() {
    let terrain = bumpy([0.0; 2]);
    let step = 1e-4;
    let bend = |x: f64, z: f64| {
        let slope = |x: f64, z: f64| terrain.height_and_gradient_at(x, z).1[0];
        (slope(x + step, z) - slope(x - step, z)) / (2.0 * step)
    };
    let mut sharpest: f64 = 0.0;
    // Across lattice lines of every octave, and away from them.
    for k in -40..40 {
        for along in [0.31, 1.7, 2.2] {
            let line = f64::from(k) * 0.375;
            let (before, after) = (bend(line - 3e-4, along), bend(line + 3e-4, along));
            assert!((before - after).abs() < 0.2, "curvature jumps at {line}, {along}: {before}, {after}");
            sharpest = sharpest.max(before.abs());
        }
    }
    assert!(sharpest > 2.0, "control: it is curved at all: {sharpest}");
    for [x, z] in points([0.0; 2], 30.0) {
        let exact = terrain.height_and_gradient_at(x, z).1;
        let along_x = (terrain.height_at(x + step, z) - terrain.height_at(x - step, z)) / (2.0 * step);
        let along_z = (terrain.height_at(x, z + step) - terrain.height_at(x, z - step)) / (2.0 * step);
        assert!((exact[0] - along_x).abs() < 1e-5 && (exact[1] - along_z).abs() < 1e-5, "slope at {x}, {z}");
    }
}

#[test]
fn detail_is_exact_far_from_home_and_moves_with_its_origin() {
    let far = [256_000.0, -256_000.0];
    let (home, away) = (bumpy([0.0; 2]), bumpy(far));
    let mut worst: f64 = 0.0;
    for ([x, z], local) in points([0.0; 2], 60.0).zip(points([0.0; 2], 40.0)) {
        let moved = [x + far[0], z + far[1]];
        assert!((home.height_at(x, z) - away.height_at(moved[0], moved[1])).abs() < 1e-9);
        let local = local.map(|metres| metres as f32);
        let exact = away.height_and_gradient_at(moved[0] + f64::from(local[0]), moved[1] + f64::from(local[1]));
        let ours = away.height_and_gradient(away.anchor(moved), local);
        worst = worst.max((f64::from(ours.0) - exact.0).abs()).max(0.01 * (f64::from(ours.1[0]) - exact.1[0]).abs());
    }
    println!("kernels are off by {worst} m");
    assert!(worst < 2e-5, "{worst}");
    let differs = |other: &Terrain| points([0.0; 2], 60.0).any(|[x, z]| (home.height_at(x, z) - other.height_at(x, z)).abs() > 0.05);
    assert!(differs(&bumpy([0.7, 0.0])), "control: another origin, other bumps");
}
