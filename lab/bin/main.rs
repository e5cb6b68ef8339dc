//! `fastslam-lab`: the filters of the figures, run natively over many seeds, and the numbers of the chapter.

mod doors;
mod graph;
mod joint;
mod lap;
mod numbers;
mod policies;
mod ring;
mod rings;
mod shard;
mod smoothing;
mod table;
mod variants;

use clap::Parser;
use fastslam_cli::{Threads, Usage, in_file, print, print_json, progress, whole, write_png};
use fastslam_widgets::model::FigureError;
use std::process::ExitCode;

/// The laboratory of the FastSLAM chapter: its laps, tables and numbers, native and with the same bits as in the browser.
#[derive(Parser)]
#[command(name = "fastslam-lab", version, propagate_version = true)]
struct Arguments {
    #[command(flatten)]
    threads: Threads,
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    Doors(doors::Arguments),
    Joint(joint::Arguments),
    Lap(lap::Arguments),
    Numbers(numbers::Arguments),
    Policies(policies::Arguments),
    Ring(ring::Arguments),
    Rings(rings::Arguments),
    Smoothing(smoothing::Arguments),
    Table(table::Arguments),
    Variants(variants::Arguments),
}

fn main() -> ExitCode {
    let run = |Arguments { threads, command }| {
        threads.run(|| match command {
            Command::Doors(arguments) => doors::run(&arguments),
            Command::Joint(arguments) => joint::run(&arguments),
            Command::Lap(arguments) => lap::run(&arguments),
            Command::Numbers(arguments) => numbers::run(&arguments),
            Command::Policies(arguments) => policies::run(&arguments),
            Command::Ring(arguments) => ring::run(&arguments),
            Command::Rings(arguments) => rings::run(&arguments),
            Command::Smoothing(arguments) => smoothing::run(&arguments),
            Command::Table(arguments) => table::run(&arguments),
            Command::Variants(arguments) => variants::run(&arguments),
        })
    };
    fastslam_cli::main(run, |error| error.is::<FigureError>().then_some(2))
}
