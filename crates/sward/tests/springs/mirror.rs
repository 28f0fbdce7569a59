//! Left and right are alike.

use glam::Vec3;
use sward::geometry::mesh::{Mesh, PAINT};
use sward::interaction::distance_map::{DistanceMap, DistanceMapHead};
use sward::response::springs::{Maps, SheetRoot};

use crate::Test;
use crate::bodies::prism;
use crate::field::{Plant, coefficients, head, root};

pub(crate) const TESTS: &[Test] = &[("a_mirrored_pass_is_the_mirror_image", a_mirrored_pass_is_the_mirror_image)];

/// Largest distance between billboards passed at `side` and, mirrored, at `other_side`, m.
fn apart(maps: &[DistanceMap; 2], side: f32, other_side: f32) -> f32 {
    let co = coefficients(3, 3);
    let mut most = 0.0f32;
    for yaw in [0.0f32, 0.4, 1.2] {
        let one = root(0.0, 0.0, yaw, 0.4);
        let other = SheetRoot { half_width: [-one.half_width[0], one.half_width[1]], ..one };
        let mut plants = [Plant::new(&co, one), Plant::new(&co, other)];
        for frame in 0..160 {
            for ((plant, map), x) in plants.iter_mut().zip(maps).zip([side, -other_side]) {
                let heads: [DistanceMapHead; 1] = [head(map, 0, Vec3::new(x, 0.0, frame as f32 * 0.025 - 1.5), 0.0)];
                plant.step(&co, &Maps { heads: &heads, texels: &map.texels }, [0.0, 1.0]);
            }
            for (a, b) in plants[0].shown.at.iter().zip(&plants[1].shown.at) {
                most = most.max(Vec3::from(*a).distance(Vec3::new(-b[0], b[1], b[2])));
            }
        }
    }
    most
}

/// A body's map and that of its mirror image.
fn both(mesh: &Mesh) -> [DistanceMap; 2] {
    let mut other = mesh.clone();
    other.vertices.iter_mut().for_each(|vertex| vertex.position[0] = -vertex.position[0]);
    [mesh, &other].map(|mesh| mesh.distance_map(64))
}

fn a_mirrored_pass_is_the_mirror_image() {
    let mut egg = Mesh::ellipsoid(Vec3::new(0.25, 0.9, 0.25), 48, PAINT);
    egg.vertices.iter_mut().for_each(|vertex| vertex.position[1] += 0.9);
    let block = prism(&[[-0.25, -0.15], [0.25, -0.15], [0.25, 0.15], [-0.25, 0.15]], 1.8);
    for (name, mesh) in [("round", egg), ("box", block)] {
        let maps = both(&mesh);
        let mut most = 0.0f32;
        for side in [0.05, 0.13, 0.21, 0.3] {
            most = most.max(apart(&maps, side, side));
        }
        let shifted = apart(&maps, 0.13, 0.14);
        println!("{name}: mirror images are {:.4} mm apart; a centimetre beside {:.1} mm", most * 1e3, shifted * 1e3);
        assert!(most < 1e-4, "{name}: {most}");
        assert!(shifted > 1e-3, "{name}: another place must show: {shifted}");
    }
}
