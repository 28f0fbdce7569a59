//! Sheets: a plant becomes the points of a grid on the smooth surface through its sheet. Twin: `sheets.wgsl` of `sward_wgpu`.
//!
//! Orthmann et al. 2009, §5.1, §5.2 and §8. Reads the sheet that the stand's response gives ([`super::sheet_at`]); writes points, row by row
//! from the root up.

use glam::Vec3;

use super::plan::PatchDraw;
use super::prepare::{Preparing, Who};
use crate::geometry::billboard::CLEARANCE;
use crate::math;
use crate::response::springs::{SheetRoot, SpringsCoefficients, surface};
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
        let (sine, cosine) = math::sin_cos(plant.yaw);
        let [x, z] = plant.who.local;
        let root = SheetRoot {
            at: [x, plant.ground, z],
            length: plant.height,
            half_width: [cosine, sine].map(|part| 0.5 * plant.width * part),
            slope: self.terrain.gradient(draw.anchor, plant.who.local),
            ..SheetRoot::default()
        };
        let sheet = self.sheet_at(&co, draw, phases, plant, &root);
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
}
