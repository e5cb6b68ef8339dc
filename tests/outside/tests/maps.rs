//! Mappers of this robot: every proposal with what is its own, over a drive of 40 m.

use fastslam::geometry::{Pose2, rms};
use fastslam::map::landmarks::{Correspondence, Landmarks};
use fastslam::map::{ConditionalMap, Observed};
use fastslam::motion::Motion;
use fastslam::proposal::{FromMeasurement, FromMotion, FromScan, Marginal, Proposal};
use fastslam::rbpf::Rbpf;
use outside::beacons::Receiver;
use outside::hall::{BEACONS, Drive, drive};
use outside::points::{Nearest, Points};
use outside::search::SETTINGS;
use outside::wheels::{Rolled, Wheels};
use std::borrow::Borrow;

const WHEELS: Wheels = Wheels { axle: 0.4, slip: 0.06, jitter: 0.002 };
const RECEIVER: Receiver = Receiver { strength_std: 0.05, direction_std: 0.02, reach: 9.0 };
const NEAREST: Nearest = Nearest { std: 0.15, most: 0.3 };

/// The path by the wheels alone.
fn odometry(drive: &Drive) -> Vec<Pose2> {
    let mut path = vec![Pose2::default()];
    for u in &drive.counted {
        path.push(WHEELS.apply(&path[path.len() - 1], u));
    }
    path
}

/// The filter after the drive, and the root mean square error of its best path \[m\].
fn mapped<M, P>(map: M, proposal: P, observations: &[Observed<M>], drive: &Drive, particles: usize) -> (Rbpf<M, P>, f64)
where
    M: ConditionalMap,
    P: Proposal<M, Control = Rolled>,
{
    let mut filter = Rbpf::builder(map, proposal).particles(particles).seed(1).build().unwrap();
    for (u, observation) in drive.counted.iter().zip(observations) {
        assert!(filter.step(u, observation.borrow()).explained());
    }
    let path = filter.particles()[filter.best()].path.poses();
    let error = rms(&path, &drive.truth);
    (filter, error)
}

/// A map that knows what was heard at the start.
fn begun(drive: &Drive) -> Points {
    let mut map = Points::new(0.25);
    map.assimilate(
        &Pose2::default(),
        &outside::hall::listen(
            &drive.truth[0],
            &mut fastslam::random::Stream::at(9, fastslam::random::Purpose::new(101), 0, 0),
        ),
        &(),
    );
    map
}

/// A third of odometry's error for each of three drives; in fact it is less than a tenth.
#[test]
fn a_search_a_score_a_map_and_a_motion_of_ones_own_map_a_hall() {
    for seed in 1..4 {
        let drive = drive(&WHEELS, &RECEIVER, seed);
        let raw = rms(&odometry(&drive), &drive.truth);
        let from_scan = FromScan { motion: WHEELS, score: NEAREST, settings: SETTINGS };
        from_scan.settings.validate().unwrap();
        let (_, error) = mapped(begun(&drive), from_scan, &drive.echoes, &drive, 8);
        assert!(raw > 0.3 && error < raw / 3.0, "seed {seed}: {error} m, odometry {raw} m");
    }
}

/// Without looking first many more particles are needed.
#[test]
fn the_motion_alone_maps_it_with_many_particles() {
    for seed in 1..4 {
        let drive = drive(&WHEELS, &RECEIVER, seed);
        let raw = rms(&odometry(&drive), &drive.truth);
        let from_motion = FromMotion { motion: WHEELS, likelihood: NEAREST };
        let (_, error) = mapped(begun(&drive), from_motion, &drive.echoes, &drive, 100);
        assert!(error < raw / 2.0, "seed {seed}: {error} m, odometry {raw} m");
    }
}

#[test]
fn a_sensor_and_a_motion_of_ones_own_map_beacons_by_both_proposals() {
    for seed in 1..4 {
        let drive = drive(&WHEELS, &RECEIVER, seed);
        let raw = rms(&odometry(&drive), &drive.truth);
        let map = || <Landmarks<Receiver>>::new(RECEIVER, Correspondence::Known);
        let first = FromMotion { motion: WHEELS, likelihood: Marginal };
        let (filter, error) = mapped(map(), first, &drive.beacons, &drive, 100);
        assert!(error < raw / 2.0, "1.0, seed {seed}: {error} m, odometry {raw} m");
        assert_eq!(filter.particles()[0].map.iter().count(), BEACONS.len());
        let (_, error) = mapped(map(), FromMeasurement { motion: WHEELS }, &drive.beacons, &drive, 20);
        assert!(error < raw / 2.0, "2.0, seed {seed}: {error} m, odometry {raw} m");
    }
}
