//! How blades without a state stand at a place: between the virtual blades around it.
//!
//! Belyaev et al. 2011, §3.3; methods §3.4. Reads moments of the nine patches around, and the wind where they sleep. Twin: `standing.wgsl`.

use super::blade::MOST_SEGMENTS;
use super::frame::{Frame, UPRIGHT, bend_towards, product, rotation};
use super::joint::{Bends, count, rest_turn};
use super::model::ChainModel;
use super::virtual_inertia::{pose, turned};
use crate::math;
use crate::state::NONE;

/// Moments of the virtual blades around one patch.
pub struct Standing<'a> {
    /// What they move by.
    pub chain: &'a ChainModel,
    /// Slots of the 3×3 patches around it, or none.
    pub around: [u32; 9],
    /// How far virtual blades rule over steady wind at the patch's corners (−−, +−, −+, ++).
    pub weights: [f32; 4],
    /// Patch side, m.
    pub patch_side: f32,
}

impl Standing<'_> {
    /// Moments of the virtual blade number `at` (which may lie in a neighbour) in `level`, planes by slot; `steady` where that patch sleeps.
    fn blade(&self, level: &[Box<[f32]>], at: [i32; 2], steady: &Bends) -> Bends {
        let side = self.chain.virtual_side as i32;
        let over = at.map(|along| i32::from(along >= side) - i32::from(along < 0));
        let slot = self.around[((over[1] + 1) * 3 + over[0] + 1) as usize];
        let Some(planes) = level.get(slot as usize).filter(|planes| slot != NONE && !planes.is_empty()) else { return *steady };
        let area = (side * side) as usize;
        let index = ((at[1] - over[1] * side) * side + at[0] - over[0] * side) as usize;
        let mut found = [[0.0; 2]; MOST_SEGMENTS];
        for (i, moment) in found[..count(&self.chain.coefficients)].iter_mut().enumerate() {
            *moment = [planes[2 * i * area + index], planes[(2 * i + 1) * area + index]];
        }
        found
    }

    /// Whether any of the patches around sleeps, so that the wind must be known.
    fn needs_wind(&self) -> bool {
        self.around.contains(&NONE) || self.weights != [1.0; 4]
    }

    /// Moments at `local` metres (x, z) from the patch's corner, as of an upright blade. `wind` is asked for where it is needed.
    pub fn moments(&self, level: &[Box<[f32]>], local: [f32; 2], wind: impl Fn() -> [f32; 2]) -> Bends {
        let steady = if self.needs_wind() { self.chain.steady.at(wind())[1] } else { [[0.0; 2]; MOST_SEGMENTS] };
        if self.around == [NONE; 9] {
            return steady;
        }
        let at = local.map(|metres| metres / self.patch_side * self.chain.virtual_side as f32 - 0.5);
        let corner = at.map(math::floored);
        let f = [at[0] - corner[0] as f32, at[1] - corner[1] as f32];
        let blade = |x: i32, z: i32| self.blade(level, [corner[0] + x, corner[1] + z], &steady);
        let (a, b, c, d) = (blade(0, 0), blade(1, 0), blade(0, 1), blade(1, 1));
        let [p, q, r, s] = self.weights;
        let (x, z) = (local[0] / self.patch_side, local[1] / self.patch_side);
        let (low, high) = (p + (q - p) * x, r + (s - r) * x);
        let weight = low + (high - low) * z;
        let mut found = steady;
        for i in 0..count(&self.chain.coefficients) {
            for axis in 0..2 {
                let low = a[i][axis] + (b[i][axis] - a[i][axis]) * f[0];
                let high = c[i][axis] + (d[i][axis] - c[i][axis]) * f[0];
                let moved = low + (high - low) * f[1];
                found[i][axis] = steady[i][axis] + (moved - steady[i][axis]) * weight;
            }
        }
        found
    }

    /// ψ of a blade planted in `base` that curls at rest, under the moments of an upright one.
    pub fn pose(&self, base: &Frame, curl: f32, moments: &Bends) -> Bends {
        pose(&self.chain.coefficients, base, curl, &moments.map(|moment| turned(base, &UPRIGHT, moment)))
    }
}

/// How far each segment of a blade leans beyond what it does by itself: ground vectors (x, z) \[rad\], as the continuum's bends. `heading` is the unit
/// ground vector it leans along by itself, `lean` rad at the root and `curl` more at the tip.
pub fn leans(chain: &ChainModel, base: &Frame, heading: [f32; 2], [lean, curl]: [f32; 2], bends: &Bends, out: &mut [[f32; 2]]) {
    let co = &chain.coefficients;
    let mut frame = *base;
    for (i, out) in out.iter_mut().enumerate().take(count(co)) {
        frame = product(&frame, &rotation([bends[i][0], bends[i][1] + rest_turn(co, curl, i)]));
        let [x, y, z] = frame[2];
        // In an upright frame: what leans towards −z there leans towards +z here.
        let [a, b] = bend_towards([x, -z, y]);
        let along = (i as f32 + 0.5) / co.segments as f32;
        let own = lean + curl * along * along;
        *out = [b - heading[0] * own, a - heading[1] * own];
    }
}
