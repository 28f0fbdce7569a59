//! A small plane of waves of one plant, for what bodies and local winds do to it alone.
//!
//! Not in the paper: there only wind moves plants. A body that brushes past carries the leaves it covers along, as far as the plane shows its way, and
//! parts them to its sides; waves and rest are those of the wind's plane. Twin: `harmonic.wgsl`.

use super::plane::{HarmonicCoefficients, Held, taken_along};
use crate::interaction::reaction::{Felt, Sums};
use crate::math::{lower, upper};
use crate::plan::Brush;
use crate::state::Waves;

/// Cells along a side.
pub const TOUCH_SIDE: u32 = 16;
/// Share of its change that V of a cell loses in 1/60 s under a body.
const HOLD: f32 = 0.35;
/// How fast leaves give way to the sides, over how fast the body comes through.
const PARTING: f32 = 0.5;

impl Brush {
    /// `hold` of a step of `dt` \[s\].
    pub fn hold(dt: f32) -> f32 {
        lower(60.0 * dt * HOLD, 0.9)
    }

    /// What it does to the middle of a cell.
    fn on(&self, cell: [f32; 2]) -> Held {
        let [x, y] = [0, 1].map(|axis: usize| (cell[axis] - self.at[axis]) / self.half[axis]);
        let (across, up) = (if x < 0.0 { -x } else { x }, if y < 0.0 { -y } else { y });
        let rim = upper(1.0 - across * across, 0.0) * upper(1.0 - up * up, 0.0);
        let share = self.hold * lower(3.0 * rim, 1.0);
        ([self.velocity[0] + PARTING * self.through * x, self.velocity[1]], share)
    }
}

/// Middle of a cell: right of the root, and above it.
fn middle(cell: usize) -> [f32; 2] {
    let side = TOUCH_SIDE as usize;
    [(cell % side) as f32 + 0.5 - 0.5 * TOUCH_SIDE as f32, (cell / side) as f32 + 0.5]
}

/// What a body feels of the leaves of a cell of `mass` kg to whose velocity it adds `change` m/s in a step of `dt` s: N along the plane's right and up, and
/// against its way through the plane. Leaves that it parts to its sides cost it as much power as they take up.
#[inline(always)]
fn felt_of(brush: &Brush, cell: [f32; 2], change: [f32; 2], mass: f32, dt: f32) -> [f32; 3] {
    let [right, up] = change.map(|part| mass / dt * part);
    let parted = PARTING * (cell[0] - brush.at[0]) / brush.half[0];
    [-right, -up, right * parted]
}

/// One step of `dt` s of a plant's plane, whose cells have leaves of `mass` kg, in a local wind \[m/s along the plane\] and under some bodies; `felt` is told what
/// each of those feels.
pub fn step_touched(
    waves: &mut Waves,
    co: &HarmonicCoefficients,
    wind: [f32; 2],
    brushes: &[Brush],
    (mass, dt): (f32, f32),
    felt: &mut [Sums],
) {
    // The one that holds most.
    let most = |cell: usize| {
        let at = middle(cell);
        let all = brushes.iter().enumerate().map(|(number, brush)| (number, brush.on(at)));
        all.fold((0, ([0.0; 2], 0.0)), |most, one| if one.1.1 > most.1.1 { one } else { most })
    };
    if !brushes.is_empty() {
        for (cell, (here, old)) in waves.now.iter().zip(&waves.old).enumerate() {
            let (number, (pushed, share)) = most(cell);
            if share > 0.0
                && let Some(sums) = felt.get_mut(number)
            {
                let change = [0, 1].map(|part: usize| taken_along(here[part], co.carried(here[part], old[part]), pushed[part], share));
                sums.add(&Felt { force: felt_of(&brushes[number], middle(cell), change, mass, dt), ..Felt::default() });
            }
        }
    }
    waves.step_apart(co, wind, &|cell| most(cell).1);
}
