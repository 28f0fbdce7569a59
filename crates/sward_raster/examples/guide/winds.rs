//! Maps of the air, as worlds answer for it, and a wind that is painted.

use std::path::Path;

use image::{ExtendedColorType, ImageFormat};
use sward::model::Assets;
use sward::scene::Scene;
use sward::world::World;

use super::Written;
use super::curves::{arrows, maps};
use super::field::{open, run};

/// Half the side of a map, m.
const HALF: f64 = 10.0;

/// Arrows on an even grid round a place, `scale` m long for each m/s.
fn air(world: &World, [x, z]: [f64; 2], scale: f64) -> Vec<([f64; 2], [f64; 2])> {
    let at = |k: i32| f64::from(k) * 1.25;
    let grid: Vec<[f64; 2]> = (-7..=7).flat_map(|j| (-7..=7).map(move |i| [at(i), at(j)])).collect();
    let places: Vec<[f64; 2]> = grid.iter().map(|place| [x + place[0], z + place[1]]).collect();
    let winds = world.winds_at(&places).into_iter().map(|wind| wind.map(|part| f64::from(part) * scale));
    grid.into_iter().zip(winds).collect()
}

/// A picture of wind: a lane that winds its way from one side to the other. Red and green are the direction, blue the strength.
pub(crate) fn lane() -> Vec<u8> {
    let side = 64_u32;
    let mut pixels = Vec::new();
    for (row, column) in (0..side).flat_map(|row| (0..side).map(move |column| (row, column))) {
        let [x, z] = [column, row].map(|at| (f64::from(at) + 0.5) / f64::from(side) * 2.0 - 1.0);
        let (middle, slope) = (0.45 * (3.0 * x).sin(), 1.35 * (3.0 * x).cos());
        let length = slope.hypot(1.0);
        let strength = (1.0 - ((z - middle) / length / 0.3).abs()).max(0.0);
        pixels.extend([1.0 / length, slope / length].map(|part| (127.5 + 127.5 * part).round() as u8));
        pixels.push((255.0 * strength).round() as u8);
    }
    let mut png = std::io::Cursor::new(Vec::new());
    // Writing into memory fails for no picture of this size.
    let _ = image::write_buffer_with_format(&mut png, &pixels, side, side, ExtendedColorType::Rgb8, ImageFormat::Png);
    png.into_inner()
}

/// Gives [`lane`] under any name.
pub(crate) struct Painted;

impl Assets for Painted {
    fn read(&self, _: &str) -> Result<Vec<u8>, String> {
        Ok(lane())
    }
}

pub(crate) fn footprints(path: &Path) -> Written {
    let world = |wind: &str| {
        let text = format!("(version: 1, stands: [(species: Meadow)], wind: [{wind}])");
        World::new(Scene::parse(&text, "guide.ron")?, &Painted)
    };
    let worlds = [
        world("Footprint(radius: 9, speed: 10)")?,
        world("Footprint(flow: Swirl, radius: 9, speed: 10)")?,
        world("Footprint(flow: Image(path: \"lane.png\"), radius: 9, speed: 10)")?,
    ];
    maps(path, &["Outward", "Swirl", "Image"], HALF, |index, axes| arrows(axes, &air(&worlds[index], [0.0; 2], 0.2)))
}

/// Air that flows: by itself, with a car, and behind a shed.
pub(crate) fn flow(path: &Path) -> Written {
    let world = |wind: &str, bodies: &str| {
        let text = format!("(version: 1, stands: [(species: Meadow)], wind: [{wind}], interactors: [{bodies}])");
        let mut world = open(&text)?;
        run(&mut world, 4.0);
        Ok::<_, Box<dyn std::error::Error>>(world)
    };
    let truck = "(shape: Truck, path: Keyframes(keys: [(time: 0, at: (-14, 16)), (time: 4, at: (22, 16))]))";
    let shed = "(shape: Box(size: (5, 3, 5)), path: Still(at: (12, 16)))";
    let worlds = [
        world("Fluid(velocity: (4, 0))", "")?,
        world("Fluid(velocity: (1, 0), gusts: [])", truck)?,
        world("Fluid(velocity: (4, 0), gusts: [], fade: 6)", shed)?,
    ];
    let titles = ["gusts and eddies", "behind a truck", "round a shed"];
    maps(path, &titles, HALF, |index, axes| arrows(axes, &air(&worlds[index], [16.0, 16.0], 0.22)))
}
