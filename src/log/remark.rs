//! What was made of a log, in words.

use core::fmt;
use fastslam::error::fixed;

/// What was made of a log that does not tell all.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum Remark {
    /// It has no odometry.
    NoOdometry,
    /// Its odometry never moves.
    StillOdometry,
    /// Its headings are in degrees.
    HeadingsInDegrees,
    /// Headings of one stretch of it are in degrees.
    SomeHeadingsInDegrees {
        /// Stamp of the first pose whose heading is \[s\].
        from: f64,
        /// Stamp of the last one \[s\].
        to: f64,
    },
    /// The clock was set back.
    ClockSetBack {
        /// By how much \[s\].
        seconds: f64,
        /// Stamp of the last scan before it \[s\].
        time: f64,
    },
    /// So many scans, of stretches of which this is the first, repeat earlier ones to the bit: they were left out.
    Copied {
        /// Numbers of its first and last scan as recorded, from 1 on, and of those that they repeat.
        stretch: [[u32; 2]; 2],
        /// How many scans in all.
        count: u32,
    },
    /// So many scans are before the first or after the last word of odometry.
    Beyond(u32),
    /// No transform tells where the laser sits.
    NoTransform {
        /// Frame of the laser.
        laser: String,
        /// Frame of the robot.
        robot: String,
    },
    /// What the writer of a log in JSON lines says of the log that it was made of.
    Told(String),
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoOdometry => f.write_str("there is no odometry: each scan is matched with those before"),
            Self::StillOdometry => f.write_str(
                "the odometry never moves: it is taken for none, and each scan is matched with those before",
            ),
            Self::HeadingsInDegrees => f.write_str(
                "odometry and its headings go together only if headings are in degrees, and not in radians: they are read as degrees",
            ),
            Self::SomeHeadingsInDegrees { from, to } => write!(
                f,
                "from {} s to {} s odometry and its headings go together only if headings are in degrees, and not in radians: there they are read as degrees",
                fixed(*from, 3),
                fixed(*to, 3)
            ),
            Self::ClockSetBack { seconds, time } => write!(
                f,
                "the clock was set back by {} s after {} s: scans and odometry stay in the order in which they were recorded",
                fixed(*seconds, 1),
                fixed(*time, 3)
            ),
            Self::Copied { stretch: [[first, last], [from, to]], count } => write!(
                f,
                "scans that were written twice: {count}, the first of them scans {first} to {last}, which repeat scans {from} to {to} to the bit; they are left out"
            ),
            Self::Beyond(scans) => write!(
                f,
                "scans before the first or after the last word of odometry: {scans}; they have the pose nearest in time"
            ),
            Self::NoTransform { laser, robot } => write!(
                f,
                "no transform tells where the laser ({laser}) sits on the robot ({robot}): it is taken to be in its centre and to look ahead"
            ),
            Self::Told(words) => f.write_str(words),
        }
    }
}
