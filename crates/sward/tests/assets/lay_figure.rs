//! An artist's lay figure, 1.85 m tall: limbs turned of wood, balls for joints, one skin. It walks.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};
use serde_json::json;
use sward::math::sin_cos_f64;

use crate::gait::{self, ANKLE, LEG, ROUND};
use crate::glb::{Glb, bytes_of};

/// Height of the hip joints of a figure that stands, m.
const HIP: f64 = ANKLE + LEG[0] + LEG[1];

/// Name, parent and place of each joint, m; the left is +x, ahead +z.
pub(crate) const JOINTS: [(&str, Option<usize>, [f64; 3]); 19] = [
    ("hips", None, [0.0, HIP + 0.02, 0.0]),
    ("waist", Some(0), [0.0, 1.1, 0.0]),
    ("chest", Some(1), [0.0, 1.24, 0.005]),
    ("neck", Some(2), [0.0, 1.53, -0.005]),
    ("head", Some(3), [0.0, 1.61, 0.005]),
    ("left arm", Some(2), [0.205, 1.455, 0.0]),
    ("left elbow", Some(5), [0.24, 1.17, -0.005]),
    ("left hand", Some(6), [0.26, 0.92, 0.005]),
    ("right arm", Some(2), [-0.205, 1.455, 0.0]),
    ("right elbow", Some(8), [-0.24, 1.17, -0.005]),
    ("right hand", Some(9), [-0.26, 0.92, 0.005]),
    ("left leg", Some(0), [0.1, HIP, 0.0]),
    ("left knee", Some(11), [0.1, ANKLE + LEG[1], 0.0]),
    ("left foot", Some(12), [0.1, ANKLE, 0.0]),
    ("left toes", Some(13), [0.1, 0.025, 0.13]),
    ("right leg", Some(0), [-0.1, HIP, 0.0]),
    ("right knee", Some(15), [-0.1, ANKLE + LEG[1], 0.0]),
    ("right foot", Some(16), [-0.1, ANKLE, 0.0]),
    ("right toes", Some(17), [-0.1, 0.025, 0.13]),
];
/// First joint of an arm and of a leg, left and right.
const ARMS: [usize; 2] = [5, 8];
const LEGS: [usize; 2] = [11, 15];
/// Poses in a round of the walk.
const POSES: usize = 24;
/// Vertices around a turned part, and rings from end to end.
const AROUND: usize = 12;
const RINGS: usize = 7;

/// One part, as if turned on a lathe and then flattened.
struct Turned {
    ends: [DVec3; 2],
    /// Half width and half depth at both ends of the taper, m.
    radii: [[f64; 2]; 2],
    /// A ball, or fuller: a spindle.
    full: bool,
    /// Joints that it follows: the second one more towards its second end.
    joints: [usize; 2],
}

/// Vertices of one material.
#[derive(Default)]
struct Skin {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    joints: Vec<u8>,
    weights: Vec<u8>,
    triangles: Vec<[u16; 3]>,
}

impl Skin {
    fn add(&mut self, part: &Turned) {
        let first = self.positions.len();
        let along = part.ends[1] - part.ends[0];
        // A foot is turned along z: its depth is its height.
        let deep = if along.z.abs() > along.y.abs() { DVec3::Y } else { DVec3::Z };
        let across = deep.cross(along).normalize();
        let deep = along.cross(across).normalize();
        for ring in 0..=RINGS {
            let level = -sin_cos_f64(PI * (0.5 - ring as f64 / RINGS as f64)).0;
            let square = level * level;
            let outline = if part.full { (1.0 - square * square).max(0.0).sqrt().sqrt() } else { (1.0 - square).max(0.0).sqrt() };
            let share = 0.5 * (1.0 + level);
            let radius = |side: usize| outline * (part.radii[0][side] + share * (part.radii[1][side] - part.radii[0][side]));
            let pole = ring == 0 || ring == RINGS;
            let follows = (255.0 * share + 0.5) as u8;
            for turn in 0..if pole { 1 } else { AROUND } {
                let (sine, cosine) = sin_cos_f64(TAU * turn as f64 / AROUND as f64);
                let out = if pole { DVec3::ZERO } else { across * (radius(0) * cosine) + deep * (radius(1) * sine) };
                let mut at = part.ends[0] + along * share + out;
                // Soles are flat.
                at.y = at.y.max(0.0);
                self.positions.push(at);
                let [base, tip] = part.joints;
                self.joints.extend([base as u8, tip as u8, 0, 0]);
                self.weights.extend(if base == tip { [255, 0, 0, 0] } else { [255 - follows, follows, 0, 0] });
            }
        }
        let begin = |ring: usize| if ring == 0 { first } else { first + 1 + (ring - 1) * AROUND };
        let vertex = |ring: usize, turn: usize| (begin(ring) + if ring == 0 || ring == RINGS { 0 } else { turn % AROUND }) as u16;
        for ring in 0..RINGS {
            for turn in 0..AROUND {
                let [a, b, c, d] = [vertex(ring, turn), vertex(ring, turn + 1), vertex(ring + 1, turn + 1), vertex(ring + 1, turn)];
                self.triangles.extend(if ring > 0 { Some([a, b, c]) } else { None });
                self.triangles.extend(if ring + 1 < RINGS { Some([a, c, d]) } else { None });
            }
        }
        self.shade(first);
    }

    /// Normals of the vertices from `first` on: of the triangles around each.
    fn shade(&mut self, first: usize) {
        self.normals.resize(self.positions.len(), DVec3::ZERO);
        for triangle in self.triangles.iter().filter(|corners| usize::from(corners[0]) >= first) {
            let [a, b, c] = triangle.map(|corner| self.positions[usize::from(corner)]);
            let normal = (b - a).cross(c - a);
            for corner in triangle {
                self.normals[usize::from(*corner)] += normal;
            }
        }
        for normal in &mut self.normals[first..] {
            *normal = normal.try_normalize().unwrap_or(DVec3::Y);
        }
    }
}

fn place(joint: usize) -> DVec3 {
    DVec3::from(JOINTS[joint].2)
}

fn spindle(from: [f64; 3], to: [f64; 3], radii: [[f64; 2]; 2], joint: usize) -> Turned {
    Turned { ends: [from.into(), to.into()], radii, full: true, joints: [joint; 2] }
}

fn ball(joint: usize, radius: f64) -> Turned {
    let (at, up) = (place(joint), DVec3::Y * radius);
    Turned { ends: [at - up, at + up], radii: [[radius; 2]; 2], full: false, joints: [joint; 2] }
}

/// A limb from a joint towards the next one, not quite reaching either.
fn limb(joint: usize, radii: [f64; 2]) -> Turned {
    let (from, to) = (place(joint), place(joint + 1));
    Turned { ends: [from.lerp(to, 0.06), from.lerp(to, 0.94)], radii: radii.map(|radius| [radius; 2]), full: true, joints: [joint; 2] }
}

/// Limbs and trunk, then balls.
fn skins() -> [Skin; 2] {
    let [mut wood, mut joints] = [Skin::default(), Skin::default()];
    wood.add(&spindle([0.0, 0.86, 0.0], [0.0, 1.07, 0.0], [[0.12, 0.095], [0.14, 0.1]], 0));
    wood.add(&spindle([0.0, 1.17, 0.0], [0.0, 1.53, 0.0], [[0.115, 0.09], [0.185, 0.11]], 2));
    wood.add(&Turned {
        ends: [[0.0, 1.6, 0.015].into(), [0.0, 1.85, 0.0].into()],
        radii: [[0.06, 0.07], [0.105, 0.125]],
        full: false,
        joints: [4; 2],
    });
    joints.add(&Turned { ends: [[0.0, 1.0, 0.0].into(), [0.0, 1.26, 0.005].into()], radii: [[0.1, 0.08]; 2], full: true, joints: [0, 2] });
    joints.add(&Turned { ends: [[0.0, 1.48, -0.005].into(), [0.0, 1.66, 0.0].into()], radii: [[0.05; 2]; 2], full: true, joints: [2, 4] });
    for arm in ARMS {
        wood.add(&limb(arm, [0.055, 0.042]));
        wood.add(&limb(arm + 1, [0.048, 0.03]));
        let hand = place(arm + 2);
        wood.add(&Turned {
            ends: [hand - DVec3::Y * 0.02, hand - DVec3::new(0.0, 0.19, -0.01)],
            radii: [[0.026, 0.04]; 2],
            full: true,
            joints: [arm + 2; 2],
        });
        joints.add(&ball(arm, 0.062));
        joints.add(&ball(arm + 1, 0.041));
        joints.add(&ball(arm + 2, 0.03));
    }
    for leg in LEGS {
        wood.add(&limb(leg, [0.088, 0.06]));
        wood.add(&limb(leg + 1, [0.066, 0.04]));
        let x = place(leg)[0];
        wood.add(&spindle([x, 0.035, -0.075], [x, 0.024, 0.147], [[0.044, 0.045], [0.056, 0.036]], leg + 2));
        wood.add(&spindle([x, 0.018, 0.13], [x, 0.014, 0.215], [[0.054, 0.03], [0.046, 0.02]], leg + 3));
        joints.add(&ball(leg, 0.082));
        joints.add(&ball(leg + 1, 0.058));
        joints.add(&ball(leg + 2, 0.042));
    }
    [wood, joints]
}

/// Turns of all joints, and the place of the hips, at a share of a round.
fn walking(round: f64) -> ([DQuat; 19], DVec3) {
    let mut turns = [DQuat::IDENTITY; 19];
    // Quaternions by our own functions: the same file everywhere.
    let about = |axis: DVec3, angle: f64| {
        let (sine, cosine) = sin_cos_f64(0.5 * angle);
        DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine)
    };
    let wave = |from: f64| sin_cos_f64(TAU * (round - from) + 0.5 * PI).0;
    let high = gait::hips(round);
    // Over the foot that stands, and the legs lean to keep feet in place.
    let sway = 0.018 * wave(0.3);
    turns[1] = about(DVec3::X, 0.035) * about(DVec3::Z, 0.9 * sway);
    turns[2] = about(DVec3::Y, 0.16 * wave(0.0)) * about(DVec3::Z, 0.9 * sway);
    turns[3] = about(DVec3::Y, -0.1 * wave(0.0));
    turns[4] = about(DVec3::Y, -0.06 * wave(0.0)) * about(DVec3::X, 0.05);
    for (side, (leg, arm)) in LEGS.into_iter().zip(ARMS).enumerate() {
        let since = 0.5 * side as f64;
        let angles = gait::leg((round - since).rem_euclid(1.0), high);
        turns[leg] = about(DVec3::Z, -sway / high) * about(DVec3::X, angles.thigh);
        turns[leg + 1] = about(DVec3::X, angles.shin);
        turns[leg + 2] = about(DVec3::X, angles.foot);
        turns[leg + 3] = about(DVec3::X, angles.toes);
        let out = if side == 0 { 0.05 } else { -0.05 };
        turns[arm] = about(DVec3::Z, out) * about(DVec3::X, 0.45 * wave(since) + 0.06);
        turns[arm + 1] = about(DVec3::X, 0.16 * wave(since) - 0.4);
        turns[arm + 2] = about(DVec3::X, -0.12);
    }
    (turns, DVec3::new(sway, high + place(0).y - HIP, 0.0))
}

fn short(numbers: impl Iterator<Item = DVec3>) -> Vec<f32> {
    numbers.flat_map(|at| at.as_vec3().to_array()).collect()
}

fn mesh(glb: &mut Glb) -> usize {
    let mut primitives = Vec::new();
    for (skin, [colour, roughness]) in skins().iter().zip([[[0.50, 0.30, 0.13], [0.5; 3]], [[0.24, 0.12, 0.05], [0.4; 3]]]) {
        let count = skin.positions.len();
        let material = json!({"pbrMetallicRoughness":
            {"baseColorFactor": [colour[0], colour[1], colour[2], 1.0], "metallicFactor": 0.0, "roughnessFactor": roughness[0]}});
        let material = glb.push("materials", material);
        let position = glb.floats(&short(skin.positions.iter().copied()), "VEC3");
        // The format asks for the bounds.
        let bounds = skin.positions.iter().fold([DVec3::MAX, DVec3::MIN], |[low, high], at| [low.min(*at), high.max(*at)]);
        glb.json["accessors"][position]["min"] = json!(bounds[0].as_vec3().to_array());
        glb.json["accessors"][position]["max"] = json!(bounds[1].as_vec3().to_array());
        let normal = glb.floats(&short(skin.normals.iter().copied()), "VEC3");
        let joints = glb.accessor(&skin.joints, 5121, "VEC4", count);
        let weights = glb.accessor(&skin.weights, 5121, "VEC4", count);
        glb.json["accessors"][weights]["normalized"] = json!(true);
        let indices: Vec<u8> = skin.triangles.as_flattened().iter().flat_map(|index| index.to_le_bytes()).collect();
        let indices = glb.accessor(&indices, 5123, "SCALAR", 3 * skin.triangles.len());
        primitives.push(json!({"material": material, "indices": indices,
            "attributes": {"POSITION": position, "NORMAL": normal, "JOINTS_0": joints, "WEIGHTS_0": weights}}));
    }
    glb.push("meshes", json!({"primitives": primitives}))
}

/// Nodes of the joints, and the skin.
fn skeleton(glb: &mut Glb) -> usize {
    let mut inverse = Vec::new();
    for (joint, (name, parent, _)) in JOINTS.iter().enumerate() {
        let from = parent.map_or(DVec3::ZERO, place);
        let node = json!({"name": name, "translation": (place(joint) - from).as_vec3().to_array()});
        assert_eq!(if parent.is_some() { glb.push("nodes", node) } else { glb.top(node) }, joint);
        if let Some(parent) = parent {
            let mut children = glb.json["nodes"][*parent]["children"].as_array().cloned().unwrap_or_default();
            children.push(json!(joint));
            glb.json["nodes"][*parent]["children"] = json!(children);
        }
        inverse.extend(glam::Mat4::from_translation(-place(joint).as_vec3()).to_cols_array());
    }
    let matrices = glb.accessor(&bytes_of(&inverse), 5126, "MAT4", JOINTS.len());
    let joints: Vec<usize> = (0..JOINTS.len()).collect();
    glb.push("skins", json!({"joints": joints, "inverseBindMatrices": matrices}))
}

/// Clip `Walk`: a round of two steps, 1.1 m long.
fn walk(glb: &mut Glb) {
    let times: Vec<f32> = (0..=POSES).map(|pose| (ROUND * pose as f64 / POSES as f64) as f32).collect();
    let poses: Vec<_> = (0..=POSES).map(|pose| walking((pose % POSES) as f64 / POSES as f64)).collect();
    let input = glb.floats(&times, "SCALAR");
    glb.json["accessors"][input]["min"] = json!([times[0]]);
    glb.json["accessors"][input]["max"] = json!([times[POSES]]);
    let places = glb.floats(&short(poses.iter().map(|(_, hips)| *hips)), "VEC3");
    let mut samplers = vec![json!({"input": input, "output": places})];
    let mut channels = vec![json!({"sampler": 0, "target": {"node": 0, "path": "translation"}})];
    for joint in 1..JOINTS.len() {
        let turns: Vec<f32> = poses.iter().flat_map(|(turns, _)| turns[joint].as_quat().to_array()).collect();
        let output = glb.floats(&turns, "VEC4");
        channels.push(json!({"sampler": samplers.len(), "target": {"node": joint, "path": "rotation"}}));
        samplers.push(json!({"input": input, "output": output}));
    }
    glb.push("animations", json!({"name": "Walk", "channels": channels, "samplers": samplers}));
}

/// The file.
pub(crate) fn walker() -> Glb {
    let mut glb = Glb::new();
    let skin = skeleton(&mut glb);
    let mesh = mesh(&mut glb);
    glb.top(json!({"name": "lay figure", "mesh": mesh, "skin": skin}));
    walk(&mut glb);
    glb
}
