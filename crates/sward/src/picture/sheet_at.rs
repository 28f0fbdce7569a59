//! The sheet of a plant as its response has it. Twins: `bent_at.wgsl` and `deformed_at.wgsl` of `sward_wgpu`.
//!
//! Orthmann et al. 2009, §5.1 and §5.5. Reads bends, or stored sheets; gives vertices at the size the plant is drawn.
//!
//! Most responses bend a plant segment by segment. The lowest segment of the sheet tilts as the response's lowest one does (the mean of both
//! ends of the foot), the highest as the response's highest one (each end by itself), and those between go evenly from one to the other:
//! what is bent steadily stays straight, what whips is curved. A sheet with two rows tilts by the mean of lowest and highest.
//!
//! Springs keep sheets of their own, of those billboards that a body touched. The others stand as the wind has them.

use super::plan::PatchDraw;
use super::prepare::{Preparing, Who};
use super::sheets::Rooted;
use crate::geometry::billboard::leaning;
use crate::math;
use crate::response::springs::{Sheet, SheetRoot, SpringsCoefficients, SpringsModel, pool, pose, target_of};
use crate::wind::Phases;

impl Preparing<'_> {
    /// The sheet of a plant of a patch, at the moment of the picture, where its drawn sheet is rooted in `root`.
    pub(super) fn sheet_at(&self, co: &SpringsCoefficients, draw: &PatchDraw, phases: &Phases, plant: &Rooted, root: &SheetRoot) -> Sheet {
        match &self.stand.springs {
            Some(springs) => self.deformed_at(springs, draw, phases, plant, root),
            None => self.bent_at(co, draw, phases, plant, root),
        }
    }

    fn bent_at(&self, co: &SpringsCoefficients, draw: &PatchDraw, phases: &Phases, plant: &Rooted, root: &SheetRoot) -> Sheet {
        let (placement, segments) = (&self.uniform.placement, (self.uniform.segments as usize).clamp(1, 8));
        let patch_side = placement.spacing * placement.cells as f32;
        let ends = [-1.0, 1.0].map(|side| {
            // Cells and texels are asked within the patch only, as by plants.
            let local = [0, 1].map(|axis| math::clamped(plant.who.local[axis] + side * root.half_width[axis], 0.0, patch_side));
            let mut bends = [[0.0; 2]; 8];
            self.bends(draw, phases, &Who { local, ..plant.who }, &mut bends[..segments]);
            [bends[0], bends[segments - 1]].map(|bend| leaning(bend, plant.who.plant))
        });
        let tilts = co.rows - 1;
        let (mut leaning, mut bends) = (*root, [ends[0][1], ends[1][1]]);
        for axis in 0..2 {
            let (low, high) = (0.5 * (ends[0][0][axis] + ends[1][0][axis]), 0.5 * (ends[0][1][axis] + ends[1][1][axis]));
            let mut shift = 0.5 * (low - high);
            if tilts > 1 {
                leaning.lean[axis] = (tilts as f32 * low - high) / (tilts - 1) as f32;
                shift = -leaning.lean[axis];
            }
            bends.iter_mut().for_each(|bend| bend[axis] += shift);
        }
        pose(co, &leaning, bends)
    }

    /// The stored sheet, or the wind's pose, of the billboard as it is simulated; then as it is drawn: shrunk towards its root where plants
    /// thin out, and wider or narrower about the middle of each row.
    fn deformed_at(&self, springs: &SpringsModel, draw: &PatchDraw, phases: &Phases, plant: &Rooted, root: &SheetRoot) -> Sheet {
        let (co, area) = (&springs.coefficients, self.uniform.placement.cells * self.uniform.placement.cells);
        let (wide, tall) = (plant.width / springs.width, plant.height / plant.who.tall.max(1e-9));
        let own = SheetRoot { length: plant.who.tall, half_width: root.half_width.map(|part| part / wide), lean: plant.who.plant, ..*root };
        let target = target_of(springs, &own, self.wind, phases);
        let stored = pool::stored(co, self.cells, draw.slots[4], plant.who.index % area);
        let mut sheet = stored.map_or(target, |stored| pool::load(co, &own, stored).shown(co, &own, &target));
        let (columns, rows) = co.sides();
        for row in sheet.at[..columns * rows].chunks_exact_mut(columns) {
            let (left, right) = (row[(columns - 1) / 2], row[columns / 2]);
            for axis in 0..3 {
                let middle = 0.5 * (left[axis] + right[axis]);
                let there = root.at[axis] + tall * (middle - root.at[axis]);
                row.iter_mut().for_each(|at| at[axis] = there + wide * (at[axis] - middle));
            }
        }
        sheet
    }
}
