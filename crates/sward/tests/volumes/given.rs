//! A meadow under a clear sky with a low sun, photographed.

use glam::Vec3;
use sward::shading::environment::Environment;
use sward::shading::volume::Spot;

use crate::Test;
use crate::level::volume;
use crate::scenes::{near, small, world};

pub(crate) const TESTS: &[Test] = &[("park_sun", sun), ("park_light_above_plants", above)];

/// Irradiance of level ground, in the file's units, as the data's description says.
const LEVEL: [f32; 3] = [1.68, 1.79, 2.19];

fn park() -> Environment {
    let bytes = std::fs::read(crate::park().expect("the picture")).expect("readable");
    Environment::from_hdr(&bytes, 1.0, 0.0).expect("a picture")
}

fn sun() {
    let sun = park().sun.expect("a sun");
    let elevation = sun.direction.y.asin().to_degrees();
    let azimuth = sun.direction.z.atan2(sun.direction.x);
    // Column 306.5 of 512, row 112.5 of 256, counted from the corner of the first pixel.
    let wanted = (306.5 / 512.0 - 0.5) * std::f32::consts::TAU;
    println!("sun: {} high, azimuth {azimuth}, irradiance {}", elevation, sun.irradiance);
    assert!((elevation - 10.5).abs() < 1.0 && (azimuth - wanted).abs() < 0.02, "{elevation} {azimuth}");
}

/// Above the plants the volume's light and the sun's make what the picture as a whole does on level ground.
fn above() {
    let park = park();
    let sun = park.sun.expect("a sun");
    let meadow = volume(&world("stands: [(species: Meadow)]", park, small()));
    let level = |up: f32| {
        let sky = meadow.faces(Spot { across: [0.5; 2], up })[2].truncate() * std::f32::consts::PI;
        sky + sun.irradiance * sun.direction.y
    };
    let found = level(1.0);
    println!("irradiance above the plants: {found}");
    assert!((0..3).all(|channel| near(found[channel], LEVEL[channel], 0.02)), "{found}");
    let below = level(0.0) - sun.irradiance * sun.direction.y;
    assert!(below.max_element() < 0.5 * Vec3::from(LEVEL).min_element(), "control: {below}");
}
