//! Paths as the benchmarks of TUM write them: `time x y z qx qy qz qw`, a line for each pose.
//!
//! Reference: Sturm et al., *A benchmark for the evaluation of RGB-D SLAM systems*, IROS 2012; read by `evo` and by the benchmark's own tools.

use super::fixed;
use crate::geometry::Pose2;
use crate::ops;

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
