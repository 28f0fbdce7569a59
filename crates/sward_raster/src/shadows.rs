//! The sun's shadow map: depth seen from the sun, one sample a texel; and how it is read.

use std::sync::OnceLock;

use glam::{Vec2, Vec3};
use sward::math::{floored, smoothstep};
use sward::picture::frame::{FrameUniform, SHADOW_SIDE};

use crate::clumps::{Between, Clump};
use crate::triangle::Triangle;

/// Texels along each side of one tile of the map.
pub(crate) const TILE: usize = 128;
/// Tiles along each side.
pub(crate) const TILES: usize = SHADOW_SIDE as usize / TILE;
/// How much a surface's slope pushes it away from the sun, texels.
const SLOPE: f32 = 1.5;

/// The whole map, tile by tile. A tile is drawn when it is first looked at: what a picture does not show is never drawn.
pub(crate) struct ShadowMap<'a> {
    tiles: Vec<OnceLock<ShadowTile>>,
    draw: Box<dyn Fn(usize) -> ShadowTile + Send + Sync + 'a>,
}

/// A place in the map, texels, and its depth, from frame space. `push` metres towards the sun keep a surface from shading itself.
#[inline]
pub(crate) fn place(frame: &FrameUniform, position: Vec3, push: f32) -> Vec3 {
    frame.shadow.transform_point3(position + frame.sun.truncate() * push)
}

impl<'a> ShadowMap<'a> {
    /// `draw` makes a tile, numbered row by row.
    pub(crate) fn new(draw: impl Fn(usize) -> ShadowTile + Send + Sync + 'a) -> Self {
        Self { tiles: (0..TILES * TILES).map(|_| OnceLock::new()).collect(), draw: Box::new(draw) }
    }

    #[inline]
    fn at(&self, x: i32, y: i32) -> f32 {
        let clamp = |at: i32| at.clamp(0, SHADOW_SIDE as i32 - 1) as usize;
        let (x, y) = (clamp(x), clamp(y));
        let index = (y / TILE) * TILES + x / TILE;
        self.tiles[index].get_or_init(|| (self.draw)(index)).depths[(y % TILE) * TILE + x % TILE]
    }

    /// Share of the four texels around a place (0..=1) that light of this depth reaches, by their nearness.
    #[inline]
    fn compare(&self, at: Vec2, depth: f32) -> f32 {
        let at = at * SHADOW_SIDE as f32 - 0.5;
        let (x, y) = (floored(at.x), floored(at.y));
        let way = at - Vec2::new(x as f32, y as f32);
        let lit = |dx: i32, dy: i32| if depth <= self.at(x + dx, y + dy) { 1.0 } else { 0.0 };
        let (a, b, c, d): (f32, f32, f32, f32) = (lit(0, 0), lit(1, 0), lit(0, 1), lit(1, 1));
        let (top, bottom) = (a + (b - a) * way.x, c + (d - c) * way.x);
        top + (bottom - top) * way.y
    }

    /// Share of the sun that arrives, four taps; `beyond` holds where the map ends.
    pub(crate) fn lit(&self, place: Vec3, spread: f32, beyond: f32) -> f32 {
        let trust = trust(place);
        if trust <= 0.0 {
            return beyond;
        }
        let texel = spread / SHADOW_SIDE as f32;
        let taps = [[-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]];
        let lit: f32 = taps.iter().map(|tap| self.compare(place.truncate() + Vec2::from(*tap) * texel, place.z)).sum();
        beyond + (0.25 * lit - beyond) * trust
    }

    /// The same over a wider area, nine taps: soft rims on bare surfaces.
    pub(crate) fn soft(&self, place: Vec3, spread: f32) -> f32 {
        let trust = trust(place);
        if trust <= 0.0 {
            return 1.0;
        }
        let texel = spread / SHADOW_SIDE as f32;
        let tap = |tap: i32| Vec2::new((tap % 3 - 1) as f32, (tap / 3 - 1) as f32) * texel;
        let lit: f32 = (0..9).map(|index| self.compare(place.truncate() + tap(index), place.z)).sum();
        1.0 + (lit / 9.0 - 1.0) * trust
    }
}

/// How sure the map is: 1 inside, falling to 0 at its rim.
#[inline]
fn trust(place: Vec3) -> f32 {
    let rim = (place.x - 0.5).abs().max((place.y - 0.5).abs());
    if place.z <= 1.0 { 1.0 - smoothstep(0.42, 0.49, rim) } else { 0.0 }
}

/// A card's picture under a triangle of the map.
pub(crate) struct Cutout<'a> {
    pub(crate) clump: &'a Clump,
    /// (u, v) at the corners.
    pub(crate) at: [Vec2; 3],
}

/// A square of the map being drawn.
pub(crate) struct ShadowTile {
    corner: [i64; 2],
    depths: Vec<f32>,
}

impl ShadowTile {
    /// An empty tile, number `index`, row by row.
    pub(crate) fn new(index: usize) -> Self {
        let corner = [(index % TILES) * TILE, (index / TILES) * TILE].map(|at| at as i64);
        Self { corner, depths: vec![1.0; TILE * TILE] }
    }

    /// Draws a triangle of points in the map (texels); `depth` tells at each texel, by the weights of its corners, how deep it is, or nothing.
    pub(crate) fn draw_deep(&mut self, points: [Vec3; 3], mut depth: impl FnMut(Vec3) -> Option<f32>) {
        let Some(triangle) = Triangle::new(points, [1.0; 3]) else { return };
        let last = TILE as i64 - 1;
        let low = [0, 1].map(|axis| (triangle.low[axis] - self.corner[axis]).max(0));
        let high = [0, 1].map(|axis| (triangle.high[axis] - self.corner[axis]).min(last));
        for row in low[1]..=high[1] {
            for column in low[0]..=high[0] {
                let (x, y) = ((self.corner[0] + column) * 256 + 128, (self.corner[1] + row) * 256 + 128);
                let edges = [0, 1, 2].map(|k| triangle.edge(k, x, y));
                if (0..3).any(|k| edges[k] + triangle.rule[k] < 0) {
                    continue;
                }
                let stored = &mut self.depths[row as usize * TILE + column as usize];
                if let Some(depth) = depth(triangle.weights(edges.map(|edge| edge as f32))).filter(|depth| *depth <= *stored) {
                    *stored = depth.clamp(0.0, 1.0);
                }
            }
        }
    }

    /// Draws a triangle of points in the map (texels, and depth); where the cutout is transparent it casts no shadow.
    pub(crate) fn draw(&mut self, points: [Vec3; 3], cutout: Option<&Cutout<'_>>) {
        let Some(triangle) = Triangle::new(points, [1.0; 3]) else { return };
        let last = TILE as i64 - 1;
        let low = [0, 1].map(|axis| (triangle.low[axis] - self.corner[axis]).max(0));
        let high = [0, 1].map(|axis| (triangle.high[axis] - self.corner[axis]).min(last));
        if low[0] > high[0] || low[1] > high[1] {
            return;
        }
        let bias = SLOPE * 256.0 * triangle.depth[1].abs().max(triangle.depth[2].abs());
        let print = cutout.map(|cutout| Print::new(&triangle, cutout));
        for row in low[1]..=high[1] {
            let (x, y) = ((self.corner[0] + low[0]) * 256 + 128, (self.corner[1] + row) * 256 + 128);
            let mut edges = [0, 1, 2].map(|k| triangle.edge(k, x, y) + triangle.rule[k]);
            let Some(skipped) = outside(triangle.a, edges, high[0] - low[0]) else { continue };
            (0..3).for_each(|k| edges[k] += 256 * triangle.a[k] * skipped);
            let x = x + 256 * skipped;
            let line = row as usize * TILE;
            let line = &mut self.depths[line + (low[0] + skipped) as usize..=line + high[0] as usize];
            let mut entered = false;
            for (column, stored) in line.iter_mut().enumerate() {
                let at = edges;
                (0..3).for_each(|k| edges[k] += 256 * triangle.a[k]);
                if (at[0] | at[1] | at[2]) < 0 {
                    if entered {
                        break;
                    }
                    continue;
                }
                entered = true;
                let depth = triangle.depth_at(x + 256 * column as i64, y).clamp(triangle.depths[0], triangle.depths[1]);
                let biased = (depth + bias).clamp(0.0, 1.0);
                if biased <= *stored && (0.0..=1.0).contains(&depth) && !print.as_ref().is_some_and(|print| print.is_empty(at)) {
                    *stored = biased;
                }
            }
        }
    }
}

/// Pixels at the start of a row of `last + 1` that lie outside, at least; `None` if all do.
#[inline]
fn outside(across: [i64; 3], edges: [i64; 3], last: i64) -> Option<i64> {
    let mut skipped = 0;
    for k in 0..3 {
        if edges[k] < 0 {
            if across[k] <= 0 {
                return None;
            }
            skipped = skipped.max(-edges[k] / (256 * across[k]));
        }
    }
    (skipped <= last).then_some(skipped)
}

/// A cutout as a triangle shows it: all in the map is affine, so one level does for the whole triangle.
struct Print<'a> {
    between: Between<'a>,
    at: [Vec2; 3],
}

impl<'a> Print<'a> {
    fn new(triangle: &Triangle, cutout: &Cutout<'a>) -> Self {
        let at = cutout.at.map(|at| at * triangle.inverse_area);
        let texels = 256.0 * sward::shading::clump::SIDE as f32;
        let slope = |over: &[i64; 3]| (at[0] * over[0] as f32 + at[1] * over[1] as f32 + at[2] * over[2] as f32) * texels;
        let longer = slope(&triangle.a).length_squared().max(slope(&triangle.b).length_squared());
        Self { between: cutout.clump.between(0.5 * longer.max(1e-9).log2()), at }
    }

    #[inline]
    fn is_empty(&self, edges: [i64; 3]) -> bool {
        let uv = self.at[0] * edges[0] as f32 + self.at[1] * edges[1] as f32 + self.at[2] * edges[2] as f32;
        self.between.alpha(uv.x, uv.y) < 0.5
    }
}
