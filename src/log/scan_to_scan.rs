//! Odometry from the scans alone, for logs that have no other.

use super::LaserScan;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::mapper::tuning::{self, Map};
use crate::matching::{HillClimbSteps, ScoredPose, hill_climb};
use crate::sensor::Scan;
use std::collections::VecDeque;

/// Side of a cell of the maps that scans are matched with \[m\], and the longest range that counts \[m\].
const CELL: f64 = 0.05;
const MAX_RANGE: f64 = 30.0;

/// Scans are matched with those of the last few places: the robot is at another place after so many metres, or radians.
const PLACE: f64 = 0.25;

/// So many: a wall that one coarse sweep touches here and there is a wall after some more.
const PLACES: usize = 8;

/// Climbs begin where the robot would be if it went on as before, and turned by these \[rad\] to either side.
const TURNS: [f64; 5] = [0.0, 0.15, -0.15, 0.3, -0.3];

/// From a step as long as a fast robot makes between two sweeps down to half a centimetre.
const CLIMB: HillClimbSteps = HillClimbSteps { linear: 0.16, angular: 0.08, halvings: 5 };

/// Gives each scan the pose at which it fits best upon the scans of the last few places, the first one the origin.
///
/// Each is searched for by hill climbing, from where the motion between the two scans before it leads. Errors add up along the way, as
/// those of wheels do; in a long corridor without doors nothing tells how far the robot went.
pub fn give_odometry(scans: &mut [LaserScan], longest: f64) {
    let score = tuning::score();
    let mut places: VecDeque<(Pose2, Scan)> = VecDeque::new();
    let mut map = mapped(&places);
    let (mut last, mut motion) = (Pose2::default(), Pose2::default());
    for scan in scans {
        let ends = scan.end_points(longest, MAX_RANGE);
        let mut pose = last.compose(&motion);
        if let (Some((place, _)), false) = (places.back(), ends.hits.is_empty()) {
            let value = |pose: &Pose2| score.log_score(&map, pose, &ends);
            let climb = |turn: f64| {
                let pose = Pose2::new(pose.x, pose.y, pose.theta + turn);
                hill_climb(ScoredPose { pose, value: value(&pose) }, CLIMB, |pose, _| value(pose))
            };
            let better = |a: ScoredPose, b: ScoredPose| if b.value > a.value { b } else { a };
            pose = TURNS.into_iter().map(climb).reduce(better).map_or(pose, |best| best.pose);
            let moved = place.between(&pose);
            if moved.distance(&Pose2::default()).max(moved.theta.abs()) > PLACE {
                places.push_back((pose, ends));
                if places.len() > PLACES {
                    places.pop_front();
                }
                map = mapped(&places);
            }
        } else if places.is_empty() && !ends.hits.is_empty() {
            places.push_back((pose, ends));
            map = mapped(&places);
        }
        (motion, last) = (last.between(&pose), pose);
        scan.odometry = pose;
    }
}

/// The map of these scans.
fn mapped(places: &VecDeque<(Pose2, Scan)>) -> Map {
    let mut map = Map::new(tuning::grid(CELL));
    for (pose, ends) in places {
        map.assimilate(pose, ends, &());
    }
    map
}
