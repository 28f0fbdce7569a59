//! How the plants of a cell resist being bent: what a body feels of them.
//!
//! Not in the paper. Moments are those of the wave's own springs and of what the plants weigh. Twin: `resistance.wgsl`.

use super::bend::Held;
use super::coefficients::Coefficients;
use crate::interaction::ABREAST;
use crate::interaction::reaction::{CRUSHED, Leaning, WORDS};
use crate::math;

/// A cell that a body has just come to hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldCell {
    /// β and ω before.
    pub before: [f32; 4],
    /// What became of it.
    pub held: Held,
    /// Where its plants would rest, rad.
    pub rest: [f32; 2],
    /// Their roots from the point about which moments are counted, m.
    pub root: [f32; 3],
}

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

    /// What bodies feel of the first eight of such cells or fewer, side by side, with plants `length` m long: words to add to sums.
    #[inline(always)]
    pub fn felt(&self, co: &Coefficients, cells: &[HeldCell], length: f32) -> impl Iterator<Item = [i32; WORDS]> {
        let none = [0.0; ABREAST];
        let (mut before, mut bend, mut rate, mut height, mut rest, mut root) =
            ([none; 4], [none; 2], [none; 2], none, [none; 2], [none; 3]);
        for (k, cell) in cells.iter().take(ABREAST).enumerate() {
            (0..4).for_each(|plane| before[plane][k] = cell.before[plane]);
            (0..3).for_each(|axis| root[axis][k] = cell.root[axis]);
            for axis in 0..2 {
                (bend[axis][k], rate[axis][k], rest[axis][k]) = (cell.held.bend[axis], cell.held.rate[axis], cell.rest[axis]);
            }
            height[k] = cell.held.height;
        }
        let mut words = [[0; ABREAST]; WORDS];
        for k in 0..ABREAST {
            let held = Held { bend: [bend[0][k], bend[1][k]], rate: [rate[0][k], rate[1][k]], by: 0, height: height[k] };
            let before = [before[0][k], before[1][k], before[2][k], before[3][k]];
            let leaning = self.leaning(co, before, &held, [rest[0][k], rest[1][k]], length);
            let felt = leaning.felt([root[0][k], root[1][k], root[2][k]]).words();
            (0..WORDS).for_each(|word| words[word][k] = felt[word]);
        }
        (0..cells.len().min(ABREAST)).map(move |k| words.map(|abreast| abreast[k]))
    }
}
