//! A robot with a camera among marked posts and other robots: what the logs of UTIAS MRCLAM are like, with their tuning and a simulated one.
//!
//! What makes such a log hard where bar codes are not read: other robots are seen like landmarks, stand for a while and drive on; what is in
//! view is found in less than half of the pictures; successive pictures repeat their errors; and posts stand 18 cm apart, in groups.
//!
//! Reference: Leung, Halpern, Barfoot, Liu, *The UTIAS multi-robot cooperative localization and mapping dataset* (IJRR 2011).

use super::landmarks::{LandmarkLog, Tuning};
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::Gate;
use fastslam::motion::{Motion, Velocity, VelocityDiffusion};
use fastslam::nalgebra::Vector2;
use fastslam::ops;
use fastslam::random::{Purpose, Stream};
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};

/// What a filter is told of such a robot, one setting for both proposals and both kinds of correspondence.
///
/// Calibrated on robot 1 of data set 6, against its motion capture:
/// - Wheels. The heading's error is white: over 0.3 s and over two minutes it comes to 0.03 rad per root of a second, nothing at
///   rest and most in turns. So the noise is a diffusion. Drawn once a step, the same numbers told a filter half of it, as steps take 0.3 s.
/// - Camera. It errs by 0.12 m and 0.02 rad, but 0.6 of that variance is the same twenty seconds later, which a filter takes for
///   independent: it is told two and a half times the deviations.
/// - View. Within 6 m and 0.45 rad to each side a post is found in one picture of three. So a sighting pays for two misses, the odds, and
///   twenty in hand are enough for a post and few enough for a robot that was parked.
pub fn tuning() -> Tuning<VelocityDiffusion> {
    Tuning {
        motion: VelocityDiffusion { speed_std: 0.0075, turn_rate_std: 0.001, alphas: [0.0, 0.0, 0.16, 0.0155] },
        sensor: RangeBearing { range_std: 0.3, bearing_std: 0.05, max_range: 6.0, field_of_view: 0.9 },
        gate: Gate {
            removal: true,
            sighting_worth: 2,
            most_count: 20,
            merge_squared: Gate::default().mahalanobis_squared,
            ..Gate::default()
        },
    }
}

/// Draws of the arena that are neither the wheels' nor the camera's.
const ARENA: Purpose = Purpose::new(17);

/// Time between two pictures \[s\].
const STEP: f64 = 0.6;

/// Pictures of a drive: twelve minutes.
const STEPS: u32 = 1200;

/// Robots that drive about without a name.
const OTHERS: u32 = 4;

/// For how many pictures another robot stands in one place, and an error of the camera is repeated.
const STANDS: u32 = 90;
const REPEATS: u32 = 33;

/// Half the sides of the arena \[m\].
const HALF: [f64; 2] = [3.0, 4.5];

/// Fifteen posts in five groups of three, 18 cm apart.
fn posts() -> Vec<Vector2<f64>> {
    let groups = [(-2.4, -4.3, 0.3), (2.6, -4.2, 1.9), (3.0, 0.4, 2.6), (-2.9, 1.2, 0.8), (0.8, 4.6, 0.1)];
    let group = |(x, y, angle): (f64, f64, f64)| {
        let (sin, cos) = ops::sin_cos(angle);
        [-0.18, 0.0, 0.18].map(|at| Vector2::new(x + at * cos, y + at * sin))
    };
    groups.into_iter().flat_map(group).collect()
}

/// A place of the arena, by its address.
fn place(seed: u64, when: u32, who: u32) -> Vector2<f64> {
    let mut stream = Stream::at(seed, ARENA, when, who);
    let mut within = |half: f64| half * (2.0 * stream.uniform() - 1.0);
    Vector2::new(within(HALF[0]), within(HALF[1]))
}

/// A drive from place to place, with the noise of a seed.
pub fn simulate(seed: u64) -> LandmarkLog {
    let Tuning { motion, sensor, .. } = tuning();
    let mut log = LandmarkLog { landmarks: posts(), ..LandmarkLog::default() };
    let start = Pose2::new(0.0, -1.0, 1.0);
    log.truth.push(start);
    log.odometry.push(start);
    let (mut goal, mut goals) = (place(seed, 0, 0), 0);
    for step in 1..=STEPS {
        let here = log.truth[log.truth.len() - 1];
        let to = Vector2::new(goal.x - here.x, goal.y - here.y);
        if to.norm() < 0.4 {
            goals += 1;
            goal = place(seed, goals, 0);
        }
        let off = ops::wrap_angle(ops::atan2(to.y, to.x) - here.theta);
        let speed = if off.abs() < 0.6 { 0.12 } else { 0.03 };
        let reported = Velocity { speed, turn_rate: off.clamp(-0.35, 0.35), duration: STEP };
        let odometry = reported.apply(&log.odometry[log.odometry.len() - 1]);
        log.truth.push(motion.sample(&here, &reported, &mut Stream::at(seed, WORLD_ODOMETRY, step, 0)));
        log.odometry.push(odometry);
        log.controls.push(reported);
        log.sightings.push(picture(seed, step, &log.truth[log.truth.len() - 1], &log.landmarks, &sensor));
    }
    log
}

/// What the camera finds in one picture: posts and robots up to 8 m, the nearer the more often, with errors half of which it repeats.
fn picture(seed: u64, step: u32, pose: &Pose2, posts: &[Vector2<f64>], sensor: &RangeBearing) -> Vec<Feature> {
    const REPEATED: [f64; 2] = [0.09, 0.015];
    const OWN: [f64; 2] = [0.075, 0.0125];
    const FARTHEST: f64 = 8.0;
    let robots = (0..OTHERS).map(|who| {
        // Not all drive on at once.
        place(seed, (step + who * STANDS / OTHERS) / STANDS, who + 1)
    });
    let named = (0..).map(Some).zip(posts.iter().copied());
    let mut found = Vec::new();
    for (slot, (signature, at)) in (0..).zip(named.chain(robots.map(|at| (None, at)))) {
        let z = sensor.predict(pose, &at).z;
        let mut stream = Stream::at(seed, WORLD_SENSOR, step, slot);
        let [a, b] = stream.normals();
        let in_view = z.x < FARTHEST && z.x > 0.5 && z.y.abs() < 0.5;
        if in_view && stream.uniform() < 0.5 * (1.0 - z.x / FARTHEST) + 0.1 {
            let [c, d] = Stream::at(seed, ARENA, step / REPEATS, 1000 + slot).normals();
            let range = z.x + OWN[0] * a + REPEATED[0] * c;
            let bearing = z.y + OWN[1] * b + REPEATED[1] * d;
            found.push(Feature { z: Vector2::new(range.max(0.1), bearing), signature });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::landmarks::{CorrespondenceKind, Course, LandmarkRun, LandmarkSetup};
    use crate::experiment::{ErrorSummary, ProposalKind};
    use fastslam::particle::Particle;
    use fastslam::proposal::FromMeasurement;
    use std::sync::Arc;

    /// Landmarks in the best particle's map at the end, for each of these seeds.
    fn landmarks_left<D: Motion<Control = Velocity> + Clone>(
        seeds: core::ops::RangeInclusive<u64>,
        tuning: &Tuning<D>,
        proposal: ProposalKind,
    ) -> Vec<f64> {
        let left = |seed| {
            let correspondence = CorrespondenceKind::Unknown;
            let setup = LandmarkSetup { particles: 50, seed, proposal, correspondence, ..LandmarkSetup::default() };
            let mut run = LandmarkRun::new(&setup, tuning, simulate(seed).into()).unwrap();
            while run.step().is_some() {}
            run.particles()[run.best()].map.iter().count() as f64
        };
        seeds.map(left).collect()
    }

    /// Without bar codes, when up to four robots stand among fifteen posts. Before, every robot that had stood anywhere stayed in the map.
    ///
    /// The path is not better for it any more. Medians over 100 seeds of its RMS error after alignment, with this tuning and before it:
    /// FastSLAM 1.0 0.222 and 0.221 m, 2.0 0.175 and 0.171 m, with the smaller error on 46 and 49 of the seeds. As long as each feature chose
    /// in the order of the list it was 0.191 and 0.204 m, 0.186 and 0.177 m, on 55 and 51 seeds; and 0.198 and 0.238 m, 0.175 and 0.201 m, on
    /// 57 and 62, where not the posts but the nearest stood first in it. Features that are assigned together do less harm without the tuning.
    fn moving_robots_leave_no_landmarks(seeds: core::ops::RangeInclusive<u64>) {
        for proposal in [ProposalKind::Motion, ProposalKind::Improved] {
            let before = Tuning {
                motion: tuning().motion,
                sensor: RangeBearing { max_range: 9.0, field_of_view: 1.1, ..tuning().sensor },
                gate: Gate::default(),
            };
            let left = landmarks_left(seeds.clone(), &tuning(), proposal);
            let left_before = landmarks_left(seeds.clone(), &before, proposal);
            let [count, count_before] = [&left, &left_before].map(|counts| ErrorSummary::of(counts).median);
            assert!((14.0..=22.0).contains(&count), "{proposal:?}: {count} landmarks");
            assert!(count_before > 28.0, "{proposal:?}: {count_before} landmarks before");
            let fewer = left.iter().zip(&left_before).all(|(left, before)| *left < 0.9 * before);
            assert!(fewer, "{proposal:?}: {left:?} landmarks, before {left_before:?}");
        }
    }

    #[test]
    fn as_many_landmarks_are_left_as_there_are_posts() {
        moving_robots_leave_no_landmarks(1..=3);
    }

    #[test]
    #[ignore = "breadth: ten seeds"]
    fn as_many_landmarks_are_left_as_there_are_posts_over_ten_seeds() {
        moving_robots_leave_no_landmarks(1..=10);
    }

    /// The median over simulated robots 1 to 5 of how far FastSLAM errs as it goes, in errors of EKF-SLAM on the same drive. Neither is told which post it
    /// sees; M = 100, and of these seeds of the filter the median counts.
    fn of_the_joint_filter(proposal: ProposalKind, seeds: core::ops::RangeInclusive<u64>) -> f64 {
        let correspondence = CorrespondenceKind::Unknown;
        let setup = |seed| LandmarkSetup { seed, proposal, correspondence, ..LandmarkSetup::default() };
        let ratio = |robot| {
            let log = Arc::new(simulate(robot));
            let mut joint = 0.0;
            let errors = seeds.clone().map(|seed| {
                let mut run = LandmarkRun::new(&setup(seed), &tuning(), Arc::clone(&log)).unwrap();
                while run.step().is_some() {}
                if seed == *seeds.start() {
                    joint = run.rms_ekf(&setup(seed), &tuning());
                }
                run.rms_online()
            });
            let error = ErrorSummary::of(&errors.collect::<Vec<f64>>()).median;
            println!("{proposal:?}, robot {robot}: {error:.3} m, the joint filter {joint:.3} m");
            error / joint
        };
        ErrorSummary::of(&(1..=5).map(ratio).collect::<Vec<f64>>()).median
    }

    /// Nothing of the tuning was chosen by these robots. Found: 0.83 for FastSLAM 2.0 and 1.42 for 1.0; by the first seed alone, 1.77 for 2.0.
    #[test]
    fn without_bar_codes_particles_err_by_at_most_half_more_than_the_joint_filter() {
        let ratio = of_the_joint_filter(ProposalKind::Improved, 1..=5);
        assert!(ratio <= 1.5, "{ratio}");
    }

    #[test]
    #[ignore = "breadth: the other version"]
    fn without_bar_codes_particles_of_fastslam_1_err_by_at_most_half_more_than_the_joint_filter() {
        let ratio = of_the_joint_filter(ProposalKind::Motion, 1..=5);
        assert!(ratio <= 1.5, "{ratio}");
    }

    /// The median over steps and particles of how much of the motion's deviation of heading is left after what was seen of mapped landmarks.
    fn left<D: Motion<Control = Velocity> + Clone>(tuning: &Tuning<D>, log: LandmarkLog) -> f64 {
        let log = Arc::new(log);
        let setup = LandmarkSetup { particles: 10, ..LandmarkSetup::default() };
        let mut run = LandmarkRun::new(&setup, tuning, Arc::clone(&log)).unwrap();
        let proposal = FromMeasurement { motion: tuning.motion.clone() };
        let mut shares = Vec::new();
        for (control, features) in log.controls.iter().zip(&log.sightings) {
            for Particle { world_from_robot: from, map, .. } in run.particles() {
                let before = tuning.motion.covariance(from, control).m33;
                let measured = proposal.fold(map, from, control, features);
                if measured.informed && before > 0.0 {
                    shares.push((measured.covariance.m33 / before).sqrt());
                }
            }
            run.step();
        }
        ErrorSummary::of(&shares).median
    }

    /// Why FastSLAM 2.0 gains little over 1.0 here: a picture, told as blunt as its repeated errors make it, takes a fifth off the deviation of
    /// heading that the wheels leave since the last one, so both draw from nearly the same distribution. On the figure of eight, where 2.0 is
    /// better, a look takes seven eighths off.
    #[test]
    fn a_picture_leaves_most_of_the_wheels_doubt_where_a_sharp_sensor_leaves_little() {
        let eight = Course::Eight;
        let [camera, sharp] = [left(&tuning(), simulate(1)), left(&eight.tuning(), eight.simulate(1))];
        assert!(camera > 0.7, "{camera}");
        assert!(sharp < 0.2, "{sharp}");
    }
}
