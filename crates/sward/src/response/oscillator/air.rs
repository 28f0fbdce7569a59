//! How plants stand in the wind: the tilt of steady wind, which they follow as slowly as they swing.
//!
//! Methods §2: the static tilt `atan(k_w |W|^(4/3) / (k − g))` along W, low-passed at ω₀ once per texel, not per plant. Texels stand on an even grid
//! of each awake patch; where a patch sleeps the tilt is that of the moment's wind. Twin: `air.wgsl`.

use super::model::OscillatorCoefficients;
use crate::math;
use crate::state::NONE;
use crate::wind::{Phases, WindField, equilibrium};

/// The tilt at the texels of one patch: planes x, z after the step and x, z before it, `texels`² values each.
pub struct AirStep<'a> {
    /// What it follows by.
    pub co: &'a OscillatorCoefficients,
    /// Patch side, m.
    pub patch_side: f32,
    /// The planes.
    pub planes: &'a mut [f32],
}

impl AirStep<'_> {
    /// One step; `woken`: the patch wakes, and begins as its wind has it. `keep` is the share of its deviation from that wind that a fading patch
    /// keeps. Returns the largest squared deviation \[rad²\].
    pub fn step(&mut self, wind: &WindField, phases: &Phases, woken: bool, keep: f32) -> f32 {
        let side = self.co.texels as usize;
        let area = side * side;
        let spacing = self.patch_side / self.co.texels as f32;
        let mut largest = 0.0;
        for index in 0..area {
            let place = [(index % side) as f32, (index / side) as f32].map(|along| (along + 0.5) * spacing);
            let target = equilibrium(wind.velocity_local(phases, place), self.co.wind);
            let mut squared = 0.0;
            for (axis, target) in target.into_iter().enumerate() {
                let before = if woken { target } else { self.planes[axis * area + index] };
                let followed = before + self.co.follow * (target - before);
                let off = keep * (followed - target);
                self.planes[axis * area + index] = if keep < 1.0 { target + off } else { followed };
                self.planes[(2 + axis) * area + index] = before;
                squared += off * off;
            }
            largest = if squared > largest { squared } else { largest };
        }
        largest
    }
}

/// The tilt in the wind around one patch.
pub struct Air<'a> {
    /// What it goes by.
    pub co: &'a OscillatorCoefficients,
    /// Planes of each slot: see [`AirStep`].
    pub levels: &'a [Box<[f32]>],
    /// Slots of the 3×3 patches around it, or [`NONE`].
    pub around: [u32; 9],
    /// How far texels rule over the moment's wind at the patch's corners (−−, +−, −+, ++).
    pub weights: [f32; 4],
    /// Patch side, m.
    pub patch_side: f32,
}

impl Air<'_> {
    /// Tilt at texel `at`, which may lie in a neighbour; `still` where that sleeps.
    #[inline(always)]
    fn texel(&self, at: [i32; 2], behind: f32, still: [f32; 2]) -> [f32; 2] {
        let side = self.co.texels as i32;
        let over = at.map(|along| i32::from(along >= side) - i32::from(along < 0));
        let slot = self.around[((over[1] + 1) * 3 + over[0] + 1) as usize];
        let Some(planes) = self.levels.get(slot as usize).filter(|planes| slot != NONE && !planes.is_empty()) else { return still };
        let area = (side * side) as usize;
        let index = ((at[1] - over[1] * side) * side + at[0] - over[0] * side) as usize;
        [0, 1].map(|axis| {
            let (now, before) = (planes[axis * area + index], planes[(2 + axis) * area + index]);
            now + (before - now) * behind
        })
    }

    /// Tilt \[rad, ground vector\] at `local` m from the patch's corner, `behind` steps before the end of the step; `wind` gives the air's velocity
    /// there and is asked where it is needed.
    #[inline(always)]
    pub fn at(&self, local: [f32; 2], behind: f32, wind: impl Fn() -> [f32; 2]) -> [f32; 2] {
        let asleep = self.co.texels == 0 || self.around == [NONE; 9];
        let asks = asleep || self.around.contains(&NONE) || self.weights != [1.0; 4];
        let still = if asks { equilibrium(wind(), self.co.wind) } else { [0.0; 2] };
        if asleep {
            return still;
        }
        let at = local.map(|metres| metres / self.patch_side * self.co.texels as f32 - 0.5);
        let corner = at.map(math::floored);
        let f = [at[0] - corner[0] as f32, at[1] - corner[1] as f32];
        let texel = |x: i32, z: i32| self.texel([corner[0] + x, corner[1] + z], behind, still);
        let (a, b, c, d) = (texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1));
        let [p, q, r, s] = self.weights;
        let (x, z) = (local[0] / self.patch_side, local[1] / self.patch_side);
        let (low, high) = (p + (q - p) * x, r + (s - r) * x);
        let weight = low + (high - low) * z;
        [0, 1].map(|axis| {
            let low = a[axis] + (b[axis] - a[axis]) * f[0];
            let high = c[axis] + (d[axis] - c[axis]) * f[0];
            let tilt = low + (high - low) * f[1];
            if asks { still[axis] + (tilt - still[axis]) * weight } else { tilt }
        })
    }
}
