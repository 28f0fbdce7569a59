//! Files of surroundings: good ones, and all sorts of bad ones.

use std::io::Cursor;

use glam::Vec3;
use image::codecs::hdr::HdrEncoder;
use image::{ExtendedColorType, ImageEncoder};
use sward::shading::environment::Environment;

use crate::Test;
use crate::scenes::{near, surroundings};

pub(crate) const TESTS: &[Test] = &[
    ("a_written_picture_is_read_back", read_back),
    ("bad_pictures_are_refused_in_words", refused),
    ("the_sun_is_taken_out_and_shines_by_itself", sun),
    ("no_sun_no_shadow", overcast),
    ("turning_turns_the_light", turned),
];

/// A picture as bytes.
fn hdr(columns: u32, rows: u32, pixels: &[[f32; 3]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let flat: &[u8] = bytemuck::cast_slice(pixels);
    HdrEncoder::new(Cursor::new(&mut bytes)).write_image(flat, columns, rows, ExtendedColorType::Rgb32F).expect("written");
    bytes
}

/// The format shares one exponent among three bytes.
fn read_back() {
    let pixels: Vec<[f32; 3]> = (0..32 * 16).map(|at| [0.5 + at as f32 / 512.0, 1.0, 0.25]).collect();
    let read = Environment::from_hdr(&hdr(32, 16, &pixels), 2.0, 0.5).expect("a picture");
    assert_eq!((read.columns, read.rows, read.turn), (32, 16, 0.5));
    for (found, wanted) in read.radiance.iter().zip(&pixels) {
        assert!((0..3).all(|channel| (found[channel] - 2.0 * wanted[channel]).abs() < 0.02), "{found:?} {wanted:?}");
    }
}

fn refused() {
    let good = hdr(32, 16, &[[1.0; 3]; 512]);
    assert!(Environment::from_hdr(&good, 1.0, 0.0).is_ok(), "control");
    let header = |size: &str| format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").into_bytes();
    let cases: [(Vec<u8>, &str); 9] = [
        (Vec::new(), "not a readable"),
        (b"P6 32 16 255".to_vec(), "not a readable"),
        (good[..good.len() / 2].to_vec(), "not a readable"),
        (header("-Y 2147483647 +X 2147483647"), "4096 wide"),
        (header("-Y 1000000000 +X 2000000000"), "4096 wide"),
        (header("-Y 0 +X 0"), ""),
        (header("-Y 4096 +X 8192"), "4096 wide"),
        (hdr(16, 16, &[[1.0; 3]; 256]), "twice as wide"),
        (hdr(4, 2, &[[1.0; 3]; 8]), "8 to 4096"),
    ];
    for (case, (bytes, words)) in cases.into_iter().enumerate() {
        let error = Environment::from_hdr(&bytes, 1.0, 0.0).expect_err("a bad picture");
        assert!(error.contains(words), "case {case}: {error}");
    }
    // Any byte may be wrong.
    let mut state = 1_u32;
    for _ in 0..2000 {
        let mut bytes = good.clone();
        for _ in 0..3 {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            let at = (state >> 8) as usize % bytes.len();
            bytes[at] = state as u8;
        }
        if let Ok(read) = Environment::from_hdr(&bytes, 1.0, 0.0) {
            assert!(read.level.iter().all(|light| light.is_finite()));
        }
    }
}

const SUN: Vec3 = Vec3::new(0.48, 0.64, 0.6);

/// A blue sky with a small sun of known strength.
fn sunny() -> Environment {
    surroundings(|direction| {
        let near = Vec3::from(direction).dot(SUN) > 0.9985;
        if near { [900.0, 800.0, 600.0] } else { [0.2, 0.4, 0.8].map(|value| value * (0.5 + 0.5 * direction[1].max(0.0))) }
    })
}

fn sun() {
    let sky = sunny();
    let sun = sky.sun.expect("a sun");
    assert!(sun.direction.dot(SUN) > 0.998, "{}", sun.direction);
    assert!(near(sun.irradiance.x / sun.irradiance.z, 1.5, 0.02), "{}", sun.irradiance);
    let brightest = sky.radiance.iter().flatten().copied().fold(0.0, f32::max);
    assert!(brightest < 1.0, "left in the picture: {brightest}");
    // Nothing is lost: sky and sun together light level ground as the whole does.
    let whole = (0..sky.columns * sky.rows).map(|at| {
        let (row, side) = (at / sky.columns, std::f32::consts::PI / sky.rows as f32);
        let (level, up) = ((row as f32 + 0.5) * side).sin_cos();
        let turn = ((at % sky.columns) as f32 + 0.5) * side - std::f32::consts::PI;
        let direction = Vec3::new(level * turn.cos(), up, level * turn.sin());
        let radiance = if direction.dot(SUN) > 0.9985 { 900.0 } else { 0.2 * (0.5 + 0.5 * up.max(0.0)) };
        radiance * level * up.max(0.0) * side * side
    });
    let (whole, parts) = (whole.sum::<f32>(), sky.level[0].x + sun.irradiance.x * sun.direction.y);
    assert!(near(parts, whole, 0.01), "{parts} instead of {whole}");
    let light = sky.light(1.0, 0.0, 0.5);
    assert_eq!(light.sun_colour, sun.irradiance);
    assert_eq!(sky.light(0.0, 0.0, 0.5).sun_colour, Vec3::ZERO, "without strength it gives no light");
}

fn overcast() {
    let grey = surroundings(|[_, up, _]| [1.0 + 0.5 * up; 3]);
    assert_eq!(grey.sun, None);
    assert_eq!(grey.light(1.0, 0.3, 0.4).sun_colour, Vec3::ZERO);
    assert!(grey.exposure() > 0.1 && grey.exposure() < 10.0, "{}", grey.exposure());
    let thousand = surroundings(|[_, up, _]| [1000.0 + 500.0 * up; 3]);
    assert!(near(thousand.exposure() * 1000.0, grey.exposure(), 0.01), "whatever the unit is");
    let dark = surroundings(|_| [0.0; 3]);
    assert!(dark.exposure().is_finite() && dark.light(1.0, 0.0, 0.1).sky == Vec3::ZERO);
}

fn turned() {
    let red = |turn: f32| {
        let pixels = surroundings(|[x, _, _]| [x.max(0.0), 0.1, 0.1]).radiance;
        Environment::new(crate::scenes::COLUMNS, crate::scenes::COLUMNS / 2, pixels, 1.0, turn)
    };
    let quarter = std::f32::consts::FRAC_PI_2;
    let [along_x, along_z] = [Vec3::X, Vec3::Z].map(|way| red(quarter).radiance_at(way).x);
    assert!(along_z > 0.9 && along_x < 0.1, "{along_x} {along_z}");
    let horizon = red(quarter).horizon;
    assert!(sward::shading::environment::air(&horizon, Vec3::Z).x > 2.0 * sward::shading::environment::air(&horizon, Vec3::NEG_Z).x);
    assert!(red(0.0).radiance_at(Vec3::X).x > 0.9, "control");
}
