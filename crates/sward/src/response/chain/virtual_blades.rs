//! The virtual blades of a patch: upright ones on an even grid, moved by the wind of their place for all real blades around them.
//!
//! Belyaev et al. 2011, §3.3; methods §3.4. State per virtual blade: ψ and ω of each joint. Reads wind. Writes state, and the moments
//! that hold each blade beside spring and weight: what real blades bend by. Twin: `virtual_pass` of the hosts.

use super::blade::MOST_SEGMENTS;
use super::frame::UPRIGHT;
use super::joint::{Bends, ChainState, count, step};
use super::model::ChainModel;
use super::virtual_inertia::moments;
use crate::wind::{Phases, WindField};

/// The planes of one patch: of states 4 a segment, of moments 2 a segment; `virtual_side`² values each.
pub struct VirtualBlades<'a> {
    /// What they move by.
    pub chain: &'a ChainModel,
    /// Patch side, m.
    pub patch_side: f32,
    /// ψx, ψy, ωx, ωy of joint 0, then of joint 1, and so on.
    pub state: &'a mut [f32],
    /// Moments after the step: x, y of joint 0, and so on.
    pub moments: &'a mut [f32],
}

impl VirtualBlades<'_> {
    fn place(&self, index: usize) -> [f32; 2] {
        let side = self.chain.virtual_side as usize;
        let spacing = self.patch_side / self.chain.virtual_side as f32;
        [(index % side) as f32, (index / side) as f32].map(|along| (along + 0.5) * spacing)
    }

    fn store(&mut self, index: usize, area: usize, state: &ChainState) {
        let n = count(&self.chain.coefficients);
        let held = moments(&self.chain.coefficients, &UPRIGHT, &state.bends());
        for i in 0..n {
            for part in 0..4 {
                self.state[(4 * i + part) * area + index] = state.joints[i][part];
            }
            for part in 0..2 {
                self.moments[(2 * i + part) * area + index] = held[i][part];
            }
        }
    }

    /// All blades stand as in a steady wind.
    pub fn wake(&mut self, wind: &WindField, phases: &Phases) {
        let area = (self.chain.virtual_side * self.chain.virtual_side) as usize;
        for index in 0..area {
            let [bends, _] = self.chain.steady.at(wind.velocity_local(phases, self.place(index)));
            self.store(index, area, &ChainState::still(&bends));
        }
    }

    /// One step. Returns the largest squared deviation from how they would stand in steady wind: of ψ \[rad²\], or of ω \[rad²/s²\] if that
    /// is larger. `keep` is the share of it that a fading patch keeps.
    pub fn step(&mut self, wind: &WindField, phases: &Phases, dt: f32, keep: f32) -> f32 {
        let co = &self.chain.coefficients;
        let n = count(co);
        let area = (self.chain.virtual_side * self.chain.virtual_side) as usize;
        let mut largest = 0.0;
        for index in 0..area {
            let mut state = ChainState::default();
            for i in 0..n {
                state.joints[i] = [0, 1, 2, 3].map(|part| self.state[(4 * i + part) * area + index]);
            }
            let air = wind.velocity_local(phases, self.place(index));
            let mut next = step(co, &UPRIGHT, 0.0, [air[0], 0.0, air[1]], dt, &state);
            let [steady, _] = self.chain.steady.at(air);
            let off = deviation(&mut next, &steady, n, keep);
            largest = if off > largest { off } else { largest };
            self.store(index, area, &next);
        }
        largest
    }
}

/// The largest squared deviation of a blade's `n` joints from `steady` after all keep a share of theirs.
#[inline(always)]
pub(super) fn deviation(state: &mut ChainState, steady: &Bends, n: usize, keep: f32) -> f32 {
    let mut largest = 0.0;
    for i in 0..if n < MOST_SEGMENTS { n } else { MOST_SEGMENTS } {
        let [x, y, wx, wy] = state.joints[i];
        let (dx, dy) = (keep * (x - steady[i][0]), keep * (y - steady[i][1]));
        let (wx, wy) = (keep * wx, keep * wy);
        if keep < 1.0 {
            state.joints[i] = [steady[i][0] + dx, steady[i][1] + dy, wx, wy];
        }
        let (bend, rate) = (dx * dx + dy * dy, wx * wx + wy * wy);
        let most = if bend > rate { bend } else { rate };
        largest = if most > largest { most } else { largest };
    }
    largest
}
