//! A blade's physical values, and the numbers of the simplified chain calibrated from them.
//!
//! Belyaev et al. 2011, §3.1; methods §3.1. The paper drops everything above a segment and keeps the springs: such a chain is 10 to 30
//! times too stiff and does not sway. Here its springs and inertias are those with which it leans and sways as the full chain does.

use bytemuck::{Pod, Zeroable};

use super::error::ChainError;
use super::modes::{Mode, first_mode, lever};

/// Most segments of a blade.
pub const MOST_SEGMENTS: usize = 8;
/// m/s².
pub(super) const GRAVITY: f64 = 9.81;
/// Most of a spring's hold that weight may take.
const STANDING: f64 = 0.8;
/// How much faster each segment sways than the one below, in shares of the first.
const QUICKER: f64 = 0.2;

/// The power p of the drag law `f = k_w |u|^(p−1) u`. Only these: a power of any number would need a logarithm in every segment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DragLaw {
    /// p = 1: slow, thick air.
    Linear,
    /// p = 4/3: sedge (the paper's), leaves that fold with the wind.
    #[default]
    FourThirds,
    /// p = 5/3.
    FiveThirds,
    /// p = 2: a stiff plate.
    Square,
}

impl DragLaw {
    /// 3 (p − 1), 0 to 3.
    pub fn thirds(self) -> u32 {
        self as u32
    }
}

/// A blade as a chain of equal rigid segments, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blade {
    /// Segments n, 1 to [`MOST_SEGMENTS`].
    pub segments: u32,
    /// Half the length l of a segment, m, 1e-4 to 10.
    pub half_length: f64,
    /// Mass m of a segment, kg, 1e-9 to 1e3.
    pub mass: f64,
    /// Stiffness of the lowest joint, N·m/rad, 1e-9 to 1e6; linear between the two ends.
    pub stiffness_root: f64,
    /// Stiffness of the uppermost joint, N·m/rad.
    pub stiffness_tip: f64,
    /// Damping ratio ζ of the first mode, 0 to 10.
    pub damping_ratio: f64,
    /// Drag k_w of a segment, N/(m/s)^p, 0 to 100.
    pub drag: f64,
    /// Power p of the drag law.
    pub law: DragLaw,
    /// First frequency f₁ of the simplified chain, Hz, 0.01 to 1000; the full chain's if not given.
    pub frequency: Option<f64>,
}

impl Blade {
    /// Stiffness k of joint `i` from 0, N·m/rad.
    pub fn stiffness(&self, i: usize) -> f64 {
        let share = if self.segments > 1 { i as f64 / f64::from(self.segments - 1) } else { 0.0 };
        self.stiffness_root + (self.stiffness_tip - self.stiffness_root) * share
    }

    /// Root to tip along the blade, m.
    pub fn length(&self) -> f64 {
        2.0 * self.half_length * f64::from(self.segments)
    }

    /// Whether all numbers are in their ranges.
    fn check(&self) -> Result<(), ChainError> {
        if !(1..=MOST_SEGMENTS as u32).contains(&self.segments) {
            return Err(ChainError::Segments { segments: self.segments, most: MOST_SEGMENTS });
        }
        let ranges = [
            ("half the length of a segment [m]", self.half_length, 1e-4, 10.0),
            ("the mass of a segment [kg]", self.mass, 1e-9, 1e3),
            ("the stiffness of the lowest joint [N·m/rad]", self.stiffness_root, 1e-9, 1e6),
            ("the stiffness of the uppermost joint [N·m/rad]", self.stiffness_tip, 1e-9, 1e6),
            ("the damping ratio", self.damping_ratio, 0.0, 10.0),
            ("the drag of a segment [N/(m/s)^p]", self.drag, 0.0, 100.0),
            ("the first frequency [Hz]", self.frequency.unwrap_or(1.0), 0.01, 1000.0),
        ];
        for (what, value, low, high) in ranges {
            if !(low..=high).contains(&value) {
                return Err(ChainError::Range { what, value, low, high });
            }
        }
        Ok(())
    }
}

/// Numbers of one joint of the simplified chain.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct JointCoefficients {
    /// k̂ = k/N², N·m/rad: leans as the full chain does, which N segments pull at.
    pub stiffness: f32,
    /// Ĵ, kg·m²: sways at the full chain's frequency.
    pub inertia: f32,
    /// ĉ, N·m·s/rad.
    pub damping: f32,
    /// Mean speed of all segments above (as their drag turns this joint) over that of its own segment, in the first mode, 1 or more:
    /// drag brakes with them all.
    pub reach: f32,
}

/// Numbers of a blade that a step reads. The same bytes are a uniform of the WGSL twin.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ChainCoefficients {
    /// Segments n.
    pub segments: u32,
    /// 3 (p − 1) of the drag law, 0 to 3.
    pub drag_thirds: u32,
    /// Half the length l of a segment, m.
    pub half_length: f32,
    /// Weight m g of a segment, N.
    pub weight: f32,
    /// Drag k_w of a segment, N/(m/s)^p.
    pub drag: f32,
    /// Keeps joints at a multiple of 16 bytes; 0.
    pub unused: [f32; 3],
    /// Per joint, root to tip.
    pub joints: [JointCoefficients; MOST_SEGMENTS],
}

/// How much faster than segment `i` all above it move in the first mode, weighted by the levers of their drag about joint `i`.
fn reach(blade: &Blade, mode: &Mode, i: usize) -> f64 {
    let n = blade.segments as usize;
    let speed = |k: usize| -> f64 { (0..=k).map(|j| lever(blade, k, j) * mode.shape[j]).sum() };
    let above = (n - i) as f64;
    (i..n).map(|k| (2 * (k - i) + 1) as f64 * speed(k)).sum::<f64>() / (above * above * speed(i))
}

/// First frequency of a blade's chain, Hz: as given, or the full chain's; `None` where that buckles.
pub fn first_frequency(blade: &Blade) -> Option<f64> {
    blade.frequency.or_else(|| first_mode(blade).map(|mode| mode.frequency))
}

/// Numbers of the simplified chain of a blade (methods §3.1): `k̂_i = k_i/N_i²`, `w_i = 2πf₁(1 + 0.2(i−1))`,
/// `Ĵ_i = (k̂_i − m g l)/w_i²`, `ĉ_i = 2ζ w_i Ĵ_i`; and [`JointCoefficients::reach`].
pub fn calibrate(blade: &Blade) -> Result<ChainCoefficients, ChainError> {
    blade.check()?;
    let n = blade.segments as usize;
    let weight_moment = blade.mass * GRAVITY * blade.half_length;
    for i in 0..n {
        let above = (n - i) as f64;
        let held = blade.stiffness(i) / (above * above);
        if weight_moment >= STANDING * held {
            let needed = weight_moment / STANDING * above * above;
            return Err(ChainError::CannotStand { joint: i + 1, segments: n, share: 100.0 * weight_moment / held, needed });
        }
    }
    let mode = first_mode(blade).ok_or(ChainError::Buckles)?;
    let first = std::f64::consts::TAU * blade.frequency.unwrap_or(mode.frequency);
    let mut joints = [JointCoefficients::default(); MOST_SEGMENTS];
    for (i, joint) in joints[..n].iter_mut().enumerate() {
        let above = (n - i) as f64;
        let stiffness = blade.stiffness(i) / (above * above);
        let omega = first * (1.0 + QUICKER * i as f64);
        let inertia = (stiffness - weight_moment) / (omega * omega);
        let damping = 2.0 * blade.damping_ratio * omega * inertia;
        let reach = reach(blade, &mode, i) as f32;
        *joint = JointCoefficients { stiffness: stiffness as f32, inertia: inertia as f32, damping: damping as f32, reach };
    }
    Ok(ChainCoefficients {
        segments: blade.segments,
        drag_thirds: blade.law.thirds(),
        half_length: blade.half_length as f32,
        weight: (blade.mass * GRAVITY) as f32,
        drag: blade.drag as f32,
        unused: [0.0; 3],
        joints,
    })
}
