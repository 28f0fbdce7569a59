//! Depth cube maps drawn on the GPU, from triangles that the CPU has posed.
//!
//! Orthmann et al. 2009, §5.2; methods §4. The arithmetic of [`DistanceMap::new`]: the same whole numbers, so the same texels see something.
//! Reads points and triangles. Writes texels as [`DistanceMap::texels`] has them. Shader: `distance_maps.wgsl`.
//!
//! [`DistanceMap::new`]: sward::interaction::distance_map::DistanceMap::new
//! [`DistanceMap::texels`]: sward::interaction::distance_map::DistanceMap::texels

use bytemuck::{Pod, Zeroable};
use sward::interaction::distance_map::{self, Cube, sized};

use super::Work;
use super::passes::{Groups, Pass};
use super::traffic;
use crate::gpu::{Gpu, Program};
use crate::stopwatch::Stopwatch;

/// Most workgroups along one axis that are asked for.
const ROW: u32 = 32768;
/// Workgroups that share large triangles.
const SHARING: u32 = 256;

/// A body whose map is to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct MapInput<'a> {
    /// Its points in the body's frame, m.
    pub points: &'a [[f32; 3]],
    /// Triangles by the indices of their corners. Those with unknown corners or corners that are not finite are left out.
    pub triangles: &'a [[u32; 3]],
    /// What it is drawn in.
    pub cube: Cube,
    /// Texels along a side of a face, 8 to [`distance_map::MOST_TEXELS`].
    pub size: u32,
    /// Where its 6 · size² texels begin. Maps must not overlap.
    pub first: u32,
}

/// `MapDraw` of `distance_maps.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MapDraw {
    /// First of its texels.
    pub first: u32,
    /// First of the words that say which triangle a texel sees.
    pub winners: u32,
    /// Texels along a side of a face.
    pub size: u32,
    /// Half of the cube's edge, m.
    pub half: f32,
    /// Texels to the metre.
    pub scale: f32,
}

/// All maps of one call, as the passes read them.
#[derive(Default)]
pub(super) struct Drawing {
    maps: Vec<MapDraw>,
    pub(super) points: Vec<[f32; 3]>,
    pub(super) triangles: Vec<[u32; 4]>,
    /// Texels of all.
    pub(super) winners: u32,
    widest: u32,
}

impl Drawing {
    /// The maps that are drawn at once.
    pub(super) fn of(inputs: &[MapInput<'_>]) -> Self {
        let mut drawing = Self::default();
        for input in &inputs[..inputs.len().min(ROW as usize)] {
            drawing.add(input);
        }
        drawing
    }

    /// Workgroups of the passes: `draw_pass`, `large_pass`, `write_pass`.
    pub(super) fn groups(&self) -> [[u32; 3]; 3] {
        let count = self.triangles.len();
        let (groups, some) = ((3 * count as u64).div_ceil(64) as u32, u32::from(count > 0));
        let write = [self.widest.div_ceil(64), self.maps.len() as u32, u32::from(!self.maps.is_empty())];
        [[groups.min(ROW), groups.div_ceil(ROW), some], [SHARING, 1, some], write]
    }

    fn add(&mut self, input: &MapInput<'_>) {
        let (size, half) = (sized(input.size), input.cube.half);
        let number = self.maps.len() as u32;
        let area = 6 * size * size;
        let scale = 0.5 * size as f32 / half;
        self.maps.push(MapDraw { first: input.first, winners: self.winners, size, half, scale });
        self.winners = self.winners.saturating_add(area);
        self.widest = self.widest.max(area);
        let base = self.points.len() as u32;
        let from_middle = |point: &[f32; 3]| [0, 1, 2].map(|axis: usize| point[axis] - input.cube.centre[axis]);
        self.points.extend(input.points.iter().map(from_middle));
        let own = &self.points[base as usize..];
        let is_drawn = |index: &u32| own.get(*index as usize).is_some_and(|point| point.iter().all(|part| part.is_finite()));
        if half > 0.0 && scale.is_finite() {
            let drawn = input.triangles.iter().filter(|triangle| triangle.iter().all(is_drawn));
            self.triangles.extend(drawn.map(|[a, b, c]| [a + base, b + base, c + base, number]));
        }
    }
}

/// The full text of the compute shader.
pub fn assembled() -> String {
    [sward::math::WGSL, distance_map::RASTER_WGSL, include_str!("distance_maps.wgsl")].join("\n")
}

/// The passes that draw distance maps.
pub struct DistanceMapPasses {
    draw: Pass,
    large: Pass,
    write: Pass,
}

impl DistanceMapPasses {
    /// Builds the pipelines.
    pub fn new(gpu: &Gpu) -> Self {
        let program = Program::new("distance maps", assembled());
        Self {
            draw: Pass::plain(gpu, &program, "draw_pass", &[0, 1, 2, 3, 4]),
            large: Pass::plain(gpu, &program, "large_pass", &[0, 1, 2, 3, 4]),
            write: Pass::plain(gpu, &program, "write_pass", &[0, 1, 2, 3, 5]),
        }
    }

    /// Records the drawing of maps, at most 32768 at once, into a storage buffer of texels, 16 bytes each. Texels of no map stay as they are; those
    /// beyond the buffer are not written.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        maps: &[MapInput<'_>],
        texels: &wgpu::Buffer,
        work: &mut Work,
        mut stopwatch: Option<&mut Stopwatch>,
    ) {
        let drawing = Drawing::of(maps);
        if drawing.maps.is_empty() {
            return;
        }
        let count = drawing.triangles.len() as u32;
        let mut filled = |label: &str, bytes: &[u8]| {
            work.uploaded += bytes.len() as u64;
            gpu.filled(label, if bytes.is_empty() { &[0; 16] } else { bytes }, wgpu::BufferUsages::STORAGE)
        };
        // New buffers hold zeros: no winners, no large triangles.
        let empty = |label: &str, words: u64| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: words * 4,
                usage: wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        };
        let bound = [
            (0, &filled("distance maps", bytemuck::cast_slice(&drawing.maps))),
            (1, &filled("points of bodies", bytemuck::cast_slice(&drawing.points))),
            (2, &filled("triangles of bodies", bytemuck::cast_slice(&drawing.triangles))),
            (3, &empty("triangles that texels see", u64::from(drawing.winners))),
            (4, &empty("large triangles", 2 + 3 * u64::from(count))),
            (5, texels),
        ];
        let mut run = |pass: &Pass, groups: [u32; 3]| {
            work.add(&pass.run(gpu, encoder, &bound, Groups::Direct(groups), stopwatch.as_deref_mut()));
        };
        let [draw, large, write] = drawing.groups();
        run(&self.draw, draw);
        run(&self.large, large);
        run(&self.write, write);
        work.traffic += traffic::drawn_maps(u64::from(count), drawing.points.len() as u64);
        work.traffic += traffic::written_maps(u64::from(drawing.winners));
    }
}
