//! Cells from the GPU into the state, in two halves: one asks, the other takes. Between them nobody has to wait.

use std::collections::VecDeque;

use sward::response::chain;
use sward::state::NONE;
use sward::world::World;

use super::GpuStep;
use super::readback::Readback;
use crate::gpu::{Gpu, GpuError};

/// Copies of buffers on their way to the CPU, in the order in which they were asked for.
pub(crate) struct Arriving {
    submission: wgpu::SubmissionIndex,
    copies: VecDeque<Readback>,
}

impl Arriving {
    /// Asks for the first bytes of each buffer.
    fn begin(gpu: &Gpu, parts: &[(&wgpu::Buffer, u64)]) -> Self {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut copies: VecDeque<_> = parts.iter().map(|(buffer, bytes)| Readback::record(gpu, &mut encoder, buffer, *bytes)).collect();
        let submission = gpu.queue.submit([encoder.finish()]);
        copies.iter_mut().for_each(|copy| copy.begin(gpu));
        Self { submission, copies }
    }

    /// The next one; empty beyond the last.
    ///
    /// # Errors
    /// What the device reports.
    pub(crate) fn next<T: bytemuck::Pod>(&mut self, gpu: &Gpu) -> Result<Vec<T>, GpuError> {
        self.copies.pop_front().map_or_else(|| Ok(Vec::new()), |copy| copy.take(gpu, &self.submission))
    }
}

/// The cells of a world on their way to the CPU: from [`GpuStep::begin_download`] to [`GpuStep::finish_download`].
pub struct Download {
    arriving: Arriving,
    /// Step they belong to.
    step: u64,
}

impl GpuStep {
    /// Copies all awake cells and upper segments, and the air that flows, into `world.state`, as if the CPU had stepped. Waits.
    ///
    /// # Errors
    /// What the device reports.
    pub fn download(&mut self, gpu: &Gpu, world: &mut World) -> Result<(), GpuError> {
        gpu.check()?;
        self.collect(gpu, world, 0)?;
        let download = self.begin_download(gpu, world);
        self.finish_download(gpu, world, download)
    }

    /// Asks for what [`GpuStep::download`] brings, without waiting for it.
    pub fn begin_download(&self, gpu: &Gpu, world: &World) -> Download {
        let mut parts = self.air.copied(world);
        for buffers in &self.layered {
            parts.extend(buffers.copied());
        }
        for ((buffers, stand), state) in self.stands.iter().zip(&world.model.stands).zip(&world.state.stands) {
            parts.extend(if stand.springs.is_some() { buffers.copied_sheets(state) } else { buffers.copied() });
        }
        Download { arriving: Arriving::begin(gpu, &parts), step: world.state.step }
    }

    /// Whether [`GpuStep::finish_download`] will not wait. Never waits itself.
    pub fn arrived(&mut self, gpu: &Gpu, download: &mut Download) -> bool {
        self.filed_without_waiting(gpu, 0) && download.arriving.copies.iter_mut().all(Readback::is_there)
    }

    /// Takes over what was asked for; waits for it unless it has [arrived](GpuStep::arrived). Where the world has gone on since, what came is of no
    /// use any more and is asked for again.
    ///
    /// # Errors
    /// What the device reports.
    pub fn finish_download(&mut self, gpu: &Gpu, world: &mut World, mut download: Download) -> Result<(), GpuError> {
        self.collect(gpu, world, 0)?;
        if download.step != world.state.step {
            download = self.begin_download(gpu, world);
        }
        let arriving = &mut download.arriving;
        self.air.arrive(gpu, arriving, world)?;
        let World { model, state, .. } = world;
        for ((buffers, stand), state) in self.layered.iter().zip(&model.layered).zip(&mut state.layered) {
            buffers.arrive(gpu, arriving, &stand.harmonic, state)?;
        }
        for ((buffers, stand), state) in self.stands.iter().zip(&model.stands).zip(&mut state.stands) {
            // Who has which sheet the plan decides: those places never left.
            if stand.springs.is_some() {
                state.cells.sheets = arriving.next(gpu)?;
                continue;
            }
            buffers.arrive(gpu, arriving, &mut state.cells)?;
            if let Some(chain) = &stand.chain {
                state.cells.roots = vec![Box::default(); state.cells.lag.len()];
                for (patch, awake) in state.awake.iter().filter(|(_, awake)| awake.lag != NONE) {
                    state.cells.roots[awake.lag as usize] = chain::roots(&model.terrain, stand, chain, *patch);
                }
                continue;
            }
            for (patch, awake) in &state.awake {
                if let Some(ground) = state.cells.ground.get_mut(awake.slot as usize) {
                    *ground = stand.ground_of(&model.terrain, *patch);
                }
            }
        }
        Ok(())
    }
}
