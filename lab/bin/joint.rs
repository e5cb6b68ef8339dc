//! `fastslam-lab joint`: what particles are worth, landmark by landmark, when the map is drawn along with the path, and when it is computed.

use crate::{print, print_json};
use anyhow::Result;
use fastslam_lab::experiment::joint::{COMPUTED, Joint, JointSetup, MOST, SAMPLED};
use serde::Serialize;

/// The sampled map against the computed one: N_eff of both after each landmark, measured and by the closed form
///
/// The first run of both filters on the log, as in the figure; the spread is that of the first landmark's estimate over all repeats.
#[derive(clap::Args)]
pub struct Arguments {
    /// Number of particles of each filter, 1 to 20000
    #[arg(long, value_name = "M", default_value_t = JointSetup::default().particles)]
    particles: u32,
    /// Factor on the standard deviations of the sensor, 0.1 to 10
    #[arg(long, value_name = "F", default_value_t = JointSetup::default().sensor_scale, allow_negative_numbers = true)]
    sensor: f64,
    /// Factor on the standard deviations of the wheels, 0 to 3: at 0 the path is known
    #[arg(long, value_name = "F", default_value_t = JointSetup::default().odometry_scale, allow_negative_numbers = true)]
    odometry: f64,
    /// Seed of both filters
    #[arg(long, default_value_t = JointSetup::default().seed)]
    seed: u64,
    /// Print JSON: an array with one object for each number of landmarks
    #[arg(long)]
    json: bool,
}

/// What is printed of a number of landmarks.
#[derive(Serialize)]
struct Row {
    landmarks: u32,
    sampled: Found,
    computed: Found,
    /// Share of the variance that computing the map has removed.
    removed: f64,
}

/// What a filter has come to: N_eff measured and by the closed form, and the spread of its estimate \[m\].
#[derive(Serialize)]
struct Found {
    ess: f64,
    predicted: f64,
    spread_m: f64,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let &Arguments { particles, sensor, odometry, seed, json } = arguments;
    let mut joint = Joint::new(&JointSetup { particles, sensor_scale: sensor, odometry_scale: odometry, seed })?;
    joint.finish()?;
    let found = |filter, landmarks| Found {
        ess: joint.population(filter, landmarks).map_or(f64::NAN, |found| found.ess),
        predicted: f64::from(particles) * joint.log().predicted_share(filter, landmarks),
        spread_m: joint.variance(filter, landmarks).sqrt(),
    };
    let row = |landmarks| Row {
        landmarks,
        sampled: found(SAMPLED, landmarks),
        computed: found(COMPUTED, landmarks),
        removed: joint.removed(landmarks),
    };
    let rows: Vec<Row> = (1..=MOST).map(row).collect();
    if json {
        return print_json(&rows);
    }
    let mut text = format!("rho {:.4}, {} repeats\n", joint.log().rho(), joint.repeats().len());
    text += "        sampled map                      computed map\n";
    text += " N      N_eff  predicted  spread [m]     N_eff  predicted  spread [m]   variance removed\n";
    for Row { landmarks, sampled, computed, removed } in rows {
        let of = |Found { ess, predicted, spread_m }: Found| {
            let predicted = if predicted < 0.1 { format!("{predicted:.1e}") } else { format!("{predicted:.1}") };
            format!("{ess:9.1}  {predicted:>9}  {spread_m:10.4}")
        };
        text += &format!("{landmarks:2}  {} {}   {:.2} %\n", of(sampled), of(computed), 100.0 * removed);
    }
    print(&text)
}
