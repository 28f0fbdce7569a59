//! The device everything runs on, and the errors it reports.
//!
//! Only WebGPU's default limits are asked for, so whatever runs here also runs in a browser.
//!
//! A device may be lost at any moment (a driver restarts, a card is unplugged), and its memory may run out. Both are errors of the call
//! that notices: [`GpuError::Lost`], after which every call with that device fails so, and [`GpuError::OutOfMemory`]. Cells on a lost
//! device are gone. To go on, keep what [`sward::world::World::save`] writes after a download; once restored, the world steps on the CPU, or on a
//! new [`Gpu`] with new `GpuStep` and `Studio`.

mod memory;
mod programs;
mod reports;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

pub(crate) use memory::Mapping;
pub(crate) use programs::Program;
use reports::Reports;

/// A device that takes longer for what it was given is taken for lost.
const PATIENCE: Duration = Duration::from_secs(1800);

/// A device, its queue, and what went wrong on it.
pub struct Gpu {
    /// The logical device: creates buffers, textures and pipelines.
    pub device: wgpu::Device,
    /// Where work and data are handed in.
    pub queue: wgpu::Queue,
    /// Name, kind and driver of the adapter.
    pub adapter_info: wgpu::AdapterInfo,
    reports: Arc<Mutex<Reports>>,
    programs: programs::Programs,
}

/// Why there is no usable device.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// No adapter at all.
    #[error(
        "no graphics adapter found. A software one is enough:\n\
         \x20 Debian, Ubuntu: apt install mesa-vulkan-drivers\n\
         \x20 Fedora: dnf install mesa-vulkan-drivers\n\
         \x20 Windows, macOS: update the graphics driver"
    )]
    NoAdapter,
    /// The environment variable names an adapter that is not there.
    #[error("SWARD_ADAPTER is \"{wanted}\", but the adapters here are: {found}")]
    UnknownAdapter {
        /// What the variable says.
        wanted: String,
        /// Names of the adapters that exist, separated by commas.
        found: String,
    },
    /// The adapter exists but gives no device.
    #[error("the adapter \"{adapter}\" gave no device: {reason}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What the driver said.
        reason: String,
    },
    /// The budget asks for more cells than one buffer can bind.
    #[error(
        "{slots} awake patches of {cells}×{cells} cells do not fit one buffer of this device; it holds {most}. Lower budget.patches or the stand's cells"
    )]
    TooManyCells {
        /// Patches asked for.
        slots: u32,
        /// Cells per patch side.
        cells: u32,
        /// Patches that fit.
        most: u32,
    },
    /// More patches near a camera keep their upper segments than one buffer can bind.
    #[error(
        "{slots} patches of {cells}×{cells} cells near a camera do not fit the buffer of upper segments of this device; it holds {most}. Lower budget.lag_distance or the stand's cells"
    )]
    TooManyLagCells {
        /// Patches asked for.
        slots: u32,
        /// Cells per patch side.
        cells: u32,
        /// Patches that fit.
        most: u32,
    },
    /// More billboards are deformed than one buffer can bind the sheets of.
    #[error(
        "the sheets of {sheets} deformed billboards do not fit one buffer of this device; it holds {most}. Lower budget.sheets or the response's columns and rows"
    )]
    TooManySheets {
        /// Sheets asked for.
        sheets: u32,
        /// Sheets that fit.
        most: u32,
    },
    /// The device is gone, and with it what it held. Open another one, or go on on the CPU from the last state that was saved.
    #[error("the graphics device was lost: {reason}")]
    Lost {
        /// What is known about it.
        reason: String,
    },
    /// The device has no room left. Fewer awake patches (`budget.patches`), fewer cells of a stand, fewer `budget.visible_plants` or a smaller
    /// picture need less.
    ///
    /// Cells that were there still are, and may be downloaded, but a step that failed so was planned already: to go on, make a new
    /// `GpuStep` from a world that was saved before it.
    #[error("the graphics device is out of memory: {what}")]
    OutOfMemory {
        /// What did not fit, in the driver's words.
        what: String,
    },
    /// What was asked for is still on the device, and in a browser nothing can wait for it. Ask first whether it is there: `GpuStep::ready`,
    /// `GpuStep::arrived`.
    #[error("the graphics device has not finished yet, and a page cannot wait for it")]
    Early,
    /// The device reported errors while working.
    #[error("the graphics device reported: {0}")]
    Device(String),
}

/// What a device needs for [`crate::stopwatch`], as far as its adapter has it.
pub const CLOCK: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES);

impl Gpu {
    /// Opens the best adapter, or the one whose name contains `SWARD_ADAPTER` (case does not matter). `SWARD_ADAPTER=none`: as if there
    /// were no adapter.
    ///
    /// `SWARD_VALIDATION=1` switches the driver's validation layer on.
    ///
    /// # Errors
    /// No adapter, no adapter of that name, or the adapter refuses a device.
    pub fn new() -> Result<Self, GpuError> {
        let wanted = std::env::var("SWARD_ADAPTER").ok().filter(|name| !name.is_empty());
        pollster::block_on(Self::open(wanted.as_deref()))
    }

    /// As [`Gpu::new`], with the device's clock where the adapter has one: for [`crate::stopwatch`].
    ///
    /// # Errors
    /// As [`Gpu::new`].
    pub fn with_clock() -> Result<Self, GpuError> {
        let wanted = std::env::var("SWARD_ADAPTER").ok().filter(|name| !name.is_empty());
        pollster::block_on(Self::open_with(wanted.as_deref(), CLOCK))
    }

    /// As [`Gpu::new`], with the wanted name given instead of read from the environment.
    ///
    /// # Errors
    /// As [`Gpu::new`].
    pub async fn open(wanted: Option<&str>) -> Result<Self, GpuError> {
        Self::open_with(wanted, wgpu::Features::empty()).await
    }

    /// As [`Gpu::open`], with those of `features` that the adapter has.
    async fn open_with(wanted: Option<&str>, features: wgpu::Features) -> Result<Self, GpuError> {
        if wanted == Some("none") {
            return Err(GpuError::NoAdapter);
        }
        let mut adapters = Vec::new();
        // OpenGL is opened only where nothing better exists.
        for backends in [wgpu::Backends::PRIMARY, wgpu::Backends::SECONDARY] {
            if adapters.is_empty() {
                let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
                descriptor.backends = backends;
                descriptor.flags = flags();
                adapters = wgpu::Instance::new(descriptor).enumerate_adapters(backends).await;
            }
        }
        let adapter = choose(adapters, wanted)?;
        let adapter_info = adapter.get_info();
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("sward"),
                required_features: adapter.features() & features,
                required_limits: wgpu::Limits::default(),
                ..Default::default()
            })
            .await
            .map_err(|reason| GpuError::NoDevice { adapter: adapter_info.name.clone(), reason: reason.to_string() })?;
        Ok(Self::watch(device, queue, adapter_info))
    }

    /// Takes over a device somebody else made, for hosts that own one already.
    pub fn watch(device: wgpu::Device, queue: wgpu::Queue, adapter_info: wgpu::AdapterInfo) -> Self {
        let reports = Arc::new(Mutex::new(Reports::default()));
        let (errors, losses) = (Arc::clone(&reports), Arc::clone(&reports));
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| open(&errors).add(&error)));
        device.set_device_lost_callback(move |reason, message| open(&losses).lose(reason, &message));
        Self { device, queue, adapter_info, reports, programs: programs::Programs::default() }
    }

    /// Takes the messages collected since the last call; empty when all went well.
    pub fn take_errors(&self) -> Vec<String> {
        open(&self.reports).take()
    }

    /// Fails when the device has reported anything since the last look, or is lost.
    ///
    /// # Errors
    /// [`GpuError::Lost`], [`GpuError::OutOfMemory`], or [`GpuError::Device`] with the collected messages.
    pub fn check(&self) -> Result<(), GpuError> {
        // A device that was destroyed says so only when it is asked, and only once all its work is done; until then calls merely go wrong.
        self.poll(wgpu::PollType::Poll);
        if open(&self.reports).is_troubled() {
            self.poll(wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) });
        }
        open(&self.reports).verdict()
    }

    /// Hears what the device has finished meanwhile; never waits.
    pub(crate) fn look(&self) {
        self.poll(wgpu::PollType::Poll);
    }

    /// Waits until `submission` is done, or everything is.
    ///
    /// # Errors
    /// As [`Gpu::check`].
    pub(crate) fn wait(&self, submission: Option<wgpu::SubmissionIndex>) -> Result<(), GpuError> {
        let answered = self.poll(wgpu::PollType::Wait { submission_index: submission, timeout: Some(PATIENCE) });
        self.check()?;
        if answered { Ok(()) } else { Err(self.silent()) }
    }

    /// Why a device did not do what it was asked to; it may not say.
    pub(crate) fn silent(&self) -> GpuError {
        self.poll(wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) });
        if let Err(error) = open(&self.reports).verdict() {
            return error;
        }
        open(&self.reports).lose(wgpu::DeviceLostReason::Unknown, "it does not answer");
        GpuError::Lost { reason: "it does not answer".to_owned() }
    }

    /// Lets the device work; false if it did not do what was asked.
    fn poll(&self, what: wgpu::PollType) -> bool {
        // wgpu 29 panics here, and only here, when the driver notices the loss while it is waited for.
        let polled = catch_unwind(AssertUnwindSafe(|| self.device.poll(what).is_ok()));
        polled.unwrap_or_else(|_| {
            open(&self.reports).lose(wgpu::DeviceLostReason::Unknown, "its driver gave up while it was waited for");
            false
        })
    }
}

fn open(reports: &Mutex<Reports>) -> MutexGuard<'_, Reports> {
    reports.lock().unwrap_or_else(PoisonError::into_inner)
}

/// `SWARD_VALIDATION=1` switches the driver's validation layer on. Without debug information: older layers refuse WGSL as a source
/// language in it.
pub fn flags() -> wgpu::InstanceFlags {
    if std::env::var_os("SWARD_VALIDATION").is_some_and(|value| value == "1") {
        wgpu::InstanceFlags::VALIDATION
    } else {
        wgpu::InstanceFlags::empty()
    }
}

fn choose(adapters: Vec<wgpu::Adapter>, wanted: Option<&str>) -> Result<wgpu::Adapter, GpuError> {
    let names = adapters.iter().map(|adapter| adapter.get_info().name).collect::<Vec<_>>().join(", ");
    if adapters.is_empty() {
        return Err(GpuError::NoAdapter);
    }
    let fits = |adapter: &wgpu::Adapter| wanted.is_none_or(|part| adapter.get_info().name.to_lowercase().contains(&part.to_lowercase()));
    adapters
        .into_iter()
        .filter(fits)
        .min_by_key(|adapter| rank(&adapter.get_info()))
        .ok_or_else(|| GpuError::UnknownAdapter { wanted: wanted.unwrap_or_default().to_owned(), found: names })
}

/// Lower is better: a real graphics card before a software driver, a native interface before OpenGL.
fn rank(info: &wgpu::AdapterInfo) -> u32 {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    2 * kind + u32::from(info.backend == wgpu::Backend::Gl)
}
