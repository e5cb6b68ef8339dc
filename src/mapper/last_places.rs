//! The scans of the last few places, as a map to match the next scan with: what tells of a motion without odometry.

use super::agreement::Agreement;
use super::models::{CELL, Map, grid, score};
use super::moving::MOVING;
use super::wheels::Wheels;
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

/// Headings to climb from where a scan fits nowhere near where the robot should be: so many to either side of the last one, so far apart \[rad\].
const TURNS: i32 = 8;
const TURN: f64 = 0.15;

/// A scan is at home if more than this share of its end points are on walls, and the map disputes less than this share.
const HOME: [f64; 2] = [0.5, 0.15];

/// From a step as long as a fast robot makes between two sweeps down to half a centimetre.
const CLIMB: HillClimbSteps = HillClimbSteps { linear: 0.16, angular: 0.08, halvings: 5 };

/// What can be off of a heading besides wheels \[rad\].
const HEADING_ERROR: f64 = 0.1;

/// The poses where a robot may be that odometry has at `told`: errors of the wheels on a way \[m, rad\] lead there.
pub(super) struct Near {
    told: Pose2,
    within: [f64; 2],
}

impl Near {
    pub(super) fn new(told: &Pose2, [x, theta]: [f64; 2]) -> Self {
        let wheels = Wheels::default().displacement(&Pose2 { x, y: 0.0, theta }).covariance;
        let [position, heading] = [wheels.m11, wheels.m33].map(|variance| MOVING.seen_through_stds * variance.sqrt());
        Self { told: *told, within: [position + MOVING.range_error, heading + HEADING_ERROR] }
    }

    pub(super) fn has(&self, pose: &Pose2) -> bool {
        let off = driven(&self.told.between(pose));
        off[0] < self.within[0] && off[1] < self.within[1]
    }
}

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
    /// Where a scan fits best upon the last places of all poses that climbs reach from these starts, and that are `within`, with the score there
    /// \[nats\]; `None` where there is nothing to match.
    pub(super) fn matched(&mut self, starts: &[Pose2], ends: &Scan, within: Option<&Near>) -> Option<ScoredPose> {
        if self.places.is_empty() || ends.hits.is_empty() {
            return None;
        }
        let score = score();
        let near = score.near(self.map(), starts.first()?, ends, 1);
        let value = |pose: &Pose2, floor| {
            if within.is_none_or(|near| near.has(pose)) { near.log_score_above(pose, floor) } else { f64::NEG_INFINITY }
        };
        let climb =
            |pose: &Pose2| hill_climb(ScoredPose { pose: *pose, value: value(pose, f64::NEG_INFINITY) }, CLIMB, value);
        let better = |a: ScoredPose, b: ScoredPose| if b.value > a.value { b } else { a };
        starts.iter().map(climb).reduce(better)
    }

    /// As [`Self::matched`] without odometry: where the scan is not at home near these starts, or no more than a `sure` share of its end points are on walls, it is
    /// searched for all round the last pose, from where the robot turns on the spot, or drives on along an arc as far as from the last place but one to the last.
    pub(super) fn searched(&mut self, starts: &[Pose2], last: &Pose2, ends: &Scan, sure: f64) -> Option<ScoredPose> {
        let near = self.matched(starts, ends, None)?;
        if self.is_home(&near.pose, ends) && self.agreement(&near.pose, ends).fits > sure {
            return Some(near);
        }
        let mut places = self.places.iter().rev().map(|(pose, _)| pose);
        let way = places.next().zip(places.next()).map_or(0.0, |(to, from)| from.distance(to));
        let turns = (-TURNS..=TURNS).map(|k| TURN * f64::from(k));
        let on = |turn: f64| {
            let half = Pose2::new(0.0, 0.0, 0.5 * turn);
            last.compose(&half).compose(&Pose2::new(way, 0.0, 0.0)).compose(&half)
        };
        let starts: Vec<Pose2> = turns.flat_map(|turn| [last.compose(&Pose2::new(0.0, 0.0, turn)), on(turn)]).collect();
        self.matched(&starts, ends, None).filter(|far| far.value > near.value).or(Some(near))
    }

    /// Whether a scan that was taken at this pose shows what the last places did.
    pub(super) fn is_home(&mut self, pose: &Pose2, ends: &Scan) -> bool {
        let (agreement, [fits, disputed]) = (self.agreement(pose, ends), HOME);
        agreement.fits > fits && agreement.disputed() < disputed
    }

    /// How well a scan that was taken at this pose agrees with the last places.
    pub(super) fn agreement(&mut self, pose: &Pose2, ends: &Scan) -> Agreement {
        Agreement::of(&score().log_beams(self.map(), pose, ends))
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
