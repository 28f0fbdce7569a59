//! Triangles become the six faces of a depth cube map.
//!
//! Orthmann et al. 2009, §5.2; methods §4. Corners are whole numbers of 1/256 texel, edges whole numbers: every machine covers the same texels.
//! Reads triangles in the body's frame. Writes depth and normal. Twin: `raster.wgsl`. Differs from the paper: both sides of a triangle count, so
//! that files with triangles turned inside out are bodies too.

use super::{Cube, DistanceMap, EMPTY, sized};
use crate::math;

/// The drawing of triangles in WGSL, one texel at a time; needs `math` before it.
pub const WGSL: &str = include_str!("raster.wgsl");

/// Parts of a texel.
const PARTS: f32 = 256.0;
/// Corners farther out than this count as this far, texels: whole numbers stay small.
const BEYOND: f32 = 16_384.0;

/// A triangle as the two faces across one axis see it: at the same places, from both sides.
struct Seen<'a> {
    /// Which axis.
    axis: usize,
    /// Corners in 1/256 texel.
    place: [[i64; 2]; 3],
    /// Corners from the cube's middle, m.
    corners: &'a [[f32; 3]; 3],
    /// Unit normal.
    normal: [f32; 3],
}

impl DistanceMap {
    /// Draws triangles (corners by index; points in the body's frame, m) in a cube, `size` texels along a side (8 to
    /// [`super::MOST_TEXELS`]). Triangles without area, with unknown corners or corners that are not finite are left out.
    pub fn new(cube: Cube, size: u32, points: &[[f32; 3]], triangles: impl IntoIterator<Item = [u32; 3]>) -> Self {
        let size = sized(size);
        let mut map = Self { size, cube, texels: vec![[EMPTY, 0.0, 1.0, 0.0]; (6 * size * size) as usize] };
        let scale = 0.5 * size as f32 / cube.half;
        let fine = |part: f32| {
            let texels = math::clamped((part + cube.half) * scale, -BEYOND, BEYOND);
            i64::from(math::floored(texels * PARTS + 0.5))
        };
        for triangle in triangles {
            let [Some(a), Some(b), Some(c)] = triangle.map(|index| points.get(index as usize)) else { continue };
            let corners = [a, b, c].map(|point| [0, 1, 2].map(|axis: usize| point[axis] - cube.centre[axis]));
            let Some(normal) = normal_of(&corners) else { continue };
            let fine = corners.map(|corner| corner.map(fine));
            for axis in 0..3 {
                let place = fine.map(|corner| [corner[(axis + 1) % 3], corner[(axis + 2) % 3]]);
                map.draw(&Seen { axis, place, corners: &corners, normal });
            }
        }
        map
    }

    fn draw(&mut self, seen: &Seen) {
        let [a, b, c] = seen.place;
        let (size, parts) = (i64::from(self.size), PARTS as i64);
        let range = |axis: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]);
            let high = a[axis].max(b[axis]).max(c[axis]);
            // Texels whose centres lie between; small triangles mostly have none.
            ((low + parts / 2 - 1).div_euclid(parts).max(0), (high - parts / 2).div_euclid(parts).min(size - 1))
        };
        let (left, right) = range(0);
        if left > right {
            return;
        }
        let (top, bottom) = range(1);
        let area = edge(a, b, c);
        if top > bottom || area == 0 {
            return;
        }
        let whole = area.abs() as f32;
        for row in top..=bottom {
            for column in left..=right {
                let middle = [column * parts + parts / 2, row * parts + parts / 2];
                let edges = [edge(b, c, middle), edge(c, a, middle), edge(a, b, middle)].map(|part| part * area.signum());
                if edges.iter().all(|part| *part >= 0) {
                    self.meet((row * size + column) as usize, seen, edges.map(|part| part as f32 / whole));
                }
            }
        }
    }

    /// The nearest surface stays on either face, of two equally near the one that faces it more, whatever their order. `place` counts the texels
    /// of a face, `shares` are those of the corners.
    fn meet(&mut self, place: usize, seen: &Seen, shares: [f32; 3]) {
        let (axis, area) = (seen.axis, (self.size * self.size) as usize);
        let size = |part: f32| if part < 0.0 { -part } else { part };
        for (face, sign) in [(2 * axis, 1.0), (2 * axis + 1, -1.0)] {
            let Some(texel) = self.texels.get_mut(face * area + place) else { continue };
            let share = |k: usize| shares[k] * (self.cube.half - sign * seen.corners[k][axis]);
            let depth = share(0) + share(1) + share(2);
            let facing = sign * seen.normal[axis];
            if depth < texel[0] || (depth == texel[0] && size(facing) > size(texel[axis + 1])) {
                let [x, y, z] = if facing < 0.0 { seen.normal.map(|part| -part) } else { seen.normal };
                *texel = [depth, x, y, z];
            }
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
