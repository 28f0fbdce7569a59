//! Triangles become the six faces of a depth cube map.
//!
//! Orthmann et al. 2009, §5.2; methods §4. Corners are whole numbers of 1/256 texel, edges whole numbers: every machine covers the same texels.
//! Reads triangles in the body's frame. Writes depth and normal. Differs from the paper: drawn on the CPU; both sides of a triangle count, so
//! that files with triangles turned inside out are bodies too.

use super::{Cube, DistanceMap, EMPTY, sized};
use crate::math;

/// Parts of a texel.
const PARTS: f32 = 256.0;
/// Corners farther out than this count as this far, texels: whole numbers stay small.
const BEYOND: f32 = 16_384.0;

/// A triangle as one face sees it.
struct Seen {
    /// Corners in 1/256 texel.
    place: [[i64; 2]; 3],
    /// Depth of each corner, m.
    depth: [f32; 3],
    /// Unit normal, turned to the face.
    normal: [f32; 3],
    /// How far it faces the face, 0 to 1.
    facing: f32,
}

impl DistanceMap {
    /// Draws triangles (corners by index; points in the body's frame, m) in a cube, `size` texels along a side (8 to
    /// [`super::MOST_TEXELS`]). Triangles without area, with unknown corners or corners that are not finite are left out.
    pub fn new(cube: Cube, size: u32, points: &[[f32; 3]], triangles: impl IntoIterator<Item = [u32; 3]>) -> Self {
        let size = sized(size);
        let mut map = Self { size, cube, texels: vec![[EMPTY, 0.0, 1.0, 0.0]; (6 * size * size) as usize] };
        for triangle in triangles {
            let [Some(a), Some(b), Some(c)] = triangle.map(|index| points.get(index as usize)) else { continue };
            let corners = [a, b, c].map(|point| [0, 1, 2].map(|axis: usize| point[axis] - cube.centre[axis]));
            let Some(normal) = normal_of(&corners) else { continue };
            for face in 0..6 {
                let seen = map.seen(face, &corners, normal);
                map.draw(face, &seen);
            }
        }
        map
    }

    fn seen(&self, face: u32, corners: &[[f32; 3]; 3], normal: [f32; 3]) -> Seen {
        let (axis, half) = ((face / 2) as usize, self.cube.half);
        let sign = if face.is_multiple_of(2) { 1.0 } else { -1.0 };
        let scale = 0.5 * self.size as f32 / half;
        let fine = |part: f32| {
            let texels = math::clamped((part + half) * scale, -BEYOND, BEYOND);
            i64::from(math::floored(texels * PARTS + 0.5))
        };
        let facing = sign * normal[axis];
        let turned = if facing < 0.0 { normal.map(|part| -part) } else { normal };
        Seen {
            place: corners.map(|corner| [fine(corner[(axis + 1) % 3]), fine(corner[(axis + 2) % 3])]),
            depth: corners.map(|corner| half - sign * corner[axis]),
            normal: turned,
            facing: if facing < 0.0 { -facing } else { facing },
        }
    }

    fn draw(&mut self, face: u32, seen: &Seen) {
        let [a, b, c] = seen.place;
        let area = edge(a, b, c);
        if area == 0 {
            return;
        }
        let size = i64::from(self.size);
        let parts = PARTS as i64;
        let range = |axis: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]);
            let high = a[axis].max(b[axis]).max(c[axis]);
            // Texels whose centres lie between; small triangles mostly have none.
            ((low + parts / 2 - 1).div_euclid(parts).max(0), (high - parts / 2).div_euclid(parts).min(size - 1))
        };
        let ((left, right), (top, bottom)) = (range(0), range(1));
        for row in top..=bottom {
            for column in left..=right {
                let middle = [column * parts + parts / 2, row * parts + parts / 2];
                let edges = [edge(b, c, middle), edge(c, a, middle), edge(a, b, middle)].map(|part| part * area.signum());
                if edges.iter().any(|part| *part < 0) {
                    continue;
                }
                let share = |k: usize| edges[k] as f32 / area.abs() as f32 * seen.depth[k];
                let depth = share(0) + share(1) + share(2);
                let index = (i64::from(face) * size + row) * size + column;
                self.meet(index as usize, depth, seen);
            }
        }
    }

    /// The nearest surface stays; of two equally near the one that faces the face more, whatever their order.
    fn meet(&mut self, index: usize, depth: f32, seen: &Seen) {
        let Some(texel) = self.texels.get_mut(index) else { return };
        let axis = index / (self.size * self.size) as usize / 2;
        let there = if texel[axis + 1] < 0.0 { -texel[axis + 1] } else { texel[axis + 1] };
        if depth < texel[0] || (depth == texel[0] && seen.facing > there) {
            *texel = [depth, seen.normal[0], seen.normal[1], seen.normal[2]];
        }
    }
}

/// Twice the signed area of a triangle, in (1/256 texel)².
fn edge(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Unit normal of a triangle; `None` where it has none.
fn normal_of([a, b, c]: &[[f32; 3]; 3]) -> Option<[f32; 3]> {
    let way = |from: &[f32; 3], to: &[f32; 3]| [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    let (u, v) = (way(a, b), way(a, c));
    let across = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let size = (across[0] * across[0] + across[1] * across[1] + across[2] * across[2]).sqrt();
    (size > 0.0 && size < EMPTY).then(|| across.map(|part| part / size))
}
