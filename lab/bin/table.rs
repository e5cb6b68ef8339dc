//! `fastslam-lab table`: errors over many seeds, whole or in shards.

use crate::graph::Method;
use crate::shard::{self, Shard};
use crate::{Usage, print, print_json, progress};
use anyhow::{Result, bail};
use fastslam::matching::Matcher;
use fastslam_lab::baseline::pose_graph::Repair;
use fastslam_lab::experiment::graph::GraphRun;
use fastslam_lab::experiment::lap::{Course, LapSetup};
use fastslam_lab::experiment::table::{LapResult, PARTICLES, Row, rows};
use fastslam_lab::experiment::{ErrorSummary, ProposalKind, quantile};
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::str::FromStr;

/// Errors of the lap over many seeds, for both proposals and M = 4, 8, 16, 24, 40
///
/// A sweep can be spread: each `--shard I/N --json` prints the laps of its share, and `--merge` makes of all shares the rows of
/// one run.
#[derive(clap::Args)]
pub struct Arguments {
    /// Seeds 1 to N of every row
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    seeds: u64,
    /// Where: apartment or ring
    #[arg(long, default_value_t = LapSetup::default().course)]
    course: Course,
    /// What the end point of a beam is compared with: cell, subcell or both
    #[arg(long, default_value = "subcell")]
    matcher: Matchers,
    /// What makes a path of each log: the particle filter in all its rows, or a pose graph in one row for each score
    #[arg(long, value_enum, default_value_t = Method::Particles)]
    method: Method,
    /// Run the I-th of N shares, and print its laps: needs --json
    #[arg(long, value_name = "I/N", requires = "json")]
    shard: Option<Shard>,
    /// Read the shares from these files instead of running anything
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["shard", "seeds", "course", "matcher"])]
    merge: Vec<PathBuf>,
    /// Print JSON: an array of rows, or the laps of a share
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Debug)]
struct Matchers(Vec<Matcher>);

impl FromStr for Matchers {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "both" => Ok(Self(vec![Matcher::Cell, Matcher::SubCell])),
            _ => {
                text.parse().map(|matcher| Self(vec![matcher])).map_err(|_| "must be cell, subcell or both".to_owned())
            }
        }
    }
}

/// What a share prints, and `--merge` reads.
#[derive(Serialize, Deserialize)]
struct Share {
    shard: Shard,
    seeds: u64,
    course: Course,
    laps: Vec<LapResult>,
}

impl shard::Share for Share {
    const COMMAND: &'static str = "table";

    fn shard(&self) -> Shard {
        self.shard
    }

    fn same_sweep(&self, other: &Self) -> bool {
        (self.seeds, self.course) == (other.seeds, other.course)
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    if arguments.method == Method::Graph {
        return graphs(arguments);
    }
    let laps = if arguments.merge.is_empty() { sweep(arguments)? } else { merge(&arguments.merge)? };
    match arguments.shard {
        Some(shard) => print_json(&Share { shard, seeds: arguments.seeds, course: arguments.course, laps }),
        None if arguments.json => print_json(&rows(&laps)),
        None => print(&text(&rows(&laps))),
    }
}

fn sweep(arguments: &Arguments) -> Result<Vec<LapResult>> {
    let mut setups = Vec::new();
    for seed in 1..=arguments.seeds {
        for &matcher in &arguments.matcher.0 {
            for proposal in [ProposalKind::Improved, ProposalKind::Motion] {
                let setup = |particles| LapSetup {
                    course: arguments.course,
                    particles,
                    seed,
                    proposal,
                    matcher,
                    ..LapSetup::default()
                };
                setups.extend(PARTICLES.map(setup));
            }
        }
    }
    let setups = arguments.shard.unwrap_or(Shard::WHOLE).of(setups);
    let bar = progress(setups.len(), "laps");
    let laps: Result<Vec<_>, _> = setups.par_iter().progress_with(bar).map(LapResult::of).collect();
    Ok(laps?)
}

/// What the pose graphs of many logs come to.
#[derive(Serialize)]
struct GraphRow {
    matcher: Matcher,
    seeds: usize,
    /// Median of the RMS error of position at the optimum \[m\].
    rms_median: f64,
    /// 95 % confidence interval of the median \[m\].
    rms_median_interval: [f64; 2],
    /// Its 90th percentile \[m\].
    rms_p90: f64,
    /// Its worst \[m\].
    rms_worst: f64,
    /// Median after the best rigid alignment \[m\].
    rms_aligned_median: f64,
    /// Median before any loop is closed \[m\].
    rms_before_median: f64,
    /// Median of the RMS error of raw odometry \[m\].
    odometry_rms_median: f64,
}

impl GraphRow {
    fn of(matcher: Matcher, runs: &[GraphRun]) -> Self {
        let all = |f: fn(&GraphRun) -> f64| {
            let mut values: Vec<f64> = runs.iter().map(f).collect();
            values.sort_unstable_by(f64::total_cmp);
            values
        };
        let ErrorSummary { median, median_interval, p90, worst } = ErrorSummary::of(&all(|run| run.rms_after));
        Self {
            matcher,
            seeds: runs.len(),
            rms_median: median,
            rms_median_interval: median_interval,
            rms_p90: p90,
            rms_worst: worst,
            rms_aligned_median: quantile(&all(|run| run.rms_after_aligned), 0.5),
            rms_before_median: quantile(&all(|run| run.rms_before), 0.5),
            odometry_rms_median: quantile(&all(|run| run.rms_odometry), 0.5),
        }
    }
}

/// `--method graph`.
fn graphs(arguments: &Arguments) -> Result<()> {
    if arguments.shard.is_some() || !arguments.merge.is_empty() {
        bail!(Usage("--shard and --merge are of particles: not with --method graph".into()));
    }
    let bar = progress(arguments.matcher.0.len() * arguments.seeds as usize, "laps");
    let row = |matcher: &Matcher| {
        let setup = |seed| LapSetup { course: arguments.course, seed, matcher: *matcher, ..LapSetup::default() };
        let runs: Result<Vec<GraphRun>, _> = (1..=arguments.seeds)
            .into_par_iter()
            .progress_with(bar.clone())
            .map(|seed| GraphRun::of(&setup(seed), Repair::LeastSquares))
            .collect();
        Ok(GraphRow::of(*matcher, &runs?))
    };
    let rows: Vec<GraphRow> = arguments.matcher.0.iter().map(row).collect::<Result<_>>()?;
    bar.finish_and_clear();
    if arguments.json {
        return print_json(&rows);
    }
    let mut text = String::from(
        "pose graph  seeds   RMS position error [m]                          aligned  unclosed  odometry\n\
         \x20                    median           95 %     p90   worst       median    median    median\n",
    );
    for row in rows {
        let GraphRow { matcher, seeds, rms_median, rms_median_interval: [low, high], rms_p90, rms_worst, .. } = row;
        text += &format!(
            "{:10} {seeds:6}   {rms_median:6.3}  {low:5.3}–{high:5.3}  {rms_p90:6.3}  {rms_worst:6.3}       {:6.3}    {:6.3}    {:6.2}\n",
            matcher.to_string(),
            row.rms_aligned_median,
            row.rms_before_median,
            row.odometry_rms_median,
        );
    }
    print(&text)
}

fn merge(files: &[PathBuf]) -> Result<Vec<LapResult>> {
    Ok(shard::merge::<Share>(files)?.into_iter().flat_map(|share| share.laps).collect())
}

fn text(rows: &[Row]) -> String {
    let mut text = String::from(
        "proposal matcher   M  seeds   RMS position error [m]                          aligned  odometry  resampled  lineage one  N_eff\n\
         \x20                            median           95 %     p90   worst       median    median   fraction      at step    end\n",
    );
    for row in rows {
        let lineage = row.lineage_one_step_median.map_or("never".to_owned(), |step| format!("{step:.0}"));
        let Row { particles, seeds, rms_median, rms_median_interval: [low, high], rms_p90, rms_worst, .. } = row;
        text += &format!(
            "{:8} {:8}{particles:3} {seeds:6}   {rms_median:6.3}  {low:5.3}–{high:5.3}  {rms_p90:6.3}  {rms_worst:6.3}       {:6.3}    {:6.2}     {:6.2}  {lineage:>11} {:6.1}\n",
            row.proposal.to_string(),
            row.matcher.to_string(),
            row.rms_aligned_median,
            row.odometry_rms_median,
            row.resampled_fraction,
            row.final_ess_median,
        );
    }
    text
}
