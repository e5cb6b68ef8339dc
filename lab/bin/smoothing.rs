//! `fastslam-lab smoothing`: what a filter's record says of the past, and what sweeps of a smoother make of it.

use crate::{print, print_json};
use anyhow::Result;
use fastslam_lab::experiment::smoothing::{MOST, Smoothing, SmoothingSetup};
use serde::Serialize;

/// The filter's record of a drive among landmarks against paths that a smoother draws: different poses and errors, step by step
///
/// The filter and the sweeps are those of the figure, whose numbers these are.
#[derive(clap::Args)]
pub struct Arguments {
    /// Number of particles of the filter and of each sweep, 2 to 64
    #[arg(long, value_name = "M", default_value_t = SmoothingSetup::default().particles)]
    particles: u32,
    /// Factor on the noise of the wheels, 0.25 to 3
    #[arg(long, value_name = "F", default_value_t = SmoothingSetup::default().odometry_scale, allow_negative_numbers = true)]
    odometry: f64,
    /// Factor on the standard deviations of the sensor, 0.25 to 2
    #[arg(long, value_name = "F", default_value_t = SmoothingSetup::default().sensor_scale, allow_negative_numbers = true)]
    sensor: f64,
    /// Leave the path the ancestors that it has: particle Gibbs without ancestor sampling
    #[arg(long)]
    keep: bool,
    /// Number of sweeps, 1 to 24
    #[arg(long, value_name = "N", default_value_t = MOST, value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST)))]
    sweeps: u32,
    /// Seed of the world's noise and of all draws
    #[arg(long, default_value_t = SmoothingSetup::default().seed)]
    seed: u64,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output {
    /// The last step at which all particles have one ancestor.
    coalescence: u32,
    /// RMS error of the mean over the first half of the drive \[m\].
    early_rms_m: Pair<f64>,
    /// Updates of a map in a sweep, for each in a run of the filter.
    cost: f64,
    steps: Vec<Row>,
}

/// The filter's record, and the paths that the sweeps have drawn.
#[derive(Serialize)]
struct Pair<T> {
    record: T,
    sweeps: T,
}

/// What is printed of a step of the drive.
#[derive(Serialize)]
struct Row {
    step: usize,
    /// Different poses.
    distinct: Pair<u32>,
    /// Distance of their mean from the truth \[m\].
    error_m: Pair<f64>,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let &Arguments { particles, odometry, sensor, keep, sweeps, seed, json } = arguments;
    let setup = SmoothingSetup { particles, odometry_scale: odometry, sensor_scale: sensor, reconnect: !keep, seed };
    let mut smoothing = Smoothing::new(&setup)?;
    smoothing.finish(sweeps);
    let Some(record) = smoothing.record() else { anyhow::bail!("the drive has no end") };
    let (distinct, moments) = (smoothing.distinct(sweeps as usize), smoothing.moments(sweeps as usize));
    let errors = [&record.moments, &moments].map(|moments| smoothing.errors(moments));
    let [before, after] = errors.each_ref().map(|errors| smoothing.early_rms(errors));
    let row = |step: usize| Row {
        step,
        distinct: Pair { record: record.distinct[step], sweeps: distinct[step] },
        error_m: Pair { record: errors[0][step], sweeps: errors[1][step] },
    };
    let output = Output {
        coalescence: record.coalescence,
        early_rms_m: Pair { record: before, sweeps: after },
        cost: smoothing.cost(),
        steps: (1..distinct.len()).map(row).collect(),
    };
    if json { print_json(&output) } else { print(&summary(&output, sweeps)) }
}

fn summary(output: &Output, sweeps: u32) -> String {
    let Output { coalescence, early_rms_m: Pair { record, sweeps: drawn }, cost, steps } = output;
    let mut text = format!(
        "one ancestor of all until step     {coalescence:8}\n\
         RMS error of the first half: record {record:7.3} m\n\
         the same of {sweeps:2} sweeps             {drawn:7.3} m\n\
         updates of a map in a sweep       {cost:9.1} × those of the filter\n\n\
         \x20      different poses    error of the mean [m]\n\
         step   record   sweeps        record    sweeps\n"
    );
    for Row { step, distinct, error_m } in steps {
        text += &format!(
            "{step:4}   {:6}   {:6}      {:8.3}  {:8.3}\n",
            distinct.record, distinct.sweeps, error_m.record, error_m.sweeps
        );
    }
    text
}
