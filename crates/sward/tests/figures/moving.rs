//! Clips and skins, and bodies that walk.

use glam::{DMat4, DVec3};
use serde_json::json;
use sward::figure::Figure;
use sward::geometry::figure::figure_mesh;
use sward::model::Assets;
use sward::scene::Scene;
use sward::world::World;

use crate::Test;
use crate::glb::{Glb, block, post, walker};
use crate::splitting::read;

pub(crate) const TESTS: &[Test] = &[
    ("clips_meet_their_keys", clips_meet_their_keys),
    ("a_turn_takes_the_shorter_way_evenly", a_turn_takes_the_shorter_way_evenly),
    ("clips_repeat_or_hold", clips_repeat_or_hold),
    ("skins_follow_their_joints", skins_follow_their_joints),
    ("feet_touch_one_after_another", feet_touch_one_after_another),
    ("a_standing_foot_does_not_push", a_standing_foot_does_not_push),
    ("steps_bend_grass_where_feet_stand", steps_bend_grass_where_feet_stand),
    ("a_body_is_placed_as_the_scene_says", a_body_is_placed_as_the_scene_says),
    ("a_clip_that_ends_elsewhere_jumps_back", a_clip_that_ends_elsewhere_jumps_back),
    ("walking_has_the_same_bits_far_away", walking_has_the_same_bits_far_away),
    ("two_ways_to_store_are_one_body", two_ways_to_store_are_one_body),
];

/// One file under one name.
pub(crate) struct One(pub(crate) &'static str, pub(crate) Vec<u8>);

impl Assets for One {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        if path == self.0 { Ok(self.1.clone()) } else { Err(format!("{path} is missing")) }
    }
}

/// A world with `bodies` (the list in RON) on a lawn; `walker.glb` is what `glb` holds.
pub(crate) fn world(glb: &Glb, bodies: &str) -> World {
    let text = format!("(version: 1, stands: [(species: Meadow)], interactors: [{bodies}])");
    let scene = Scene::parse(&text, "test.ron").unwrap_or_else(|error| panic!("{error}"));
    World::new(scene, &One("walker.glb", glb.bytes())).unwrap_or_else(|error| panic!("{error}"))
}

/// A figure of one block moved by one clip.
fn moved(path: &str, interpolation: &str, times: &[f32], values: &[f32]) -> Figure {
    let mut glb = Glb::new();
    let (positions, triangles) = block([-0.5; 3], [0.5; 3]);
    let mesh = glb.mesh(&positions, &triangles, json!({}));
    let node = glb.top(json!({"mesh": mesh}));
    glb.clip("C", node, path, interpolation, times, values);
    read(&glb, 1)
}

fn clips_meet_their_keys() {
    let at = |figure: &Figure, time: f64| figure.pose(Some(0), time)[0].transform_point3(DVec3::ZERO);
    let values = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 4.0, 0.0];
    let linear = moved("translation", "LINEAR", &[1.0, 2.0, 4.0], &values);
    let step = moved("translation", "STEP", &[1.0, 2.0, 4.0], &values);
    for (time, even, held) in [
        (0.0, [0.0, 0.0], [0.0, 0.0]),
        (1.5, [1.0, 0.0], [0.0, 0.0]),
        (2.0, [2.0, 0.0], [2.0, 0.0]),
        (3.0, [2.0, 2.0], [2.0, 0.0]),
        (9.0, [2.0, 4.0], [2.0, 4.0]),
    ] {
        assert_eq!(at(&linear, time).truncate().to_array(), even, "linear at {time}");
        assert_eq!(at(&step, time).truncate().to_array(), held, "step at {time}");
    }
    // From 0 to 1 within 2 s, leaving at 3 units a second and arriving at rest: Hermite.
    let cubic = moved("translation", "CUBICSPLINE", &[0.0, 2.0], &[0., 0., 0., 0., 0., 0., 3., 0., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0.]);
    for s in [0.0_f64, 0.25, 0.5, 0.9, 1.0] {
        let expected = 3.0 * s * s - 2.0 * s * s * s + 6.0 * (s * s * s - 2.0 * s * s + s);
        assert!((at(&cubic, 2.0 * s).x - expected).abs() < 1e-12, "cubic at {s}");
    }
    let scale = moved("scale", "LINEAR", &[0.0, 1.0], &[1.0, 1.0, 1.0, 3.0, 1.0, 1.0]);
    assert_eq!(scale.pose(Some(0), 0.5)[0].transform_vector3(DVec3::ONE), DVec3::new(2.0, 1.0, 1.0));
    assert_eq!(scale.pose(None, 0.5)[0], DMat4::IDENTITY);
}

fn a_turn_takes_the_shorter_way_evenly() {
    let (s, c) = (0.6_f64.sin() as f32, 0.6_f64.cos() as f32);
    // The same turn of 1.2 rad about y, its quaternion once with each sign.
    for sign in [1.0, -1.0] {
        let figure = moved("rotation", "LINEAR", &[0.0, 1.0], &[0.0, 0.0, 0.0, 1.0, 0.0, sign * s, 0.0, sign * c]);
        for share in [0.0, 0.2, 0.5, 0.9, 1.0] {
            let ahead = figure.pose(Some(0), share)[0].transform_vector3(DVec3::Z);
            let angle = ahead.x.atan2(ahead.z);
            assert!((angle - 1.2 * share).abs() < 1e-6, "{angle} rad at {share}");
            assert!((ahead.length() - 1.0).abs() < 1e-12);
        }
    }
}

fn clips_repeat_or_hold() {
    let figure = moved("translation", "LINEAR", &[1.0, 3.0], &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    let clip = &figure.clips[0];
    assert_eq!((clip.begin, clip.end), (1.0, 3.0));
    for (elapsed, speed, start, round, once) in [
        (0.0, 1.0, 0.0, 1.0, 1.0),
        (2.5, 1.0, 0.0, 1.5, 3.0),
        (0.5, 2.0, 0.5, 2.5, 2.5),
        (0.5, -1.0, 0.0, 2.5, 1.0),
        (1e6, 1.0, 0.25, 1.25, 3.0),
    ] {
        assert_eq!(clip.time(elapsed, speed, start, true), round, "{elapsed} s on");
        assert_eq!(clip.time(elapsed, speed, start, false), once, "{elapsed} s on, once");
    }
}

fn skins_follow_their_joints() {
    let figure = read(&post(), 8);
    assert_eq!((figure.frames.len(), figure.parts.len()), (2, 2), "one part a joint, whatever `pieces` is");
    let tall = |clip, time| {
        let frames = figure.pose(clip, time);
        let posed: Vec<_> = figure.parts.iter().map(|part| part.posed(&frames[part.frame as usize]).expect("in bounds")).collect();
        posed
    };
    // The node's own shift by (5, 5, 5) does not move a skin.
    let rest = tall(None, 0.0);
    assert!((rest[0].lowest, rest[0].under[0]) == (0.0, 0.0) && (rest[1].lowest - 1.5).abs() < 1e-9, "{rest:?}");
    // Bowed by a right angle about x at 1 m the upper half lies along +z.
    let bowed = tall(Some(0), 1.0);
    assert_eq!(bowed[0], rest[0]);
    assert!((bowed[1].lowest - 0.9).abs() < 1e-6 && (bowed[1].under[2] - 0.75).abs() < 1e-6, "{bowed:?}");
    let world = world(&post(), "(shape: Mesh(file: \"walker.glb\", clip: \"Bow\", repeat: false))");
    let body = world.model.bodies[0].figure.as_ref().expect("a figure");
    let mesh = figure_mesh(body, 1.0);
    let far = mesh.vertices.iter().map(|vertex| vertex.position[2]).fold(f32::MIN, f32::max);
    assert!((far - 1.0).abs() < 1e-5, "the tip reaches {far} m ahead");
    let still = figure_mesh(body, 0.0);
    // The middle ring at 1 m follows both joints by half: its edges are half way between staying and lying down.
    let ring: Vec<f32> =
        still.vertices.iter().zip(&mesh.vertices).filter(|(a, _)| a.position[1] == 1.0).map(|(_, b)| b.position[2]).collect();
    assert!(ring.len() >= 4 && ring.iter().all(|z| (z.abs() - 0.05).abs() < 1e-5), "{ring:?}");
    assert!(still.vertices.iter().zip(&mesh.vertices).any(|(a, b)| a.position != b.position));
    assert!(mesh.vertices.iter().all(|vertex| (glam::Vec3::from(vertex.normal).length() - 1.0).abs() < 1e-4));
}

const WALK: &str =
    "(shape: Mesh(file: \"walker.glb\", pieces: 1, clip: \"Walk\"), path: Keyframes(keys: [(time: 0, at: (0, 0)), (time: 4, at: (0, 4))]))";

/// Heights of the left and the right foot during the last step.
fn feet(world: &World) -> [f64; 2] {
    let (body, state) = (&world.model.bodies[0], &world.state.bodies[0]);
    let lowest = |k: usize| body.pieces_between(state)[k].iter().map(|piece| piece.offset[1]).fold(f64::MAX, f64::min);
    [lowest(1), lowest(2)]
}

fn feet_touch_one_after_another() {
    let mut world = world(&walker(), WALK);
    for step in 0..120 {
        world.step();
        let [left, right] = feet(&world);
        let phase = (f64::from(step) + 0.5) / 60.0 % 1.0;
        // In the middle of each half one foot stands and the other swings.
        if (phase - 0.25).abs() < 0.2 {
            assert!(left < 0.001 && right > 0.01, "{phase}: {left}, {right}");
        } else if (phase - 0.75).abs() < 0.2 {
            assert!(right < 0.001 && left > 0.01, "{phase}: {left}, {right}");
        }
    }
}

/// Speeds of the pieces that touch in the coming step: of the trunk, the left and the right leg.
fn speeds(world: &mut World) -> Vec<f32> {
    let plan = world.plan();
    let reports = Vec::new();
    let speeds = plan.stands[0].contacts.iter().map(|contact| contact.velocity[0].hypot(contact.velocity[1])).collect();
    world.finish(reports);
    speeds
}

fn a_standing_foot_does_not_push() {
    let mut walking = world(&walker(), WALK);
    // In the middle of the way the body goes 1 m/s, and the standing foot goes back as fast.
    (0..75).for_each(|_| walking.step());
    let speeds = speeds(&mut walking);
    assert_eq!(speeds.len(), 3);
    assert!((speeds[0] - 1.0).abs() < 0.01, "trunk: {speeds:?}");
    assert!(speeds[1] < 0.01 && speeds[2] > 1.5, "left foot stands, right foot swings: {speeds:?}");
}

fn steps_bend_grass_where_feet_stand() {
    let bent = |bodies: &str| {
        let mut world = world(&walker(), bodies);
        (0..150).for_each(|_| world.step());
        let bend = |x: f64, z: f64| world.bend_at(0, [x, z]).map_or(0.0, |b| b[0].hypot(b[1]));
        // Where the left foot has stood from 2.0 s on, and the grass far beside.
        [bend(0.375, 2.125), bend(-2.0, 2.125)]
    };
    let [under, beside] = bent(WALK);
    assert!(under > 0.5 && beside < 0.05, "{under} under the foot, {beside} beside");
    let [high, _] = bent(&WALK.replace("path:", "clearance: 0.6, path:"));
    assert!(high < 0.2, "control: a body above the grass bends {high}");
}

fn a_body_is_placed_as_the_scene_says() {
    let mut glb = Glb::new();
    let (positions, triangles) = block([-50.0, -20.0, 0.0], [50.0, 80.0, 300.0]);
    let mesh = glb.mesh(&positions, &triangles, json!({}));
    glb.top(json!({"mesh": mesh}));
    let piece = |more: &str| {
        let world = world(&glb, &format!("(shape: Mesh(file: \"walker.glb\", scale: 0.01{more}))"));
        let piece = world.model.bodies[0].pieces[0].clone();
        let reach = |axis: usize, pick: fn(f64, f64) -> f64| piece.outline.iter().map(|p| p[axis]).fold(piece.outline[0][axis], pick);
        [reach(0, f64::min), reach(0, f64::max), reach(1, f64::min), reach(1, f64::max), piece.offset[1]]
    };
    let near = |found: [f64; 5], expected: [f64; 5]| {
        assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?} instead of {expected:?}");
    };
    near(piece(""), [-0.5, 0.5, 0.0, 3.0, 0.0]);
    near(piece(", grounded: false"), [-0.5, 0.5, 0.0, 3.0, -0.2]);
    near(piece(", offset: (1, 0.5, -1)"), [0.5, 1.5, -1.0, 2.0, 0.5]);
    // The front looks along +x in the file: −π/2 brings it to +z.
    near(piece(", yaw: 3.14159265"), [-0.5, 0.5, -3.0, 0.0, 0.0]);
    near(piece(", yaw: 1.57079633"), [0.0, 3.0, -0.5, 0.5, 0.0]);
}

fn a_clip_that_ends_elsewhere_jumps_back() {
    let mut glb = Glb::new();
    let (positions, triangles) = block([-0.2, 0.0, -0.2], [0.2, 0.4, 0.2]);
    let mesh = glb.mesh(&positions, &triangles, json!({}));
    let node = glb.top(json!({"mesh": mesh}));
    glb.clip("Go", node, "translation", "LINEAR", &[0.0, 1.0], &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    let mut world = world(&glb, "(shape: Mesh(file: \"walker.glb\", clip: \"Go\"))");
    let mut fastest: f32 = 0.0;
    for _ in 0..130 {
        let speeds = speeds(&mut world);
        fastest = speeds.into_iter().fold(fastest, f32::max);
    }
    assert!((1.9..2.1).contains(&fastest), "2 m/s on its way, and nothing on the way back: {fastest} m/s");
}

fn walking_has_the_same_bits_far_away() {
    let walk = |shift: f64, origin: i32| {
        let text = format!(
            "(version: 1, origin: ({origin}, 0), stands: [(species: Meadow)], camera: (eye: ({shift:?}, 2.0, -5.0), target: ({shift:?}, 0.0, 3.0)),
             interactors: [(shape: Mesh(file: \"walker.glb\", clip: \"Walk\"),
                path: Keyframes(keys: [(time: 0, at: ({shift:?}, 0)), (time: 4, at: ({:?}, 4))]))])",
            shift + 0.5
        );
        let scene = Scene::parse(&text, "test.ron").unwrap_or_else(|error| panic!("{error}"));
        let mut world = World::new(scene, &One("walker.glb", walker().bytes())).unwrap_or_else(|error| panic!("{error}"));
        (0..90).for_each(|_| world.step());
        world.hash()
    };
    let shift = 8000.0 * 32.0;
    assert_eq!(walk(0.0, 0), walk(shift, 8000));
    assert_ne!(walk(0.0, 0), walk(shift + 0.25, 8000), "control: a cell farther");
}

fn two_ways_to_store_are_one_body() {
    let glb = walker();
    let whole = read(&glb, 4);
    let mut json = glb.json.clone();
    json["buffers"] = json!([{"byteLength": glb.binary.len(), "uri": "my%20walker.bin"}]);
    let beside = |name: &str| if name == "my walker.bin" { Ok(glb.binary.clone()) } else { Err("missing".to_owned()) };
    let apart = Figure::read(json.to_string().as_bytes(), &beside, 4).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((&whole.parts, &whole.clips, &whole.vertices), (&apart.parts, &apart.clips, &apart.vertices));
    let digits = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let base64: String = glb
        .binary
        .chunks(3)
        .flat_map(|three| {
            let word = three.iter().fold(0_u32, |word, byte| word << 8 | u32::from(*byte)) << (8 * (3 - three.len()));
            (0..4).map(move |k| if k <= three.len() { digits[(word >> (18 - 6 * k) & 63) as usize] as char } else { '=' })
        })
        .collect();
    json["buffers"][0]["uri"] = json!(format!("data:application/octet-stream;base64,{base64}"));
    let embedded = Figure::read(json.to_string().as_bytes(), &|_| Err("nothing is beside it".to_owned()), 4);
    assert_eq!(embedded.unwrap_or_else(|error| panic!("{error}")).vertices, whole.vertices);
}
