//! How plants lie by themselves: by a number, by pictures, each some way of its own.

use std::io::Cursor;

use image::{ImageFormat, RgbImage};
use sward::model::Assets;
use sward::placement::MOST_LEAN;
use sward::scene::Scene;
use sward::world::World;

use crate::growth::{Grey, plants};

/// Pictures: the left half along +x and the right half along −z, 45 degrees; messiness from black to white.
struct Pictures;

/// A PNG of rows of four colours.
fn painted(row: [[u8; 3]; 4]) -> Vec<u8> {
    let picture = RgbImage::from_fn(4, 4, |x, _| image::Rgb(row[x as usize]));
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).expect("written");
    bytes.into_inner()
}

impl Assets for Pictures {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        let (east, south) = ([255, 128, 255], [128, 1, 255]);
        match path {
            "ways.png" => Ok(painted([east, east, south, south])),
            "upright.png" => Ok(painted([[128, 128, 255]; 4])),
            "mess.png" => Grey(4, 1, vec![0, 0, 255, 255]).read(path),
            _ => Err(format!("{path} is missing")),
        }
    }
}

fn combed(stand: &str, masks: &str) -> Result<World, String> {
    let text = format!(
        "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 64, {stand}), (species: Lawn, cells: 64)], masks: [{masks}])"
    );
    let scene = Scene::parse(&text, "combed.ron").map_err(|error| error.to_string())?;
    World::new(scene, &Pictures).map_err(|error| error.to_string())
}

/// Roots and leans of a stand's plants.
fn leans(world: &World, stand: usize) -> Vec<([f32; 2], [f32; 2])> {
    let found: Vec<_> = plants(world, stand).into_iter().map(|plant| (plant.root, plant.lean)).collect();
    assert!(found.len() > 1000);
    found
}

fn near(a: [f32; 2], b: [f32; 2]) -> bool {
    (0..2).all(|axis| (a[axis] - b[axis]).abs() < 0.0051)
}

#[test]
fn a_number_leans_all_alike_and_messiness_scatters_them() {
    assert!(leans(&combed("", "").unwrap(), 0).iter().all(|(_, lean)| *lean == [0.0; 2]), "control");
    let world = combed("lean: (0.3, -0.4)", "").unwrap();
    assert!(leans(&world, 0).iter().all(|(_, lean)| *lean == [0.3, -0.4]));
    assert!(leans(&world, 1).iter().all(|(_, lean)| *lean == [0.0; 2]), "the other stand stands");
    let messy = leans(&combed("lean: (0.3, -0.4), messiness: 0.5", "").unwrap(), 0);
    let count = messy.len() as f32;
    for (axis, middle) in [(0, 0.3_f32), (1, -0.4)] {
        let off: Vec<f32> = messy.iter().map(|(_, lean)| lean[axis] - middle).collect();
        let (mean, most) = (off.iter().sum::<f32>() / count, off.iter().fold(0.0_f32, |most, off| most.max(off.abs())));
        // Even over ±0.3: a deviation of 0.3/√3.
        let spread = (off.iter().map(|off| off * off).sum::<f32>() / count).sqrt();
        assert!(mean.abs() < 0.01 && (0.29..0.3001).contains(&most) && (spread - 0.173).abs() < 0.01, "{mean} {most} {spread}");
    }
    let wild = leans(&combed("lean: (0.8, 0.8), messiness: 1", "").unwrap(), 0);
    let most = wild.iter().fold(0.0_f32, |most, (_, [x, z])| most.max(x.hypot(*z)));
    assert!(most <= MOST_LEAN + 1e-6 && most > 1.19, "{most}");
}

#[test]
fn pictures_say_how_plants_lie() {
    let mask = "(direction: \"ways.png\", at: (-8, -8), size: (16, 16), stands: [\"meadow\"])";
    let world = combed("lean: (0.1, 0.1)", mask).unwrap();
    let quarter = std::f32::consts::FRAC_PI_4;
    let (mut east, mut south, mut outside) = (0, 0, 0);
    for (root, lean) in leans(&world, 0) {
        if root.iter().any(|at| at.abs() > 8.0) {
            assert!(lean == [0.1, 0.1], "{root:?} {lean:?}: as the stand");
            outside += 1;
        } else if (-7.9..-2.1).contains(&root[0]) {
            assert!(near(lean, [quarter, 0.0]), "{root:?} {lean:?}");
            east += 1;
        } else if (2.1..7.9).contains(&root[0]) {
            assert!(near(lean, [0.0, -quarter]), "{root:?} {lean:?}");
            south += 1;
        }
    }
    assert!(east > 1000 && south > 1000 && outside > 1000);
    assert!(leans(&world, 1).iter().all(|(_, lean)| *lean == [0.0; 2]), "the stand that is not named");
    // The last of two holds, for what it speaks of.
    let both = combed("", &format!("{mask}, (direction: \"upright.png\", messiness: \"mess.png\", at: (-8, -8), size: (16, 16))")).unwrap();
    let found = leans(&both, 0);
    let tidy = found.iter().filter(|(root, _)| root[1].abs() < 8.0 && (-7.9..-2.1).contains(&root[0]));
    assert!(tidy.clone().count() > 1000 && tidy.clone().all(|(_, lean)| *lean == [0.0; 2]));
    let messy: Vec<_> = found.iter().filter(|(root, _)| root[1].abs() < 8.0 && (2.1..7.9).contains(&root[0])).collect();
    let spread = (messy.iter().map(|(_, lean)| lean[0] * lean[0]).sum::<f32>() / messy.len() as f32).sqrt();
    assert!((spread - 0.346).abs() < 0.02, "{spread}");
}

/// What stands up by itself in every response leans where it is combed: its bend is that much more.
#[test]
fn deformed_billboards_rest_as_they_are_combed() {
    let world = combed("lean: (0.3, -0.4), response: Springs(), cover: 1, clumping: 0", "").unwrap();
    let at = world.bend_at(0, [1.3, 2.2]).expect("a stand");
    assert!(near(at, [0.3, -0.4]), "{at:?}");
    let upright = combed("response: Springs(), cover: 1, clumping: 0", "").unwrap();
    assert!(near(upright.bend_at(0, [1.3, 2.2]).expect("a stand"), [0.0; 2]), "control");
}

#[test]
fn bad_pictures_are_refused_in_words() {
    let of = |mask: &str| combed("", mask).expect_err("refused");
    assert!(of("(size: (4, 4))").contains("this mask has no picture"), "{}", of("(size: (4, 4))"));
    let grey = of("(direction: \"mess.png\", size: (4, 4))");
    assert!(grey.contains("mess.png: the picture of directions is L8") && grey.contains("(128, 128, 255) is upright"), "{grey}");
    let colour = of("(messiness: \"ways.png\", size: (4, 4))");
    assert!(colour.contains("ways.png: the picture of messiness is Rgb8"), "{colour}");
    assert!(of("(direction: \"none.png\", size: (4, 4))").contains("none.png"));
    assert!(combed("lean: (0.9, 0)", "").is_err() && combed("messiness: 1.5", "").is_err());
}
