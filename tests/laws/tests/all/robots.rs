//! What a mapper must find alike, however a robot is built and its drive is cut up: a laser mounted anywhere, steps of any length.

use fastslam::geometry::Pose2;
use fastslam::mapper::{LaserMapper, LaserMapperSettings, Replay};
use fastslam::motion::OdometryModel;
use fastslam::random::{Purpose, Stream};
use fastslam_lab::experiment::graph::PathError;
use fastslam_lab::experiment::log::{Example, Recipe};
use fastslam_lab::world::LongRing;
use fastslam_log::LaserLog;
use std::f64::consts::PI;
use std::sync::Arc;

/// Once round a corridor of 60 m and on for a quarter, with nobody in it.
fn ring(seed: u64) -> Recipe {
    let ring = LongRing { length: 60.0, seed };
    let wheels = OdometryModel { alphas: [0.0; 4] };
    let (plan, route) = (ring.plan(), ring.once_and_a_quarter());
    Recipe { seed, plan, route, spacing: 0.4, max_range: 12.0, wheels, ..Recipe::building() }
}

pub fn mapped(log: LaserLog, particles: usize, seed: u64) -> LaserMapper {
    let settings = LaserMapperSettings { particles, seed, ..LaserMapperSettings::default() };
    let mut replay = Replay::new(settings, Arc::new(log)).unwrap();
    replay.by_ref().for_each(drop);
    replay.mapper().clone()
}

/// Where a mapper has the robot at each scan.
pub fn poses(mapper: &LaserMapper) -> Vec<Pose2> {
    mapper.path().into_iter().map(|(_, pose)| pose).collect()
}

/// Lasers in the centre, ahead, aside, turned to the left, and upside down ahead and aside: the mean error over six seeds (M = 2) is at most 4.5 cm more
/// than that of the laser in the centre, 3.7 cm. Found: 1.8, 1.0, −2.2 and 3.5 cm; ahead 6.6 cm where free space is traced from the robot's centre.
#[test]
fn a_laser_may_be_mounted_anywhere() {
    const SEEDS: u64 = 6;
    let mountings = [
        ("centre", Pose2::default(), false, 0.0),
        ("ahead", Pose2::new(0.6, 0.0, 0.0), false, 0.045),
        ("aside", Pose2::new(0.0, 0.4, 0.0), false, 0.045),
        ("turned", Pose2::new(0.0, 0.0, 0.5 * PI), false, 0.045),
        ("upside down", Pose2::new(0.6, 0.4, 0.0), true, 0.045),
    ];
    let mut centre = 0.0;
    for (name, robot_from_laser, upside_down, margin) in mountings {
        let error = |seed| {
            let recipe = Recipe { robot_from_laser, upside_down, scatter: 0.5, ..ring(seed) };
            let Example { log, truth, .. } = Example::of(&recipe, usize::MAX);
            let path = poses(&mapped(log, 2, seed));
            PathError::of(&path, &truth).aligned
        };
        let errors: Vec<f64> = (1..=SEEDS).map(error).collect();
        let mean = errors.iter().sum::<f64>() / SEEDS as f64;
        println!("{name}: {mean:.3} of {errors:.3?}");
        if margin == 0.0 {
            centre = mean;
        }
        assert!(mean - centre <= margin, "{name}: {mean} m, in the centre {centre} m");
    }
}

/// Wheels whose heading scatters by 0.03 rad/√m, drawn here: what is learnt of them after 75 m is within a quarter of that, and of each other, by steps
/// from 2 cm to 1 m.
#[test]
fn the_noise_of_wheels_is_one_number_however_a_drive_is_cut() {
    const HEADING_STD: f64 = 0.03;
    let learnt = [0.02, 0.1, 0.3, 1.0].map(|spacing| {
        let Example { mut log, truth, .. } = Example::of(&Recipe { spacing, ..ring(1) }, usize::MAX);
        let mut odometry = Pose2::default();
        for (k, scan) in log.scans.iter_mut().enumerate() {
            if k > 0 {
                let step = truth[k - 1].between(&truth[k]);
                let way = step.distance(&Pose2::default());
                let [normal] = Stream::at(3, Purpose::TRIAL, k as u32, 0).normals();
                let turned = HEADING_STD * way.sqrt() * normal;
                odometry = odometry.compose(&Pose2::new(step.x, step.y, step.theta + turned));
            }
            scan.odometry = odometry;
        }
        let std = mapped(log, 2, 1).wheels().heading_std();
        println!("{spacing} m: {std:.4} rad/√m");
        std
    });
    let [least, most] = [f64::min, f64::max].map(|of| learnt.into_iter().reduce(of).unwrap());
    assert!(most < 1.25 * least, "{learnt:?}");
    assert!(learnt.iter().all(|std| (0.75..1.25).contains(&(std / HEADING_STD))), "{learnt:?}");
}
