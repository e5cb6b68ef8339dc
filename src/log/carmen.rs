//! Logs of CARMEN, the Carnegie Mellon robot navigation toolkit: one message a line, words between blanks.
//!
//! ```text
//! ODOM x y theta tv rv accel time host logger_time
//! FLASER n range… x y theta odom_x odom_y odom_theta time host logger_time
//! ROBOTLASER1 type first_angle field_of_view angle_step max_range accuracy remission_mode n range… m remission…
//!     laser_x laser_y laser_theta robot_x robot_y robot_theta tv rv forward_safety side_safety turn_axis time host logger_time
//! PARAM name value …
//! ```
//!
//! Reference: the file format of CARMEN's logger, as its log files describe it in their own comments.

mod others;
mod words;

use self::words::{Words, shown};
use super::heading::in_radians;
#[cfg(feature = "json")]
use super::json::ReadLine;
use super::number::number;
use super::place::place;
use super::{Field, LaserLog, LogError, LogProblem};
use core::f64::consts::PI;
use fastslam::error::fixed;
use fastslam::geometry::Pose2;
use fastslam::sensor::LaserScan;

/// A laser farther than this from the robot's centre \[m\] does not sit on it: then the two poses of a message are not what they
/// should be (some logs hold a corrected pose in one of them), and the laser is taken to be in the centre.
const LASER_REACH: f64 = 3.0;

/// Longest line \[bytes\]: ten thousand beams with their remissions take a tenth of it.
const LONGEST_LINE: usize = 1 << 20;

/// How much may come before the first scan \[bytes\]. What is no log, as a gigabyte of newlines, is not read to its end.
const MOST_BEFORE_SCAN: u64 = MEGABYTES_BEFORE_SCAN << 20;
const MEGABYTES_BEFORE_SCAN: u64 = 64;

/// Reads a log that is in memory. A malformed line ends it with an error, or, if `lenient`, is counted and passed over.
///
/// # Errors
/// As those of [`LogReader`].
pub fn parse(bytes: &[u8], lenient: bool) -> Result<LaserLog, LogError> {
    read(LogReader::new(lenient), bytes)
}

/// Reads a log as [`parse`] does, for programs that are to be lighter without a reader of JSON: a line of JSON is malformed.
///
/// # Errors
/// As those of [`LogReader`].
pub fn parse_carmen(bytes: &[u8], lenient: bool) -> Result<LaserLog, LogError> {
    read(LogReader::of(Reader::default(), lenient), bytes)
}

fn read(mut reader: LogReader, bytes: &[u8]) -> Result<LaserLog, LogError> {
    reader.push(bytes)?;
    reader.finish()
}

/// Reads a log piece by piece, as it comes from a file or a network: what stays in memory is the log as read (four bytes a range), and of
/// the text the line that is begun.
///
/// ```
/// use fastslam_log::LogReader;
/// let mut reader = LogReader::new(false);
/// for piece in ["FLASER 2 1.0 ", "2.0 0 0 0 0 0 0 1 host 1\nFLA", "SER 2 1.1 2.1 0 0 0 0.1 0 0 2 host 2"] {
///     reader.push(piece.as_bytes())?;
/// }
/// assert_eq!(reader.finish()?.scans.len(), 2);
/// # Ok::<(), fastslam_log::LogError>(())
/// ```
pub struct LogReader {
    reader: Reader,
    lenient: bool,
    /// The line that is begun.
    begun: Vec<u8>,
    /// Whether the line that is begun was too long: the rest of it is passed over.
    passing: bool,
    lines: u32,
    bytes: u64,
}

impl LogReader {
    /// For a log of which nothing has been read. A malformed line ends it with an error, or, if `lenient`, is counted and passed over.
    pub fn new(lenient: bool) -> Self {
        #[cfg(feature = "json")]
        let reader = Reader { json: Some(super::json::read), ..Reader::default() };
        #[cfg(not(feature = "json"))]
        let reader = Reader::default();
        Self::of(reader, lenient)
    }

    fn of(reader: Reader, lenient: bool) -> Self {
        Self { reader, lenient, begun: Vec::new(), passing: false, lines: 0, bytes: 0 }
    }

    /// The next bytes, cut anywhere.
    ///
    /// # Errors
    /// A malformed line, and what was expected there, unless the reader is lenient: one that is cut short, a scan without beams, with
    /// (but for ROBOTLASER1) another number of beams than those before it, or farther than a kilometre from the one before it. With line 0, that 64 MB went by
    /// without a scan.
    pub fn push(&mut self, bytes: &[u8]) -> Result<(), LogError> {
        self.bytes += bytes.len() as u64;
        let mut pieces = bytes.split(|byte| *byte == b'\n').peekable();
        while let Some(piece) = pieces.next() {
            let ends = pieces.peek().is_some();
            if ends && !self.passing && self.begun.is_empty() && piece.len() <= LONGEST_LINE {
                self.line(piece)?;
                continue;
            }
            if self.begun.len() + piece.len() <= LONGEST_LINE {
                self.begun.extend_from_slice(piece);
            } else if !self.passing {
                self.begun = Vec::new();
                self.passing = true;
                self.malformed(self.lines + 1, LogProblem::LongLine)?;
            }
            if ends {
                self.end_line()?;
            }
        }
        if self.reader.log.scans.is_empty() && self.bytes > MOST_BEFORE_SCAN {
            let but = self.other_kind();
            return Err(LogError::whole(LogProblem::NoScanSoon { megabytes: MEGABYTES_BEFORE_SCAN, but }));
        }
        Ok(())
    }

    /// Ends one of several files that are a log together. The next bytes are those of the next file, whose lines are counted from 1 again.
    ///
    /// # Errors
    /// As [`Self::push`], of the last line.
    pub fn end_part(&mut self) -> Result<(), LogError> {
        self.end_line()?;
        self.lines = 0;
        Ok(())
    }

    /// Number of scans read so far.
    pub fn scans(&self) -> usize {
        self.reader.log.scans.len()
    }

    /// The log, with what is in it by time.
    ///
    /// # Errors
    /// As [`Self::push`], of the last line. Where there is no scan at all, the first malformed line that was passed over; with line 0, that there is no scan,
    /// or none that has met anything.
    pub fn finish(mut self) -> Result<LaserLog, LogError> {
        self.end_line()?;
        if self.reader.log.scans.is_empty() {
            // What could not be read tells more than what is not there.
            if let Some(first) = self.reader.log.notes.first_malformed.take() {
                return Err(first);
            }
            return Err(LogError::whole(LogProblem::NoScan { but: self.other_kind() }));
        }
        let Reader { mut log, told, places_laser, .. } = self.reader;
        log.seen_something()?;
        if !places_laser {
            in_radians(&mut log, &told);
        }
        log.in_order();
        place(&mut log)?;
        Ok(log)
    }

    fn end_line(&mut self) -> Result<(), LogError> {
        let (line, passed) = (core::mem::take(&mut self.begun), core::mem::take(&mut self.passing));
        if passed {
            self.lines += 1;
            return Ok(());
        }
        let read = self.line(&line);
        self.begun = line; // with the room that it has
        self.begun.clear();
        read
    }

    fn line(&mut self, bytes: &[u8]) -> Result<(), LogError> {
        self.lines += 1;
        self.reader.line(bytes).or_else(|problem| self.malformed(self.lines, problem))
    }

    fn malformed(&mut self, line: u32, problem: LogProblem) -> Result<(), LogError> {
        let error = LogError { line, problem };
        if !self.lenient {
            return Err(error);
        }
        self.reader.log.notes.malformed += 1;
        self.reader.log.notes.first_malformed.get_or_insert(error);
        Ok(())
    }

    /// What the log has instead of scans.
    fn other_kind(&self) -> Option<String> {
        self.reader.log.notes.unknown.first().map(|(kind, _)| kind.clone())
    }
}

/// The scans of a log as FLASER messages, which [`parse`] reads back: ranges to a centimetre, poses to a millimetre, angles to a
/// ten-thousandth. For lasers in the robot's centre that sweep half a circle.
pub fn write(log: &LaserLog) -> String {
    let mut text = String::new();
    for scan in &log.scans {
        let Pose2 { x, y, theta } = scan.odometry;
        let pose = [fixed(x, 3), fixed(y, 3), fixed(theta, 4)].join(" ");
        let time = fixed(scan.time, 2);
        text.push_str("FLASER ");
        text.push_str(&scan.ranges.len().to_string());
        for range in &scan.ranges {
            text.push(' ');
            text.push_str(&fixed(f64::from(*range), 2));
        }
        text.push_str(&[" ", &pose, " ", &pose, " ", &time, " - ", &time, "\n"].concat());
    }
    text
}

const FRONT: &str = "FLASER";
const ROBOT: &str = "ROBOTLASER1";

#[derive(Default)]
struct Reader {
    /// What reads a line of JSON, where one may come.
    #[cfg(feature = "json")]
    json: Option<ReadLine>,
    log: LaserLog,
    /// `robot_frontlaser_offset`: how far ahead of the robot's centre the laser of FLASER sits \[m\].
    offset: f64,
    /// `robot_front_laser_max` \[m\].
    max_range: Option<f64>,
    /// Beams of the first FLASER.
    beams: Option<usize>,
    /// Each pose of the odometry as it is told, before its heading is wrapped.
    told: Vec<[f64; 3]>,
    /// Whether there is a ROBOTLASER1, of which both headings, of robot and laser, would have to be read anew: its headings stay radians.
    places_laser: bool,
}

impl Reader {
    fn line(&mut self, bytes: &[u8]) -> Result<(), LogProblem> {
        /// The byte-order mark of UTF-8, which some editors write in front of a text.
        const MARK: &[u8] = b"\xef\xbb\xbf";
        let bytes = bytes.strip_prefix(MARK).unwrap_or(bytes);
        let text = core::str::from_utf8(bytes).map_err(|_| LogProblem::Binary)?;
        let mut words = text.split_ascii_whitespace();
        let Some(kind) = words.next() else { return Ok(()) };
        #[cfg(feature = "json")]
        if let Some(read) = self.json
            && kind.starts_with('{')
        {
            return read(text).map(|told| self.told(told));
        }
        let of = |kind| Words { words, kind };
        match kind {
            _ if kind.starts_with('#') => {}
            "FLASER" => self.front_laser(of(FRONT))?,
            "ROBOTLASER1" => self.robot_laser(of(ROBOT))?,
            "ODOM" => {
                let mut words = of("ODOM");
                let (pose, told) = words.pose("x, y, theta")?;
                for name in ["tv", "rv", "accel"] {
                    words.number(name)?;
                }
                let time = words.time()?;
                self.odometry(time, pose, told);
            }
            "PARAM" => self.parameter(of("PARAM"))?,
            _ if number(kind).is_some_and(f64::is_finite) => self.tum(text)?,
            "RLASER" | "ROBOTLASER2" => self.log.notes.rear += 1,
            _ if kind.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-./".contains(&byte)) => {
                let unknown = &mut self.log.notes.unknown;
                match unknown.iter().position(|(name, _)| name == kind) {
                    Some(k) => unknown[k].1 += 1,
                    None if unknown.len() < MOST_KINDS => unknown.push((kind.into(), 1)),
                    None => return Err(LogProblem::UnknownMessage(shown(kind))),
                }
            }
            _ => return Err(LogProblem::NoMessage(shown(kind))),
        }
        Ok(())
    }

    fn front_laser(&mut self, mut words: Words<'_>) -> Result<(), LogProblem> {
        let ranges = words.ranges()?;
        words.pose("x, y, theta")?;
        let (odometry, told) = words.pose("odom_x, odom_y, odom_theta")?;
        let time = words.time()?;
        let (first_angle, angle_step) = fan(ranges.len());
        let scan = LaserScan {
            time,
            odometry,
            robot_from_laser: Pose2::new(self.offset, 0.0, 0.0),
            first_angle,
            angle_step,
            max_range: self.max_range,
            ranges,
        };
        self.take(scan, told, words.kind)
    }

    fn robot_laser(&mut self, mut words: Words<'_>) -> Result<(), LogProblem> {
        words.number("laser_type")?;
        let first_angle = words.number("start_angle [rad]")?;
        words.number("field_of_view [rad]")?;
        let angle_step = words.number("angular_resolution [rad]")?;
        let max_range = words.number("maximum_range [m]")?;
        if first_angle.abs() > 2.0 * PI || angle_step.abs() > PI || angle_step == 0.0 {
            return Err(LogProblem::Angles { message: words.kind, first: first_angle, step: angle_step });
        }
        words.number("accuracy")?;
        words.number("remission_mode")?;
        let ranges = words.ranges()?;
        let remissions = words.count(Field::RemissionCount)?;
        for _ in 0..remissions {
            words.word(Field::Remission)?;
        }
        let (laser, _) = words.pose("laser_x, laser_y, laser_theta")?;
        let (odometry, told) = words.pose("robot_x, robot_y, robot_theta")?;
        self.places_laser = true;
        for name in ["tv", "rv", "forward_safety_dist", "side_safety_dist", "turn_axis"] {
            words.number(name)?;
        }
        let time = words.time()?;
        let robot_from_laser = odometry.between(&laser);
        let mounted = odometry.distance(&laser) < LASER_REACH;
        let scan = LaserScan {
            time,
            odometry,
            robot_from_laser: if mounted { robot_from_laser } else { Pose2::default() },
            first_angle,
            angle_step,
            max_range: Some(max_range).filter(|range| *range > 0.0),
            ranges,
        };
        self.take(scan, told, words.kind)
    }

    /// Takes a pose of the odometry, and what is told of it.
    fn odometry(&mut self, time: f64, pose: Pose2, told: [f64; 3]) {
        self.log.odometry.push((time, pose));
        self.told.push(told);
    }

    /// Takes a scan that goes with those before it.
    fn take(&mut self, scan: LaserScan, told: [f64; 3], message: &'static str) -> Result<(), LogProblem> {
        let count = scan.ranges.len();
        if count == 0 {
            return Err(LogProblem::NoRanges { message });
        }
        // Only a scan that says itself where its beams are may have another number of them: some lasers change it with every turn.
        let beams = if message == ROBOT { count } else { *self.beams.get_or_insert(count) };
        if count != beams {
            return Err(LogProblem::OtherRanges { message, before: beams, found: count });
        }
        if let Some(last) = self.log.scans.last() {
            let jump = last.odometry.distance(&scan.odometry);
            if jump > LaserScan::FARTHEST_JUMP {
                return Err(LogProblem::Jump { message, kilometres: 1e-3 * jump });
            }
        }
        self.odometry(scan.time, scan.odometry, told);
        self.log.scans.push(scan);
        Ok(())
    }

    fn parameter(&mut self, mut words: Words<'_>) -> Result<(), LogProblem> {
        match words.word(Field::Name)? {
            "robot_frontlaser_offset" => self.offset = words.value(Field::Metres)?.clamp(-LASER_REACH, LASER_REACH),
            "robot_front_laser_max" => self.max_range = Some(words.value(Field::Metres)?).filter(|range| *range > 0.0),
            _ => {} // a value may be anything, or nothing
        }
        Ok(())
    }
}

/// Kinds of unknown messages that are counted apart: a log has a few, a file of another sort has no end of them.
const MOST_KINDS: usize = 64;

/// Direction of the first beam and the angle between beams \[rad\] of a message that says only how many there are.
///
/// The lasers of the time swept half a circle, or 100° at a quarter of a degree. An odd number of beams has one at each end;
/// an even number leaves the last out.
fn fan(count: usize) -> (f64, f64) {
    let degrees = if [100, 101, 200, 201, 400, 401].contains(&count) { 100.0 } else { 180.0 };
    let field_of_view = degrees * PI / 180.0;
    (-0.5 * field_of_view, field_of_view / (count - count % 2).max(1) as f64)
}
