//! How large a building is before it is mapped: what decides whether its maps fit into memory.

use fastslam::ops;
use fastslam::sensor::LaserScan;
use std::collections::BTreeSet;

/// Side of the squares that are counted \[m\].
const SQUARE: f64 = 1.0;

/// Scans, and beams of a scan, that are looked at: more would only find the same squares again.
const MOST_SCANS: usize = 1000;
const MOST_BEAMS: usize = 32;

/// Area \[m²\] that the beams of these scans sweep up to `max_range` \[m\], from where raw odometry says the robot was.
///
/// Counted in whole squares of 1 m. Raw odometry drifts, so that ground seen twice may count twice: rather too much than too little.
pub fn swept_area(scans: &[LaserScan], max_range: f64) -> f64 {
    let mut squares = BTreeSet::new();
    let mut last = None;
    for scan in scans.iter().step_by(scans.len().div_ceil(MOST_SCANS).max(1)) {
        let world_from_laser = scan.odometry.compose(&scan.robot_from_laser);
        for k in (0..scan.ranges.len()).step_by(scan.ranges.len().div_ceil(MOST_BEAMS).max(1)) {
            let range = f64::from(scan.ranges[k]);
            // What met nothing may have seen as far as any beam does.
            let length = if range > 0.0 { range.min(max_range) } else { 0.0 };
            let (sin, cos) = ops::sin_cos(world_from_laser.theta + scan.first_angle + k as f64 * scan.angle_step);
            for step in 0..=(length / SQUARE) as u32 {
                let along = f64::from(step) * SQUARE;
                let [x, y] = [world_from_laser.x + along * cos, world_from_laser.y + along * sin];
                // Squares 65 km apart count as one: no building is as large.
                let [i, j] = [x, y].map(|c| (c / SQUARE).floor() as i32 as u32 as usize & 0xffff);
                let square = (i << 16) | j;
                if last.replace(square) != Some(square) {
                    squares.insert(square);
                }
            }
        }
    }
    squares.len() as f64 * SQUARE * SQUARE
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::geometry::Pose2;

    fn log(scans: &[(f64, Vec<f32>)]) -> Vec<LaserScan> {
        let scan = |(x, ranges): &(f64, Vec<f32>)| LaserScan {
            time: 0.0,
            odometry: Pose2::new(*x, 0.5, 0.0),
            robot_from_laser: Pose2::default(),
            first_angle: 0.0,
            angle_step: core::f64::consts::FRAC_PI_2,
            max_range: None,
            ranges: ranges.clone(),
        };
        scans.iter().map(scan).collect()
    }

    #[test]
    fn squares_along_the_beams_are_counted_once() {
        let one = (0.5, vec![4.2, 2.2]);
        assert_eq!(swept_area(&log(core::slice::from_ref(&one)), 30.0), 5.0 + 2.0);
        assert_eq!(swept_area(&log(&[one.clone(), one.clone()]), 30.0), 7.0);
        assert_eq!(swept_area(&log(&[one, (20.5, vec![1.0])]), 30.0), 7.0 + 2.0);
    }

    #[test]
    fn no_beam_goes_beyond_the_longest_range() {
        assert_eq!(swept_area(&log(&[(0.5, vec![80.0])]), 10.0), 11.0);
        assert_eq!(swept_area(&log(&[(0.5, vec![f32::INFINITY])]), 10.0), 11.0);
        assert_eq!(swept_area(&log(&[(0.5, vec![0.0, f32::NAN, -3.0])]), 10.0), 1.0);
        assert_eq!(swept_area(&log(&[]), 10.0), 0.0);
    }
}
