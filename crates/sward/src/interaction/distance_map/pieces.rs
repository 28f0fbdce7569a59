//! The surface of convex pieces: the bodies a scene describes by shapes, for their distance maps.
//!
//! Methods §4. Our own functions throughout, where the meshes of pictures use the library's: the same map on every machine.

use super::{Cube, DistanceMap};
use crate::interaction::convex::{outline_at, reference, slope};
use crate::interaction::motion::Pose;
use crate::interaction::piece::{Piece, Underside};
use crate::math;

/// Rings of an ellipsoid from pole to pole; twice as many steps around.
const RINGS: u32 = 24;

/// Triangles by the indices of their corners.
#[derive(Clone, Debug, Default, PartialEq)]
struct Surface {
    points: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl DistanceMap {
    /// The map of a body's pieces in the body's frame, `size` texels along a side.
    pub fn of_pieces(pieces: &[Piece], size: u32) -> Self {
        let mut surface = Surface::default();
        for piece in pieces {
            match piece.underside {
                Underside::Ellipsoid { radii } => surface.ellipsoid(piece, radii),
                _ => surface.prism(piece),
            }
        }
        Self::new(Cube::around(&surface.points, size), size, &surface.points, surface.triangles)
    }
}

impl Surface {
    /// An outline between a piece's underside and its upper side.
    fn prism(&mut self, piece: &Piece) {
        let pose = Pose::default();
        let [x, z, height, _] = reference(piece, &pose, pose.ground).map(f64::from);
        let under = slope(piece, &pose).map(f64::from);
        let first = self.points.len() as u32;
        for [px, pz] in outline_at(piece, &pose) {
            let bottom = height + under[0] * (px - x) + under[1] * (pz - z);
            self.points.extend([bottom, height + piece.rise].map(|y| [px as f32, y as f32, pz as f32]));
        }
        let count = (self.points.len() as u32 - first) / 2;
        for k in 0..count {
            let (a, b) = (first + 2 * k, first + 2 * ((k + 1) % count));
            self.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
            if k > 0 && k + 1 < count {
                self.triangles.extend([[first, a, b], [first + 1, a + 1, b + 1]]);
            }
        }
    }

    fn ellipsoid(&mut self, piece: &Piece, radii: [f64; 3]) {
        let pose = Pose::default();
        let [x, z, height, _] = reference(piece, &pose, pose.ground).map(f64::from);
        let first = self.points.len() as u32;
        let part = std::f64::consts::PI / f64::from(RINGS);
        let (turn_sine, turn) = math::sin_cos_f64(piece.yaw);
        for ring in 0..=RINGS {
            let (wide, high) = math::sin_cos_f64(part * f64::from(ring));
            for step in 0..2 * RINGS {
                let (s, c) = math::sin_cos_f64(part * f64::from(step));
                let (a, b) = (radii[0] * wide * s, radii[2] * wide * c);
                let point = [x + turn * a + turn_sine * b, height + radii[1] * high, z - turn_sine * a + turn * b];
                self.points.push(point.map(|part| part as f32));
            }
        }
        let row = 2 * RINGS;
        for ring in 0..RINGS {
            for step in 0..row {
                let [a, b] = [step, (step + 1) % row].map(|step| first + ring * row + step);
                self.triangles.extend([[a, a + row, b], [b, a + row, b + row]]);
            }
        }
    }
}
