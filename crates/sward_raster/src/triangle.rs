//! A triangle on the picture: which samples it covers, how deep it is there, and the weights of its corners.
//!
//! As graphics hardware does it: corners snapped to 1/256 of a pixel, whole-number edge functions, the top-left rule (a sample on an edge
//! shared by two triangles belongs to exactly one of them), clipping at the near plane, and weights corrected for perspective.

use glam::{Vec2, Vec3, Vec4};
use sward::math::floored;

/// Parts of a pixel.
const PARTS: f32 = 256.0;
/// No corner lies farther out, pixels: whole-number edge functions then fit 64 bits.
const FARTHEST: f32 = 1_048_576.0;
/// What is kept of a triangle in clip space: beyond the near plane, and not farther aside than this many halves of the picture.
const PLANES: [Vec4; 5] = [
    Vec4::new(0.0, 0.0, -1.0, 1.0),
    Vec4::new(1.0, 0.0, 0.0, ASIDE),
    Vec4::new(-1.0, 0.0, 0.0, ASIDE),
    Vec4::new(0.0, 1.0, 0.0, ASIDE),
    Vec4::new(0.0, -1.0, 0.0, ASIDE),
];
const ASIDE: f32 = 64.0;
/// Places of the four samples in a pixel, 1/256.
pub(crate) const SAMPLES: [[i64; 2]; 4] = [[96, 32], [224, 96], [32, 160], [160, 224]];

/// A triangle in pixels, ready to be drawn.
#[derive(Clone, Debug)]
pub(crate) struct Triangle {
    /// E_k(x, y) = a x + b y + c in 1/256 pixels, ≥ 0 inside: the edge opposite corner k.
    pub(crate) a: [i64; 3],
    pub(crate) b: [i64; 3],
    pub(crate) c: [i64; 3],
    /// −1 for edges whose samples belong to the neighbour.
    pub(crate) rule: [i64; 3],
    /// 1 / E_k at corner k.
    pub(crate) inverse_area: f32,
    /// 1 / w at the corners.
    pub(crate) inverse_w: [f32; 3],
    /// Depth at corner 0 (at `first`), and its change over 1/256 pixel.
    pub(crate) depth: [f32; 3],
    pub(crate) first: [i64; 2],
    /// Least and greatest depth.
    pub(crate) depths: [f32; 2],
    /// Lowest and highest pixel, inclusive.
    pub(crate) low: [i64; 2],
    pub(crate) high: [i64; 2],
    /// Weights of the whole triangle's corners at the corners of this part of it; `None` for a whole one.
    source: Option<[Vec3; 3]>,
}

impl Triangle {
    /// A triangle of points in pixels (z: depth) with 1 / w; `None` if it has no area or a number is not finite.
    pub(crate) fn new(points: [Vec3; 3], inverse_w: [f32; 3]) -> Option<Self> {
        if !points.iter().all(|point| point.is_finite()) {
            return None;
        }
        let snap = |value: f32| i64::from(floored(value.clamp(-FARTHEST, FARTHEST) * PARTS + 0.5));
        let at = points.map(|point| [snap(point.x), snap(point.y)]);
        let area = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
        if area == 0 {
            return None;
        }
        // Triangles of either turning sense are drawn: the edge functions of one are negated.
        let sign = area.signum();
        let (mut a, mut b, mut c, mut rule) = ([0; 3], [0; 3], [0; 3], [0; 3]);
        for k in 0..3 {
            let (from, to) = (at[(k + 1) % 3], at[(k + 2) % 3]);
            (a[k], b[k]) = (sign * (from[1] - to[1]), sign * (to[0] - from[0]));
            c[k] = -(a[k] * from[0] + b[k] * from[1]);
            rule[k] = if a[k] > 0 || (a[k] == 0 && b[k] > 0) { 0 } else { -1 };
        }
        let inverse_area = 1.0 / area.abs() as f64;
        let slope = |over: &[i64; 3]| ((0..3).map(|k| f64::from(points[k].z) * over[k] as f64).sum::<f64>() * inverse_area) as f32;
        let depths = [points[0].z.min(points[1].z).min(points[2].z), points[0].z.max(points[1].z).max(points[2].z)];
        let least = |axis: usize| at[0][axis].min(at[1][axis]).min(at[2][axis]) >> 8;
        let most = |axis: usize| at[0][axis].max(at[1][axis]).max(at[2][axis]) >> 8;
        Some(Self {
            depth: [points[0].z, slope(&a), slope(&b)],
            first: at[0],
            depths,
            low: [least(0), least(1)],
            high: [most(0), most(1)],
            a,
            b,
            c,
            rule,
            inverse_area: inverse_area as f32,
            inverse_w,
            source: None,
        })
    }

    /// The value of edge `k` at a place, 1/256 pixels.
    #[inline]
    pub(crate) fn edge(&self, k: usize, x: i64, y: i64) -> i64 {
        self.a[k] * x + self.b[k] * y + self.c[k]
    }

    /// Depth at a place, 1/256 pixels.
    #[inline]
    pub(crate) fn depth_at(&self, x: i64, y: i64) -> f32 {
        self.depth[0] + self.depth[1] * (x - self.first[0]) as f32 + self.depth[2] * (y - self.first[1]) as f32
    }

    /// Weights of the corners, in perspective, where the edges have these values.
    #[inline]
    pub(crate) fn weights(&self, edges: [f32; 3]) -> Vec3 {
        let part = Vec3::from(edges) * self.inverse_area * Vec3::from(self.inverse_w);
        // Outside the triangle, where a pixel's centre may be, the sum may vanish.
        let weights = part / part.element_sum().max(1e-9);
        match &self.source {
            None => weights,
            Some(source) => source[0] * weights.x + source[1] * weights.y + source[2] * weights.z,
        }
    }
}

/// Clip space to pixels; z is the depth.
#[inline]
pub(crate) fn to_pixels(clip: Vec4, size: Vec2) -> Vec3 {
    let ndc = clip / clip.w;
    Vec3::new((0.5 + 0.5 * ndc.x) * size.x, (0.5 - 0.5 * ndc.y) * size.y, ndc.z)
}

/// Draws the part of a triangle in clip space that lies beyond the near plane, in as many triangles as it takes.
pub(crate) fn clipped(clip: [Vec4; 3], size: Vec2, mut draw: impl FnMut(&Triangle)) {
    let mut emit = |corners: [Vec4; 3], source: Option<[Vec3; 3]>| {
        if let Some(triangle) = Triangle::new(corners.map(|corner| to_pixels(corner, size)), corners.map(|corner| 1.0 / corner.w)) {
            draw(&Triangle { source, ..triangle });
        }
    };
    if clip.iter().all(|corner| PLANES.iter().all(|plane| plane.dot(*corner) >= 0.0)) {
        return emit(clip, None);
    }
    let mut polygon: Vec<(Vec4, Vec3)> = (0..3).map(|k| (clip[k], Vec3::AXES[k])).collect();
    for plane in PLANES {
        polygon = cut(&polygon, plane);
    }
    for k in 2..polygon.len() {
        let part = [polygon[0], polygon[k - 1], polygon[k]];
        emit(part.map(|(corner, _)| corner), Some(part.map(|(_, weights)| weights)));
    }
}

/// The part of a polygon (corners, and weights of the triangle it is from) on the inner side of a plane.
fn cut(polygon: &[(Vec4, Vec3)], plane: Vec4) -> Vec<(Vec4, Vec3)> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &(from, weights)) in polygon.iter().enumerate() {
        let (to, next) = polygon[(k + 1) % polygon.len()];
        let (here, there) = (plane.dot(from), plane.dot(to));
        if here >= 0.0 {
            kept.push((from, weights));
        }
        if (here >= 0.0) != (there >= 0.0) {
            let way = here / (here - there);
            kept.push((from.lerp(to, way), weights.lerp(next, way)));
        }
    }
    kept
}
