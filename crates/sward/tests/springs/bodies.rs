//! Bodies to walk with, and how a point lies to them, exactly.

use glam::{Vec2, Vec3};
use sward::geometry::mesh::{Mesh, PAINT};
use sward::interaction::distance_map::DistanceMap;
use sward::interaction::{Piece, Underside};

/// A body, its map, and its signed distance (exact for boxes, to first order for ellipsoids).
pub(crate) struct Body {
    pub(crate) name: &'static str,
    pub(crate) map: DistanceMap,
    pub(crate) distance: Box<dyn Fn(Vec3) -> f32>,
    /// Half of its extent along z, m.
    pub(crate) half_length: f32,
}

/// A box that begins `lift` m above the ground, of the core's own pieces.
pub(crate) fn block(name: &'static str, size: Vec3, lift: f32, texels: u32) -> Body {
    let half = 0.5 * size.as_dvec3();
    let outline = vec![[-half.x, -half.z], [half.x, -half.z], [half.x, half.z], [-half.x, half.z]];
    let piece = Piece { outline, underside: Underside::Plane, offset: [0.0, f64::from(lift), 0.0], rise: f64::from(size.y), yaw: 0.0 };
    let distance = move |p: Vec3| {
        let off = (p - Vec3::Y * (lift + 0.5 * size.y)).abs() - 0.5 * size;
        let outside = off.max(Vec3::ZERO).length();
        if outside > 0.0 { outside } else { off.max_element() }
    };
    Body { name, map: DistanceMap::of_pieces(&[piece], texels), distance: Box::new(distance), half_length: 0.5 * size.z }
}

/// An ellipsoid whose lowest point is `lift` m above the ground, of a mesh of `rings` rings.
pub(crate) fn egg(name: &'static str, radii: Vec3, lift: f32, texels: u32, rings: u32) -> Body {
    let mut mesh = Mesh::ellipsoid(radii, rings, PAINT);
    mesh.vertices.iter_mut().for_each(|vertex| vertex.position[1] += lift + radii.y);
    let distance = move |p: Vec3| {
        let own = (p - Vec3::Y * (lift + radii.y)) / radii;
        let share = own.length();
        share * (share - 1.0) / (own / radii).length().max(1e-6)
    };
    Body { name, map: mesh.distance_map(texels), distance: Box::new(distance), half_length: radii.z }
}

/// A mesh of points and triangles for inside tests.
pub(crate) fn prism(points: &[[f32; 2]], height: f32) -> Mesh {
    Mesh::prism(&points.iter().map(|p| Vec2::from(*p)).collect::<Vec<_>>(), height, PAINT)
}
