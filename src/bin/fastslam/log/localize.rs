//! A robot found in a map that stays as it is.

use super::outputs::Outputs;
use super::progress::Progress;
use super::{Arguments, Doubtful, Stopped, stopped_by_signal};
use crate::{print, print_json};
use anyhow::{Context, Result, bail};
use fastslam::error::{Range, SettingError};
use fastslam::geometry::{Gaussian3, Pose2};
use fastslam::mapper::{Localizer, Pushed};
use fastslam_log::LaserLog;
use nalgebra::Matrix3;
use serde::Serialize;
use std::str::FromStr;
use std::sync::atomic::Ordering;

/// How far the robot may be from where it is said to begin, in standard deviations \[m, m, rad\]: three are searched.
const START_STDS: [f64; 3] = [0.5, 0.5, 0.25];

/// Less of what was seen on walls of the map: the robot is lost, or in another building.
const LEAST_MATCHED: f64 = 0.5;

/// A pose as it is typed: x, y \[m\] and heading \[deg\].
#[derive(Clone, Copy, Debug)]
pub struct Start(Pose2);

impl FromStr for Start {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const PLACE: Range = Range::number(-1e7, 1e7, "");
        let numbers: Option<Vec<f64>> =
            text.split(',').map(|word| word.trim().parse().ok().filter(|number| PLACE.contains(*number))).collect();
        let three = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
        three
            .map(|[x, y, heading]| Self(Pose2::new(x, y, heading.to_radians())))
            .ok_or_else(|| "must be three numbers apart by commas: x, y [m] and heading [deg]".into())
    }
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output {
    /// In the log.
    scans: usize,
    /// Of these, how many were looked at.
    scans_used: u32,
    elapsed_s: f64,
    scans_per_s: f64,
    /// Share of what was seen that lies on walls of the map.
    matched_fraction: f64,
    /// At the last scan.
    x: f64,
    y: f64,
    heading_deg: f64,
    /// Covariance of the error of x, y and heading, row by row \[m, m, rad\].
    covariance: [[f64; 3]; 3],
}

/// Finds the robot of a log in the map of a localizer that begins about where the robot is, by default here.
pub fn run(
    arguments: &Arguments,
    name: &str,
    log: &LaserLog,
    here: Pose2,
    begin: impl Fn(Gaussian3) -> Result<Localizer, SettingError>,
) -> Result<()> {
    let stopped = stopped_by_signal()?;
    let outputs = Outputs::open(arguments)?;
    let start = arguments.start.map_or(here, |Start(pose)| pose);
    let start = Gaussian3::new(start, Matrix3::from_diagonal(&START_STDS.map(|std| std * std).into()));
    let mut localizer = begin(start.context("start: must be a place")?)?;
    let mut progress = Progress::new(name, log.scans.len());
    let mut used = 0;
    for scan in log.scans.iter().take_while(|_| !stopped.load(Ordering::Relaxed)) {
        let pushed = localizer.push(scan);
        progress.scans += 1;
        used += u32::from(matches!(pushed, Pushed::First | Pushed::Step(_)));
        if let Pushed::Step(report) = pushed {
            progress.tell(localizer.filter(), report.selection_ess);
        }
    }
    let elapsed = progress.finish().as_secs_f64();
    outputs.write_path(&localizer.path())?;
    let now = localizer.pose_with_covariance();
    let Pose2 { x, y, theta } = now.pose;
    let output = Output {
        scans: progress.scans,
        scans_used: used,
        elapsed_s: elapsed,
        scans_per_s: progress.scans as f64 / elapsed.max(1e-3),
        matched_fraction: localizer.matched_fraction(),
        x,
        y,
        heading_deg: theta.to_degrees(),
        // By columns, which are its rows.
        covariance: now.covariance.into(),
    };
    if arguments.json {
        print_json(&output)?;
    } else {
        let Output { scans, scans_used, scans_per_s, heading_deg, matched_fraction, .. } = output;
        let [x_std, y_std, heading_std] = now.stds();
        print(&format!(
            "{scans} scans, of which {scans_used} looked at, in the map, which stays as it is\n\
             time                              {elapsed:8.1} s, {scans_per_s:.0} scans/s\n\
             of what was seen, on walls of the map {:4.0} %\n\
             at the last scan                  {x:8.2} m, {y:.2} m, {heading_deg:.1}°\n\
             standard deviations of that       {x_std:8.3} m, {y_std:.3} m, {:.2}°\n",
            100.0 * matched_fraction,
            heading_std.to_degrees(),
        ))?;
    }
    if progress.scans < progress.all {
        let said = format!("{name}: stopped after {} of {} scans", progress.scans, progress.all);
        bail!(Stopped(said));
    }
    if localizer.matched_fraction() < LEAST_MATCHED {
        let lost = "little of what was seen is in the map: is it of another building, or does the robot begin elsewhere (--start)?";
        bail!(Doubtful(format!("{name}: {lost}")));
    }
    Ok(())
}
