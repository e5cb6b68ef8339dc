//! Readings that are one number again and again: what a driver writes for an error, and no range.

use super::LaserLog;
use crate::ascending::ascending;
use fastslam::sensor::longest_reading;

/// No wall is at one distance, to the last digit, for more than this share of all beams.
const SHARE: f64 = 0.02;

/// It is read so many times as often as the next shorter number and the next longer one: ranges that are rounded make steps, and no peak.
const PEAK: usize = 10;

/// From this share of the longest reading on readings say *nothing met*, whatever they are.
const NOTHING_MET: f64 = 0.97;

impl LaserLog {
    /// Takes readings out that are one number, shorter than what stands for *nothing met*, much too often to be a range. Each of these numbers \[m\] and how
    /// often it was read.
    pub fn leave_constants_out(&mut self) -> Vec<(f32, usize)> {
        let longest = (NOTHING_MET * longest_reading(&self.scans)) as f32;
        let is_range = |range: &f32| *range > 0.0 && *range < longest;
        let ranges: Vec<f32> = self.scans.iter().flat_map(|scan| &scan.ranges).copied().filter(is_range).collect();
        let (all, ranges) = (ranges.len(), ascending(ranges));
        let numbers: Vec<(f32, usize)> = ranges.chunk_by(|a, b| a == b).map(|same| (same[0], same.len())).collect();
        let count = |k: Option<usize>| k.and_then(|k| numbers.get(k)).map_or(0, |(_, count)| *count);
        let is_peak = |k: usize| {
            let beside = count(k.checked_sub(1)).max(count(Some(k + 1)));
            numbers[k].1 as f64 > SHARE * all as f64 && numbers[k].1 > PEAK * beside
        };
        // Of few numbers each is a peak: a drawing, or a test.
        let constants: Vec<(f32, usize)> = match numbers.len() > all / 1000 + PEAK {
            true => (0..numbers.len()).filter(|k| is_peak(*k)).map(|k| numbers[k]).collect(),
            false => Vec::new(),
        };
        for range in self.scans.iter_mut().flat_map(|scan| &mut scan.ranges) {
            if constants.iter().any(|(constant, _)| constant == range) {
                *range = f32::NAN;
            }
        }
        constants
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::geometry::Pose2;
    use fastslam::sensor::LaserScan;

    /// Scans of 60 beams between 1 and 8 m, rounded to so many steps a metre, of which each 20th is `constant`.
    fn log(steps: f32, constant: f32) -> LaserLog {
        let range = |k: u32| ((1.0 + (k * 7919 % 7001) as f32 / 1000.0) * steps).round() / steps;
        let scan = |number: u32| LaserScan {
            time: f64::from(number),
            odometry: Pose2::default(),
            robot_from_laser: Pose2::default(),
            first_angle: 0.0,
            angle_step: 0.01,
            max_range: None,
            ranges: (60 * number..60 * number + 60).map(|k| if k % 20 == 7 { constant } else { range(k) }).collect(),
        };
        LaserLog { scans: (0..100).map(scan).collect(), ..LaserLog::default() }
    }

    #[test]
    fn a_number_that_is_read_too_often_is_no_range() {
        for constant in [0.05, 2.5, 5.0, 7.0005] {
            let mut spoilt = log(1000.0, constant);
            let found = spoilt.leave_constants_out();
            assert!(matches!(found[..], [(number, 300..=305)] if number == constant), "{constant}: {found:?}");
            assert!(spoilt.scans.iter().flat_map(|scan| &scan.ranges).all(|range| *range != constant));
        }
    }

    #[test]
    fn a_number_that_is_read_seldom_is_a_range_and_so_are_those_of_a_drawing() {
        let mut seldom = log(1000.0, 2.5);
        for scan in seldom.scans.iter_mut().skip(20) {
            for range in scan.ranges.iter_mut().filter(|range| **range == 2.5) {
                *range = 4.0 + *range * scan.time as f32 / 1e4;
            }
        }
        let mut drawn = log(1000.0, 2.5);
        for range in drawn.scans.iter_mut().flat_map(|scan| &mut scan.ranges) {
            *range = if *range < 4.0 { 1.0 } else { 5.0 };
        }
        for mut good in [seldom, drawn] {
            let before = good.clone();
            assert_eq!(good.leave_constants_out(), []);
            assert_eq!(good, before);
        }
    }

    #[test]
    fn neither_what_met_nothing_nor_what_is_rounded_is_taken_for_an_error() {
        for (steps, constant) in [(1000.0, 81.83), (1000.0, 0.0), (4.0, 2.5), (20.0, 3.0), (1000.0, f32::INFINITY)] {
            let mut good = log(steps, constant);
            let before = good.clone();
            assert_eq!(good.leave_constants_out(), [], "{steps}, {constant}");
            assert_eq!(good, before);
        }
    }
}
