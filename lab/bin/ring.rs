//! `fastslam-lab ring`: what a filter keeps until a loop closes, over many seeds, on the ring or in an apartment's rooms.

use crate::lap::Options;
use crate::{print, print_json, progress};
use anyhow::Result;
use fastslam::error::SettingError;
use fastslam_lab::experiment::lap::Course;
use fastslam_lab::experiment::quantile;
use fastslam_lab::experiment::ring::{AFTER, NoiseProbe, PriceNoise, RingRun, RingSetup, median, price_noise};
use indicatif::ParallelProgressIterator;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;

/// Drive round the ring, or through the rooms, for many seeds: how different the universes are just before the loop closes, and what the closing leaves
#[derive(clap::Args)]
pub struct Arguments {
    /// Seeds 1 to N
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    seeds: u64,
    /// Niches on each side of the block, 0 to 2
    #[arg(long, value_name = "N", default_value_t = RingSetup::default().niches)]
    niches: usize,
    /// Longest range of the laser [m], 0.5 to 20
    #[arg(long, value_name = "METRES", default_value_t = RingSetup::default().max_range, allow_negative_numbers = true)]
    max_range: f64,
    /// Through the rooms of an apartment instead, with a laser that sees 3 m
    #[arg(long, conflicts_with_all = ["niches", "max_range", "price_noise"])]
    rooms: bool,
    #[command(flatten)]
    options: Options,
    /// Measure instead how much of a particle's price is noise: at every 10th step each particle draws its next pose 60 times
    #[arg(long)]
    price_noise: bool,
    /// With --price-noise: at every K-th step
    #[arg(long, value_name = "K", default_value_t = NoiseProbe::default().every, value_parser = clap::value_parser!(u32).range(1..=110))]
    every: u32,
    /// With --price-noise: how many times each particle draws
    #[arg(long, value_name = "N", default_value_t = NoiseProbe::default().draws, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    draws: u32,
    /// With --price-noise: the n-th draw of all particles is from one stream
    #[arg(long, requires = "price_noise")]
    shared_streams: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output<T> {
    particles: usize,
    /// Of the ring.
    #[serde(skip_serializing_if = "Option::is_none")]
    niches: Option<usize>,
    max_range: f64,
    /// Of each measure, over the seeds.
    medians: BTreeMap<&'static str, f64>,
    /// One run a seed.
    runs: Vec<T>,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let &Arguments { niches, max_range, rooms, options: Options { particles, .. }, .. } = arguments;
    let lap = |seed| arguments.options.setup(if rooms { Course::Rooms } else { Course::Ring }, seed);
    let setup = |seed| RingSetup { lap: lap(seed), niches, max_range };
    setup(1).start()?; // refused before anything is run, if it is
    let sides = (!rooms).then_some(niches);
    if arguments.price_noise {
        let &Arguments { every, draws, shared_streams: shared, .. } = arguments;
        let probe = NoiseProbe { every, draws, shared };
        let runs = sweep(arguments.seeds, |seed| price_noise(&setup(seed), probe))?;
        let of = |f: fn(&PriceNoise) -> Option<f64>| median_of(runs.iter().flatten().filter_map(f).collect());
        let medians = NOISES.map(|(name, _, f)| (name, of(f))).into();
        let text = noise_text(arguments, &runs);
        if arguments.json {
            print_json(&Output { particles, niches: sides, max_range, medians, runs })
        } else {
            print(&text)
        }
    } else {
        let runs = sweep(arguments.seeds, |seed| {
            if rooms { RingRun::on(&Course::Rooms.route(), &lap(seed)) } else { RingRun::of(&setup(seed)) }
        })?;
        let of = |k: usize| median(runs.iter().map(|run| run.measures()[k].2).collect());
        let medians = runs[0].measures().iter().enumerate().map(|(k, (name, ..))| (*name, of(k))).collect();
        let text = text(arguments, &runs);
        if arguments.json {
            print_json(&Output { particles, niches: sides, max_range, medians, runs })
        } else {
            print(&text)
        }
    }
}

/// In the order of the seeds, which are spread over the threads.
fn sweep<T: Send>(seeds: u64, run: impl Fn(u64) -> Result<T, SettingError> + Sync + Send) -> Result<Vec<T>> {
    let bar = progress(seeds as usize, "seeds");
    let runs: Result<Vec<T>, _> =
        (1..seeds + 1).collect::<Vec<u64>>().into_par_iter().progress_with(bar).map(run).collect();
    Ok(runs?)
}

fn head(arguments: &Arguments) -> String {
    let Arguments { seeds, niches, max_range, rooms, options: Options { particles, policy, scheme, .. }, .. } =
        arguments;
    let place = if *rooms { "rooms".into() } else { format!("ring of {niches} niches a side, laser {max_range} m") };
    format!("{place}, {seeds} seeds, {particles} particles, {policy} ({scheme})\n")
}

fn text(arguments: &Arguments, runs: &[RingRun]) -> String {
    let mut text = head(arguments);
    text += &format!("closing at step {}; before: one step earlier; after: {AFTER} steps later\n", runs[0].closing);
    text += &format!("{:38} {:>8} {:>8} {:>8}\n", "over the seeds", "p10", "median", "p90");
    for (k, (_, title, _)) in runs[0].measures().into_iter().enumerate() {
        let mut values: Vec<f64> = runs.iter().map(|run| run.measures()[k].2).collect();
        values.sort_unstable_by(f64::total_cmp);
        let [p10, median, p90] = [0.1, 0.5, 0.9].map(|q| quantile(&values, q));
        text += &format!("{title:38} {p10:8.3} {median:8.3} {p90:8.3}\n");
    }
    text
}

/// What is told of a particle's price: key in JSON, head of the column, value.
type Noise = (&'static str, &'static str, fn(&PriceNoise) -> Option<f64>);
const NOISES: [Noise; 5] = [
    ("noise", "of one particle", |noise| Some(noise.noise)),
    ("noise_relative", "above the mean", |noise| Some(noise.noise_relative)),
    ("spread", "between particles", |noise| Some(noise.spread)),
    ("fit_error", "of the fit", |noise| noise.fit_error),
    ("matched", "matched", |noise| Some(noise.matched)),
];

/// Not a number where nothing was measured.
fn median_of(values: Vec<f64>) -> f64 {
    if values.is_empty() { f64::NAN } else { median(values) }
}

fn noise_text(arguments: &Arguments, runs: &[Vec<PriceNoise>]) -> String {
    let mut text = head(arguments);
    text += &format!(
        "ln of the price, {} draws: standard deviations [nats], medians over the seeds\n\
         of one particle: from draw to draw; above the mean: the same less the population's mean of the draw;\n\
         between particles: of the means of their draws; of the fit: over particles, of its integral's error\n",
        arguments.draws
    );
    text += &format!("{:>8}", "step");
    NOISES.iter().for_each(|(_, head, _)| text += &format!("{head:>20}"));
    let mut line = |name: &str, of: &[&PriceNoise]| {
        text += &format!("\n{name:>8}");
        for (.., f) in NOISES {
            text += &format!("{:20.2}", median_of(of.iter().filter_map(|noise| f(noise)).collect()));
        }
    };
    for (k, first) in runs[0].iter().enumerate() {
        line(&first.step.to_string(), &runs.iter().map(|run| &run[k]).collect::<Vec<_>>());
    }
    line("all", &runs.iter().flatten().collect::<Vec<_>>());
    text + "\n"
}
