//! Lines of other formats, which may stand between those of CARMEN.

use super::Reader;
use super::words::Words;
use crate::LogProblem;
#[cfg(feature = "json")]
use crate::{LogError, Remark, json::Told};
use fastslam::geometry::Pose2;
use fastslam::ops;
use fastslam::sensor::LaserScan;

impl Reader {
    /// Takes what a line of JSON tells.
    #[cfg(feature = "json")]
    pub(super) fn told(&mut self, told: Told) {
        match told {
            Told::Scan(scan, told) => {
                if !scan.odometry.x.is_nan() {
                    self.odometry(scan.time, scan.odometry, told);
                }
                self.log.notes.beyond.add(&scan.ranges, scan.max_range);
                self.log.scans.push(scan);
            }
            Told::Remark(remark) => self.log.notes.remarks.push(Remark::Told(remark)),
            Told::Malformed(count, message) => {
                self.log.notes.malformed += count;
                self.log.notes.first_malformed.get_or_insert(LogError::whole(LogProblem::Told(message)));
            }
        }
    }

    /// Odometry as TUM's benchmarks write it: time x y z qx qy qz qw.
    pub(super) fn tum(&mut self, text: &str) -> Result<(), LogProblem> {
        let mut words = Words { words: text.split_ascii_whitespace(), kind: "" };
        let time = words.time()?;
        let [x, y, _, _, _, sin, cos] = {
            let mut numbers = [0.0; 7];
            for (number, name) in numbers.iter_mut().zip(["x", "y", "z", "qx", "qy", "qz", "qw"]) {
                *number = words.number(name)?;
            }
            numbers
        };
        if x.abs().max(y.abs()) > LaserScan::FARTHEST || (sin == 0.0 && cos == 0.0) {
            return Err(LogProblem::NoPose);
        }
        let theta = 2.0 * ops::atan2(sin, cos);
        self.odometry(time, Pose2::new(x, y, theta), [x, y, theta]);
        Ok(())
    }
}
