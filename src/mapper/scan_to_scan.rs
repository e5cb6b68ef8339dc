//! Odometry from the scans alone, for logs that have no other.

use super::last_places::{LastPlaces, MAX_RANGE, fan};
use super::settings::NOTHING_MET;
use crate::geometry::Pose2;
use crate::sensor::{LaserScan, longest_reading};

/// Gives each scan, in place of its odometry, the pose at which it fits best upon the scans of the last few places, the first one the origin:
/// for odometry that tells nothing.
///
/// Each is searched for by hill climbing, from where the motion between the two scans before it leads. Errors add up along the way, as
/// those of wheels do; in a long corridor without doors nothing tells how far the robot went.
pub fn match_scans(scans: &mut [LaserScan]) {
    let longest = NOTHING_MET * longest_reading(scans);
    let mut places = LastPlaces::default();
    let (mut last, mut motion) = (Pose2::default(), Pose2::default());
    for scan in scans {
        let ends = scan.end_points(longest, MAX_RANGE);
        let ahead = last.compose(&motion);
        let pose = places.searched(&fan(ahead), &last, &ends).map_or(ahead, |best| best.pose);
        places.take(pose, || ends);
        (motion, last) = (last.between(&pose), pose);
        scan.odometry = pose;
    }
}
