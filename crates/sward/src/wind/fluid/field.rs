//! The flow of a plane as responses and pictures read it: between cells, anywhere, between two steps.
//!
//! Phases are fixed-point numbers that wrap, as those of gusts: patches agree bit for bit on the nodes they share. The plane travels with the mean wind,
//! so its eddies go over the ground, and no step blurs them on the way. Twin: `field.wgsl`.

use std::sync::Arc;

use crate::math::floored;

/// One way round is 2³².
const TURN: f64 = 4_294_967_296.0;

/// A plane at one moment, as the GPU reads it: the same layout as `WindFluid` in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct FluidBlock {
    /// Phase at node (0, 0) of patch (0, 0), counted from the middle of the first cell; 2³² is one plane.
    pub phase: [u32; 2],
    /// Phase added from one node to the next along either axis.
    pub step: u32,
    /// Planes per metre, 1/m.
    pub per_metre: f32,
    /// Texel of the flow.
    pub now: u32,
    /// Texel of the flow one step before.
    pub before: u32,
    /// A side has 2^bits cells.
    pub bits: u32,
    /// Steps, 0 to 1, that the moment lies before the flow.
    pub behind: f32,
}

/// The flow of a plane: its cells row by row, m/s along x and z beside the mean wind. What a step changes of it.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidState {
    /// After the last step.
    pub now: Arc<Vec<[f32; 2]>>,
    /// Before it.
    pub before: Arc<Vec<[f32; 2]>>,
}

impl FluidState {
    /// Air that rests, on `side`² cells.
    pub fn still(side: usize) -> Self {
        let still = Arc::new(vec![[0.0; 2]; side * side]);
        Self { now: Arc::clone(&still), before: still }
    }
}

/// A plane and its flow at one moment.
#[derive(Clone, Debug)]
pub struct FluidField {
    /// Where it lies.
    pub block: FluidBlock,
    /// Its flow.
    pub flow: FluidState,
    /// A speed seldom exceeded, beside the mean, m/s.
    pub speed: f32,
}

impl FluidField {
    /// The phase at a node, counted from where the phase `base` belongs.
    #[inline(always)]
    pub fn node_phase(&self, base: [u32; 2], node: [i32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| base[axis].wrapping_add((node[axis] as u32).wrapping_mul(self.block.step)))
    }

    /// The phase at `local` metres (x, z) from where the phase `base` belongs.
    #[inline(always)]
    pub fn local_phase(&self, base: [u32; 2], local: [f32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| {
            let planes = local[axis] * self.block.per_metre;
            let part = planes - floored(planes) as f32;
            base[axis].wrapping_add((((part * 16_777_216.0) as i32) << 8) as u32)
        })
    }

    /// Adds the velocity at a phase to `sum` \[m/s\].
    #[inline(always)]
    pub fn add(&self, phase: [u32; 2], sum: &mut [f32; 2]) {
        let mut found = self.sample(&self.flow.now, phase);
        let behind = self.block.behind;
        if behind > 0.0 {
            let before = self.sample(&self.flow.before, phase);
            found = [0, 1].map(|axis| found[axis] + (before[axis] - found[axis]) * behind);
        }
        *sum = [sum[0] + found[0], sum[1] + found[1]];
    }

    /// Bilinear flow at a phase: the top bits are the cell, the next 24 the way to the next one.
    #[inline(always)]
    fn sample(&self, flow: &[[f32; 2]], phase: [u32; 2]) -> [f32; 2] {
        let bits = self.block.bits;
        let cell = phase.map(|turn| turn >> (32 - bits));
        let next = cell.map(|at| (at + 1) & ((1 << bits) - 1));
        let [s, t] = phase.map(|turn| ((turn << bits) >> 8) as i32 as f32 * (1.0 / 16_777_216.0));
        let at = |x: u32, z: u32| flow.get(((z << bits) + x) as usize).copied().unwrap_or_default();
        let [a, b, c, d] = [at(cell[0], cell[1]), at(next[0], cell[1]), at(cell[0], next[1]), at(next[0], next[1])];
        [0, 1].map(|axis: usize| {
            let (near, far) = (a[axis] + (b[axis] - a[axis]) * s, c[axis] + (d[axis] - c[axis]) * s);
            near + (far - near) * t
        })
    }

    /// The same flow, repeating a whole number of times over `intervals` nodes: see [`super::super::WindField::snapped`].
    pub(crate) fn snapped(&self, intervals: u32) -> Self {
        let mut field = self.clone();
        let side = f64::from(intervals.max(1));
        let planes = f64::from(self.block.step) * side / TURN;
        // Where a plane is wider than a patch it is made narrower: as wide.
        let whole = if planes.round() < 1.0 { 1.0 } else { planes.round() };
        field.block.step = (whole * TURN / side) as u64 as u32;
        field.block.per_metre = (f64::from(self.block.per_metre) * whole / planes) as f32;
        field
    }
}
