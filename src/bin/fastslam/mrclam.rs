//! Logs of the UTIAS multi-robot dataset (Leung, Halpern, Barfoot, Liu, IJRR 2011): one robot among landmarks with bar codes, and its
//! true path by motion capture.

use crate::offsets::held;
use crate::sense::Drive;
use crate::{Usage, in_file};
use anyhow::{Context, Result, bail};
use fastslam::geometry::Pose2;
use fastslam::motion::{Velocity, VelocityDiffusion};
use fastslam::ops;
use fastslam::sensor::Feature;
use fastslam_lab::experiment::landmarks::{LandmarkLog, Tuning};
use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

/// Where [`camera::tuning`](fastslam_lab::experiment::camera::tuning) comes from, in words that are printed with every error. The data set states no noises; what is read off a log's own
/// truth is no forecast of how well that log can be done.
pub const NOISES: &str = "calibrated on robot 1 of data set 6, against its motion capture: no forecast for that log";

/// Readings this close in time are one look of the camera \[s\].
const ONE_LOOK: f64 = 0.02;

/// Longest step \[s\]: where nothing is seen for longer, the motion is cut into several, as one arc would be too far from it.
const LONGEST_STEP: f64 = 0.5;

/// Reads PREFIX-barcodes.dat, -landmarks.dat and -robot1-{odometry,measurement,groundtruth}.dat. PREFIX may name the robot:
/// PREFIX-robot2. Returns the log with what is to be told of it; `named` is whether bar codes are read.
pub fn read(prefix: &Path, tuning: &Tuning<VelocityDiffusion>, named: bool) -> Result<(LandmarkLog, Vec<String>)> {
    let text = prefix.to_string_lossy();
    let text = text.trim_end_matches('-');
    let (set, robot) = match text.rsplit_once("-robot") {
        Some((set, number)) if !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()) => (set, number),
        _ => (text, "1"),
    };
    let [barcodes, landmarks] = ["barcodes", "landmarks"].map(|name| PathBuf::from(format!("{set}-{name}.dat")));
    let of_robot = |name| PathBuf::from(format!("{set}-robot{robot}-{name}.dat"));

    let barcodes = table(&barcodes, ["subject", "barcode"])?;
    let landmarks = table(&landmarks, ["subject", "x [m]", "y [m]", "x std [m]", "y std [m]"])?;
    let odometry = timed(&of_robot("odometry"), ["time [s]", "v [m/s]", "ω [rad/s]"])?;
    let measurements = timed(&of_robot("measurement"), ["time [s]", "barcode", "range [m]", "bearing [rad]"])?;
    let truth = timed(&of_robot("groundtruth"), ["time [s]", "x [m]", "y [m]", "θ [rad]"])?;

    // A bar code that belongs to another robot, or to nobody, names no landmark. Where bar codes are read, such a sighting is passed
    // over; where they are not, it is one like any other, and clutter.
    let signature = |barcode: f64| {
        let [subject, _] = barcodes.iter().find(|row| row[1] == barcode)?;
        landmarks.iter().position(|row| row[0] == *subject).map(|index| index as u32)
    };
    let log = LandmarkLog {
        landmarks: landmarks.iter().map(|row| Vector2::new(row[1], row[2])).collect(),
        ..LandmarkLog::default()
    };
    let mut remarks = of_rows(&measurements, |barcode| barcodes.iter().any(|row| row[1] == barcode), &signature, named);
    let mut looks = Vec::new();
    let mut rest = &measurements[..];
    while let Some([time, ..]) = rest.first().copied() {
        let count = rest.iter().take_while(|row| row[0] < time + ONE_LOOK).count();
        let (look, after) = rest.split_at(count);
        rest = after;
        let feature =
            |row: &[f64; 4]| Feature { z: Vector2::new(row[2], ops::wrap_angle(row[3])), signature: signature(row[1]) };
        // A row that is there twice is one measurement.
        let once = look.iter().enumerate().filter(|(k, row)| !look[..*k].contains(row));
        looks.push((time, once.map(|(_, row)| feature(row)).collect()));
    }
    let used = used(&odometry, &truth);
    remarks.extend(
        Drive { odometry: &odometry, looks: &looks, used, sensor: &tuning.sensor, motion: Some(&tuning.motion) }
            .remarks(),
    );
    let log = drive(log, &odometry, &truth, looks, |pose, control| control.apply(pose));
    if log.controls.is_empty() {
        bail!(Usage::of_file(prefix, "no measurement falls into the time of both odometry and ground truth"));
    }
    Ok((log, remarks))
}

/// What measurements, rows of time, bar code, range and bearing, say against the list of bar codes, the landmarks and each other.
fn of_rows(
    rows: &[[f64; 4]],
    is_listed: impl Fn(f64) -> bool,
    signature: &impl Fn(f64) -> Option<u32>,
    named: bool,
) -> Vec<String> {
    let count = |of: &dyn Fn(&[f64; 4]) -> bool| rows.iter().filter(|row| of(row)).count();
    let (all, unlisted) = (rows.len(), count(&|row| !is_listed(row[1])));
    let nameless = count(&|row| signature(row[1]).is_none());
    let mut remarks = Vec::new();
    if named && (20 * unlisted > all || 2 * nameless > all) {
        remarks.push(format!(
            "{nameless} of {all} measurements are passed over: their bar code is no landmark's, and {unlisted} are in no list of bar codes; say \
             --association unknown to use them"
        ));
    }
    let most = rows.iter().map(|row| row[3].abs()).fold(0.0, f64::max);
    if most > TAU {
        remarks.push(format!("bearings go up to {most:.1}: they must be in radians"));
    }
    remarks
}

/// First and last second in which there is both odometry and truth.
pub fn used(odometry: &[[f64; 3]], truth: &[[f64; 4]]) -> [f64; 2] {
    [odometry[0][0].max(truth[0][0]), odometry[odometry.len() - 1][0].min(truth[truth.len() - 1][0])]
}

/// Appends a drive to a log: a step to every look, and where nothing is seen for long, some between. Rows of `odometry` are time \[s\],
/// v \[m/s\] and ω \[rad/s\], those of `truth` time, x, y \[m\] and θ \[rad\]; `apply` moves a pose by a control.
pub fn drive(
    mut log: LandmarkLog,
    odometry: &[[f64; 3]],
    truth: &[[f64; 4]],
    looks: Vec<(f64, Vec<Feature>)>,
    apply: impl Fn(&Pose2, &Velocity) -> Pose2,
) -> LandmarkLog {
    let [start, end] = used(odometry, truth);
    let mut now = start;
    log.truth.push(pose_at(truth, start));
    log.odometry.push(log.truth[0]);
    let mut step = |log: &mut LandmarkLog, until: f64, features: Vec<Feature>| {
        let control = driven(odometry, now, until);
        now = until;
        log.odometry.push(apply(&log.odometry[log.odometry.len() - 1], &control));
        log.truth.push(pose_at(truth, until));
        log.controls.push(control);
        log.sightings.push(features);
        until
    };
    let mut last = start;
    for (time, features) in looks {
        // A look at the very start belongs to the drive: its step takes no time.
        let is_first = log.controls.is_empty() && time == start;
        if !is_first && (time <= last || time > end) {
            continue; // before the drive began, or where there is no truth to hold it against
        }
        let parts = ((time - last) / LONGEST_STEP).ceil().max(1.0);
        let begin = last;
        for part in 1..parts as u32 {
            step(&mut log, begin + (time - begin) * f64::from(part) / parts, Vec::new());
        }
        last = step(&mut log, time, features);
    }
    log
}

/// Mean velocities between two times, of readings that each hold until the next.
fn driven(odometry: &[[f64; 3]], from: f64, until: f64) -> Velocity {
    let duration = until - from;
    if duration <= 0.0 {
        return Velocity { speed: 0.0, turn_rate: 0.0, duration: 0.0 };
    }
    let (mut distance, mut turn) = (0.0, 0.0);
    for Velocity { speed, turn_rate, duration } in held(odometry, from, until) {
        distance += speed * duration;
        turn += turn_rate * duration;
    }
    Velocity { speed: distance / duration, turn_rate: turn / duration, duration }
}

/// The true pose at a time, interpolated.
fn pose_at(truth: &[[f64; 4]], time: f64) -> Pose2 {
    let after = truth.partition_point(|row| row[0] < time).min(truth.len() - 1);
    let ([t0, x0, y0, a0], [t1, x1, y1, a1]) = (truth[after.max(1) - 1], truth[after]);
    let share = if t1 > t0 { ((time - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { 0.0 };
    Pose2::new(x0 + share * (x1 - x0), y0 + share * (y1 - y0), a0 + share * ops::wrap_angle(a1 - a0))
}

/// A table whose first column is a time that never goes back.
pub fn timed<const N: usize>(path: &Path, columns: [&str; N]) -> Result<Vec<[f64; N]>> {
    let rows = table(path, columns)?;
    match rows.windows(2).position(|pair| pair[1][0] < pair[0][0]) {
        Some(k) => bail!(Usage::of_file(path, format_args!("times go back: {} after {}", rows[k + 1][0], rows[k][0]))),
        None => Ok(rows),
    }
}

/// The rows of a file of numbers in columns; lines that begin with # are comments.
//
// Not by the crate csv: columns are apart by commas, blanks and tabs in any number, where it takes one character, and the line that it gives of
// a record is that of the comments before it.
fn table<const N: usize>(path: &Path, columns: [&str; N]) -> Result<Vec<[f64; N]>> {
    let text = std::fs::read_to_string(path).with_context(in_file(path))?;
    let mut rows = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        if line.trim_start().starts_with('#') || line.trim().is_empty() {
            continue;
        }
        let values: Option<Vec<f64>> = line
            .split([',', ' ', '\t', '\r'])
            .filter(|word| !word.is_empty())
            .map(|word| word.parse().ok().filter(|x: &f64| x.is_finite()))
            .collect();
        match values.and_then(|values| <[f64; N]>::try_from(values).ok()) {
            Some(row) => rows.push(row),
            None => {
                let expected = format_args!("line {number}: expected {N} numbers: {}", columns_of(&columns));
                bail!(Usage::of_file(path, expected));
            }
        }
    }
    if rows.is_empty() {
        bail!(Usage::of_file(path, format_args!("no line with {N} numbers: {}", columns_of(&columns))));
    }
    Ok(rows)
}

/// Names of columns in a line, however many there are.
fn columns_of(columns: &[&str]) -> String {
    if columns.len() > 8 { format!("{}, …", columns[..3].join(", ")) } else { columns.join(", ") }
}
