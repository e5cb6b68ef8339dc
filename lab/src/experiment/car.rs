//! A car among trees: the vehicle and the tuning for logs like that of Victoria Park, and a simulated one.
//!
//! References: Guivant, Nebot (IEEE T-RA 2001), whose vehicle this is; Montemerlo, *FastSLAM* (thesis, CMU 2003), chapter 4.

use super::landmarks::{LandmarkLog, Tuning};
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use core::f64::consts::PI;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::Gate;
use fastslam::motion::{Car, Motion};
use fastslam::nalgebra::Vector2;
use fastslam::ops;
use fastslam::random::{Purpose, Stream};
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};

/// How far beside the rear axle's middle the wheel runs that is read \[m\].
pub const WHEEL_ASIDE: f64 = 0.76;

/// What a filter is told. The vehicle's dimensions are those that its log is distributed with; the noises are ours, for steps of some 0.2 s: 5 cm/s and
/// 5 % of the speed, 2° of steering, half a metre and 3° for the middle of a tree.
pub fn tuning() -> Tuning<Car> {
    Tuning {
        motion: Car {
            wheel_base: 2.83,
            mount: [3.78, 0.5],
            speed_std: 0.05,
            speed_share: 0.05,
            steering_std: 2.0 * PI / 180.0,
        },
        sensor: RangeBearing { range_std: 0.5, bearing_std: 3.0 * PI / 180.0, max_range: 30.0, field_of_view: PI },
        gate: Gate::default(),
    }
}

/// How many poses are drawn together and how many steps are seen beyond them, where they are drawn late: one second of each, in which the car drives 3 m.
pub const WINDOW: [u32; 2] = [4, 4];

/// Two rounds of two loops between 60 trees, with the noise of a seed.
pub fn simulate(seed: u64) -> LandmarkLog {
    const STEP: f64 = 0.25;
    const TREES: u32 = 60;
    let Tuning { motion, sensor, .. } = tuning();
    let tree = |k| {
        let mut stream = Stream::at(23, Purpose::TRIAL, 0, k);
        Vector2::new(-60.0 + 120.0 * stream.uniform(), -60.0 + 120.0 * stream.uniform())
    };
    let mut log = LandmarkLog { landmarks: (0..TREES).map(tree).collect(), ..LandmarkLog::default() };
    log.truth.push(Pose2::default());
    log.odometry.push(Pose2::default());
    // Circles of 25 m to the left and to the right, at 3 m/s.
    let steering = ops::atan2(motion.wheel_base, 25.0);
    let steps = (2.0 * PI * 25.0 / (3.0 * STEP)).round() as u32;
    for step in 1..=4 * steps {
        let left = ((step - 1) / steps).is_multiple_of(2);
        let driven = motion.control(3.0, if left { steering } else { -steering }, 0.0, STEP);
        let truth = motion.apply(&log.truth[log.truth.len() - 1], &driven);
        let reported = motion.perturb(&driven, &mut Stream::at(seed, WORLD_ODOMETRY, step, 0));
        log.odometry.push(motion.apply(&log.odometry[log.odometry.len() - 1], &reported));
        let see = |(signature, at): (u32, &Vector2<f64>)| {
            let mut stream = Stream::at(seed, WORLD_SENSOR, step, signature);
            let z = sensor.measure(&truth, at, &mut stream);
            sensor.sees(&truth, at, 0.0).then_some(Feature { z, signature: Some(signature) })
        };
        log.sightings.push((0..).zip(&log.landmarks).filter_map(see).collect());
        log.truth.push(truth);
        log.controls.push(reported);
    }
    log
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::ErrorSummary;
    use crate::experiment::landmarks::{LandmarkRun, LandmarkSetup};
    use std::sync::Arc;

    /// Known correspondence, M = 100: the medians of the errors as they went, where raw odometry is metres off.
    ///
    /// FastSLAM 2.0 resamples every few steps. When a loop closes all particles descend from one or two of those that began it, and their mean is hardly
    /// more than one draw of where the car may be, which errs by √2 times what the mean of all draws does: it comes near the joint filter, and does
    /// not reach it. Particles that draw late resample less often, some lines are left, and they do.
    ///
    /// Returns the medians of FastSLAM 2.0 and of late draws.
    fn late_draws_are_near_the_joint_filter(seeds: core::ops::RangeInclusive<u64>) -> [f64; 2] {
        let errors: Vec<[f64; 4]> = seeds
            .map(|seed| {
                let setup = LandmarkSetup { seed, ..LandmarkSetup::default() };
                let mut run = LandmarkRun::new(&setup, &tuning(), simulate(seed).into()).unwrap();
                while run.step().is_some() {}
                let late = run.rms_late(&setup, &tuning(), WINDOW).unwrap();
                let errors = [run.rms_online(), late, run.rms_ekf(&setup, &tuning()), run.rms_odometry()];
                println!("seed {seed}: {errors:.3?}");
                errors
            })
            .collect();
        let [ours, late, joint, raw] =
            [0, 1, 2, 3].map(|k| ErrorSummary::of(&errors.iter().map(|run| run[k]).collect::<Vec<_>>()).median);
        assert!(ours < 2.0 * joint && raw > 3.0 * joint, "{ours} {joint} {raw}");
        assert!(late < 1.2 * joint, "{late} {joint}");
        [ours, late]
    }

    #[test]
    fn a_hundred_particles_are_within_a_fifth_of_the_joint_filter_where_they_draw_late() {
        late_draws_are_near_the_joint_filter(1..=3);
    }

    /// Why the drift of a car is not learnt unless that is asked for: the noise it is told is wide, and this one does not drift. The median of five seeds is 1.04 m
    /// where it is 0.72 m without.
    #[test]
    fn a_car_that_does_not_drift_is_followed_nearly_as_well_where_its_drift_is_learnt() {
        let (mut plain, mut learning) = (Vec::new(), Vec::new());
        for seed in 1..=5 {
            let (setup, log) = (LandmarkSetup { seed, ..LandmarkSetup::default() }, Arc::new(simulate(seed)));
            let mut run = LandmarkRun::new(&setup, &tuning(), Arc::clone(&log)).unwrap();
            while run.step().is_some() {}
            plain.push(run.rms_online());
            let mut run = LandmarkRun::learning(&setup, &tuning(), log).unwrap();
            while run.step().is_some() {}
            learning.push(run.rms_online());
        }
        println!("{plain:.3?} {learning:.3?}");
        let [plain, learning] = [plain, learning].map(|errors| ErrorSummary::of(&errors).median);
        assert!(learning < 2.0 * plain, "{learning} {plain}");
    }

    /// Of a few seeds the median does not tell which of the two is nearer to the truth.
    #[test]
    #[ignore = "breadth: forty seeds"]
    fn a_hundred_particles_that_draw_late_are_nearer_than_those_that_do_not_over_forty_seeds() {
        let [ours, late] = late_draws_are_near_the_joint_filter(1..=40);
        assert!(late < ours, "{late} {ours}");
    }
}
