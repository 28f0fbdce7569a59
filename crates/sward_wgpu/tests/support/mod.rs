//! What tests on a graphics adapter share.
#![allow(dead_code, reason = "each test binary uses its own part")]

use std::sync::{Mutex, OnceLock, PoisonError};

/// Where wgpu reports what the Vulkan validation layer says, and that the layer is missing.
const LAYER: &str = "wgpu_hal::vulkan::instance";

/// Collects what the driver's validation layer says.
///
/// `Gpu::take_errors` sees only what wgpu itself refuses; the layer's messages go to the `log` crate. Install the watch *before* the
/// first `Gpu::new()`: wgpu asks the layer for warnings only while somebody listens. Only `SWARD_VALIDATION=1` switches the layer on;
/// without it the watch hears nothing. With it, and no layer on the machine, the watch holds the message that says so.
///
/// There is one watch per process, shared by all its tests:
///
/// ```ignore
/// mod support;
/// let watch = support::Watch::install();
/// let gpu = Gpu::new()?;
/// // … work, and wait for it …
/// assert_eq!(watch.messages(), Vec::<String>::new());
/// ```
pub(crate) struct Watch {
    messages: Mutex<Vec<String>>,
}

impl Watch {
    /// The watch of this process, listening from the first call on.
    ///
    /// # Panics
    /// If another logger was installed before: then the watch would hear nothing.
    pub(crate) fn install() -> &'static Self {
        static WATCH: OnceLock<Watch> = OnceLock::new();
        let mut first = false;
        let watch = WATCH.get_or_init(|| {
            first = true;
            Self { messages: Mutex::new(Vec::new()) }
        });
        if first {
            log::set_logger(watch).expect("a logger is installed already");
            // wgpu says at this level that the layer is missing.
            log::set_max_level(log::LevelFilter::Debug);
        }
        watch
    }

    /// Warnings and errors so far, oldest first, without their appended lists of objects.
    pub(crate) fn messages(&self) -> Vec<String> {
        self.messages.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Takes the messages: the next look sees only newer ones.
    pub(crate) fn take(&self) -> Vec<String> {
        std::mem::take(&mut *self.messages.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl log::Log for Watch {
    fn enabled(&self, metadata: &log::Metadata<'_>) -> bool {
        metadata.target() == LAYER
    }

    fn log(&self, record: &log::Record<'_>) {
        if !self.enabled(record.metadata()) {
            return;
        }
        let text = record.args().to_string();
        let matters = record.level() <= log::Level::Warn || text.contains("unable to find layer");
        // Lines that begin with a tab list the objects of the message before.
        if matters && !text.starts_with('\t') {
            self.messages.lock().unwrap_or_else(PoisonError::into_inner).push(text);
        }
    }

    fn flush(&self) {}
}

/// Whether tests on an adapter can run: `Ok(true)` here, `Ok(false)` where there is none (print such tests as *ignored*), and an
/// error where `CI` is set, since there they must run.
pub(crate) fn adapter() -> Result<bool, String> {
    match sward_wgpu::gpu::Gpu::new() {
        Ok(_) => Ok(true),
        Err(error) if std::env::var_os("CI").is_some() => Err(error.to_string()),
        Err(_) => Ok(false),
    }
}
