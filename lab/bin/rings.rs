//! `fastslam-lab rings`: whether the mapper of logs closes simulated loops of 60, 120 and 240 m, over many seeds.

use crate::{print, print_json, progress, whole};
use anyhow::Result;
use fastslam::execute::Executor;
use fastslam::mapper::LaserMapperSettings;
use fastslam::proposal::IncrementalWeight;
use fastslam_lab::experiment::ErrorSummary;
use fastslam_lab::experiment::log::digest;
use fastslam_lab::experiment::long_rings::{LENGTHS, LongRingSetup, LoopErrors};
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use serde::Serialize;

/// Map simulated long loops, once round a corridor with doors and people and on for a quarter, for many seeds: does the loop close?
///
/// Each seed draws its own building, noises and filter. Paths are judged after the best rigid alignment.
#[derive(clap::Args)]
pub struct Arguments {
    /// Once round [m], 40 to 480 [default: 60, 120 and 240, one after the other]
    #[arg(long, value_name = "METRES", value_parser = whole(LongRingSetup::LENGTH), allow_negative_numbers = true)]
    length: Option<usize>,
    /// Number of particles M, 1 to 4096
    #[arg(long, value_name = "M", default_value_t = LongRingSetup::default().particles, value_parser = whole(LaserMapperSettings::PARTICLES), allow_negative_numbers = true)]
    particles: usize,
    /// What a particle pays for a scan: marginal, new-ground-free or old-map-at-draw
    #[arg(long, default_value_t = LongRingSetup::default().weight)]
    weight: IncrementalWeight,
    /// Seeds 1 to N
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    seeds: u64,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output {
    particles: usize,
    rings: Vec<Ring>,
}

/// One length.
#[derive(Serialize)]
struct Ring {
    /// Once round \[m\].
    length: u32,
    /// Of the best particle's path.
    mapped: Spread,
    /// Of raw odometry.
    odometry: Spread,
    /// One a seed.
    runs: Vec<Run>,
}

/// Over the seeds.
#[derive(Serialize)]
struct Spread {
    /// RMS error of position \[m\].
    rms: ErrorSummary,
    /// The same of the first time round \[m\].
    first_lap: ErrorSummary,
    /// Share of the revisits that are off by more than 0.5 m.
    revisits_off: ErrorSummary,
}

impl Spread {
    fn of(errors: &[LoopErrors]) -> Self {
        let spread = |f: fn(&LoopErrors) -> f64| ErrorSummary::of(&errors.iter().map(f).collect::<Vec<_>>());
        Self {
            rms: spread(|errors| errors.rms),
            first_lap: spread(|errors| errors.first_lap),
            revisits_off: spread(|errors| errors.revisits_off),
        }
    }
}

/// One run.
#[derive(Clone, Serialize)]
struct Run {
    seed: u64,
    scans_used: u32,
    mapped: LoopErrors,
    odometry: LoopErrors,
    resampled_fraction: f64,
    /// First scan at which all particles descend from one; null if they never do.
    lineage_one_scan: Option<u32>,
    /// Of the weights and of every particle's path and map.
    digest: String,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let &Arguments { length, particles, weight, seeds, json } = arguments;
    let lengths = length.map_or_else(|| LENGTHS.to_vec(), |length| vec![length as u32]);
    // The longest first, so that no thread is left with one of them at the end; the table is in the order of the lengths.
    let setups: Vec<LongRingSetup> = lengths
        .iter()
        .rev()
        .flat_map(|length| (1..=seeds).map(|seed| LongRingSetup { length: *length, particles, seed, weight }))
        .collect();
    let bar = progress(setups.len(), "runs");
    let runs: Result<Vec<Run>> = setups.par_iter().progress_with(bar).map(one).collect();
    let runs = runs?;
    let rings = lengths.iter().zip(runs.chunks(seeds as usize).rev()).map(|(length, runs)| ring(*length, runs));
    let output = Output { particles, rings: rings.collect() };
    if json { print_json(&output) } else { print(&text(seeds, &output)) }
}

fn one(setup: &LongRingSetup) -> Result<Run> {
    let mut run = setup.start()?.with_executor(Executor::Serial);
    while run.step() {}
    let mapper = run.mapper();
    Ok(Run {
        seed: setup.seed,
        scans_used: mapper.steps() + 1,
        mapped: run.errors(),
        odometry: run.odometry_errors(),
        resampled_fraction: mapper.resampled_fraction(),
        lineage_one_scan: mapper.single_lineage_since(),
        digest: format!("{:016x}", digest(mapper).value()),
    })
}

fn ring(length: u32, runs: &[Run]) -> Ring {
    let errors = |f: fn(&Run) -> LoopErrors| Spread::of(&runs.iter().map(f).collect::<Vec<_>>());
    Ring { length, mapped: errors(|run| run.mapped), odometry: errors(|run| run.odometry), runs: runs.to_vec() }
}

fn text(seeds: u64, output: &Output) -> String {
    let mut text = format!(
        "simulated rings, {seeds} seeds, {} particles: medians and worst over the seeds\n\
         {:>7} {:16} {:>17} {:>21} {:>26}\n\
         {:>7} {:16} {:>17} {:>21} {:>26}\n",
        output.particles,
        "ring",
        "",
        "RMS error [m]",
        "first time round [m]",
        "revisits off by > 0.5 m [%]",
        "",
        "",
        "median   worst",
        "median   worst",
        "median   worst",
    );
    for Ring { length, mapped, odometry, .. } in &output.rings {
        for (name, Spread { rms, first_lap, revisits_off }) in [("mapped", mapped), ("raw odometry", odometry)] {
            text += &format!(
                "{length:5} m {name:16} {:9.3} {:7.3} {:13.3} {:7.3} {:18.1} {:7.1}\n",
                rms.median,
                rms.worst,
                first_lap.median,
                first_lap.worst,
                100.0 * revisits_off.median,
                100.0 * revisits_off.worst,
            );
        }
    }
    text
}
