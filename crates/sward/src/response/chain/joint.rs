//! One step of one blade as the simplified chain.
//!
//! Belyaev et al. 2011, §3.1–3.2; methods §3.1. Each joint is a damped oscillator of its own, in its segment's frame; what the others do
//! to it is where the segment points and how fast it moves. Reads wind. Writes ψ and its rate. Twin: `chain.wgsl`.
//! Differs from the paper: calibrated numbers, closed form within a step, drag of all that is above, stops (docs/papers.md).
//!
//! Signs: l × f' with l = (0, 0, l) is (−l f'_y, l f'_x, 0), and M(ψ) with ψ_y > 0 tips a segment towards its local +x, so a force along
//! +x makes ψ_y grow. Turning a segment by δ takes l f'_z δ from the moment of f: a force that pulls outwards is a stiffness l f'_z.

use bytemuck::{Pod, Zeroable};

use super::blade::{ChainCoefficients, MOST_SEGMENTS};
use super::frame::{Frame, product, rotation, to_local, to_world};
use crate::math;
use crate::response::oscillation::transition;

/// Most a joint may turn, rad.
pub const BEND_LIMIT: f32 = 2.0;
/// Fastest a joint may turn, rad/s.
pub const RATE_LIMIT: f32 = 60.0;
/// Least of a spring's stiffness that a step works with.
const LEAST_STIFFNESS: f32 = 0.05;

/// ψ of each joint, rad: across the segment below, no twist.
pub type Bends = [[f32; 2]; MOST_SEGMENTS];

/// What a step changes of a blade; the same bytes as in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ChainState {
    /// Per joint, root to tip: ψ_x, ψ_y \[rad\], ω_x, ω_y \[rad/s\]. |ψ| ≤ [`BEND_LIMIT`], |ω| ≤ [`RATE_LIMIT`] after a step.
    pub joints: [[f32; 4]; MOST_SEGMENTS],
}

impl ChainState {
    /// At rest in these bends.
    pub fn still(bends: &Bends) -> Self {
        Self { joints: bends.map(|[x, y]| [x, y, 0.0, 0.0]) }
    }

    /// ψ of each joint.
    pub fn bends(&self) -> Bends {
        self.joints.map(|[x, y, _, _]| [x, y])
    }
}

/// Segments of a blade, within the arrays.
#[inline(always)]
pub(super) fn count(co: &ChainCoefficients) -> usize {
    (co.segments as usize).min(MOST_SEGMENTS)
}

/// Speed to the power p − 1.
#[inline(always)]
pub(super) fn raised(speed: f32, thirds: u32) -> f32 {
    let root = math::cbrt(speed);
    let low = if thirds == 0 { 1.0 } else { root };
    let high = if thirds == 2 { root * root } else { speed };
    if thirds < 2 { low } else { high }
}

/// Moment of the outer force on a segment and what a step needs beside it.
struct Load {
    /// τ = l × Tᵀf, its two parts across the segment, N·m.
    moment: [f32; 2],
    /// What the force adds to the spring, N·m/rad.
    stiffness: f32,
    /// What drag adds to the damping, N·m·s/rad.
    damping: f32,
}

/// Drag and weight on segment `i` in frame `turned`, in air that passes with `air` \[m/s\].
#[inline(always)]
fn load(co: &ChainCoefficients, i: usize, turned: &Frame, air: [f32; 3]) -> Load {
    let speed = (air[0] * air[0] + air[1] * air[1] + air[2] * air[2]).sqrt();
    let rise = co.drag * raised(speed, co.drag_thirds);
    let force = to_local(turned, [rise * air[0], rise * air[1] - co.weight, rise * air[2]]);
    let l = co.half_length;
    // Weight with its own sign, so that free swaying is exact; drag at its largest, so that no wind throws a segment past its lee.
    let stiffness = l * (rise * speed - co.weight * turned[2][1]);
    let power = 1.0 + co.drag_thirds as f32 * (1.0 / 3.0);
    Load { moment: [-l * force[1], l * force[0]], stiffness, damping: l * l * rise * power * co.joints[i].reach }
}

/// ψ and ω of a joint after `dt`, its load held as it is.
#[inline(always)]
fn swung(co: &ChainCoefficients, i: usize, load: &Load, dt: f32, [x, y, wx, wy]: [f32; 4]) -> [f32; 4] {
    let joint = &co.joints[i];
    let spring = joint.stiffness;
    let stiffness = math::upper(spring + load.stiffness, LEAST_STIFFNESS * spring);
    let damping = joint.damping + load.damping;
    let [a, b, c, d] = transition(0.5 * damping / joint.inertia, stiffness / joint.inertia, dt);
    let one = |psi: f32, omega: f32, moment: f32| {
        // The moment already brakes with ω: what the step adds for it is taken out of the target.
        let away = (spring * psi - moment - load.damping * omega) / stiffness;
        let away = math::clamped(away, -1e9, 1e9);
        [psi - away + a * away + b * omega, c * away + d * omega]
    };
    let ([x, wx], [y, wy]) = (one(x, wx, load.moment[0]), one(y, wy, load.moment[1]));
    stopped([x, y, wx, wy])
}

/// Within the stops: at the largest bend what still turns outwards is taken away, and nothing turns faster than the limit.
#[inline(always)]
fn stopped([x, y, wx, wy]: [f32; 4]) -> [f32; 4] {
    let size = (x * x + y * y).sqrt();
    let beyond = size > BEND_LIMIT;
    let (ux, uy) = (x / math::upper(size, 1e-9), y / math::upper(size, 1e-9));
    let outwards = if beyond { math::upper(wx * ux + wy * uy, 0.0) } else { 0.0 };
    let (x, y) = if beyond { (BEND_LIMIT * ux, BEND_LIMIT * uy) } else { (x, y) };
    let (wx, wy) = (wx - outwards * ux, wy - outwards * uy);
    let rate = (wx * wx + wy * wy).sqrt();
    let share = if rate > RATE_LIMIT { RATE_LIMIT / rate } else { 1.0 };
    [x, y, wx * share, wy * share]
}

/// By how much joint `i` is turned at rest where a blade curls \[rad\]: towards its local +x. The middle of a segment at a share s of the
/// length then leans by `curl` s² beyond the root.
#[inline(always)]
pub fn rest_turn(co: &ChainCoefficients, curl: f32, i: usize) -> f32 {
    let n = co.segments as f32;
    let share = if i == 0 { 0.25 } else { 2.0 * i as f32 };
    curl * share / (n * n)
}

/// A blade `dt` seconds later, in air that moves with `wind` \[m/s, world\]. `base` is [`super::planted`]; at rest it curls as
/// [`rest_turn`] says, and ψ counts from there.
///
/// All frames, velocities and forces are those at the start of the step (methods §3.1).
#[inline(always)]
pub fn step(co: &ChainCoefficients, base: &Frame, curl: f32, wind: [f32; 3], dt: f32, state: &ChainState) -> ChainState {
    let mut next = *state;
    let mut frame = *base;
    let mut spin = [0.0; 3];
    let mut end = [0.0; 3];
    for i in 0..count(co) {
        let [x, y, wx, wy] = state.joints[i];
        let turn = rotation([x, y + rest_turn(co, curl, i)]);
        frame = product(&frame, &turn);
        let below = to_local(&turn, spin);
        spin = [below[0] + wx, below[1] + wy, below[2]];
        let centre = to_world(&frame, [spin[1] * co.half_length, -spin[0] * co.half_length, 0.0]);
        // The air that brakes this joint passes all segments above, which move faster.
        let reach = co.joints[i].reach;
        let air = [0, 1, 2].map(|axis| wind[axis] - reach * (end[axis] + centre[axis]));
        end = [0, 1, 2].map(|axis| end[axis] + 2.0 * centre[axis]);
        next.joints[i] = swung(co, i, &load(co, i, &frame, air), dt, state.joints[i]);
    }
    next
}

/// Where the joints are, m from the root: the root itself, then the upper end of each segment; entries beyond the tip repeat it.
pub fn joints(base: &Frame, curl: f32, co: &ChainCoefficients, bends: &Bends) -> [[f32; 3]; MOST_SEGMENTS + 1] {
    let mut places = [[0.0; 3]; MOST_SEGMENTS + 1];
    let mut frame = *base;
    for i in 0..MOST_SEGMENTS {
        places[i + 1] = places[i];
        if i < count(co) {
            frame = product(&frame, &rotation([bends[i][0], bends[i][1] + rest_turn(co, curl, i)]));
            places[i + 1] = [0, 1, 2].map(|axis| places[i][axis] + 2.0 * co.half_length * frame[2][axis]);
        }
    }
    places
}
