//! Where a plant is at a time: a function of how it was let go.
//!
//! Grass interaction by instigators (article), "Solving the differential equation"; methods §2. Twin: `swing.wgsl`.

use super::model::OscillatorCoefficients;
use crate::math;
use crate::response::oscillation::advance;

/// As [`super::GRAVITY`].
pub(super) const GRAVITY: f32 = 9.81;
/// No plant leans farther, rad.
pub(super) const HALF_PI: f32 = std::f32::consts::FRAC_PI_2;
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
        let over = 1.0 / length;
        Self { omega_squared: (k - GRAVITY) * over, gamma: 0.5 * b * over }
    }
}

/// How a plant was last left by bodies. All zero: at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Record {
    /// Deviation from how it stands in the wind, ground vector \[rad\].
    pub deviation: [f32; 2],
    /// Rate along it, rad/s.
    pub rate: f32,
    /// The lower 24 bits of the number of steps done when it was so, then a byte: 128 where no body held it, or how far a body turned it in that step, in 127ths of
    /// the most that it may.
    pub stamp: u32,
}

/// Of a [`Record::stamp`]: no body held the plant at the end of that step.
pub(super) const FREE: u32 = 128;
/// Of a [`Record::stamp`]: the most that a body turns a plant in a step.
pub(super) const FULL_TURN: f32 = 127.0;

/// A stamp of step `now`, in which a body turned a plant by `turn` of the most that it may, −1 to 1.
#[inline(always)]
pub(super) fn stamp_held(now: u32, turn: f32) -> u32 {
    let parts = math::floored(math::clamped(turn, -1.0, 1.0) * FULL_TURN + 0.5);
    (now << 8) | u32::from(parts as i8 as u8)
}

impl Record {
    /// Let go without a push after `now` steps, so far from how it stands in the wind \[rad\].
    pub fn let_go(deviation: [f32; 2], now: u32) -> Self {
        Self { deviation, rate: 0.0, stamp: (now << 8) | FREE }
    }

    /// The record of cell `cell` in planes of `area` values.
    #[inline(always)]
    pub fn load(planes: &[f32], area: usize, cell: usize) -> Self {
        let at = |plane: usize| planes[plane * area + cell];
        Self { deviation: [at(0), at(1)], rate: at(2), stamp: at(3).to_bits() }
    }

    /// Puts it there.
    #[inline(always)]
    pub fn store(&self, planes: &mut [f32], area: usize, cell: usize) {
        let [x, z] = self.deviation;
        for (plane, value) in [x, z, self.rate, f32::from_bits(self.stamp)].into_iter().enumerate() {
            planes[plane * area + cell] = value;
        }
    }

    /// Whether a body held the plant then.
    #[inline(always)]
    pub fn is_held(&self) -> bool {
        self.stamp & 0xff != FREE
    }

    /// Steps from then to step `now`; −2²³ to 2²³, then it wraps.
    #[inline(always)]
    pub fn steps_to(&self, now: u32) -> i32 {
        ((now << 8).wrapping_sub(self.stamp & !0xff) as i32) >> 8
    }

    /// Whether the plant is long at rest.
    #[inline(always)]
    pub(super) fn is_aged(&self, co: &OscillatorCoefficients, now: u32) -> bool {
        self.steps_to(now) as u32 > co.settle && *self != Self::default()
    }

    /// The rate with which it swings on if it is let go: the body's, but no faster than it would swing by itself.
    #[inline(always)]
    fn own_rate(&self, own: &Own, size: f32) -> f32 {
        let frequency = own.omega_squared.sqrt();
        let bound = math::clamped(self.rate, -frequency * size, frequency * (HALF_PI - size));
        if self.is_held() { bound } else { self.rate }
    }

    /// Deviation \[rad\] `behind` steps before step `now`.
    #[inline(always)]
    pub fn at(&self, co: &OscillatorCoefficients, own: &Own, now: u32, behind: f32) -> [f32; 2] {
        let [x, z] = self.deviation;
        let size = (x * x + z * z).sqrt();
        let steps = self.steps_to(now) as f32 - behind;
        let [free, _] = advance(size, self.own_rate(own, size), own.gamma, own.omega_squared, steps * co.dt);
        let scale = 1.0 / math::upper(size, SHORTEST);
        if steps >= 0.0 {
            return [x * free * scale, z * free * scale];
        }
        // A picture looks back into the step in which a body held it: it moved and turned with the body.
        let share = math::upper(size + self.rate * steps * co.dt, 0.0) * scale;
        let turn = if self.is_held() { f32::from(self.stamp as u8 as i8) * (co.pace / FULL_TURN) } else { 0.0 };
        let (sine, cosine) = math::sin_cos(turn * steps);
        [share * (cosine * x - sine * z), share * (sine * x + cosine * z)]
    }

    /// How fast the deviation changes at step `now`, rad/s: as fast as the body moves that holds it then.
    #[inline(always)]
    pub(super) fn rate_at(&self, co: &OscillatorCoefficients, own: &Own, now: u32) -> [f32; 2] {
        let [x, z] = self.deviation;
        let size = (x * x + z * z).sqrt();
        let steps = math::upper(self.steps_to(now) as f32, 0.0);
        let [_, swung] = advance(size, self.own_rate(own, size), own.gamma, own.omega_squared, steps * co.dt);
        let rate = if steps > 0.0 { swung } else { self.rate };
        let scale = rate / math::upper(size, SHORTEST);
        [x * scale, z * scale]
    }

    /// The same motion as it is `seconds` after it was let go, as of step `now`.
    #[inline(always)]
    pub(super) fn later(&self, own: &Own, seconds: f32, now: u32) -> Self {
        let [x, z] = self.deviation;
        let size = math::upper((x * x + z * z).sqrt(), SHORTEST);
        let [theta, rate] = advance(size, self.own_rate(own, size), own.gamma, own.omega_squared, seconds);
        // Directions have no sign of their own: one that has swung through leans the other way.
        let (theta, rate, sign) = if theta < 0.0 { (-theta, -rate, -1.0) } else { (theta, rate, 1.0) };
        let share = sign * math::upper(theta, SHORTEST) / size;
        Self { deviation: [x * share, z * share], rate, stamp: (now << 8) | FREE }
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
