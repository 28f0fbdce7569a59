//! A ring that stamps: a torus that lies flat, 2.7 m wide and 0.7 m high, of painted iron.

use std::f64::consts::TAU;

use glam::DVec3;
use serde_json::json;
use sward::math::sin_cos_f64;

use crate::glb::{Glb, bytes_of};

/// Radius of the ring and of its section, m.
pub(crate) const RADII: [f64; 2] = [1.0, 0.35];
/// Vertices around the ring and around its section.
const AROUND: [usize; 2] = [48, 20];

/// The file.
pub(crate) fn torus() -> Glb {
    let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    let [ring, section] = AROUND;
    for at in 0..ring {
        let (sine, cosine) = sin_cos_f64(TAU * at as f64 / ring as f64);
        let out = DVec3::new(cosine, 0.0, sine);
        for turn in 0..section {
            let (up, along) = sin_cos_f64(TAU * turn as f64 / section as f64);
            let normal = out * along + DVec3::Y * up;
            let place = out * RADII[0] + normal * RADII[1] + DVec3::Y * RADII[1];
            positions.extend(place.as_vec3().to_array());
            normals.extend(normal.as_vec3().to_array());
            let vertex = |at: usize, turn: usize| ((at % ring) * section + turn % section) as u16;
            let [a, b, c, d] = [vertex(at, turn), vertex(at, turn + 1), vertex(at + 1, turn + 1), vertex(at + 1, turn)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let mut glb = Glb::new();
    let material =
        json!({"pbrMetallicRoughness": {"baseColorFactor": [0.45, 0.05, 0.03, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.35}});
    glb.push("materials", material);
    let position = glb.accessor(&bytes_of(&positions), 5126, "VEC3", positions.len() / 3);
    let width = RADII[0] + RADII[1];
    let bounds = [DVec3::new(-width, 0.0, -width), DVec3::new(width, 2.0 * RADII[1], width)].map(|at| at.as_vec3().to_array());
    glb.json["accessors"][position]["min"] = json!(bounds[0]);
    glb.json["accessors"][position]["max"] = json!(bounds[1]);
    let normal = glb.accessor(&bytes_of(&normals), 5126, "VEC3", normals.len() / 3);
    let indices: Vec<u8> = triangles.as_flattened().iter().flat_map(|index| index.to_le_bytes()).collect();
    let indices = glb.accessor(&indices, 5123, "SCALAR", 3 * triangles.len());
    let primitive = json!({"material": 0, "indices": indices, "attributes": {"POSITION": position, "NORMAL": normal}});
    let mesh = glb.push("meshes", json!({"primitives": [primitive]}));
    glb.top(json!({"name": "ring", "mesh": mesh}));
    glb
}
