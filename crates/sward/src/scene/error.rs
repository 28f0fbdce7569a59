//! Errors of scene files: what happened, where in the file, and what to type instead.

use std::fmt;
use std::ops::Range;

use super::{explain, locate};

/// Why a scene is not valid.
///
/// `line` and `column` count from 1; both are 0 where there is no text (a scene built in code).
/// Then `message` begins with the path of the field.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{message}{}", self.place(), self.advice())]
#[non_exhaustive]
pub struct SceneError {
    /// Name of the file, as given by the caller.
    pub file: String,
    /// Line in the file, from 1.
    pub line: u32,
    /// Column in that line in characters, from 1.
    pub column: u32,
    /// What happened.
    pub message: String,
    /// What to type instead.
    pub help: Option<String>,
    /// The whole text of the file.
    pub text: String,
    /// The way to the value that names the file at fault, where that is not the scene itself.
    /// Boxed: errors travel in every result.
    named_by: Box<Trail>,
}

impl SceneError {
    /// A file that the scene names, not the scene itself, is at fault.
    pub(crate) fn in_file(file: &str, message: String) -> Self {
        Self { file: file.to_owned(), line: 0, column: 0, message, help: None, text: String::new(), named_by: Box::default() }
    }

    /// Says which value of the scene names the file at fault.
    pub(crate) fn named_by(self, trail: Trail) -> Self {
        Self { named_by: Box::new(trail), ..self }
    }

    /// Adds what to do about it.
    pub(crate) fn advise(self, help: &str) -> Self {
        Self { help: Some(help.to_owned()), ..self }
    }

    /// An error of a file that a scene names, with its place in that scene: where `text`, the scene called `scene`, names the file. Errors
    /// that have a place already, or concern no other file, stay as they are.
    #[must_use]
    pub fn located(self, text: &str, scene: &str) -> Self {
        if self.line > 0 || self.named_by.0.is_empty() {
            return self;
        }
        let (line, column) = locate::line_and_column(text, locate::locate(text, &self.named_by));
        let message = if self.file.is_empty() { self.message } else { format!("{}: {}", self.file, self.message) };
        Self { file: scene.to_owned(), line, column, message, text: text.to_owned(), ..self }
    }

    /// Where the trouble starts in `text`, up to the end of that line, in bytes. Empty if the place is not known.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        if self.line == 0 {
            return 0..0;
        }
        let start = locate::offset(&self.text, self.line as usize, self.column as usize);
        let rest = self.text[start..].lines().next().unwrap_or("");
        start..start + rest.len()
    }

    fn place(&self) -> String {
        match self.line {
            0 if self.file.is_empty() => String::new(),
            0 => format!("{}: ", self.file),
            _ => format!("{}:{}:{}: ", self.file, self.line, self.column),
        }
    }

    fn advice(&self) -> String {
        self.help.as_ref().map_or_else(String::new, |help| format!("\n  help: {help}"))
    }

    /// The reader's complaint, in our words.
    pub(super) fn from_reader(error: &ron::error::SpannedError, text: &str, file: &str) -> Self {
        let (message, help) = explain::explain(&error.code);
        let (line, column) = locate::line_and_column(text, reader_offset(error, text));
        Self { file: file.to_owned(), line, column, message, help, text: text.to_owned(), named_by: Box::default() }
    }

    /// A problem found after reading, with its place looked up in the text.
    pub(super) fn from_problem(problem: Problem, text: &str, file: &str) -> Self {
        let (line, column) = locate::line_and_column(text, locate::locate(text, &problem.trail));
        Self {
            file: file.to_owned(),
            line,
            column,
            message: problem.message,
            help: problem.help,
            text: text.to_owned(),
            named_by: Box::default(),
        }
    }
}

/// Byte at which the reader's complaint starts: at what it choked on, not at the space before it.
fn reader_offset(error: &ron::error::SpannedError, text: &str) -> usize {
    use ron::error::Error;
    let missing = matches!(error.code, Error::ExpectedComma | Error::Eof);
    let place = if missing { error.span.end } else { error.span.start };
    let offset = locate::offset(text, place.line, place.col);
    let rest = text[offset..].trim_start();
    if rest.is_empty() { offset } else { text.len() - rest.len() }
}

impl From<Problem> for SceneError {
    /// A problem in a scene built in code: there is no file, so the path of the field leads the message.
    fn from(problem: Problem) -> Self {
        let path = problem.trail.to_string();
        let colon = if path.is_empty() { "" } else { ": " };
        Self {
            file: String::new(),
            line: 0,
            column: 0,
            message: format!("{path}{colon}{}", problem.message),
            help: problem.help,
            text: String::new(),
            named_by: Box::default(),
        }
    }
}

/// Something wrong with a value, before it is known where the value stands in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    pub(super) trail: Trail,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

impl Problem {
    pub(super) fn at(trail: Trail, message: impl Into<String>) -> Self {
        Self { trail, message: message.into(), help: None }
    }

    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

/// One step from a value to a value inside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// The field of this name.
    Key(&'static str),
    /// The list element of this index, from 0.
    Index(usize),
}

/// The way from the scene to a value inside it: `stands[0].cells`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trail(pub(super) Vec<Step>);

impl Trail {
    pub(crate) fn key(mut self, name: &'static str) -> Self {
        self.0.push(Step::Key(name));
        self
    }

    pub(crate) fn index(mut self, index: usize) -> Self {
        self.0.push(Step::Index(index));
        self
    }
}

impl fmt::Display for Trail {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, step) in self.0.iter().enumerate() {
            match step {
                Step::Key(name) if position == 0 => f.write_str(name)?,
                Step::Key(name) => write!(f, ".{name}")?,
                Step::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}
