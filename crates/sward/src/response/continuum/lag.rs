//! Upper segments follow the lowest one late: a steady bend is straight, a fast one trails.
//!
//! Chen & Johan 2010, §4.5, eq. 7–9; methods §1.5. Reads β (and ω) after the step, writes β_1 … β_{n−1} of patches near a camera.
//! Twin: `lag.wgsl`. Differs from the paper: a cascade of low-passes by default (docs/papers.md).

use bytemuck::{Pod, Zeroable};

use crate::math;
use crate::scene::{Continuum, Lag};

/// Numbers of one species' lag. The same bytes are a uniform of the WGSL twin.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LagCoefficients {
    /// Segments n.
    pub segments: u32,
    /// 0 cascade, 1 history, 2 look-up.
    pub kind: u32,
    /// Share of the difference taken up in a step while bending, `1 − e^{−Δt/τ}`, τ = γ_top/(n−1).
    pub gain_top: f32,
    /// The same while recovering.
    pub gain_recover: f32,
    /// γ_top, s.
    pub gamma_top: f32,
    /// γ_recover, s.
    pub gamma_recover: f32,
    /// Steps kept by `history`, 1 or more.
    pub ring: u32,
    /// Steps per second.
    pub rate: f32,
}

impl LagCoefficients {
    /// Coefficients of a species of `segments` segments at step `dt` \[s\].
    pub fn new(species: &Continuum, segments: u32, dt: f64) -> Self {
        let gain = |gamma: f32| {
            let tau = f64::from(gamma) / f64::from(segments.max(2) - 1);
            if tau > 0.0 { (1.0 - math::exp_f64(-dt / tau)) as f32 } else { 1.0 }
        };
        let longest = f64::from(if species.gamma_top > species.gamma_recover { species.gamma_top } else { species.gamma_recover });
        let kind = match species.lag {
            Lag::Cascade => 0,
            Lag::History => 1,
            Lag::Lookup => 2,
        };
        let ring = if kind == 1 { (longest / dt).round() as u32 + 1 } else { 1 };
        let (gamma_top, gamma_recover) = (species.gamma_top, species.gamma_recover);
        Self {
            segments,
            kind,
            gain_top: gain(gamma_top),
            gain_recover: gain(gamma_recover),
            gamma_top,
            gamma_recover,
            ring,
            rate: (1.0 / dt) as f32,
        }
    }

    /// What [`crate::geometry::billboard::earlier`] needs to show an upper segment between two steps: the gain of taking a step back,
    /// g/(1 − g), while bending and while recovering, at most 2; and the share left to the segment below beyond that. Segments that
    /// do not trail by the cascade move with the one below.
    pub fn past(&self) -> [f32; 4] {
        if self.kind != 0 {
            return [0.0, 0.0, 1.0, 1.0];
        }
        let split = |gain: f32| {
            if 3.0 * gain <= 2.0 { (gain / (1.0 - gain), 0.0) } else { (2.0, 1.0 - 2.0 * (1.0 - gain) / gain) }
        };
        let ((top, top_share), (recover, recover_share)) = (split(self.gain_top), split(self.gain_recover));
        [top, recover, top_share, recover_share]
    }

    /// Delay of segment `i`, s: grows evenly to the top.
    #[inline(always)]
    pub fn delay(&self, i: u32, gamma: f32) -> f32 {
        gamma * i as f32 / (self.segments - 1) as f32
    }
}

/// One step of the cascade over a patch: `bend` = βx, βz planes, `upper` = planes of β_1x, β_1z, β_2x, …
#[inline(always)]
pub fn cascade(lag: &LagCoefficients, bend: [&[f32]; 2], upper: &mut [f32]) {
    let area = bend[0].len();
    for segment in 0..(lag.segments - 1) as usize {
        let (below, here) = upper.split_at_mut(segment * 2 * area);
        let (here_x, rest) = here.split_at_mut(area);
        let here_z = &mut rest[..area];
        let below =
            if segment == 0 { bend } else { [&below[(segment - 1) * 2 * area..][..area], &below[(segment * 2 - 1) * area..][..area]] };
        for i in 0..area {
            let (bx, bz, x, z) = (below[0][i], below[1][i], here_x[i], here_z[i]);
            let recovering = bx * bx + bz * bz < x * x + z * z;
            let gain = if recovering { lag.gain_recover } else { lag.gain_top };
            here_x[i] = x + gain * (bx - x);
            here_z[i] = z + gain * (bz - z);
        }
    }
}

/// The paper's eq. 7 for one cell: β_i(t) = β(t − γ_i) from a ring of past β. `past(k)` is β k steps ago.
#[inline(always)]
pub fn from_history(lag: &LagCoefficients, segment: u32, past: impl Fn(u32) -> [f32; 2]) -> [f32; 2] {
    let steps = |gamma: f32| {
        let steps = (lag.delay(segment, gamma) * lag.rate + 0.5) as u32;
        if steps < lag.ring { steps } else { lag.ring - 1 }
    };
    let squared = |b: [f32; 2]| b[0] * b[0] + b[1] * b[1];
    let (now, before) = (past(0), past(steps(lag.gamma_top)));
    if squared(now) < squared(before) { past(steps(lag.gamma_recover)) } else { before }
}

/// The paper's eq. 8–9 for one cell: how far along ω the bend of segment `i` is looked up, m (x, z); `speed` = c at the cell [m/s].
#[inline(always)]
pub fn look_up_offset(lag: &LagCoefficients, segment: u32, bend: [f32; 2], rate: [f32; 2], speed: f32) -> [f32; 2] {
    let size = (rate[0] * rate[0] + rate[1] * rate[1]).sqrt();
    if size < 1e-3 {
        return [0.0, 0.0];
    }
    let recovering = bend[0] * rate[0] + bend[1] * rate[1] < 0.0;
    let delay = lag.delay(segment, if recovering { lag.gamma_recover } else { lag.gamma_top });
    let reach = math::lower(delay, std::f32::consts::FRAC_PI_2 / size) * speed / size;
    [reach * rate[0], reach * rate[1]]
}
