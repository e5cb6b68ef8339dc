//! The command line: the figures' filters, run natively.

mod landmarks;
mod lap;
mod log;
mod mrclam;
mod numbers;
mod picture;
mod policies;
mod ring;
mod table;
mod variants;

use clap::Parser;
use fastslam::error::SettingError;
use fastslam_widgets::model::FigureError;
use std::process::ExitCode;

/// Rao-Blackwellized particle filters for SLAM: the chapter's laps and tables, native and with the same bits as in the browser.
#[derive(Parser)]
#[command(name = "fastslam", version, propagate_version = true)]
struct Arguments {
    /// Threads to compute with; the results are the same for any number [default: all processors]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    Lap(lap::Arguments),
    Log(log::Arguments),
    ExampleLog(log::ExampleArguments),
    Landmarks(landmarks::Arguments),
    Numbers(numbers::Arguments),
    Policies(policies::Arguments),
    Ring(ring::Arguments),
    Table(table::Arguments),
    Variants(variants::Arguments),
}

/// Why a command ended early, in one line.
enum Failure {
    /// The arguments cannot be used: exit status 2.
    Usage(String),
    /// They can, but something else failed: exit status 1.
    Run(String),
}

impl Failure {
    /// What the system said of a file.
    fn file(path: &std::path::Path, error: impl std::fmt::Display) -> Self {
        Self::Run(format!("{}: {error}", path.display()))
    }

    /// What is wrong with what a file says.
    fn usage_of(path: &std::path::Path, what: impl std::fmt::Display) -> Self {
        Self::Usage(format!("{}: {what}", path.display()))
    }
}

impl From<SettingError> for Failure {
    fn from(error: SettingError) -> Self {
        Self::Usage(error.to_string())
    }
}

impl From<FigureError> for Failure {
    fn from(error: FigureError) -> Self {
        Self::Usage(error.to_string())
    }
}

fn main() -> ExitCode {
    let failure = match Arguments::try_parse() {
        Err(message) if message.use_stderr() => Failure::Usage(one_line(&message)),
        Err(message) => message.exit(), // what was asked for: help or version
        Ok(arguments) => match run(arguments) {
            Ok(()) => return ExitCode::SUCCESS,
            Err(failure) => failure,
        },
    };
    let (message, status) = match failure {
        Failure::Usage(message) => (message, 2),
        Failure::Run(message) => (message, 1),
    };
    eprintln!("fastslam: {message}");
    ExitCode::from(status)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    let threads = arguments.threads.map_or(0, usize::from); // 0: as many as there are processors
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| Failure::Run(e.to_string()))?;
    pool.install(|| match arguments.command {
        Command::Lap(arguments) => lap::run(&arguments),
        Command::Log(arguments) => log::run(&arguments),
        Command::ExampleLog(arguments) => log::example(&arguments),
        Command::Landmarks(arguments) => landmarks::run(&arguments),
        Command::Numbers(arguments) => numbers::run(&arguments),
        Command::Policies(arguments) => policies::run(&arguments),
        Command::Ring(arguments) => ring::run(&arguments),
        Command::Table(arguments) => table::run(&arguments),
        Command::Variants(arguments) => variants::run(&arguments),
    })
}

/// What clap says before it advises, in one line.
fn one_line(message: &clap::Error) -> String {
    if message.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return "a command is missing: lap, log, example-log, landmarks, numbers, policies, ring, table or variants (fastslam --help explains)"
            .to_owned();
    }
    let text = message.to_string();
    let said =
        text.lines().take_while(|line| !line.trim_start().starts_with("Usage:") && !line.starts_with("For more"));
    let words: Vec<&str> = said.flat_map(str::split_whitespace).collect();
    words.join(" ").trim_start_matches("error: ").to_owned()
}

/// A bar for so many of these, on a terminal; nothing elsewhere.
fn progress(count: usize, what: &str) -> indicatif::ProgressBar {
    let template = format!("{{wide_bar}} {{pos}}/{{len}} {what}, {{elapsed}} gone, {{eta}} to go");
    let style = indicatif::ProgressStyle::with_template(&template).expect("the template is right");
    indicatif::ProgressBar::new(count as u64).with_style(style)
}

/// Prints to standard output; a reader that has gone away is no error.
fn print(text: &str) -> Result<(), Failure> {
    use std::io::{ErrorKind, Write};
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Run(format!("standard output: {error}"))),
        _ => Ok(()),
    }
}

/// One JSON value to standard output.
fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(value).map_err(|error| Failure::Run(error.to_string()))?;
    print(&format!("{text}\n"))
}
