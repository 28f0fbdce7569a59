//! How a sheet stands in the wind where nothing touches it.
//!
//! Orthmann et al. 2009, §5.1; methods §4. Reads the bend at both ends of its foot: of any wind, or the paper's sum of sines. Twin: `wind.wgsl`.
//! Differs from the paper: segments tilt, more the higher they are, so columns keep their lengths; the paper moves the upper vertices.

use super::lengths::pass;
use super::sheet::{Sheet, SheetRoot, SpringsCoefficients, direction};
use crate::math;

/// Radians of a turn, as a share of 2³² parts.
const TURN: f32 = std::f32::consts::TAU / 4_294_967_296.0;

/// One of the sines that wind is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Bend at its crest along x and z, rad.
    pub bend: [f32; 2],
    /// Turns a metre along x and z, 1/m.
    pub turns: [f32; 2],
    /// Where it is at the patch's corner, in 2⁻³² of a turn: whole numbers wrap and never drift.
    pub phase: u32,
}

/// The bend of a weighted sum of sines at a place, m from the patch's corner; rad along x and z.
pub fn sway(waves: &[Wave], [x, z]: [f32; 2]) -> [f32; 2] {
    let mut bend = [0.0; 2];
    for wave in waves {
        let turns = wave.turns[0] * x + wave.turns[1] * z;
        let part = turns - math::floored(turns) as f32;
        let sine = math::sin_cos(wave.phase as f32 * TURN + part * std::f32::consts::TAU).0;
        bend = [bend[0] + wave.bend[0] * sine, bend[1] + wave.bend[1] * sine];
    }
    bend
}

/// The sheet in wind that bends its first column's tip by `bends[0]` and its last one's by `bends[1]` (rad along x and z, beside its lean).
pub fn pose(co: &SpringsCoefficients, root: &SheetRoot, bends: [[f32; 2]; 2]) -> Sheet {
    let (columns, rows) = co.sides();
    let mut sheet = Sheet::of(co, root, |column, segment| {
        let (across, up) = (column as f32 / (columns - 1) as f32, (segment + 1) as f32 / (rows - 1) as f32);
        let bend = |axis: usize| root.lean[axis] + up * (bends[0][axis] + across * (bends[1][axis] - bends[0][axis]));
        direction([bend(0), bend(1)])
    });
    pass(co, root, &mut sheet);
    sheet
}
