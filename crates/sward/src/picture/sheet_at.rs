//! The sheet of a plant as its response has it. Twin: `sheet_at.wgsl` of `sward_wgpu`.
//!
//! Responses that know only bends leave a sheet where the wind and they would have it. A response that keeps sheets of its own, pushed
//! out of shape, answers with those here.

use super::plan::PatchDraw;
use super::prepare::{Preparing, Who};
use crate::response::springs::{Sheet, SheetRoot, SpringsCoefficients};

impl Preparing<'_> {
    /// The sheet of the plant `who` of a patch, at the moment of the picture; `target` is where its bends alone put it.
    pub(super) fn sheet_at(&self, _co: &SpringsCoefficients, _draw: &PatchDraw, _who: &Who, _root: &SheetRoot, target: Sheet) -> Sheet {
        target
    }
}
