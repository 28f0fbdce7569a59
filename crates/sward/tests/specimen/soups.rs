//! Leaves and roots of small meshes, against a search that is written down as the paper says it.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::json;
use sward::math::{mixed, unit};
use sward::specimen::{Kind, Order, Size, Specimen};

use crate::glb::Glb;
use crate::{Test, ready};

pub(crate) const TESTS: &[Test] = &[
    ("leaves_are_what_a_breadth_first_search_finds", leaves_are_what_a_breadth_first_search_finds),
    ("a_leaf_has_one_root", a_leaf_has_one_root),
    ("minus_zero_is_zero", minus_zero_is_zero),
    ("roots_have_the_smallest_u_plus_v", roots_have_the_smallest_u_plus_v),
    ("nodes_place_turn_and_mirror", nodes_place_turn_and_mirror),
    ("heights_and_scales", heights_and_scales),
    ("missing_normals_are_computed", missing_normals_are_computed),
    ("the_inside_is_darker", the_inside_is_darker),
    ("progress_is_told_in_small_steps", progress_is_told_in_small_steps),
];

/// Triangles between few places, so that many share some.
struct Soup {
    positions: Vec<[f32; 3]>,
    uvs: Option<Vec<[f32; 2]>>,
    triangles: Vec<[u16; 3]>,
}

fn random(seed: u32, textured: bool) -> Soup {
    let number = |k: u32| mixed(mixed(seed.wrapping_mul(7919)) ^ mixed(k));
    let count = 40 + number(0) % 80;
    // Some places are taken several times, with other signs of zero.
    let place = |k: u32| {
        [1, 2, 3].map(|axis| ((number(1000 * axis + k) % 5) as f32 - 2.0) * if number(axis + 5 * k) % 2 == 0 { 1.0 } else { -1.0 })
    };
    let corner = |k: u32| (number(50_000 + k) % count) as u16;
    Soup {
        positions: (0..count).map(place).collect(),
        uvs: textured.then(|| (0..count).map(|k| [unit(number(90_000 + k)), unit(number(91_000 + k))]).collect()),
        triangles: (0..count / 5).map(|k| [corner(3 * k), corner(3 * k + 1), corner(3 * k + 2)]).collect(),
    }
}

fn file(soup: &Soup) -> Vec<u8> {
    let mut glb = Glb::new();
    let attributes = match &soup.uvs {
        Some(uvs) => json!({"TEXCOORD_0": glb.floats(uvs.as_flattened(), "VEC2")}),
        None => json!({}),
    };
    let mesh = glb.mesh(&soup.positions, &soup.triangles, attributes);
    glb.top(json!({"mesh": mesh}));
    glb.bytes()
}

fn plant(soup: &Soup) -> Specimen {
    ready(&file(soup), &Order::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Of each used vertex, the vertex that is its leaf's root, as §3.2 says: breadth first over neighbours. `welded`: places are compared too.
fn searched(soup: &Soup, welded: bool) -> BTreeMap<u16, u16> {
    let used: BTreeSet<u16> = soup.triangles.iter().flatten().copied().collect();
    let position = |vertex: u16| soup.positions[usize::from(vertex)];
    let sum = |vertex: u16| soup.uvs.as_ref().map_or(0.0, |uvs| uvs[usize::from(vertex)][0] + uvs[usize::from(vertex)][1]);
    let mut roots = BTreeMap::new();
    for &start in &used {
        if roots.contains_key(&start) {
            continue;
        }
        let (mut found, mut open) = (BTreeSet::from([start]), vec![start]);
        while !open.is_empty() {
            let mut next = Vec::new();
            for vertex in open {
                let beside = soup.triangles.iter().filter(|t| t.contains(&vertex)).flatten().copied();
                let there = used.iter().copied().filter(|other| welded && position(*other) == position(vertex));
                next.extend(beside.chain(there).filter(|other| found.insert(*other)));
            }
            open = next;
        }
        let root = found.iter().copied().reduce(|best, other| if sum(other) < sum(best) { other } else { best }).expect("it has a start");
        roots.extend(found.into_iter().map(|vertex| (vertex, root)));
    }
    roots
}

/// Whether a plant has the roots that a search found.
fn agrees(plant: &Specimen, soup: &Soup, roots: &BTreeMap<u16, u16>) -> bool {
    // Used vertices keep their order.
    let vertices = plant.vertices.iter().zip(roots);
    let count = roots.values().collect::<BTreeSet<_>>().len();
    plant.leaves as usize == count && vertices.into_iter().all(|(vertex, (_, root))| vertex.root == soup.positions[usize::from(*root)])
}

fn leaves_are_what_a_breadth_first_search_finds() {
    let (mut several, mut caught) = (0, 0);
    for seed in 0..300 {
        let soup = random(seed, seed % 2 == 0);
        let plant = plant(&soup);
        let roots = searched(&soup, true);
        assert_eq!(plant.vertices.len(), roots.len(), "vertices that no triangle uses are not kept");
        assert!(agrees(&plant, &soup, &roots), "seed {seed}");
        several += u32::from(plant.leaves > 2);
        caught += u32::from(!agrees(&plant, &soup, &searched(&soup, false)));
    }
    println!("{several} of 300 soups have more than two leaves; {caught} would differ if nothing were welded");
    assert!(several > 50 && caught > 50, "control");
}

/// Whether all corners of every leaf triangle have the same root.
pub(crate) fn whole(plant: &Specimen) -> bool {
    let leaf = plant.parts.iter().filter(|part| plant.finishes[part.finish].kind == Kind::Leaf);
    leaf.flat_map(|part| &plant.triangles[part.triangles.start as usize..part.triangles.end as usize]).all(|[a, b, c]| {
        let root = |corner: &u32| plant.vertices[*corner as usize].root;
        root(a) == root(b) && root(b) == root(c)
    })
}

fn a_leaf_has_one_root() {
    let mut plant = plant(&random(4, true));
    assert!(whole(&plant));
    let corner = plant.triangles[0][1] as usize;
    plant.vertices[corner].root[1] += 1.0;
    assert!(!whole(&plant), "control");
}

fn minus_zero_is_zero() {
    let two = |x: f32| Soup {
        positions: vec![[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [x, -0.0, 1.0], [-1.0, 0.0, 0.0], [-1.0, 1.0, 0.0]],
        uvs: None,
        triangles: vec![[0, 1, 2], [3, 4, 5]],
    };
    assert_eq!(plant(&two(-0.0)).leaves, 1);
    assert_eq!(plant(&two(f32::from_bits(1))).leaves, 2, "control: the smallest number is another place");
}

fn roots_have_the_smallest_u_plus_v() {
    let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let triangles = vec![[0, 1, 2], [0, 2, 3]];
    let roots = |uvs: Option<Vec<[f32; 2]>>| {
        let plant = plant(&Soup { positions: positions.clone(), uvs, triangles: triangles.clone() });
        assert!(plant.leaves == 1 && plant.vertices.iter().all(|vertex| vertex.root == plant.vertices[0].root));
        plant.vertices[0].root
    };
    assert_eq!(roots(None), positions[0]);
    assert_eq!(roots(Some(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]])), positions[3]);
    assert_eq!(roots(Some(vec![[1.0, 1.0], [0.5, 0.5], [0.0, 1.0], [1.0, 0.0]])), positions[1], "of equals the first");
    // Finer than half precision, in which they are stored.
    assert_eq!(roots(Some(vec![[0.5, 0.500001], [0.9, 0.9], [0.5, 0.5], [0.9, 0.9]])), positions[2]);
}

fn nodes_place_turn_and_mirror() {
    let soup = random(8, true);
    let mut glb = Glb::new();
    let normals: Vec<f32> = (0..soup.positions.len()).flat_map(|_| [0.0, 0.6, 0.8]).collect();
    let normals = glb.floats(&normals, "VEC3");
    let mesh = glb.mesh(&soup.positions, &soup.triangles, json!({"NORMAL": normals}));
    glb.top(json!({"mesh": mesh, "translation": [0.0, 10.0, 0.0], "scale": [-1.0, 2.0, 1.0]}));
    let moved = ready(&glb.bytes(), &Order::default()).expect("a plant");
    let plain = plant(&Soup { uvs: None, ..soup });
    for (moved, plain) in moved.vertices.iter().zip(&plain.vertices) {
        let [x, y, z] = plain.position;
        assert_eq!(moved.position, [-x + 0.0, 2.0 * y + 10.0, z]);
        let [_, y, z] = moved.normal();
        assert!((y - 0.351).abs() < 0.01 && (z - 0.936).abs() < 0.01, "{y} {z}: half as steep");
    }
    let turned = |[a, b, c]: [u32; 3]| [a, c, b];
    assert_eq!(moved.triangles, plain.triangles.iter().copied().map(turned).collect::<Vec<_>>(), "mirrored, they must turn round");
    assert_eq!(moved.leaves, plain.leaves);
}

fn heights_and_scales() {
    let bytes = file(&random(3, false));
    let as_is = ready(&bytes, &Order::default()).expect("a plant");
    for (size, factor) in [(Size::Scale(0.25), 0.25), (Size::Height(3.0), 3.0 / as_is.high[1])] {
        let plant = ready(&bytes, &Order { size, ..Order::default() }).expect("a plant");
        assert_eq!(plant.leaves, as_is.leaves);
        for (own, other) in plant.vertices.iter().zip(&as_is.vertices) {
            assert_eq!((own.position, own.root), (other.position.map(|part| part * factor), other.root.map(|part| part * factor)));
        }
        assert_eq!(plant.high, as_is.high.map(|part| part * factor));
    }
    let refused = |size| ready(&bytes, &Order { size, ..Order::default() }).map_or_else(|error| error.to_string(), |_| "ready".to_owned());
    assert!(
        refused(Size::Scale(1000.0)).contains("4000.000 m across, allowed 0.01 to 200 m; type scale: 5.000e-1"),
        "{}",
        refused(Size::Scale(1000.0))
    );
    assert!(refused(Size::Scale(f32::NAN)).contains("allowed"));
    assert_eq!(refused(Size::Scale(10.0)), "ready", "control");
    let mut below = random(3, false);
    below.positions.iter_mut().for_each(|position| position[1] -= 9.0);
    let below = ready(&file(&below), &Order { size: Size::Height(1.0), ..Order::default() });
    assert!(below.expect_err("nothing is above").to_string().contains("above its root"));
}

fn missing_normals_are_computed() {
    let flat = Soup {
        positions: vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]],
        uvs: None,
        triangles: vec![[0, 1, 2], [0, 3, 1]],
    };
    let normals: Vec<[f32; 3]> = plant(&flat).vertices.iter().map(|vertex| vertex.normal()).collect();
    assert!(normals[2][1] > 0.99 && normals[3][0].abs() > 0.99, "{normals:?}");
    assert!(normals[0][1] > 0.6 && normals[0][1] < 0.8, "an edge's is in between: {normals:?}");
}

/// A block full of small triangles: its middle sees little of the sky, its top most.
fn the_inside_is_darker() {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for k in 0..12_000_u32 {
        let number = |n: u32| unit(mixed(mixed(k) ^ n)) - 0.5;
        let middle = [number(1), number(2), number(3)];
        let first = positions.len() as u16;
        for n in [10, 20, 30] {
            positions.push([0, 1, 2].map(|axis| middle[axis as usize] + 0.05 * number(n + axis)));
        }
        triangles.push([first, first + 1, first + 2]);
    }
    let plant = plant(&Soup { positions, uvs: None, triangles });
    let mean = |within: fn([f32; 3]) -> bool| {
        let shades: Vec<f32> = plant.vertices.iter().filter(|vertex| within(vertex.position)).map(|vertex| vertex.shade()).collect();
        assert!(shades.len() > 50);
        shades.iter().sum::<f32>() / shades.len() as f32
    };
    let (inside, top) = (mean(|p| p.iter().all(|part| part.abs() < 0.15)), mean(|p| p[1] > 0.47));
    let below = mean(|p| p[1] < -0.47);
    println!("shade: {inside:.2} inside, {top:.2} on top, {below:.2} below");
    assert!(inside + 0.2 < below && below + 0.1 < top && top < 1.0);
    let alone = Soup { positions: vec![[0.0, 0.0, 0.0], [0.001, 0.0, 1.0], [0.0, 0.0, 1.0]], uvs: None, triangles: vec![[0, 1, 2]] };
    assert!(self::plant(&alone).vertices.iter().all(|vertex| vertex.shade() > 0.9), "control: nothing shades a single blade");
}

fn progress_is_told_in_small_steps() {
    let mut shares = Vec::new();
    let soup = random(1, true);
    Specimen::read(&file(&soup), &|_| Err(String::new()), &Order::default(), &mut |share| shares.push(share)).expect("a plant");
    assert_eq!((shares[0], shares[shares.len() - 1]), (0.0, 1.0));
    assert!(shares.windows(2).all(|pair| pair[0] < pair[1] && pair[1] - pair[0] <= 0.0101), "{shares:?}");
    assert!(shares.len() >= 100);
}
