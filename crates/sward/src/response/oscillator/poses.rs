//! Where all plants of a patch are at once: [`Record::at`] for cells side by side, without a branch, to the same bits.

use super::model::OscillatorCoefficients;
use super::swing::{FREE, FULL_TURN, GRAVITY, HALF_PI, SHORTEST};
use crate::lanes::{Lanes, Simd, Work};
use crate::math;
use crate::placement::{self, PlacementParameters};
use crate::response::oscillation::{CRITICAL, DAMPING_LIMIT, START_LIMIT, STIFFNESS_LIMIT, TIME_LIMIT};

/// What the poses of a patch are made from.
#[derive(Clone, Copy, Debug)]
pub struct Poses<'a> {
    /// How plants swing.
    pub co: &'a OscillatorCoefficients,
    /// How they differ.
    pub placement: &'a PlacementParameters,
    /// Which patch.
    pub patch: [i32; 2],
    /// Its records, four planes.
    pub records: &'a [f32],
    /// Height of each cell's plant, m; 0 where none stands.
    pub heights: &'a [f32],
    /// Steps done; wraps.
    pub now: u32,
    /// Steps before that.
    pub behind: f32,
}

impl Poses<'_> {
    /// Deviation of each plant from how it stands in the wind \[rad\], x and z; as many as the shortest list holds.
    pub fn write(&self, lanes: Lanes, out: [&mut [f32]; 2]) {
        lanes.run(Writing { poses: self, out });
    }
}

/// Cells worked on at a time: what one pass leaves for the next stays in the nearest cache.
const ROW: usize = 64;
type Row = [f32; ROW];

/// All bits where something holds, else none.
#[inline(always)]
fn mask(holds: bool) -> u32 {
    u32::from(holds).wrapping_neg()
}

/// `yes` where the mask has its bits, else `no`: a choice that is no branch, so that cells side by side share instructions.
#[inline(always)]
fn either(mask: u32, yes: f32, no: f32) -> f32 {
    f32::from_bits((yes.to_bits() & mask) | (no.to_bits() & !mask))
}

/// The cells of a row: how each swings, and when it was let go.
struct Swings {
    gamma: Row,
    squared: Row,
    size: Row,
    rate: Row,
    /// Steps since then.
    steps: Row,
}

/// What the pass before needs in vectors of its own: exponentials and sines.
struct Parts {
    tau: Row,
    slow: Row,
    fast: Row,
    root: Row,
    sine: Row,
    cosine: Row,
}

impl Poses<'_> {
    #[inline(always)]
    fn swings(&self, first: u32, [x, z, rate, stamp]: [&Row; 4], heights: &Row) -> Swings {
        let (co, zero) = (self.co, [0.0; ROW]);
        let mut s = Swings { gamma: zero, squared: zero, size: zero, rate: zero, steps: zero };
        for k in 0..ROW {
            let variety = placement::variety(self.placement, self.patch, first + k as u32);
            let either_way = |half: u32| half as i32 as f32 * (1.0 / 32768.0) - 1.0;
            let stiffness = co.stiffness * (1.0 + co.spreads[0] * either_way(variety & 0xffff));
            let damping = co.damping * (1.0 + co.spreads[1] * either_way(variety >> 16));
            let length = math::upper(co.scale * heights[k], 1e-4);
            let over = 1.0 / length;
            (s.squared[k], s.gamma[k]) = ((stiffness - GRAVITY) * over, 0.5 * damping * over);
        }
        for k in 0..ROW {
            let stamp = stamp[k].to_bits();
            s.steps[k] = (((self.now << 8).wrapping_sub(stamp & !0xff) as i32) >> 8) as f32 - self.behind;
            s.size[k] = (x[k] * x[k] + z[k] * z[k]).sqrt();
        }
        s.rate = *rate;
        // Seldom has a body left any of a row within its own step.
        if stamp.iter().any(|stamp| stamp.to_bits() & 0xff != FREE) {
            for k in 0..ROW {
                let own = s.squared[k].sqrt();
                let bound = math::clamped(rate[k], -own * s.size[k], own * (HALF_PI - s.size[k]));
                s.rate[k] = either(mask(stamp[k].to_bits() & 0xff != FREE), bound, rate[k]);
            }
        }
        s
    }
}

/// The deviations of [`crate::response::oscillation::advance`], its three cases worked out side by side.
#[inline(always)]
fn swung(s: &Swings, dt: f32) -> Row {
    let zero = [0.0; ROW];
    let mut p = Parts { tau: zero, slow: zero, fast: zero, root: zero, sine: zero, cosine: zero };
    let (mut gamma, mut critical, mut over) = (zero, [0_u32; ROW], [0_u32; ROW]);
    let mut curve = zero;
    for k in 0..ROW {
        gamma[k] = math::clamped(s.gamma[k], 0.0, DAMPING_LIMIT);
        let omega_squared = math::clamped(s.squared[k], 0.0, STIFFNESS_LIMIT);
        p.tau[k] = math::clamped(s.steps[k] * dt, 0.0, TIME_LIMIT);
        let squared = omega_squared - gamma[k] * gamma[k];
        curve[k] = squared * p.tau[k] * p.tau[k];
        critical[k] = mask(either(mask(curve[k] < 0.0), -curve[k], curve[k]) < CRITICAL);
        over[k] = !mask(squared > 0.0);
        p.root[k] = either(over[k], -squared, squared).sqrt();
        p.fast[k] = gamma[k] + p.root[k];
        p.slow[k] = either(over[k] & !critical[k], -(omega_squared / p.fast[k]) * p.tau[k], -gamma[k] * p.tau[k]);
    }
    for k in 0..ROW {
        p.slow[k] = math::exp(p.slow[k]);
    }
    // Plants of a stand mostly are of one case.
    if over.contains(&0) {
        for k in 0..ROW {
            (p.sine[k], p.cosine[k]) = math::sin_cos(p.root[k] * p.tau[k]);
        }
    }
    if over.iter().any(|over| *over != 0) {
        for k in 0..ROW {
            p.fast[k] = math::exp(-p.fast[k] * p.tau[k]);
        }
    }
    let mut theta = zero;
    let start = |k: usize| math::clamped(s.size[k], -START_LIMIT, START_LIMIT);
    let rate = |k: usize| math::clamped(s.rate[k], -START_LIMIT, START_LIMIT);
    let sways = over.iter().zip(&critical).all(|(over, critical)| over | critical == 0);
    if sways {
        for k in 0..ROW {
            let (c, sine) = (p.slow[k] * p.cosine[k], p.slow[k] * p.sine[k] / p.root[k]);
            theta[k] = (c + gamma[k] * sine) * start(k) + sine * rate(k);
        }
        return theta;
    }
    for k in 0..ROW {
        let (x, slow, fast, root) = (curve[k], p.slow[k], p.fast[k], p.root[k]);
        let c = either(over[k], 0.5 * (slow + fast), slow * p.cosine[k]);
        let sine = either(over[k], 0.5 * (slow - fast), slow * p.sine[k]) / root;
        let c = either(critical[k], slow * (1.0 + x * (x / 24.0 - 0.5)), c);
        let sine = either(critical[k], slow * p.tau[k] * (1.0 + x * (x / 120.0 - 1.0 / 6.0)), sine);
        theta[k] = (c + gamma[k] * sine) * start(k) + sine * rate(k);
    }
    theta
}

/// The work of [`Poses::write`].
struct Writing<'a> {
    poses: &'a Poses<'a>,
    out: [&'a mut [f32]; 2],
}

impl Writing<'_> {
    /// Cells of which a picture looks back into the step in which a body held them: they moved and turned with it.
    #[inline(always)]
    fn look_back(&mut self, first: usize, s: &Swings, [x, z, rate, stamp]: [&Row; 4], count: usize) {
        let co = self.poses.co;
        for k in 0..count {
            if s.steps[k] >= 0.0 {
                continue;
            }
            let stamp = stamp[k].to_bits();
            let share = math::upper(s.size[k] + rate[k] * s.steps[k] * co.dt, 0.0) * (1.0 / math::upper(s.size[k], SHORTEST));
            let turn = if stamp & 0xff != FREE { f32::from(stamp as u8 as i8) * (co.pace / FULL_TURN) } else { 0.0 };
            let (sine, cosine) = math::sin_cos(turn * s.steps[k]);
            self.out[0][first + k] = share * (cosine * x[k] - sine * z[k]);
            self.out[1][first + k] = share * (sine * x[k] + cosine * z[k]);
        }
    }
}

/// The cells of a row; beyond the end zero.
#[inline(always)]
fn row(plane: &[f32]) -> Row {
    let mut row = [0.0; ROW];
    row[..plane.len()].copy_from_slice(plane);
    row
}

impl Work for Writing<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(mut self, _: S) {
        let area = self.poses.records.len() / 4;
        let count = area.min(self.out[0].len()).min(self.out[1].len()).min(self.poses.heights.len());
        let mut first = 0;
        while first < count {
            let end = if first + ROW < count { first + ROW } else { count };
            let planes: [Row; 4] = [0, 1, 2, 3].map(|plane| row(&self.poses.records[plane * area..][first..end]));
            let planes = [&planes[0], &planes[1], &planes[2], &planes[3]];
            let swings = self.poses.swings(first as u32, planes, &row(&self.poses.heights[first..end]));
            let theta = swung(&swings, self.poses.co.dt);
            let mut share = [0.0; ROW];
            for k in 0..ROW {
                share[k] = 1.0 / math::upper(swings.size[k], SHORTEST);
            }
            let [out_x, out_z] = &mut self.out;
            for (k, (x, z)) in out_x[first..end].iter_mut().zip(&mut out_z[first..end]).enumerate() {
                (*x, *z) = (planes[0][k] * theta[k] * share[k], planes[1][k] * theta[k] * share[k]);
            }
            if swings.steps.iter().any(|steps| *steps < 0.0) {
                self.look_back(first, &swings, planes, end - first);
            }
            first = end;
        }
    }
}
