//! Layers in the picture and in the shadow map: textures of cut plants on grids that waves move. Twin of `layers.wgsl` of `sward_wgpu`.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};
use sward::geometry::layers::{LayerDraw, Moving};
use sward::picture::aov::COVERAGE;
use sward::picture::frame::{FrameUniform, SHADOW_SIDE};
use sward::picture::layers::{CutKey, CutPlan, CutUniform, Origin};
use sward::shading::foliage::MEAN_LIT;
use sward::world::World;

use crate::bins::{Bins, Rect, rects};
use crate::cut::{CutTexture, cut};
use crate::ground::rect;
use crate::leaf_picture::LeafPicture;
use crate::leaves::coverage;
use crate::shadows::{self, ShadowTile, TILE, TILES};
use crate::sight::{Sight, mix};
use crate::tile::{Quad, Shaded, Tile};
use crate::trace::Trace;
use crate::triangle::clipped;

/// What stays from picture to picture: pictures of leaves, and cuts.
#[derive(Default)]
pub(crate) struct CutCache {
    pictures: Vec<Vec<LeafPicture>>,
    cuts: Mutex<BTreeMap<CutKey, Arc<CutTexture>>>,
}

impl CutCache {
    pub(crate) fn new(world: &World) -> Self {
        let pictures = world.model.layered.iter().map(|stand| stand.specimen.pictures.iter().map(LeafPicture::new).collect());
        Self { pictures: pictures.collect(), cuts: Mutex::default() }
    }

    /// The texture of a cut, made if need be.
    fn texture(&self, world: &World, plan: &CutPlan, origin: Origin, sight: Option<&Sight<'_>>) -> Arc<CutTexture> {
        // Whoever panicked while it held the lock left a whole map.
        let known = |key| self.cuts.lock().unwrap_or_else(std::sync::PoisonError::into_inner).get(key).cloned();
        known(&plan.key).unwrap_or_else(|| {
            let stand = &world.model.layered[plan.key.stand];
            let uniform = CutUniform::new(stand, plan, origin);
            let made = Arc::new(cut(&stand.specimen, &self.pictures[plan.key.stand], &uniform, plan.texture(), sight));
            self.cuts.lock().unwrap_or_else(std::sync::PoisonError::into_inner).insert(plan.key, Arc::clone(&made));
            made
        })
    }

    /// Forgets what is not shown.
    pub(crate) fn keep(&self, plans: &[Vec<CutPlan>; 2]) {
        let shown: std::collections::BTreeSet<CutKey> = plans.iter().flatten().map(|plan| plan.key).collect();
        self.cuts.lock().unwrap_or_else(std::sync::PoisonError::into_inner).retain(|key, _| shown.contains(key));
    }
}

/// A corner of a layer's grid.
#[derive(Clone, Copy)]
struct Corner {
    place: Vec3,
    uv: Vec2,
    /// Light the air adds, and what it leaves.
    air: Vec4,
}

struct Piece {
    corners: [Corner; 3],
    layer: u32,
}

/// The layers of one picture, of the camera's cuts or the sun's.
#[derive(Default)]
pub(crate) struct Layers {
    textures: Vec<Arc<CutTexture>>,
    /// Layers, and the texture of each.
    draws: Vec<(LayerDraw, usize)>,
    pieces: Vec<Piece>,
}

impl Layers {
    /// Cuts what is to be shown, and lays the grids; `sight` is `None` for the sun's.
    pub(crate) fn new(world: &World, cache: &CutCache, plans: &[CutPlan], origin: Origin, sight: Option<&Sight<'_>>) -> Self {
        let mut layers = Self::default();
        let notes: Vec<Vec<&[[f32; 2]]>> =
            world.state.layered.iter().map(|state| state.notes.iter().map(|note| &note[..]).collect()).collect();
        for plan in plans {
            let state = &world.state.layered[plan.key.stand];
            let moving = Moving { notes: &notes[plan.key.stand], touches: &state.touches };
            layers.textures.push(cache.texture(world, plan, origin, sight));
            for draw in &plan.layers {
                layers.lay(draw, &moving, sight);
            }
        }
        layers
    }

    fn lay(&mut self, draw: &LayerDraw, moving: &Moving<'_>, sight: Option<&Sight<'_>>) {
        let number = self.draws.len() as u32;
        self.draws.push((*draw, self.textures.len() - 1));
        let [columns, rows] = [draw.window[2] as usize, draw.window[3] as usize];
        let corner = |column: usize, row: usize| {
            let corner = moving.corner(draw, [column as f32 / columns as f32, row as f32 / rows as f32]);
            let air = sight.map_or(Vec4::W, |sight| {
                let away = corner.place - sight.eye;
                let clear = sight.clear(away.length());
                (sight.air(away.normalize_or(Vec3::NEG_Z)) * (1.0 - clear)).extend(clear)
            });
            Corner { place: corner.place, uv: corner.uv.into(), air }
        };
        let corners: Vec<Corner> =
            (0..=rows).flat_map(|row| (0..=columns).map(move |column| (column, row))).map(|(c, r)| corner(c, r)).collect();
        for row in 0..rows {
            for column in 0..columns {
                let at = |dx: usize, dy: usize| corners[(row + dy) * (columns + 1) + column + dx];
                for three in [[at(0, 0), at(1, 0), at(0, 1)], [at(0, 1), at(1, 0), at(1, 1)]] {
                    self.pieces.push(Piece { corners: three, layer: number });
                }
            }
        }
    }

    /// By tile of the picture.
    pub(crate) fn bins(&self, sight: &Sight<'_>, [columns, rows]: [usize; 2]) -> Bins {
        Bins::new(&rects(&self.pieces, |_, piece| rect(piece.corners.map(|corner| sight.clip(corner.place)), sight)), columns, rows)
    }

    /// Draws into a tile of the picture.
    pub(crate) fn draw(&self, sight: &Sight<'_>, tile: &mut Tile, which: &[u32]) {
        for index in which {
            let piece = &self.pieces[*index as usize];
            let clip = piece.corners.map(|corner| sight.clip(corner.place));
            clipped(clip, sight.pixels(), |triangle| tile.draw_deep(triangle, |quad| self.shade(sight, quad, piece)));
        }
    }

    fn shade(&self, sight: &Sight<'_>, quad: &Quad, piece: &Piece) -> (Shaded, [f32; 4]) {
        let (draw, texture) = &self.draws[piece.layer as usize];
        let texture = &self.textures[*texture];
        let (mut shaded, mut depths) = (Shaded::default(), [0.0; 4]);
        for lane in (0..4).filter(|lane| quad.lane(*lane)) {
            let weights = quad.weights[lane];
            let uv = mix(weights, &piece.corners.map(|corner| corner.uv.extend(0.0))).truncate();
            let [sky, sun] = texture.at(uv);
            if sky.w < 0.125 {
                continue;
            }
            let whole = 1.0 / sky.w.max(1e-3);
            let place = behind(draw, mix(weights, &piece.corners.map(|corner| corner.place)), sun.w * whole);
            let lit = sight.shadows.lit(shadows::place(&sight.frame, place, 0.12), 2.2, MEAN_LIT);
            let (air, clear) = (
                mix(weights, &piece.corners.map(|corner| corner.air.xyz())),
                mix(weights, &piece.corners.map(|corner| Vec3::new(corner.air.w, 0.0, 0.0))).x,
            );
            shaded.colours[lane] = air + (sky.xyz() + sun.xyz() * lit) * (whole * clear);
            let clip = sight.clip(place);
            depths[lane] = (clip.z / clip.w).clamp(0.0, 1.0);
            let pixel = [quad.first[0] + lane as i64 % 2, quad.first[1] + lane as i64 / 2];
            shaded.samples |= coverage(covers(draw, sky.w, pixel)) << (4 * lane);
        }
        (shaded, depths)
    }

    /// Corners of the pieces of some cuts as they were, when `world` was the present: in the order of this picture's pieces.
    pub(crate) fn places(world: &World, plans: &[CutPlan], then: &[Vec<LayerDraw>]) -> Vec<[Vec3; 3]> {
        let notes: Vec<Vec<&[[f32; 2]]>> =
            world.state.layered.iter().map(|state| state.notes.iter().map(|note| &note[..]).collect()).collect();
        let mut places = Vec::new();
        for (plan, draws) in plans.iter().zip(then) {
            let Some(state) = world.state.layered.get(plan.key.stand) else { continue };
            let moving = Moving { notes: &notes[plan.key.stand], touches: &state.touches };
            for draw in draws {
                let mut layers = Self::default();
                layers.textures.push(Arc::default());
                layers.lay(draw, &moving, None);
                places.extend(layers.pieces.iter().map(|piece| piece.corners.map(|corner| corner.place)));
            }
        }
        places
    }

    /// Draws the outputs of what lies in a tile; `then`: the corners of the pieces where they were.
    pub(crate) fn trace(&self, sight: &Sight<'_>, tile: &mut Trace<'_>, which: &[u32], then: &[[Vec3; 3]]) {
        for index in which {
            let (piece, Some(was)) = (&self.pieces[*index as usize], then.get(*index as usize)) else { continue };
            let (draw, texture) = &self.draws[piece.layer as usize];
            let texture = &self.textures[*texture];
            if draw.which[1] == 0 {
                continue;
            }
            let clip = piece.corners.map(|corner| sight.clip(corner.place));
            tile.draw_deep(clip, |weights, before| {
                let uv = mix(weights, &piece.corners.map(|corner| corner.uv.extend(0.0))).truncate();
                let [sky, sun] = texture.at(uv);
                (sky.w >= COVERAGE).then(|| {
                    let off = sun.w / sky.w.max(1e-3);
                    let place = behind(draw, mix(weights, &piece.corners.map(|corner| corner.place)), off);
                    let was = behind(draw, mix(weights, was), off);
                    (sight.clip(place), before.then * was.extend(1.0), draw.which[0])
                })
            });
        }
    }

    /// Points of a piece in the shadow map, texels.
    fn in_map(&self, frame: &FrameUniform, piece: &Piece) -> [Vec3; 3] {
        let side = SHADOW_SIDE as f32;
        piece.corners.map(|corner| shadows::place(frame, corner.place, 0.0) * Vec3::new(side, side, 1.0))
    }

    /// By tile of the shadow map.
    pub(crate) fn shadow_bins(&self, frame: &FrameUniform) -> Bins {
        let rect = |_: usize, piece: &Piece| {
            let points = self.in_map(frame, piece).map(Vec3::truncate);
            let (low, high) = (points[0].min(points[1]).min(points[2]), points[0].max(points[1]).max(points[2]));
            Rect::under(low.to_array(), high.to_array(), [SHADOW_SIDE; 2], TILE as u32)
        };
        Bins::new(&rects(&self.pieces, rect), TILES, TILES)
    }

    /// Draws into a tile of the shadow map.
    pub(crate) fn draw_shadow(&self, frame: &FrameUniform, tile: &mut ShadowTile, which: &[u32]) {
        for index in which {
            let piece = &self.pieces[*index as usize];
            let (draw, texture) = &self.draws[piece.layer as usize];
            let texture = &self.textures[*texture];
            tile.draw_deep(self.in_map(frame, piece), |weights| {
                let uv = mix(weights, &piece.corners.map(|corner| corner.uv.extend(0.0))).truncate();
                let [sky, sun] = texture.at(uv);
                if sky.w < 0.5 {
                    return None;
                }
                let place = mix(weights, &piece.corners.map(|corner| corner.place));
                Some(shadows::place(frame, behind(draw, place, sun.w / sky.w), 0.0).z)
            });
        }
    }
}

/// A point that lies `behind` a layer's point as its cut saw it.
fn behind(draw: &LayerDraw, place: Vec3, behind: f32) -> Vec3 {
    place + (place - Vec4::from(draw.eye).xyz()) * (behind / draw.eye[3])
}

/// The share of a pixel's samples that a layer is to cover. Equal shares are the same samples, so two layers that cover half of a pixel each would leave half
/// of it empty: leaves cover what two layers of alpha cover together.
fn covers(draw: &LayerDraw, alpha: f32, [x, y]: [i64; 2]) -> f32 {
    let covered = if draw.which[3] == 0 { alpha } else { alpha * (2.0 - alpha) };
    // While cuts change, between two numbers of samples, pixel by pixel in Bayer's order.
    let spread = |bits: i64| (bits & 1) << 4 | (bits & 2) << 1 | (bits & 4) >> 2;
    let off = (2 * spread(x ^ y) + spread(y)) as f32 / 63.0 - 0.5;
    covered * draw.forward[3] - 0.125 + off * (4.0 * (1.0 - draw.forward[3])).min(0.25)
}
