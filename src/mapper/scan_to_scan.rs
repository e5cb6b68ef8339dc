//! Odometry from the scans alone, for logs that have no other.

use super::last_places::{LastPlaces, MAX_RANGE, fan};
use super::settings::NOTHING_MET;
use crate::geometry::Pose2;
use crate::sensor::{LaserScan, longest_reading};

/// From this share of end points on walls on, a scan that fits where the last motion leads is searched for nowhere else: no odometry will correct the path. Without
/// its odometry the ACES log, a scan a metre, is mapped 40 m off by 0.5 (whatever is at home), 1.3 m by 0.7 and 2.5 m by 0.85, and a third of the Intel log 0.5, 0.3 and 0.6 m.
const SURE: f64 = 0.7;

/// Gives each scan, in place of its odometry, the pose at which it fits best upon the scans of the last few places, the first one the origin:
/// for odometry that tells nothing.
///
/// Each is searched for by hill climbing, from where the motion between the two scans before it leads. Errors add up along the way, as
/// those of wheels do; in a long corridor without doors nothing tells how far the robot went. Returns the stamps \[s\] of the scans that do not fit upon those
/// before wherever they are searched for, among those that met anything: from each of them on the path may be wrong.
pub fn match_scans(scans: &mut [LaserScan]) -> Vec<f64> {
    let mut lost = Vec::new();
    let longest = NOTHING_MET * longest_reading(scans);
    let mut places = LastPlaces::default();
    let (mut last, mut motion) = (Pose2::default(), Pose2::default());
    for scan in scans {
        let ends = scan.end_points(longest, MAX_RANGE);
        let ahead = last.compose(&motion);
        let best = places.searched(&fan(ahead), &last, &ends, SURE);
        let pose = best.map_or(ahead, |best| best.pose);
        if best.is_some_and(|best| !places.is_home(&best.pose, &ends)) {
            lost.push(scan.time);
        }
        places.take(pose, || ends);
        (motion, last) = (last.between(&pose), pose);
        scan.odometry = pose;
    }
    lost
}
