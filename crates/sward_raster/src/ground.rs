//! Terrain: a grid of rings displaced by the height field, coloured as turf and distant canopy. Twin of `ground.wgsl` of `sward_wgpu`.

use glam::{Vec2, Vec3, Vec4};
use sward::geometry::relief::{Relief, ReliefFrame, detail, edit, height};
use sward::geometry::rings::{self, Grid};
use sward::growth::Near;
use sward::shading::ground::stray;
use sward::shading::look::Turf;
use sward::terrain::{EditFrame, Edits};

use crate::bins::{Bins, Rect};
use crate::each::each;
use crate::shadows;
use crate::sight::{Sight, mix};
use crate::tile::{self, Quad, Shaded, Tile};
use crate::trace::Trace;
use crate::triangle::{clipped, to_pixels};

/// Vertices at once.
const CHUNK: usize = 1024;

/// A corner of the grid.
#[derive(Clone, Copy)]
struct Point {
    clip: Vec4,
    place: Vec3,
    normal: Vec3,
}

/// The grid of one picture.
pub(crate) struct Ground {
    points: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    bins: Bins,
}

/// The corner `p` of the grid, `spacing` m from the next.
fn point(sight: &Sight<'_>, relief: &Relief, edits: &Edits, frame: &(ReliefFrame, EditFrame), p: Vec2, spacing: f32) -> Point {
    let load = |index: i32| relief.heights.get(index as usize).copied().unwrap_or(0.0);
    let added = |column: i32, row: i32| edits.heights()[row as usize * edits.size()[0] as usize + column as usize];
    let (frame, edit_frame) = frame;
    let at = |x: f32, z: f32| {
        let p = [p.x + x, p.y + z];
        height(frame, p, load) + edit(edit_frame, p, added) + detail(frame, [sight.eye.x, sight.eye.z], p)
    };
    let reach = (0.5 * spacing).max(0.4);
    let slope = Vec2::new(at(reach, 0.0) - at(-reach, 0.0), at(0.0, reach) - at(0.0, -reach)) / (2.0 * reach);
    let place = Vec3::new(p.x, at(0.0, 0.0), p.y);
    Point { clip: sight.clip(place), place, normal: Vec3::new(-slope.x, 1.0, -slope.y).normalize() }
}

impl Ground {
    /// Lays the grid of a frame at `origin` out under the camera and sorts it into `columns × rows` tiles.
    pub(crate) fn new(
        sight: &Sight<'_>,
        relief: &Relief,
        edits: &Edits,
        origin: [f64; 2],
        camera: [f32; 2],
        [columns, rows]: [usize; 2],
    ) -> Self {
        let phase = origin.map(|metres| metres.rem_euclid(1024.0) as f32);
        let Grid { vertices, indices } = rings::build(camera, phase);
        let frame = (relief.frame(origin), edits.frame(origin));
        let chunks = vertices.chunks(CHUNK).collect();
        let points = each(chunks, |chunk: &[[f32; 3]]| {
            chunk.iter().map(|[x, z, spacing]| point(sight, relief, edits, &frame, Vec2::new(*x, *z), *spacing)).collect::<Vec<_>>()
        });
        let points: Vec<Point> = points.into_iter().flatten().collect();
        let triangles: Vec<[u32; 3]> = indices.chunks_exact(3).map(|three| [three[0], three[1], three[2]]).collect();
        let rects: Vec<Option<Rect>> = triangles.iter().map(|three| rect(three.map(|at| points[at as usize].clip), sight)).collect();
        Self { bins: Bins::new(&rects, columns, rows), points, triangles }
    }

    /// Draws what lies in a tile.
    pub(crate) fn draw(&self, sight: &Sight<'_>, turf: &Turf, growth: &Near, tile: &mut Tile, index: usize) {
        for triangle in self.bins.of(index) {
            let corners = self.triangles[*triangle as usize].map(|at| self.points[at as usize]);
            let (places, normals) = (corners.map(|corner| corner.place), corners.map(|corner| corner.normal));
            clipped(corners.map(|corner| corner.clip), sight.pixels(), |triangle| {
                tile.draw(triangle, |quad| shade(sight, turf, growth, quad, &places, &normals));
            });
        }
    }
}

impl Ground {
    /// Draws the outputs of what lies in a tile: the ground stays where it is.
    pub(crate) fn trace(&self, tile: &mut Trace<'_>, index: usize) {
        for triangle in self.bins.of(index) {
            let corners = self.triangles[*triangle as usize].map(|at| self.points[at as usize]);
            let trail = tile.trail(corners.map(|corner| corner.clip), corners.map(|corner| corner.place), 0);
            tile.draw(&trail, |_| [true; 4]);
        }
    }
}

/// Tiles a triangle may touch: all of them where it passes the near plane.
pub(crate) fn rect(clip: [Vec4; 3], sight: &Sight<'_>) -> Option<Rect> {
    let size = sight.pixels();
    let near = sward::picture::frame::NEAR;
    if clip.iter().all(|corner| corner.w < near) {
        return None;
    }
    if clip.iter().any(|corner| corner.w < near) {
        return Rect::under([0.0; 2], size.to_array(), sight.size, tile::SIDE);
    }
    let points = clip.map(|corner| to_pixels(corner, size).truncate());
    let low = points[0].min(points[1]).min(points[2]) - 1.0;
    let high = points[0].max(points[1]).max(points[2]) + 1.0;
    Rect::under(low.to_array(), high.to_array(), sight.size, tile::SIDE)
}

fn shade(sight: &Sight<'_>, turf: &Turf, growth: &Near, quad: &Quad, places: &[Vec3; 3], normals: &[Vec3; 3]) -> Shaded {
    let mut shaded = Shaded { samples: quad.visible, ..Shaded::default() };
    for lane in (0..4).filter(|lane| quad.lane(*lane)) {
        let place = mix(quad.weights[lane], places);
        let to_eye = sight.eye - place;
        let distance = to_eye.length();
        let view = to_eye / distance.max(1e-3);
        let normal = mix(quad.weights[lane], normals).normalize_or(Vec3::Y);
        let lit = sight.shadows.soft(shadows::place(&sight.frame, place, 0.06), 1.6);
        let (p, pixel) = (sight.pattern(place), sight.frame.right.w);
        let mut colour = sight.ground(turf, p, normal, view, distance, lit, place);
        if !growth.is_empty() {
            let blur = distance * pixel / normal.dot(view).max(0.03).sqrt();
            let [red, green, blue, bare] = growth.bare((Vec2::new(place.x, place.z) + stray(p)).to_array(), blur);
            if bare > 0.0 {
                let own = Vec3::new(red, green, blue) / bare;
                colour = colour.lerp(sight.earth(own, p, normal, view, distance, lit, place), bare);
            }
        }
        shaded.colours[lane] = sight.air(-view).lerp(colour, sight.clear(distance));
    }
    shaded
}
