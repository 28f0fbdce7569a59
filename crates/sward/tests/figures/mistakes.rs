//! Files that cannot be bodies: words, not panics.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use serde_json::{Value, json};
use sward::figure::Figure;
use sward::scene::Scene;
use sward::world::World;

use crate::Test;
use crate::glb::{Glb, block, bytes_of, pack, post, table, walker};
use crate::moving::One;

pub(crate) const TESTS: &[Test] = &[
    ("broken_files_are_explained", broken_files_are_explained),
    ("broken_containers_are_explained", broken_containers_are_explained),
    ("scenes_name_the_file_and_the_way_out", scenes_name_the_file_and_the_way_out),
    ("sparse_accessors_replace_elements", sparse_accessors_replace_elements),
    ("small_files_cannot_ask_for_all_memory", small_files_cannot_ask_for_all_memory),
    ("textures_that_cannot_be_decoded_are_named", textures_that_cannot_be_decoded_are_named),
    ("mutated_files_never_panic", mutated_files_never_panic),
    ("mutated_words_never_panic", mutated_words_never_panic),
];

fn message(bytes: &[u8]) -> String {
    let read = Figure::read(bytes, &|name| Err(format!("{name} is missing")), 2);
    read.map_or_else(|error| error.to_string(), |figure| format!("read: {} parts", figure.parts.len()))
}

/// A change to the JSON of [`walker`] or [`post`], and what the error must say.
type Mistake = (fn(&mut Value), &'static str);

const MISTAKES: &[Mistake] = &[
    (|json| json["asset"]["version"] = json!("1.0"), "`asset.version` is 1.0"),
    (|json| json["asset"] = json!({}), "no version"),
    (
        |json| json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]),
        "`KHR_draco_mesh_compression`, which sward does not read; export it without compression (Blender",
    ),
    (|json| json["scenes"][0]["nodes"] = json!([]), "there are no triangles"),
    (|json| json["meshes"][0]["primitives"][0]["mode"] = json!(1), "read: 1 parts"),
    (|json| json["scenes"][0]["nodes"] = json!([99]), "scenes points to nodes[99], but there are 3"),
    (|json| json["nodes"][0]["children"] = json!([0]), "nodes[0] is its own ancestor"),
    (|json| (json["nodes"][0]["children"], json["nodes"][1]["children"]) = (json!([1]), json!([0])), "is its own ancestor"),
    (
        |json| (json["nodes"][0]["children"], json["nodes"][1]["children"]) = (json!([2]), json!([2])),
        "is a child of nodes[0] and of nodes[1]",
    ),
    (|json| json["nodes"][0]["mesh"] = json!(7), "nodes[0] points to meshes[7]"),
    (|json| json["nodes"][0]["mesh"] = json!(-1), "JSON"),
    (|json| json["nodes"][0]["scale"] = json!([1e300, 1, 1]), "nodes[0] stands at numbers beyond"),
    (|json| json["nodes"][0]["matrix"] = json!([1, 2, 3]), "JSON"),
    (|json| json["accessors"][0]["count"] = json!(4_000_000_000_u64), "accessors[0] has 4000000000 elements"),
    (|json| json["accessors"][0]["count"] = json!(9), "reach beyond its bufferView"),
    (|json| json["accessors"][0]["byteOffset"] = json!(u64::MAX), "reach beyond its bufferView"),
    (|json| json["accessors"][0]["componentType"] = json!(5), "has component type 5"),
    (|json| json["accessors"][0]["type"] = json!("VEC9"), "is of type `VEC9`"),
    (|json| json["accessors"][0]["sparse"] = json!({"count": 1}), "accessors[0].sparse.indices has component type 0"),
    (
        |json| {
            json["accessors"][0]["sparse"] =
                json!({"count": 1, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}})
        },
        "accessors[0].sparse.indices has an index",
    ),
    (|json| json["extensionsRequired"] = json!(["EXT_meshopt_compression"]), "gltfpack: leave out -c"),
    (|json| json["accessors"][1]["componentType"] = json!(5122), "indices are needed"),
    (|json| json["bufferViews"][0]["byteLength"] = json!(1_u64 << 60), "bufferViews[0] reaches beyond"),
    (|json| json["bufferViews"][0]["byteStride"] = json!(1), "reach beyond its bufferView"),
    (|json| json["bufferViews"][0]["buffer"] = json!(3), "points to buffers[3]"),
    (|json| json["animations"][0]["samplers"][0]["interpolation"] = json!("WAVY"), "has interpolation `WAVY`"),
    (|json| json["animations"][0]["channels"][0]["sampler"] = json!(9), "points to samplers[9]"),
    (|json| json["animations"][0]["samplers"][0]["input"] = json!(0), "is of type `VEC3`"),
    (|json| json["animations"][0]["samplers"][0]["interpolation"] = json!("CUBICSPLINE"), "4 keys and 4 values"),
];

fn broken_files_are_explained() {
    let mut wrong = Vec::new();
    for (change, words) in MISTAKES {
        let mut glb = walker();
        change(&mut glb.json);
        let found = message(&glb.bytes());
        if !found.contains(words) {
            wrong.push(format!("wanted {words:?}: {found}"));
        }
    }
    let mut skin = post();
    skin.json["skins"][0]["joints"] = json!([1]);
    wrong.extend(Some(message(&skin.bytes())).filter(|found| !found.contains("follows joint 1, but its skin has 1")));
    let mut numbers = walker();
    numbers.binary[..4].copy_from_slice(&bytes_of(&[f32::NAN]));
    wrong.extend(Some(message(&numbers.bytes())).filter(|found| !found.contains("POSITION) has NaN in element 0")));
    numbers.binary[..4].copy_from_slice(&bytes_of(&[1e20]));
    wrong.extend(Some(message(&numbers.bytes())).filter(|found| !found.contains("beyond ±1e7")));
    // Indices follow the 96 bytes of eight corners.
    numbers = walker();
    numbers.binary[96..98].copy_from_slice(&[200, 0]);
    wrong.extend(Some(message(&numbers.bytes())).filter(|found| !found.contains("has an index 200, but 8 vertices")));
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(message(&walker().bytes()), "read: 3 parts", "control");
}

fn broken_containers_are_explained() {
    let whole = table().bytes();
    let changed = |at: usize, value: u32| {
        let mut bytes = whole.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        message(&bytes)
    };
    for (found, words) in [
        (message(b""), "begins with \"\""),
        (message(b"\x89PNG....."), "begins with \"ufffdPNG\""),
        (message(b"glTF"), "ends within its header"),
        (message(&whole[..40]), "announces"),
        (message(&whole[..whole.len() - 1]), "copy or export it again"),
        (changed(4, 1), "version 1 of the binary format"),
        (changed(8, u32::MAX), "announces 4294967295 bytes"),
        (changed(12, u32::MAX), "a chunk announces 4294967295 bytes"),
        (changed(16, 7), "no JSON chunk"),
        (message(&pack(b"{", &[])), "JSON"),
        (message(b"{\"asset\": {\"version\": \"2.0\"}}"), "no triangles"),
        (message(b"{\"asset\": {\"version\": \"2.0\"}, \"buffers\": [{\"byteLength\": 4, \"uri\": \"a.bin\"}]}"), "a.bin is missing"),
    ] {
        assert!(found.contains(words) || words.contains("ufffd") && found.contains("PNG"), "wanted {words:?}: {found}");
    }
    let (positions, triangles) = block([0.0; 3], [1.0; 3]);
    let mut many = Glb::new();
    let mesh = many.mesh(&positions, &triangles, json!({}));
    (0..600).for_each(|_| _ = many.top(json!({"mesh": mesh})));
    assert!(
        message(&many.bytes()).contains("joints and nodes with a mesh, at most 512 are read; join objects"),
        "{}",
        message(&many.bytes())
    );
    let indices = many.accessor(&vec![0; 3 * 1_000_001], 5121, "SCALAR", 3 * 1_000_001);
    many.json["meshes"][mesh]["primitives"][0]["indices"] = json!(indices);
    assert!(message(&many.bytes()).contains("at most 3000000 are read"), "{}", message(&many.bytes()));
    let indices = many.accessor(&vec![0; 3 * 600_000], 5121, "SCALAR", 3 * 600_000);
    many.json["meshes"][mesh]["primitives"][0]["indices"] = json!(indices);
    assert!(message(&many.bytes()).contains("1200000 triangles, at most 1000000 are read; simplify"), "{}", message(&many.bytes()));
}

fn scenes_name_the_file_and_the_way_out() {
    let refused = |shape: &str| {
        let text = format!("(version: 1, interactors: [(shape: Mesh({shape}))])");
        let scene = match Scene::parse(&text, "test.ron") {
            Ok(scene) => scene,
            Err(error) => return error.to_string(),
        };
        World::new(scene, &One("walker.glb", walker().bytes())).map_or_else(|error| error.to_string(), |_| "read".to_owned())
    };
    for (shape, words) in [
        ("file: \"walker.glb\"", "read"),
        ("file: \"\"", "`file` is empty"),
        ("", "`file` is missing in `Mesh`"),
        ("file: \"gone.glb\"", "gone.glb: cannot be read: gone.glb is missing"),
        ("file: \"walker.glb\", clip: \"Wlak\"", "walker.glb: no clip is called `Wlak`; did you mean `Walk`? known: Walk"),
        ("file: \"walker.glb\", clip: \"walk\"", "did you mean `Walk`?"),
        ("file: \"walker.glb\", clip: \"Swim\"", "no clip is called `Swim`; known: Walk"),
        ("file: \"walker.glb\", scale: 0.001", "allowed 0.01 to 200 m; type scale:"),
        ("file: \"walker.glb\", scale: 1000", "1000.000 m across"),
        ("file: \"walker.glb\", pieces: 0", "`pieces` is 0, allowed 1 to 64"),
        ("file: \"walker.glb\", scale: 0", "`scale` is 0"),
    ] {
        let found = refused(shape);
        assert!(found.contains(words), "{shape}\n  wanted {words}\n  found {found}");
    }
}

/// The same box, once plain, once as zeros with all corners replaced, once with one corner put right.
fn sparse_accessors_replace_elements() {
    let (positions, triangles) = block([1.0, 0.0, -2.0], [2.0, 3.0, 4.0]);
    let made = |replaced: &[u16], spoil: bool, view: bool| {
        let mut given = positions.clone();
        if spoil {
            replaced.iter().for_each(|corner| given[usize::from(*corner)] = [9.0; 3]);
        }
        let mut glb = Glb::new();
        let mesh = glb.mesh(&given, &triangles, json!({}));
        glb.top(json!({"mesh": mesh}));
        if !replaced.is_empty() {
            let indices = glb.view(&replaced.iter().flat_map(|index| index.to_le_bytes()).collect::<Vec<u8>>());
            let values =
                glb.view(&bytes_of(replaced.iter().map(|corner| positions[usize::from(*corner)]).collect::<Vec<_>>().as_flattened()));
            glb.json["accessors"][0]["sparse"] = json!({"count": replaced.len(), "indices": {"bufferView": indices, "componentType": 5123}, "values": {"bufferView": values}});
        }
        if !view {
            glb.json["accessors"][0].as_object_mut().expect("an object").remove("bufferView");
        }
        Figure::read(&glb.bytes(), &|_| Err(String::new()), 2).map(|figure| figure.vertices)
    };
    let plain = made(&[], false, true).expect("control");
    assert_eq!(made(&[5], true, true).expect("one is put right"), plain);
    assert_eq!(made(&[0, 1, 2, 3, 4, 5, 6, 7], false, false).expect("all are given"), plain);
    assert_ne!(made(&[0, 1, 2], false, false).expect("zeros elsewhere"), plain, "control");
    assert!(made(&[], false, false).is_err(), "without a view and replacements there is nothing");
}

/// Shared vertices and textures count as often as they are used, by what their headers say.
fn small_files_cannot_ask_for_all_memory() {
    let mut glb = table();
    let count = 1_600_000;
    glb.json["accessors"][0] = json!({"componentType": 5126, "type": "VEC3", "count": count, "sparse":
        {"count": 0, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}}});
    let normals = glb.push("accessors", glb.json["accessors"][0].clone());
    let primitive = &mut glb.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["NORMAL"] = json!(normals);
    let primitive = primitive.clone();
    assert_eq!(message(&glb.bytes()), "read: 1 parts", "control: one is allowed");
    glb.json["meshes"][0]["primitives"] = json!(vec![primitive; 1000]);
    assert!(message(&glb.bytes()).contains("3200000 vertices, at most 3000000 are read; simplify"), "{}", message(&glb.bytes()));
    let mut painted = table();
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x20\0\0\0\x20\0\x08\x02\0\0\0\xfd\xc8\x5d\x0e\0\0\0\0IDAT\x35\xaf\x06\x1e".to_vec();
    png.extend([0; 8]);
    let view = painted.view(&png);
    for number in 0..3 {
        let image = painted.push("images", json!({"bufferView": view}));
        let texture = painted.push("textures", json!({"source": image}));
        painted.push("materials", json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": texture}}}));
        let found = message(&painted.bytes());
        assert_eq!(found.contains("pixels in its textures, at most 134217728 are read; export smaller"), number == 2, "{found}");
    }
}

/// A body is not painted plain because its texture is damaged: the file is refused, as every damaged picture.
fn textures_that_cannot_be_decoded_are_named() {
    let picture = |width: u32, format: image::ImageFormat| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        image::RgbImage::new(width, 1).write_to(&mut bytes, format).expect("in memory");
        bytes.into_inner()
    };
    let painted = |bytes: &[u8]| {
        let mut body = table();
        let view = body.view(bytes);
        body.push("images", json!({"bufferView": view, "name": "wood"}));
        body.push("textures", json!({"source": 0}));
        body.push("materials", json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}));
        message(&body.bytes())
    };
    let png = picture(4, image::ImageFormat::Png);
    for (bytes, words) in [
        (png[..png.len() - 20].to_vec(), "cannot be decoded"),
        (picture(8193, image::ImageFormat::Png), "is 8193 x 1 pixels"),
        (b"RIFF\0\0\0\0WEBP".to_vec(), "is neither a PNG nor a JPEG"),
    ] {
        let found = painted(&bytes);
        assert!(found.starts_with("the texture images[0] \"wood\" ") && found.contains(words), "{found}");
        assert!(found.ends_with("; export it with PNG or JPEG textures of at most 8192 x 8192 pixels"), "{found}");
    }
    for bytes in [png, picture(4, image::ImageFormat::Jpeg), picture(8192, image::ImageFormat::Png)] {
        assert_eq!(painted(&bytes), "read: 2 parts", "control");
    }
}

fn files() -> Vec<Vec<u8>> {
    vec![walker().bytes(), post().bytes(), table().bytes()]
}

/// Reads, and if that works plays: nothing may panic, and all that comes out is in bounds.
fn used(bytes: &[u8]) -> bool {
    let Ok(figure) = Figure::read(bytes, &|_| Err("nothing is beside it".to_owned()), 3) else { return false };
    for time in [0.0, 0.3, 1e5] {
        let clip = (!figure.clips.is_empty()).then_some(0);
        let frames = figure.pose(clip, time);
        for posed in figure.parts.iter().filter_map(|part| part.posed(&frames[part.frame as usize])) {
            assert!(posed.under.iter().chain(&posed.gradient).all(|part| part.is_finite()), "{posed:?}");
        }
    }
    let text = "(version: 1, stands: [(species: Lawn, cells: 64)], interactors: [(shape: Mesh(file: \"walker.glb\", pieces: 3))])";
    if let Ok(mut world) = World::new(Scene::parse(text, "test.ron").expect("a scene"), &One("walker.glb", bytes.to_vec())) {
        world.step();
    }
    true
}

fn mutated_files_never_panic() {
    let strategy = (0..3_usize, prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6));
    let (files, mut read, mut refused) = (files(), 0, 0);
    assert!(files.iter().all(|file| used(file)), "control: unharmed files are read");
    for _ in 0..1 {
        let mut runner = TestRunner::new(Config { cases: 400, failure_persistence: None, ..Config::default() });
        let counts = std::cell::Cell::new((0, 0));
        runner
            .run(&strategy, |(file, changes)| {
                let mut bytes = files[file].clone();
                changes.iter().for_each(|(at, value)| bytes[at.index(files[file].len())] = *value);
                let good = used(&bytes);
                let (a, b) = counts.get();
                counts.set((a + u32::from(good), b + u32::from(!good)));
                Ok(())
            })
            .unwrap_or_else(|error| panic!("{error}"));
        (read, refused) = counts.get();
    }
    println!("{read} mutated files were read, {refused} refused");
    assert!(read > 20 && refused > 20);
}

/// Whole numbers and floats of extreme size at aligned places of the binary part, where single bytes seldom hit.
fn mutated_words_never_panic() {
    let words = [f32::MAX, f32::MIN_POSITIVE, -1e7, 1e7, 0.0, -0.0, 1e-20, 65535.0, 9.9e6].map(f32::to_bits);
    let files = files();
    let mut read = 0;
    for (number, file) in files.iter().enumerate() {
        let start = file.len() - [walker(), post(), table()][number].binary.len();
        for round in 0..60_usize {
            let mut bytes = file.clone();
            for k in 0..1 + round % 3 {
                let at = start + 4 * ((round * 7919 + k * 104_729) % ((file.len() - start) / 4));
                bytes[at..at + 4].copy_from_slice(&words[(round + 3 * k) % words.len()].to_le_bytes());
            }
            read += u32::from(used(&bytes));
        }
    }
    assert!(read > 20, "{read}");
}
