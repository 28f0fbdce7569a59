//! How the plants of a cell resist being bent: what a body feels of them.
//!
//! Not in the paper. Moments are those of the wave's own springs and of what the plants weigh. Twin: `resistance.wgsl`.

use super::bend::Held;
use super::coefficients::Coefficients;
use crate::interaction::reaction::{CRUSHED, Leaning};
use crate::math;

/// How the plants of a cell resist being bent: what stands there on average.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resistance {
    /// Moment of inertia about the roots, kg·m².
    pub inertia: f32,
    /// κ, 1/s²: times the moment of inertia it is the stiffness.
    pub kappa: f32,
}

impl Resistance {
    /// A cell whose β and ω were `before` and have just become `held`, where plants `length` m long rest at `rest`. Its moment is J (κ(β − β_eq) + Δω/Δt), the
    /// part of it that straightens the plants. They are touched where tan θ = v t/h has it, so the body's force does as much work as their springs take up.
    #[inline(always)]
    pub fn leaning(&self, co: &Coefficients, before: [f32; 4], held: &Held, rest: [f32; 2], length: f32) -> Leaning {
        let size = |[x, z]: [f32; 2]| (x * x + z * z).sqrt();
        let tilt = size(held.bend);
        let towards = held.bend.map(|part| part / math::upper(tilt, 1e-9));
        let away = [held.bend[0] - rest[0], held.bend[1] - rest[1]];
        let part = |axis: usize| towards[axis] * (self.kappa * away[axis] + (held.rate[axis] - before[2 + axis]) / co.step);
        let moment = math::upper(self.inertia * (part(0) + part(1)), 0.0);
        let (_, cosine) = math::sin_cos(tilt);
        let lever = held.height / math::upper(cosine, 1e-3);
        let fell = tilt > CRUSHED && size([before[0], before[1]]) <= CRUSHED;
        let energy = 0.5 * self.inertia * self.kappa * (away[0] * away[0] + away[1] * away[1]);
        Leaning { tilt, towards, moment, lever, length, aside: 1.0, crushed: if fell { energy } else { 0.0 } }
    }
}
