//! Recovery: a sheet goes back from where it was left to its pose in the wind, by the directions of its segments.
//!
//! Orthmann et al. 2009, §5.5, eq. 8; methods §4. Reads the stored sheet, steps since the last contact, the pose in the wind. Twin:
//! `recover.wgsl`.
//! Differs from the paper: directions are blended, not positions, so lengths hold; from the sheet as stored, not as last shown, so the frame
//! rate does not matter; t²(3 − 2t) starts and ends gently, t³ of the paper is a choice.

use super::lengths::pass;
use super::sheet::{Sheet, SheetRoot, SpringsCoefficients};
use super::vector::between;
use crate::math;

/// Recover time left, 1 at the last contact to 0, after a number of steps without one.
#[inline(always)]
pub fn time_left(co: &SpringsCoefficients, steps: u32) -> f32 {
    math::clamped(1.0 - steps as f32 * co.dt / co.recover, 0.0, 1.0)
}

/// Share of the stored sheet that is left: t²(3 − 2t), or t³.
#[inline(always)]
pub fn share_left(co: &SpringsCoefficients, steps: u32) -> f32 {
    let t = time_left(co, steps);
    if co.cubic == 1 { t * t * t } else { t * t * (3.0 - 2.0 * t) }
}

/// A sheet on its way from `stored` to `target`, `steps` after its last contact.
pub fn recovered(co: &SpringsCoefficients, root: &SheetRoot, stored: &Sheet, target: &Sheet, steps: u32) -> Sheet {
    if steps == 0 {
        return *stored;
    }
    let share = 1.0 - share_left(co, steps);
    let columns = co.sides().0;
    let mut sheet = Sheet::of(co, root, |column, segment| {
        let vertex = segment * columns + column;
        between(stored.way(columns, vertex), target.way(columns, vertex), share)
    });
    pass(co, root, &mut sheet);
    sheet
}
