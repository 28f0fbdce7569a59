//! Wind: the velocity of the air over the ground, a sum of sources.
//!
//! Chen & Johan 2010 bend grass by natural wind; the noise is Belyaev et al. 2011, §3.3 (see [`noise`]). Wind is evaluated on
//! nodes; phases are fixed-point numbers that wrap, so neighbouring patches agree bit for bit on the nodes they share, however
//! far from home and however late. Writes: velocity \[m/s\] at nodes. Twins: `mod.wgsl`, `sum.wgsl`, `noise.wgsl`, `footprint.wgsl`, `fluid/field.wgsl`.

pub mod fluid;
pub mod footprint;
mod image;
pub mod noise;
#[cfg(test)]
mod tests;
mod tile;

use crate::math::{atan, cbrt, upper};
pub use crate::scene::{MAX_FLUIDS, MAX_FOOTPRINTS};
use fluid::{FluidBlock, FluidField};
pub use footprint::{Flow, Footprint, Images};
pub use noise::Octave;
use std::sync::Arc;
pub use tile::{TILE_DEVIATION, TILE_SIDE, Tile};

/// The text of the WGSL twin. It needs `math.wgsl`, and a function `wind_tile_load(index: u32) -> vec2<f32>` from its host.
pub const WGSL: &str =
    concat!(include_str!("footprint.wgsl"), include_str!("fluid/field.wgsl"), include_str!("noise.wgsl"), include_str!("mod.wgsl"));

/// The sum of all sources, of hosts that have a `wind: WindBlock` and, for a patch that is tiled, another `tile_wind`.
pub const TILED_SUM_WGSL: &str = concat!(include_str!("tiled.wgsl"), include_str!("sum.wgsl"));

/// The same, of hosts in which no patch is tiled.
pub const SUM_WGSL: &str = concat!(include_str!("untiled.wgsl"), include_str!("sum.wgsl"));

/// Most octaves of one [`WindField`]; each [`Source::Natural`] has three.
pub const MAX_OCTAVES: usize = 8;

/// Something that moves the air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// The same wind everywhere, for ever.
    Uniform {
        /// Along x and z \[m/s\].
        velocity: [f32; 2],
    },
    /// A mean wind with gusts that travel with it.
    Natural {
        /// The mean, along x and z \[m/s\].
        velocity: [f32; 2],
        /// Standard deviation of the gusts (per axis) over the mean speed, usually 0 to 1.
        turbulence: f32,
    },
}

/// A source among others: which one it is, and how strong it is now.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blowing {
    /// What moves the air.
    pub source: Source,
    /// Its gusts are those of this number, whatever blows beside it.
    pub number: u32,
    /// Share of its strength, 0 to 1.
    pub level: f32,
    /// Its place in the scene.
    pub place: usize,
}

/// Sources at full strength, numbered in their order.
pub fn all_blowing(sources: &[Source]) -> Vec<Blowing> {
    let numbered = sources.iter().enumerate();
    numbered.map(|(place, source)| Blowing { source: *source, number: place as u32, level: 1.0, place }).collect()
}

/// The wind of one step, everywhere.
#[derive(Debug, Clone)]
pub struct WindField {
    /// Mean velocity along x and z \[m/s\].
    pub mean: [f32; 2],
    /// The gusts, at most [`MAX_OCTAVES`].
    pub octaves: Vec<Octave>,
    /// How many octaves (the weakest) were left out because there were more.
    pub dropped: usize,
    /// The noise.
    pub tile: Arc<Tile>,
    /// Wind of places, at most [`MAX_FOOTPRINTS`].
    pub footprints: Vec<Footprint>,
    /// Their images.
    pub images: Arc<Images>,
    /// Air that flows, at most [`MAX_FLUIDS`]; their mean velocities are in `mean`.
    pub fluids: Vec<FluidField>,
}

/// Where a place lies in the gusts and under the footprints.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Phases {
    /// Tile phases (u, v) of each octave; one whole tile is 2³², so they wrap.
    pub octaves: [[u32; 2]; MAX_OCTAVES],
    /// The place seen from the centre of each footprint, 1/256 node.
    pub bases: [[i32; 2]; MAX_FOOTPRINTS],
    /// Phases on the planes of air that flows; one whole plane is 2³².
    pub fluids: [[u32; 2]; MAX_FLUIDS],
}

/// A [`WindField`] as the GPU reads it; the same layout as `WindBlock` in WGSL, fit for a uniform buffer.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct WindBlock {
    /// Mean velocity along x and z \[m/s\].
    pub mean: [f32; 2],
    /// How many octaves count.
    pub count: u32,
    /// Node intervals along one side of a patch.
    pub intervals: u32,
    /// The gusts.
    pub octaves: [Octave; MAX_OCTAVES],
    /// How many footprints count.
    pub footprint_count: u32,
    /// How many planes of air count.
    pub fluid_count: u32,
    /// Keeps footprints at a multiple of 16 bytes.
    pub unused: [u32; 2],
    /// Wind of places.
    pub footprints: [Footprint; MAX_FOOTPRINTS],
    /// Air that flows.
    pub fluids: [FluidBlock; MAX_FLUIDS],
}

impl WindField {
    /// The sum of `sources` at step number `step` of `dt` seconds, for nodes `node_spacing` metres apart.
    /// A source with a number that is not finite is left out.
    pub fn at(sources: &[Source], step: u64, dt: f64, node_spacing: f64) -> Self {
        Self::before(&all_blowing(sources), step, 0.0, dt, node_spacing)
    }

    /// The sum of sources, `behind` steps (0 to 1) before step number `step`: for pictures of a moment between two steps.
    pub fn before(sources: &[Blowing], step: u64, behind: f64, dt: f64, node_spacing: f64) -> Self {
        let mut mean = [0.0; 2];
        let mut octaves = Vec::new();
        for Blowing { source, number, level, .. } in sources {
            let (velocity, turbulence) = match *source {
                Source::Uniform { velocity } => (velocity, 0.0),
                Source::Natural { velocity, turbulence } => (velocity, turbulence),
            };
            if !(velocity[0].is_finite() && velocity[1].is_finite() && turbulence.is_finite()) {
                continue;
            }
            mean = [mean[0] + level * velocity[0], mean[1] + level * velocity[1]];
            // They travel as fast, however strong they are.
            let gusts = noise::gusts(velocity, turbulence, *number, (step, behind), dt, node_spacing);
            octaves.extend(gusts.map(|octave| Octave { amplitude: level * octave.amplitude, ..octave }).filter(|_| *level > 0.0));
        }
        let dropped = octaves.len().saturating_sub(MAX_OCTAVES);
        if dropped > 0 {
            octaves.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
            octaves.truncate(MAX_OCTAVES);
        }
        Self { mean, octaves, dropped, tile: Tile::shipped(), footprints: Vec::new(), images: Arc::default(), fluids: Vec::new() }
    }

    /// The same wind with every gust, and every plane of air that flows, repeating a whole number of times over `intervals` nodes along each side, so
    /// that one patch of it can be tiled without a seam (methods §1.6).
    pub fn snapped(&self, intervals: u32) -> Self {
        let mut field = self.clone();
        let snap = |step: u32| {
            // Steps are small signed shares of a tile; a side's worth of them is rounded to whole tiles.
            let side = i64::from(step as i32) * i64::from(intervals);
            let whole = (side + (1 << 31)).div_euclid(1 << 32) << 32;
            (whole / i64::from(intervals.max(1))) as u32
        };
        for octave in &mut field.octaves {
            (octave.step_x, octave.step_z) = (octave.step_x.map(snap), octave.step_z.map(snap));
        }
        field.fluids.iter_mut().for_each(|fluid| *fluid = fluid.snapped(intervals));
        field
    }

    /// The phases at node (0, 0) of a patch with `intervals` node intervals along a side.
    pub fn patch_phases(&self, patch: [i32; 2], intervals: u32) -> Phases {
        let node = patch.map(|along| (along as u32).wrapping_mul(intervals) as i32);
        let mut phases = Phases::default();
        for (phase, octave) in phases.octaves.iter_mut().zip(&self.octaves) {
            *phase = octave.node_phase(octave.phase, node);
        }
        for (base, print) in phases.bases.iter_mut().zip(&self.footprints) {
            *base = print.base(patch, intervals);
        }
        for (phase, fluid) in phases.fluids.iter_mut().zip(&self.fluids) {
            *phase = fluid.node_phase(fluid.block.phase, node);
        }
        phases
    }

    /// Air velocity along x and z \[m/s\] at a node, counted from where `phases` belong.
    pub fn velocity(&self, phases: &Phases, node: [i32; 2]) -> [f32; 2] {
        let mut sum = self.mean;
        for (octave, phase) in self.octaves.iter().zip(&phases.octaves) {
            octave.add(&self.tile, octave.node_phase(*phase, node), &mut sum);
        }
        for (print, base) in self.footprints.iter().zip(&phases.bases) {
            let [x, z] = print.velocity(&self.images, print.to_node(*base, node));
            sum = [sum[0] + x, sum[1] + z];
        }
        for (fluid, phase) in self.fluids.iter().zip(&phases.fluids) {
            fluid.add(fluid.node_phase(*phase, node), &mut sum);
        }
        sum
    }

    /// [`WindField::velocity`] of a row of nodes going along +x from `first`, the same bits; planar, as many as both
    /// outputs hold.
    pub fn velocity_row(&self, phases: &Phases, first: [i32; 2], along_x: &mut [f32], along_z: &mut [f32]) {
        for (i, (x, z)) in along_x.iter_mut().zip(along_z).enumerate() {
            [*x, *z] = self.velocity(phases, [first[0].wrapping_add(i as i32), first[1]]);
        }
    }

    /// Air velocity along x and z \[m/s\] at `local` metres (x, z), some kilometres at most, from where `phases` belong:
    /// the wind between nodes, for drawing.
    pub fn velocity_local(&self, phases: &Phases, local: [f32; 2]) -> [f32; 2] {
        let mut sum = self.mean;
        for (octave, phase) in self.octaves.iter().zip(&phases.octaves) {
            octave.add(&self.tile, octave.local_phase(*phase, local), &mut sum);
        }
        for (print, base) in self.footprints.iter().zip(&phases.bases) {
            let [x, z] = print.velocity(&self.images, print.to_local(*base, local));
            sum = [sum[0] + x, sum[1] + z];
        }
        for (fluid, phase) in self.fluids.iter().zip(&phases.fluids) {
            fluid.add(fluid.local_phase(*phase, local), &mut sum);
        }
        sum
    }

    /// A speed \[m/s\] seldom exceeded: the mean and two standard deviations of the gusts and eddies. Grass that this wind does not
    /// stir may sleep.
    pub fn gust_speed(&self) -> f32 {
        let squares: f32 = self.octaves.iter().map(|octave| octave.amplitude * octave.amplitude).sum();
        let mean = (self.mean[0] * self.mean[0] + self.mean[1] * self.mean[1]).sqrt();
        let gusts = 2.0 * TILE_DEVIATION * squares.sqrt();
        let eddies: f32 = self.fluids.iter().map(|fluid| fluid.speed * fluid.speed).sum();
        mean + if eddies > 0.0 { (gusts * gusts + eddies).sqrt() } else { gusts }
    }

    /// Whether the wind is not the same everywhere.
    pub fn varies(&self) -> bool {
        !self.octaves.is_empty() || !self.footprints.is_empty() || !self.fluids.is_empty()
    }

    /// The field as the GPU reads it, for patches with `intervals` node intervals along a side.
    pub fn block(&self, intervals: u32) -> WindBlock {
        let mut octaves = [Octave::default(); MAX_OCTAVES];
        let count = self.octaves.len().min(MAX_OCTAVES);
        octaves[..count].copy_from_slice(&self.octaves[..count]);
        let mut footprints = [Footprint::default(); MAX_FOOTPRINTS];
        let prints = self.footprints.len().min(MAX_FOOTPRINTS);
        footprints[..prints].copy_from_slice(&self.footprints[..prints]);
        let mut fluids = [FluidBlock::default(); MAX_FLUIDS];
        fluids.iter_mut().zip(&self.fluids).for_each(|(block, fluid)| *block = fluid.block);
        WindBlock {
            mean: self.mean,
            count: count as u32,
            intervals,
            octaves,
            footprint_count: prints as u32,
            fluid_count: self.fluids.len().min(MAX_FLUIDS) as u32,
            unused: [0; 2],
            footprints,
            fluids,
        }
    }
}

/// The bend β \[rad, along x and z\] at which a plant rests in a wind \[m/s\]: `atan(k_w |W|^(4/3))` along W, 0 at W = 0.
/// The power 4/3 is the drag of sedge (Belyaev et al. 2011).
#[inline(always)]
pub fn equilibrium(wind: [f32; 2], k_w: f32) -> [f32; 2] {
    let speed = (wind[0] * wind[0] + wind[1] * wind[1]).sqrt();
    let lean = atan(k_w * speed * cbrt(speed));
    let share = lean / upper(speed, 1e-9);
    [wind[0] * share, wind[1] * share]
}
