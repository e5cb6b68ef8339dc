//! Headings that are told in degrees.

use super::{LaserLog, Remark};
use core::f64::consts::PI;
use fastslam::geometry::Pose2;
use fastslam::ops;

/// Least share of the way that is driven in one direction of the robot, ahead or back, with headings as what they are; more than this with headings as what they
/// are not is a coincidence.
const ALONG: [f64; 2] = [0.8, 0.5];

/// Fewer motions are no evidence.
const ENOUGH: usize = 10;

/// Reads the headings of a log as degrees, if that is what they are.
pub(super) fn in_radians(log: &mut LaserLog, told: &[[f64; 3]]) {
    if !in_degrees(told) {
        return;
    }
    let heading = |degrees: f64| ops::wrap_angle(degrees * PI / 180.0);
    let mut poses = log.odometry.iter_mut().zip(told);
    // Each scan that is told with a pose comes in the order of these poses.
    for scan in log.scans.iter_mut().filter(|scan| !scan.odometry.x.is_nan()) {
        for ((time, pose), [_, _, degrees]) in poses.by_ref() {
            let is_of_scan = *time == scan.time && *pose == scan.odometry;
            pose.theta = heading(*degrees);
            if is_of_scan {
                scan.odometry = *pose;
                break;
            }
        }
    }
    poses.for_each(|((_, pose), [_, _, degrees])| pose.theta = heading(*degrees));
    log.notes.remarks.push(Remark::HeadingsInDegrees);
}

/// Whether poses \[m, as told\] tell of one motion only if their headings are degrees: wheels roll along the heading, or at one angle to it.
fn in_degrees(told: &[[f64; 3]]) -> bool {
    if !told.iter().any(|[_, _, theta]| theta.abs() > 2.0 * PI) {
        return false;
    }
    let [degrees, radians] = [PI / 180.0, 1.0].map(|unit| along(told, unit));
    degrees.is_some_and(|share| share > ALONG[0]) && radians.is_some_and(|share| share < ALONG[1])
}

/// Share of the way in the direction that is driven most, as seen from the robot: twice the angle, as what drives back drives along the heading too.
fn along(told: &[[f64; 3]], unit: f64) -> Option<f64> {
    let (mut sum, mut way, mut count) = ([0.0; 2], 0.0, 0);
    for pair in told.windows(2) {
        let [from, to] = [pair[0], pair[1]].map(|[x, y, theta]| Pose2::new(x, y, unit * theta));
        let Pose2 { x, y, theta } = from.between(&to);
        let length = ops::hypot(x, y);
        if length > 0.0 {
            // The chord of an arc lies half of the turn aside.
            let (sin, cos) = ops::sin_cos(2.0 * (ops::atan2(y, x) - 0.5 * theta));
            sum = [sum[0] + length * cos, sum[1] + length * sin];
            (way, count) = (way + length, count + 1);
        }
    }
    (count >= ENOUGH).then(|| ops::hypot(sum[0], sum[1]) / way)
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
            assert!(in_degrees(&square(degree, wrapped)), "{wrapped}");
            assert!(!in_degrees(&square(1.0, wrapped)), "{wrapped}");
        }
        // On a straight line headings tell nothing. Where each step turns by up to 70°, to either side, only the chords of the arcs tell the heading.
        let straight: Vec<_> = (0..50).map(|k| [f64::from(k), 0.0, 7.0]).collect();
        assert!(!in_degrees(&straight));
        let mut pose = Pose2::default();
        let winding = (0..50).map(|k| {
            let turn = f64::from(k * 37 % 141 - 70) / degree;
            let half = Pose2::new(0.0, 0.0, turn / 2.0);
            pose = pose.compose(&half).compose(&Pose2::new(0.5, 0.0, 0.0)).compose(&half);
            [pose.x, pose.y, 720.0 + pose.theta * degree]
        });
        assert!(in_degrees(&winding.collect::<Vec<_>>()));
        let standing = vec![[0.0, 0.0, 90.0]; 50];
        assert!(!in_degrees(&standing) && !in_degrees(&[]));
    }
}
