//! `fastslam-lab variants`: the mapper of logs in worlds of our own that ask more of it than its example, over some seeds.

use crate::{Usage, print, print_json, progress, whole};
use anyhow::{Result, bail};
use cpu_time::ThreadTime;
use fastslam::mapper::LaserMapperSettings;
use fastslam_lab::experiment::ErrorSummary;
use fastslam_lab::experiment::log::digest;
use fastslam_lab::experiment::variants::{Variant, VariantRun, variants};
use fastslam_log::RelationErrors;
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use serde::Serialize;
use std::time::Duration;

/// Map simulated logs with worse wheels, worse lasers, people and long corridors: errors against the true relations
#[derive(clap::Args)]
pub struct Arguments {
    /// Number of particles M, 1 to 4096
    #[arg(long, value_name = "M", default_value_t = 8, value_parser = whole(LaserMapperSettings::PARTICLES), allow_negative_numbers = true)]
    particles: usize,
    /// Seeds 1 to N, of the world's noises and of the filter's draws
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    seeds: u64,
    /// Only variants whose names begin so
    #[arg(long, value_name = "PREFIX", default_value = "")]
    only: String,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output {
    particles: usize,
    variants: Vec<Row>,
}

/// One variant.
#[derive(Serialize)]
struct Row {
    name: &'static str,
    title: &'static str,
    /// Over the seeds, means over the relations \[m\].
    translation: ErrorSummary,
    /// The same \[deg\].
    rotation_deg: ErrorSummary,
    /// Median over the seeds of the share of steps that resampled.
    resampled_fraction: f64,
    /// Over the seeds, for each scan taken and particle \[ms\].
    cpu_ms: ErrorSummary,
    /// One a seed.
    runs: Vec<Run>,
}

/// One run.
#[derive(Clone, Serialize)]
struct Run {
    seed: u64,
    scans_used: u32,
    #[serde(flatten)]
    errors: RelationErrors,
    resampled_fraction: f64,
    /// Of the thread that ran it, for each scan taken and particle \[ms\].
    cpu_ms: f64,
    /// Of the weights and of every particle's path and map.
    digest: String,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let &Arguments { particles, seeds, .. } = arguments;
    let all = variants();
    let asked: Vec<&Variant> = all.iter().filter(|variant| variant.name.starts_with(&arguments.only)).collect();
    if asked.is_empty() {
        let names: Vec<&str> = all.iter().map(|variant| variant.name).collect();
        bail!(Usage(format!("--only {}: no such variant, there are {}", arguments.only, names.join(", "))));
    }
    // A seed after the other of each variant, in the order of the table; which thread runs which makes no difference.
    let tasks: Vec<(&Variant, u64)> =
        asked.iter().flat_map(|variant| (1..=seeds).map(|seed| (*variant, seed))).collect();
    let bar = progress(tasks.len(), "runs");
    let runs: Result<Vec<Run>> =
        tasks.into_par_iter().progress_with(bar).map(|(variant, seed)| one(variant, particles, seed)).collect();
    let rows = asked.iter().zip(runs?.chunks(seeds as usize)).map(|(variant, runs)| row(variant, runs)).collect();
    let output = Output { particles, variants: rows };
    if arguments.json { print_json(&output) } else { print(&text(arguments, &output)) }
}

fn one(variant: &Variant, particles: usize, seed: u64) -> Result<Run> {
    let mut run = VariantRun::new(variant, particles, seed)?;
    let mut cpu = Duration::ZERO;
    loop {
        let start = ThreadTime::now();
        if !run.step() {
            break;
        }
        cpu += start.elapsed();
    }
    let steps = run.mapper().steps();
    Ok(Run {
        seed,
        scans_used: steps + 1,
        errors: run.errors(),
        resampled_fraction: run.mapper().resampled_fraction(),
        cpu_ms: 1e3 * cpu.as_secs_f64() / f64::from(steps.max(1)) / particles as f64,
        digest: format!("{:016x}", digest(run.mapper()).value()),
    })
}

fn row(variant: &Variant, runs: &[Run]) -> Row {
    let spread = |f: &dyn Fn(&Run) -> f64| ErrorSummary::of(&runs.iter().map(f).collect::<Vec<_>>());
    Row {
        name: variant.name,
        title: variant.title,
        translation: spread(&|run| run.errors.translation_mean),
        rotation_deg: spread(&|run| run.errors.rotation_mean_deg),
        resampled_fraction: spread(&|run| run.resampled_fraction).median,
        cpu_ms: spread(&|run| run.cpu_ms),
        runs: runs.to_vec(),
    }
}

fn text(arguments: &Arguments, output: &Output) -> String {
    let Arguments { particles, seeds, .. } = arguments;
    let mut text = format!(
        "simulated logs, {seeds} seeds, {particles} particles: mean errors against the true relations, over the seeds\n\
         {:14} {:36} {:>15} {:>15} {:>9} {:>15}\n\
         {:51} {:>15} {:>15} {:>9} {:>15}\n",
        "",
        "",
        "translation [m]",
        "rotation [deg]",
        "resampled",
        "CPU [ms]",
        "",
        "median  worst",
        "median  worst",
        "[%]",
        "a scan, particle",
    );
    for Row { name, title, translation, rotation_deg, resampled_fraction, cpu_ms, .. } in &output.variants {
        text += &format!(
            "{name:14} {title:36} {:8.4} {:6.4} {:8.3} {:6.3} {:9.0} {:15.3}\n",
            translation.median,
            translation.worst,
            rotation_deg.median,
            rotation_deg.worst,
            100.0 * resampled_fraction,
            cpu_ms.median,
        );
    }
    text
}
