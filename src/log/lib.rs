#![doc = include_str!("README.md")]

mod ascending;
#[cfg(feature = "bags")]
mod bag;
mod carmen;
mod clock;
mod constant;
mod extent;
mod handed;
mod heading;
#[cfg(feature = "json")]
mod json;
mod number;
mod place;
mod problem;
mod relations;
mod remark;
mod repeated;
mod tum;
mod units;

#[cfg(feature = "bags")]
pub use bag::{BagOptions, BagReader, is_bag, write_path};
pub use carmen::{LogReader, parse, parse_carmen, write};
pub use extent::swept_area;
#[cfg(feature = "json")]
pub use json::write_json_lines;
pub use problem::{Field, LogError, LogProblem, MessageProblem, Topics};
pub use relations::{NEAR, Relation, RelationErrors, parse_relations, relation_errors};
pub use remark::Remark;
pub use tum::write_tum;
pub use units::UnitChange;

use fastslam::geometry::Pose2;
use fastslam::order::sorted;
use fastslam::sensor::LaserScan;

/// A log, read.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct LaserLog {
    /// Sweeps of the front laser, by time.
    pub scans: Vec<LaserScan>,
    /// Raw odometry by time \[s\]: that of the scans, and what was reported between them.
    pub odometry: Vec<(f64, Pose2)>,
    /// What else was met.
    pub notes: Notes,
}

/// What a [`Replay`](fastslam::mapper::Replay) pushes.
impl AsRef<[LaserScan]> for LaserLog {
    fn as_ref(&self) -> &[LaserScan] {
        &self.scans
    }
}

impl LaserLog {
    /// Puts what is in it in order: parts are written twice, clocks are set back, and of messages that come over a network some are late. The sorts are stable, so that
    /// equal stamps keep the file's order.
    fn in_order(&mut self) {
        self.leave_copies_out();
        clock::run_on(self);
        self.notes.out_of_order = self.scans.windows(2).filter(|pair| pair[1].time < pair[0].time).count() as u32;
        self.scans = sorted(core::mem::take(&mut self.scans), |a, b| a.time.total_cmp(&b.time));
        self.odometry_in_order();
    }

    fn odometry_in_order(&mut self) {
        self.odometry = sorted(core::mem::take(&mut self.odometry), |a, b| a.0.total_cmp(&b.0));
    }

    /// Whether any of its readings has met anything.
    fn seen_something(&self) -> Result<(), LogError> {
        let readings = || self.scans.iter().flat_map(|scan| &scan.ranges);
        let Beyond { count, max_range, .. } = self.notes.beyond;
        // Readings of bags that are beyond are 0 by now; those of JSON lines are as they were.
        let ranges =
            readings().filter(|range| range.is_finite() && **range > 0.0 && (count == 0 || **range <= max_range));
        if ranges.count() > 0 {
            return Ok(());
        }
        Err(LogError::whole(LogProblem::NoReading { readings: readings().count(), beyond: self.notes.beyond }))
    }
}

/// What was met in a log besides what is used.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Notes {
    /// Messages of rear lasers, which are passed over.
    pub rear: u32,
    /// Messages of kinds that are not known here, by kind.
    pub unknown: Vec<(String, u32)>,
    /// Malformed lines that were passed over.
    pub malformed: u32,
    /// The first of them.
    pub first_malformed: Option<LogError>,
    /// Scans whose stamp is before that of the scan above them: they were put in order.
    pub out_of_order: u32,
    /// Readings of bags and of JSON lines that are beyond the longest range that their scan declares.
    pub beyond: Beyond,
    /// Stamps \[s\] of scans that were matched for want of odometry and fit nowhere upon those before: from each of them on the path may be wrong.
    pub lost: Vec<f64>,
    /// What else was made of the log.
    pub remarks: Vec<Remark>,
}

/// Readings beyond the longest range that scans declare.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Beyond {
    /// How many there are.
    pub count: u32,
    /// The shortest of them.
    pub shortest: f32,
    /// What is declared \[m\].
    pub max_range: f32,
}

impl Beyond {
    /// Adds those of a scan, if it declares a longest range.
    #[cfg(any(feature = "bags", feature = "json"))]
    fn add(&mut self, ranges: &[f32], declared: Option<f64>) {
        let Some(max_range) = declared.map(|declared| declared as f32) else { return };
        for range in ranges.iter().filter(|range| range.is_finite() && **range > max_range) {
            let shortest = if self.count > 0 { self.shortest.min(*range) } else { *range };
            *self = Self { count: self.count + 1, shortest, max_range };
        }
    }
}

/// Raw odometry at a time \[s\], interpolated between its neighbours and held beyond its ends; `None` without any. Poses
/// with one stamp are in the order of the file, and at that stamp the first of them counts.
pub fn odometry_at(odometry: &[(f64, Pose2)], time: f64) -> Option<Pose2> {
    let after = odometry.partition_point(|(t, _)| *t < time).min(odometry.len().checked_sub(1)?);
    let ((t0, a), (t1, b)) = (odometry[after.max(1) - 1], odometry[after]);
    let share = if t1 > t0 { ((time - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { 0.0 };
    Some(a.plus(&(b.minus(&a) * share)))
}
