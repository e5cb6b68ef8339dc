//! Logs of our own, free to ship: a robot with a laser in a building of which the truth is known, for the
//! [mapper](fastslam::mapper) to map.

use crate::digest::Digest;
use crate::world::{FloorPlan, LongRing, corners_cut_short, crowd, drive, escort, until_people};
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use core::f64::consts::PI;
use fastslam::geometry::Pose2;
use fastslam::mapper::{LaserMapper, Map};
use fastslam::motion::{Odometry, OdometryModel};
use fastslam::random::Stream;
use fastslam::sensor::BeamSensor;
use fastslam::sensor::LaserScan;
use fastslam_log::{LaserLog, Relation};

/// How a log of our own comes about.
#[derive(Clone, PartialEq, Debug)]
pub struct Recipe {
    /// Seed of the noises.
    pub seed: u64,
    /// Where.
    pub plan: FloorPlan,
    /// Way points \[m\].
    pub route: Vec<[f64; 2]>,
    /// How far from its way the robot looks at first \[rad\]; it turns on the spot before it drives. A map begins with the
    /// first pose, so by this angle the building lies askew in its cells.
    pub askew: f64,
    /// From one scan to the next \[m\].
    pub spacing: f64,
    /// Beams of the laser, at least two, from its right to its left: 2 n of them from −90° on by π / n, or 2 n + 1 with +90° too.
    pub beams: u32,
    /// Where the laser sits on the robot, and which way it looks.
    pub robot_from_laser: Pose2,
    /// Whether it hangs upside down, so that its beams go from left to right.
    pub upside_down: bool,
    /// Longest range of the laser \[m\].
    pub max_range: f64,
    /// Standard deviation of a range \[m\].
    pub range_std: f64,
    /// Share of the beams, 0 to 1, that end before the wall, anywhere from a fifth of the way on: people who walk by.
    pub people: f64,
    /// Noise of the wheels.
    pub wheels: OdometryModel,
    /// What the wheels turn too far on every metre \[rad/m\].
    pub bias: f64,
    /// Share of the steps, 0 to 1, in which a wheel slips: the drive is reported 0.1 m too long, and a turn of up to 0.1 rad to
    /// either side that was none.
    pub slip: f64,
    /// So many times the noise by which odometry of recorded logs is spoilt on purpose, beside that of the wheels: for a step of d metres,
    /// 5 % of d along each of the robot's axes, and of its heading 3° a metre and 5 % of the turn. No drive, turn and turn again:
    /// a step aside is none.
    pub scatter: f64,
    /// How far to its left the robot steps after every fifth scan, and back to its way with the next \[m\]: 0 for one that cannot.
    pub aside: f64,
    /// People who stand close beside its way, each for some scans.
    pub crowd: u32,
    /// People who go along with the robot.
    pub escort: u32,
    /// People who walk round a ring, and which.
    pub walkers: Option<(LongRing, u32)>,
}

/// From one scan to the next \[s\].
const INTERVAL: f64 = 0.7;

impl Recipe {
    /// A robot with a laser of 180 beams in [`FloorPlan::building`], twice round its corridors.
    pub fn building() -> Self {
        Self {
            seed: 17,
            plan: FloorPlan::building(),
            route: ROUTE.to_vec(),
            askew: 0.0,
            spacing: 0.35,
            beams: 180,
            robot_from_laser: Pose2::default(),
            upside_down: false,
            max_range: 30.0,
            range_std: 0.015,
            people: 0.0,
            wheels: OdometryModel { alphas: [0.01, 0.0004, 0.002, 0.001] },
            bias: 0.0,
            slip: 0.0,
            scatter: 0.0,
            aside: 0.0,
            crowd: 0,
            escort: 0,
            walkers: None,
        }
    }

    /// Where the robot is, for each scan.
    fn truth(&self) -> Vec<Pose2> {
        /// From a corner, where the robot begins to cut it \[m\].
        const NEAR: f64 = 1.2;
        /// On the spot, from one scan to the next \[rad\].
        const TURN: f64 = PI / 12.0;
        let length: f64 =
            self.route.windows(2).map(|l| fastslam::ops::hypot(l[1][0] - l[0][0], l[1][1] - l[0][1])).sum();
        let way = drive(&corners_cut_short(&self.route, NEAR), (length / self.spacing) as usize);
        let turns = (self.askew.abs() / TURN).ceil() as u32;
        let left = |k: u32| self.askew * f64::from(turns - k) / f64::from(turns);
        let on_the_spot = (0..turns).map(|k| Pose2::new(way[0].x, way[0].y, way[0].theta + left(k)));
        let aside = |(k, pose): (usize, &Pose2)| {
            let steps = self.aside != 0.0 && k % 5 == 4;
            [Some(*pose), steps.then(|| pose.compose(&Pose2::new(0.0, self.aside, 0.0)))]
        };
        on_the_spot.chain(way.iter().enumerate().flat_map(aside).flatten()).collect()
    }

    /// What the wheels report of a drive, the step-th.
    fn reported(&self, driven: &Odometry, step: u32) -> Odometry {
        let mut reported = self.wheels.perturb(driven, &mut Stream::at(self.seed, WORLD_ODOMETRY, step, 0));
        reported.rot2 += self.bias * driven.trans;
        let mut stream = Stream::at(self.seed, WORLD_ODOMETRY, step, 1);
        if stream.uniform() < self.slip {
            reported.trans += 0.1;
            reported.rot2 += 0.2 * (stream.uniform() - 0.5);
        }
        if self.scatter > 0.0 { self.scattered(&reported, step) } else { reported }
    }

    /// The same with [`Self::scatter`].
    fn scattered(&self, reported: &Odometry, step: u32) -> Odometry {
        let start = Pose2::default();
        let moved = reported.apply(&start);
        let way = moved.distance(&start);
        let [x, y, turn]: [f64; 3] = Stream::at(self.seed, WORLD_ODOMETRY, step, 2).normals();
        let heading_std = fastslam::ops::hypot(3_f64.to_radians() * way, 0.05 * moved.theta);
        let noise = [0.05 * way * x, 0.05 * way * y, heading_std * turn].map(|part| self.scatter * part);
        Odometry::between(&start, &moved.plus(&noise.into()))
    }

    /// Ranges \[m\] at the step-th pose of this way; the longest where nothing is met.
    fn ranges(&self, way: &[Pose2], sensor: &BeamSensor, step: u32) -> Vec<f64> {
        let laser = way[step as usize].compose(&self.robot_from_laser);
        let mut ranges = self.plan.ranges(&laser, sensor, &mut Stream::at(self.seed, WORLD_SENSOR, step, 0));
        let mut stream = Stream::at(self.seed, WORLD_SENSOR, step, 1);
        for range in &mut ranges {
            *range = range.min(sensor.max_range);
            if stream.uniform() < self.people {
                *range *= 0.2 + 0.8 * stream.uniform();
            }
        }
        let people = self.people(way, step);
        for (range, angle) in ranges.iter_mut().zip(&sensor.angles) {
            *range = range.min(until_people(&people, &laser, *angle));
        }
        ranges
    }

    /// Where people are \[m\] at the step-th pose of this way.
    fn people(&self, way: &[Pose2], step: u32) -> Vec<[f64; 2]> {
        let time = INTERVAL * f64::from(step);
        let round = self.walkers.iter().flat_map(|(ring, count)| ring.people(*count, time));
        let along = escort(self.seed, self.escort, time).into_iter().map(|person| way[step as usize].transform(person));
        crowd(self.seed, self.crowd, way, step).into_iter().chain(along).chain(round).collect()
    }
}

/// A log of our own, free to ship.
#[derive(Clone, Debug)]
pub struct Example {
    /// What the robot reported.
    pub log: LaserLog,
    /// Where it was, for each scan.
    pub truth: Vec<Pose2>,
    /// True relations between neighbouring scans, and between scans of one place at different times.
    pub relations: Vec<Relation>,
}

impl Example {
    /// By [`Recipe::building`]: always the same; of its key scans the first so many.
    pub fn new(scans: usize) -> Self {
        Self::of(&Recipe::building(), scans)
    }

    /// By a recipe; of its key scans the first so many.
    ///
    /// # Panics
    /// For fewer than two beams or way points, or a spacing longer than the route.
    pub fn of(recipe: &Recipe, scans: usize) -> Self {
        /// Scans between two that see a place at different times.
        const APART: usize = 60;
        let mut truth = recipe.truth();
        truth.truncate(scans);
        let half = recipe.beams / 2;
        assert!(half > 0, "a laser of ours needs two beams");
        let angle_step = PI / f64::from(2 * half);
        let to_the_left = if recipe.upside_down { -1.0 } else { 1.0 };
        let angles = (0..recipe.beams).map(|k| to_the_left * (f64::from(k) - f64::from(half)) * angle_step).collect();
        let sensor = BeamSensor { angles, max_range: recipe.max_range, range_std: recipe.range_std };
        let mut log = LaserLog::default();
        let mut odometry = Pose2::default();
        for (step, pose) in (0..).zip(&truth) {
            if step > 0 {
                let driven = Odometry::between(&truth[step as usize - 1], pose);
                odometry = recipe.reported(&driven, step).apply(&odometry);
            }
            // With the digits that a file has: what is read from it is the same log.
            let odometry =
                Pose2 { x: rounded(odometry.x, 1e3), y: rounded(odometry.y, 1e3), theta: rounded(odometry.theta, 1e4) };
            let time = rounded(1_000_000_000.0 + INTERVAL * f64::from(step), 1e2);
            let ranges = recipe.ranges(&truth, &sensor, step);
            let ranges = ranges.iter().map(|range| rounded(*range, 1e2) as f32).collect();
            log.odometry.push((time, odometry));
            log.scans.push(LaserScan {
                time,
                odometry,
                robot_from_laser: recipe.robot_from_laser,
                first_angle: to_the_left * -0.5 * PI,
                angle_step: to_the_left * angle_step,
                max_range: None,
                ranges,
            });
        }
        let relation = |a: usize, b: usize| Relation {
            times: [log.scans[a].time, log.scans[b].time],
            first_from_second: truth[a].between(&truth[b]),
        };
        let mut relations: Vec<Relation> = (1..truth.len()).map(|k| relation(k - 1, k)).collect();
        for k in APART..truth.len() {
            let near =
                (0..=k - APART).min_by(|a, b| truth[*a].distance(&truth[k]).total_cmp(&truth[*b].distance(&truth[k])));
            relations.extend(near.filter(|near| truth[*near].distance(&truth[k]) < 1.0).map(|near| relation(near, k)));
        }
        Self { log, truth, relations }
    }
}

/// To so many parts of one.
fn rounded(x: f64, parts: f64) -> f64 {
    (x * parts).round() / parts
}

/// Through the building \[m\]: round its west half, round its east half, then all round, and home.
const ROUTE: [[f64; 2]; 30] = [
    [6.0, 10.0],
    [6.0, 17.9],
    [19.8, 17.9],
    [20.0, 12.0],
    [20.1, 6.2],
    [12.5, 6.1],
    [12.0, 3.0],
    [13.8, 2.6],
    [13.6, 6.0],
    [6.1, 6.0],
    [5.9, 12.0],
    [6.2, 18.0],
    [20.0, 18.0],
    [33.0, 17.8],
    [33.9, 12.0],
    [37.0, 11.8],
    [37.4, 13.4],
    [34.0, 12.8],
    [33.8, 6.2],
    [20.2, 6.0],
    [19.9, 12.0],
    [20.0, 17.9],
    [26.0, 18.2],
    [26.4, 21.4],
    [28.0, 21.2],
    [27.8, 17.9],
    [33.8, 18.0],
    [34.0, 6.1],
    [6.0, 6.2],
    [6.1, 10.5],
];

/// Fingerprint of a mapper's weights and of every particle's path and whole map, bit for bit.
pub fn digest(mapper: &LaserMapper) -> Digest {
    let (mut digest, filter) = (Digest::new(), mapper.filter());
    filter.weights().as_slice().iter().for_each(|w| digest.f64(*w));
    for particle in filter.particles() {
        for pose in particle.path.poses() {
            [pose.x, pose.y, pose.theta].into_iter().for_each(|x| digest.f64(x));
        }
    }
    Map::hash_all(filter.particles().iter().map(|particle| &particle.map), &mut digest);
    digest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::golden::logs;
    use fastslam::mapper::{LaserMapperSettings, Replay};
    use fastslam_log::relation_errors;
    use std::sync::Arc;

    #[test]
    fn our_own_building_is_mapped_within_centimetres() {
        let Example { log, relations, .. } = Example::new(usize::MAX);
        let log = Arc::new(log);
        let raw = relation_errors(&log.odometry, &log.odometry, &relations).unwrap();
        let settings = LaserMapperSettings { particles: 8, ..LaserMapperSettings::default() };
        let mut replay = Replay::new(settings, Arc::clone(&log)).unwrap();
        replay.by_ref().for_each(drop);
        let mapper = replay.mapper();
        assert_eq!(mapper.path().len(), log.scans.len());
        let errors = relation_errors(&mapper.path(), &log.odometry, &relations).unwrap();
        assert!(raw.translation_mean > 0.5, "odometry alone must fail: {raw:?}");
        assert!(errors.translation_mean < 0.06 && errors.rotation_mean_deg < 0.5, "{errors:?}");
        let (footprint, estimate) = (mapper.footprint(), settings.memory_estimate(&log.scans));
        // Particles that are selected seldom share little with each other, but each shares what is old with the map of some scans ago.
        assert!(footprint.unique < footprint.dense / 2, "{footprint:?}");
        assert!(footprint.unique < estimate && estimate < 2 * footprint.unique, "{estimate} for {footprint:?}");
    }

    /// Of the path that is bent to close its loop.
    #[test]
    fn the_golden_run_that_is_called_bent_is() {
        let (name, mut replay) = logs().pop().unwrap();
        replay.by_ref().for_each(drop);
        assert_eq!((name, replay.mapper().closings()), ("log-bent", 1));
    }

    #[test]
    fn the_robot_of_the_example_drives_through_doors_and_not_through_walls() {
        let (plan, Example { truth, .. }) = (FloorPlan::building(), Example::new(usize::MAX));
        for (k, pair) in truth.windows(2).enumerate() {
            let [dx, dy] = [pair[1].x - pair[0].x, pair[1].y - pair[0].y];
            let free = plan.raycast([pair[0].x, pair[0].y], fastslam::ops::atan2(dy, dx));
            assert!(free > pair[0].distance(&pair[1]) + 0.1, "step {k} at {:?}: a wall after {free} m", pair[0]);
        }
    }
}
