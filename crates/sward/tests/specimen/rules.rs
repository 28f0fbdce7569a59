//! Leaf or wood, and what materials say besides.

use std::io::Cursor;

use serde_json::{Value, json};
use sward::specimen::{Kind, Order, Rule, Specimen, SpecimenError};

use crate::glb::{Glb, block};
use crate::{Test, ready};

pub(crate) const TESTS: &[Test] = &[
    ("names_and_holes_tell_leaves_from_wood", names_and_holes_tell_leaves_from_wood),
    ("a_scene_has_the_last_word", a_scene_has_the_last_word),
    ("names_that_are_not_there_are_refused", names_that_are_not_there_are_refused),
    ("materials_become_finishes", materials_become_finishes),
    ("leaves_come_first", leaves_come_first),
];

/// A box of each material, side by side.
pub(crate) fn boxes(materials: &[Value]) -> Glb {
    let mut glb = Glb::new();
    for (number, material) in materials.iter().enumerate() {
        let (positions, triangles) = block([number as f32, 0.0, 0.0], [number as f32 + 0.5, 1.0, 0.5]);
        let mesh = glb.mesh(&positions, &triangles, json!({}));
        glb.push("materials", material.clone());
        glb.json["meshes"][mesh]["primitives"][0]["material"] = json!(number);
        glb.top(json!({"mesh": mesh}));
    }
    glb
}

/// The file's materials in order, and what each became.
fn kinds(materials: &[Value], rule: Rule) -> Result<Vec<(String, Kind)>, SpecimenError> {
    let plant = ready(&boxes(materials).bytes(), &Order { rule, ..Order::default() })?;
    let mut kinds: Vec<_> = plant
        .parts
        .iter()
        .map(|part| {
            let left = plant.vertices[plant.triangles[part.triangles.start as usize][0] as usize].position[0] as u32;
            let finish = &plant.finishes[part.finish];
            (left, (finish.name.clone(), finish.kind))
        })
        .collect();
    kinds.sort_by_key(|(left, _)| *left);
    Ok(kinds.into_iter().map(|(_, kind)| kind).collect())
}

fn leafy(materials: &[Value], rule: Rule) -> Vec<bool> {
    kinds(materials, rule).expect("a plant").iter().map(|(_, kind)| *kind == Kind::Leaf).collect()
}

fn named(name: &str) -> Value {
    json!({"name": name})
}

fn names_and_holes_tell_leaves_from_wood() {
    let plain = Rule::default;
    assert_eq!(leafy(&[named("OakBark"), named("oak_leaves")], plain()), [false, true]);
    assert_eq!(
        leafy(&[named("a"), json!({"name": "b", "alphaMode": "MASK"})], plain()),
        [false, true],
        "holes are leaves, the rest is wood"
    );
    assert_eq!(leafy(&[named("a"), json!({"name": "b", "alphaMode": "BLEND"})], plain()), [false, true]);
    assert_eq!(leafy(&[json!({"name": "bark", "alphaMode": "MASK"}), named("b")], plain()), [false, true], "names before holes");
    assert_eq!(leafy(&[named("a"), named("b")], plain()), [true, true], "nothing is known: all leaf");
    assert_eq!(leafy(&[named("bark"), named("b")], plain()), [false, true], "beside wood alone the unknown is leaf");
    assert_eq!(leafy(&[named("bark"), named("needles"), named("cone")], plain()), [false, true, false]);
}

fn rule(leaves: &[&str], wood: &[&str]) -> Rule {
    let list = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    Rule { leaves: list(leaves), wood: list(wood) }
}

fn a_scene_has_the_last_word() {
    let materials = [named("bark"), named("leaves"), named("moss")];
    assert_eq!(leafy(&materials, rule(&["bark"], &["leaves"])), [true, false, true]);
    assert_eq!(leafy(&materials, rule(&[], &["moss"])), [false, true, false]);
    assert_eq!(leafy(&materials, Rule::default()), [false, true, true], "control");
}

fn names_that_are_not_there_are_refused() {
    let refused = |rule: Rule, materials: &[Value]| kinds(materials, rule).expect_err("refused").to_string();
    let materials = [named("Bark.001"), named("Leaf.001")];
    assert_eq!(refused(rule(&["Leaf"], &[]), &materials), "no material is called `Leaf`; known: Bark.001, Leaf.001");
    assert!(refused(rule(&[], &["bark.001"]), &materials).contains("`bark.001`"));
    assert!(refused(rule(&["Leaf.001"], &["Leaf.001"]), &materials).contains("both"));
    assert!(refused(rule(&["x"], &[]), &[json!({})]).contains("the file names none"));
    assert!(kinds(&materials, rule(&["Leaf.001"], &["Bark.001"])).is_ok(), "control");
}

fn png(size: [u32; 2], texels: &[[u8; 4]]) -> Vec<u8> {
    let image = image::RgbaImage::from_raw(size[0], size[1], texels.as_flattened().to_vec()).expect("as many as said");
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).expect("in memory");
    bytes.into_inner()
}

fn painted() -> Specimen {
    let factor = json!([0.5, 0.25, 1.0, 0.8]);
    let texture = |index: usize, more: Value| json!({"baseColorFactor": more, "baseColorTexture": {"index": index}});
    let mut glb = boxes(&[
        json!({"name": "bark", "pbrMetallicRoughness": texture(0, json!([1, 1, 1, 1]))}),
        json!({"name": "leaf a", "alphaMode": "MASK", "doubleSided": true, "pbrMetallicRoughness": texture(1, factor)}),
        json!({"name": "leaf b", "alphaMode": "MASK", "alphaCutoff": 0.25, "pbrMetallicRoughness": texture(1, json!([1, 1, 1, 1]))}),
        json!({"name": "leaf c"}),
    ]);
    for bytes in [png([1, 1], &[[9, 8, 7, 255]]), png([2, 1], &[[10, 200, 30, 255], [40, 90, 60, 0]])] {
        let view = glb.view(&bytes);
        let image = glb.push("images", json!({"bufferView": view}));
        glb.push("textures", json!({"source": image}));
    }
    ready(&glb.bytes(), &Order::default()).expect("a plant")
}

fn materials_become_finishes() {
    let plant = painted();
    let names: Vec<&str> = plant.finishes.iter().map(|finish| finish.name.as_str()).collect();
    assert_eq!(names, ["leaf a", "leaf b", "leaf c", "bark"]);
    let [a, b, c, bark] = &plant.finishes[..] else { panic!("four finishes") };
    assert_eq!((a.colour, a.cutoff, a.two_sided), ([0.5, 0.25, 1.0], 0.625, true), "the factor's alpha is in the cutoff");
    assert_eq!((b.cutoff, b.two_sided, c.cutoff, bark.cutoff), (0.25, false, 0.0, 0.0));
    assert_eq!((a.picture, b.picture, c.picture, bark.picture), (Some(0), Some(0), None, Some(1)), "each picture once");
    assert_eq!((plant.pictures[0].size, plant.pictures[1].size), ([2, 1], [1, 1]));
    assert_eq!(plant.pictures[0].texels, [[10, 200, 30, 255], [40, 90, 60, 0]], "transparent texels keep their colour");
}

fn leaves_come_first() {
    let plant = painted();
    let kinds: Vec<Kind> = plant.parts.iter().map(|part| plant.finishes[part.finish].kind).collect();
    assert!(kinds.is_sorted());
    assert!(plant.parts.windows(2).all(|pair| pair[0].triangles.end == pair[1].triangles.start));
    assert_eq!((plant.leaves, plant.count(Kind::Leaf), plant.count(Kind::Wood)), (3, 36, 12));
    let wood = plant.parts.last().expect("parts").triangles.clone();
    for corner in plant.triangles[wood.start as usize..].iter().flatten() {
        let vertex = plant.vertices[*corner as usize];
        assert_eq!(vertex.root, vertex.position, "wood is its own root");
    }
}
