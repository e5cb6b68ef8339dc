//! Odometry from the scans alone, for logs that have no other.

use super::LaserScan;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::mapper::tuning::{self, Map};
use crate::matching::{HillClimbSteps, ScoredPose, hill_climb};
use crate::sensor::Scan;

/// Side of a cell of the maps that scans are matched with \[m\], and the longest range that counts \[m\].
const CELL: f64 = 0.05;
const MAX_RANGE: f64 = 30.0;

/// A scan is matched with the last one of a place: the robot is at another place after so many metres, or radians.
const PLACE: f64 = 0.3;

/// Climbs begin where the robot would be if it went on as before, and turned by these \[rad\] to either side.
const TURNS: [f64; 5] = [0.0, 0.15, -0.15, 0.3, -0.3];

/// From a step as long as a fast robot makes between two sweeps down to half a centimetre.
const CLIMB: HillClimbSteps = HillClimbSteps { linear: 0.16, angular: 0.08, halvings: 5 };

/// Gives each scan the pose at which it fits best upon the scan of the place before it, the first one the origin.
///
/// Each is searched for by hill climbing, from where the motion between the two scans before it leads. Errors add up along the way, as
/// those of wheels do; in a long corridor without doors nothing tells how far the robot went.
pub fn give_odometry(scans: &mut [LaserScan], longest: f64) {
    let score = tuning::score();
    let mut place = Pose2::default();
    let mut map: Option<Map> = None;
    let (mut last, mut motion) = (Pose2::default(), Pose2::default());
    for scan in scans {
        let ends = scan.end_points(longest, MAX_RANGE);
        let pose = match &map {
            Some(map) if !ends.hits.is_empty() => {
                let value = |pose: &Pose2| score.log_score(map, pose, &ends);
                let ahead = place.between(&last.compose(&motion));
                let starts = TURNS.map(|turn| Pose2::new(ahead.x, ahead.y, ahead.theta + turn));
                let climbed = starts.map(|pose| {
                    hill_climb(ScoredPose { pose, value: value(&pose) }, CLIMB, |pose, _| value(pose))
                });
                let best = climbed.into_iter().reduce(|best, next| if next.value > best.value { next } else { best });
                place.compose(&best.map_or(ahead, |best| best.pose))
            }
            _ => last.compose(&motion),
        };
        scan.odometry = pose;
        (motion, last) = (last.between(&pose), pose);
        let moved = place.between(&pose);
        if map.is_none() || moved.distance(&Pose2::default()).max(moved.theta.abs()) > PLACE {
            if !ends.hits.is_empty() {
                (map, place) = (Some(mapped(&ends)), pose);
            }
        }
    }
}

/// The map of one scan, taken at the origin.
fn mapped(ends: &Scan) -> Map {
    let mut map = Map::new(tuning::grid(CELL));
    map.assimilate(&Pose2::default(), ends, &());
    map
}
