//! The sward command line: parse, run, report.

#![forbid(unsafe_code)]

mod aov;
mod arguments;
mod artist;
mod backend;
mod cache;
mod checkpoint;
mod clip;
mod commands;
mod console;
mod failure;
mod fingerprint;
mod output;
mod progress;
mod scenes;

use std::process::ExitCode;

use clap::Parser;

use arguments::{Arguments, Command};
use console::Console;
use failure::Failure;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let console = Console { quiet: arguments.quiet };
    match run(&arguments, &console) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

fn run(arguments: &Arguments, console: &Console) -> Result<(), Failure> {
    match &arguments.command {
        None => commands::hello::run(console),
        Some(Command::Render(render)) => commands::render::run(render, console),
        Some(Command::Simulate(simulate)) => commands::simulate::run(simulate, console),
        Some(Command::Bench(bench)) => commands::bench::run(bench, console),
        Some(Command::Compare(compare)) => commands::compare::run(compare, console),
        Some(Command::Show(show)) => commands::show::run(show, console),
        Some(Command::Fit(fit)) => commands::fit::run(fit, console),
        Some(Command::Grow(grow)) => commands::grow::run(grow, console),
        Some(Command::Scenes(scenes)) => commands::scenes::run(scenes, console),
        Some(Command::SceneFormat) => console.answer(&sward::scene::reference()),
        Some(Command::Completions(completions)) => commands::completions::run(completions, console),
    }
}
