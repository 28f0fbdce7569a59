//! Blades: strips of triangles, every one by itself. Twin of `blades/draw.wgsl` of `sward_wgpu`.

use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};
use sward::geometry::blade::{MOST_PIECES, across, profile};
use sward::math::upper;
use sward::picture::aov::COVERAGE;
use sward::picture::blade_plan::{BladePlan, LEVELS};
use sward::picture::blades::{Blade, Blades, heading};
use sward::picture::frame::{FrameUniform, NEAR, SHADOW_SIDE};
use sward::picture::identity;
use sward::shading::blade::{BladeStyle, Spot, coverage};
use sward::shading::common::patchwork;
use sward::shading::foliage::MEAN_LIT;

use crate::bins::{Bins, Rect, rects};
use crate::each::each;
use crate::leaves;
use crate::shadows::{self, ShadowTile, TILE, TILES};
use crate::sight::{Sight, mix};
use crate::tile::{self, Quad, Shaded, Tile};
use crate::trace::Trace;
use crate::triangle::clipped;

/// Most corners of a strip.
const CORNERS: usize = 2 * MOST_PIECES + 1;

/// Blades with one number of pieces.
pub(crate) struct Strips {
    blades: Vec<Blade>,
    /// `pieces + 1` of each.
    points: Vec<Vec3>,
    style: BladeStyle,
}

/// A strip's blades as they were in the picture before: blade, points, number of its plant.
pub(crate) struct Past {
    blades: Vec<(Blade, u32)>,
    points: Vec<Vec3>,
}

/// A corner of a strip.
#[derive(Clone, Copy, Default)]
struct Corner {
    place: Vec3,
    across: Vec3,
    facing: Vec3,
    /// Side −1..1, along 0..1.
    at: Vec2,
    /// Share of the pixel that the blade covers.
    cover: f32,
}

/// Solves all blades of a stand, by their numbers of pieces.
pub(crate) fn solve(blades: &Blades<'_>, plan: &BladePlan, styles: [BladeStyle; LEVELS]) -> [Strips; LEVELS] {
    let mut strips = styles.map(|style| Strips { blades: Vec::new(), points: Vec::new(), style });
    let patches = each(plan.draws.iter().enumerate().collect(), |(number, draw)| {
        let mut found: [(Vec<Blade>, Vec<Vec3>); LEVELS] = Default::default();
        blades.of_patch(number as u32, draw, |blade, level, points| {
            found[level].0.push(*blade);
            found[level].1.extend_from_slice(points);
        });
        found
    });
    for patch in patches {
        for (strips, (blades, points)) in strips.iter_mut().zip(patch) {
            strips.blades.extend(blades);
            strips.points.extend(points);
        }
    }
    // No more than there is room for.
    for (level, strips) in strips.iter_mut().enumerate() {
        let room = plan.uniform.rooms[level] as usize;
        strips.blades.truncate(room);
        strips.points.truncate(room * strips.joints());
    }
    strips
}

impl Strips {
    fn pieces(&self) -> usize {
        self.style.shape[0] as usize
    }

    fn joints(&self) -> usize {
        self.pieces() + 1
    }

    fn points_of(&self, index: usize) -> &[Vec3] {
        &self.points[index * self.joints()..][..self.joints()]
    }

    /// The blades as they were: `blades` solves that moment, `then` is its plan, `identity` numbers its plants.
    pub(crate) fn past(&self, level: usize, blades: &Blades<'_>, then: &BladePlan, identity: [u32; 4]) -> Past {
        let starts: Vec<usize> = (0..self.blades.len()).step_by(CHUNK).collect();
        let chunks = each(starts, |start| {
            let end = (start + CHUNK).min(self.blades.len());
            let (mut found, mut points) = (Vec::new(), Vec::new());
            // Blades of a patch lie side by side.
            for same in self.blades[start..end].chunk_by(|a, b| a.draw == b.draw) {
                let draw = &then.draws[same[0].draw as usize];
                let (phases, growth) = (blades.preparing.phases(draw), blades.preparing.growth(draw));
                for now in same {
                    let mut own = [Vec3::ZERO; MOST_PIECES + 1];
                    let own = &mut own[..self.joints()];
                    let was = blades.past(draw, &phases, growth.as_deref(), now, level, own).unwrap_or_default();
                    found.push((was, identity::number(identity, draw.patch, blades.cell(now.rank))));
                    points.extend_from_slice(own);
                }
            }
            (found, points)
        });
        let (mut all, mut points) = (Vec::new(), Vec::new());
        for (found, own) in chunks {
            all.extend(found);
            points.extend(own);
        }
        Past { blades: all, points }
    }

    /// Corners of a strip, two at each joint but the tip; as wide as a picture draws them, if there is one.
    fn corners(&self, points: &[Vec3], blade: &Blade, sight: Option<&Sight<'_>>) -> [Corner; CORNERS] {
        let (mut corners, heading, last) = ([Corner::default(); CORNERS], heading(blade).to_array(), self.pieces());
        for (k, point) in points.iter().enumerate() {
            let along = k as f32 / last as f32;
            let tangent = (points[(k + 1).min(last)] - points[k.saturating_sub(1)]).normalize_or(Vec3::Y);
            let across = across(heading, tangent, blade.twist * along);
            let width = blade.width * profile(along);
            let (drawn, cover) = match sight {
                Some(sight) => drawn(width, sight.frame.right.w * point.distance(sight.eye), blade.tint),
                None => (width, 1.0),
            };
            for (side, corner) in corners[2 * k..].iter_mut().take(if k == last { 1 } else { 2 }).enumerate() {
                let side = if k == last { 0.0 } else { 2.0 * side as f32 - 1.0 };
                let place = *point + across * (0.5 * drawn * side);
                *corner = Corner { place, across, facing: across.cross(tangent), at: Vec2::new(side, along), cover };
            }
        }
        corners
    }

    /// By tile of the picture.
    pub(crate) fn bins(&self, sight: &Sight<'_>, [columns, rows]: [usize; 2]) -> Bins {
        let scale = [0, 1].map(|row| sight.frame.view_projection.row(row).truncate().length());
        let size = sight.pixels();
        let rect = |index: usize, blade: &Blade| {
            let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
            let mut behind = 0;
            for point in self.points_of(index) {
                let clip = sight.clip(*point);
                let reach = 0.5 * upper(blade.width, sight.frame.right.w * clip.w);
                if clip.w - reach < NEAR {
                    behind += usize::from(clip.w + reach < NEAR);
                    (low, high) = (Vec2::NEG_INFINITY, Vec2::INFINITY);
                    continue;
                }
                let middle = Vec2::new(clip.x, clip.y) / clip.w;
                let around = reach * (Vec2::from(scale) + middle.abs()) / (clip.w - reach);
                (low, high) = (low.min(middle - around), high.max(middle + around));
            }
            if behind == self.joints() {
                return None;
            }
            let corner = |ndc: Vec2| Vec2::new((0.5 + 0.5 * ndc.x) * size.x, (0.5 - 0.5 * ndc.y) * size.y);
            let (a, b) = (corner(low), corner(high));
            Rect::under([a.x - 1.0, b.y - 1.0], [b.x + 1.0, a.y + 1.0], sight.size, tile::SIDE)
        };
        Bins::new(&rects(&self.blades, rect), columns, rows)
    }

    /// By tile of the shadow map.
    pub(crate) fn shadow_bins(&self, frame: &FrameUniform) -> Bins {
        let side = SHADOW_SIDE as f32;
        let rect = |index: usize, blade: &Blade| {
            if !in_shadow_map(frame, blade) {
                return None;
            }
            let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
            for point in self.points_of(index) {
                let place = shadows::place(frame, *point, 0.0).truncate() * side;
                (low, high) = (low.min(place), high.max(place));
            }
            Rect::under((low - 2.0).to_array(), (high + 2.0).to_array(), [SHADOW_SIDE; 2], TILE as u32)
        };
        Bins::new(&rects(&self.blades, rect), TILES, TILES)
    }

    /// Draws into a tile of the shadow map.
    pub(crate) fn draw_shadow(&self, frame: &FrameUniform, tile: &mut ShadowTile, which: &[u32]) {
        let side = SHADOW_SIDE as f32;
        for &index in which {
            let blade = &self.blades[index as usize];
            let wide = Blade { width: shadow_width(frame, blade.width), ..*blade };
            let corners = self.corners(self.points_of(index as usize), &wide, None);
            let place = |corner: usize| shadows::place(frame, corners[corner].place, 0.0) * Vec3::new(side, side, 1.0);
            triangles(self.pieces()).for_each(|three| tile.draw(three.map(place), None));
        }
    }

    /// Draws into a tile of the picture.
    pub(crate) fn draw(&self, sight: &Sight<'_>, tile: &mut Tile, which: &[u32]) {
        for &index in which {
            let blade = &self.blades[index as usize];
            let corners = self.corners(self.points_of(index as usize), blade, Some(sight));
            let pattern = patchwork(sight.pattern(blade.root.into()));
            let clips = corners.map(|corner| sight.clip(corner.place));
            let mut airs = [None; CORNERS];
            for three in triangles(self.pieces()) {
                clipped(three.map(|corner| clips[corner]), sight.pixels(), |triangle| {
                    let own = three.map(|corner| corners[corner]);
                    let air = three.map(|corner| *airs[corner].get_or_insert_with(|| air(sight, corners[corner].place)));
                    tile.draw(triangle, |quad| self.shade(sight, blade, pattern, quad, &own, &air));
                });
            }
        }
    }

    fn shade(&self, sight: &Sight<'_>, grown: &Blade, pattern: Vec3, quad: &Quad, corners: &[Corner; 3], air: &[Vec4; 3]) -> Shaded {
        let mut shaded = Shaded::default();
        for lane in (0..4).filter(|lane| quad.lane(*lane)) {
            let weights = quad.weights[lane];
            let cover = weights.dot(Vec3::from(corners.map(|corner| corner.cover)));
            let samples = quad.visible & (leaves::coverage(cover) << (4 * lane));
            if samples == 0 {
                continue;
            }
            shaded.samples |= samples;
            let place = mix(weights, &corners.map(|corner| corner.place));
            let at = corners[0].at * weights.x + corners[1].at * weights.y + corners[2].at * weights.z;
            let to_eye = sight.eye - place;
            let distance = to_eye.length();
            let view = to_eye / upper(distance, 1e-9);
            let spot = Spot {
                facing: mix(weights, &corners.map(|corner| corner.facing)),
                across: mix(weights, &corners.map(|corner| corner.across)),
                side: at.x,
                along: at.y,
                ground: Vec3::new(-grown.slope[0], 1.0, -grown.slope[1]).normalize(),
                patchwork: pattern,
                tint: grown.tint,
            };
            let lit = sight.shadows.lit(shadows::place(&sight.frame, place, 0.10), 2.2, MEAN_LIT);
            let colour = sight.blade(&self.style, &spot, view, distance, lit, (place, place.y - grown.root[1]));
            let air = air[0] * weights.x + air[1] * weights.y + air[2] * weights.z;
            shaded.colours[lane] = air.xyz() + colour * air.w;
        }
        shaded
    }

    /// Draws the outputs of what lies in a tile; `then`: the same blades as they were.
    pub(crate) fn trace(&self, sight: &Sight<'_>, tile: &mut Trace<'_>, which: &[u32], then: &Past) {
        for &index in which {
            let at = index as usize;
            let (blade, (was, number)) = (&self.blades[at], &then.blades[at]);
            let corners = self.corners(self.points_of(at), blade, Some(sight));
            let clips: [Vec4; CORNERS] = corners.map(|corner| sight.clip(corner.place));
            // The same place across the strip, as wide as it is drawn now.
            let was = Blade { width: blade.width, ..*was };
            let before = self.corners(&then.points[at * self.joints()..][..self.joints()], &was, Some(sight));
            for three in triangles(self.pieces()) {
                let cover = Vec3::from(three.map(|corner| corners[corner].cover));
                let trail = tile.trail(three.map(|corner| clips[corner]), three.map(|corner| before[corner].place), *number);
                tile.draw(&trail, |quad| quad.weights.map(|weights| weights.dot(cover) >= COVERAGE));
            }
        }
    }
}

/// Light the air adds to what is seen at a place, and what it leaves of it.
fn air(sight: &Sight<'_>, place: Vec3) -> Vec4 {
    let away = place - sight.eye;
    let clear = sight.clear(away.length());
    (sight.air(away.normalize_or(Vec3::NEG_Z)) * (1.0 - clear)).extend(clear)
}

/// Blades looked at together.
const CHUNK: usize = 4096;

/// The width a blade is drawn with where a pixel is `pixel` m high, and the share of it that it covers.
fn drawn(width: f32, pixel: f32, tint: f32) -> (f32, f32) {
    (upper(width, pixel), coverage(width, pixel, tint))
}

/// Whether a blade may cast a shadow that is seen: it stands in the map, and is one of as many as together take as much light as all,
/// since in the map none is narrower than a texel.
fn in_shadow_map(frame: &FrameUniform, blade: &Blade) -> bool {
    let centre = shadows::place(frame, blade.root.into(), 0.0);
    let inside = (centre.x - 0.5).abs().max((centre.y - 0.5).abs()) <= 0.52;
    inside && (blade.tint * 37.3).fract() * shadow_width(frame, blade.width) <= blade.width
}

/// Width of a blade in the shadow map, m.
fn shadow_width(frame: &FrameUniform, width: f32) -> f32 {
    upper(width, frame.sky.w)
}

/// Triangles of a strip: two for each piece, one for the last. Corner 2 k + s stands at joint k, on one side (0) or the other (1).
fn triangles(pieces: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..2 * pieces - 1).map(|at| [at, at + 1, at + 2])
}
