//! How far pictures may run ahead of a device that nobody may wait for.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// Pictures that a device may have before it: one to work at, one to go on with.
const MOST: u32 = 2;

/// Pictures handed in and not finished yet.
#[derive(Clone, Debug, Default)]
pub struct Pace(Arc<AtomicU32>);

impl Pace {
    /// Whether the device has room for another picture.
    pub fn is_free(&self) -> bool {
        self.0.load(Ordering::Relaxed) < MOST
    }

    /// A picture was handed in.
    pub fn hand_in(&self, queue: &wgpu::Queue) {
        self.begin();
        let pace = self.clone();
        queue.on_submitted_work_done(move || pace.end());
    }

    fn begin(&self) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    fn end(&self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third_picture_waits() {
        let pace = Pace::default();
        pace.begin();
        assert!(pace.is_free(), "control");
        pace.begin();
        assert!(!pace.is_free());
        pace.end();
        assert!(pace.is_free());
    }
}
