//! What a device says by itself, sorted by what can be done about it.

use std::error::Error;

use super::GpuError;

/// One broken pipeline repeats its message every frame; the first few tell the story.
const MOST: usize = 16;

/// Everything said since the last look; a loss is for ever.
#[derive(Debug, Default)]
pub(super) struct Reports {
    lost: Option<String>,
    exhausted: Option<String>,
    messages: Vec<String>,
}

impl Reports {
    /// An error that no call returned.
    pub(super) fn add(&mut self, error: &wgpu::Error) {
        let text = match error {
            wgpu::Error::OutOfMemory { source } => {
                let whole = chain(source.as_ref());
                self.exhausted.get_or_insert_with(|| whole.clone());
                format!("out of memory: {whole}")
            }
            other => other.to_string(),
        };
        if self.messages.len() < MOST {
            self.messages.push(text);
        }
    }

    /// The device is gone.
    pub(super) fn lose(&mut self, reason: wgpu::DeviceLostReason, message: &str) {
        let words = match reason {
            wgpu::DeviceLostReason::Destroyed => "it was destroyed",
            _ if message.is_empty() => "its driver does not say why",
            _ => message,
        };
        self.lost.get_or_insert_with(|| words.to_owned());
    }

    /// Something went wrong, and it is not known to be a loss.
    pub(super) fn is_troubled(&self) -> bool {
        self.lost.is_none() && !self.messages.is_empty()
    }

    /// Takes the messages.
    pub(super) fn take(&mut self) -> Vec<String> {
        self.exhausted = None;
        std::mem::take(&mut self.messages)
    }

    /// Takes the messages as the error they amount to: what follows from a loss or from a lack of memory is not told.
    pub(super) fn verdict(&mut self) -> Result<(), GpuError> {
        let (exhausted, messages) = (self.exhausted.take(), std::mem::take(&mut self.messages));
        match (&self.lost, exhausted) {
            (Some(reason), _) => Err(GpuError::Lost { reason: reason.clone() }),
            (None, Some(what)) => Err(GpuError::OutOfMemory { what }),
            (None, None) if messages.is_empty() => Ok(()),
            (None, None) => Err(GpuError::Device(messages.join("\n"))),
        }
    }
}

/// An error and what caused it, in one line.
fn chain(error: &(dyn Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text += &format!(": {error}");
        cause = error.source();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn invalid(description: &str) -> wgpu::Error {
        wgpu::Error::Validation { source: description.into(), description: description.to_owned() }
    }

    #[test]
    fn errors_are_told_apart() {
        let mut reports = Reports::default();
        assert!(reports.verdict().is_ok(), "control: nothing was said");
        reports.add(&invalid("wrong"));
        assert!(matches!(reports.verdict(), Err(GpuError::Device(text)) if text == "wrong"));
        assert!(reports.verdict().is_ok(), "it is told once");
        reports.add(&wgpu::Error::OutOfMemory { source: "cells now".into() });
        reports.add(&invalid("what follows from it"));
        assert!(matches!(reports.verdict(), Err(GpuError::OutOfMemory { what }) if what == "cells now"));
        assert!(reports.verdict().is_ok(), "there may be room again");
        reports.add(&invalid("what follows from it"));
        reports.lose(wgpu::DeviceLostReason::Unknown, "unplugged");
        reports.lose(wgpu::DeviceLostReason::Destroyed, "");
        for _ in 0..2 {
            assert!(matches!(reports.verdict(), Err(GpuError::Lost { reason }) if reason == "unplugged"), "a loss is for ever");
        }
    }

    #[test]
    fn many_messages_are_cut() {
        let mut reports = Reports::default();
        (0..1000).for_each(|_| reports.add(&invalid("wrong")));
        assert_eq!(reports.take().len(), MOST);
    }
}
