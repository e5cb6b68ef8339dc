//! Logs of a car in the text form in which that of Victoria Park (Guivant, Nebot 2001) is passed on: a folder with DRS.txt, GPS.txt and LASER.txt.
//!
//! Columns are apart by commas or blanks. DRS: time \[s\], speed of the left rear wheel \[m/s\], steering angle \[rad\]. GPS: time, x, y \[m\]. LASER:
//! time and 361 ranges \[m\] from right to left. In place of LASER a folder may have SIGHTINGS.txt: time, range \[m\], bearing \[rad\], number of the tree.

use crate::sense::Drive;
use crate::{Usage, mrclam};
use anyhow::{Result, bail};
use fastslam::geometry::Pose2;
use fastslam::motion::{Car, Motion};
use fastslam::ops;
use fastslam::sensor::{Feature, RangeBearing};
use fastslam_lab::experiment::car::WHEEL_ASIDE;
use fastslam_lab::experiment::landmarks::LandmarkLog;
use nalgebra::Vector2;
use std::path::Path;

/// Where the tuning comes from.
pub const NOISES: &str = "the vehicle of Victoria Park, with noises of ours";

/// Way after which two places of the GPS give the heading of the start \[m\].
const HEADING_FROM: f64 = 3.0;

/// Most trees that a log may number.
const MOST_TREES: f64 = 100_000.0;

/// Reads a folder. Its truth is the GPS, as far as that is one: to some metres, with gaps, and its first leg for the heading of the start. Returns the log
/// with what is to be told of it.
pub fn read(folder: &Path, car: &Car, sensor: &RangeBearing, named: bool) -> Result<(LandmarkLog, Vec<String>)> {
    let drs = mrclam::timed(&folder.join("DRS.txt"), ["time [s]", "speed [m/s]", "steering angle [rad]"])?;
    if let Some(row) = drs.iter().find(|row| row[2].abs() > 1.5) {
        let said = format_args!("time {}: steering angle {}: must be from -1.5 to 1.5 [rad]", row[0], row[2]);
        bail!(Usage::of_file(&folder.join("DRS.txt"), said));
    }
    let gps_file = folder.join("GPS.txt");
    let gps = mrclam::timed(&gps_file, ["time [s]", "x [m]", "y [m]"])?;
    let far = |row: &&[f64; 3]| ops::hypot(row[1] - gps[0][1], row[2] - gps[0][2]) >= HEADING_FROM;
    let Some(leg) = gps.iter().find(far) else {
        bail!(Usage::of_file(
            &gps_file,
            format_args!("never {HEADING_FROM} m from its start: no heading to start with")
        ));
    };
    let heading = ops::atan2(leg[2] - gps[0][2], leg[1] - gps[0][1]);
    let truth: Vec<[f64; 4]> = gps.iter().map(|row| [row[0], row[1], row[2], heading]).collect();
    let velocities = drs.iter().map(|[time, speed, steering]| {
        let control = car.control(*speed, *steering, WHEEL_ASIDE, 1.0);
        [*time, control.speed, control.turn_rate]
    });

    let sightings = folder.join("SIGHTINGS.txt");
    let mut looks: Vec<(f64, Vec<Feature>)> = Vec::new();
    let mut trees = 0;
    if sightings.exists() {
        for [time, range, bearing, tree] in
            mrclam::timed(&sightings, ["time [s]", "range [m]", "bearing [rad]", "number of the tree"])?
        {
            if !(0.0..MOST_TREES).contains(&tree) || tree.fract() != 0.0 || range <= 0.0 {
                let said = format_args!(
                    "time {time}: range {range}, tree {tree}: must be above 0, and a whole number from 0 to {}",
                    MOST_TREES - 1.0
                );
                bail!(Usage::of_file(&sightings, said));
            }
            trees = trees.max(tree as usize + 1);
            let feature = Feature { z: Vector2::new(range, ops::wrap_angle(bearing)), signature: Some(tree as u32) };
            match looks.last_mut() {
                Some((last, features)) if *last == time => features.push(feature),
                _ => looks.push((time, vec![feature])),
            }
        }
    } else {
        if named {
            let said = "trees of a laser have no names: say --association unknown, or give SIGHTINGS.txt";
            bail!(Usage::of_file(folder, said));
        }
        let columns: [&str; 362] = core::array::from_fn(|k| if k == 0 { "time [s]" } else { "range [m]" });
        let scans = mrclam::timed(&folder.join("LASER.txt"), columns)?;
        looks.extend(scans.iter().map(|row| (row[0], found_trees(&row[1..]))));
    }
    let log = LandmarkLog { landmarks: vec![Vector2::zeros(); trees], ..LandmarkLog::default() };
    let odometry: Vec<[f64; 3]> = velocities.collect();
    let used = mrclam::used(&odometry, &truth);
    let remarks = Drive { odometry: &odometry, looks: &looks, used, sensor, motion: None }.remarks();
    let log = mrclam::drive(log, &odometry, &truth, looks, |pose: &Pose2, control| car.apply(pose, control));
    if log.controls.is_empty() {
        bail!(Usage::of_file(folder, "nothing is seen in the time of both DRS.txt and GPS.txt"));
    }
    Ok((log, remarks))
}

/// What is narrower than a metre and stands in front of everything beside it, up to 75 m: its middle.
fn found_trees(ranges: &[f64]) -> Vec<Feature> {
    const FARTHEST: f64 = 75.0;
    const NEAREST: f64 = 1.0;
    const JUMP: f64 = 1.5;
    const WIDEST: f64 = 1.0;
    let step = core::f64::consts::PI / (ranges.len() - 1) as f64;
    let of = |k: usize| if ranges[k] > NEAREST { ranges[k] } else { FARTHEST };
    let mut trees = Vec::new();
    let mut begin = 0;
    for end in 1..=ranges.len() {
        if end < ranges.len() && (of(end) - of(end - 1)).abs() < JUMP {
            continue;
        }
        let (first, last) = (begin, end - 1);
        begin = end;
        let beside = first > 0 && end < ranges.len() && of(first - 1) > of(first) && of(end) > of(last);
        let middle = (first..end).map(of).sum::<f64>() / (end - first) as f64;
        let width = middle * step * (end - first) as f64;
        if beside && middle < FARTHEST && width < WIDEST {
            let bearing = 0.5 * (first + last) as f64 * step - core::f64::consts::FRAC_PI_2;
            trees.push(Feature { z: Vector2::new(middle + 0.5 * width, bearing), signature: None });
        }
    }
    trees
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trunk_is_found_and_a_wall_and_a_hollow_are_not() {
        let mut scan = [80.0; 361];
        scan[180..184].fill(10.0); // straight ahead, 0.35 m wide
        scan[20..80].fill(15.0); // a wall
        scan[250..260].fill(5.0); // 0.4 m, but behind what stands beside it
        scan[245..250].fill(3.0);
        scan[260..265].fill(3.0);
        let trees = found_trees(&scan);
        assert_eq!(trees.iter().filter(|tree| (tree.z.x - 10.17).abs() < 0.1).count(), 1, "{trees:?}");
        assert!(trees.iter().all(|tree| tree.z.x < 12.0 && (tree.z.x - 5.2).abs() > 0.3), "{trees:?}");
    }
}
