//! `fastslam`: recorded drives, mapped.

mod calibration;
mod landmark_graph;
mod landmarks;
mod log;
mod mrclam;
mod offsets;
mod picture;
mod remarks;
mod sense;
mod settings;
mod victoria;

use clap::Parser;
use fastslam_cli::{Threads, Usage, in_file, print, print_json, progress, whole};
use std::process::ExitCode;

/// Rao-Blackwellized particle filters for SLAM: from the log of a robot to its map and its path, with the same bits as in the browser.
#[derive(Parser)]
#[command(name = "fastslam", version, propagate_version = true)]
struct Arguments {
    #[command(flatten)]
    threads: Threads,
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    Log(Box<log::Arguments>),
    ExampleLog(log::ExampleArguments),
    Landmarks(Box<landmarks::Arguments>),
}

fn main() -> ExitCode {
    let run = |Arguments { threads, command }| {
        threads.run(|| match command {
            Command::Log(arguments) => log::run(&arguments),
            Command::ExampleLog(arguments) => log::example(&arguments),
            Command::Landmarks(arguments) => landmarks::run(&arguments),
        })
    };
    fastslam_cli::main(run, |error| match () {
        () if error.is::<log::Stopped>() => Some(130),
        () if error.is::<log::Doubtful>() => Some(3),
        () => None,
    })
}
