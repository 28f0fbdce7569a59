//! Bodies: opaque meshes with lacquer, rubber, glass and chrome. Twin of `bodies.wgsl` of `sward_wgpu`.

use glam::{Vec3, Vec4};
use sward::geometry::mesh::{Mesh, Vertex};
use sward::math::smoothstep;
use sward::picture::frame::{BodyDraw, FrameUniform, SHADOW_SIDE};

use crate::bins::{Bins, Rect};
use crate::ground::rect;
use crate::shadows::{self, ShadowTile, TILE, TILES};
use crate::sight::{Sight, mix};
use crate::tile::{Quad, Shaded, Tile};
use crate::trace::Trace;
use crate::triangle::clipped;

/// A corner of a body in frame space.
#[derive(Clone, Copy)]
struct Skin {
    place: Vec3,
    normal: Vec3,
    colour: Vec3,
    /// Roughness, gloss, openness to the sky.
    surface: Vec3,
}

/// The bodies of one picture, in triangles.
pub(crate) struct Bodies {
    triangles: Vec<[Skin; 3]>,
    /// Number in the scene of the body of each.
    numbers: Vec<u32>,
}

fn skin(vertex: &Vertex, draw: &BodyDraw) -> Skin {
    let place = draw.transform.transform_point3(vertex.position.into());
    let [r, g, b, paint] = vertex.colour;
    // The ground darkens what is close above it.
    let open = smoothstep(-0.1, 0.9, place.y - draw.ground);
    Skin {
        place,
        normal: draw.transform.transform_vector3(vertex.normal.into()),
        colour: Vec3::new(r, g, b).lerp(draw.paint.into(), paint),
        surface: Vec3::new(vertex.surface[0], vertex.surface[1], 0.35 + 0.65 * open),
    }
}

impl Bodies {
    /// Puts the meshes where the bodies are.
    pub(crate) fn new(meshes: &[&Mesh], draws: &[BodyDraw]) -> Self {
        let (mut triangles, mut numbers) = (Vec::new(), Vec::new());
        for draw in draws {
            let Some(mesh) = meshes.get(draw.mesh) else { continue };
            let skins: Vec<Skin> = mesh.vertices.iter().map(|vertex| skin(vertex, draw)).collect();
            let corners = mesh.indices.chunks_exact(3).filter_map(|three| {
                let corner = |k: usize| skins.get(three[k] as usize).copied();
                Some([corner(0)?, corner(1)?, corner(2)?])
            });
            triangles.extend(corners);
            numbers.resize(triangles.len(), draw.number);
        }
        Self { triangles, numbers }
    }

    fn clip(&self, sight: &Sight<'_>, index: usize) -> [Vec4; 3] {
        self.triangles[index].map(|corner| sight.clip(corner.place))
    }

    /// By tile of the picture.
    pub(crate) fn bins(&self, sight: &Sight<'_>, [columns, rows]: [usize; 2]) -> Bins {
        let rects: Vec<Option<Rect>> = (0..self.triangles.len()).map(|index| rect(self.clip(sight, index), sight)).collect();
        Bins::new(&rects, columns, rows)
    }

    /// By tile of the shadow map.
    pub(crate) fn shadow_bins(&self, frame: &FrameUniform) -> Bins {
        let rect = |index: usize| {
            let points = self.in_map(frame, index).map(Vec3::truncate);
            let (low, high) = (points[0].min(points[1]).min(points[2]), points[0].max(points[1]).max(points[2]));
            Rect::under(low.to_array(), high.to_array(), [SHADOW_SIDE; 2], TILE as u32)
        };
        let rects: Vec<Option<Rect>> = (0..self.triangles.len()).map(rect).collect();
        Bins::new(&rects, TILES, TILES)
    }

    /// A triangle in the shadow map: texels, and depth.
    fn in_map(&self, frame: &FrameUniform, index: usize) -> [Vec3; 3] {
        let side = SHADOW_SIDE as f32;
        self.triangles[index].map(|corner| shadows::place(frame, corner.place, 0.0) * Vec3::new(side, side, 1.0))
    }

    /// Draws into a tile of the shadow map.
    pub(crate) fn draw_shadow(&self, frame: &FrameUniform, tile: &mut ShadowTile, which: &[u32]) {
        which.iter().for_each(|index| tile.draw(self.in_map(frame, *index as usize), None));
    }

    /// Draws the outputs of what lies in a tile; `then`: the same bodies where they were.
    pub(crate) fn trace(&self, sight: &Sight<'_>, tile: &mut Trace<'_>, which: &[u32], then: &Self) {
        for &index in which {
            let at = index as usize;
            // Meshes keep the number and order of their triangles.
            let Some(was) = then.triangles.get(at) else { continue };
            let trail = tile.trail(self.clip(sight, at), was.map(|corner| corner.place), self.numbers[at]);
            tile.draw(&trail, |_| [true; 4]);
        }
    }

    /// Draws into a tile of the picture.
    pub(crate) fn draw(&self, sight: &Sight<'_>, tile: &mut Tile, which: &[u32]) {
        for &index in which {
            let corners = &self.triangles[index as usize];
            clipped(self.clip(sight, index as usize), sight.pixels(), |triangle| tile.draw(triangle, |quad| shade(sight, quad, corners)));
        }
    }
}

fn shade(sight: &Sight<'_>, quad: &Quad, corners: &[Skin; 3]) -> Shaded {
    let mut shaded = Shaded { samples: quad.visible, ..Shaded::default() };
    let between =
        |lane: usize, pick: fn(&Skin) -> Vec3| mix(quad.weights[lane], &[pick(&corners[0]), pick(&corners[1]), pick(&corners[2])]);
    for lane in (0..4).filter(|lane| quad.lane(*lane)) {
        let place = between(lane, |corner| corner.place);
        let to_eye = sight.eye - place;
        let distance = to_eye.length();
        let view = to_eye / distance.max(1e-3);
        let outwards = between(lane, |corner| corner.normal).normalize_or(Vec3::Y);
        let normal = if outwards.dot(view) > 0.0 { outwards } else { -outwards };
        let lit = sight.shadows.soft(shadows::place(&sight.frame, place + normal * 0.03, 0.03), 1.5);
        let (colour, surface) = (between(lane, |corner| corner.colour), between(lane, |corner| corner.surface));
        let colour = sight.body(colour, surface, normal, view, lit);
        shaded.colours[lane] = sight.air(-view).lerp(colour, sight.clear(distance));
    }
    shaded
}
