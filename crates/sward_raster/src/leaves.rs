//! Pixels of plants: leaves lit by sun and sky. Twin of `leaves.wgsl` of `sward_wgpu`.

use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};
use sward::shading::clump::SIDE;
use sward::shading::foliage::{self, Card, MEAN_LIT};
use sward::shading::look::Style;

use crate::clumps::{Between, Clump};
use crate::shadows;
use crate::sight::{Sight, mix};
use crate::tile::{Quad, Shaded};

/// A corner of a card.
#[derive(Clone, Copy, Default)]
pub(crate) struct Leaf {
    pub(crate) place: Vec3,
    /// Along the card, unit.
    pub(crate) across: Vec3,
    /// Out of the card, unit.
    pub(crate) facing: Vec3,
    /// u, along 0..1 (v is the rest), how much it lies down 0..1.
    pub(crate) card: Vec3,
    /// Light the air adds, and what it leaves of the leaf's; reckoned when it is first needed.
    pub(crate) air: Option<Vec4>,
}

/// What all leaves of a plant have in common.
pub(crate) struct LeafOf<'a> {
    pub(crate) style: &'a Style,
    pub(crate) clump: &'a Clump,
    pub(crate) patchwork: Vec3,
    pub(crate) tint: f32,
    /// Height of the root, m.
    pub(crate) root: f32,
}

impl Leaf {
    fn air(&mut self, sight: &Sight<'_>) -> Vec4 {
        *self.air.get_or_insert_with(|| {
            let away = self.place - sight.eye;
            let clear = sight.clear(away.length());
            (sight.air(away.normalize_or(Vec3::NEG_Z)) * (1.0 - clear)).extend(clear)
        })
    }
}

/// A card's picture under a quad.
struct Print<'a> {
    /// u, along, how much it lies down; lane by lane, as all here.
    card: [Vec3; 4],
    at: [Vec2; 4],
    read: [Between<'a>; 4],
    facing: [Vec3; 4],
    distances: [f32; 4],
    views: [Vec3; 4],
    alpha: [f32; 4],
    /// Of alpha over a pixel.
    change: [f32; 4],
}

impl<'a> Print<'a> {
    /// The print of the triangle between `corners`; `None` where all of it is empty.
    #[inline]
    fn new(sight: &Sight<'_>, clump: &'a Clump, quad: &Quad, corners: &[Leaf; 3]) -> Option<Self> {
        let cards = corners.map(|corner| corner.card);
        let card = quad.weights.map(|weights| mix(weights, &cards));
        let at = card.map(|card| Vec2::new(card.x, 1.0 - card.y));
        let (across, down) = changes(at);
        let side = SIDE as f32;
        let read: [Between<'_>; 4] = std::array::from_fn(|lane| clump.between(foliage::level(across[lane] * side, down[lane] * side)));
        let mut alpha = [0.0; 4];
        for lane in 0..4 {
            alpha[lane] = read[lane].alpha(at[lane].x, at[lane].y);
        }
        if alpha == [0.0; 4] {
            return None;
        }
        let places = corners.map(|corner| corner.place);
        let facings = corners.map(|corner| corner.facing);
        let mut distances = [0.0; 4];
        let mut views = [Vec3::ZERO; 4];
        let mut facing = [Vec3::ZERO; 4];
        for lane in 0..4 {
            let to_eye = sight.eye - mix(quad.weights[lane], &places);
            distances[lane] = to_eye.length();
            views[lane] = to_eye / distances[lane].max(1e-9);
            facing[lane] = mix(quad.weights[lane], &facings);
            alpha[lane] *= foliage::on_edge(facing[lane], views[lane]);
        }
        let change = [
            (alpha[1] - alpha[0]).abs() + (alpha[2] - alpha[0]).abs(),
            (alpha[1] - alpha[0]).abs() + (alpha[3] - alpha[1]).abs(),
            (alpha[3] - alpha[2]).abs() + (alpha[2] - alpha[0]).abs(),
            (alpha[3] - alpha[2]).abs() + (alpha[3] - alpha[1]).abs(),
        ];
        Some(Self { card, at, read, facing, distances, views, alpha, change })
    }

    /// Share of a lane's pixel that the leaf covers.
    #[inline]
    fn cover(&self, style: &Style, lane: usize) -> f32 {
        foliage::rim(self.alpha[lane], self.change[lane], style.mean[3], self.distances[lane])
    }
}

/// Coverage of each lane of a quad under the triangle between `corners`.
pub(crate) fn cover(sight: &Sight<'_>, style: &Style, clump: &Clump, quad: &Quad, corners: &[Leaf; 3]) -> [f32; 4] {
    let print = Print::new(sight, clump, quad, corners);
    std::array::from_fn(|lane| print.as_ref().map_or(0.0, |print| print.cover(style, lane)))
}

/// Shades the visible lanes of a quad under the triangle of corners `three`.
pub(crate) fn shade(sight: &Sight<'_>, of: &LeafOf<'_>, quad: &Quad, leaves: &mut [Leaf], three: [usize; 3]) -> Shaded {
    let mut shaded = Shaded::default();
    let corners = three.map(|corner| leaves[corner]);
    let Some(print) = Print::new(sight, of.clump, quad, &corners) else { return shaded };
    let places = corners.map(|corner| corner.place);
    for lane in (0..4).filter(|lane| quad.lane(*lane)) {
        let cover = print.cover(of.style, lane);
        let samples = quad.visible & (coverage(cover) << (4 * lane));
        if cover < 0.1 || samples == 0 {
            continue;
        }
        shaded.samples |= samples;
        let (weights, view, distance) = (quad.weights[lane], print.views[lane], print.distances[lane]);
        let place = Card {
            across: mix(weights, &corners.map(|corner| corner.across)),
            facing: print.facing[lane],
            along: print.card[lane].y,
            lying: print.card[lane].z,
            patchwork: of.patchwork,
            tint: of.tint,
        };
        let texel = print.read[lane].paint(print.at[lane].x, print.at[lane].y);
        let at = mix(weights, &places);
        let lit = sight.shadows.lit(shadows::place(&sight.frame, at, 0.10), 2.2, MEAN_LIT);
        let colour = sight.foliage(of.style, &place, texel.into(), view, distance, lit, (at, at.y - of.root));
        let air = three.map(|corner| leaves[corner].air(sight));
        let air = air[0] * weights.x + air[1] * weights.y + air[2] * weights.z;
        shaded.colours[lane] = air.xyz() + colour * air.w;
    }
    shaded
}

/// How values change across and down one pixel, lane by lane.
fn changes(at: [Vec2; 4]) -> ([Vec2; 4], [Vec2; 4]) {
    let (top, bottom, left, right) = (at[1] - at[0], at[3] - at[2], at[2] - at[0], at[3] - at[1]);
    ([top, top, bottom, bottom], [left, right, left, right])
}

/// Alpha as coverage: sample k is covered where alpha exceeds k / 4.
pub(crate) fn coverage(alpha: f32) -> u16 {
    (0..4).map(|sample| u16::from(alpha > sample as f32 * 0.25) << sample).sum()
}
