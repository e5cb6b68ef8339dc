//! One sweep of a laser, as a robot's driver or a log tells it.

use super::Scan;
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::ops;

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
    /// Farthest a coordinate may be from the origin of odometry \[m\]: beyond it a number is no place.
    pub const FARTHEST: f64 = 1e7;
    /// Farthest from one scan to the next by odometry \[m\]: no robot drives a kilometre between two sweeps of its laser.
    pub const FARTHEST_JUMP: f64 = 1e3;

    /// Whether all that says when, where and which way the laser looked is a number, and each coordinate that of a place.
    ///
    /// # Errors
    /// [`SettingError::OutOfRange`] of the first that is not, by the name of its field. Readings are not asked: of a beam whose range is no
    /// number nothing is known, and the others are of use.
    pub fn validate(&self) -> Result<(), SettingError> {
        const PLACE: Range = Range::number(-LaserScan::FARTHEST, LaserScan::FARTHEST, "m");
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

/// No laser of a robot measures as far \[m\]: a longer reading is an error, or a word for *nothing met* besides the laser's own.
const FARTHEST_READING: f32 = 1e3;

/// The range \[m\] that all but one in a thousand of the readings below a kilometre stay within, 0 without any: the longest ones are often
/// errors, or say something else than the laser's *nothing met*, and must not change what that is.
pub fn longest_reading(scans: &[LaserScan]) -> f64 {
    let is_range = |range: &&f32| **range > 0.0 && **range < FARTHEST_READING;
    let readings = || scans.iter().flat_map(|scan| &scan.ranges).filter(is_range);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_reach_of_nothing_is_told_from_what_says_nothing() {
        let scan = LaserScan {
            time: 0.0,
            odometry: Pose2::default(),
            robot_from_laser: Pose2::default(),
            first_angle: 0.0,
            angle_step: 0.1,
            max_range: Some(12.0),
            ranges: vec![3.0, f32::INFINITY, 0.0, f32::NAN, -1.0, 13.0],
        };
        let told = |clear_range| {
            let beams = scan.beams(f64::INFINITY, 30.0, clear_range);
            beams.map(|beam| beam.map(|beam| (beam.length, beam.met))).collect::<Vec<_>>()
        };
        assert_eq!(told(5.0), [Some((3.0, true)), Some((5.0, false)), None, None, None, None]);
        assert_eq!(told(0.0), [Some((3.0, true)), None, None, None, None, None]);
    }
}
