//! A square of the outputs beside a picture being drawn: one sample a pixel, at its centre. Twin of the pass in `render/aov` of
//! `sward_wgpu`.

use glam::{DVec3, Vec2, Vec3, Vec4};
use sward::picture::aov::{AovPixel, AovUniform, pixel};

use crate::sight::Sight;
use crate::tile::{CENTRES, Quad, SIDE, centres, ray};
use crate::triangle::{Triangle, clipped};

/// Where a triangle is, and where it was.
pub(crate) struct Trail {
    /// Clip space of its corners.
    now: [Vec4; 3],
    /// Clip space of the picture before.
    then: [Vec4; 3],
    number: u32,
    /// Edges of the triangle as planes through the eye, in (x, y, w) of clip space.
    planes: [DVec3; 3],
}

impl Trail {
    /// Weights of the corners at a place of the picture (−1..=1, y up), on the triangle itself: those of [`Quad`] are of corners snapped to
    /// parts of a pixel, and a card seen on edge is narrower than these.
    fn weights(&self, x: f64, y: f64) -> Option<Vec3> {
        let at = DVec3::new(x, y, 1.0);
        let weights = DVec3::from(self.planes.map(|plane| plane.dot(at)));
        let sum = weights.element_sum();
        let inside = (weights / sum).max(DVec3::ZERO);
        (sum != 0.0).then(|| (inside / inside.element_sum()).as_vec3()).filter(|weights| weights.is_finite())
    }
}

/// A tile's pixels, row by row.
pub(crate) struct Trace<'a> {
    /// The camera of the picture before.
    pub(crate) before: &'a AovUniform,
    corner: [i64; 2],
    size: Vec2,
    depths: Vec<f32>,
    pixels: Vec<AovPixel>,
}

fn between(weights: Vec3, values: &[Vec4; 3]) -> Vec4 {
    values[0] * weights.x + values[1] * weights.y + values[2] * weights.z
}

impl<'a> Trace<'a> {
    /// An empty tile whose first pixel is `corner`.
    pub(crate) fn new(corner: [i64; 2], before: &'a AovUniform) -> Self {
        let count = (SIDE * SIDE) as usize;
        let empty = AovPixel { depth: f32::INFINITY, motion: [0.0; 2], plant: 0 };
        Self { before, corner, size: Vec2::new(before.size.x, before.size.y), depths: vec![0.0; count], pixels: vec![empty; count] }
    }

    /// A triangle with clip space `now`, whose corners were at `then`, m in frame space.
    pub(crate) fn trail(&self, now: [Vec4; 3], then: [Vec3; 3], number: u32) -> Trail {
        let [a, b, c] = now.map(|corner| DVec3::new(corner.x.into(), corner.y.into(), corner.w.into()));
        let planes = [b.cross(c), c.cross(a), a.cross(b)];
        Trail { now, then: then.map(|place| self.before.then * place.extend(1.0)), number, planes }
    }

    /// Draws a triangle; `solid` says which lanes of a quad it holds.
    pub(crate) fn draw(&mut self, trail: &Trail, mut solid: impl FnMut(&Quad) -> [bool; 4]) {
        clipped(trail.now, self.size, |triangle| self.draw_part(triangle, trail, &mut solid));
    }

    fn draw_part(&mut self, triangle: &Triangle, trail: &Trail, solid: &mut impl FnMut(&Quad) -> [bool; 4]) {
        let last = i64::from(SIDE) - 1;
        let low = [0, 1].map(|axis| (triangle.low[axis] - self.corner[axis]).max(0) / 2);
        let high = [0, 1].map(|axis| (triangle.high[axis] - self.corner[axis]).min(last));
        if (0..2).any(|axis| high[axis] < 2 * low[axis]) {
            return;
        }
        for row in low[1]..=high[1] / 2 {
            for column in low[0]..=high[0] / 2 {
                let first = [(self.corner[0] + 2 * column) * 256, (self.corner[1] + 2 * row) * 256];
                let depths = CENTRES.map(|[x, y]| self.depth_at(triangle, [first[0] + x, first[1] + y]));
                let place = |lane: usize| (2 * row as usize + lane / 2) * SIDE as usize + 2 * column as usize + lane % 2;
                let seen = |lane: usize| depths[lane].is_some_and(|depth| depth >= self.depths[place(lane)]);
                let visible = (0..4).filter(|lane| seen(*lane)).fold(0, |mask, lane| mask | 15 << (4 * lane));
                if visible == 0 {
                    continue;
                }
                let edges = [0, 1, 2].map(|k| triangle.edge(k, first[0], first[1]));
                let quad = Quad { first: first.map(|at| at / 256), weights: centres(triangle, edges), visible };
                let solid = solid(&quad);
                for lane in (0..4).filter(|lane| solid[*lane] && quad.lane(*lane)) {
                    let [x, y] = [0, 1].map(|axis| ((first[axis] + CENTRES[lane][axis]) as f64) / 256.0);
                    let size = self.size.as_dvec2();
                    let weights = trail.weights(2.0 * x / size.x - 1.0, 1.0 - 2.0 * y / size.y).unwrap_or(quad.weights[lane]);
                    self.depths[place(lane)] = depths[lane].unwrap_or_default();
                    self.pixels[place(lane)] = pixel(between(weights, &trail.now), between(weights, &trail.then), self.size, trail.number);
                }
            }
        }
    }

    /// Draws a triangle in clip space whose depth is known only pixel by pixel: `seen` gives, by the weights of its corners, clip space of what is seen there, of
    /// the same in the picture before, and its number.
    pub(crate) fn draw_deep(&mut self, now: [Vec4; 3], mut seen: impl FnMut(Vec3, &AovUniform) -> Option<(Vec4, Vec4, u32)>) {
        let last = i64::from(SIDE) - 1;
        clipped(now, self.size, |triangle| {
            let low = [0, 1].map(|axis| (triangle.low[axis] - self.corner[axis]).max(0));
            let high = [0, 1].map(|axis| (triangle.high[axis] - self.corner[axis]).min(last));
            for row in low[1]..=high[1] {
                for column in low[0]..=high[0] {
                    let [x, y] = [(self.corner[0] + column) * 256 + 128, (self.corner[1] + row) * 256 + 128];
                    if self.depth_at(triangle, [x, y]).is_none() {
                        continue;
                    }
                    let weights = triangle.weights([0, 1, 2].map(|k| triangle.edge(k, x, y) as f32));
                    let Some((clip, then, number)) = seen(weights, self.before) else { continue };
                    let (depth, place) = ((clip.z / clip.w).clamp(0.0, 1.0), (row * i64::from(SIDE) + column) as usize);
                    if depth >= self.depths[place] {
                        self.depths[place] = depth;
                        self.pixels[place] = pixel(clip, then, self.size, number);
                    }
                }
            }
        });
    }

    /// Depth of a triangle at a place, 1/256 pixel; `None` beside it.
    #[inline]
    fn depth_at(&self, triangle: &Triangle, [x, y]: [i64; 2]) -> Option<f32> {
        let inside = (0..3).all(|k| triangle.edge(k, x, y) + triangle.rule[k] >= 0);
        let [least, most] = triangle.depths;
        inside.then(|| triangle.depth_at(x, y).clamp(least, most))
    }

    /// Fills what nothing has covered with the sky: infinitely far, so that only turning the camera moves it.
    pub(crate) fn fill(&mut self, sight: &Sight<'_>) {
        let frame = &sight.frame;
        let axes = [frame.forward, frame.right, frame.up].map(|axis| axis.truncate());
        for index in (0..self.pixels.len()).filter(|index| self.depths[*index] == 0.0) {
            let at = [self.corner[0] + i64::from(index as u32 % SIDE), self.corner[1] + i64::from(index as u32 / SIDE)];
            let ray = ray(axes, at, self.size).extend(0.0);
            let seen = pixel(frame.view_projection * ray, self.before.then * ray, self.size, 0);
            self.pixels[index] = AovPixel { depth: f32::INFINITY, ..seen };
        }
    }

    /// The pixels, [`SIDE`]², row by row.
    pub(crate) fn finish(self) -> Vec<AovPixel> {
        self.pixels
    }
}
