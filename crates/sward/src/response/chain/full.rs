//! The full chain: every segment acts on every other. f64, CPU only, for tests and reports.
//!
//! Belyaev et al. 2011, §3.1, first system; methods §3.2. Differs from the paper in its coordinates, not in its motion: segments are thin
//! rods, so their directions d_i say everything (nothing turns about a rod), and kinetic energy is ½ Σ A_ij ḋ_i·ḋ_j with A constant.
//! Then A d̈ = F + λ d with |d_i| = 1 has all centrifugal, Coriolis and child terms in it: λ is the tension that keeps each rod straight.
//!
//! Damping is c_i = β k_i at each joint, on the difference of the two segments' rates, with the β that gives the first mode its ζ.

use super::blade::{Blade, DragLaw, MOST_SEGMENTS, calibrate};
use super::error::ChainError;
use super::frame::Frame;
use super::modes::{Square, cholesky, first_mode, inertia, solved, weight_lever};
use crate::math;

/// Three numbers of a place or a direction.
type Vector = [f64; 3];
/// One for each segment.
type Vectors = [Vector; MOST_SEGMENTS];

/// A blade with nothing left out.
#[derive(Clone, Debug)]
pub struct FullChain {
    /// Where each segment points, root to tip: unit vectors of the world.
    pub directions: [[f64; 3]; MOST_SEGMENTS],
    /// How fast that changes, 1/s; across the directions.
    pub rates: [[f64; 3]; MOST_SEGMENTS],
    /// A force on the upper end of each segment, N: what bodies press it with.
    pub loads: [[f64; 3]; MOST_SEGMENTS],
    blade: Blade,
    /// Where the dummy segment points.
    root: Vector,
    inertia: Square,
    inverse: Square,
    /// Damping per stiffness, s.
    beta: f64,
    /// Largest (2πf)² of the springs, or more, 1/s².
    fastest: f64,
}

#[inline(always)]
fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a + s b.
#[inline(always)]
fn plus(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

/// `M x` for each axis.
#[inline(always)]
fn spread(m: &Square, n: usize, x: &Vectors) -> Vectors {
    let mut y = [[0.0; 3]; MOST_SEGMENTS];
    for i in 0..n {
        for j in 0..n {
            y[i] = plus(y[i], m[i][j], x[j]);
        }
    }
    y
}

/// The cube root of x ≥ 0 from that of [`math`], two Newton steps on; 0 where x is too small for it.
fn cube_root(x: f64) -> f64 {
    let mut root = f64::from(math::cbrt(x as f32));
    if root <= 0.0 {
        return 0.0;
    }
    for _ in 0..2 {
        root -= (root * root * root - x) / (3.0 * root * root);
    }
    root
}

/// Angle between two unit vectors, rad, and angle over sine.
fn apart(a: Vector, b: Vector) -> (f64, f64) {
    let across = cross(a, b);
    let sine = dot(across, across).sqrt();
    let angle = math::atan2_f64(sine, dot(a, b));
    (angle, if sine > 1e-9 { angle / sine } else { 1.0 })
}

impl FullChain {
    /// A blade at rest on its springs, straight, in the direction of `base`; its damping is that of `blade`.
    pub fn new(blade: &Blade, base: &Frame) -> Result<Self, ChainError> {
        calibrate(blade)?;
        let n = blade.segments as usize;
        let mode = first_mode(blade).ok_or(ChainError::Buckles)?;
        let a = inertia(blade);
        let factor = cholesky(&a, n).ok_or(ChainError::Buckles)?;
        let mut inverse = [[0.0; MOST_SEGMENTS]; MOST_SEGMENTS];
        for j in 0..n {
            let mut unit = [0.0; MOST_SEGMENTS];
            unit[j] = 1.0;
            inverse[j] = solved(&factor, n, &unit);
        }
        let omega = std::f64::consts::TAU * mode.frequency;
        // A trace is at least the largest of the eigenvalues.
        let mut fastest = 0.0;
        for i in 0..n {
            let above = if i + 1 < n { blade.stiffness(i + 1) } else { 0.0 };
            fastest += inverse[i][i] * (blade.stiffness(i) + above);
            if i + 1 < n {
                fastest -= 2.0 * inverse[i][i + 1] * above;
            }
        }
        let root = base[2].map(f64::from);
        let beta = 2.0 * blade.damping_ratio / (omega * mode.spring_share);
        let (directions, rates) = ([root; MOST_SEGMENTS], [[0.0; 3]; MOST_SEGMENTS]);
        Ok(Self { directions, rates, loads: rates, blade: *blade, root, inertia: a, inverse, beta, fastest })
    }

    fn count(&self) -> usize {
        (self.blade.segments as usize).min(MOST_SEGMENTS)
    }

    /// Speed to the power p − 1.
    fn raised(&self, speed: f64) -> f64 {
        match self.blade.law {
            DragLaw::Linear => 1.0,
            DragLaw::FourThirds => cube_root(speed),
            DragLaw::FiveThirds => cube_root(speed) * cube_root(speed),
            DragLaw::Square => speed,
        }
    }

    /// Forces on the directions: drag at the centres, weight, springs and their damping, N·m.
    fn forces(&self, d: &Vectors, rates: &Vectors, wind: Vector) -> Vectors {
        let (n, l) = (self.count(), self.blade.half_length);
        let mut drag = [[0.0; 3]; MOST_SEGMENTS];
        let mut air = wind;
        for i in 0..n {
            let at_centre = plus(air, -l, rates[i]);
            air = plus(air, -2.0 * l, rates[i]);
            let speed = dot(at_centre, at_centre).sqrt();
            drag[i] = at_centre.map(|u| self.blade.drag * self.raised(speed) * u);
        }
        let mut force = [[0.0; 3]; MOST_SEGMENTS];
        let mut above = [0.0; 3];
        for i in (0..n).rev() {
            above = plus(above, 1.0, self.loads[i]);
            force[i] = plus(plus([0.0, -weight_lever(&self.blade, i), 0.0], l, drag[i]), 2.0 * l, above);
            above = plus(above, 1.0, drag[i]);
        }
        for i in 0..n {
            let (below, below_rate) = if i == 0 { (self.root, [0.0; 3]) } else { (d[i - 1], rates[i - 1]) };
            let stiffness = self.blade.stiffness(i);
            let (_, scale) = apart(d[i], below);
            let spin = plus(cross(d[i], rates[i]), -1.0, cross(below, below_rate));
            let spring = cross(d[i], below).map(|x| stiffness * scale * x);
            let torque = plus(spring, -self.beta * stiffness, spin);
            force[i] = plus(force[i], 1.0, cross(torque, d[i]));
            if i > 0 {
                force[i - 1] = plus(force[i - 1], -1.0, cross(torque, below));
            }
        }
        force
    }

    /// d̈, 1/s².
    fn accelerations(&self, d: &Vectors, rates: &Vectors, wind: Vector) -> Vectors {
        let n = self.count();
        let mut free = spread(&self.inverse, n, &self.forces(d, rates, wind));
        let mut gram = [[0.0; MOST_SEGMENTS]; MOST_SEGMENTS];
        let mut missing = [0.0; MOST_SEGMENTS];
        for i in 0..n {
            // |d| = 1 for ever means d·d̈ = −|ḋ|².
            missing[i] = -dot(rates[i], rates[i]) - dot(d[i], free[i]);
            for j in 0..=i {
                // The lower triangle is all that is read.
                gram[i][j] = self.inverse[i][j] * dot(d[i], d[j]);
            }
        }
        let Some(factor) = cholesky(&gram, n) else { return [[0.0; 3]; MOST_SEGMENTS] };
        let tension = solved(&factor, n, &missing);
        for i in 0..n {
            for j in 0..n {
                free[i] = plus(free[i], self.inverse[i][j] * tension[j], d[j]);
            }
        }
        free
    }

    /// The blade `dt` seconds later in air that moves with `wind` \[m/s\]: Runge–Kutta of fourth order, as many substeps as it needs.
    pub fn step(&mut self, wind: [f64; 3], dt: f64) {
        let speed = dot(wind, wind).sqrt() + 10.0;
        let drag = 2.0 * self.blade.drag * self.raised(speed) / self.blade.mass;
        let needed = dt * (0.5 * (self.beta * self.fastest + drag) + 2.0 * self.fastest.sqrt());
        let substeps = if needed < 1e6 { needed as u32 + 1 } else { 1_000_000 };
        for _ in 0..substeps {
            self.substep(wind, dt / f64::from(substeps));
        }
    }

    fn substep(&mut self, wind: Vector, h: f64) {
        let n = self.count();
        let moved = |base: &Vectors, s: f64, by: &Vectors| {
            let mut sum = *base;
            for i in 0..n {
                sum[i] = plus(sum[i], s, by[i]);
            }
            sum
        };
        let (d, r1) = (self.directions, self.rates);
        let a1 = self.accelerations(&d, &r1, wind);
        let r2 = moved(&r1, 0.5 * h, &a1);
        let a2 = self.accelerations(&moved(&d, 0.5 * h, &r1), &r2, wind);
        let r3 = moved(&r1, 0.5 * h, &a2);
        let a3 = self.accelerations(&moved(&d, 0.5 * h, &r2), &r3, wind);
        let r4 = moved(&r1, h, &a3);
        let a4 = self.accelerations(&moved(&d, h, &r3), &r4, wind);
        for i in 0..n {
            let mean = |a: Vector, b: Vector, c: Vector, e: Vector| plus(plus(plus(a, 2.0, b), 2.0, c), 1.0, e);
            let direction = plus(d[i], h / 6.0, mean(r1[i], r2[i], r3[i], r4[i]));
            let rate = plus(r1[i], h / 6.0, mean(a1[i], a2[i], a3[i], a4[i]));
            // Rounding alone would let rods grow.
            let length = dot(direction, direction).sqrt();
            self.directions[i] = direction.map(|x| x / length);
            self.rates[i] = plus(rate, -dot(rate, self.directions[i]), self.directions[i]);
        }
    }

    /// Energy of motion, springs and height, J.
    pub fn energy(&self) -> f64 {
        let n = self.count();
        let momentum = spread(&self.inertia, n, &self.rates);
        let mut energy = 0.0;
        for i in 0..n {
            let below = if i == 0 { self.root } else { self.directions[i - 1] };
            let (angle, _) = apart(self.directions[i], below);
            energy += 0.5 * dot(self.rates[i], momentum[i]) + 0.5 * self.blade.stiffness(i) * angle * angle;
            energy += weight_lever(&self.blade, i) * self.directions[i][1];
        }
        energy
    }

    /// Where the joints are, m from the root; entries beyond the tip repeat it.
    pub fn joints(&self) -> [[f64; 3]; MOST_SEGMENTS + 1] {
        let mut places = [[0.0; 3]; MOST_SEGMENTS + 1];
        for i in 0..MOST_SEGMENTS {
            let length = if i < self.count() { 2.0 * self.blade.half_length } else { 0.0 };
            places[i + 1] = plus(places[i], length, self.directions[i]);
        }
        places
    }
}
