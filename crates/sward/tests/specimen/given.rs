//! Plants made by others.

use sward::specimen::{Kind, Order, Specimen};

use crate::soups::whole;
use crate::{Test, ready, shared};

pub(crate) const TESTS: &[Test] = &[
    ("given_plants_have_the_triangles_written_down", given_plants_have_the_triangles_written_down),
    ("their_leaves_are_quads_in_crossed_pairs", their_leaves_are_quads_in_crossed_pairs),
];

/// Name, height, triangles of bark and of leaves.
const PLANTS: [(&str, f32, u64, u64); 6] = [
    ("oak_medium", 14.0, 3166, 10640),
    ("aspen_medium", 15.0, 5088, 2112),
    ("pine_medium", 12.0, 10032, 9840),
    ("ash_small", 8.0, 5616, 5456),
    ("bush_1", 1.8, 8880, 4992),
    ("bush_3", 1.2, 13674, 2496),
];

fn read(name: &str) -> Specimen {
    let path = shared().expect("ignored without it").join(format!("{name}.glb"));
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    ready(&bytes, &Order::default()).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn given_plants_have_the_triangles_written_down() {
    for (name, height, bark, leaves) in PLANTS {
        let plant = read(name);
        assert_eq!((plant.count(Kind::Wood), plant.count(Kind::Leaf)), (bark, leaves), "{name}");
        assert!((plant.high[1] - height).abs() < 0.05 * height, "{name}: {} m", plant.high[1]);
        let names: Vec<(&str, bool, f32)> =
            plant.finishes.iter().map(|finish| (finish.name.as_str(), finish.two_sided, finish.cutoff)).collect();
        let cutoff = if name == "pine_medium" { 0.3 } else { 0.5 };
        assert_eq!((names[0], names[1].0), (("leaves", true, cutoff), "bark"), "{name}");
        assert_eq!(plant.finishes.iter().map(|finish| finish.picture).collect::<Vec<_>>(), [Some(0), Some(1)]);
        assert!(plant.pictures[0].size == [512, 512] && plant.pictures[0].texels.iter().any(|texel| texel[3] == 0), "{name}");
    }
}

/// Two triangles a leaf, four corners in a plane, their root one of them; and every second leaf stands across the one before it.
fn their_leaves_are_quads_in_crossed_pairs() {
    for (name, _, _, triangles) in PLANTS {
        let plant = read(name);
        assert_eq!(u64::from(plant.leaves), triangles / 2, "{name}");
        assert!(whole(&plant));
        let leaves = &plant.triangles[..triangles as usize];
        let centre = |pair: &[[u32; 3]]| {
            let corners: std::collections::BTreeSet<u32> = pair.iter().flatten().copied().collect();
            assert_eq!(corners.len(), 4, "{name}: a quad");
            let root = plant.vertices[pair[0][0] as usize].root;
            assert!(corners.iter().any(|corner| plant.vertices[*corner as usize].position == root), "{name}");
            let places = corners.iter().map(|corner| glam::Vec3::from(plant.vertices[*corner as usize].position));
            places.sum::<glam::Vec3>() / 4.0
        };
        let across = |pair: &[[u32; 3]]| {
            let [a, b, c] = pair[0].map(|corner| glam::Vec3::from(plant.vertices[corner as usize].position));
            (b - a).cross(c - a).normalize_or_zero()
        };
        let crossed = leaves.chunks_exact(4).filter(|two| {
            let (first, second) = two.split_at(2);
            centre(first).distance(centre(second)) < 0.02 * plant.high[1] && across(first).dot(across(second)).abs() < 0.1
        });
        let (crossed, all) = (crossed.count(), leaves.len() / 4);
        println!("{name}: {crossed} of {all} pairs are crossed");
        assert!(crossed * 100 >= all * 99, "{name}");
        let shifted = leaves[2..].chunks_exact(4).filter(|two| centre(&two[..2]).distance(centre(&two[2..])) < 1e-4 * plant.high[1]);
        assert!(shifted.count() * 10 < all, "{name}: control, other pairs are not");
    }
}
