//! Scans as JSON lines, for robots whose logs nothing else reads: one object a line.
//!
//! ```text
//! {"time": 1.5, "angle_min": -1.57, "angle_increment": 0.0175, "range_max": 30, "ranges": [2.1, null, 2.3], "laser": [0.1, 0, 0], "odometry": [0.5, 0, 0.02]}
//! ```
//!
//! Seconds, metres, radians, in the frames and with the names of `sensor_msgs/LaserScan`. `ranges` has a number for each beam, `null` where
//! nothing is in reach, 0 where nothing is known. `range_max`, `laser` (x, y, heading of the laser on the robot; at its centre where it is
//! missing) and `odometry` (x, y, heading of the robot) may be missing. Where scans have no odometry of their own it comes from lines of a TUM
//! file, which may stand anywhere between them or in front of them. What else an object holds is passed over.

use super::number::number;
use super::place::NOWHERE;
use super::{LaserLog, LogProblem, Notes};
use core::f64::consts::PI;
use fastslam::geometry::Pose2;
use fastslam::sensor::LaserScan;
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

/// A number of a line, read as those of all other logs are: to the bit, for which `serde_json` has its feature `float_roundtrip`, a second
/// reader of numbers and as large as all the rest of it.
#[derive(Clone, Copy, Default)]
struct Number(f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = <&RawValue>::deserialize(deserializer)?.get();
        let value = number(text).filter(|value| value.is_finite()).map(Self);
        value.ok_or_else(|| D::Error::custom("expected a finite number"))
    }
}

/// What a line may hold, and how its numbers and its ranges are read or written.
#[derive(Default, Serialize, Deserialize)]
#[serde(default)]
struct Line<N, R> {
    #[serde(skip_serializing_if = "Option::is_none")]
    remark: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    malformed: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<N>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_min: Option<N>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_increment: Option<N>,
    #[serde(skip_serializing_if = "Option::is_none")]
    range_max: Option<N>,
    #[serde(skip_serializing_if = "Option::is_none")]
    laser: Option<[N; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    odometry: Option<[N; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ranges: Option<Vec<Option<R>>>,
}

/// What a line tells.
pub(super) enum Told {
    /// With its odometry as it is told.
    Scan(LaserScan, [f64; 3]),
    Remark(String),
    /// So many messages could not be read where the lines come from, and why the first of them could not.
    Malformed(u32, String),
}

/// What reads a line.
pub(super) type ReadLine = fn(&str) -> Result<Told, LogProblem>;

pub(super) fn read(line: &str) -> Result<Told, LogProblem> {
    let line: Line<Number, Number> = serde_json::from_str(line).map_err(|error| {
        // As Python writes them, unless it is told not to.
        let is_python = line.contains("NaN") || line.contains("Infinity");
        LogProblem::Json(if is_python { PYTHON.into() } else { error.to_string() })
    })?;
    match (line.malformed, line.remark) {
        (Some(count), remark) => return Ok(Told::Malformed(count, remark.unwrap_or_default())),
        (None, Some(remark)) => return Ok(Told::Remark(remark)),
        (None, None) => {}
    }
    let number = |name, value: Option<Number>| value.map(|Number(value)| value).ok_or(LogProblem::JsonLacks(name));
    let (time, first_angle) = (number("time", line.time)?, number("angle_min", line.angle_min)?);
    let angle_step = number("angle_increment", line.angle_increment)?;
    if first_angle.abs() > 2.0 * PI || angle_step.abs() > PI || angle_step == 0.0 {
        return Err(LogProblem::JsonAngles { first: first_angle, step: angle_step });
    }
    let ranges = line.ranges.ok_or(LogProblem::JsonLacks("ranges"))?;
    if ranges.is_empty() {
        return Err(LogProblem::JsonNoRanges);
    }
    let [odometry, laser] = [line.odometry, line.laser].map(|pose| pose.map(|pose| pose.map(|Number(value)| value)));
    let pose = |[x, y, theta]: [f64; 3]| Pose2::new(x, y, theta);
    let scan = LaserScan {
        time,
        odometry: odometry.map_or(Pose2::default(), pose),
        robot_from_laser: laser.map_or(Pose2::default(), pose),
        first_angle,
        angle_step,
        max_range: line.range_max.map(|Number(range)| range).filter(|range| *range > 0.0),
        ranges: ranges.into_iter().map(|range| range.map_or(f32::INFINITY, |Number(range)| range as f32)).collect(),
    };
    if scan.validate().is_err() {
        return Err(LogProblem::JsonFar);
    }
    Ok(match odometry {
        Some(told) => Told::Scan(scan, told),
        None => Told::Scan(LaserScan { odometry: NOWHERE, ..scan }, [0.0; 3]),
    })
}

/// What is wrong with a line of Python's.
const PYTHON: &str =
    "NaN and Infinity are not JSON; write null where nothing is in reach, and 0 where nothing is known";

/// A range as JSON can tell it: `null` where nothing is in reach, and 0 for what is no number.
fn reading(range: &f32) -> Option<f32> {
    match *range {
        f32::INFINITY => None,
        range if range.is_finite() => Some(range),
        _ => Some(0.0),
    }
}

/// The scans of a log as JSON lines, each with its odometry, and what was noted of it: [`parse`](super::parse) reads back the same bits.
pub fn write_json_lines(log: &LaserLog) -> String {
    let mut text = String::new();
    let mut write = |line: &Line<f64, f32>| {
        text.push_str(&serde_json::to_string(line).unwrap_or_default()); // of numbers and words: nothing that can fail
        text.push('\n');
    };
    for scan in &log.scans {
        let pose = |pose: &Pose2| Some([pose.x, pose.y, pose.theta]);
        write(&Line {
            time: Some(scan.time),
            angle_min: Some(scan.first_angle),
            angle_increment: Some(scan.angle_step),
            range_max: scan.max_range,
            laser: pose(&scan.robot_from_laser),
            odometry: pose(&scan.odometry),
            ranges: Some(scan.ranges.iter().map(reading).collect()),
            ..Line::default()
        });
    }
    let Notes { remarks, malformed, first_malformed, .. } = &log.notes;
    if let Some(first) = first_malformed {
        write(&Line { malformed: Some(*malformed), remark: Some(first.problem.to_string()), ..Line::default() });
    }
    for remark in remarks {
        write(&Line { remark: Some(remark.to_string()), ..Line::default() });
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_told_with_its_place_in_the_line() {
        for wrong in ["\"1.5\"", "true", "1e999", "[]"] {
            let line = format!("{{\"time\": 0, \"angle_min\": {wrong}, \"angle_increment\": 1, \"ranges\": [1]}}");
            let found = read(&line).err().map(|problem| problem.to_string()).unwrap_or_default();
            let column = 25 + wrong.len(); // where it ends
            assert!(found.contains(&format!("expected a finite number at line 1 column {column}")), "{found}");
        }
    }
}
