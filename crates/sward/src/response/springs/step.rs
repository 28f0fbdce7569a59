//! One step of one billboard.
//!
//! Orthmann et al. 2009, §5, Fig. 3; methods §4. Reads distance maps, the pose in the wind. Writes the stored sheet, steps since the last
//! contact, ways out. Twin: `step.wgsl`. Differs from the paper: recovery into a body is no recovery, so grass leans on what stands still.

use super::lay::{lay, spread};
use super::lengths::pass;
use super::push::{Faces, Maps, TOLERANCE, push};
use super::recover::recovered;
use super::sheet::{MOST_VERTICES, Sheet, SheetRoot, SpringsCoefficients};
use super::sweep::sweep;

/// Rounds of push-out and length pass in a moment.
pub const ROUNDS: u32 = 8;
/// How deep a vertex may be left before the other way is tried, m.
const DEEP: f32 = 2e-3;
/// Times as many rounds that one is given: it asks for small moves.
const PATIENCE: u32 = 4;

/// What a step changes of a billboard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldSheet {
    /// As it was left at the last contact.
    pub stored: Sheet,
    /// Steps since then; 0: something touches it.
    pub steps: u32,
    /// By which way each vertex left the body that touches it, 0 for none.
    pub faces: Faces,
}

impl HeldSheet {
    /// A billboard that nothing has touched: it stands as the wind has it.
    pub fn new(target: &Sheet) -> Self {
        Self { stored: *target, steps: 0, faces: [0; MOST_VERTICES] }
    }

    /// Its vertices where the wind would have them at `target`.
    pub fn shown(&self, co: &SpringsCoefficients, root: &SheetRoot, target: &Sheet) -> Sheet {
        recovered(co, root, &self.stored, target, self.steps)
    }

    /// Whether nothing is left to recover.
    pub fn is_done(&self, co: &SpringsCoefficients) -> bool {
        super::recover::time_left(co, self.steps) <= 0.0
    }
}

/// Whether a body touches a sheet at any moment of the step.
pub fn is_touched(co: &SpringsCoefficients, root: &SheetRoot, maps: &Maps, sheet: &Sheet) -> bool {
    maps.reach(root) && (0..=maps.last()).any(|moment| maps.deepest(co, root, moment, sheet) > TOLERANCE)
}

/// One step. `target` is the pose in the wind; `heading` (x, z) is where a column falls that stands upright under a body: the body's way.
pub fn step(co: &SpringsCoefficients, root: &SheetRoot, maps: &Maps, target: &Sheet, heading: [f32; 2], held: &mut HeldSheet) {
    if root.length <= 0.0 {
        return;
    }
    let shown = held.shown(co, root, target);
    if is_touched(co, root, maps, &shown) {
        let mut sheet = shown;
        for moment in 0..=maps.last() {
            resolve(co, root, maps, moment, heading, &mut sheet, &mut held.faces);
        }
        (held.stored, held.steps) = (sheet, 0);
        return;
    }
    let next = recovered(co, root, &held.stored, target, held.steps.saturating_add(1));
    if is_touched(co, root, maps, &next) {
        // It leans on a body: it stays as it is, and starts anew once there is room.
        (held.stored, held.steps) = (shown, 0);
    } else {
        held.steps = held.steps.saturating_add(1);
        held.faces = [0; MOST_VERTICES];
    }
}

/// Out of the bodies of one moment: springs, then push-out and lengths in turn; what is left lies down; nothing jumps. Where that leaves a vertex
/// deep in a body, since the way led farther than it may move, the sheet as it was goes the shortest way instead, without springs.
pub fn resolve(
    co: &SpringsCoefficients,
    root: &SheetRoot,
    maps: &Maps,
    moment: u32,
    heading: [f32; 2],
    sheet: &mut Sheet,
    faces: &mut Faces,
) {
    let before = *sheet;
    if maps.deepest(co, root, moment, sheet) <= TOLERANCE {
        return;
    }
    let mut fixed = [false; MOST_VERTICES];
    for ((fixed, face), at) in fixed.iter_mut().zip(faces.iter_mut()).zip(&sheet.at) {
        *fixed = maps.is_under(root, moment, *at);
        *face = if maps.depth(root, moment, *at) > TOLERANCE { *face } else { 0 };
    }
    let mut least = f32::MAX;
    for attempt in 0..2 {
        let (mut moved, mut left) = (before, if attempt == 0 { *faces } else { [0; MOST_VERTICES] });
        for _ in 0..if attempt == 0 { co.iterations } else { 0 } {
            moved = sweep(co, root, &moved, &fixed);
        }
        for _ in 0..if attempt == 0 { ROUNDS } else { PATIENCE * ROUNDS } {
            let pushed = push(co, root, maps, moment, &mut moved, &mut left);
            pass(co, root, &mut moved);
            if !pushed {
                break;
            }
        }
        if attempt == 0 {
            lay(co, root, maps, moment, &mut moved, &left, heading);
        }
        spread(co, root, maps.last() + 1, &before, &mut moved);
        let deepest = maps.deepest(co, root, moment, &moved);
        if deepest < least {
            (least, *sheet, *faces) = (deepest, moved, left);
        }
        if least <= DEEP {
            break;
        }
    }
}
