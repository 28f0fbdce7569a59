//! Nothing grows where a scene says so: exclusions, masks and steep ground.

use std::io::Cursor;

use crate::common::{Dice, world};
use sward::model::{Assets, Folder};
use sward::picture::subject::Frame;
use sward::placement::{self, Plant};
use sward::scene::Scene;
use sward::world::World;

const ROAD: &str = "(area: Road(points: [(-20, 3), (1, 2), (6, -9), (6, -40)], width: 4))";
const HOUSE: &str = "(area: Box(at: (-8, -7), size: (5, 9), yaw: 0.4))";
const YARD: &str = "(area: Polygon(points: [(8, 4), (14, 4), (14, 12), (11, 6), (8, 12)]))";
const POND: &str = "(area: Disc(at: (0, 11), radius: 2.5))";

/// Plants of the 5 × 5 patches round the origin, roots in m from it.
pub(crate) fn plants(world: &World, stand: usize) -> Vec<Plant> {
    let (model, mut found) = (&world.model.stands[stand], Vec::new());
    for patch in (0..25).map(|k| [k % 5 - 2, k / 5 - 2]) {
        let map = model.growth_map(&world.model.terrain, patch);
        for index in 0..model.cells * model.cells {
            let placed = placement::plant(&model.placement, patch, [index % model.cells, index / model.cells]);
            let plant = match &map {
                Some(map) => placed.and_then(|plant| placement::grown(plant, map[index as usize])),
                None => placed,
            };
            found.extend(plant.map(|plant| Plant { root: [0, 1].map(|axis| plant.root[axis] + patch[axis] as f32 * 8.0), ..plant }));
        }
    }
    found
}

fn meadow(more: &str) -> World {
    world(&format!("field: (patch_side: 8), stands: [(species: Meadow, cells: 64)], {more}"))
}

/// Distance of a point to a piece of a line, by another way than the product's: the nearest of many points on it.
fn near_line(points: &[[f64; 2]], at: [f64; 2]) -> f64 {
    let pieces = points.windows(2).flat_map(|pair| (0..=100).map(move |k| (pair[0], pair[1], f64::from(k) / 100.0)));
    pieces.map(|(a, b, t)| (a[0] + (b[0] - a[0]) * t - at[0]).hypot(a[1] + (b[1] - a[1]) * t - at[1])).fold(f64::MAX, f64::min)
}

fn in_house(at: [f64; 2]) -> bool {
    let (sine, cosine) = 0.4_f64.sin_cos();
    let (x, z) = (at[0] + 8.0, at[1] + 7.0);
    (cosine * x - sine * z).abs() < 2.5 && (sine * x + cosine * z).abs() < 4.5
}

/// Three corners' worth: the M-shaped yard is its rectangle without the notch.
fn in_yard(at: [f64; 2]) -> bool {
    let notch = 6.0 + 2.0 * (at[0] - 11.0).abs();
    at[0] > 8.0 && at[0] < 14.0 && at[1] > 4.0 && at[1] < notch
}

fn in_pond(at: [f64; 2]) -> bool {
    at[0].hypot(at[1] - 11.0) < 2.5
}

/// Whether a place lies in a shape.
type Inside<'a> = &'a dyn Fn([f64; 2]) -> bool;

#[test]
fn no_root_stands_in_an_exclusion() {
    let (free, limited) = (meadow(""), meadow(&format!("exclusions: [{ROAD}, {HOUSE}, {YARD}, {POND}]")));
    let on_road = |at: [f64; 2]| near_line(&[[-20.0, 3.0], [1.0, 2.0], [6.0, -9.0], [6.0, -40.0]], at) < 1.99;
    let all: [(&str, Inside); 4] = [("road", &on_road), ("house", &in_house), ("yard", &in_yard), ("pond", &in_pond)];
    let root = |plant: &Plant| plant.root.map(f64::from);
    let (wild, kept) = (plants(&free, 0), plants(&limited, 0));
    let mut gone = 0;
    for (name, inside) in all {
        // Near roots only: the slow oracle is asked less often.
        let count = |plants: &[Plant]| plants.iter().step_by(3).filter(|plant| inside(root(plant))).count();
        assert!(count(&wild) > 100, "control: {name} holds {}", count(&wild));
        assert_eq!(kept.iter().filter(|plant| name != "road" && inside(root(plant))).count() + count(&kept), 0, "{name}");
        gone += count(&wild);
    }
    let lost = wild.len() - kept.len();
    assert!(lost > 2 * gone && lost < 4 * gone, "{lost} of {} plants are gone, {gone} of every third", wild.len());
    // What is left is what stood there before.
    assert!(kept.iter().all(|plant| wild.contains(plant)));
}

#[test]
fn patches_out_of_reach_have_no_map() {
    let limited = meadow(&format!("exclusions: [{HOUSE}]"));
    let stand = &limited.model.stands[0];
    let map = |patch| stand.growth_map(&limited.model.terrain, patch);
    assert!(map([-1, -1]).is_some() && map([3, 3]).is_none() && map([800_000, 5]).is_none());
    assert!(meadow("").model.stands[0].growth_map(&limited.model.terrain, [0, 0]).is_none());
}

#[test]
fn margins_thin_out_and_shrink() {
    let share = |world: &World, low: f64, high: f64| {
        let found = plants(world, 0);
        let band: Vec<&Plant> = found.iter().filter(|plant| (low..high).contains(&f64::from(plant.root[0]).abs())).collect();
        (band.len() as f64, band.iter().map(|plant| f64::from(plant.height)).sum::<f64>() / band.len().max(1) as f64)
    };
    let wall = "(area: Road(points: [(0, -100), (0, 100)], width: 2), soft: 4)";
    let (free, soft) = (meadow(""), meadow(&format!("exclusions: [{wall}]")));
    let bands: Vec<(f64, f64)> = [(1.0, 2.0), (2.0, 3.0), (3.0, 4.0), (4.0, 5.0), (5.0, 9.0)]
        .map(|(low, high)| {
            let (own, all) = (share(&soft, low, high), share(&free, low, high));
            (own.0 / all.0, own.1 / all.1)
        })
        .to_vec();
    assert_eq!(share(&soft, 0.0, 1.0).0, 0.0);
    assert!(bands.windows(2).all(|pair| pair[0].0 <= pair[1].0 && pair[0].1 <= pair[1].1 + 0.01), "{bands:?}");
    assert!(bands[0].0 < 0.15 && bands[3].0 > 0.85 && bands[4] == (1.0, 1.0), "{bands:?}");
    assert!(bands[0].1 < 0.75, "{bands:?}");
}

#[test]
fn plants_grow_below_a_bridge_and_only_the_stands_named_are_kept_away() {
    let text = |more: &str| {
        format!(
            "field: (patch_side: 8), stands: [(species: Meadow, cells: 64), (species: Lawn, cells: 64)],
            exclusions: [(area: Disc(at: (0, 0), radius: 6), {more})]"
        )
    };
    let inside = |world: &World, stand: usize| {
        plants(world, stand)
            .iter()
            .filter(|plant| plant.root[0].hypot(plant.root[1]) < 5.99)
            .map(|plant| plant.height)
            .collect::<Vec<f32>>()
    };
    let bridge = world(&text("above: 0.4"));
    assert!(inside(&bridge, 0).iter().all(|height| *height <= 0.4) && inside(&bridge, 0).len() > 300, "low meadow stays");
    assert_eq!(inside(&bridge, 1).len(), inside(&world(&text("stands: [\"meadow\"]")), 1).len(), "all lawn stays");
    let only = world(&text("stands: [\"meadow\"]"));
    assert_eq!((inside(&only, 0).len(), inside(&only, 1).len() > 3000), (0, true));
    assert_eq!(inside(&world(&text("soft: 0")), 1).len(), 0, "control: without names it is for all");
}

/// A PNG of given grey values.
pub(crate) struct Grey(pub(crate) u32, pub(crate) u32, pub(crate) Vec<u8>);

impl Assets for Grey {
    fn read(&self, _: &str) -> Result<Vec<u8>, String> {
        let picture = image::GrayImage::from_raw(self.0, self.1, self.2.clone()).expect("that many");
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, image::ImageFormat::Png).expect("written");
        Ok(bytes.into_inner())
    }
}

fn masked(more: &str, grey: &dyn Assets) -> Result<World, String> {
    let text = format!(
        "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 64, clumping: 0)],
        masks: [(path: \"grey.png\", {more})])"
    );
    let scene = Scene::parse(&text, "masked.ron").map_err(|error| error.to_string())?;
    World::new(scene, grey).map_err(|error| error.to_string())
}

#[test]
fn a_mask_says_how_much_grows() {
    // Columns: black, half, white, white.
    let grey = Grey(4, 1, vec![0, 128, 255, 255]);
    let share = |world: &World, low: f32, high: f32| {
        let found = plants(world, 0);
        let cells = f64::from((high - low) * 40.0 * 64.0);
        let band: Vec<&Plant> = found.iter().filter(|plant| (low..high).contains(&plant.root[0])).collect();
        (band.len() as f64 / cells, band.iter().map(|plant| f64::from(plant.height)).sum::<f64>() / band.len().max(1) as f64)
    };
    let world = masked("at: (-8, -100), size: (16, 200), height: 0.5, outside: 0.0", &grey).unwrap();
    assert_eq!(share(&world, -8.0, -6.01).0, 0.0, "left half of the black column");
    // In the middle of the second column just its own grey; bilinear on both sides, so the mean of the column is near it.
    assert!((share(&world, -2.5, -1.5).0 - 0.5).abs() < 0.06, "{:?}", share(&world, -2.5, -1.5));
    assert_eq!((share(&world, 3.0, 8.0).0, share(&world, 8.0, 16.0).0), (1.0, 0.0), "white, and outside");
    let (grown, half) = (share(&world, 3.0, 8.0).1, share(&world, -2.5, -1.5).1);
    assert!((half / grown - 0.75).abs() < 0.04, "half grey, half followed: {half} of {grown}");
    let level = masked("at: (-8, -100), size: (16, 200), height: 0.0", &grey).unwrap();
    assert!((share(&level, -2.5, -1.5).1 / grown - 1.0).abs() < 0.04 && share(&level, 8.0, 16.0).0 == 1.0, "control");
}

/// The checksum of a chunk of a PNG.
fn crc(bytes: &[u8]) -> u32 {
    let bit = |crc: u32| if crc & 1 == 1 { crc >> 1 ^ 0xEDB8_8320 } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| bit(crc)))
}

#[test]
fn bad_masks_are_refused_in_words() {
    struct Bytes(Vec<u8>);
    impl Assets for Bytes {
        fn read(&self, _: &str) -> Result<Vec<u8>, String> {
            Ok(self.0.clone())
        }
    }
    let of = |bytes: Vec<u8>| masked("size: (9, 9)", &Bytes(bytes)).expect_err("a bad mask");
    assert_eq!(
        masked("size: (9, 9)", &Folder("/nowhere".into())).expect_err("no file").split(" (os").next(),
        Some("grey.png: cannot be read: /nowhere/grey.png: No such file or directory")
    );
    assert!(of(b"a picture".to_vec()).starts_with("grey.png: the mask is not a readable PNG"));
    let mut png = Cursor::new(Vec::new());
    image::RgbImage::new(4, 4).write_to(&mut png, image::ImageFormat::Png).expect("written");
    let png = png.into_inner();
    let help = "\n  help: export it as a grey PNG of 8 or 16 bits, at most 2048 pixels a side";
    assert_eq!(of(png), format!("grey.png: the mask is Rgb8, needed is 8- or 16-bit grey without alpha (L8, L16){help}"));
    // A header that promises 60000 × 60000 pixels is refused before any of them is made room for.
    let mut bomb = Grey(4, 4, vec![7; 16]).read("").unwrap();
    bomb[16..24].copy_from_slice(&[60000_u32.to_be_bytes(); 2].concat());
    let sum = crc(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&sum.to_be_bytes());
    assert_eq!(of(bomb), format!("grey.png: the mask is 60000 x 60000 pixels, allowed are 1 to 2048 a side{help}"));
    let grey = Grey(4, 4, vec![7; 16]).read("").unwrap();
    let mut dice = Dice(4);
    for _ in 0..300 {
        let mut damaged = grey.clone();
        let at = (dice.unit() * damaged.len() as f64) as usize;
        damaged[at] ^= 1 << (dice.unit() * 8.0) as u32;
        damaged.truncate((dice.unit() * 2.0 * grey.len() as f64) as usize + 1);
        let _ = masked("size: (9, 9)", &Bytes(damaged));
    }
    assert!(masked("size: (9, 9)", &Bytes(grey)).is_ok(), "control");
}

#[test]
fn steep_ground_stays_bare() {
    let text = |slope: &str| {
        format!("field: (patch_side: 8), detail: (amplitude: 1.5, wavelength: 6), stands: [(species: Meadow, cells: 64, {slope})]")
    };
    let steep = |world: &World| {
        let terrain = &world.model.terrain;
        let slope = |plant: &Plant| {
            let (_, [x, z]) = terrain.height_and_gradient_at(f64::from(plant.root[0]), f64::from(plant.root[1]));
            x.hypot(z)
        };
        let found = plants(world, 0);
        (found.len(), found.iter().map(slope).fold(0.0, f64::max))
    };
    let ((all, steepest), (some, limit)) = (steep(&world(&text(""))), steep(&world(&text("slope: (0, 0.4)"))));
    assert!(limit <= 0.4001 && steepest > 0.7, "control: up to {steepest}");
    assert!(some > all / 10 && some < all * 9 / 10, "{some} of {all}");
}

/// A body on the middle of a road pushes no plant: none stands there to pass the push on.
#[test]
fn bodies_on_bare_ground_push_nothing() {
    let text = |more: &str| {
        format!(
            "field: (patch_side: 8), stands: [(species: Meadow, cells: 64)], {more}
            interactors: [(shape: Sphere(radius: 0.5), path: Keyframes(keys: [(time: 0, at: (0, -6)), (time: 2, at: (0, 6))]))]"
        )
    };
    let bent = |more: &str| {
        let mut world = world(&text(more));
        (0..90).for_each(|_| world.step());
        let most = |stand: &sward::state::StandState| {
            stand.cells.now.iter().flat_map(|cells| cells.iter()).fold(0.0_f32, |most, value| most.max(value.abs()))
        };
        most(&world.state.stands[0])
    };
    let road = "exclusions: [(area: Road(points: [(0, -50), (0, 50)], width: 3))],";
    assert_eq!(bent(road), 0.0);
    assert!(bent("") > 0.5, "control");
    assert!(
        bent(&road.replace("width: 3", "width: 3, above: 1").replace("width: 3, above: 1)", "width: 3), above: 1")) > 0.5,
        "below a bridge grass is pushed"
    );
}

/// A mask that thins what grows outside its picture does so however far away the picture lies, for plants and for the colour of ground.
#[test]
fn a_far_mask_thins_the_ground_in_sight() {
    let grey = Grey(4, 1, vec![0, 128, 255, 255]);
    let seen = |outside: &str| {
        let world = masked(&format!("at: (90000, 90000), size: (16, 16), outside: {outside}"), &grey).unwrap();
        let view = world.camera();
        let (frame, _) = Frame::of(&world, &view, 0.0);
        let records = frame.input(&world, &view, &[]).growth.records;
        (records.iter().map(|record| record.outside).collect::<Vec<f32>>(), plants(&world, 0).len())
    };
    assert_eq!(seen("0"), (vec![0.0], 0));
    let (records, grown) = seen("1");
    assert!(records.is_empty() && grown > 10_000, "control: {grown}");
}
