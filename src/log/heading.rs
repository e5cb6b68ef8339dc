//! Headings that are told in degrees.

use super::{LaserLog, Remark};
use core::f64::consts::PI;
use core::ops::Range;
use fastslam::geometry::Pose2;
use fastslam::ops;

/// Least share of the way that is driven in one direction of the robot, ahead or back, with headings as what they are; more than this with headings as what they
/// are not is a coincidence.
const ALONG: [f64; 2] = [0.8, 0.5];

const DEGREE: f64 = PI / 180.0;

/// Fewer motions are no evidence.
const ENOUGH: usize = 10;

/// Reads the headings of a log, or of one stretch of it, as degrees, if that is what they are.
pub(super) fn in_radians(log: &mut LaserLog, told: &[[f64; 3]]) {
    let Some(degrees) = in_degrees(told) else { return };
    log.notes.remarks.push(if degrees.len() == told.len() {
        Remark::HeadingsInDegrees
    } else {
        let [from, to] = [degrees.start, degrees.end - 1].map(|k| log.odometry[k].0);
        Remark::SomeHeadingsInDegrees { from, to }
    });
    let mut poses = log.odometry.iter_mut().zip(told).enumerate();
    let put = |k: usize, pose: &mut Pose2, heading: f64| {
        if degrees.contains(&k) {
            pose.theta = ops::wrap_angle(heading * PI / 180.0);
        }
    };
    // Each scan that is told with a pose comes in the order of these poses.
    for scan in log.scans.iter_mut().filter(|scan| !scan.odometry.x.is_nan()) {
        for (k, ((time, pose), [_, _, heading])) in poses.by_ref() {
            let is_of_scan = *time == scan.time && *pose == scan.odometry;
            put(k, pose, *heading);
            if is_of_scan {
                scan.odometry = *pose;
                break;
            }
        }
    }
    poses.for_each(|(k, ((_, pose), [_, _, heading]))| put(k, pose, *heading));
}

/// Which poses \[m, as told\] tell of one motion only if their headings are degrees: wheels roll along the heading, or at one angle to it. All of them, or
/// the one stretch with which they fit best, where all others fit as radians.
fn in_degrees(told: &[[f64; 3]]) -> Option<Range<usize>> {
    let beyond = |[_, _, theta]: &[f64; 3]| theta.abs() > 2.0 * PI;
    let (first, last) = (told.iter().position(beyond)?, told.iter().rposition(beyond)?);
    let all = 0..told.len();
    let [in_degrees, in_radians] = [DEGREE, 1.0].map(|unit| Along::sums(told, unit));
    let others = |degrees: &Range<usize>| {
        Along::of(&in_radians, &(0..degrees.start)).plus(&Along::of(&in_radians, &(degrees.end..told.len())))
    };
    let is = |degrees: &Range<usize>| {
        Along::of(&in_degrees, degrees).share().is_some_and(|share| share > ALONG[0])
            && Along::of(&in_radians, degrees).share().is_some_and(|share| share < ALONG[1])
            && (*degrees == all || others(degrees).share().is_some_and(|share| share > ALONG[0]))
            && (degrees.contains(&first) || degrees.contains(&last))
    };
    // The direction of most is about that of all, and then of all that are read as they should be.
    let best = |sums: &Vec<Along>| {
        let degrees = stretch(told, Along::of(sums, &all).sum);
        stretch(told, Along::of(&in_degrees, &degrees).plus(&others(&degrees)).sum)
    };
    // All of them, if that is what they may be.
    core::iter::once(all.clone()).chain([&in_radians, &in_degrees].map(best)).find(is)
}

/// The stretch of poses that lets the robot drive furthest in this direction with its headings in degrees, and all others in radians: the best of all
/// ways through three parts, pose by pose (Viterbi 1967).
fn stretch(told: &[[f64; 3]], [x, y]: [f64; 2]) -> Range<usize> {
    // How far before, in and behind the stretch, and where it begins and ends.
    let (mut before, mut within, mut behind) = (0.0, (0.0, 0), (f64::NEG_INFINITY, 0..0));
    // A heading of 0 is the same in both units: nothing is won by a change there but an error of rounding.
    let change = 1e-6 * ops::hypot(x, y);
    for k in 1..told.len() {
        let step = |units| {
            let [along, aside] = Along::step([told[k - 1], told[k]], units).sum;
            x * along + y * aside
        };
        let ends = (within.0 + step([DEGREE, 1.0]) - change, within.1..k);
        let goes_on = behind.0 + step([1.0; 2]);
        behind = if ends.0 > goes_on { ends } else { (goes_on, behind.1) };
        let begins = (before + step([1.0, DEGREE]) - change, k);
        let goes_on = within.0 + step([DEGREE; 2]);
        within = if begins.0 > goes_on { begins } else { (goes_on, within.1) };
        before += step([1.0; 2]);
    }
    if within.0 > behind.0 { within.1..told.len() } else { behind.1 }
}

/// Way that is driven, and in which direction as seen from the robot: twice the angle, as what drives back drives along the heading too.
#[derive(Clone, Copy, Default)]
struct Along {
    sum: [f64; 2],
    way: f64,
    count: usize,
}

impl Along {
    /// That from one pose to another, with headings in these units \[rad\].
    fn step(poses: [[f64; 3]; 2], units: [f64; 2]) -> Self {
        let pose = |k: usize| Pose2::new(poses[k][0], poses[k][1], units[k] * poses[k][2]);
        let Pose2 { x, y, theta } = pose(0).between(&pose(1));
        let length = ops::hypot(x, y);
        // The chord of an arc lies half of the turn aside.
        let (sin, cos) = ops::sin_cos(2.0 * (ops::atan2(y, x) - 0.5 * theta));
        Self { sum: [length * cos, length * sin], way: length, count: usize::from(length > 0.0) }
    }

    /// That up to each pose, with headings in this unit \[rad\].
    fn sums(told: &[[f64; 3]], unit: f64) -> Vec<Self> {
        let steps = told.windows(2).map(|pair| Self::step([pair[0], pair[1]], [unit; 2]));
        let sums = steps.scan(Self::default(), |sum, step| {
            *sum = sum.plus(&step);
            Some(*sum)
        });
        core::iter::once(Self::default()).chain(sums).collect()
    }

    /// That between the first and the last of these poses.
    fn of(sums: &[Self], poses: &Range<usize>) -> Self {
        if poses.is_empty() {
            return Self::default();
        }
        let (from, to) = (sums[poses.start], sums[poses.end - 1]);
        let sum = [to.sum[0] - from.sum[0], to.sum[1] - from.sum[1]];
        Self { sum, way: to.way - from.way, count: to.count - from.count }
    }

    fn plus(&self, more: &Self) -> Self {
        let sum = [self.sum[0] + more.sum[0], self.sum[1] + more.sum[1]];
        Self { sum, way: self.way + more.way, count: self.count + more.count }
    }

    /// Share of the way in that direction.
    fn share(&self) -> Option<f64> {
        (self.count >= ENOUGH).then(|| ops::hypot(self.sum[0], self.sum[1]) / self.way)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Round and round a square with round corners, and some way back, in headings of this unit.
    fn square(unit: f64, wrapped: bool) -> Vec<[f64; 3]> {
        let (mut pose, mut heading) = (Pose2::default(), 0.0);
        let mut told = Vec::new();
        for k in 0..240 {
            let (way, turn) = (if k > 200 { -0.3 } else { 0.3 }, if k % 20 < 5 { PI / 10.0 } else { 0.0 });
            pose = pose.compose(&Pose2::new(way, 0.0, 0.0)).compose(&Pose2::new(0.0, 0.0, turn));
            heading += turn;
            told.push([pose.x, pose.y, if wrapped { pose.theta } else { heading } * unit]);
        }
        told
    }

    /// A log of FLASER lines with these poses, each with an ODOM line before it.
    fn log(told: &[[f64; 3]]) -> crate::LaserLog {
        let line = |(k, [x, y, theta]): (usize, &[f64; 3])| {
            format!(
                "ODOM {x} {y} {theta} 0 0 0 {k}.5 h {k}.5\nFLASER 2 1 2 {x} {y} {theta} {x} {y} {theta} {k}.6 h {k}.6\n"
            )
        };
        crate::carmen::parse(told.iter().enumerate().map(line).collect::<String>().as_bytes(), false).unwrap()
    }

    #[test]
    fn a_log_in_degrees_is_read_as_one_in_radians() {
        let [degrees, radians] = [180.0 / PI, 1.0].map(|unit| log(&square(unit, false)));
        assert_eq!(
            (&degrees.notes.remarks[..], &radians.notes.remarks[..]),
            (&[crate::Remark::HeadingsInDegrees][..], &[][..])
        );
        let same = |a: Pose2, b: Pose2| a.x == b.x && a.y == b.y && ops::wrap_angle(a.theta - b.theta).abs() < 1e-9;
        assert!(degrees.scans.iter().zip(&radians.scans).all(|(a, b)| same(a.odometry, b.odometry)));
        assert!(degrees.odometry.iter().zip(&radians.odometry).all(|(a, b)| same(a.1, b.1)));
    }

    #[test]
    fn degrees_are_told_from_radians_by_the_way_that_is_driven() {
        let degree = 180.0 / PI;
        for wrapped in [true, false] {
            assert_eq!(in_degrees(&square(degree, wrapped)), Some(0..240), "{wrapped}");
            assert_eq!(in_degrees(&square(1.0, wrapped)), None, "{wrapped}");
        }
        // On a straight line headings tell nothing. Where each step turns by up to 70°, to either side, only the chords of the arcs tell the heading.
        let straight: Vec<_> = (0..50).map(|k| [f64::from(k), 0.0, 7.0]).collect();
        assert_eq!(in_degrees(&straight), None);
        let mut pose = Pose2::default();
        let winding = (0..50).map(|k| {
            let turn = f64::from(k * 37 % 141 - 70) / degree;
            let half = Pose2::new(0.0, 0.0, turn / 2.0);
            pose = pose.compose(&half).compose(&Pose2::new(0.5, 0.0, 0.0)).compose(&half);
            [pose.x, pose.y, 720.0 + pose.theta * degree]
        });
        assert_eq!(in_degrees(&winding.collect::<Vec<_>>()), Some(0..50));
        let standing = vec![[0.0, 0.0, 90.0]; 50];
        assert!(in_degrees(&standing).is_none() && in_degrees(&[]).is_none());
    }

    #[test]
    fn a_log_of_which_one_stretch_is_in_degrees_is_read_as_one_in_radians() {
        let plain = log(&square(1.0, true));
        for (degrees, times) in
            [(100..240, [100.5, 239.6]), (0..90, [0.5, 89.6]), (50..110, [50.5, 109.6]), (30..210, [30.5, 209.6])]
        {
            let mut told = square(1.0, true);
            told[degrees.clone()].iter_mut().for_each(|[_, _, theta]| *theta = theta.to_degrees());
            assert_eq!(in_degrees(&told), Some(degrees.clone()));
            let log = log(&told);
            let [from, to] = times;
            assert_eq!(log.notes.remarks, [Remark::SomeHeadingsInDegrees { from, to }]);
            let near = |a: Pose2, b: Pose2| a.x == b.x && a.y == b.y && ops::wrap_angle(a.theta - b.theta).abs() < 1e-9;
            assert!(log.scans.iter().zip(&plain.scans).all(|(a, b)| near(a.odometry, b.odometry)), "{degrees:?}");
            assert!(log.odometry.iter().zip(&plain.odometry).all(|(a, b)| near(a.1, b.1)), "{degrees:?}");
        }
        // Headings that are not wrapped, and those of a compass that is broken from the middle on.
        assert_eq!(in_degrees(&square(1.0, false)), None);
        let mut broken = square(1.0, true);
        broken[120..].iter_mut().enumerate().for_each(|(k, [_, _, theta])| *theta = 7.0 + (k * 37 % 141) as f64);
        assert_eq!(in_degrees(&broken), None);
    }
}
