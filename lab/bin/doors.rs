//! `fastslam-lab doors`: who ends at the right one of six identical doors, whole or in shards.

use crate::shard::{self, Shard};
use crate::{print, print_json, progress};
use anyhow::Result;
use fastslam::resampling::ResamplePolicy;
use fastslam_lab::experiment::doors::{DoorsOutcome, DoorsSetup, outcomes};
use fastslam_lab::experiment::{Fraction, ProposalKind};
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Numbers of particles.
const PARTICLES: [usize; 3] = [25, 100, 400];

/// Six identical doors over many seeds: EKF-SLAM against FastSLAM 1.0 and 2.0 with M = 25, 100, 400
///
/// A sweep can be spread: each `--shard I/N --json` prints the runs of its share, and `--merge` makes of all shares the rows of
/// one run.
#[derive(clap::Args)]
pub struct Arguments {
    /// Seeds 1 to N of every row
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    seeds: u64,
    /// Standard deviation of where the ride ends [m], 0 to 20
    #[arg(long, value_name = "M", default_value_t = DoorsSetup::default().ride_std, allow_negative_numbers = true)]
    ride_std: f64,
    /// When to resample: always, never, neff or neff:F, F from 0 to 1
    #[arg(long, default_value_t = DoorsSetup::default().policy)]
    policy: ResamplePolicy,
    /// Run the I-th of N shares, and print its runs: needs --json
    #[arg(long, value_name = "I/N", requires = "json")]
    shard: Option<Shard>,
    /// Read the shares from these files instead of running anything
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["shard", "seeds", "ride_std", "policy"])]
    merge: Vec<PathBuf>,
    /// Print JSON: an array of rows, or the runs of a share
    #[arg(long)]
    json: bool,
}

/// One run.
#[derive(Clone, Serialize, Deserialize)]
struct Run {
    seed: u64,
    proposal: ProposalKind,
    particles: usize,
    #[serde(flatten)]
    outcome: DoorsOutcome,
}

#[derive(Serialize, Deserialize)]
struct Share {
    shard: Shard,
    seeds: u64,
    ride_std: f64,
    policy: String,
    runs: Vec<Run>,
}

impl shard::Share for Share {
    const COMMAND: &'static str = "doors";

    fn shard(&self) -> Shard {
        self.shard
    }

    fn same_sweep(&self, other: &Self) -> bool {
        (self.seeds, self.ride_std, &self.policy) == (other.seeds, other.ride_std, &other.policy)
    }
}

/// What is printed of a filter.
#[derive(Serialize)]
struct Row {
    filter: &'static str,
    /// Of EKF-SLAM there are none.
    particles: Option<usize>,
    seeds: u32,
    right: f64,
    /// Wilson's, of 95 %.
    interval: [f64; 2],
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    if !arguments.merge.is_empty() {
        let shares = shard::merge::<Share>(&arguments.merge)?;
        let (ride_std, runs) =
            (shares[0].ride_std, shares.into_iter().flat_map(|share| share.runs).collect::<Vec<_>>());
        return tell(arguments.json, ride_std, &runs);
    }
    let &Arguments { seeds, ride_std, policy, .. } = arguments;
    let runs = sweep(arguments)?;
    match arguments.shard {
        Some(shard) => print_json(&Share { shard, seeds, ride_std, policy: policy.to_string(), runs }),
        None => tell(arguments.json, ride_std, &runs),
    }
}

fn sweep(arguments: &Arguments) -> Result<Vec<Run>> {
    let &Arguments { ride_std, policy, .. } = arguments;
    let of = |proposal: ProposalKind, particles, seed| DoorsSetup {
        seed,
        proposal,
        particles,
        ride_std,
        policy,
        ..DoorsSetup::default()
    };
    let versions = [ProposalKind::Motion, ProposalKind::Improved];
    let setups = (1..=arguments.seeds).flat_map(|seed| {
        versions.into_iter().flat_map(move |proposal| PARTICLES.map(|particles| of(proposal, particles, seed)))
    });
    let setups = arguments.shard.unwrap_or(Shard::WHOLE).of(setups.collect());
    let bar = progress(setups.len(), "runs");
    let run = |setup: &DoorsSetup| {
        let outcome = outcomes(setup, setup.seed..setup.seed + 1)?[0];
        Ok(Run { seed: setup.seed, proposal: setup.proposal, particles: setup.particles, outcome })
    };
    setups.par_iter().progress_with(bar).map(run).collect()
}

fn rows(runs: &[Run]) -> Vec<Row> {
    let row = |filter, particles, of: &dyn Fn(&Run) -> Option<bool>| {
        let fraction = Fraction::of(runs.iter().filter_map(of));
        let (right, interval) = (fraction.share(), fraction.wilson());
        (fraction.total > 0).then_some(Row { filter, particles, seeds: fraction.total, right, interval })
    };
    // The same log at any number of particles.
    let [few, ..] = PARTICLES;
    let ekf = row("EKF-SLAM", None, &|run| {
        (run.particles == few && run.proposal == ProposalKind::Motion).then_some(run.outcome.ekf_right)
    });
    let versions = [("FastSLAM 1.0", ProposalKind::Motion), ("FastSLAM 2.0", ProposalKind::Improved)];
    let particles = versions.into_iter().flat_map(|(filter, proposal)| {
        PARTICLES.map(|particles| {
            row(filter, Some(particles), &|run| {
                (run.particles == particles && run.proposal == proposal).then_some(run.outcome.fastslam_right)
            })
        })
    });
    ekf.into_iter().chain(particles.flatten()).collect()
}

fn tell(as_json: bool, ride_std: f64, runs: &[Run]) -> Result<()> {
    let rows = rows(runs);
    if as_json {
        return print_json(&rows);
    }
    let pencil = DoorsSetup { ride_std, ..DoorsSetup::default() }.pencil();
    let mut text = format!("filter            M  seeds   right   95 % interval     by the pencil {pencil:.3}\n");
    for Row { filter, particles, seeds, right, interval: [low, high] } in rows {
        let m = particles.map_or("-".to_owned(), |m| m.to_string());
        text += &format!("{filter:12} {m:>6} {seeds:6}   {right:.3}   [{low:.3}, {high:.3}]\n");
    }
    print(&text)
}
