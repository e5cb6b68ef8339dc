//! Paths as the benchmarks of TUM write them: `time x y z qx qy qz qw`, a line for each pose.
//!
//! Reference: Sturm et al., *A benchmark for the evaluation of RGB-D SLAM systems*, IROS 2012; read by `evo` and by the benchmark's own tools.

use fastslam::error::fixed;
use fastslam::geometry::Pose2;
use fastslam::ops;

/// Poses with their times \[s\]: a line `time x y z qx qy qz qw` for each, in seconds, metres, and a unit quaternion.
pub fn write_tum(path: &[(f64, Pose2)]) -> String {
    let mut text = String::new();
    for (time, pose) in path {
        let (sin, cos) = ops::sin_cos(0.5 * pose.theta);
        let [x, y] = [pose.x, pose.y].map(|metres| fixed(metres, 6));
        let [qz, qw] = [sin, cos].map(|part| fixed(part, 9));
        text += &format!("{} {x} {y} 0 0 0 {qz} {qw}\n", fixed(*time, 6));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse;

    #[test]
    fn poses_are_read_back_as_they_were_written() {
        let pose = |k: u32| Pose2::new(0.5 * f64::from(k), -1.25, 0.55 * f64::from(k));
        let path: Vec<(f64, Pose2)> = (0..12).map(|k| (f64::from(k), pose(k))).collect();
        let scan = "FLASER 2 1.0 2.0 0 0 0 0 0 0 99 robot 99\n"; // without which it is not a log
        let log = parse((write_tum(&path) + scan).as_bytes(), false).unwrap();
        assert_eq!(log.odometry.len(), path.len() + 1);
        for ((time, pose), (read, found)) in path.iter().zip(&log.odometry) {
            assert_eq!(time, read);
            assert!(found.minus(pose).norm() < 1e-6, "{pose:?} {found:?}");
        }
    }
}
