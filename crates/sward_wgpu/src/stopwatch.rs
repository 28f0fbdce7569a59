//! Times of single passes, taken by the device itself. For benches, and for whoever wants to see them.

use crate::compute::readback::read;
use crate::gpu::{Gpu, GpuError};

/// Moments that one recording can hold.
const MOMENTS: u32 = 256;

/// Takes the time of passes between two calls of [`Stopwatch::read`].
pub struct Stopwatch {
    queries: wgpu::QuerySet,
    moments: wgpu::Buffer,
    nanoseconds: f64,
    /// The device tells the time within a pass too.
    inside: bool,
    stages: Vec<(&'static str, [u32; 2])>,
    used: u32,
}

impl Stopwatch {
    /// `None` where the device was opened without [`crate::gpu::CLOCK`], or its adapter has no clock.
    pub fn new(gpu: &Gpu) -> Option<Self> {
        let features = gpu.device.features();
        if !features.contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let queries = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("stopwatch"),
            ty: wgpu::QueryType::Timestamp,
            count: MOMENTS,
        });
        let moments = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("stopwatch"),
            size: u64::from(MOMENTS) * 8,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let inside = features.contains(wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES);
        let nanoseconds = f64::from(gpu.queue.get_timestamp_period());
        Some(Self { queries, moments, nanoseconds, inside, stages: Vec::new(), used: 0 })
    }

    /// Takes places for `count` moments; `None` when the recording is full.
    fn take(&mut self, count: u32) -> Option<u32> {
        let first = self.used;
        if first + count > MOMENTS {
            return None;
        }
        self.used += count;
        Some(first)
    }

    /// Times a compute pass.
    pub fn compute(&mut self, stage: &'static str) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let first = self.take(2)?;
        self.stages.push((stage, [first, first + 1]));
        Some(wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(first),
            end_of_pass_write_index: Some(first + 1),
        })
    }

    /// Times a render pass of several stages; between them goes [`Stopwatch::next`], with the number that comes back, counted up. Where the device
    /// tells no time within a pass, all of it is one stage, `whole`.
    pub fn render(&mut self, whole: &'static str, stages: &[&'static str]) -> Option<(u32, wgpu::RenderPassTimestampWrites<'_>)> {
        let stages = if self.inside && !stages.is_empty() { stages } else { &[whole] };
        let first = self.take(stages.len() as u32 + 1)?;
        for (at, stage) in (first..).zip(stages) {
            self.stages.push((stage, [at, at + 1]));
        }
        let writes = wgpu::RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(first),
            end_of_pass_write_index: Some(first + stages.len() as u32),
        };
        Some((first, writes))
    }

    /// One stage of a render pass ends here and the next begins: the moment `at`.
    pub fn next(&self, pass: &mut wgpu::RenderPass<'_>, at: u32) {
        if self.inside {
            pass.write_timestamp(&self.queries, at);
        }
    }

    /// Copies what was taken; goes at the end of the last encoder.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        if self.used > 0 {
            encoder.resolve_query_set(&self.queries, 0..self.used, &self.moments, 0);
        }
    }

    /// Waits for the device, and starts anew. Milliseconds of each stage since then, in the order they were first met; stages of one
    /// name are added up.
    ///
    /// # Errors
    /// What the device reports.
    pub fn read(&mut self, gpu: &Gpu) -> Result<Vec<(&'static str, f64)>, GpuError> {
        let moments: Vec<u64> = read(gpu, &self.moments, u64::from(self.used) * 8)?;
        let mut times: Vec<(&'static str, f64)> = Vec::new();
        for (stage, [begin, end]) in self.stages.drain(..) {
            let ticks = moments[end as usize].saturating_sub(moments[begin as usize]);
            let milliseconds = 1e-6 * self.nanoseconds * ticks as f64;
            match times.iter_mut().find(|(name, _)| *name == stage) {
                Some((_, sum)) => *sum += milliseconds,
                None => times.push((stage, milliseconds)),
            }
        }
        self.used = 0;
        Ok(times)
    }
}
