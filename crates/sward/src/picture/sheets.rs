//! Sheets: a plant becomes the points of a grid on the smooth surface through its sheet. Twin: `sheets.wgsl` of `sward_wgpu`.
//!
//! Orthmann et al. 2009, §5.1, §5.2 and §8. Reads the bends that the stand's response gives at both ends of the foot; writes points, row by
//! row from the root up.
//!
//! A response bends a plant segment by segment. The lowest segment of the sheet tilts as the response's lowest one does (the mean of both
//! ends), the highest as the response's highest one (each end by itself), and those between go evenly from one to the other: what is
//! bent steadily stays straight, what whips is curved. A sheet with two rows tilts by the mean of lowest and highest.

use glam::Vec3;

use super::plan::PatchDraw;
use super::prepare::{Preparing, Who};
use crate::geometry::billboard::CLEARANCE;
use crate::math;
use crate::response::springs::{SheetRoot, SpringsCoefficients, pose, surface};
use crate::wind::Phases;

/// A plant where it stands.
pub(super) struct Rooted {
    /// As its bends ask.
    pub(super) who: Who,
    /// Height of the ground at its root, m.
    pub(super) ground: f32,
    /// Height as it is drawn, m.
    pub(super) height: f32,
    /// How far it is drawn as a plain quad, 0 to 1.
    pub(super) straight: f32,
    /// Heading of its foot, rad.
    pub(super) yaw: f32,
    /// Width, m.
    pub(super) width: f32,
}

impl Preparing<'_> {
    /// Points of a plant's sheet.
    pub(super) fn sheet(&self, draw: &PatchDraw, phases: &Phases, plant: &Rooted, points: &mut [[f32; 4]]) {
        let [columns, rows, ..] = self.uniform.sheet;
        let co = SpringsCoefficients::new([columns, rows], 0, 0.0, 1.0, 1.0);
        let (root, bends) = self.sheet_bent(&co, draw, phases, plant);
        let sheet = self.sheet_at(&co, draw, &plant.who, &root, pose(&co, &root, bends));
        let drawn = self.uniform.drawn as usize;
        let point = |across: f32, up: f32| {
            let (last, top) = ((co.columns - 1) as f32, (co.rows - 1) as f32);
            Vec3::from(surface::point(&co, &root, &sheet, across * last, up * top))
        };
        let mut corners = [Vec3::ZERO; 4];
        if plant.straight > 0.0 {
            corners = [point(0.0, 0.0), point(1.0, 0.0), point(0.0, 1.0), point(1.0, 1.0)];
        }
        let shift = Vec3::new(draw.offset[0], 0.0, draw.offset[1]);
        for (k, out) in points.iter_mut().enumerate() {
            let (across, up) = ((k % (drawn + 1)) as f32 / drawn as f32, (k / (drawn + 1)) as f32 / drawn as f32);
            let mut at = point(across, up);
            if plant.straight > 0.0 {
                let [low, high] = [corners[0].lerp(corners[1], across), corners[2].lerp(corners[3], across)];
                at = at.lerp(low.lerp(high, up), plant.straight);
            }
            let clear = if up > 0.0 { CLEARANCE } else { 0.0 };
            at.y = math::upper(at.y, self.terrain.height(draw.anchor, [at.x, at.z]) + clear);
            *out = (at + shift).extend(0.0).to_array();
        }
    }

    /// The root of a sheet, and the bends of [`pose`] at both ends of its foot.
    fn sheet_bent(&self, co: &SpringsCoefficients, draw: &PatchDraw, phases: &Phases, plant: &Rooted) -> (SheetRoot, [[f32; 2]; 2]) {
        let (placement, segments) = (&self.uniform.placement, (self.uniform.segments as usize).clamp(1, 8));
        let (sine, cosine) = math::sin_cos(plant.yaw);
        let [x, z] = plant.who.local;
        let mut root = SheetRoot {
            at: [x, plant.ground, z],
            length: plant.height,
            half_width: [cosine, sine].map(|part| 0.5 * plant.width * part),
            slope: self.terrain.gradient(draw.anchor, plant.who.local),
            ..SheetRoot::default()
        };
        let patch_side = placement.spacing * placement.cells as f32;
        let ends = [-1.0, 1.0].map(|side| {
            // Cells and texels are asked within the patch only, as by plants.
            let local = [0, 1].map(|axis| math::clamped(plant.who.local[axis] + side * root.half_width[axis], 0.0, patch_side));
            let mut bends = [[0.0; 2]; 8];
            self.bends(draw, phases, &Who { local, ..plant.who }, &mut bends[..segments]);
            [bends[0], bends[segments - 1]]
        });
        let tilts = co.rows - 1;
        let mut bends = [ends[0][1], ends[1][1]];
        for axis in 0..2 {
            let (low, high) = (0.5 * (ends[0][0][axis] + ends[1][0][axis]), 0.5 * (ends[0][1][axis] + ends[1][1][axis]));
            if tilts == 1 {
                bends.iter_mut().for_each(|bend| bend[axis] += 0.5 * (low - high));
            } else {
                let lean = (tilts as f32 * low - high) / (tilts - 1) as f32;
                root.lean[axis] = lean;
                bends.iter_mut().for_each(|bend| bend[axis] -= lean);
            }
        }
        (root, bends)
    }
}
