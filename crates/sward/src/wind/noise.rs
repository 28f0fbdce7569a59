//! Gusts: octaves of noise that travel with the wind.
//!
//! Belyaev et al. 2011, §3.3: `W(u) = W₀ + Σ kᵢ T(cᵢ Rᵢ (u − wᵢ t))`, with a cyclic tile T, travel velocities wᵢ, sizes cᵢ and
//! rotations Rᵢ by the heading of wᵢ. Twin: `noise.wgsl`.
//! Differs from the paper: gusts run downwind, each its own way (as printed all run upwind); each octave starts elsewhere in
//! the tile; tile coordinates are fixed-point numbers, so they neither drift nor jump.

use super::tile::Tile;
use crate::math::{floored, hash};

/// The wind that [`SHIPPED`] describes: speed \[m/s\] times turbulence.
const SHIPPED_GUSTS: f64 = 4.0 * 0.25;
const SHIPPED_SPEED: f64 = 4.0;
/// For 4 m/s along +x: amplitude k \[m/s\], travel velocity w along and across the wind \[m/s\], size c \[tiles/m\].
const SHIPPED: [(f64, [f64; 2], f64); 3] = [(3.8, [4.0, 0.0], 0.02), (2.3, [2.0, 1.5], 0.05), (1.4, [1.0, -2.0], 0.13)];
/// What hashes decide where an octave starts in the tile.
const START: [u32; 2] = [0x57a7_0000, 0x57a7_0001];

/// One octave of gusts at one step. Tile phases are fractions of a tile times 2³², one per tile axis (u, v), and wrap.
#[derive(Debug, Clone, Copy, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Octave {
    /// Phase added from one node to the next along +x.
    pub step_x: [u32; 2],
    /// Phase added from one node to the next along +z.
    pub step_z: [u32; 2],
    /// Phase at node (0, 0) of patch (0, 0) at this step.
    pub phase: [u32; 2],
    /// Tiles (u, v) per metre along +x, for places between nodes \[1/m\].
    pub per_metre_x: [f32; 2],
    /// Tiles (u, v) per metre along +z \[1/m\].
    pub per_metre_z: [f32; 2],
    /// Velocity where the tile holds 1 \[m/s\].
    pub amplitude: f32,
    /// Fills the struct to 48 bytes; 0.
    pub reserved: u32,
}

/// The three octaves of a natural wind, the `source`-th of a scene; none without mean speed or turbulence.
pub(super) fn gusts(
    velocity: [f32; 2],
    turbulence: f32,
    source: u32,
    (step, behind): (u64, f64),
    dt: f64,
    node_spacing: f64,
) -> impl Iterator<Item = Octave> {
    let velocity = velocity.map(f64::from);
    let speed = (velocity[0] * velocity[0] + velocity[1] * velocity[1]).sqrt();
    let turbulence = f64::from(turbulence);
    let count = if speed > 1e-6 && turbulence > 0.0 { SHIPPED.len() } else { 0 };
    let turned = move |[along, across]: [f64; 2]| {
        [(along * velocity[0] - across * velocity[1]) / SHIPPED_SPEED, (along * velocity[1] + across * velocity[0]) / SHIPPED_SPEED]
    };
    SHIPPED.into_iter().take(count).zip(0..).map(move |((k, travel, size), index)| {
        let amplitude = (k * speed * turbulence / SHIPPED_GUSTS) as f32;
        let start = START.map(|purpose| hash(source, 0, 0, index, purpose));
        Octave::new(amplitude, turned(travel), size, start, (step, behind), dt, node_spacing)
    })
}

impl Octave {
    /// An octave of `size` tiles per metre that travels with velocity `travel` (not zero) \[m/s\] from the phase `start`.
    fn new(amplitude: f32, travel: [f64; 2], size: f64, start: [u32; 2], (step, behind): (u64, f64), dt: f64, node_spacing: f64) -> Self {
        let speed = (travel[0] * travel[0] + travel[1] * travel[1]).sqrt();
        let heading = [travel[0] / speed, travel[1] / speed];
        // The columns of c R.
        let along_x = [size * heading[0], size * heading[1]];
        let along_z = [-size * heading[1], size * heading[0]];
        let mut phase = start;
        for axis in 0..2 {
            let per_second = along_x[axis] * travel[0] + along_z[axis] * travel[1];
            // A rate in whole numbers: every step adds the same, for ever.
            let passed = fixed(-per_second * dt).wrapping_mul(step).wrapping_add(fixed(per_second * dt * behind));
            phase[axis] = phase[axis].wrapping_add(short(passed));
        }
        Self {
            step_x: along_x.map(|tiles| short(fixed(tiles * node_spacing))),
            step_z: along_z.map(|tiles| short(fixed(tiles * node_spacing))),
            phase,
            per_metre_x: along_x.map(|tiles| tiles as f32),
            per_metre_z: along_z.map(|tiles| tiles as f32),
            amplitude,
            reserved: 0,
        }
    }

    /// The phase at a node, counted from where the phase `base` belongs.
    #[inline(always)]
    pub fn node_phase(&self, base: [u32; 2], node: [i32; 2]) -> [u32; 2] {
        let mut phase = base;
        for axis in 0..2 {
            let along_x = (node[0] as u32).wrapping_mul(self.step_x[axis]);
            let along_z = (node[1] as u32).wrapping_mul(self.step_z[axis]);
            phase[axis] = phase[axis].wrapping_add(along_x).wrapping_add(along_z);
        }
        phase
    }

    /// The phase at `local` metres (x, z) from where the phase `base` belongs.
    #[inline(always)]
    pub fn local_phase(&self, base: [u32; 2], local: [f32; 2]) -> [u32; 2] {
        let mut phase = base;
        for axis in 0..2 {
            let tiles = local[0] * self.per_metre_x[axis] + local[1] * self.per_metre_z[axis];
            let part = tiles - floored(tiles) as f32;
            phase[axis] = phase[axis].wrapping_add((((part * 16777216.0) as i32) << 8) as u32);
        }
        phase
    }

    /// Adds the velocity at a phase to `sum` \[m/s\].
    #[inline(always)]
    pub(super) fn add(&self, tile: &Tile, phase: [u32; 2], sum: &mut [f32; 2]) {
        let gust = tile.sample(phase);
        *sum = [sum[0] + self.amplitude * gust[0], sum[1] + self.amplitude * gust[1]];
    }
}

/// A number of tiles without its whole part, times 2⁶⁴ (wrapping).
pub(super) fn fixed(tiles: f64) -> u64 {
    ((tiles - tiles.round()) * 18446744073709551616.0) as i64 as u64
}

/// A phase of 2⁶⁴ per tile as one of 2³² per tile, to the nearest.
pub(super) fn short(phase: u64) -> u32 {
    (phase.wrapping_add(1 << 31) >> 32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::unit;
    use crate::wind::{Source, WindField};

    /// The mean product of one octave's gusts at two steps, the later one looked at `shift` metres further.
    fn agreement(octaves: [&Octave; 2], shift: [f32; 2]) -> f32 {
        let tile = Tile::shipped();
        let mut sum = 0.0;
        for i in 0..3000 {
            let place = [1, 2].map(|purpose| unit(hash(3, 0, 0, i, purpose)) * 60.0);
            let then = tile.sample(octaves[0].local_phase(octaves[0].phase, place));
            let later = [place[0] + shift[0], place[1] + shift[1]];
            let now = tile.sample(octaves[1].local_phase(octaves[1].phase, later));
            sum += then[0] * now[0] + then[1] * now[1];
        }
        sum
    }

    #[test]
    fn gusts_travel_with_their_own_velocity() {
        let cases = [([4.0, 0.0], [[4.0, 0.0], [2.0, 1.5], [1.0, -2.0]]), ([0.0, 8.0], [[0.0, 8.0], [-3.0, 4.0], [4.0, 2.0]])];
        for (velocity, travels) in cases {
            let wind = [Source::Natural { velocity, turbulence: 0.2 }];
            let (then, now) = (WindField::at(&wind, 1_000_000, 1.0 / 60.0, 0.5), WindField::at(&wind, 1_000_030, 1.0 / 60.0, 0.5));
            for (index, travel) in travels.into_iter().enumerate() {
                let octaves = [&then.octaves[index], &now.octaves[index]];
                // Half a second later; the best of a grid of shifts around the expected one.
                let mut best = (f32::MIN, [0, 0]);
                for dx in -4..=4 {
                    for dz in -4..=4 {
                        let shift = [travel[0] * 0.5 + dx as f32 * 0.2, travel[1] * 0.5 + dz as f32 * 0.2];
                        let score = agreement(octaves, shift);
                        if score > best.0 {
                            best = (score, [dx, dz]);
                        }
                    }
                }
                assert_eq!(best.1, [0, 0], "octave {index} of wind {velocity:?}");
                let upwind = agreement(octaves, [-travel[0] * 0.5, -travel[1] * 0.5]);
                assert!(upwind < 0.9 * best.0, "octave {index} of {velocity:?} does not move");
            }
        }
    }
}
