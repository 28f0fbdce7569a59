//! Stills, drawn on the CPU, one or several beside each other.

use std::path::Path;

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use sward::scene::Scene;
use sward::world::World;
use sward_raster::Studio;

use super::Written;
use super::field::{open, run};
use super::winds::Painted;

/// Worlds at their moment, drawn beside each other, each in `size` pixels.
fn strip(path: &Path, size: [u32; 2], worlds: &[World]) -> Written {
    let gap = 4;
    let width = worlds.len() as u32 * (size[0] + gap) - gap;
    let mut pixels = vec![255; (3 * width * size[1]) as usize];
    for (index, world) in worlds.iter().enumerate() {
        let picture = Studio::new(world).draw(world, size);
        for (row, line) in picture.rgba8.chunks_exact(4 * size[0] as usize).enumerate() {
            let start = 3 * (row * width as usize + index * (size[0] + gap) as usize);
            for (to, from) in pixels[start..].chunks_exact_mut(3).zip(line.chunks_exact(4)) {
                to.copy_from_slice(&from[..3]);
            }
        }
    }
    let file = std::io::BufWriter::new(std::fs::File::create(path)?);
    Ok(JpegEncoder::new_with_quality(file, 84).write_image(&pixels, width, size[1], ExtendedColorType::Rgb8)?)
}

/// A scene at a moment.
fn at(text: &str, time: f64) -> Result<World, Box<dyn std::error::Error>> {
    let mut world = open(text)?;
    run(&mut world, time);
    Ok(world)
}

/// The first scene of the guide, as its chapter has it.
pub(crate) fn first(path: &Path) -> Written {
    let chapter = include_str!("../../../../docs/guide/first-scene.md");
    let scene = chapter.split("```ron\n").nth(1).and_then(|rest| rest.split("```").next()).ok_or("the chapter has no scene")?;
    strip(path, [640, 360], &[at(scene, 5.2)?])
}

/// A meadow through which a truck has driven away from the camera, when it is `far` m ahead.
fn truck(stand: &str, far: f64) -> Result<World, Box<dyn std::error::Error>> {
    let text = format!(
        "(version: 1, stands: [({stand})], camera: (eye: (1.8, 2.3, -3.5), target: (0.1, 0.1, 4), field_of_view: 0.75),
          light: (azimuth: 0.9, elevation: 0.35, exposure: 0.4),
          interactors: [(shape: Truck, path: Keyframes(keys: [(time: 0, at: (0, -8)), (time: 5, at: (0, 27))]))])"
    );
    at(&text, (far + 8.0) / 7.0)
}

pub(crate) fn responses(path: &Path) -> Written {
    let stands = ["Continuum()", "Oscillator()", "VirtualInertia()", "Springs()"];
    let worlds = stands.map(|response| truck(&format!("species: Meadow, height: (0.45, 0.65), response: {response}"), 5.5));
    strip(path, [300, 200], &worlds.into_iter().collect::<Result<Vec<_>, _>>()?)
}

pub(crate) fn representations(path: &Path) -> Written {
    let near = |stand: &str| {
        let text = format!(
            "(version: 1, stands: [({stand})], wind: [Natural(velocity: (4, 1))],
              camera: (eye: (0, 0.9, -1.2), target: (0, 0.35, 2), field_of_view: 0.7))"
        );
        at(&text, 2.0)
    };
    strip(
        path,
        [300, 200],
        &[
            near("species: Meadow, representation: Billboard()")?,
            near("species: Meadow, representation: Sheet()")?,
            near("species: Meadow, representation: Blade()")?,
            near("species: Shrub, places: [(at: (0, 1.9), height: 1.1)]")?,
        ],
    )
}

/// What the truck leaves behind with three damping ratios.
pub(crate) fn track(path: &Path) -> Written {
    let behind = |response: &str| truck(&format!("species: Meadow, response: Continuum({response})"), 14.0);
    strip(
        path,
        [316, 210],
        &[behind("frequency: 1.7, damping: 0.36")?, behind("frequency: 0.36, damping: 4")?, behind("frequency: 0.36, damping: 10")?],
    )
}

pub(crate) fn gain(path: &Path) -> Written {
    let gusts = |wind: f32| {
        let text = format!(
            "(version: 1, stands: [(species: Reed, response: Continuum(wind: {wind}))], wind: [Natural(velocity: (7, 0), turbulence: 0.3)],
              camera: (eye: (0, 2.2, -6), target: (0, 0.7, 2), field_of_view: 0.7))"
        );
        at(&text, 4.0)
    };
    strip(path, [316, 210], &[gusts(0.01)?, gusts(0.0385)?, gusts(0.12)?])
}

/// Reed in the moment after a bar, with three delays of the tip.
pub(crate) fn trail(path: &Path) -> Written {
    let after = |delay: f32| {
        let text = format!(
            "(version: 1, stands: [(species: Reed, cover: 0.5, response: Continuum(gamma_top: {delay}, gamma_recover: {delay}))],
              camera: (eye: (4.5, 1.3, 0.2), target: (0, 0.6, 0.2), field_of_view: 0.7),
              interactors: [(shape: Box(size: (28, 0.5, 0.6)), clearance: 0.1, until: 2,
                path: Keyframes(keys: [(time: 0, at: (0, -12)), (time: 2, at: (0, 12))]))])"
        );
        at(&text, 1.45)
    };
    strip(path, [316, 210], &[after(0.0)?, after(0.2)?, after(0.5)?])
}

/// A meadow under a wind that is painted: a lane that winds its way.
pub(crate) fn painted(path: &Path) -> Written {
    let text = "(version: 1, stands: [(species: Meadow, height: (0.5, 0.7), clumping: 0.1)],
        wind: [Footprint(flow: Image(path: \"lane.png\"), radius: 9, speed: 24)],
        camera: (eye: (0, 9, -11), target: (0, 0, -0.5), field_of_view: 0.85), light: (azimuth: 0.9, elevation: 0.6, exposure: 0.8))";
    let mut world = World::new(Scene::parse(text, "guide.ron")?, &Painted)?;
    run(&mut world, 2.0);
    strip(path, [640, 360], &[world])
}
