//! Settings of the sheet representation: one billboard that bends as a smooth surface.
//!
//! Orthmann et al. 2009, §5.2 (the sheet) and §8 (smooth drawing).

use super::error::{Problem, Trail};
use super::parameters::{parameters, parameters_with_overrides};
use super::springs::Springs;

parameters_with_overrides! {
    /// How the sheet of a plant is cut, drawn and coloured. Colours are linear red, green and blue.
    pub struct Sheet, SheetOverrides {
        /// Columns of the sheet: how finely it bends from side to side. With response `Springs` those are meant.
        columns: u32 = 3, "" in 2..=9;
        /// Rows of the sheet, the one at the root included: how finely it bends from root to tip. With response `Springs` those are meant.
        rows: u32 = 3, "" in 2..=9;
        /// Points along each side with which it is drawn near the camera: how smooth it looks.
        points: u32 = 5, "" in 2..=9;
        /// Width of the sheet.
        width: f32 = 0.75, "m" in 0.01..=5.0;
        /// Distance from the camera beyond which a sheet is drawn with its four corners.
        plain_distance: f32 = 40.0, "m" in 1.0..=1000.0;
        /// Colour at the root.
        colour_root: [f32; 3] = [0.030, 0.050, 0.015], "" in 0.0..=1.0;
        /// Colour at the tip.
        colour_tip: [f32; 3] = [0.200, 0.260, 0.070], "" in 0.0..=1.0;
        /// Share of dry, straw-coloured blades.
        dryness: f32 = 0.35, "" in 0.0..=1.0;
    }
    extra {}
}

impl Sheet {
    /// This sheet with `overrides`, of a stand whose response keeps sheets of vertices: those are drawn.
    pub(super) fn of_springs(&self, springs: &Springs, overrides: &SheetOverrides, trail: &Trail) -> Result<Self, Problem> {
        for (name, given, kept) in [("columns", overrides.columns, springs.columns), ("rows", overrides.rows, springs.rows)] {
            if let Some(given) = given.filter(|given| *given != kept) {
                let message = format!("`{name}` of the sheet is {given}, and the response's sheets have {kept}");
                return Err(Problem::at(trail.clone().key(name), message).help(format!("write `{name}` in `Springs(…)` only")));
            }
        }
        Ok(Self { columns: springs.columns, rows: springs.rows, ..self.with(overrides) })
    }
}
