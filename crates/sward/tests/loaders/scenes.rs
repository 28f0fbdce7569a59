//! Scenes: their text, and the worlds that come of them.

use sward::scene::Scene;

use crate::files::{Tiff, whole};
use crate::glue::{Files, smaller, used};
use crate::{glb, run, terrains, words};

/// Every kind of thing a scene may hold.
const RICH: &str = r#"(
    version: 1, title: "Rich", seed: 9, origin: (3, -4), steps_per_second: 60, field: (patch_side: 8, patches: (40, 30)),
    terrain: Image(path: "hills.png", scale: 0.5, offset: (10, 20)), detail: (amplitude: 0.2, wavelength: 3, octaves: 4, roughness: 0.6, seed: 3),
    stands: [(species: Reed, name: "a", cells: 16, cover: 0.5, lean: (0.1, -0.2), messiness: 0.3, clumping: 0.2, clump_size: 3, height: (0.2, 0.9),
        response: Continuum(frequency: 1.5, damping: 0.4, lag: History)), (species: Tussock, cells: 8, slope: (0.01, 0.9)), (species: Lawn, cells: 8)],
    exclusions: [(area: Road(points: [(-20, 3), (1, 2), (6, -9)], width: 3), soft: 1, above: 0.4, stands: ["a"], colour: (0.1, 0.2, 0.3)),
        (area: Box(at: (2, 1), size: (3, 5), yaw: 0.4)), (area: Polygon(points: [(8, 4), (14, 4), (11, 6)]), soft: 2), (area: Disc(at: (0, 9), radius: 2))],
    masks: [(path: "grey.png", at: (-9, -8), size: (20, 24), height: 0.7, outside: 0.6, stands: ["lawn", "a"], colour: (0.2, 0.1, 0)),
        (path: "grey.png", direction: "whirl.png", messiness: "grey.png", size: (5, 5))],
    edits: [(at: (3, 1), radius: 4, hardness: 0.5, change: Raise(height: 0.8)), (time: 0.01, at: (1, 2), change: Flatten(height: 12)),
        (time: 0.02, at: (-3, 2), radius: 2, change: Flatten())],
    wind: [Uniform(velocity: (1, 2)), Natural(velocity: (-3, 1), turbulence: 0.4), Footprint(flow: Swirl, radius: 9, follow: "b"),
        Footprint(flow: Image(path: "whirl.png"), radius: 6, speed: -20, height: 3, ceiling: 12, path: Circle(radius: 4, speed: 3))],
    interactors: [
        (name: "b", shape: Truck, path: Circle(centre: (1, 2), radius: 6, speed: -5, start: 1), clearance: 0.1),
        (shape: Mesh(file: "walker.glb", scale: 1.5, yaw: 1, offset: (0, 0.1, 0), pieces: 3, clip: "Walk", clip_speed: 2, clip_start: 0.2),
            path: Keyframes(keys: [(time: 0, at: (0, 0)), (time: 1, at: (3, 2), yaw: 1, clearance: 0.5), (time: 1.5, at: (3, 4))], repeat: true)),
        (shape: Compound(parts: [(shape: Box(size: (1, 2, 3)), offset: (1, 0, 0), yaw: 0.3), (shape: Ellipsoid(radii: (0.5, 1, 2)))]), path: Still(at: (5, 5), yaw: 2)),
        (shape: Polygon(points: [(-1, -1), (1, -1), (0, 1)], height: 2), path: Driven(at: (2, -2)), from: 0, until: 5, follow_ground: false),
        (shape: Sphere(radius: 0.7), clearance: -0.2)],
    camera: (eye: (0, 2, -9), target: (0, 1, 0), keys: [(time: 0, eye: (0, 2, -9), target: (0, 0, 0)), (time: 2, eye: (4, 2, -9), target: (0, 0, 0))]),
    light: (azimuth: 1, elevation: 0.7, fog: 0.01), budget: (patches: 12, focus_distance: 12, lag_distance: 9, visible_plants: 4096, beyond: Tiled),
)"#;

fn texts() -> Vec<String> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut paths: Vec<_> = std::fs::read_dir(folder).expect("the shipped scenes").flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let mut texts: Vec<String> = paths.iter().map(|path| std::fs::read_to_string(path).expect("text")).collect();
    texts.extend([
        RICH.to_owned(),
        RICH.replace("hills.png", "dem.tif"),
        "(version: 1, stands: [(species: Meadow, cells: 16)], wind: [Natural()])".to_owned(),
    ]);
    texts
}

/// It has a clip that scenes name.
const HELICOPTER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/helicopter.glb");

fn files() -> Files {
    let terrain = whole(Tiff::new(9, 7).pixel(5.0, 5.0), &(0..63).collect::<Vec<_>>());
    Files(vec![
        ("hills.png", terrains::heights()),
        ("hills.toml", terrains::SIDECAR.as_bytes().to_vec()),
        ("assets/jacksboro.png", terrains::heights()),
        ("assets/jacksboro.toml", terrains::SIDECAR.as_bytes().to_vec()),
        ("dem.tif", terrain),
        ("whirl.png", terrains::directions()),
        ("grey.png", terrains::shades()),
        ("walker.glb", glb::walker().bytes()),
        ("assets/clump.png", terrains::shades()),
        ("assets/helicopter.glb", std::fs::read(HELICOPTER).expect("shipped")),
        ("assets/torus.glb", glb::walker().bytes()),
        ("assets/walker.glb", glb::walker().bytes()),
    ])
}

#[test]
fn scenes_never_panic() {
    let (texts, files) = (texts(), files());
    for text in &texts {
        let mut scene = Scene::parse(text, "control.ron").unwrap_or_else(|error| panic!("{error}"));
        smaller(&mut scene);
        assert!(used(scene, &files), "control: unharmed scenes are taken");
    }
    let others: Vec<Vec<String>> = texts.iter().map(|text| words::pieces(text)).collect();
    let mut known: Vec<String> =
        sward::scene::reference().split(|letter: char| !letter.is_alphanumeric() && letter != '_').map(str::to_owned).collect();
    known.sort();
    known.dedup();
    let tally = run("scenes", 0.36, |chance| {
        let mut list = chance.pick(&others).clone();
        words::mutate(&mut list, &known, &others, chance);
        let Ok(mut scene) = Scene::parse(&list.concat(), "mutated.ron") else { return false };
        let again = Scene::parse(&scene.to_ron(), "again.ron").unwrap_or_else(|error| panic!("what is written is read: {error}"));
        assert!(scene == again, "what is written and read is another scene: {}", scene.to_ron());
        smaller(&mut scene);
        used(scene, &files)
    });
    tally.is_mixed(0.02);
}
