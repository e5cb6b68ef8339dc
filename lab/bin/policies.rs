//! `fastslam-lab policies`: when to resample, over many seeds.

use crate::{print, print_json, progress, whole};
use anyhow::Result;
use fastslam::resampling::Scheme;
use fastslam_lab::experiment::Fraction;
use fastslam_lab::experiment::lap;
use fastslam_lab::experiment::resampling::counts::{PolicySummary, outcomes, summary};
use fastslam_lab::experiment::resampling::{PoliciesSetup, PolicyCourse};
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use serde::Serialize;

/// Compare never resampling, resampling every step and resampling by N_eff, on one log and one noise for each seed
#[derive(clap::Args)]
pub struct Arguments {
    /// The course: lap (the apartment), or wings (two that look the same)
    #[arg(long, default_value_t = PolicyCourse::Lap)]
    course: PolicyCourse,
    /// Seeds 1 to N
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    seeds: u64,
    /// Number of particles M of each filter, 1 to 4096
    #[arg(long, value_name = "M", default_value_t = PoliciesSetup::default().particles, value_parser = whole(lap::PARTICLES), allow_negative_numbers = true)]
    particles: usize,
    /// The selective filter resamples where N_eff < F M, F from 0 to 1
    #[arg(long, value_name = "F", default_value_t = PoliciesSetup::default().threshold, allow_negative_numbers = true)]
    threshold: f64,
    /// How to resample: systematic, stratified, multinomial or residual [default: systematic on the lap, multinomial in the wings]
    #[arg(long)]
    scheme: Option<Scheme>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output {
    course: String,
    seeds: u64,
    particles: usize,
    threshold: f64,
    scheme: Scheme,
    policies: [PolicySummary; 3],
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let &Arguments { course, seeds, particles, threshold, .. } = arguments;
    let of_course = PoliciesSetup::of(course);
    let scheme = arguments.scheme.unwrap_or(of_course.scheme);
    let setup = PoliciesSetup { particles, threshold, scheme, ..of_course };
    setup.validate()?; // refused before anything is run, if it is
    let seeds_run: Result<Vec<_>, _> = (1..seeds + 1)
        .collect::<Vec<u64>>()
        .into_par_iter()
        .progress_with(progress(seeds as usize, "seeds"))
        .map(|seed| outcomes(&setup, seed..seed + 1))
        .collect();
    let policies = summary(&seeds_run?.concat(), particles);
    let output = Output { course: course.to_string(), seeds, particles, threshold, scheme, policies };
    if arguments.json { print_json(&output) } else { print(&text(&output)) }
}

fn text(output: &Output) -> String {
    let Output { course, seeds, particles, threshold, scheme, policies } = output;
    let mut text = format!(
        "{course}, {seeds} seeds, {particles} particles, {scheme}, threshold {threshold}\n\
         policy     N_eff     RMS [m]   error over selective   steps that  lineage one   N_eff up  tree nodes      c of\n\
         \x20            end      median     p10  median     p90     resample      at step    to then         end   t + 1 + c M ln M\n",
    );
    for policy in policies {
        let [p10, median, p90] = policy.error_factor;
        text += &format!(
            "{:9}{:7.2}{:12.3}{p10:8.2}{median:8.2}{p90:8.2}{:11.1} %{:>13}{:11.2}{:12.1}{:>10}\n",
            policy.policy,
            policy.final_ess_median,
            policy.rms_median,
            100.0 * policy.resampled_fraction,
            policy.lineage_one_step_median.map_or("never".to_owned(), |step| format!("{step:.0}")),
            policy.ess_meanwhile,
            policy.tree_nodes,
            policy.tree_c.map_or("-".to_owned(), |c| format!("{c:.2}")),
        );
    }
    for (what, of) in [
        ("right wing alive before the sign", (|p| p.alive) as fn(&PolicySummary) -> Option<Fraction>),
        ("best in the right wing at the end", |p| p.settled),
    ] {
        for policy in policies {
            let Some(fraction) = of(policy) else { continue };
            let [low, high] = fraction.wilson();
            text += &format!(
                "{what:34} {:9} {:5} of {} = {:.3}   95 % [{low:.3}, {high:.3}]\n",
                policy.policy,
                fraction.successes,
                fraction.total,
                fraction.share()
            );
        }
    }
    text
}
