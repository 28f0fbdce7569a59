//! Where a plant is at a time: a function of how it was let go.
//!
//! Grass interaction by instigators (article), "Solving the differential equation"; methods §2. Twin: `swing.wgsl`.

use super::model::OscillatorCoefficients;
use crate::math;
use crate::response::oscillation::advance;

/// As [`super::GRAVITY`].
const GRAVITY: f32 = 9.81;
/// No plant leans farther, rad.
const HALF_PI: f32 = std::f32::consts::FRAC_PI_2;
/// A deviation shorter than this has no direction.
pub(super) const SHORTEST: f32 = 1e-6;

/// How one plant swings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Own {
    /// ω₀², 1/s².
    pub omega_squared: f32,
    /// γ, 1/s.
    pub gamma: f32,
}

impl Own {
    /// Of a plant `height` m high (0 where none is) of which `variety` says how it differs: see [`crate::placement::variety`].
    #[inline(always)]
    pub fn of(co: &OscillatorCoefficients, variety: u32, height: f32) -> Self {
        let either = |half: u32| half as f32 * (1.0 / 32768.0) - 1.0;
        let k = co.stiffness * (1.0 + co.spreads[0] * either(variety & 0xffff));
        let b = co.damping * (1.0 + co.spreads[1] * either(variety >> 16));
        let length = math::upper(co.scale * height, 1e-4);
        Self { omega_squared: (k - GRAVITY) / length, gamma: b / (2.0 * length) }
    }
}

/// How a plant was last left by bodies. All zero: at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Record {
    /// Deviation from how it stands in the wind, ground vector \[rad\].
    pub deviation: [f32; 2],
    /// Rate along it, rad/s.
    pub rate: f32,
    /// Steps done when it was so; wraps.
    pub step: u32,
}

impl Record {
    /// The record of cell `cell` in planes of `area` values.
    #[inline(always)]
    pub fn load(planes: &[f32], area: usize, cell: usize) -> Self {
        let at = |plane: usize| planes[plane * area + cell];
        Self { deviation: [at(0), at(1)], rate: at(2), step: at(3).to_bits() }
    }

    /// Puts it there.
    #[inline(always)]
    pub fn store(&self, planes: &mut [f32], area: usize, cell: usize) {
        let [x, z] = self.deviation;
        for (plane, value) in [x, z, self.rate, f32::from_bits(self.step)].into_iter().enumerate() {
            planes[plane * area + cell] = value;
        }
    }

    /// Seconds since then, `behind` steps before step `now`; negative where a picture looks back into the step in which a body held it.
    #[inline(always)]
    fn elapsed(&self, co: &OscillatorCoefficients, now: u32, behind: f32) -> f32 {
        (now.wrapping_sub(self.step) as i32 as f32 - behind) * co.dt
    }

    /// Deviation \[rad\] `behind` steps before step `now`.
    #[inline(always)]
    pub fn at(&self, co: &OscillatorCoefficients, own: &Own, now: u32, behind: f32) -> [f32; 2] {
        let [x, z] = self.deviation;
        let size = (x * x + z * z).sqrt();
        let tau = self.elapsed(co, now, behind);
        let [free, _] = advance(size, self.rate, own.gamma, own.omega_squared, tau);
        // Before the end of the step in which a body held it, it moved with the body.
        let theta = if tau < 0.0 { size + self.rate * tau } else { free };
        let share = theta / math::upper(size, SHORTEST);
        [x * share, z * share]
    }

    /// The same motion as it is `seconds` later, as of step `now`.
    #[inline(always)]
    pub(super) fn later(&self, own: &Own, seconds: f32, now: u32) -> Self {
        let [x, z] = self.deviation;
        let size = math::upper((x * x + z * z).sqrt(), SHORTEST);
        let [theta, rate] = advance(size, self.rate, own.gamma, own.omega_squared, seconds);
        // Directions have no sign of their own: one that has swung through leans the other way.
        let (theta, rate, sign) = if theta < 0.0 { (-theta, -rate, -1.0) } else { (theta, rate, 1.0) };
        let share = sign * math::upper(theta, SHORTEST) / size;
        Self { deviation: [x * share, z * share], rate, step: now }
    }
}

/// A bend brought within a quarter turn.
#[inline(always)]
pub fn limited(bend: [f32; 2]) -> [f32; 2] {
    let size = (bend[0] * bend[0] + bend[1] * bend[1]).sqrt();
    let share = if size > HALF_PI { HALF_PI / size } else { 1.0 };
    [bend[0] * share, bend[1] * share]
}

/// Bend of segment `segment` of `segments` of a plant that leans as `bend` says: the rod, curved over. It is straight where it stands upright or lies
/// flat, and on average leans as the rod does.
#[inline(always)]
pub fn curved(curve: f32, bend: [f32; 2], segment: u32, segments: u32) -> [f32; 2] {
    let size = math::upper((bend[0] * bend[0] + bend[1] * bend[1]).sqrt(), SHORTEST);
    let (sine, cosine) = math::sin_cos(size);
    let place = (2.0 * segment as f32 + 1.0) / segments as f32 - 1.0;
    let share = 1.0 + curve * sine * cosine * place / size;
    [bend[0] * share, bend[1] * share]
}
