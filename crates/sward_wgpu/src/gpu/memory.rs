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

    /// Asks for the first `bytes` (1 or more, a multiple of 4) of a buffer, once all that was handed in before is done.
    pub(crate) fn map(&self, buffer: &wgpu::Buffer, bytes: u64) -> Mapping {
        let (tell, answer) = mpsc::channel();
        // Nobody listens any more where the wait has failed.
        buffer.slice(..bytes).map_async(wgpu::MapMode::Read, move |mapped| _ = tell.send(mapped.is_ok()));
        Mapping { buffer: buffer.clone(), bytes, answer, said: None }
    }

    /// Maps the first `bytes` of a buffer when `submission`, or everything, is done, and lets `take` read them.
    ///
    /// # Errors
    /// As [`Gpu::check`]; [`GpuError::Early`] in a browser, where nothing can wait.
    pub(crate) fn mapped<T>(
        &self,
        buffer: &wgpu::Buffer,
        bytes: u64,
        submission: Option<wgpu::SubmissionIndex>,
        take: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        self.map(buffer, bytes).take(self, submission, take)
    }
}

/// A buffer that is being mapped.
pub(crate) struct Mapping {
    buffer: wgpu::Buffer,
    bytes: u64,
    answer: mpsc::Receiver<bool>,
    /// What the answer was, once it is there.
    said: Option<bool>,
}

impl Mapping {
    /// Whether [`Mapping::take`] will not wait. Only after [`Gpu::look`] is the answer new.
    pub(crate) fn is_answered(&mut self) -> bool {
        self.said = self.said.or(match self.answer.try_recv() {
            Ok(said) => Some(said),
            Err(mpsc::TryRecvError::Empty) => None,
            Err(mpsc::TryRecvError::Disconnected) => Some(false),
        });
        self.said.is_some()
    }

    /// Lets `take` read the bytes; waits for `submission`, or for everything, unless they are there.
    ///
    /// # Errors
    /// As [`Gpu::check`]; [`GpuError::Early`] in a browser, where nothing can wait.
    pub(crate) fn take<T>(
        mut self,
        gpu: &Gpu,
        submission: Option<wgpu::SubmissionIndex>,
        take: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        if self.is_answered() {
            gpu.check()?;
        } else if cfg!(target_arch = "wasm32") {
            gpu.check()?;
            return Err(GpuError::Early);
        } else {
            gpu.wait(submission)?;
            // Another thread that waits may hold the answer, about to give it.
            self.said = self.said.or(self.answer.recv_timeout(GRACE).ok());
        }
        // wgpu panics where a buffer is read that is not mapped.
        if self.said != Some(true) {
            return Err(gpu.silent());
        }
        let taken = take(&self.buffer.slice(..self.bytes).get_mapped_range());
        self.buffer.unmap();
        Ok(taken)
    }
}
