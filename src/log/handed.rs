//! A log that one program has read, as bytes for another that knows nothing of its format: every bit of the scans and of the odometry, and
//! what was noted, in words.
//!
//! Numbers are little-endian, counts of 32 bits stand before what they count, texts are UTF-8. Both programs are of one version: there is no
//! promise about any other.

use super::{Beyond, LaserLog, LogError, LogProblem, Notes, Remark};
use fastslam::geometry::Pose2;
use fastslam::sensor::LaserScan;

/// No text begins so: the first byte is never one of UTF-8.
const MAGIC: [u8; 8] = *b"\xffFASTLOG";

impl LaserLog {
    /// The log as bytes, which [`Self::from_bytes`] reads. Of a problem and of each remark only the English words are kept: whoever speaks
    /// another language puts its words there before, as [`LogProblem::Told`] and [`Remark::Told`].
    pub fn to_bytes(&self) -> Vec<u8> {
        let Self { scans, odometry, notes } = self;
        let mut bytes = Bytes(MAGIC.to_vec());
        bytes.each(scans, |bytes, scan| {
            bytes.f64(scan.time);
            bytes.pose(&scan.odometry);
            bytes.pose(&scan.robot_from_laser);
            bytes.f64(scan.first_angle);
            bytes.f64(scan.angle_step);
            bytes.f64(scan.max_range.unwrap_or(f64::NAN));
            bytes.each(&scan.ranges, |bytes, range| bytes.f32(*range));
        });
        bytes.each(odometry, |bytes, (time, pose)| {
            bytes.f64(*time);
            bytes.pose(pose);
        });
        let Notes { rear, unknown, malformed, first_malformed, out_of_order, beyond, lost, remarks } = notes;
        [*rear, *malformed, *out_of_order, beyond.count].into_iter().for_each(|count| bytes.u32(count));
        [beyond.shortest, beyond.max_range].into_iter().for_each(|metres| bytes.f32(metres));
        bytes.each(unknown, |bytes, (kind, count)| {
            bytes.text(kind);
            bytes.u32(*count);
        });
        bytes.each(first_malformed.as_slice(), |bytes, first| {
            bytes.u32(first.line);
            bytes.text(&first.problem.to_string());
        });
        bytes.each(lost, |bytes, time| bytes.f64(*time));
        bytes.each(remarks, |bytes, remark| bytes.text(&remark.to_string()));
        bytes.0
    }

    /// The log that [`Self::to_bytes`] wrote; `None` of what is not one.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let mut rest = Rest(bytes.strip_prefix(&MAGIC)?);
        let scans = rest.each(|rest| {
            Some(LaserScan {
                time: rest.f64()?,
                odometry: rest.pose()?,
                robot_from_laser: rest.pose()?,
                first_angle: rest.f64()?,
                angle_step: rest.f64()?,
                max_range: Some(rest.f64()?).filter(|range| !range.is_nan()),
                ranges: rest.each(Rest::f32)?,
            })
        })?;
        let odometry = rest.each(|rest| Some((rest.f64()?, rest.pose()?)))?;
        let [rear, malformed, out_of_order, count] = [rest.u32()?, rest.u32()?, rest.u32()?, rest.u32()?];
        let beyond = Beyond { count, shortest: rest.f32()?, max_range: rest.f32()? };
        let unknown = rest.each(|rest| Some((rest.text()?, rest.u32()?)))?;
        let first = rest.each(|rest| Some(LogError { line: rest.u32()?, problem: LogProblem::Told(rest.text()?) }))?;
        let first_malformed = first.into_iter().next();
        let lost = rest.each(Rest::f64)?;
        let remarks = rest.each(|rest| Some(Remark::Told(rest.text()?)))?;
        let notes = Notes { rear, unknown, malformed, first_malformed, out_of_order, beyond, lost, remarks };
        rest.0.is_empty().then_some(Self { scans, odometry, notes })
    }
}

/// What is written.
struct Bytes(Vec<u8>);

impl Bytes {
    fn u32(&mut self, x: u32) {
        self.0.extend(x.to_le_bytes());
    }

    fn f32(&mut self, x: f32) {
        self.0.extend(x.to_le_bytes());
    }

    fn f64(&mut self, x: f64) {
        self.0.extend(x.to_le_bytes());
    }

    fn pose(&mut self, pose: &Pose2) {
        [pose.x, pose.y, pose.theta].into_iter().for_each(|x| self.f64(x));
    }

    fn text(&mut self, text: &str) {
        self.u32(text.len() as u32);
        self.0.extend(text.as_bytes());
    }

    fn each<T>(&mut self, things: &[T], write: impl Fn(&mut Self, &T)) {
        self.u32(things.len() as u32);
        things.iter().for_each(|thing| write(self, thing));
    }
}

/// What is left to read.
struct Rest<'a>(&'a [u8]);

impl Rest<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*taken)
    }

    fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    fn f32(&mut self) -> Option<f32> {
        self.take().map(f32::from_le_bytes)
    }

    fn f64(&mut self) -> Option<f64> {
        self.take().map(f64::from_le_bytes)
    }

    fn pose(&mut self) -> Option<Pose2> {
        Some(Pose2 { x: self.f64()?, y: self.f64()?, theta: self.f64()? })
    }

    fn text(&mut self) -> Option<String> {
        String::from_utf8(self.each(|rest| rest.take().map(|[byte]| byte))?).ok()
    }

    fn each<T>(&mut self, read: impl Fn(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let count = self.u32()?;
        // It may say anything: no room is made before there is something to put there.
        (0..count).map(|_| read(self)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log() -> LaserLog {
        let scan = |time: f64, ranges: &[f32]| LaserScan {
            time,
            odometry: Pose2 { x: 0.1 + time, y: -0.0, theta: 3.0 },
            robot_from_laser: Pose2 { x: 0.1, y: 1e-300, theta: -3.1 },
            first_angle: -0.1,
            angle_step: 0.2,
            max_range: (time > 1.0).then_some(f64::INFINITY),
            ranges: ranges.into(),
        };
        let told = |words: &str| LogProblem::Told(words.into());
        LaserLog {
            scans: vec![scan(0.3, &[f32::INFINITY, 0.1, -0.0]), scan(1.3e9 + 0.1, &[])],
            odometry: vec![(0.3, Pose2 { x: f64::NEG_INFINITY, y: 5e-324, theta: 0.0 }), (0.4, Pose2::default())],
            notes: Notes {
                rear: 1,
                unknown: vec![("SYNC".into(), 2), (String::new(), 3)],
                malformed: 4,
                first_malformed: Some(LogError { line: 5, problem: told("two\nlines, “ü”") }),
                out_of_order: 6,
                beyond: Beyond { count: 7, shortest: 8.5, max_range: 8.0 },
                lost: vec![9.25],
                remarks: vec![Remark::Told("one".into()), Remark::Told("two".into())],
            },
        }
    }

    #[test]
    fn a_log_is_read_back_as_it_was_to_the_bit() {
        // Debug tells the two zeros apart.
        for log in [log(), LaserLog::default()] {
            assert_eq!(format!("{:?}", LaserLog::from_bytes(&log.to_bytes()).unwrap()), format!("{log:?}"));
        }
        let nowhere = |x: f64| {
            let mut log = log();
            log.scans[0].odometry.x = x;
            log.scans[0].ranges[1] = x as f32;
            log
        };
        let again = LaserLog::from_bytes(&nowhere(f64::NAN).to_bytes()).unwrap();
        assert!(again.scans[0].odometry.x.is_nan() && again.scans[0].ranges[1].is_nan());
    }

    #[test]
    fn what_was_noted_is_read_back_in_words() {
        let mut log = log();
        log.notes.first_malformed = Some(LogError { line: 2, problem: LogProblem::NoPose });
        log.notes.remarks = vec![Remark::Beyond(2)];
        let notes = LaserLog::from_bytes(&log.to_bytes()).unwrap().notes;
        let told = LogProblem::Told(LogProblem::NoPose.to_string());
        assert_eq!(notes.first_malformed, Some(LogError { line: 2, problem: told }));
        assert_eq!(notes.remarks, [Remark::Told(Remark::Beyond(2).to_string())]);
    }

    #[test]
    fn what_is_cut_off_or_goes_on_is_no_log() {
        let bytes = log().to_bytes();
        assert!((0..bytes.len()).all(|end| LaserLog::from_bytes(&bytes[..end]).is_none()));
        assert_eq!(LaserLog::from_bytes(&[&bytes[..], b"\0"].concat()), None);
        assert_eq!(LaserLog::from_bytes(&[&MAGIC[..], &[0xff; 4]].concat()), None, "more scans than there are bytes");
        assert_eq!(LaserLog::from_bytes(b"FLASER 2 1 2 0 0 0 0 0 0 1 h 1"), None);
    }
}
