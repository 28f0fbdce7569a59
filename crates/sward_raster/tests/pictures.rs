//! Pictures do not depend on threads; odd worlds and sizes are drawn without complaint.

use sward::model::NoAssets;
use sward::picture::blade_plan::BAND;
use sward::scene::Scene;
use sward::world::World;
use sward_raster::{Studio, Thinning};

const SCENE: &str = "(version: 1, field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32), (species: Lawn, cells: 32)],
    wind: [Natural(velocity: (3.0, 1.0))], budget: (patches: 25, focus_distance: 12.0, lag_distance: 12.0),
    interactors: [(name: \"ball\", shape: Sphere(radius: 0.6), path: Circle(radius: 3.0, speed: 4.0)), (shape: Truck)])";

fn world(text: &str, steps: u32) -> World {
    let mut world = World::new(Scene::parse(text, "test.ron").expect("valid"), &NoAssets).expect("it compiles");
    (0..steps).for_each(|_| world.step());
    world
}

/// FNV-1a over the bytes of a picture.
fn hash(world: &World, threads: usize) -> u64 {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let picture = pool.install(|| Studio::new(world).draw(world, [150, 100]));
    assert_eq!([picture.width, picture.height, picture.rgba8.len() as u32], [150, 100, 60_000]);
    picture.rgba8.iter().fold(0xcbf2_9ce4_8422_2325, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

/// A sparse picture shows the same light and colours with fewer plants; with a share of 1 it is the usual one, bit for bit.
#[test]
fn sparse_pictures_look_alike() {
    for response in ["Continuum()", "Chain()"] {
        let representation = if response == "Chain()" { "Blade()" } else { "Billboard()" };
        let text = format!(
            "(version: 1, stands: [(species: Meadow, response: {response}, representation: {representation})], budget: (patches: 9, focus_distance: 0))"
        );
        let world = world(&text, 0);
        let draw = |near: Option<f64>| {
            let mut studio = Studio::new(&world);
            near.into_iter().for_each(|near| studio.thin(near));
            studio.draw(&world, [160, 90]).rgba8
        };
        let (usual, same, sparse) = (draw(None), draw(Some(1.0)), draw(Some(0.2)));
        assert!(usual == same, "{response}");
        let changed = usual.iter().zip(&sparse).filter(|(a, b)| a.abs_diff(**b) > 8).count();
        assert!(changed > usual.len() / 50, "control: {response}: {changed} values change");
        let mean = |picture: &[u8]| picture.iter().map(|value| f64::from(*value)).sum::<f64>() / picture.len() as f64;
        let (usual, sparse) = (mean(&usual), mean(&sparse));
        println!("{response}: mean {usual:.1}, sparse {sparse:.1}");
        assert!((usual - sparse).abs() < 6.0, "{response}: mean {usual} became {sparse}");
    }
}

/// The same camera, blades thinned out for it and for one a centimetre on: hardly a pixel changes. Control: a metre on, as
/// where densities are decided for whole patches. What a hard border does to single blades is tested in the core (`nothing_pops`).
#[test]
fn blades_do_not_pop() {
    do_not_pop("Continuum()", true);
    do_not_pop("VirtualInertia()", false);
    do_not_pop("Chain()", false);
}

/// Blades of one response, with a ball that has rolled among them; also with a hard border, and as pictures are drawn by themselves, if `all`.
fn do_not_pop(response: &str, all: bool) {
    let world = world(
        &format!(
            "(version: 1, stands: [(species: Meadow, response: {response}, representation: Blade())], wind: [Natural(velocity: (3, 1))],
            interactors: [(name: \"ball\", shape: Sphere(radius: 0.5), path: Keyframes(keys: [(time: 0, at: (-2, 0)), (time: 1, at: (2, 0))]))],
            camera: (eye: (0, 1.7, -8), target: (0, 0.5, 10)), budget: (patches: 9, focus_distance: 0))"
        ),
        30,
    );
    let (studio, eye) = (Studio::new(&world), world.camera().eye);
    let draw = |way: f64, band: f32| {
        let thinning = Thinning { eye: [eye[0], eye[1], eye[2] + way], band };
        studio.draw_thinned(&world, thinning, [640, 360]).rgba8
    };
    let changed = |here: &[u8], there: &[u8]| {
        let pixels = here.chunks_exact(4).zip(there.chunks_exact(4));
        let count = pixels.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 8)).count();
        100.0 * count as f64 / (640.0 * 360.0)
    };
    let here = draw(0.0, BAND);
    let (own, far) = (changed(&here, &draw(0.01, BAND)), changed(&here, &draw(1.0, BAND)));
    println!("{response}: {own:.4} % of the pixels change by more than 8 of 255; a metre on {far:.1} %");
    assert!(own <= 0.1, "{response}: {own} % pop");
    assert!(far > 1.0, "control: {far} %");
    if all {
        println!("{response}: with a hard border {:.4} %", changed(&draw(0.0, 1e-6), &draw(0.01, 1e-6)));
        assert_eq!(here, studio.draw(&world, [640, 360]).rgba8, "a picture's own thinning");
    }
}

#[test]
fn threads_do_not_change_a_picture() {
    let (early, late) = (world(SCENE, 10), world(SCENE, 11));
    let one = hash(&early, 1);
    assert_eq!(one, hash(&early, 1));
    assert_eq!(one, hash(&early, 2));
    assert_eq!(one, hash(&early, 5));
    assert_ne!(one, hash(&late, 2), "a step later the picture is another one");
}

/// Sides that are no multiple of a tile's, one pixel, none.
#[test]
fn odd_sizes_are_drawn() {
    let world = world(SCENE, 0);
    let studio = Studio::new(&world);
    for (size, got) in [([1, 1], [1, 1]), ([65, 3], [65, 3]), ([0, 7], [1, 7])] {
        let picture = studio.draw(&world, size);
        assert_eq!([picture.width, picture.height], got);
        assert_eq!(picture.rgba8.len(), 4 * (got[0] * got[1]) as usize);
        assert!(picture.rgba8.chunks_exact(4).all(|pixel| pixel[3] == 255));
    }
}

/// A small picture is the large one, seen through fewer pixels.
#[test]
fn sizes_show_the_same() {
    let world = world(SCENE, 5);
    let studio = Studio::new(&world);
    let mean = |size: [u32; 2]| {
        let picture = studio.draw(&world, size);
        picture.rgba8.iter().map(|byte| f64::from(*byte)).sum::<f64>() / picture.rgba8.len() as f64
    };
    assert!((mean([64, 36]) - mean([192, 108])).abs() < 4.0);
}

/// Nothing grows, the camera stands in a body, looks straight down, or away from everything; and numbers at the edge of what is valid.
#[test]
fn odd_worlds_are_drawn() {
    for text in [
        "(version: 1)",
        "(version: 1, stands: [(species: Reed, cells: 16)], field: (patch_side: 8), camera: (eye: (1, 0.5, 1), target: (1, 0, 1.0001)))",
        "(version: 1, interactors: [(shape: Box(size: (9, 9, 9)), path: Still(at: (0, 0)))], camera: (eye: (0, 2, 0), target: (0, 2, 9)))",
        "(version: 1, stands: [(species: Lawn, cells: 16)], field: (patch_side: 8), camera: (eye: (0, 9, 0), target: (0, 90, 9)))",
    ] {
        let world = world(text, 2);
        let picture = Studio::new(&world).draw(&world, [40, 30]);
        assert_eq!(picture.rgba8.len(), 4800, "{text}");
    }
}

/// What a browser does not have.
const ELSEWHERE: [&str; 5] = ["std::time", "std::fs", "std::thread", "std::env", "std::net"];

fn needs(text: &str) -> Vec<&'static str> {
    ELSEWHERE.into_iter().filter(|name| text.contains(name)).collect()
}

#[test]
fn nothing_is_needed_that_a_browser_lacks() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let files: Vec<_> = std::fs::read_dir(folder).expect("readable").flatten().filter(|entry| entry.path().is_file()).collect();
    assert!(files.len() > 10, "only {} files", files.len());
    for file in files {
        let text = std::fs::read_to_string(file.path()).expect("readable");
        assert_eq!(needs(&text), Vec::<&str>::new(), "{}", file.path().display());
    }
    assert_eq!(needs("let now = std::time::Instant::now();"), ["std::time"]);
}
