//! Plants that go on swinging when the numbers change by which they swing: each motion becomes the one that begins where it is, as fast as it is.
//!
//! Methods §2: the closed form from (θ₀, θ̇₀) holds from any moment on. Twin: `rebase.wgsl`.

use super::model::OscillatorCoefficients;
use super::swing::{Own, Record};
use crate::placement::{self, Growing, PlacementParameters};
use crate::state::PatchKey;

impl Record {
    /// The same motion as of step `now`, by the numbers it was left with; nothing where it is long at rest.
    #[inline(always)]
    pub fn rebased(&self, co: &OscillatorCoefficients, own: &Own, now: u32) -> Self {
        let steps = self.steps_to(now);
        if *self == Self::default() || self.is_aged(co, now) {
            return Self::default();
        }
        // What a body holds in this very step has not begun to swing.
        if steps <= 0 { *self } else { self.later(own, steps as f32 * co.dt, now) }
    }
}

/// Rebases all plants of a patch to step `now`; `co` are the numbers till now, `grown` says how far each has grown, or nothing if all have.
pub fn rebase(co: &OscillatorCoefficients, placement: &PlacementParameters, patch: PatchKey, grown: &[u8], records: &mut [f32], now: u32) {
    let area = records.len() / 4;
    for cell in 0..area {
        let record = Record::load(records, area, cell);
        if record == Record::default() {
            continue;
        }
        let at = [cell as u32 % placement.cells, cell as u32 / placement.cells];
        let plant = placement::plant(placement, patch, at);
        let share = grown.get(cell).copied().unwrap_or(u8::MAX);
        let height = plant.and_then(|plant| placement::grown(plant, Growing::of_share(share))).map_or(0.0, |plant| plant.height);
        let own = Own::of(co, placement::variety(placement, patch, cell as u32), height);
        record.rebased(co, &own, now).store(records, area, cell);
    }
}
