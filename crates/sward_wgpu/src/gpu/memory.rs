//! Numbers to the device and back, without the calls of wgpu that panic where the device is lost or full.

use std::borrow::Cow;
use std::sync::mpsc;
use std::time::Duration;

use super::{Gpu, GpuError};

/// Longest time from the end of the work until everybody is told.
const GRACE: Duration = Duration::from_secs(60);

impl Gpu {
    /// A buffer that holds `contents`, filled up with zeros to 4 bytes.
    ///
    /// `create_buffer_init` of wgpu maps the new buffer, and panics where there is none.
    pub(crate) fn filled(&self, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let size = contents.len().next_multiple_of(4).max(4);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: size as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut padded = Cow::Borrowed(contents);
        if size > contents.len() {
            padded.to_mut().resize(size, 0);
        }
        self.queue.write_buffer(&buffer, 0, &padded);
        buffer
    }

    /// Maps the first `bytes` (1 or more, a multiple of 4) of a buffer when `submission`, or everything, is done, and lets `take` read them.
    ///
    /// # Errors
    /// As [`Gpu::check`].
    pub(crate) fn mapped<T>(
        &self,
        buffer: &wgpu::Buffer,
        bytes: u64,
        submission: Option<wgpu::SubmissionIndex>,
        take: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        let (tell, answer) = mpsc::channel();
        let slice = buffer.slice(..bytes);
        // Nobody listens any more where the wait has failed.
        slice.map_async(wgpu::MapMode::Read, move |mapped| _ = tell.send(mapped.is_ok()));
        self.wait(submission)?;
        // Another thread that waits may hold the answer, about to give it. wgpu panics where a buffer is read that is not mapped.
        if answer.recv_timeout(GRACE) != Ok(true) {
            return Err(self.silent());
        }
        let taken = take(&slice.get_mapped_range());
        buffer.unmap();
        Ok(taken)
    }
}
