//! Getting numbers back from the GPU.

use crate::gpu::{Gpu, GpuError, Mapping};

/// A copy of a buffer on its way to the CPU.
pub struct Readback {
    staging: wgpu::Buffer,
    bytes: u64,
    mapping: Option<Mapping>,
}

impl Readback {
    /// Records the copy of the first `bytes` of `source`.
    pub fn record(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, source: &wgpu::Buffer, bytes: u64) -> Self {
        let staging = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: bytes.max(4),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        if bytes > 0 {
            encoder.copy_buffer_to_buffer(source, 0, &staging, 0, Some(bytes));
        }
        Self { staging, bytes, mapping: None }
    }

    /// Asks for the values as soon as they are there; after the submission that copies them.
    pub fn begin(&mut self, gpu: &Gpu) {
        if self.bytes > 0 {
            self.mapping = Some(gpu.map(&self.staging, self.bytes));
        }
    }

    /// Whether [`Readback::take`] will not wait.
    pub fn is_there(&mut self) -> bool {
        self.bytes == 0 || self.mapping.as_mut().is_some_and(Mapping::is_answered)
    }

    /// Returns the values; waits until `submission` is done unless they are there.
    ///
    /// # Errors
    /// What the device reports.
    pub fn take<T: bytemuck::Pod>(self, gpu: &Gpu, submission: &wgpu::SubmissionIndex) -> Result<Vec<T>, GpuError> {
        if self.bytes == 0 {
            return Ok(Vec::new());
        }
        let mapping = self.mapping.unwrap_or_else(|| gpu.map(&self.staging, self.bytes));
        mapping.take(gpu, Some(submission.clone()), bytemuck::pod_collect_to_vec)
    }
}

/// Reads the first `bytes` of a buffer now.
///
/// # Errors
/// What the device reports.
pub fn read<T: bytemuck::Pod>(gpu: &Gpu, source: &wgpu::Buffer, bytes: u64) -> Result<Vec<T>, GpuError> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let readback = Readback::record(gpu, &mut encoder, source, bytes);
    let submission = gpu.queue.submit([encoder.finish()]);
    readback.take(gpu, &submission)
}
