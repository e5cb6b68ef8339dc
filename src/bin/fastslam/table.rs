//! `fastslam table`: errors over many seeds, whole or in shards.

use crate::{in_file, print, print_json, progress};
use anyhow::{Context, Result, ensure};
use fastslam::matching::Matcher;
use fastslam_lab::experiment::ProposalKind;
use fastslam_lab::experiment::lap::{Course, LapSetup};
use fastslam_lab::experiment::table::{LapResult, PARTICLES, Row, rows};
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

/// The `index`-th of `count` shares, counted from 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
struct Shard {
    index: usize,
    count: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
        match parts {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err("must be I/N with I from 1 to N".to_owned()),
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

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let laps = if arguments.merge.is_empty() { sweep(arguments)? } else { merge(&arguments.merge)? };
    match arguments.shard {
        Some(shard) => print_json(&Share { shard, seeds: arguments.seeds, course: arguments.course, laps }),
        None if arguments.json => print_json(&rows(&laps)),
        None => print(&text(&rows(&laps))),
    }
}

fn sweep(arguments: &Arguments) -> Result<Vec<LapResult>> {
    let Shard { index, count } = arguments.shard.unwrap_or(Shard { index: 1, count: 1 });
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
    let setups: Vec<LapSetup> = setups.into_iter().skip(index - 1).step_by(count).collect();
    let bar = progress(setups.len(), "laps");
    let laps: Result<Vec<_>, _> = setups.par_iter().progress_with(bar).map(LapResult::of).collect();
    Ok(laps?)
}

fn merge(files: &[PathBuf]) -> Result<Vec<LapResult>> {
    let mut shares: Vec<Share> = Vec::new();
    for path in files {
        let text = std::fs::read_to_string(path).with_context(in_file(path))?;
        let file = path.display();
        let share: Share = serde_json::from_str(&text)
            .with_context(|| format!("{file}: not the output of table --shard I/N --json"))?;
        let Shard { index, count } = share.shard;
        if let Some(first) = shares.first() {
            let same = (first.seeds, first.course, first.shard.count) == (share.seeds, share.course, count);
            ensure!(same, "{file}: a share of another sweep than the first file");
        }
        let twice = shares.iter().any(|other| other.shard == share.shard);
        ensure!(!twice, "{file}: share {index}/{count} is there twice");
        shares.push(share);
    }
    let count = shares[0].shard.count;
    let missing: Vec<String> = (1..=count)
        .filter(|index| shares.iter().all(|share| share.shard.index != *index))
        .map(|index| format!("{index}/{count}"))
        .collect();
    ensure!(missing.is_empty(), "--merge: shares missing: {}", missing.join(", "));
    Ok(shares.into_iter().flat_map(|share| share.laps).collect())
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
