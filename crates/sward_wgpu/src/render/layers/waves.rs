//! The waves of a world that steps on the CPU, brought to the device: only what has changed since the picture before.

use sward::response::harmonic::{HarmonicModel, TOUCH_SIDE};
use sward::state::LayeredState;

use super::WaveBuffers;
use crate::gpu::Gpu;

impl WaveBuffers {
    /// Those of two moments, one behind the other.
    pub(crate) fn joined(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, now: &Self, then: &Self) -> Self {
        let mut join = |label: &str, [a, b]: [&wgpu::Buffer; 2]| {
            let joined = buffer(gpu, label, a.size() + b.size());
            encoder.copy_buffer_to_buffer(a, 0, &joined, 0, Some(a.size()));
            encoder.copy_buffer_to_buffer(b, 0, &joined, a.size(), Some(b.size()));
            joined
        };
        let notes = join("notes, now and then", [&now.notes, &then.notes]);
        Self { notes, touches: join("touched plants, now and then", [&now.touches, &then.touches]) }
    }

    /// A copy of them.
    pub(crate) fn copied(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) -> Self {
        let mut copy = |label: &str, of: &wgpu::Buffer| {
            let copy = buffer(gpu, label, of.size());
            encoder.copy_buffer_to_buffer(of, 0, &copy, 0, Some(of.size()));
            copy
        };
        Self { notes: copy("notes then", &self.notes), touches: copy("touched plants then", &self.touches) }
    }
}

/// Waves of one stand.
pub(crate) struct WaveUpload {
    pub(crate) buffers: WaveBuffers,
    /// The step they are of; `None` before the first.
    step: Option<u64>,
}

impl WaveUpload {
    pub(crate) fn new(gpu: &Gpu, model: &HarmonicModel) -> Self {
        let notes = buffer(gpu, "notes of waves", 8 * u64::from(model.ring.notes) * u64::from(model.cells * model.cells));
        Self { buffers: WaveBuffers { notes, touches: buffer(gpu, "touched plants", 8) }, step: None }
    }

    /// Brings the state of step number `step` there.
    pub(crate) fn follow(&mut self, gpu: &Gpu, model: &HarmonicModel, state: &LayeredState, step: u64) {
        let ring = model.ring;
        let since = self.step.and_then(|before| step.checked_sub(before)).unwrap_or(u64::MAX);
        let changed = (since.saturating_add(u64::from(2 * ring.every)) / u64::from(ring.every)).min(u64::from(ring.notes)) as u32;
        let area = u64::from(model.cells * model.cells);
        for back in 0..changed {
            let note = (ring.present(step) + ring.notes - back) % ring.notes;
            if let Some(cells) = state.notes.get(note as usize) {
                gpu.queue.write_buffer(&self.buffers.notes, 8 * area * u64::from(note), bytemuck::cast_slice(cells));
            }
        }
        self.step = Some(step);
        let each = u64::from(TOUCH_SIDE * TOUCH_SIDE) * 8;
        let wanted = each * state.touches.len().max(1) as u64;
        if self.buffers.touches.size() < wanted {
            self.buffers.touches = buffer(gpu, "touched plants", wanted.next_power_of_two());
        }
        for (slot, waves) in state.touches.iter().enumerate().filter(|(_, waves)| !waves.now.is_empty()) {
            gpu.queue.write_buffer(&self.buffers.touches, each * slot as u64, bytemuck::cast_slice(&waves.now));
        }
    }
}

fn buffer(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}
