//! The scans of the last few places, as a map to match the next scan with: what tells of a motion without odometry.

use super::agreement::Agreement;
use super::models::{CELL, Map, grid, score};
use super::moving::MOVING;
use super::wheels::Wheels;
use crate::geometry::{Gaussian3, Pose2, driven};
use crate::map::ConditionalMap;
use crate::matching::{HillClimbSteps, Score, ScoreNear, ScoredPose, hill_climb};
use crate::motion::{Displaced, Motion};
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

/// Standard deviation of a turn between two places, as odometry reports it while it is in doubt \[rad\]: wide enough to say nothing.
const TURN_ERROR: f64 = 1.0;

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
    /// Best mode of a scan's score upon the last places, with that score \[nats\], among those that hill climbs from these starts reach and that `counts`
    /// accepts; `None` where there is none, or nothing to match.
    pub(super) fn matched(
        &mut self,
        starts: &[Pose2],
        ends: &Scan,
        counts: &dyn Fn(&Pose2) -> bool,
    ) -> Option<ScoredPose> {
        if self.places.is_empty() || ends.hits.is_empty() {
            return None;
        }
        let tops = climbed(self.map(), starts, ends, None).into_iter();
        tops.filter(|top| counts(&top.pose)).reduce(better)
    }

    /// Realigns the places: each moves to where its scan fits best upon the earlier ones, with the distance that odometry reports as a prior. The newest
    /// place keeps its pose. Without this, odometry errors between places blur the map that the next scan is matched with.
    pub(super) fn tighten(&mut self) {
        let mut map = Map::new(grid(CELL));
        let mut before: Option<(Pose2, Pose2)> = None;
        for (pose, ends) in &mut self.places {
            let told = *pose;
            if let Some((told_before, before)) = before {
                let step = told_before.between(&told);
                *pose = before.compose(&step);
                let wheels = Wheels::default().displacement(&step).turned(0.0, TURN_ERROR * TURN_ERROR);
                let wheels = Displaced.gaussian(&before, &wheels, [0.0; 3]);
                let top = climbed(&map, &fan(*pose), ends, wheels.as_ref()).into_iter().reduce(better);
                if let Some(top) = top.filter(|top| is_home(&map, &top.pose, ends)) {
                    *pose = top.pose;
                }
            }
            map.assimilate(pose, ends, &());
            before = Some((told, *pose));
        }
        let Some((told, moved)) = before else { return };
        let back = told.compose(&moved.between(&Pose2::default()));
        self.places.iter_mut().for_each(|(pose, _)| *pose = back.compose(pose));
        self.map = None;
    }

    /// As [`Self::matched`] without odometry: where the scan is not at home near these starts, or no more than a `sure` share of its end points are on walls, it is
    /// searched for all round the last pose, from where the robot turns on the spot, or drives on along an arc as far as from the last place but one to the last.
    pub(super) fn searched(&mut self, starts: &[Pose2], last: &Pose2, ends: &Scan, sure: f64) -> Option<ScoredPose> {
        let near = self.matched(starts, ends, &|_| true)?;
        if self.is_home(&near.pose, ends) && self.agreement(&near.pose, ends).fits > sure {
            return Some(near);
        }
        let mut places = self.places.iter().rev().map(|(pose, _)| pose);
        let way = places.next().zip(places.next()).map_or(0.0, |(to, from)| from.distance(to));
        let mut starts = Vec::new();
        for k in -TURNS..=TURNS {
            let turn = TURN * f64::from(k);
            let half = Pose2::new(0.0, 0.0, 0.5 * turn);
            let on = last.compose(&half).compose(&Pose2::new(way, 0.0, 0.0)).compose(&half);
            starts.extend([last.compose(&Pose2::new(0.0, 0.0, turn)), on]);
        }
        self.matched(&starts, ends, &|_| true).filter(|far| far.value > near.value).or(Some(near))
    }

    /// Whether a scan that was taken at this pose shows what the last places did.
    pub(super) fn is_home(&mut self, pose: &Pose2, ends: &Scan) -> bool {
        is_home(self.map(), pose, ends)
    }

    /// How well a scan that was taken at this pose agrees with the last places.
    pub(super) fn agreement(&mut self, pose: &Pose2, ends: &Scan) -> Agreement {
        agreement(self.map(), pose, ends)
    }

    /// Keeps a scan that was taken at this pose, if that is another place than the last one; tells whether it is.
    pub(super) fn take(&mut self, pose: Pose2, ends: impl FnOnce() -> Scan) -> bool {
        if self.places.back().is_some_and(|(last, _)| is_within([PLACE; 2], last, &pose)) {
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
        let mut sum = [0.0; 2];
        let mut from: Option<&Pose2> = None;
        let mut add = |to| {
            let [way, turn] = from.map_or([0.0; 2], |from| driven(&from.between(to)));
            (sum[0], sum[1], from) = (sum[0] + way, sum[1] + turn, Some(to));
        };
        self.places.iter().for_each(|(place, _)| add(place));
        add(pose);
        sum
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

/// Modes that hill climbs from these starts reach: of a scan's score upon a map plus the logarithm of the prior \[nats\].
fn climbed(map: &Map, starts: &[Pose2], ends: &Scan, prior: Option<&Gaussian3>) -> Vec<ScoredPose> {
    let (score, Some(place)) = (score(), starts.first()) else { return Vec::new() };
    let near = score.near(map, place, ends, 1);
    let value = |pose: &Pose2, floor: f64| {
        let log_prior = prior.map_or(0.0, |prior| prior.log_density(pose));
        log_prior + near.log_score_above(pose, floor - log_prior)
    };
    let climb =
        |pose: &Pose2| hill_climb(ScoredPose { pose: *pose, value: value(pose, f64::NEG_INFINITY) }, CLIMB, value);
    starts.iter().map(climb).collect()
}

/// The one with the higher score; of equals the first.
fn better(a: ScoredPose, b: ScoredPose) -> ScoredPose {
    if b.value > a.value { b } else { a }
}

/// How well a scan that was taken at this pose agrees with a map.
fn agreement(map: &Map, pose: &Pose2, ends: &Scan) -> Agreement {
    Agreement::of(&score().log_beams(map, pose, ends))
}

/// Whether it shows what that map does.
fn is_home(map: &Map, pose: &Pose2, ends: &Scan) -> bool {
    let (agreement, [fits, disputed]) = (agreement(map, pose, ends), HOME);
    agreement.fits > fits && agreement.disputed() < disputed
}

/// Poses to climb from where the heading is uncertain: this one, and turned to either side.
pub(super) fn fan(pose: Pose2) -> [Pose2; 5] {
    [0.0, 0.15, -0.15, 0.3, -0.3].map(|turn| Pose2::new(pose.x, pose.y, pose.theta + turn))
}

/// Bound on the odometry error \[m, rad\] after driving and turning this far \[m, rad\].
pub(super) fn errors_of_wheels([x, theta]: [f64; 2]) -> [f64; 2] {
    let wheels = Wheels::default().displacement(&Pose2 { x, y: 0.0, theta }).covariance;
    let [position, heading] = [wheels.m11, wheels.m33].map(|variance| MOVING.seen_through_stds * variance.sqrt());
    [position + MOVING.range_error, heading + HEADING_ERROR]
}

/// Whether two poses differ by less than these limits \[m, rad\].
pub(super) fn is_within(limits: [f64; 2], a: &Pose2, b: &Pose2) -> bool {
    driven(&a.between(b)).into_iter().zip(limits).all(|(moved, limit)| moved < limit)
}
