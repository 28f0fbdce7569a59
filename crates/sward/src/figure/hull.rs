//! Convex hulls of integer points, exactly.
//!
//! Incremental: each point replaces the faces it sees by a fan to their rim. Tests are exact in whole numbers, so nothing depends on rounding;
//! callers shake their points a little, so that no four lie in a plane and no case is degenerate.

use crate::math::hash;

/// Points are below this in size: then every determinant fits 64 bits.
pub(super) const LARGEST: f64 = 65536.0;

type Point = [i64; 3];

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> i64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A whole point moved by up to 3 units in each direction, by its number.
pub(super) fn shaken(point: Point, number: u32) -> Point {
    let by = hash(0x5a4e, 0, 0, number, 0);
    [0, 1, 2].map(|axis| point[axis] + i64::from(by >> (8 * axis) & 7) - 3)
}

struct Face {
    corners: [u32; 3],
    normal: Point,
    offset: i64,
}

impl Face {
    fn new(points: &[Point], corners: [u32; 3]) -> Self {
        let [a, b, c] = corners.map(|index| points[index as usize]);
        let normal = cross(minus(b, a), minus(c, a));
        Self { corners, normal, offset: dot(normal, a) }
    }

    fn sees(&self, point: Point) -> bool {
        dot(self.normal, point) > self.offset
    }
}

/// Four points that span a volume, the first three counter-clockwise seen from outside.
fn start(points: &[Point]) -> Option<[u32; 4]> {
    let a = *points.first()?;
    let b = (1..points.len()).find(|k| points[*k] != a)?;
    let along = minus(points[b], a);
    let c = (1..points.len()).find(|k| cross(along, minus(points[*k], a)) != [0; 3])?;
    let normal = cross(along, minus(points[c], a));
    let d = (1..points.len()).find(|k| dot(normal, minus(points[*k], a)) != 0)?;
    let (b, c, d) = (b as u32, c as u32, d as u32);
    Some(if dot(normal, minus(points[d as usize], a)) < 0 { [0, b, c, d] } else { [0, c, b, d] })
}

/// Triangles of the convex hull, counter-clockwise seen from outside; none where the points span no volume.
pub(super) fn hull(points: &[Point]) -> Vec<[u32; 3]> {
    let Some([a, b, c, d]) = start(points) else { return Vec::new() };
    let mut faces: Vec<Face> = [[a, b, c], [a, d, b], [b, d, c], [c, d, a]].into_iter().map(|corners| Face::new(points, corners)).collect();
    let mut rim: Vec<[u32; 2]> = Vec::new();
    for (number, &point) in points.iter().enumerate() {
        rim.clear();
        faces.retain(|face| {
            let seen = face.sees(point);
            if seen {
                let [a, b, c] = face.corners;
                for edge in [[a, b], [b, c], [c, a]] {
                    // An edge between two seen faces is met once in each direction.
                    match rim.iter().position(|other| *other == [edge[1], edge[0]]) {
                        Some(other) => drop(rim.swap_remove(other)),
                        None => rim.push(edge),
                    }
                }
            }
            !seen
        });
        faces.extend(rim.iter().map(|edge| Face::new(points, [edge[0], edge[1], number as u32])));
    }
    faces.into_iter().map(|face| face.corners).collect()
}

/// Six times the volume within a closed surface.
pub(super) fn volume(points: &[Point], faces: &[[u32; 3]]) -> i64 {
    let Some(&origin) = points.first() else { return 0 };
    let at = |index: u32| minus(points[index as usize], origin);
    faces.iter().map(|face| dot(at(face[0]), cross(at(face[1]), at(face[2])))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hulls_enclose_all_points_and_the_right_volume() {
        for seed in 0..40 {
            let points: Vec<Point> = (0..60).map(|k| [0, 1, 2].map(|axis| i64::from(hash(seed, axis, 0, k, 1) % 60000))).collect();
            let faces = hull(&points);
            assert!(faces.len() >= 4 && faces.len() <= 2 * 60 - 4, "{}", faces.len());
            for face in &faces {
                let face = Face::new(&points, *face);
                assert!(!points.iter().any(|point| face.sees(*point)));
            }
        }
        let cube: Vec<Point> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2].map(|bit| bit * 1000)).collect();
        let shaken: Vec<Point> = cube.iter().zip(0..).map(|(point, number)| shaken(*point, number)).collect();
        let size = volume(&shaken, &hull(&shaken)) as f64 / 6e9;
        assert!((size - 1.0).abs() < 0.02, "{size}");
        assert_eq!(volume(&cube, &hull(&cube)), 6_000_000_000, "without shaking too");
    }

    #[test]
    fn what_spans_no_volume_has_no_hull() {
        for points in [vec![], vec![[1, 2, 3]; 5], (0..9).map(|k| [k, 2 * k, 5]).collect(), (0..9).map(|k| [k % 3, k / 3, 7]).collect()] {
            assert!(hull(&points).is_empty(), "{points:?}");
        }
    }
}
