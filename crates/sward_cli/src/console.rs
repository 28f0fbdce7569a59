//! What is said on the terminal.

use std::io::{ErrorKind, Write};

use crate::failure::Failure;

/// Where words go.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Console {
    /// Only answers and errors.
    pub(crate) quiet: bool,
}

impl Console {
    /// Prints what was asked for, and a line break if it lacks one.
    pub(crate) fn answer(&self, text: &str) -> Result<(), Failure> {
        let mut out = std::io::stdout().lock();
        let end = if text.ends_with('\n') { "" } else { "\n" };
        match write!(out, "{text}{end}").and_then(|()| out.flush()) {
            // The reader has seen enough, as `head` does.
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            written => written.map_err(|error| Failure::failed(format!("cannot write to the terminal: {error}"))),
        }
    }

    /// Prints what was done, unless silence was asked for.
    pub(crate) fn summary(&self, text: &str) -> Result<(), Failure> {
        if self.quiet { Ok(()) } else { self.answer(text) }
    }

    /// Says on stderr, in one line, what is done otherwise than one might expect; not where silence was asked for.
    pub(crate) fn note(&self, text: &str) {
        if !self.quiet {
            eprintln!("sward: {text}");
        }
    }
}
