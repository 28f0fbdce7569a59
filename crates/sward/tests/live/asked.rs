//! What games ask: how high bent grass stands, which plants stand where.

use super::{Text, USUAL, run};
use std::time::Instant;
use sward::model::NoAssets;
use sward::picture::standing::standing;
use sward::scene::{Change, Cut, Edit, Scene, WindSource};
use sward::world::World;

const STANDS: [&str; 6] = [
    "species: Meadow, cells: 32",
    "species: Meadow, cells: 32, response: Oscillator()",
    "species: Meadow, cells: 16, response: VirtualInertia(), representation: Blade(blades: 4)",
    "species: Meadow, cells: 16, response: Chain()",
    "species: Meadow, cells: 16, response: Springs()",
    "species: Reed, cells: 32, lean: (0.2, 0)",
];

fn world(stand: &str) -> World {
    let text = format!(
        "(version: 1, field: (patch_side: 8), stands: [({stand})], camera: (eye: (0, 2, 0), target: (1, 1, 4)),
          interactors: [(shape: Box(size: (2.4, 1, 2.4)), clearance: 0.05, path: Keyframes(keys: [(time: 0.1, at: (-2, 7)), (time: 1.1, at: (2, 2))]))],
          budget: (patches: 9, focus_distance: 10))"
    );
    World::new(Scene::parse(&text, "asked.ron").unwrap(), &NoAssets).unwrap()
}

fn mean(heights: &[f32]) -> f32 {
    heights.iter().sum::<f32>() / heights.len() as f32
}

fn around(at: [f64; 2]) -> Vec<[f64; 2]> {
    (0..49).map(|k| [at[0] - 0.45 + 0.15 * f64::from(k % 7), at[1] - 0.45 + 0.15 * f64::from(k / 7)]).collect()
}

#[test]
fn cover_is_as_high_as_bent_grass_stands() {
    for stand in STANDS {
        let mut world = world(stand);
        let (here, there) = (around([2.0, 2.0]), around([-4.0, -3.0]));
        let upright = [&here, &there].map(|places| mean(&world.cover_heights_at(places)));
        run(&mut world, 90);
        let bent = [&here, &there].map(|places| mean(&world.cover_heights_at(places)));
        assert!(bent[0] < 0.55 * upright[0] && (bent[1] - upright[1]).abs() < 0.02 * upright[1], "{stand}: {upright:?} {bent:?}");
        // As plants stand that are looked at one by one.
        let region = [[1.6, 1.6], [2.4, 2.4]];
        let tops: Vec<f32> = standing(&world, 0, region, 10_000).iter().map(|plant| (plant.points.last().unwrap()[1]) as f32).collect();
        let found = world.plants_in(region, 10_000);
        let heights: Vec<f32> = found.iter().map(|plant| plant.standing.height).collect();
        assert!(!heights.is_empty() && found.iter().all(|plant| plant.standing.height <= plant.length + 1e-4), "{stand}");
        // Of blades it is the first of each plant's, here of four.
        assert!((mean(&tops) - mean(&heights)).abs() < 0.25 * upright[0], "{stand}: {} {}", mean(&tops), mean(&heights));
        let asked: Vec<f32> = around([2.0, 2.0]).iter().map(|place| world.cover_height_at(*place)).collect();
        assert_eq!(asked, world.cover_heights_at(&here), "{stand}: one by one");
        for odd in [[f64::NAN, 0.0], [f64::INFINITY, 1.0], [1e300, -1e300], [-1e9, 1e9]] {
            assert!(world.cover_height_at(odd).is_finite());
        }
        assert!(world.plants_in([[f64::NAN; 2], [1.0; 2]], 9).len() <= 9 && world.plants_in([[-1e9; 2], [1e9; 2]], 5).len() == 5);
    }
}

#[test]
fn cover_follows_growth_lean_and_wind() {
    let mut world = world(STANDS[0]);
    let places = around([-3.0, -3.0]);
    let whole = mean(&world.cover_heights_at(&places));
    world.edit(&Edit { at: [-3.0, -3.0], radius: 2.0, change: Change::Cut(Cut { height: 0.1 }), ..Edit::default() }).unwrap();
    let cut = mean(&world.cover_heights_at(&places));
    assert!((0.07..0.11).contains(&cut) && whole > 0.25, "{whole} {cut}");
    world.edit(&Edit { at: [-3.0, -3.0], radius: 2.0, change: Change::Burn, ..Edit::default() }).unwrap();
    assert_eq!(mean(&world.cover_heights_at(&places)), 0.0);
    assert_eq!(world.plants_in([[-3.5; 2], [-2.5; 2]], 99).len(), 0);
    let wind = |x: f32| WindSource::Uniform(sward::scene::Uniform { velocity: [x, 0.0] });
    let before = mean(&world.cover_heights_at(&around([5.0, 5.0])));
    world.add_wind(wind(15.0), 0.0, &NoAssets).unwrap();
    assert!(mean(&world.cover_heights_at(&around([40.0, 5.0]))) < 0.8 * before, "asleep, it stands as the wind has it");
}

#[test]
fn a_tree_is_cover_and_is_found() {
    let text = "(version: 1, stands: [(species: Lawn), (species: Tree, places: [(at: (4, 6), height: 6)])], camera: (eye: (0, 2, 0), target: (4, 2, 6)))";
    let world = World::new(Scene::parse(text, "tree.ron").unwrap(), &NoAssets).unwrap();
    let [under, beside] = [[4.0, 6.0], [14.0, 6.0]].map(|at| world.cover_height_at(at));
    assert!(under > 5.0 && beside < 0.1, "{under} {beside}");
    let trees: Vec<_> = world.plants_in([[3.0, 5.0], [5.0, 7.0]], 100_000).into_iter().filter(|plant| plant.stand == 1).collect();
    assert_eq!((trees.len(), trees[0].length), (1, 6.0));
}

/// How long a million take is measured by `cargo bench -p sward --bench claims`; here other tests run beside it.
#[test]
fn a_million_places_are_answered() {
    let mut world =
        Text { first: "species: Meadow, cells: 128", second: "species: Tussock, cells: 64, response: Oscillator()", ..USUAL }.world();
    run(&mut world, 30);
    let count = if cfg!(debug_assertions) { 10_000 } else { 1_000_000 };
    let places: Vec<[f64; 2]> = (0..count).map(|k| [f64::from(k % 1000) * 0.012 - 6.0, f64::from(k / 1000) * 0.012 - 6.0]).collect();
    let begin = Instant::now();
    let heights = world.cover_heights_at(&places);
    println!("{count} places in two stands: {:.2} s", begin.elapsed().as_secs_f64());
    assert!(heights.iter().any(|height| *height > 0.2) && heights.iter().all(|height| height.is_finite()));
}
