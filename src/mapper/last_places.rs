//! The scans of the last few places, as a map to match the next scan with: what tells of a motion without odometry.

use super::models::{CELL, Map, grid, score};
use crate::geometry::{Pose2, driven};
use crate::map::ConditionalMap;
use crate::matching::{HillClimbSteps, Score, ScoreNear, ScoredPose, hill_climb};
#[cfg(feature = "serde")]
use crate::save::{self, RestoreError};
use crate::sensor::Scan;
use std::collections::VecDeque;

/// The longest range that counts \[m\].
pub(super) const MAX_RANGE: f64 = 30.0;

/// The robot is at another place after so many metres, or radians.
const PLACE: f64 = 0.25;

/// So many: a wall that one coarse sweep touches here and there is a wall after some more.
const PLACES: usize = 8;

/// From a step as long as a fast robot makes between two sweeps down to half a centimetre.
const CLIMB: HillClimbSteps = HillClimbSteps { linear: 0.16, angular: 0.08, halvings: 5 };

/// See the module.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct LastPlaces {
    places: VecDeque<(Pose2, Scan)>,
    /// Of these places, once it is asked for.
    #[cfg_attr(feature = "serde", serde(skip))]
    map: Option<Map>,
}

impl LastPlaces {
    /// Where a scan fits best upon the last places of all poses that climbs reach from these starts and that are `allowed`, with the score there
    /// \[nats\]; `None` where there is nothing to match.
    pub(super) fn matched(
        &mut self,
        starts: &[Pose2],
        ends: &Scan,
        allowed: impl Fn(&Pose2) -> bool,
    ) -> Option<ScoredPose> {
        if self.places.is_empty() || ends.hits.is_empty() {
            return None;
        }
        let score = score();
        let near = score.near(self.map(), starts.first()?, ends, 1);
        let value = |pose: &Pose2, floor| {
            if allowed(pose) { near.log_score_above(pose, floor) } else { f64::NEG_INFINITY }
        };
        let climb =
            |pose: &Pose2| hill_climb(ScoredPose { pose: *pose, value: value(pose, f64::NEG_INFINITY) }, CLIMB, value);
        let better = |a: ScoredPose, b: ScoredPose| if b.value > a.value { b } else { a };
        starts.iter().map(climb).reduce(better)
    }

    /// Keeps a scan that was taken at this pose, if that is another place than the last one; tells whether it is.
    pub(super) fn take(&mut self, pose: Pose2, ends: impl FnOnce() -> Scan) -> bool {
        if self.places.back().is_some_and(|(last, _)| is_same(last, &pose)) {
            return false;
        }
        let ends = ends();
        if ends.hits.is_empty() {
            return false;
        }
        self.places.push_back((pose, ends));
        if self.places.len() > PLACES {
            self.places.pop_front();
        }
        self.map = None;
        true
    }

    /// How far it is from the first of these places to a pose, and by how much one turns on the way, to whichever side \[m, rad\].
    pub(super) fn span(&self, pose: &Pose2) -> [f64; 2] {
        let poses = || self.places.iter().map(|(pose, _)| pose).chain([pose]);
        let legs = poses().zip(poses().skip(1)).map(|(from, to)| driven(&from.between(to)));
        legs.fold([0.0; 2], |sum, leg| [sum[0] + leg[0], sum[1] + leg[1]])
    }

    /// The map of these places.
    pub(super) fn map(&mut self) -> &Map {
        let Self { places, map } = self;
        map.get_or_insert_with(|| {
            let mut map = Map::new(grid(CELL));
            for (pose, ends) in places {
                map.assimilate(pose, ends, &());
            }
            map
        })
    }
}

#[cfg(feature = "serde")]
impl LastPlaces {
    /// Whether these can be places.
    pub(super) fn check(&self) -> Result<(), RestoreError> {
        save::holds(self.places.len() <= PLACES, "odometer.places", "the last few")?;
        save::poses("odometer.places", self.places.iter().map(|(pose, _)| *pose))?;
        let points =
            |scan: &Scan| [scan.origin].into_iter().chain(scan.hits.clone()).chain(scan.misses.clone()).flatten();
        save::finite("odometer.places", self.places.iter().flat_map(|(_, scan)| points(scan).collect::<Vec<_>>()))
    }
}

/// Poses to climb from where the heading is uncertain: this one, and turned to either side.
pub(super) fn fan(pose: Pose2) -> [Pose2; 5] {
    [0.0, 0.15, -0.15, 0.3, -0.3].map(|turn| Pose2::new(pose.x, pose.y, pose.theta + turn))
}

/// Whether two poses are of one place.
fn is_same(a: &Pose2, b: &Pose2) -> bool {
    driven(&a.between(b)).into_iter().all(|moved| moved <= PLACE)
}
