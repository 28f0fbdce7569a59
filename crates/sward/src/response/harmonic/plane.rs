//! The waves on the plane: V'' = c²∇²V − κ(V − a·V_wind), damped, stepped by Verlet.
//!
//! Chen & Johan 2015, §3.3; methods §5. State: V \[m/s\], x and y of n × n cells of a periodic plane, now and one step before. Twin: `harmonic.wgsl`.
//! Differs from the paper: κ pulls V to what the wind makes of it. Without it V drifts without bound.

use crate::math::lower;
use crate::state::Waves;

/// Numbers of the kernel; the same layout in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct HarmonicCoefficients {
    /// c²Δt²/Δx².
    pub spread: f32,
    /// κΔt².
    pub restoring: f32,
    /// λ: share of its change that V loses in a step.
    pub damping: f32,
    /// a: velocity of the vegetation over that of the wind, in a steady wind.
    pub gain: f32,
}

impl HarmonicCoefficients {
    /// Of waves of `speed` \[m/s\] and vegetation that swings at `frequency` \[Hz\] with a damping `ratio`, on cells of `cell` \[m\] in steps of `dt`
    /// \[s\]. Frequency and speed are kept where the scheme is stable: 8c²Δt²/Δx² + κΔt² < 4 − 2λ.
    pub fn new(speed: f32, frequency: f32, ratio: f32, gain: f32, cell: f32, dt: f32) -> Self {
        let turn = std::f32::consts::TAU * frequency * dt;
        let damping = (1.0 - crate::math::exp_f64(-2.0 * f64::from(ratio * turn))) as f32;
        let restoring = lower(turn * turn, 1.0);
        let pace = speed * dt / cell;
        let spread = lower(pace * pace, 0.98 * (4.0 - 2.0 * damping - restoring) / 8.0);
        Self { spread, restoring, damping, gain }
    }

    /// The same for cells that bodies may hold by a share of up to `hold` of a step: they lose up to Λ = 1 − (1 − λ)(1 − hold) of their change and are drawn
    /// by hold²/4 more. Speed is kept where that is stable: 8c²Δt²/Δx² + κΔt² + hold²/4 < 4 − 2Λ.
    pub fn under(self, hold: f32) -> Self {
        let left = 2.0 + 2.0 * (1.0 - self.damping) * (1.0 - hold) - self.restoring - 0.25 * hold * hold;
        Self { spread: lower(self.spread, 0.98 * left / 8.0), ..self }
    }

    /// Change of V that goes on from the step before.
    pub(super) fn carried(&self, here: f32, old: f32) -> f32 {
        (1.0 - self.damping) * (here - old)
    }
}

/// What a body does to a cell: the velocity it has there \[m/s\], and how far it holds the cell, 0 to 1.
pub(super) type Held = ([f32; 2], f32);

/// What a body that holds a cell adds to V in a step, beside the change `carried` on from the step before: V is drawn from `here` to `pushed` by a spring
/// that just does not swing, and loses `share` of what it carries. V that were set at once would leap, and swing on by what it leapt: a body that holds
/// a cell now and then, such as a rotor, would pump it up without bound.
pub(super) fn taken_along(here: f32, carried: f32, pushed: f32, share: f32) -> f32 {
    0.25 * share * share * (pushed - here) - share * carried
}

impl Waves {
    /// Vegetation that rests, on `side` × `side` cells.
    pub fn new(side: usize) -> Self {
        let still = vec![[0.0; 2]; side * side];
        Self { side, now: still.clone(), old: still }
    }

    /// Cells along a side.
    pub fn side(&self) -> usize {
        self.side
    }

    /// One step in a wind \[m/s\] on the same cells; the plane repeats.
    pub fn step(&mut self, co: &HarmonicCoefficients, wind: &[[f32; 2]]) {
        let n = self.side;
        self.step_by(co, &|i| (i + n - 1) % n, &|i| (i + 1) % n, &|cell| wind[cell], &|_| ([0.0; 2], 0.0));
    }

    /// One step of a plane that ends at its rim, all in one wind \[m/s\]; `held` says what bodies do to a cell.
    pub fn step_apart(&mut self, co: &HarmonicCoefficients, wind: [f32; 2], held: &dyn Fn(usize) -> Held) {
        let last = self.side - 1;
        self.step_by(co, &|i| if i > 0 { i - 1 } else { 0 }, &|i| if i < last { i + 1 } else { last }, &|_| wind, held);
    }

    #[inline(always)]
    fn step_by(
        &mut self,
        co: &HarmonicCoefficients,
        before: &dyn Fn(usize) -> usize,
        after: &dyn Fn(usize) -> usize,
        wind: &dyn Fn(usize) -> [f32; 2],
        held: &dyn Fn(usize) -> Held,
    ) {
        let n = self.side;
        for j in 0..n {
            let (row, below, above) = (j * n, before(j) * n, after(j) * n);
            for i in 0..n {
                let (left, right) = (before(i), after(i));
                let (air, (pushed, share)) = (wind(row + i), held(row + i));
                for part in 0..2 {
                    let here = self.now[row + i][part];
                    let old = self.old[row + i][part];
                    let around =
                        self.now[row + left][part] + self.now[row + right][part] + self.now[below + i][part] + self.now[above + i][part];
                    let pulled = co.spread * (around - 4.0 * here) - co.restoring * (here - co.gain * air[part]);
                    let carried = co.carried(here, old);
                    self.old[row + i][part] = here + carried + pulled + taken_along(here, carried, pushed[part], share);
                }
            }
        }
        std::mem::swap(&mut self.now, &mut self.old);
    }

    /// V between cells, at a place in cells from the corner; the plane repeats.
    pub fn at(&self, place: [f32; 2]) -> [f32; 2] {
        let from = place.map(|along| along - 0.5);
        let corner = from.map(crate::math::floored);
        let f = [from[0] - corner[0] as f32, from[1] - corner[1] as f32];
        let n = self.side as i32;
        let cell = |di: i32, dj: i32| self.now[((corner[1] + dj).rem_euclid(n) * n + (corner[0] + di).rem_euclid(n)) as usize];
        let (a, b, c, d) = (cell(0, 0), cell(1, 0), cell(0, 1), cell(1, 1));
        [0, 1].map(|part: usize| {
            let (low, high) = (a[part] + (b[part] - a[part]) * f[0], c[part] + (d[part] - c[part]) * f[0]);
            low + (high - low) * f[1]
        })
    }
}
