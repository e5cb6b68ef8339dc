//! What can be wrong with a log: each problem as the data that tell of it, so that whoever shows it can say it in the words of his readers.
//! Displayed, they are said in English.

use super::Beyond;
use core::fmt;
use fastslam::error::{Shown, fixed};

/// A line that cannot be read, or a file.
#[derive(Clone, PartialEq, Debug)]
pub struct LogError {
    /// Its number, from 1 on; 0 for what is said of the file as a whole.
    pub line: u32,
    /// What is wrong with it.
    pub problem: LogProblem,
}

impl LogError {
    /// Of the file as a whole.
    pub(super) fn whole(problem: LogProblem) -> Self {
        Self { line: 0, problem }
    }
}

impl fmt::Display for LogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.problem)
    }
}

impl core::error::Error for LogError {}

/// What is wrong with a log, or with a line or a message of it. Words that are cited from the file are quoted and short.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LogProblem {
    /// A line is longer than any message.
    #[error("expected a message, found a line of more than 1 MB")]
    LongLine,
    /// A line is not in UTF-8.
    #[error("expected a message in plain text, found binary")]
    Binary,
    /// A line begins with a name that is not known, after many others.
    #[error("expected one of the known messages, found {0}")]
    UnknownMessage(String),
    /// A line begins with what is no name.
    #[error("expected the name of a message, found {0}")]
    NoMessage(String),
    /// A field of a message is missing, or not what it should be.
    #[error("{}: expected {field}, found {}", message.unwrap_or("a pose"), found.as_deref().unwrap_or("the end of the line"))]
    Field {
        /// Name of the message; `None` for a pose in a line of a TUM file.
        message: Option<&'static str>,
        /// What should be there.
        field: Field,
        /// What is there; `None` at the end of the line.
        found: Option<String>,
    },
    /// A scan has no beams.
    #[error("{message}: expected ranges, found 0 of them")]
    NoRanges {
        /// Name of the message.
        message: &'static str,
    },
    /// A scan has another number of beams than those before it.
    #[error("{message}: expected {before} ranges as in the scans before, found {found}")]
    OtherRanges {
        /// Name of the message.
        message: &'static str,
        /// Beams of the scans before.
        before: usize,
        /// Beams of this one.
        found: usize,
    },
    /// Angles of a scan are none in radians.
    #[error("{message}: expected angles in radians, found {} and {}", Shown(*first), Shown(*step))]
    Angles {
        /// Name of the message.
        message: &'static str,
        /// Of the first beam \[rad\].
        first: f64,
        /// From one beam to the next \[rad\].
        step: f64,
    },
    /// A scan is too far from the one before it.
    #[error("{message}: expected a pose within 1 km of the scan before, found one {} km away", fixed(*kilometres, 1))]
    Jump {
        /// Name of the message.
        message: &'static str,
        /// How far \[km\].
        kilometres: f64,
    },
    /// A pose is beyond all places.
    #[error(
        "{message}: expected {names} within 10000 km and 10 million radians, found {} {} {}",
        Shown(found[0]), Shown(found[1]), Shown(found[2])
    )]
    Far {
        /// Name of the message.
        message: &'static str,
        /// Names of its fields.
        names: &'static str,
        /// x, y \[m\] and heading \[rad\].
        found: [f64; 3],
    },
    /// A pose of a TUM file is beyond all places, or none in the plane.
    #[error("a pose: expected one within 10000 km that turns about the vertical")]
    NoPose,
    /// A line of JSON is none, or has other types; in the words of the library that reads it.
    #[error("expected a scan in JSON: {0}")]
    Json(String),
    /// A scan in JSON lacks a field of this name.
    #[error("a scan in JSON: expected \"{0}\", found none")]
    JsonLacks(&'static str),
    /// Angles of a scan in JSON are none in radians.
    #[error(
        "a scan in JSON: expected angle_min and angle_increment in radians, found {} and {}",
        Shown(*first), Shown(*step)
    )]
    JsonAngles {
        /// Of the first beam \[rad\].
        first: f64,
        /// From one beam to the next \[rad\].
        step: f64,
    },
    /// A scan in JSON has no beams.
    #[error("a scan in JSON: expected ranges, found 0 of them")]
    JsonNoRanges,
    /// A scan in JSON is beyond all places.
    #[error("a scan in JSON: expected places within 10000 km")]
    JsonFar,
    /// There is no scan in a log of text.
    #[error(
        "no FLASER or ROBOTLASER1 message in it{}",
        but.as_ref().map(|kind| format!(" (but {kind})")).unwrap_or_default()
    )]
    NoScan {
        /// A kind of messages that it has.
        but: Option<String>,
    },
    /// There is no scan at the beginning of a log of text, which is not read further.
    #[error(
        "no FLASER or ROBOTLASER1 message in its first {megabytes} MB{}",
        but.as_ref().map(|kind| format!(" (but {kind})")).unwrap_or_default()
    )]
    NoScanSoon {
        /// What was read of it \[MB\].
        megabytes: u64,
        /// A kind of messages that it has.
        but: Option<String>,
    },
    /// No beam has met anything.
    #[error("none of its {readings} readings is a range: a finite number above 0{}", in_reach(beyond))]
    NoReading {
        /// Readings of all scans.
        readings: usize,
        /// Those of them that are beyond what their scans declare.
        beyond: Beyond,
    },
    /// Odometry is of another time than the scans.
    #[error(
        "its scans ({} to {} s) and its odometry ({} to {} s) have no time in common",
        fixed(scans[0], 3), fixed(scans[1], 3), fixed(odometry[0], 3), fixed(odometry[1], 3)
    )]
    NoCommonTime {
        /// First and last stamp of the scans \[s\].
        scans: [f64; 2],
        /// First and last stamp of the odometry \[s\].
        odometry: [f64; 2],
    },
    /// Odometry is too far from one scan to the next.
    #[error("its odometry jumps {} km from one scan to the next, at {} s", fixed(*kilometres, 1), fixed(*time, 3))]
    OdometryJumps {
        /// How far \[km\].
        kilometres: f64,
        /// When \[s\].
        time: f64,
    },
    /// A line of a file of relations is none.
    #[error("expected 8 numbers: t1 t2 x y z roll pitch yaw")]
    Relation,
    /// A file of relations has none.
    #[error("no line of 8 numbers: t1 t2 x y z roll pitch yaw")]
    NoRelation,
    /// A file that is read as a bag is none.
    #[error("it is neither an MCAP file nor a ROS 1 bag")]
    NoBag,
    /// A ROS 1 bag is older than all that are read.
    #[error("it is a ROS 1 bag of another format than 2.0: `rosbag migrate` or `rosbags-convert` makes one")]
    OldBag,
    /// A bag has no topic with scans.
    #[error("no sensor_msgs/LaserScan in it; there is {0}")]
    NoScanTopic(Topics),
    /// The topic that was asked for is not there or not the right one, or one must be named; in English.
    #[error("{0}")]
    Topic(String),
    /// A laser does not sweep a plan of the building.
    #[error("the laser {laser} is tilted against {robot} by more than 20°: its sweeps are no plan of a building")]
    Tilted {
        /// Frame of the laser.
        laser: String,
        /// Frame of the robot.
        robot: String,
    },
    /// A message of a bag cannot be used.
    #[error("{topic}: message {number} ({kind}) {problem}")]
    Message {
        /// Its topic.
        topic: String,
        /// Its number on that topic, from 1 on.
        number: u32,
        /// Its type.
        kind: String,
        /// What is wrong with it.
        problem: MessageProblem,
    },
    /// A bag ends within a record.
    #[error("it ends in the middle of a record: was its recording broken off?")]
    Truncated,
    /// Chunks of a bag are packed in a way that is not known here.
    #[error("its chunks are compressed by “{0}”; zstd, lz4 and bz2 can be read")]
    Compression(String),
    /// A bag is not built as it should be; in English, by those who know its format.
    #[error("{0}")]
    Damaged(String),
    /// What the writer of a log in JSON lines says of the log that it was made of.
    #[error("{0}")]
    Told(String),
}

/// What else a range must be, where that is what they are not.
fn in_reach(Beyond { count, shortest, max_range }: &Beyond) -> String {
    if *count == 0 {
        return String::new();
    }
    let [max_range, shortest] = [max_range, shortest].map(|metres| fixed(f64::from(*metres), 1));
    format!(
        " and up to range_max, {max_range} m; {count} are beyond it, the shortest of them {shortest}: are they in metres?"
    )
}

/// A field of a message, as it is called where it is missing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum Field {
    /// By its name, and its unit where it has one.
    Named(&'static str),
    /// A stamp.
    Time,
    /// The value of a parameter \[m\].
    Metres,
    /// The name of a parameter.
    Name,
    /// How many ranges follow.
    RangeCount,
    /// How many remissions follow.
    RemissionCount,
    /// One of the remissions.
    Remission,
    /// One of the ranges.
    Range {
        /// Which, from 1 on.
        number: u32,
        /// Of how many.
        of: u32,
    },
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Named(name) => name,
            Self::Time => "a time [s]",
            Self::Metres => "metres",
            Self::Name => "a name",
            Self::RangeCount => "the number of ranges",
            Self::RemissionCount => "the number of remissions",
            Self::Remission => "remissions",
            Self::Range { number, of } => return write!(f, "{of} ranges, of them number {number}"),
        })
    }
}

/// What is wrong with a message of a bag, in words that follow its name.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MessageProblem {
    /// It ends too early.
    #[error("is shorter than its type asks for")]
    Short,
    /// It has a pose that is none.
    #[error("has a pose that is no number, or a quaternion of zeros")]
    Pose,
    /// It has a transform that is none.
    #[error("has a transform that is no number")]
    Transform,
    /// A scan has no beams.
    #[error("has no ranges")]
    NoRanges,
    /// Angles of a scan are none in radians.
    #[error("expected angle_min and angle_increment in radians, found {} and {}", Shown(*first), Shown(*step))]
    Angles {
        /// Of the first beam \[rad\].
        first: f64,
        /// From one beam to the next \[rad\].
        step: f64,
    },
    /// It is encoded in a way that is not known here.
    #[error("is encoded as “{0}”; cdr and ros1 can be read")]
    Encoding(String),
    /// It is in another kind of CDR than the plain one.
    #[error("is in an encapsulation {:02x}{:02x} of CDR; plain CDR can be read", _0[0], _0[1])]
    Encapsulation([u8; 2]),
}

/// The topics of a bag, as far as a line holds them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Topics {
    /// Each with the number of its messages and their type.
    pub listed: Vec<String>,
    /// How many more there are.
    pub more: usize,
}

impl fmt::Display for Topics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.listed[..], self.more) {
            ([], _) => f.write_str("no topic at all"),
            (listed, 0) => f.write_str(&listed.join(", ")),
            (listed, more) => write!(f, "{}, and {more} more", listed.join(", ")),
        }
    }
}
