//! A bar with the remaining time, for whatever takes more than a second.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::console::Console;

/// Work of a known length.
pub(crate) struct Progress {
    bar: ProgressBar,
    begun: Instant,
    hidden: bool,
    wanted: bool,
}

impl Progress {
    /// Work of `length` units; `what` is the unit, in the plural.
    pub(crate) fn new(length: u64, what: &'static str, console: &Console) -> Self {
        let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::hidden());
        let template = format!("{{bar:32}} {{pos}}/{{len}} {what}, {{eta}} left");
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style);
        }
        Self { bar, begun: Instant::now(), hidden: true, wanted: !console.quiet && std::io::stderr().is_terminal() }
    }

    /// One unit is done.
    pub(crate) fn advance(&mut self) {
        if self.hidden && self.wanted && self.begun.elapsed() > Duration::from_secs(1) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
            self.hidden = false;
        }
        self.bar.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
