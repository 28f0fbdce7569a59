//! Small glTF files, built in memory.

use serde_json::{Value, json};

/// A file in the making.
pub(crate) struct Glb {
    pub(crate) json: Value,
    pub(crate) binary: Vec<u8>,
}

pub(crate) fn bytes_of(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

impl Glb {
    pub(crate) fn new() -> Self {
        let json = json!({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "accessors": [],
            "bufferViews": [], "buffers": [], "skins": [], "animations": [], "materials": [], "textures": [], "images": []});
        Self { json, binary: Vec::new() }
    }

    /// Appends to a list of the JSON; returns the index.
    pub(crate) fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    }

    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        let start = self.binary.len();
        self.binary.extend(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.push("bufferViews", json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len()}))
    }

    pub(crate) fn accessor(&mut self, bytes: &[u8], component: u32, shape: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({"bufferView": view, "componentType": component, "type": shape, "count": count}))
    }

    pub(crate) fn floats(&mut self, numbers: &[f32], shape: &str) -> usize {
        let width = match shape {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        self.accessor(&bytes_of(numbers), 5126, shape, numbers.len() / width)
    }

    /// A mesh of one primitive; more attributes may be given.
    pub(crate) fn mesh(&mut self, positions: &[[f32; 3]], triangles: &[[u16; 3]], attributes: Value) -> usize {
        let position = self.floats(positions.as_flattened(), "VEC3");
        let indices: Vec<u8> = triangles.as_flattened().iter().flat_map(|index| index.to_le_bytes()).collect();
        let indices = self.accessor(&indices, 5123, "SCALAR", 3 * triangles.len());
        let mut all = json!({"POSITION": position});
        all.as_object_mut().expect("an object").extend(attributes.as_object().expect("an object").clone());
        self.push("meshes", json!({"primitives": [{"attributes": all, "indices": indices}]}))
    }

    /// A node on top of the scene.
    pub(crate) fn top(&mut self, node: Value) -> usize {
        let index = self.push("nodes", node);
        self.json["scenes"][0]["nodes"].as_array_mut().expect("a list").push(json!(index));
        index
    }

    /// An animation of one channel.
    pub(crate) fn clip(&mut self, name: &str, node: usize, path: &str, interpolation: &str, times: &[f32], values: &[f32]) -> usize {
        let input = self.floats(times, "SCALAR");
        let output = self.floats(values, if path == "rotation" { "VEC4" } else { "VEC3" });
        let sampler = json!({"input": input, "output": output, "interpolation": interpolation});
        let channel = json!({"sampler": 0, "target": {"node": node, "path": path}});
        self.push("animations", json!({"name": name, "channels": [channel], "samplers": [sampler]}))
    }

    /// The file as `.glb`.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{"byteLength": self.binary.len()}]);
        pack(json.to_string().as_bytes(), &self.binary)
    }
}

/// A `.glb` of a JSON text and a binary chunk.
pub(crate) fn pack(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let mut json = json.to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let mut bytes = b"glTF".to_vec();
    for word in [2, length as u32, json.len() as u32, 0x4E4F_534A] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(json);
    bytes.extend((binary.len() as u32).to_le_bytes());
    bytes.extend(0x004E_4942_u32.to_le_bytes());
    bytes.extend(binary);
    bytes
}

/// Corners and triangles of a box.
pub(crate) fn block(low: [f32; 3], high: [f32; 3]) -> (Vec<[f32; 3]>, Vec<[u16; 3]>) {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let sides: [[u16; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    ((0..8).map(corner).collect(), sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

/// Several boxes as one mesh.
pub(crate) fn blocks(list: &[[[f32; 3]; 2]]) -> (Vec<[f32; 3]>, Vec<[u16; 3]>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for [low, high] in list {
        let (corners, faces) = block(*low, *high);
        let first = positions.len() as u16;
        positions.extend(corners);
        triangles.extend(faces.iter().map(|face| face.map(|index| index + first)));
    }
    (positions, triangles)
}

/// A table: a top from 0.7 to 0.8 m on four legs, 2 m wide and 3 m long.
pub(crate) fn table() -> Glb {
    let mut parts = vec![[[-1.0, 0.7, -1.5], [1.0, 0.8, 1.5]]];
    for (x, z) in [(-0.9, -1.4), (0.9, -1.4), (-0.9, 1.4), (0.9, 1.4)] {
        parts.push([[x - 0.1, 0.0, z - 0.1], [x + 0.1, 0.75, z + 0.1]]);
    }
    let (positions, triangles) = blocks(&parts);
    let mut glb = Glb::new();
    let mesh = glb.mesh(&positions, &triangles, json!({}));
    glb.top(json!({"mesh": mesh}));
    glb
}

/// Two legs as nodes and a trunk, 1 m high. Clip `Walk`, 1 s: each foot is on the ground for half of it, going back 1 m/s in the body's
/// frame, and swings forward 0.2 m high in the other half.
pub(crate) fn walker() -> Glb {
    let mut glb = Glb::new();
    let (positions, triangles) = block([-0.08, 0.0, -0.15], [0.08, 0.5, 0.15]);
    let leg = glb.mesh(&positions, &triangles, json!({}));
    let (positions, triangles) = block([-0.3, 0.7, -0.15], [0.3, 1.0, 0.15]);
    let trunk = glb.mesh(&positions, &triangles, json!({}));
    glb.top(json!({"mesh": trunk, "name": "trunk"}));
    let left = glb.top(json!({"mesh": leg, "name": "left", "translation": [0.3, 0.0, 0.0]}));
    let right = glb.top(json!({"mesh": leg, "name": "right", "translation": [-0.3, 0.0, 0.0]}));
    let times = glb.floats(&[0.0, 0.5, 0.75, 1.0], "SCALAR");
    let ahead = glb.floats(&[0.3, 0.0, 0.25, 0.3, 0.0, -0.25, 0.3, 0.2, 0.0, 0.3, 0.0, 0.25], "VEC3");
    let late = glb.floats(&[0.0, 0.25, 0.5, 1.0], "SCALAR");
    let behind = glb.floats(&[-0.3, 0.0, -0.25, -0.3, 0.2, 0.0, -0.3, 0.0, 0.25, -0.3, 0.0, -0.25], "VEC3");
    let channel = |sampler: usize, node: usize| json!({"sampler": sampler, "target": {"node": node, "path": "translation"}});
    glb.push(
        "animations",
        json!({"name": "Walk", "channels": [channel(0, left), channel(1, right)],
            "samplers": [{"input": times, "output": ahead}, {"input": late, "output": behind}]}),
    );
    glb
}

/// A post of two joints, 2 m high, its upper half bent by a clip; the middle follows both halves.
pub(crate) fn post() -> Glb {
    let mut glb = Glb::new();
    let mut positions = Vec::new();
    for level in 0..5 {
        for (x, z) in [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)] {
            positions.push([x, 0.5 * level as f32, z]);
        }
    }
    let mut triangles = Vec::new();
    for level in 0..4_u16 {
        for side in 0..4_u16 {
            let (a, b) = (4 * level + side, 4 * level + (side + 1) % 4);
            triangles.extend([[a, a + 4, b], [b, a + 4, b + 4]]);
        }
    }
    let joints: Vec<u8> = (0..20).flat_map(|_| [0, 1, 0, 0]).collect();
    let weights: Vec<f32> =
        (0..20).flat_map(|k| [[1.0, 0.0], [1.0, 0.0], [0.5, 0.5], [0.0, 1.0], [0.0, 1.0]][k / 4].into_iter().chain([0.0, 0.0])).collect();
    let joints = glb.accessor(&joints, 5121, "VEC4", 20);
    let weights = glb.floats(&weights, "VEC4");
    let mesh = glb.mesh(&positions, &triangles, json!({"JOINTS_0": joints, "WEIGHTS_0": weights}));
    let mut matrices = glam::Mat4::IDENTITY.to_cols_array().to_vec();
    matrices.extend(glam::Mat4::from_translation(glam::Vec3::new(0.0, -1.0, 0.0)).to_cols_array());
    let matrices = glb.floats(&matrices, "MAT4");
    glb.top(json!({"mesh": mesh, "skin": 0, "translation": [5.0, 5.0, 5.0]}));
    let root = glb.top(json!({"name": "root"}));
    let bone = glb.push("nodes", json!({"name": "bone", "translation": [0.0, 1.0, 0.0]}));
    glb.json["nodes"][root]["children"] = json!([bone]);
    glb.push("skins", json!({"joints": [root, bone], "inverseBindMatrices": matrices}));
    let half = std::f32::consts::FRAC_1_SQRT_2;
    glb.clip("Bow", bone, "rotation", "LINEAR", &[0.0, 1.0], &[0.0, 0.0, 0.0, 1.0, half, 0.0, 0.0, half]);
    glb
}
