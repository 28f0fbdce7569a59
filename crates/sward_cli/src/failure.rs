//! What can go wrong, in plain words: what happened, where, and what to type instead.

use std::fmt;
use std::io::IsTerminal;
use std::process::ExitCode;

use miette::{Diagnostic, LabeledSpan, MietteHandlerOpts, NamedSource, Report, SourceCode};
use sward::scene::SceneError;
use sward_wgpu::gpu::GpuError;

/// Why a command did not do what was asked.
#[derive(Debug)]
pub(crate) struct Failure {
    message: String,
    help: Option<String>,
    source: Option<Box<Place>>,
    status: u8,
}

/// Longest line of a scene that is shown, letters.
const WIDEST: u32 = 2000;

/// Where in a scene file.
#[derive(Debug)]
struct Place {
    text: NamedSource<String>,
    label: LabeledSpan,
}

impl Failure {
    /// What was asked for cannot be done (status 2); nothing has been written.
    pub(crate) fn input(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()), source: None, status: 2 }
    }

    /// The machine did not play along (status 1).
    pub(crate) fn failed(message: impl Into<String>) -> Self {
        Self { message: message.into(), help: None, source: None, status: 1 }
    }

    /// Adds what to do about it.
    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// Prints the failure and gives the process's exit status.
    pub(crate) fn report(self) -> ExitCode {
        let status = self.status;
        // Lines are broken only for a reader: a log or an editor wants each message whole.
        let whole = !std::io::stderr().is_terminal();
        // The hook can be set only once; a second report would look the same.
        let _ = miette::set_hook(Box::new(move |_| {
            let options = MietteHandlerOpts::new();
            Box::new(if whole { options.wrap_lines(false).color(false) } else { options }.build())
        }));
        eprintln!("{:?}", Report::new(self));
        ExitCode::from(status)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

impl Diagnostic for Failure {
    fn help(&self) -> Option<Box<dyn fmt::Display + '_>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|place| &place.text as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.source.as_ref().map(|place| Box::new(std::iter::once(place.label.clone())) as Box<dyn Iterator<Item = LabeledSpan>>)
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let name = if error.file.is_empty() { "scene" } else { &error.file };
        if error.line == 0 {
            return Self { message: format!("{name}: {}", error.message), help: error.help, source: None, status: 2 };
        }
        // A line too long for a terminal shows nothing, and miette panics beyond column 65535: message and column say where it is.
        if error.column > WIDEST || error.span().len() > WIDEST as usize {
            return Self {
                message: format!("{name}:{}:{}: {}", error.line, error.column, error.message),
                help: error.help,
                source: None,
                status: 2,
            };
        }
        let span = error.span();
        // One letter is enough to point at; the rest of the line may be fine.
        let letter = error.text[span.clone()].chars().next().map_or(0, char::len_utf8);
        let label = LabeledSpan::at(span.start..span.start + letter, "here");
        let text = NamedSource::new(name, error.text.clone());
        Self {
            message: format!("{name}:{}:{}: {}", error.line, error.column, error.message),
            help: error.help,
            source: Some(Box::new(Place { text, label })),
            status: 2,
        }
    }
}

impl From<GpuError> for Failure {
    fn from(error: GpuError) -> Self {
        let text = error.to_string();
        match (&error, text.split_once(". ")) {
            (GpuError::NoAdapter, Some((what, advice))) => Self::failed(what).help(advice),
            (GpuError::Lost { .. }, _) => {
                Self::failed(text).help("run it again (a sequence with --resume goes on where it stopped), or without a graphics card: --on cpu --draw cpu")
            }
            (GpuError::OutOfMemory { .. }, _) => Self::failed(text).help(
                "type a smaller --size, or lower budget.patches, budget.visible_plants or a stand's cells in the scene; or do without a graphics card: --on cpu --draw cpu",
            ),
            (GpuError::UnknownAdapter { .. }, _) => {
                Self::input(text, "set SWARD_ADAPTER to a part of one of these names, or unset it; or do without a graphics card: --on cpu --draw cpu")
            }
            (GpuError::TooManyCells { .. } | GpuError::TooManyLagCells { .. } | GpuError::TooManySheets { .. }, Some((what, advice))) => {
                Self::input(what, format!("{advice} in the scene; or do without a graphics card: --on cpu --draw cpu"))
            }
            _ => Self::failed(text),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_asked_for_and_is_not_there_is_wrong_input() {
        let unknown = Failure::from(GpuError::UnknownAdapter { wanted: "fast".to_owned(), found: "slow".to_owned() });
        let many = Failure::from(GpuError::TooManyCells { slots: 4096, cells: 256, most: 128 });
        let lagged = Failure::from(GpuError::TooManyLagCells { slots: 112, cells: 256, most: 85 });
        let sheets = Failure::from(GpuError::TooManySheets { sheets: 200_000, most: 142_784 });
        let cases = [
            (unknown, ["slow", "unset it"]),
            (many, ["holds 128", "budget.patches"]),
            (lagged, ["holds 85", "budget.lag_distance"]),
            (sheets, ["holds 142784", "budget.sheets"]),
        ];
        for (failure, words) in cases {
            let help = failure.help.clone().unwrap_or_default();
            assert_eq!(failure.status, 2);
            assert!(failure.message.contains(words[0]) && help.contains(words[1]) && help.contains("--on cpu"), "{failure:?}");
        }
        let none = Failure::from(GpuError::NoAdapter);
        assert!(none.status == 1 && none.help.is_some(), "control: a machine without an adapter is no wrong input");
    }

    #[test]
    fn lost_and_full_devices_fail_with_a_way_out() {
        let lost = Failure::from(GpuError::Lost { reason: "unplugged".to_owned() });
        let full = Failure::from(GpuError::OutOfMemory { what: "cells now".to_owned() });
        for (failure, words) in [(lost, ["unplugged", "--resume"]), (full, ["cells now", "budget.patches"])] {
            let help = failure.help.clone().unwrap_or_default();
            assert_eq!(failure.status, 1);
            assert!(failure.message.contains(words[0]) && help.contains(words[1]) && help.contains("--on cpu --draw cpu"), "{failure:?}");
        }
    }
}
