//! Where the vertices of a figure are while a clip plays, for pictures and for distance maps alike.
//!
//! Linear blend skinning, glTF 2.0 §3.7.3.3, in f64: the same bits everywhere.

use glam::DMat4;

use super::distance_map::{Cube, DistanceMap};
use super::figure::FigureBody;
use crate::figure::FigureVertex;
use crate::math;

/// Moments of a clip at which its farthest points are looked for.
const MOMENTS: u32 = 32;

/// From a vertex's own space to the body's frame: its frames, weighted.
pub fn blended(frames: &[DMat4], vertex: &FigureVertex) -> DMat4 {
    let frame = |k: usize| frames.get(usize::from(vertex.frames[k])).copied().unwrap_or(DMat4::IDENTITY) * f64::from(vertex.weights[k]);
    let mut matrix = frame(0);
    for k in (1..4).filter(|k| vertex.weights[*k] > 0.0) {
        matrix += frame(k);
    }
    matrix
}

impl FigureBody {
    /// Where each vertex is, m in the body's frame, `elapsed` seconds after the body appeared.
    pub fn points(&self, elapsed: f64) -> Vec<[f32; 3]> {
        let frames = self.pose(elapsed);
        let place = |vertex: &FigureVertex| {
            blended(&frames, vertex).transform_point3(glam::Vec3::from(vertex.position).as_dvec3()).as_vec3().to_array()
        };
        self.figure.vertices.iter().map(place).collect()
    }

    /// How far any vertex moves within the body from one moment to another, m: limbs are faster than the body.
    pub fn stride(&self, from: f64, to: f64) -> f32 {
        let mut most = 0.0;
        for (a, b) in self.points(from).iter().zip(&self.points(to)) {
            let way = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
            most = math::upper(way[0] * way[0] + way[1] * way[1] + way[2] * way[2], most);
        }
        most.sqrt()
    }

    /// The cube around the body over its whole clip, so that texels stay where they are on it; `size` texels along a side.
    pub fn cube(&self, size: u32) -> Cube {
        let moments = if self.is_animated() { MOMENTS } else { 1 };
        let at = |moment: u32| self.points(self.period() * f64::from(moment) / f64::from(moments));
        let points: Vec<[f32; 3]> = (0..moments).flat_map(at).collect();
        Cube::around(&points, size)
    }

    /// The depth cube map of the body, `elapsed` seconds after it appeared, in a cube as [`Self::cube`] gives it.
    pub fn distance_map(&self, cube: Cube, size: u32, elapsed: f64) -> DistanceMap {
        DistanceMap::new(cube, size, &self.points(elapsed), self.figure.triangles.iter().copied())
    }
}
