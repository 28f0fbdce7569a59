//! Plants: crossed cards bent along their joints, or sheets. Twin of `plants.wgsl`, `cards.wgsl`, `sheet_grids.wgsl` and both vertex shaders
//! of `sward_wgpu`.
//!
//! Only plants and joints are stored; cards and sheets are built again in each tile a plant touches, so memory does not grow with their triangles.

use glam::{Vec2, Vec3, Vec4};
use sward::geometry::card::rung;
use sward::geometry::sheet::{Around, SheetOf, corner};
use sward::math::smoothstep;
use sward::picture::aov::COVERAGE;
use sward::picture::frame::{FrameUniform, NEAR, SHADOW_SIDE};
use sward::picture::plants::{MOST_CARDS, MOST_SEGMENTS, PLANTS_PER_INSTANCE, Plant};
use sward::shading::common::patchwork;
use sward::shading::look::{Look, Style};

use crate::bins::{Bins, Rect, rects};
use crate::clumps::Clumps;
use crate::leaves::{self, Leaf, LeafOf};
use crate::shadows::{self, Cutout, ShadowTile, TILE, TILES};
use crate::sight::Sight;
use crate::tile::{self, Tile};
use crate::trace::Trace;
use crate::triangle::clipped;

/// Plants of one look and one number of segments, solved.
pub(crate) struct Batch {
    pub(crate) plants: Vec<Plant>,
    /// `segments + 1` of each plant; of a sheet, (segments + 1)² points.
    pub(crate) joints: Vec<[f32; 4]>,
    pub(crate) style: Style,
}

/// Left and right half of a card show the same picture turned around for half of the plants.
fn flip(plant: &Plant) -> f32 {
    if (plant.tint * 64.0).fract() < 0.5 { -1.0 } else { 1.0 }
}

fn joint(values: &[[f32; 4]], at: usize) -> Vec3 {
    values.get(at).map_or(Vec3::ZERO, |joint| Vec3::new(joint[0], joint[1], joint[2]))
}

impl Batch {
    pub(crate) fn new(plants: Vec<Plant>, joints: Vec<[f32; 4]>, look: &Look, segments: u32, cards: u32) -> Self {
        let style = Style::new(look, segments.clamp(1, MOST_SEGMENTS), cards.min(MOST_CARDS), PLANTS_PER_INSTANCE);
        Self { plants, joints, style }
    }

    fn segments(&self) -> usize {
        self.style.shape[0] as usize
    }

    /// Cards, or one sheet.
    fn cards(&self) -> usize {
        (self.style.shape[1] as usize).max(1)
    }

    fn is_sheet(&self) -> bool {
        self.style.shape[1] == 0
    }

    /// Joints of a plant.
    fn joints_each(&self) -> usize {
        let side = self.segments() + 1;
        if self.is_sheet() { side * side } else { side }
    }

    fn joints_of(&self, index: usize) -> &[[f32; 4]] {
        let count = self.joints_each();
        self.joints.get(index * count..(index + 1) * count).unwrap_or(&[])
    }

    /// How far a plant seen from `eye` is gone, 0 to 1.
    fn gone(&self, eye: Vec3, plant: &Plant) -> f32 {
        let [_, _, near, end] = self.style.mean;
        let distance = Vec3::from(plant.root).distance(eye);
        // Plants end at slightly different distances, so that no front is seen.
        smoothstep(near, end, distance + (plant.tint - 0.5) * 0.3 * (end - near))
    }

    /// How much of its size a plant keeps where plants end; `None` for one that is not drawn.
    fn keep(&self, sight: &Sight<'_>, plant: &Plant) -> Option<f32> {
        let gone = self.gone(sight.eye, plant);
        (plant.height > 0.0 && gone < 1.0).then_some(keep(gone))
    }

    /// The corners of a card or of a sheet, in the order of [`Batch::triangles`].
    fn corners(&self, index: usize, plant: &Plant, card: usize, keep: f32, corners: &mut Vec<Leaf>) {
        corners.clear();
        let (joints, flip) = (self.joints_of(index), flip(plant));
        if self.is_sheet() {
            self.sheet(plant, joints, keep, flip, corners);
        } else {
            self.card(plant, joints, card, keep, flip, corners);
        }
    }

    fn card(&self, plant: &Plant, joints: &[[f32; 4]], card: usize, keep: f32, flip: f32, corners: &mut Vec<Leaf>) {
        let turn = plant.yaw + card as f32 * std::f32::consts::PI / self.cards() as f32;
        for at in 0..=self.segments() {
            let [low, high] = [at.saturating_sub(1), (at + 1).min(self.segments())];
            let around = [0, at, low, high].map(|at| joint(joints, at));
            let rung = rung(around, turn, plant.width, (card + 1) as f32 * at as f32, keep);
            let along = at as f32 / self.segments() as f32;
            for side in [-1.0, 1.0] {
                let card = Vec3::new(0.5 + 0.5 * side * flip, along, rung.lying);
                corners.push(Leaf { place: rung.corner(side), across: rung.across, facing: rung.facing, card, air: None });
            }
        }
    }

    fn sheet(&self, plant: &Plant, points: &[[f32; 4]], keep: f32, flip: f32, corners: &mut Vec<Leaf>) {
        let pieces = self.segments();
        let of = SheetOf { root: plant.root.into(), width: plant.width, height: plant.height, tint: plant.tint };
        for at in 0..self.joints_each() {
            let [column, row] = [at % (pieces + 1), at / (pieces + 1)];
            let around = Around::of(pieces, [column, row], |at| joint(points, at));
            let (side, along) = (2.0 * column as f32 / pieces as f32 - 1.0, row as f32 / pieces as f32);
            let bent = corner(&of, &around, [side, along], keep);
            let card = Vec3::new(0.5 + 0.5 * side * flip, along, bent.lying);
            corners.push(Leaf { place: bent.place, across: bent.across, facing: bent.facing, card, air: None });
        }
    }

    /// Two triangles per segment of a card: corner 2 k + s stands at joint k, on the left (0) or right (1). Of a sheet, two per piece.
    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let (across, rows) = (if self.is_sheet() { self.segments() + 1 } else { 2 }, self.segments() + 1);
        let pieces = (0..rows - 1).flat_map(move |row| (0..across - 1).map(move |column| row * across + column));
        pieces.flat_map(move |at| [[at, at + 1, at + across], [at + across, at + 1, at + across + 1]])
    }

    /// Farthest that a corner may be from its joint or point, m.
    fn reach(&self, plant: &Plant) -> f32 {
        if self.is_sheet() {
            return 0.5 * 2.35 * plant.width + 0.27 * plant.height;
        }
        0.5 * 1.35 * plant.width + 0.018 * (self.cards() * self.segments()) as f32
    }

    /// By tile of the picture.
    pub(crate) fn bins(&self, sight: &Sight<'_>, [columns, rows]: [usize; 2]) -> Bins {
        let scale = [0, 1].map(|row| sight.frame.view_projection.row(row).truncate().length());
        Bins::new(&rects(&self.plants, |index, plant| self.seen(sight, index, plant, scale)), columns, rows)
    }

    /// By tile of the shadow map.
    pub(crate) fn shadow_bins(&self, frame: &FrameUniform) -> Bins {
        let side = SHADOW_SIDE as f32;
        let scale = [0, 1].map(|row| frame.shadow.row(row).truncate().length() * side);
        let rect = |index: usize, plant: &Plant| {
            let centre = shadows::place(frame, plant.root.into(), 0.0);
            if plant.height <= 0.0 || (centre.x - 0.5).abs().max((centre.y - 0.5).abs()) > 0.52 {
                return None;
            }
            let reach = Vec2::from(scale) * self.reach(plant) + 1.0;
            let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
            for at in 0..self.joints_each() {
                let place = shadows::place(frame, joint(self.joints_of(index), at), 0.0).truncate() * side;
                (low, high) = (low.min(place), high.max(place));
            }
            Rect::under((low - reach).to_array(), (high + reach).to_array(), [SHADOW_SIDE; 2], TILE as u32)
        };
        Bins::new(&rects(&self.plants, rect), TILES, TILES)
    }

    /// Tiles a plant may touch, on the safe side; `scale`: how far a metre at distance 1 reaches over the picture's halves.
    fn seen(&self, sight: &Sight<'_>, index: usize, plant: &Plant, scale: [f32; 2]) -> Option<Rect> {
        self.keep(sight, plant)?;
        let (reach, size) = (self.reach(plant), sight.pixels());
        let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        let (mut behind, joints) = (0, self.joints_of(index));
        for at in 0..self.joints_each() {
            let clip = sight.clip(joint(joints, at));
            if clip.w - reach < NEAR {
                behind += usize::from(clip.w + reach < NEAR);
                (low, high) = (Vec2::NEG_INFINITY, Vec2::INFINITY);
                continue;
            }
            let middle = Vec2::new(clip.x, clip.y) / clip.w;
            let around = reach * (Vec2::from(scale) + middle.abs()) / (clip.w - reach);
            (low, high) = (low.min(middle - around), high.max(middle + around));
        }
        if behind == self.joints_each() {
            return None;
        }
        let corner = |ndc: Vec2| Vec2::new((0.5 + 0.5 * ndc.x) * size.x, (0.5 - 0.5 * ndc.y) * size.y);
        let (a, b) = (corner(low), corner(high));
        Rect::under([a.x - 1.0, b.y - 1.0], [b.x + 1.0, a.y + 1.0], sight.size, tile::SIDE)
    }

    /// Draws into a tile of the shadow map.
    pub(crate) fn draw_shadow(&self, frame: &FrameUniform, clumps: &Clumps, tile: &mut ShadowTile, which: &[u32]) {
        let side = SHADOW_SIDE as f32;
        let (mut leaves, mut points) = (Vec::new(), Vec::new());
        for &index in which {
            let plant = &self.plants[index as usize];
            let clump = clumps.layer(plant.layer);
            for card in 0..self.cards() {
                self.corners(index as usize, plant, card, 1.0, &mut leaves);
                points.clear();
                points.extend(leaves.iter().map(|leaf| shadows::place(frame, leaf.place, 0.0) * Vec3::new(side, side, 1.0)));
                for three in self.triangles() {
                    let at = three.map(|corner| Vec2::new(leaves[corner].card.x, 1.0 - leaves[corner].card.y));
                    tile.draw(three.map(|corner| points[corner]), Some(&Cutout { clump, at }));
                }
            }
        }
    }

    /// Draws into a tile of the picture.
    pub(crate) fn draw(&self, sight: &Sight<'_>, clumps: &Clumps, tile: &mut Tile, which: &[u32]) {
        let (mut leaves, mut clips) = (Vec::new(), Vec::new());
        for &index in which {
            let plant = &self.plants[index as usize];
            let Some(keep) = self.keep(sight, plant) else { continue };
            let pattern = patchwork(sight.pattern(plant.root.into()));
            let (clump, root) = (clumps.layer(plant.layer), plant.root[1]);
            let of = LeafOf { style: &self.style, clump, patchwork: pattern, tint: plant.tint, root };
            for card in 0..self.cards() {
                self.corners(index as usize, plant, card, keep, &mut leaves);
                see(sight, &leaves, &mut clips);
                for three in self.triangles() {
                    clipped(three.map(|corner| clips[corner]), sight.pixels(), |triangle| {
                        tile.draw(triangle, |quad| leaves::shade(sight, &of, quad, &mut leaves, three));
                    });
                }
            }
        }
    }

    /// Draws the outputs of what lies in a tile; `then`: the same plants as they were, seen from `before`.
    pub(crate) fn trace(&self, sight: &Sight<'_>, clumps: &Clumps, tile: &mut Trace<'_>, which: &[u32], then: &Self) {
        let (mut leaves, mut clips, mut were) = (Vec::new(), Vec::new(), Vec::new());
        for &index in which {
            let at = index as usize;
            let (plant, was) = (&self.plants[at], &then.plants[at]);
            let Some(kept) = self.keep(sight, plant) else { continue };
            let (clump, before) = (clumps.layer(plant.layer), keep(then.gone(tile.before.eye.truncate(), was)));
            for card in 0..self.cards() {
                self.corners(at, plant, card, kept, &mut leaves);
                then.corners(at, was, card, before, &mut were);
                see(sight, &leaves, &mut clips);
                for three in self.triangles() {
                    let corners = three.map(|corner| leaves[corner]);
                    let trail = tile.trail(three.map(|corner| clips[corner]), three.map(|corner| were[corner].place), was.layer);
                    tile.draw(&trail, |quad| leaves::cover(sight, &self.style, clump, quad, &corners).map(|cover| cover >= COVERAGE));
                }
            }
        }
    }
}

/// Clip space of corners.
fn see(sight: &Sight<'_>, leaves: &[Leaf], clips: &mut Vec<Vec4>) {
    clips.clear();
    clips.extend(leaves.iter().map(|leaf| sight.clip(leaf.place)));
}

/// What the fading leaves of a plant's size.
fn keep(gone: f32) -> f32 {
    1.0 - 0.85 * gone
}
