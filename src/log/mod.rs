//! Recorded logs of robots with a laser: what was driven and seen, and how well an estimate of the path agrees with known
//! relations between poses.
//!
//! No I/O: bytes in, structures out. Whoever has the bytes, from a file, a network or a browser, reads them by the same code.

#[cfg(feature = "bags")]
mod bag;
mod carmen;
mod clock;
mod extent;
#[cfg(feature = "json")]
mod json;
mod place;
mod problem;
mod relations;
mod scan_to_scan;
mod tum;

#[cfg(feature = "bags")]
pub use bag::{BagOptions, BagReader, is_bag, write_path};
pub use carmen::{LogReader, parse, write};
pub use extent::swept_area;
#[cfg(feature = "json")]
pub use json::write_json_lines;
pub use problem::{Field, LogError, LogProblem, MessageProblem, Remark, Topics};
pub use relations::{NEAR, Relation, RelationErrors, parse_relations, relation_errors};
pub use tum::write_tum;

use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::mapper::tuning::{NOTHING_MET, STILL};
use crate::ops;
use crate::order::sorted;
use crate::sensor::Scan;

/// Farthest a coordinate may be from the log's origin \[m\]: beyond it a number is no place.
const FARTHEST: f64 = 1e7;

/// Farthest from one scan to the next by odometry \[m\]: no robot drives a kilometre between two sweeps of its laser.
pub(crate) const FARTHEST_JUMP: f64 = 1e3;

/// One sweep of a laser.
#[derive(Clone, PartialEq, Debug)]
pub struct LaserScan {
    /// When \[s\], on the log's clock.
    pub time: f64,
    /// Pose of the robot by raw odometry.
    pub odometry: Pose2,
    /// Where the laser sits.
    pub robot_from_laser: Pose2,
    /// Direction of the first beam in the laser's frame \[rad\].
    pub first_angle: f64,
    /// From one beam to the next \[rad\].
    pub angle_step: f64,
    /// Longest range \[m\] as the log itself declares it.
    pub max_range: Option<f64>,
    /// Ranges \[m\]. +∞: nothing is in reach. What is no number, 0 or less says nothing, nor does [`Self::max_range`] or more.
    pub ranges: Vec<f32>,
}

impl LaserScan {
    /// Whether all that says when, where and which way the laser looked is a number, and each coordinate that of a place.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] of the first that is not, by the name of its field. Readings are not asked: of a beam whose range is no
    /// number nothing is known, and the others are of use.
    pub fn validate(&self) -> Result<(), SettingError> {
        const PLACE: Range = Range::number(-FARTHEST, FARTHEST, "m");
        const ANGLE: Range = Range::finite("rad");
        let Self { time, odometry, robot_from_laser, first_angle, angle_step, .. } = self;
        Range::finite("s").check("time", *time)?;
        PLACE.check("odometry.x", odometry.x)?;
        PLACE.check("odometry.y", odometry.y)?;
        ANGLE.check("odometry.theta", odometry.theta)?;
        PLACE.check("robot_from_laser.x", robot_from_laser.x)?;
        PLACE.check("robot_from_laser.y", robot_from_laser.y)?;
        ANGLE.check("robot_from_laser.theta", robot_from_laser.theta)?;
        ANGLE.check("first_angle", *first_angle)?;
        ANGLE.check("angle_step", *angle_step).map(drop)
    }

    /// Where the laser sits, in the robot's frame \[m\].
    pub(crate) fn origin(&self) -> [f64; 2] {
        [self.robot_from_laser.x, self.robot_from_laser.y]
    }

    /// Where the beams began and ended, in the robot's frame. A reading of `longest` \[m\] or more met nothing, and says nothing: what it passed
    /// may be glass. One of `max_range` \[m\] or more is cut there, and says that the way is free.
    pub fn end_points(&self, longest: f64, max_range: f64) -> Scan {
        let mut ends = Scan { origin: self.origin(), ..Scan::default() };
        for Beam { end, met, .. } in self.beams(longest, max_range, 0.0).flatten() {
            if met { ends.hits.push(end) } else { ends.misses.push(end) }
        }
        ends
    }

    /// The same beam by beam, with `None` for those that say nothing. A reading of +∞ says that the way is free up to `clear_range` \[m\].
    pub(crate) fn beams(&self, longest: f64, max_range: f64, clear_range: f64) -> impl Iterator<Item = Option<Beam>> {
        let longest = self.max_range.map_or(longest, |declared| declared.min(longest));
        self.ranges.iter().map(|range| f64::from(*range)).enumerate().map(move |(k, range)| {
            let clears = range == f64::INFINITY && clear_range > 0.0;
            (clears || (range > 0.0 && range < longest)).then(|| {
                let (sin, cos) = ops::sin_cos(self.first_angle + k as f64 * self.angle_step);
                let length = range.min(if clears { clear_range.min(max_range) } else { max_range });
                let end = self.robot_from_laser.transform([length * cos, length * sin]);
                Beam { length, end, met: range < max_range }
            })
        })
    }
}

/// A beam that says something.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Beam {
    /// How far the way is free, from the laser \[m\].
    pub length: f64,
    /// Where that is, in the robot's frame \[m\].
    pub end: [f64; 2],
    /// Whether something is there.
    pub met: bool,
}

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

impl LaserLog {
    /// The range \[m\] that all but one in a thousand of the readings stay within, 0 without any: the longest one is
    /// often an error, or says something else than the laser's *nothing met*.
    pub fn longest_reading(&self) -> f64 {
        let readings =
            || self.scans.iter().flat_map(|scan| &scan.ranges).filter(|range| range.is_finite() && **range > 0.0);
        let most_beyond = readings().count() / 1000;
        // The smallest range that no more go beyond, by bisection: positive numbers are in the order of their bits.
        let (mut low, mut high) = (0, f32::INFINITY.to_bits());
        while low < high {
            let middle = low.midpoint(high);
            let beyond = readings().filter(|range| range.to_bits() > middle).count();
            if beyond > most_beyond { low = middle + 1 } else { high = middle }
        }
        f64::from(f32::from_bits(low))
    }

    /// Leaves out scans whose ranges are, to the bit, those of the one before, though the robot moved in between: a driver that sends its last scan
    /// again. How many there were, and the stamp of the first \[s\]; `None` where there were none. In a corridor that a simulator draws without noise, all
    /// that is left out says nothing new.
    pub fn leave_repeated_out(&mut self) -> Option<(usize, f64)> {
        /// Fewer ranges may be equal by chance.
        const ENOUGH: usize = 10;
        let tells = |scan: &LaserScan| scan.ranges.iter().filter(|range| range.is_finite() && **range > 0.0).count();
        let (mut count, mut first, mut kept) = (0, None, Vec::<LaserScan>::new());
        for scan in core::mem::take(&mut self.scans) {
            let repeats = kept.last().is_some_and(|last| {
                let moved = last.odometry.between(&scan.odometry);
                let moves = moved.x.abs().max(moved.y.abs()).max(moved.theta.abs()) > STILL;
                moves && last.ranges == scan.ranges && tells(&scan) >= ENOUGH
            });
            if repeats {
                count += 1;
                first = first.or(Some(scan.time));
            } else {
                kept.push(scan);
            }
        }
        self.scans = kept;
        first.map(|time| (count, time))
    }

    /// Gives each scan the pose at which it fits best upon those before, in place of that by odometry: for odometry that is none. [`Self::odometry`] stays
    /// as it was told.
    pub fn match_scans(&mut self) {
        let longest = NOTHING_MET * self.longest_reading();
        scan_to_scan::give_odometry(&mut self.scans, longest);
    }

    /// Puts what is in it in order: clocks are set back, and of messages that come over a network some are late. The sorts are stable, so that
    /// equal stamps keep the file's order.
    fn in_order(&mut self) {
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

/// A number with so many decimals, and 0 without a sign.
pub(crate) fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| matches!(byte, b'0' | b'.')) => digits.into(),
        _ => text,
    }
}
