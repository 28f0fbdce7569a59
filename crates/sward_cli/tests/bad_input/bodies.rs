//! glTF files that cannot be bodies.

use serde_json::{Value, json};

use crate::support::Place;
use crate::{refuses, takes};

const BODY: &str = "(version: 1, interactors: [(shape: Mesh(file: \"car.glb\"))])";

/// A triangle on two nodes: JSON and numbers.
fn triangle() -> (Value, Vec<u8>) {
    let numbers: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0].into_iter().flat_map(f32::to_le_bytes).collect();
    let indices: Vec<u8> = [0_u32, 1, 2].into_iter().flat_map(u32::to_le_bytes).collect();
    let json = json!({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"children": [1]}, {"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
            {"bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12}], "buffers": [{"byteLength": 48}]});
    (json, [numbers, indices].concat())
}

fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let json = json.to_owned() + &" ".repeat(json.len().next_multiple_of(4) - json.len());
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let mut bytes = b"glTF".to_vec();
    for word in [2, length as u32, json.len() as u32, 0x4E4F_534A] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(json.bytes());
    bytes.extend((binary.len() as u32).to_le_bytes().into_iter().chain(0x004E_4942_u32.to_le_bytes()));
    bytes.extend(binary);
    bytes
}

fn whole() -> Vec<u8> {
    let (json, binary) = triangle();
    glb(&json.to_string(), &binary)
}

/// A change to the JSON, and what the error says of it.
type Mistake = (fn(&mut Value), &'static [&'static str]);

const MISTAKES: &[Mistake] = &[
    (|json| json["scenes"][0]["nodes"] = json!([]), &["no triangles", "export meshes"]),
    (|json| json["meshes"][0]["primitives"][0]["mode"] = json!(1), &["no triangles", "export meshes"]),
    (|json| json["asset"]["version"] = json!("1.0"), &["`asset.version` is 1.0, needed is 2.0", "export it as glTF 2.0"]),
    (|json| json["nodes"][1]["children"] = json!([0]), &["nodes[0] is its own ancestor; a tree is needed", "export it again"]),
    (|json| json["nodes"][1]["children"] = json!([1]), &["nodes[1]", "export it again"]),
    (|json| json["nodes"][1]["mesh"] = json!(4_000_000_000_u32), &["nodes[1] points to meshes[4000000000], but there are 1"]),
    (|json| json["nodes"][1]["scale"] = json!([1e308, 1, 1]), &["nodes[1] stands at numbers beyond", "export it again"]),
    (|json| json["accessors"][0]["count"] = json!(u64::MAX), &["accessors[0]", "at most 3000000 are read"]),
    (|json| json["accessors"][0]["count"] = json!(4), &["accessors[0] has 4 elements, which reach beyond its bufferView of 36 bytes"]),
    (|json| json["accessors"][0]["byteOffset"] = json!(u64::MAX), &["accessors[0]", "reach beyond its bufferView"]),
    (|json| json["accessors"][1]["count"] = json!(9), &["accessors[1]", "reach beyond its bufferView of 12 bytes"]),
    (|json| json["accessors"][1]["type"] = json!("VEC3"), &["accessors[1] is of type `VEC3`, which does not fit its use"]),
    (|json| json["bufferViews"][0]["byteLength"] = json!(u64::MAX), &["bufferViews[0] reaches beyond the 48 bytes of its buffer"]),
    (|json| json["bufferViews"][0]["byteStride"] = json!(u64::MAX), &["accessors[0]", "reach beyond"]),
    (|json| json["buffers"][0]["byteLength"] = json!(1_u64 << 40), &["buffers[0] announces 1099511627776 bytes, but there are 48"]),
    (
        |json| json["buffers"][0]["uri"] = json!("gone.bin"),
        &["buffers[0] names a file that cannot be read", "export it as .glb, in one file"],
    ),
    (|json| json["buffers"][0]["uri"] = json!("../../etc/passwd"), &["buffers[0] names", "a file beside the glTF file or below it"]),
    (|json| json["buffers"][0]["uri"] = json!("data:text/plain,a"), &["buffers[0] has a `data:` URI that is not base64"]),
    (|json| json["nodes"] = json!(vec![json!({}); 5000]), &["5000 nodes, at most 4096 are read", "join objects before exporting"]),
    (|json| json["nodes"] = json!(7), &["its JSON is not glTF 2.0", "line 1 column", "export it again"]),
    (|json| json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]), &["`KHR_draco_mesh_compression`", "compression"]),
];

#[test]
fn bodies_that_are_no_gltf_are_refused() {
    let place = Place::new("bad_glb");
    let at = "1:47";
    refuses(&place, BODY, at, &["car.glb: cannot be read", "type a path"]);
    place.write("car.glb", whole());
    takes(&place, BODY);
    let refuse = |bytes: Vec<u8>, words: &[&str]| {
        place.write("car.glb", bytes);
        refuses(&place, BODY, "", &[&["test.ron:1:47: car.glb: "], words].concat());
    };
    for (change, words) in MISTAKES {
        let (mut json, binary) = triangle();
        change(&mut json);
        refuse(glb(&json.to_string(), &binary), words);
    }
    let (json, binary) = triangle();
    let json = json.to_string();
    for (at, value, words) in [
        (0, f32::NAN.to_bits(), &["meshes[0].primitives[0].POSITION) has NaN in element 0; a finite number is needed"][..]),
        (4, f32::INFINITY.to_bits(), &["has inf in element 0; a finite number is needed"]),
        (8, 1e30_f32.to_bits(), &["POSITION has vertices beyond ±1e7 units", "export it again"]),
        (36, 3, &["meshes[0].primitives[0] has an index 3, but 3 vertices", "export it again"]),
        (40, u32::MAX, &["meshes[0].primitives[0] has an index 4294967295, but 3 vertices", "export it again"]),
    ] {
        let mut harmed = binary.clone();
        harmed[at..at + 4].copy_from_slice(&value.to_le_bytes());
        refuse(glb(&json, &harmed), words);
    }
    refuse(glb(&"[".repeat(100_000), &[]), &["its JSON is not glTF 2.0", "export it again"]);
    refuse(
        glb(&format!("{{\"x\": {}1{}}}", "[".repeat(100_000), "]".repeat(100_000)), &[]),
        &["its JSON is not glTF 2.0", "export it again"],
    );
}

#[test]
fn containers_that_lie_are_refused() {
    let place = Place::new("bad_container");
    let refuse = |bytes: Vec<u8>, words: &[&str]| {
        place.write("car.glb", bytes);
        refuses(&place, BODY, "", &[&["test.ron:1:47: car.glb: not a whole glTF 2.0 file: "], words].concat());
    };
    let whole = whole();
    for end in [4, 8, 11] {
        refuse(whole[..end].to_vec(), &["it ends within its header", "copy or export it again"]);
    }
    for end in [12, 15, 20, 60, whole.len() - 1] {
        refuse(whole[..end].to_vec(), &["its header announces", "copy or export it again"]);
    }
    refuse(Vec::new(), &["not with \"glTF\" (.glb) or \"{\" (.gltf)"]);
    refuse(b"PK\x03\x04".to_vec(), &["it begins with \"PK", "not with \"glTF\" (.glb) or \"{\" (.gltf)"]);
    for (at, value, words) in [
        (4, 1_u32, &["version 1 of the binary format, needed is 2", "export it as glTF 2.0"][..]),
        (8, u32::MAX, &["announces 4294967295 bytes", "copy or export it again"]),
        (12, u32::MAX, &["a chunk announces 4294967295 bytes", "copy or export it again"]),
        (12, 8000, &["a chunk announces 8000 bytes", "copy or export it again"]),
        (16, 7, &["no JSON chunk"]),
    ] {
        let mut bytes = whole.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        refuse(bytes, words);
    }
}

/// What the scene asks of a file that is fine: the place is the value that asks.
#[test]
fn bodies_asked_for_more_than_they_have_are_refused() {
    let place = Place::new("bad_wishes");
    place.write("car.glb", whole());
    let body = |more: &str| format!("(version: 1, interactors: [(shape: Mesh(file: \"car.glb\",\n {more}))])");
    refuses(&place, &body("clip: \"Drive\""), "", &["test.ron:2:8: car.glb: no clip is called `Drive`", "leave `clip` out"]);
    refuses(&place, &body("scale: 5000"), "", &["test.ron:2:9: car.glb: as scaled, the body is", "allowed 0.01 to 200 m", "type scale:"]);
    refuses(&place, &body("scale: NaN"), "", &["test.ron:2:9: `scale` is NaN", "allowed 0.00001 to 10000"]);
    refuses(&place, &body("pieces: 65"), "", &["test.ron:2:10: `pieces` is 65, allowed 1 to 64"]);
    takes(&place, &body("scale: 2"));
}
