//! Bodies made by others.

use std::time::Instant;

use glam::{DMat4, Vec3};
use sward::figure::Figure;
use sward::geometry::figure::figure_mesh;
use sward::model::Folder;
use sward::scene::Scene;
use sward::world::World;

use crate::splitting::{outside, under};
use crate::{Test, shared};

pub(crate) const TESTS: &[Test] = &[
    ("given_bodies_have_the_sizes_written_down", given_bodies_have_the_sizes_written_down),
    ("given_bodies_lie_within_their_parts", given_bodies_lie_within_their_parts),
    ("trucks_stand_on_wheels", trucks_stand_on_wheels),
    ("tori_keep_their_holes", tori_keep_their_holes),
    ("given_figures_walk", given_figures_walk),
    ("every_clip_plays", every_clip_plays),
];

/// Name, size in file units, triangles, clips.
const BODIES: [(&str, [f32; 3], usize, usize); 8] = [
    ("truck_green", [1.5, 1.4, 2.9], 1104, 0),
    ("truck_yellow", [1.5, 1.55, 2.8], 989, 0),
    ("motorcycle", [1.1, 1.3, 2.4], 960, 0),
    ("hovercraft", [2.8, 0.9, 2.2], 322, 0),
    ("torus_pair", [2.5, 2.5, 2.5], 3072, 0),
    ("fox", [25.0, 79.0, 155.0], 576, 3),
    ("knight", [2.5, 2.5, 2.0], 5296, 10),
    ("robot", [1.2, 1.1, 0.6], 550, 4),
];

fn read(name: &str, pieces: u32) -> Figure {
    let path = shared().expect("ignored without it").join(format!("{name}.glb"));
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    Figure::read(&bytes, &|name| Err(format!("{name} is missing")), pieces).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn world(bodies: &str) -> World {
    let text = format!("(version: 1, stands: [(species: Meadow)], interactors: [{bodies}])");
    let scene = Scene::parse(&text, "test.ron").unwrap_or_else(|error| panic!("{error}"));
    World::new(scene, &Folder(shared().expect("ignored without it"))).unwrap_or_else(|error| panic!("{error}"))
}

/// Where each vertex is, at rest.
fn positions(figure: &Figure) -> Vec<Vec3> {
    let frames = figure.pose(None, 0.0);
    let blend = |vertex: &sward::figure::FigureVertex| {
        let parts = vertex.frames.iter().zip(vertex.weights);
        parts.map(|(frame, weight)| frames[usize::from(*frame)].as_mat4().transform_point3(vertex.position.into()) * weight).sum()
    };
    figure.vertices.iter().map(blend).collect()
}

fn given_bodies_have_the_sizes_written_down() {
    for (name, size, triangles, clips) in BODIES {
        let begin = Instant::now();
        let figure = read(name, 8);
        let points = positions(&figure);
        let (low, high) = points.iter().fold((Vec3::MAX, Vec3::MIN), |(low, high), point| (low.min(*point), high.max(*point)));
        println!("{name}: {} frames, {} parts, {} ms", figure.frames.len(), figure.parts.len(), begin.elapsed().as_millis());
        assert_eq!((figure.triangles.len(), figure.clips.len()), (triangles, clips), "{name}");
        let off = ((high - low) / Vec3::from(size) - Vec3::ONE).abs();
        assert!(off.max_element() < 0.06, "{name}: {} instead of {size:?}", high - low);
    }
}

fn given_bodies_lie_within_their_parts() {
    for (name, size, ..) in BODIES {
        let figure = read(name, 8);
        let mut worst = 0.0_f64;
        for vertex in &figure.vertices {
            let strongest = (1..4).fold(0, |best, k| if vertex.weights[k] > vertex.weights[best] { k } else { best });
            let parts = figure.parts.iter().filter(|part| part.frame == u32::from(vertex.frames[strongest]) && !part.faces.is_empty());
            let away = parts.map(|part| outside(part, Vec3::from(vertex.position).as_dvec3())).fold(f64::MAX, f64::min);
            worst = worst.max(if away == f64::MAX { 0.0 } else { away });
        }
        let share = worst / f64::from(size[0].max(size[1]).max(size[2]));
        println!("{name}: a vertex lies at most {:.1} % of its size outside its part", 100.0 * share);
        assert!(share < 0.02, "{name}: {share}");
    }
}

fn trucks_stand_on_wheels() {
    for name in ["truck_green", "truck_yellow"] {
        let world = world(&format!("(shape: Mesh(file: \"{name}.glb\", scale: 1.6))"));
        let undersides: Vec<[f64; 3]> = world.model.bodies[0].pieces.iter().map(|piece| piece.offset).collect();
        let wheels: Vec<&[f64; 3]> = undersides.iter().filter(|under| under[1] < 0.05).collect();
        assert!(wheels.len() >= 4, "{name}: {undersides:?}");
        for (x, z) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
            assert!(wheels.iter().any(|under| under[0] * x > 0.4 && under[2] * z > 0.4), "{name}: a corner has no wheel: {wheels:?}");
        }
        let middle = undersides.iter().filter(|under| under[0].abs() < 0.3).map(|under| under[1]).fold(f64::MAX, f64::min);
        assert!(middle > 0.2, "{name}: the body floats {middle} m above the ground");
    }
}

fn tori_keep_their_holes() {
    // The standing torus: nothing is under its hole's middle but its lower and its upper arc; seen from above the lying one has a hole.
    let figure = read("torus_pair", 24);
    let points = positions(&figure);
    let frames = figure.pose(None, 0.0);
    let inside =
        |at: glam::DVec3| figure.parts.iter().any(|part| outside(part, frames[part.frame as usize].inverse().transform_point3(at)) < 0.0);
    let (mut solid, mut empty) = (0, 0);
    for k in 0..20_000_u32 {
        let part = |purpose| f64::from(sward::math::unit(sward::math::hash(5, 0, 0, k, purpose))) * 2.6 - 1.3;
        let at = glam::DVec3::new(part(1), part(2), part(3));
        let near = points.iter().map(|point| point.as_dvec3().distance(at)).fold(f64::MAX, f64::min);
        // A tube is 0.25 thick about its ring: farther from every vertex than that is air.
        if near > 0.3 {
            (solid, empty) = (solid + u32::from(inside(at)), empty + 1);
        }
    }
    let filled = f64::from(solid) / f64::from(empty);
    println!("{} parts fill {:.1} % of the air around two tori", figure.parts.len(), 100.0 * filled);
    let hull = read("torus_pair", 1);
    assert_eq!(hull.parts.len(), 1);
    assert!(filled < 0.1);
    assert!(under(&hull.parts, [0.0, 0.0]).is_some());
    assert!(outside(&hull.parts[0], DMat4::IDENTITY.transform_point3(glam::DVec3::ZERO)) < -0.3, "control: the hull has no hole");
}

fn given_figures_walk() {
    for (file, scale, clip, left, right) in [
        ("knight", 0.7, "Walking_A", "foot.l", "foot.r"),
        ("fox", 0.007, "Walk", "LeftFoot", "RightFoot"),
        ("robot", 1.0, "walk", "leg-left", "leg-right"),
    ] {
        let world = world(&format!("(shape: Mesh(file: \"{file}.glb\", scale: {scale}, clip: \"{clip}\"))"));
        let body = world.model.bodies[0].figure.as_ref().expect("a figure");
        let length = body.figure.clips.iter().find(|known| known.name == clip).map(|clip| clip.end - clip.begin).expect("a clip");
        let part_of = |name: &str| {
            let found = body.figure.parts.iter().position(|part| {
                let node = &body.figure.nodes[body.figure.frames[part.frame as usize].node as usize];
                node.name.to_lowercase().contains(&name.to_lowercase())
            });
            found.unwrap_or_else(|| {
                let names: Vec<&str> = body
                    .figure
                    .parts
                    .iter()
                    .map(|part| body.figure.nodes[body.figure.frames[part.frame as usize].node as usize].name.as_str())
                    .collect();
                panic!("{file} has no part {name}: {names:?}")
            })
        };
        let (left, right) = (part_of(left), part_of(right));
        let (mut lowest, mut ups) = (f64::MAX, [0; 2]);
        for moment in 0..40 {
            let frames = body.pose(length * f64::from(moment) / 40.0);
            let heights = body.figure.parts.iter().map(|part| part.posed(&frames[part.frame as usize]).map_or(0.0, |posed| posed.lowest));
            let heights: Vec<f64> = heights.collect();
            let height = |part: usize| heights[part];
            lowest = heights.iter().copied().fold(lowest, f64::min);
            let (a, b) = (height(left), height(right));
            ups[0] += usize::from(a > b + 0.02);
            ups[1] += usize::from(b > a + 0.02);
        }
        println!("{file}: lowest {lowest:.3} m; left foot higher {} times, right {} times of 40", ups[0], ups[1]);
        assert!(lowest.abs() < 0.03, "{file} stands at {lowest} m");
        assert!(ups[0] >= 5 && ups[1] >= 5, "{file}: {ups:?}");
    }
}

fn every_clip_plays() {
    let mut clips = 0;
    for (file, scale) in [("fox", 0.007), ("knight", 0.7), ("robot", 1.0)] {
        for clip in read(file, 1).clips {
            let world = world(&format!("(shape: Mesh(file: \"{file}.glb\", scale: {scale}, pieces: 1, clip: \"{}\"))", clip.name));
            let body = world.model.bodies[0].figure.as_ref().expect("a figure");
            let (first, later) = (figure_mesh(body, 0.0), figure_mesh(body, 0.4 * (clip.end - clip.begin)));
            let moved = first.vertices.iter().zip(&later.vertices).filter(|(a, b)| a.position != b.position).count();
            assert!(moved > 0 || clip.name == "static", "{file}, {}: nothing moves", clip.name);
            for vertex in later.vertices {
                assert!(
                    vertex.position.iter().all(|part| part.abs() < 5.0) && Vec3::from(vertex.normal).is_normalized(),
                    "{file}: {vertex:?}"
                );
            }
            clips += 1;
        }
    }
    assert_eq!(clips, 17);
}
