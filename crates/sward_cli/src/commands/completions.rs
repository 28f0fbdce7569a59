//! `sward completions`: a script for the shell.

use clap::CommandFactory;

use crate::arguments::{self, Arguments};
use crate::console::Console;
use crate::failure::Failure;

/// Prints the script.
pub(crate) fn run(arguments: &arguments::Completions, console: &Console) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "sward", &mut script);
    console.answer(&String::from_utf8_lossy(&script))
}
