//! A small helicopter, 6.9 m long without its rotor, nose ahead (+z), on skids. Clip `Fly`: both rotors turn.

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use glam::{DQuat, DVec3};
use serde_json::{Value, json};
use sward::math::sin_cos_f64;

use crate::glb::Glb;

/// Time of a turn of the rotor, s; the tail's is a third of it.
pub(crate) const TURN: f64 = 0.36;
/// Blades of the rotor, and their reach, m.
const BLADES: usize = 3;
pub(crate) const REACH: f64 = 4.6;
/// Place of the rotor's hub and of the tail's, m.
const HUB: [f64; 3] = [0.0, 2.72, 0.1];
const TAIL: [f64; 3] = [0.16, 1.78, -4.62];
/// Index of the dark material.
const DARK: usize = 2;
/// Vertices around a hull.
const AROUND: usize = 20;

/// Sections of a hull from nose to tail: place along z, height of the middle, half width, half height, m.
type Section = [f64; 4];
const CABIN: [Section; 11] = [
    [2.06, 0.98, 0.02, 0.02],
    [1.98, 0.98, 0.24, 0.2],
    [1.7, 1.0, 0.54, 0.42],
    [1.1, 1.1, 0.8, 0.64],
    [0.3, 1.22, 0.86, 0.76],
    [-0.5, 1.36, 0.74, 0.68],
    [-1.1, 1.52, 0.42, 0.4],
    [-1.7, 1.6, 0.2, 0.19],
    [-3.2, 1.68, 0.13, 0.13],
    [-4.7, 1.76, 0.08, 0.08],
    [-4.76, 1.76, 0.01, 0.01],
];
const GLASS: [Section; 6] = [
    [2.0, 1.16, 0.02, 0.02],
    [1.86, 1.22, 0.4, 0.27],
    [1.4, 1.42, 0.74, 0.47],
    [0.9, 1.54, 0.86, 0.52],
    [0.5, 1.6, 0.84, 0.48],
    [0.3, 1.6, 0.4, 0.24],
];
const ENGINE: [Section; 6] = [
    [0.75, 2.0, 0.02, 0.02],
    [0.6, 2.0, 0.26, 0.16],
    [0.1, 2.04, 0.4, 0.26],
    [-0.6, 2.0, 0.36, 0.26],
    [-1.1, 1.9, 0.2, 0.16],
    [-1.25, 1.86, 0.02, 0.02],
];

/// Triangles of one material.
#[derive(Default)]
struct Skin {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    triangles: Vec<[u16; 3]>,
}

impl Skin {
    /// Rings from end to end, each given by its middle and two half axes; smooth.
    fn loft(&mut self, rings: &[[DVec3; 3]]) {
        let first = self.positions.len();
        for [middle, across, up] in rings {
            for turn in 0..AROUND {
                let (sine, cosine) = sin_cos_f64(TAU * turn as f64 / AROUND as f64);
                self.positions.push(*middle + *across * cosine + *up * sine);
            }
        }
        self.normals.resize(self.positions.len(), DVec3::ZERO);
        let vertex = |ring: usize, turn: usize| (first + ring * AROUND + turn % AROUND) as u16;
        for ring in 1..rings.len() {
            for turn in 0..AROUND {
                let [a, b, c, d] = [vertex(ring - 1, turn), vertex(ring - 1, turn + 1), vertex(ring, turn + 1), vertex(ring, turn)];
                for triangle in [[a, b, c], [a, c, d]] {
                    let [p, q, r] = triangle.map(|corner| self.positions[usize::from(corner)]);
                    triangle.iter().for_each(|corner| self.normals[usize::from(*corner)] += (q - p).cross(r - p));
                    self.triangles.push(triangle);
                }
            }
        }
        self.normals[first..].iter_mut().for_each(|normal| *normal = normal.try_normalize().unwrap_or(DVec3::Y));
    }

    fn hull(&mut self, sections: &[Section]) {
        let ring = |[z, y, wide, high]: &Section| [DVec3::new(0.0, *y, *z), DVec3::X * *wide, DVec3::Y * *high];
        // From nose to tail x turns to y outwards only the other way round.
        self.loft(&sections.iter().rev().map(ring).collect::<Vec<_>>());
    }

    /// A round bar.
    fn bar(&mut self, from: [f64; 3], to: [f64; 3], radius: f64) {
        let [from, to] = [from, to].map(DVec3::from);
        let along = (to - from).normalize();
        let (across, up) = along.any_orthonormal_pair();
        let ring = |at: DVec3, radius: f64| [at, across * radius, up * radius];
        self.loft(&[ring(from, 0.001), ring(from, radius), ring(to, radius), ring(to, 0.001)]);
    }

    /// A box with flat sides, turned about the vertical.
    fn plate(&mut self, low: [f64; 3], high: [f64; 3], yaw: f64) {
        let (sine, cosine) = sin_cos_f64(yaw);
        let turned = |at: DVec3| DVec3::new(cosine * at.x + sine * at.z, at.y, cosine * at.z - sine * at.x);
        let [low, high] = [low, high].map(DVec3::from);
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let [out, u, v] = [axis, (axis + 1) % 3, (axis + 2) % 3].map(|axis| DVec3::AXES[axis] * half[axis]);
                let (out, u) = (out * side, u * side);
                let first = self.positions.len() as u16;
                self.positions.extend([-u - v, u - v, u + v, v - u].map(|corner| turned(middle + out + corner)));
                self.normals.extend([turned(out.normalize()); 4]);
                self.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|face| face.map(|corner: u16| first + corner)));
            }
        }
    }

    /// The primitive of a mesh.
    fn primitive(&self, glb: &mut Glb, material: usize) -> Value {
        let numbers = |list: &[DVec3]| list.iter().flat_map(|at| at.as_vec3().to_array()).collect::<Vec<f32>>();
        let (low, high) = self.positions.iter().fold((DVec3::MAX, DVec3::MIN), |(low, high), at| (low.min(*at), high.max(*at)));
        let position = glb.floats(&numbers(&self.positions), "VEC3");
        glb.json["accessors"][position]["min"] = json!(low.as_vec3().to_array());
        glb.json["accessors"][position]["max"] = json!(high.as_vec3().to_array());
        let normal = glb.floats(&numbers(&self.normals), "VEC3");
        let indices: Vec<u8> = self.triangles.as_flattened().iter().flat_map(|index| index.to_le_bytes()).collect();
        let indices = glb.accessor(&indices, 5123, "SCALAR", 3 * self.triangles.len());
        json!({"material": material, "indices": indices, "attributes": {"POSITION": position, "NORMAL": normal}})
    }
}

/// Painted, glass, and dark parts of what does not turn.
fn airframe() -> [Skin; 3] {
    let [mut paint, mut glass, mut dark] = [(); 3].map(|()| Skin::default());
    paint.hull(&CABIN);
    paint.hull(&ENGINE);
    paint.plate([-0.035, 1.7, -4.8], [0.035, 2.75, -4.4], 0.0);
    paint.plate([-0.75, 1.66, -3.75], [0.75, 1.71, -3.4], 0.0);
    glass.hull(&GLASS);
    dark.bar([0.0, 2.1, HUB[2]], [0.0, HUB[1], HUB[2]], 0.07);
    for side in [-1.0, 1.0] {
        dark.bar([0.9 * side, 0.05, -1.2], [0.9 * side, 0.05, 1.5], 0.05);
        dark.bar([0.9 * side, 0.05, 1.5], [0.9 * side, 0.22, 1.75], 0.05);
        for z in [-0.65, 0.95] {
            dark.bar([0.9 * side, 0.05, z], [0.4 * side, 0.72, z], 0.04);
        }
    }
    [paint, glass, dark]
}

fn blades(count: usize, reach: f64, chord: f64) -> Skin {
    let mut skin = Skin::default();
    for blade in 0..count {
        skin.plate([-0.5 * chord, -0.012, 0.0], [0.5 * chord, 0.012, reach], TAU * blade as f64 / count as f64);
    }
    skin
}

/// Turns about an axis, quarter by quarter.
fn turning(axis: DVec3, quarters: u32) -> Vec<f32> {
    let quarter = |k: u32| {
        let (sine, cosine) = sin_cos_f64(0.25 * PI * f64::from(k));
        DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine)
    };
    (0..=quarters).flat_map(|k| quarter(k).as_quat().to_array()).collect()
}

/// A hub with its blades, which lie flat unless they are told to `stand`, and what of the clip turns it: channel and sampler.
fn rotor(glb: &mut Glb, name: &str, at: [f64; 3], skin: &Skin, stand: bool) -> usize {
    let primitive = skin.primitive(glb, DARK);
    let mesh = glb.push("meshes", json!({"primitives": [primitive]}));
    let tilt = if stand { [0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2] } else { [0.0, 0.0, 0.0, 1.0] };
    let own = glb.push("nodes", json!({"name": name, "mesh": mesh, "rotation": tilt}));
    glb.top(json!({"name": format!("{name} hub"), "translation": at, "children": [own]}))
}

/// Clip `Fly`: a turn of the rotor and three of the tail's.
fn fly(glb: &mut Glb, hubs: [usize; 2]) {
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    for (hub, axis, quarters) in [(hubs[0], DVec3::Y, 4), (hubs[1], DVec3::X, 12)] {
        let times: Vec<f32> = (0..=quarters).map(|k| (TURN * f64::from(k) / f64::from(quarters)) as f32).collect();
        let input = glb.floats(&times, "SCALAR");
        glb.json["accessors"][input]["min"] = json!([0.0]);
        glb.json["accessors"][input]["max"] = json!([times.last()]);
        let output = glb.floats(&turning(axis, quarters), "VEC4");
        channels.push(json!({"sampler": samplers.len(), "target": {"node": hub, "path": "rotation"}}));
        samplers.push(json!({"input": input, "output": output}));
    }
    glb.push("animations", json!({"name": "Fly", "channels": channels, "samplers": samplers}));
}

/// The file.
pub(crate) fn helicopter() -> Glb {
    let mut glb = Glb::new();
    for (name, [red, green, blue], roughness) in
        [("paint", [0.66, 0.6, 0.48], 0.35), ("glass", [0.025, 0.035, 0.045], 0.08), ("dark", [0.03, 0.03, 0.03], 0.6)]
    {
        let look = json!({"baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.0, "roughnessFactor": roughness});
        glb.push("materials", json!({"name": name, "pbrMetallicRoughness": look}));
    }
    let primitives: Vec<Value> = airframe().iter().enumerate().map(|(material, skin)| skin.primitive(&mut glb, material)).collect();
    let mesh = glb.push("meshes", json!({"primitives": primitives}));
    glb.top(json!({"name": "airframe", "mesh": mesh}));
    let hubs = [
        rotor(&mut glb, "rotor", HUB, &blades(BLADES, REACH, 0.24), false),
        rotor(&mut glb, "tail rotor", TAIL, &blades(2, 0.72, 0.1), true),
    ];
    fly(&mut glb, hubs);
    glb
}
