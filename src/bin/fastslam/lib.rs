//! What the two command lines share: `fastslam`, for those who have a robot, and the laboratory's.

use anyhow::{Context, Result};
use clap::Parser;
use fastslam::error::{Range, SettingError};
pub use png::ColorType;
use std::fmt::Display;
use std::fs::File;
use std::io::{BufWriter, ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;

/// What was asked for cannot be done as it was asked: exit status 2, where any other failure is 1.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);

impl Usage {
    /// What is wrong with what a file says.
    pub fn of_file(path: &Path, what: impl Display) -> Self {
        Self(format!("{}: {what}", path.display()))
    }
}

/// How many threads compute.
#[derive(clap::Args)]
pub struct Threads {
    /// Threads to compute with; the results are the same for any number [default: all processors]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl Threads {
    /// Computes this with so many threads.
    ///
    /// # Errors
    /// Where there can be no such threads, and those of the computation.
    pub fn run(&self, compute: impl FnOnce() -> Result<()> + Send) -> Result<()> {
        let threads = self.threads.map_or(0, usize::from); // 0: as many as there are processors
        rayon::ThreadPoolBuilder::new().num_threads(threads).build()?.install(compute)
    }
}

/// A command line: parses the arguments, runs, and says what failed on one line. `status` is the exit status of failures that have one of their own.
pub fn main<A: Parser>(
    run: impl FnOnce(A) -> Result<()>,
    status: impl FnOnce(&anyhow::Error) -> Option<u8>,
) -> ExitCode {
    let result = match A::try_parse() {
        Err(message) if message.use_stderr() => Err(Usage(one_line(&A::command(), &message)).into()),
        Err(message) => message.exit(), // what was asked for: help or version
        Ok(arguments) => run(arguments),
    };
    let Err(error) = result else { return ExitCode::SUCCESS };
    eprintln!("{}: {error:#}", A::command().get_name());
    let usage = error.is::<Usage>() || error.is::<SettingError>();
    let usual = if usage { 2 } else { 1 };
    ExitCode::from(status(&error).unwrap_or(usual))
}

/// What clap says before it advises, in one line.
fn one_line(command: &clap::Command, message: &clap::Error) -> String {
    if message.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        let names = command.get_subcommands().map(clap::Command::get_name).collect::<Vec<_>>().join(", ");
        let (others, last) = names.rsplit_once(", ").unwrap_or_default();
        return format!("a command is missing: {others} or {last} ({} --help explains)", command.get_name());
    }
    let text = message.to_string();
    let said =
        text.lines().take_while(|line| !line.trim_start().starts_with("Usage:") && !line.starts_with("For more"));
    let words: Vec<&str> = said.flat_map(str::split_whitespace).collect();
    words.join(" ").trim_start_matches("error: ").replace(" tip: ", "; ")
}

/// A flag's whole number in a range, which the refusal of any other names.
pub fn whole(range: Range) -> impl Fn(&str) -> Result<usize, String> + Clone + Send + Sync + 'static {
    move |text| match text.parse::<f64>() {
        Ok(number) if range.contains(number) => Ok(number as usize),
        _ => Err(format!("must be {range}")),
    }
}

/// A bar for so many of these, on a terminal; nothing elsewhere.
pub fn progress(count: usize, what: &str) -> indicatif::ProgressBar {
    let template = format!("{{wide_bar}} {{pos}}/{{len}} {what}, {{elapsed}} gone, {{eta}} to go");
    let style = indicatif::ProgressStyle::with_template(&template).expect("the template is right");
    indicatif::ProgressBar::new(count as u64).with_style(style)
}

/// What failed with a file: its name, for [`Context`].
pub fn in_file(path: &Path) -> impl FnOnce() -> String {
    || path.display().to_string()
}

/// Prints to standard output; a reader that has gone away is no error.
///
/// # Errors
/// Where it cannot be written to.
pub fn print(text: &str) -> Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error).context("standard output"),
        _ => Ok(()),
    }
}

/// One JSON value to standard output.
///
/// # Errors
/// As those of [`print()`].
pub fn print_json(value: &impl serde::Serialize) -> Result<()> {
    print(&(serde_json::to_string(value)? + "\n"))
}

/// Writes a picture of this width and height, whose pixels are given row by row from the top, a byte a colour.
///
/// # Errors
/// Where the file cannot be written.
pub fn write_png(
    path: &Path,
    [width, height]: [u32; 2],
    colours: ColorType,
    pixels: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<()> {
    let write = || -> std::io::Result<()> {
        let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), width, height);
        encoder.set_color(colours);
        let mut encoder = encoder.write_header()?;
        let mut rows = encoder.stream_writer()?;
        pixels(&mut rows)?;
        Ok(rows.finish()?)
    };
    write().with_context(in_file(path))
}
