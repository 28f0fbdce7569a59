//! Plants cut into layers: every triangle of a mesh drawn once, into the part of the texture that its leaf's layer has. Twin of `cut.wgsl` of `sward_wgpu`.

use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};
use sward::picture::layers::CutUniform;
use sward::shading::common::hash;
use sward::shading::crown;
use sward::specimen::{Finish, Kind, Specimen};

use crate::bins::{Bins, Rect, rects};
use crate::each::each;
use crate::leaf_picture::LeafPicture;
use crate::leaves::coverage;
use crate::sight::{Sight, mix};
use crate::tile::{Quad, SIDE, Shaded, Tile};
use crate::triangle::{clipped, to_pixels};

/// A sample of a cut: light of the sky, light of the sun where it shines, and how far behind its layer it is.
#[derive(Clone, Copy, Default)]
struct Sample {
    sky: Vec3,
    sun: Vec3,
    behind: f32,
}

/// All layers of a cut.
#[derive(Default)]
pub(crate) struct CutTexture {
    size: [u32; 2],
    /// Light of the sky; covered share. Times that share, as all here.
    sky: Vec<Vec4>,
    /// Light of the sun; how far behind the layer.
    sun: Vec<Vec4>,
}

impl CutTexture {
    /// Both between texels, at (u, v), v down.
    pub(crate) fn at(&self, uv: Vec2) -> [Vec4; 2] {
        let [width, height] = self.size.map(|side| side as i32);
        let at = uv * Vec2::new(width as f32, height as f32) - 0.5;
        let corner = at.floor();
        let way = at - corner;
        let texel = |list: &[Vec4], dx: i32, dy: i32| {
            let (x, y) = ((corner.x as i32 + dx).clamp(0, width - 1), (corner.y as i32 + dy).clamp(0, height - 1));
            list[(y * width + x) as usize]
        };
        [&self.sky, &self.sun].map(|list| {
            let row = |dy: i32| texel(list, 0, dy).lerp(texel(list, 1, dy), way.x);
            row(0).lerp(row(1), way.y)
        })
    }
}

/// A corner of a mesh in its cut.
#[derive(Clone, Copy)]
struct Corner {
    clip: Vec4,
    place: Vec3,
    normal: Vec3,
    /// u, v, openness.
    card: Vec3,
}

/// A triangle in its cut.
struct Piece {
    corners: [Corner; 3],
    finish: usize,
    /// Column and row of its layer's part; depth of the layer; what makes its leaf differ from others.
    part: [f32; 4],
}

/// Cuts a plant; `sight`: the light on it, which the sun's own cuts do without.
pub(crate) fn cut(
    specimen: &Specimen,
    pictures: &[LeafPicture],
    uniform: &CutUniform,
    size: [u32; 2],
    sight: Option<&Sight<'_>>,
) -> CutTexture {
    let pieces = pieces(specimen, uniform);
    let pixels = Vec2::new(size[0] as f32, size[1] as f32);
    let tiles = size.map(|side| side.div_ceil(SIDE) as usize);
    let rect = |_: usize, piece: &Piece| {
        if piece.corners.iter().any(|corner| corner.clip.w < 0.02) {
            return Rect::under([0.0; 2], pixels.to_array(), size, SIDE);
        }
        let points = piece.corners.map(|corner| to_pixels(corner.clip, pixels).truncate());
        let (low, high) = (points[0].min(points[1]).min(points[2]), points[0].max(points[1]).max(points[2]));
        Rect::under((low - 1.0).to_array(), (high + 1.0).to_array(), size, SIDE)
    };
    let bins = Bins::new(&rects(&pieces, rect), tiles[0], tiles[1]);
    let drawn = each((0..tiles[0] * tiles[1]).collect(), |index| {
        let corner = [index % tiles[0], index / tiles[0]].map(|at| (at * SIDE as usize) as i64);
        let mut tile: Tile<Sample> = Tile::new(corner);
        for piece in bins.of(index) {
            let piece = &pieces[*piece as usize];
            let of = Shading { finish: &specimen.finishes[piece.finish], pictures, uniform, sight, piece };
            clipped(piece.corners.map(|corner| corner.clip), pixels, |triangle| {
                tile.draw(triangle, |quad| of.shade(quad));
            });
        }
        tile
    });
    let area = (size[0] * size[1]) as usize;
    let mut texture = CutTexture { size, sky: vec![Vec4::ZERO; area], sun: vec![Vec4::ZERO; area] };
    for (index, tile) in drawn.iter().enumerate() {
        let corner = [index % tiles[0], index / tiles[0]].map(|at| at * SIDE as usize);
        for y in corner[1]..(corner[1] + SIDE as usize).min(size[1] as usize) {
            for x in corner[0]..(corner[0] + SIDE as usize).min(size[0] as usize) {
                let (samples, covered) = tile.samples([x - corner[0], y - corner[1]]);
                let at = y * size[0] as usize + x;
                for (sample, _) in samples.iter().zip(covered).filter(|(_, covered)| *covered) {
                    texture.sky[at] += sample.sky.extend(1.0) * 0.25;
                    texture.sun[at] += sample.sun.extend(sample.behind) * 0.25;
                }
            }
        }
    }
    texture
}

/// All triangles where the cut has them.
fn pieces(specimen: &Specimen, uniform: &CutUniform) -> Vec<Piece> {
    let axis = |axis: [f32; 4]| Vec4::from(axis).xyz();
    let (eye, right, up, forward) = (axis(uniform.eye), axis(uniform.right), axis(uniform.up), axis(uniform.forward));
    let [top, columns, rows, _] = uniform.grid;
    let count = uniform.eye[3] as usize;
    let [left, bottom, side] = [uniform.right[3], uniform.up[3], uniform.forward[3]];
    let mut pieces = Vec::with_capacity(specimen.triangles.len());
    for part in &specimen.parts {
        let wood = specimen.finishes[part.finish].kind == Kind::Wood;
        for triangle in &specimen.triangles[part.triangles.start as usize..part.triangles.end as usize] {
            let vertices = triangle.map(|vertex| specimen.vertices[vertex as usize]);
            let root = Vec3::from(vertices[0].root);
            let (mut layer, mut depth) = (count, uniform.size[2]);
            if !wood {
                let away = (uniform.place.transform_point3(root) - eye).dot(forward);
                layer = (0..count - 1).filter(|k| away >= uniform.edges[k / 4][k % 4]).count();
                depth = uniform.depths[layer / 4][layer % 4];
            }
            let (column, row) = ((layer % columns as usize) as f32, (layer / columns as usize) as f32);
            let corners = vertices.map(|vertex| {
                let place = uniform.place.transform_point3(vertex.position.into());
                let from = place - eye;
                let (x, y, z) = (from.dot(right), from.dot(up), from.dot(forward));
                let across = (x - left * z) / (side - left);
                let down = (top * z - y) / (top - bottom);
                let clip = Vec4::new(2.0 * (column * z + across) / columns - z, z - 2.0 * (row * z + down) / rows, 0.05, z);
                let (normal, uv) = (uniform.place.transform_vector3(vertex.normal().into()), vertex.uv());
                Corner { clip, place, normal, card: Vec3::new(uv[0], uv[1], vertex.shade()) }
            });
            let cell = (root * 512.0).floor().as_ivec3();
            let chance = hash(cell.x.wrapping_add(cell.y.wrapping_mul(7)), cell.z, 31);
            pieces.push(Piece { corners, finish: part.finish, part: [column, row, depth, chance] });
        }
    }
    pieces
}

/// What shades a triangle.
struct Shading<'a> {
    finish: &'a Finish,
    pictures: &'a [LeafPicture],
    uniform: &'a CutUniform,
    sight: Option<&'a Sight<'a>>,
    piece: &'a Piece,
}

impl Shading<'_> {
    fn shade(&self, quad: &Quad) -> Shaded<Sample> {
        let corners = &self.piece.corners;
        let between = |lane: usize, pick: fn(&Corner) -> Vec3| mix(quad.weights[lane], &corners.map(|corner| pick(&corner)));
        let mut alphas = [1.0; 4];
        let mut texels = [Vec3::ONE; 4];
        if let Some(picture) = self.finish.picture.and_then(|picture| self.pictures.get(picture)) {
            let uvs = [0, 1, 2, 3].map(|lane| between(lane, |corner| corner.card).truncate());
            let found = picture.quad(uvs);
            let change = (found[1].w - found[0].w).abs() + (found[2].w - found[0].w).abs();
            for lane in 0..4 {
                texels[lane] = found[lane].xyz();
                alphas[lane] = ((found[lane].w - self.finish.cutoff) / change.max(0.02) + 0.5).clamp(0.0, 1.0);
            }
        }
        let mut shaded = Shaded::default();
        let cell = Vec2::new(self.uniform.size[0], self.uniform.size[1]);
        for lane in (0..4).filter(|lane| quad.lane(*lane)) {
            let pixel = Vec2::new((quad.first[0] + lane as i64 % 2) as f32, (quad.first[1] + lane as i64 / 2) as f32);
            let within = ((pixel + 0.5) / cell).floor();
            let seen = mix(quad.weights[lane], &corners.map(|corner| Vec3::new(corner.clip.w, 0.0, 0.0))).x;
            if within != Vec2::new(self.piece.part[0], self.piece.part[1]) || alphas[lane] < 0.125 || seen < 0.02 {
                continue;
            }
            let (place, card) = (between(lane, |corner| corner.place), between(lane, |corner| corner.card));
            let normal = between(lane, |corner| corner.normal);
            let behind = seen - self.piece.part[2];
            let (sky, sun) = self.light(place, normal, card.z.clamp(0.0, 1.0), texels[lane]);
            shaded.colours[lane] = Sample { sky, sun, behind };
            shaded.samples |= coverage(alphas[lane] - 0.125) << (4 * lane);
        }
        shaded
    }

    fn light(&self, place: Vec3, normal: Vec3, open: f32, texel: Vec3) -> (Vec3, Vec3) {
        let Some(sight) = self.sight else { return Default::default() };
        let wood = self.finish.kind == Kind::Wood;
        let view = (Vec4::from(self.uniform.eye).xyz() - place).normalize_or(Vec3::Y);
        let crown = Vec4::from(self.uniform.crown);
        let outwards = (place - crown.xyz()) * crown.w;
        let own = (normal + Vec3::new(0.0, 1e-6, 0.0)).normalize_or(Vec3::Y);
        let facing = if own.dot(view) > 0.0 { own } else { -own };
        let normal = if wood { facing } else { crown::normal(own, outwards / outwards.length().max(1.0), view) };
        let plain = Vec3::from(self.finish.colour) * texel;
        let albedo = if wood { plain } else { crown::colour(plain, self.piece.part[3], self.uniform.grid[3], open) };
        let through = if wood { 0.0 } else { crown::THROUGH };
        (sight.crown_sky(albedo, normal, open, through, place), crown::sun(albedo, normal, view, &sight.light, through))
    }
}
