//! Odometry from the scans alone, for logs that have no other.

use super::LaserScan;
use crate::geometry::Pose2;
use crate::mapper::{LastPlaces, MAX_RANGE, fan};

/// Gives each scan the pose at which it fits best upon the scans of the last few places, the first one the origin.
///
/// Each is searched for by hill climbing, from where the motion between the two scans before it leads. Errors add up along the way, as
/// those of wheels do; in a long corridor without doors nothing tells how far the robot went.
pub fn give_odometry(scans: &mut [LaserScan], longest: f64) {
    let mut places = LastPlaces::default();
    let (mut last, mut motion) = (Pose2::default(), Pose2::default());
    for scan in scans {
        let ends = scan.end_points(longest, MAX_RANGE);
        let ahead = last.compose(&motion);
        let pose = places.matched(&fan(ahead), &ends, |_| true).map_or(ahead, |best| best.pose);
        places.take(pose, || ends);
        (motion, last) = (last.between(&pose), pose);
        scan.odometry = pose;
    }
}
