//! The command line: the figures' filters, run natively.

mod doors;
mod graph;
mod joint;
mod landmark_graph;
mod landmarks;
mod lap;
mod log;
mod mrclam;
mod numbers;
mod picture;
mod policies;
mod remarks;
mod ring;
mod rings;
mod settings;
mod shard;
mod smoothing;
mod table;
mod variants;
mod victoria;

use anyhow::{Context, Result};
use clap::{CommandFactory, Parser};
use fastslam::error::{Range, SettingError};
use fastslam_widgets::model::FigureError;
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::Path;
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
    Doors(doors::Arguments),
    Joint(joint::Arguments),
    Lap(lap::Arguments),
    Log(Box<log::Arguments>),
    ExampleLog(log::ExampleArguments),
    Landmarks(Box<landmarks::Arguments>),
    Numbers(numbers::Arguments),
    Policies(policies::Arguments),
    Ring(ring::Arguments),
    Rings(rings::Arguments),
    Smoothing(smoothing::Arguments),
    Table(table::Arguments),
    Variants(variants::Arguments),
}

/// What was asked for cannot be done as it was asked: exit status 2, where any other failure is 1.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct Usage(String);

impl Usage {
    /// What is wrong with what a file says.
    fn of_file(path: &Path, what: impl Display) -> Self {
        Self(format!("{}: {what}", path.display()))
    }
}

fn main() -> ExitCode {
    let result = match Arguments::try_parse() {
        Err(message) if message.use_stderr() => Err(Usage(one_line(&message)).into()),
        Err(message) => message.exit(), // what was asked for: help or version
        Ok(arguments) => run(arguments),
    };
    let Err(error) = result else { return ExitCode::SUCCESS };
    eprintln!("fastslam: {error:#}");
    let usage = error.is::<Usage>() || error.is::<SettingError>() || error.is::<FigureError>();
    ExitCode::from(match () {
        () if error.is::<log::Stopped>() => 130,
        () if error.is::<log::Doubtful>() => 3,
        () if usage => 2,
        () => 1,
    })
}

fn run(arguments: Arguments) -> Result<()> {
    let threads = arguments.threads.map_or(0, usize::from); // 0: as many as there are processors
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    pool.install(|| match arguments.command {
        Command::Doors(arguments) => doors::run(&arguments),
        Command::Joint(arguments) => joint::run(&arguments),
        Command::Lap(arguments) => lap::run(&arguments),
        Command::Log(arguments) => log::run(&arguments),
        Command::ExampleLog(arguments) => log::example(&arguments),
        Command::Landmarks(arguments) => landmarks::run(&arguments),
        Command::Numbers(arguments) => numbers::run(&arguments),
        Command::Policies(arguments) => policies::run(&arguments),
        Command::Ring(arguments) => ring::run(&arguments),
        Command::Rings(arguments) => rings::run(&arguments),
        Command::Smoothing(arguments) => smoothing::run(&arguments),
        Command::Table(arguments) => table::run(&arguments),
        Command::Variants(arguments) => variants::run(&arguments),
    })
}

/// What clap says before it advises, in one line.
fn one_line(message: &clap::Error) -> String {
    if message.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        let command = Arguments::command();
        let names = command.get_subcommands().map(clap::Command::get_name).collect::<Vec<_>>().join(", ");
        let (others, last) = names.rsplit_once(", ").unwrap_or_default();
        return format!("a command is missing: {others} or {last} (fastslam --help explains)");
    }
    let text = message.to_string();
    let said =
        text.lines().take_while(|line| !line.trim_start().starts_with("Usage:") && !line.starts_with("For more"));
    let words: Vec<&str> = said.flat_map(str::split_whitespace).collect();
    words.join(" ").trim_start_matches("error: ").replace(" tip: ", "; ")
}

/// A flag's whole number in a range, which the refusal of any other names.
fn whole(range: Range) -> impl Fn(&str) -> Result<usize, String> + Clone + Send + Sync + 'static {
    move |text| match text.parse::<f64>() {
        Ok(number) if range.contains(number) => Ok(number as usize),
        _ => Err(format!("must be {range}")),
    }
}

/// A bar for so many of these, on a terminal; nothing elsewhere.
fn progress(count: usize, what: &str) -> indicatif::ProgressBar {
    let template = format!("{{wide_bar}} {{pos}}/{{len}} {what}, {{elapsed}} gone, {{eta}} to go");
    let style = indicatif::ProgressStyle::with_template(&template).expect("the template is right");
    indicatif::ProgressBar::new(count as u64).with_style(style)
}

/// What failed with a file: its name, for [`Context`].
fn in_file(path: &Path) -> impl FnOnce() -> String {
    || path.display().to_string()
}

/// Prints to standard output; a reader that has gone away is no error.
fn print(text: &str) -> Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error).context("standard output"),
        _ => Ok(()),
    }
}

/// One JSON value to standard output.
fn print_json(value: &impl serde::Serialize) -> Result<()> {
    print(&(serde_json::to_string(value)? + "\n"))
}
