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

#[cfg(feature = "json")]
use super::json::Told;
use super::place::place;
use super::{FARTHEST, FARTHEST_JUMP, LaserLog, LaserScan, LogError, fixed};
use crate::error::Shown;
use crate::geometry::Pose2;
use crate::ops;
use core::f64::consts::PI;

/// A laser farther than this from the robot's centre \[m\] does not sit on it: then the two poses of a message are not what they
/// should be (some logs hold a corrected pose in one of them), and the laser is taken to be in the centre.
const LASER_REACH: f64 = 3.0;

/// Longest line \[bytes\]: ten thousand beams with their remissions take a tenth of it.
const LONGEST_LINE: usize = 1 << 20;

/// How much may come before the first scan \[bytes\]. What is no log, as a gigabyte of newlines, is not read to its end.
const MOST_BEFORE_SCAN: u64 = 64 << 20;

/// Reads a log that is in memory. A malformed line ends it with an error, or, if `lenient`, is counted and passed over.
///
/// # Errors
/// As those of [`LogReader`].
pub fn parse(bytes: &[u8], lenient: bool) -> Result<LaserLog, LogError> {
    let mut reader = LogReader::new(lenient);
    reader.push(bytes)?;
    reader.finish()
}

/// Reads a log piece by piece, as it comes from a file or a network: what stays in memory is the log as read (four bytes a range), and of
/// the text the line that is begun.
///
/// ```
/// use fastslam::log::LogReader;
/// let mut reader = LogReader::new(false);
/// for piece in ["FLASER 2 1.0 ", "2.0 0 0 0 0 0 0 1 host 1\nFLA", "SER 2 1.1 2.1 0 0 0 0.1 0 0 2 host 2"] {
///     reader.push(piece.as_bytes())?;
/// }
/// assert_eq!(reader.finish()?.scans.len(), 2);
/// # Ok::<(), fastslam::log::LogError>(())
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
        Self { reader: Reader::default(), lenient, begun: Vec::new(), passing: false, lines: 0, bytes: 0 }
    }

    /// The next bytes, cut anywhere.
    ///
    /// # Errors
    /// A malformed line, and what was expected there, unless the reader is lenient: one that is cut short, a scan without beams, with
    /// another number of beams than those before it, or farther than a kilometre from the one before it. With line 0, that 64 MB went by
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
                self.malformed(self.lines + 1, "expected a message, found a line of more than 1 MB".into())?;
            }
            if ends {
                self.end_line()?;
            }
        }
        if self.reader.log.scans.is_empty() && self.bytes > MOST_BEFORE_SCAN {
            return Err(self.no_scan(" in its first 64 MB"));
        }
        Ok(())
    }

    /// The log, with what is in it by time.
    ///
    /// # Errors
    /// As [`Self::push`], of the last line; with line 0, that there is no scan at all, or none that has met anything.
    pub fn finish(mut self) -> Result<LaserLog, LogError> {
        self.end_line()?;
        if self.reader.log.scans.is_empty() {
            return Err(self.no_scan(" in it"));
        }
        let mut log = self.reader.log;
        log.seen_something()?;
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
        self.reader.line(bytes).or_else(|message| self.malformed(self.lines, message))
    }

    fn malformed(&mut self, line: u32, message: String) -> Result<(), LogError> {
        let error = LogError { line, message };
        if !self.lenient {
            return Err(error);
        }
        self.reader.log.notes.malformed += 1;
        self.reader.log.notes.first_malformed.get_or_insert(error);
        Ok(())
    }

    fn no_scan(&self, place: &str) -> LogError {
        let but = match self.reader.log.notes.unknown.first() {
            Some((kind, _)) => format!(" (but {kind})"),
            None => String::new(),
        };
        LogError { line: 0, message: format!("no FLASER or ROBOTLASER1 message{place}{but}") }
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

#[derive(Default)]
struct Reader {
    log: LaserLog,
    /// `robot_frontlaser_offset`: how far ahead of the robot's centre the laser of FLASER sits \[m\].
    offset: f64,
    /// `robot_front_laser_max` \[m\].
    max_range: Option<f64>,
    /// Beams of the first scan of each kind of message: FLASER, ROBOTLASER1.
    beams: [Option<usize>; 2],
}

impl Reader {
    fn line(&mut self, bytes: &[u8]) -> Result<(), String> {
        let text =
            core::str::from_utf8(bytes).map_err(|_| "expected a message in plain text, found binary".to_owned())?;
        let mut words = Words { words: text.split_ascii_whitespace(), kind: "" };
        let Some(kind) = words.words.next() else { return Ok(()) };
        words.kind = kind;
        match kind {
            _ if kind.starts_with('#') => {}
            "FLASER" => self.front_laser(&mut words)?,
            "ROBOTLASER1" => self.robot_laser(&mut words)?,
            "ODOM" => {
                let pose = words.pose("x, y, theta")?;
                for name in ["tv", "rv", "accel"] {
                    words.number(name)?;
                }
                let time = words.time()?;
                self.log.odometry.push((time, pose));
            }
            "PARAM" => self.parameter(&mut words)?,
            #[cfg(feature = "json")]
            _ if kind.starts_with('{') => match super::json::read(text)? {
                Told::Scan(scan) => {
                    if !scan.odometry.x.is_nan() {
                        self.log.odometry.push((scan.time, scan.odometry));
                    }
                    self.log.scans.push(scan);
                }
                Told::Remark(remark) => self.log.notes.remarks.push(remark),
                Told::Malformed(count, message) => {
                    self.log.notes.malformed += count;
                    self.log.notes.first_malformed.get_or_insert(LogError { line: 0, message });
                }
            },
            _ if kind.parse::<f64>().is_ok_and(f64::is_finite) => self.tum(text)?,
            "RLASER" | "ROBOTLASER2" => self.log.notes.rear += 1,
            _ if kind.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-./".contains(&byte)) => {
                let unknown = &mut self.log.notes.unknown;
                match unknown.iter().position(|(name, _)| name == kind) {
                    Some(k) => unknown[k].1 += 1,
                    None if unknown.len() < MOST_KINDS => unknown.push((kind.into(), 1)),
                    None => return Err(format!("expected one of the known messages, found {}", shown(kind))),
                }
            }
            _ => return Err(format!("expected the name of a message, found {}", shown(kind))),
        }
        Ok(())
    }

    /// Odometry as TUM's benchmarks write it: time x y z qx qy qz qw.
    fn tum(&mut self, text: &str) -> Result<(), String> {
        let mut words = Words { words: text.split_ascii_whitespace(), kind: "a pose" };
        let time = words.time()?;
        let [x, y, _, _, _, sin, cos] = {
            let mut numbers = [0.0; 7];
            for (number, name) in numbers.iter_mut().zip(["x", "y", "z", "qx", "qy", "qz", "qw"]) {
                *number = words.number(name)?;
            }
            numbers
        };
        if x.abs().max(y.abs()) > FARTHEST || (sin == 0.0 && cos == 0.0) {
            return Err("a pose: expected one within 10000 km that turns about the vertical".into());
        }
        self.log.odometry.push((time, Pose2::new(x, y, 2.0 * ops::atan2(sin, cos))));
        Ok(())
    }

    fn front_laser(&mut self, words: &mut Words<'_>) -> Result<(), String> {
        let ranges = words.ranges()?;
        words.pose("x, y, theta")?;
        let odometry = words.pose("odom_x, odom_y, odom_theta")?;
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
        self.take(scan, words.kind)
    }

    fn robot_laser(&mut self, words: &mut Words<'_>) -> Result<(), String> {
        words.number("laser_type")?;
        let first_angle = words.number("start_angle [rad]")?;
        words.number("field_of_view [rad]")?;
        let angle_step = words.number("angular_resolution [rad]")?;
        let max_range = words.number("maximum_range [m]")?;
        if first_angle.abs() > 2.0 * PI || angle_step.abs() > PI || angle_step == 0.0 {
            let found = [first_angle, angle_step].map(|x| Shown(x).to_string()).join(" and ");
            return Err(format!("{}: expected angles in radians, found {found}", words.kind));
        }
        words.number("accuracy")?;
        words.number("remission_mode")?;
        let ranges = words.ranges()?;
        let remissions = words.count("remissions")?;
        for _ in 0..remissions {
            words.word("remissions")?;
        }
        let laser = words.pose("laser_x, laser_y, laser_theta")?;
        let odometry = words.pose("robot_x, robot_y, robot_theta")?;
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
        self.take(scan, words.kind)
    }

    /// Takes a scan that goes with those before it.
    fn take(&mut self, scan: LaserScan, kind: &str) -> Result<(), String> {
        let count = scan.ranges.len();
        if count == 0 {
            return Err(format!("{kind}: expected ranges, found 0 of them"));
        }
        let beams = *self.beams[usize::from(kind == "ROBOTLASER1")].get_or_insert(count);
        if count != beams {
            return Err(format!("{kind}: expected {beams} ranges as in the scans before, found {count}"));
        }
        if let Some(last) = self.log.scans.last() {
            let jump = last.odometry.distance(&scan.odometry);
            if jump > FARTHEST_JUMP {
                let kilometres = fixed(1e-3 * jump, 1);
                return Err(format!(
                    "{kind}: expected a pose within 1 km of the scan before, found one {kilometres} km away"
                ));
            }
        }
        self.log.odometry.push((scan.time, scan.odometry));
        self.log.scans.push(scan);
        Ok(())
    }

    fn parameter(&mut self, words: &mut Words<'_>) -> Result<(), String> {
        match words.word("a name")? {
            "robot_frontlaser_offset" => self.offset = words.number("metres")?.clamp(-LASER_REACH, LASER_REACH),
            "robot_front_laser_max" => self.max_range = Some(words.number("metres")?).filter(|range| *range > 0.0),
            _ => {} // a value may be anything, or nothing
        }
        Ok(())
    }
}

/// Beams that room is made for before they are read.
const MOST_BEAMS: u32 = 4096;

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

/// The words of one message.
struct Words<'a> {
    words: core::str::SplitAsciiWhitespace<'a>,
    kind: &'a str,
}

impl<'a> Words<'a> {
    fn word(&mut self, name: &str) -> Result<&'a str, String> {
        self.words.next().ok_or_else(|| format!("{}: expected {name}, found the end of the line", self.kind))
    }

    /// A finite number.
    fn number(&mut self, name: &str) -> Result<f64, String> {
        let word = self.word(name)?;
        word.parse::<f64>()
            .ok()
            .filter(|x| x.is_finite())
            .ok_or_else(|| format!("{}: expected {name}, found {}", self.kind, shown(word)))
    }

    fn count(&mut self, name: &str) -> Result<u32, String> {
        let word = self.word(&format!("the number of {name}"))?;
        word.parse().map_err(|_| format!("{}: expected the number of {name}, found {}", self.kind, shown(word)))
    }

    /// A count, and as many ranges. What a laser writes for *nothing met* (nan, inf) is kept as infinite.
    fn ranges(&mut self) -> Result<Vec<f32>, String> {
        let count = self.count("ranges")?;
        let mut ranges = Vec::with_capacity(count.min(MOST_BEAMS) as usize); // it may say anything
        for k in 0..count {
            let name = || format!("{count} ranges, of them number {}", k + 1);
            let word = self.word(&name())?;
            let range = match word.parse::<f64>().ok().filter(|range| !range.is_nan()) {
                Some(range) => range as f32,
                None if is_no_number(word) => f32::INFINITY,
                None => return Err(format!("{}: expected {}, found {}", self.kind, name(), shown(word))),
            };
            ranges.push(range);
        }
        Ok(ranges)
    }

    fn pose(&mut self, names: &str) -> Result<Pose2, String> {
        let [x, y, theta] = [self.number(names)?, self.number(names)?, self.number(names)?];
        if x.abs().max(y.abs()) > FARTHEST || theta.abs() > FARTHEST {
            let found = [x, y, theta].map(|x| Shown(x).to_string()).join(" ");
            return Err(format!("{}: expected {names} within 10000 km and as many turns, found {found}", self.kind));
        }
        Ok(Pose2::new(x, y, theta))
    }

    /// The first stamp at the end of the line.
    fn time(&mut self) -> Result<f64, String> {
        self.number("a time [s]")
    }
}

fn is_no_number(word: &str) -> bool {
    let unsigned = word.trim_start_matches(['-', '+']);
    ["nan", "inf", "infinity"].iter().any(|name| unsigned.eq_ignore_ascii_case(name))
}

/// A word as a message shows it: the start of it, without control characters.
fn shown(word: &str) -> String {
    const MOST: usize = 24;
    let start: String = word.chars().take(MOST).flat_map(char::escape_debug).collect();
    if word.chars().count() > MOST { format!("“{start}…”") } else { format!("“{start}”") }
}
