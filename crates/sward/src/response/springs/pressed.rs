//! What a body feels of a billboard that it deforms.
//!
//! Not in the paper, whose springs keep lengths and know no forces. A deformed sheet is taken as the plant it stands for, leaning as far as its middle column does: it would
//! turn back to the wind's pose with J κ, κ that of the species' continuum. While a body turns it, what the
//! body pushed out shows how far it went for that: its force along the ground does as much work as the plant takes up. A sheet that is held bears it. Twin: `pressed.wgsl`.

use super::push::{Faces, Maps};
use super::sheet::{Sheet, SheetRoot, SpringsCoefficients};
use super::vector::{minus, plus, size};
use crate::interaction::reaction::{CRUSHED, Felt, Leaning};
use crate::math;

/// Least turn, rad, and way, in lengths, of what is pushed aside.
const LEAST: f32 = 1e-5;

/// What one of the bodies at the end of the step feels about the middle of its cube, and which: `before` is the sheet at the start of the step, `after` at
/// its end, `target` how the wind would have it; `stiffness` J κ in N·m/rad.
pub fn felt(
    co: &SpringsCoefficients,
    root: &SheetRoot,
    maps: &Maps,
    [before, after, target]: [&Sheet; 3],
    faces: &Faces,
    stiffness: f32,
) -> Option<(u32, Felt)> {
    let (columns, rows) = co.sides();
    let whole = [0, rows - 1];
    let [x, z] = after.tilt(co, whole);
    let tilt = (x * x + z * z).sqrt();
    let towards = [x / math::upper(tilt, 1e-9), z / math::upper(tilt, 1e-9)];
    let rest = target.tilt(co, whole);
    let away = math::upper((x - rest[0]) * towards[0] + (z - rest[1]) * towards[1], 0.0);
    let (mut far, mut way, mut count) = (0.0, 0.0, 0.0);
    for vertex in columns..columns * rows {
        if faces[vertex] != 0 {
            let [dx, _, dz] = minus(after.at[vertex], before.at[vertex]);
            far += size(minus(after.at[vertex], after.at[vertex % columns]));
            way += dx * towards[0] + dz * towards[1];
            count += 1.0;
        }
    }
    let length = if count > 0.0 { far / count } else { 0.5 * root.length };
    let [bx, bz] = before.tilt(co, whole);
    let turn = tilt - bx * towards[0] - bz * towards[1];
    let (sine, cosine) = math::sin_cos(tilt);
    let aside = turn > LEAST && way > LEAST * root.length;
    let lever = if aside { cosine * way / (count * turn) } else { length };
    let at = plus(root.at, [sine * towards[0], cosine, sine * towards[1]], length);
    let (mut by, mut least) = (None, f32::MAX);
    for (number, head) in maps.heads.iter().enumerate().filter(|(_, head)| head.moment == maps.last()) {
        let centre = [head.centre[0], head.centre[1], head.centre[2]];
        let away = size(minus(at, centre)) / head.centre[3];
        if away < least {
            (by, least) = (Some((number as u32, centre)), away);
        }
    }
    let (number, centre) = by?;
    let fell = tilt > CRUSHED && bx * bx + bz * bz <= CRUSHED * CRUSHED;
    let crushed = if fell { 0.5 * stiffness * away * away } else { 0.0 };
    let leaning = Leaning { tilt, towards, moment: stiffness * away, lever, length, aside: if aside { 1.0 } else { 0.0 }, crushed };
    Some((number, leaning.felt(minus(root.at, centre))))
}
