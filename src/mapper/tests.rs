use super::*;
use crate::ops;
use crate::proposal::ProposalTrace;
use crate::resampling::ResamplePolicy;
use nalgebra::{Matrix3, Vector3};
use std::hash::{DefaultHasher, Hasher};
use std::sync::Arc;

/// Scans every 10 cm on a straight way through a room of 6 m × 4 m, by wheels that count a tenth too much.
fn scans(count: usize, beams: usize) -> Vec<LaserScan> {
    let angle_step = core::f64::consts::PI / (beams - 1) as f64;
    let first_angle = -0.5 * core::f64::consts::PI;
    let scan = |k: usize| {
        let x = 0.1 * k as f64;
        let range = |beam: usize| {
            let (sin, cos) = ops::sin_cos(first_angle + beam as f64 * angle_step);
            ((4.0 - x) / cos.max(1e-9)).min(2.0 / sin.abs().max(1e-9)) as f32
        };
        LaserScan {
            time: k as f64,
            odometry: Pose2::new(1.1 * x, 0.0, 0.0),
            robot_from_laser: Pose2::default(),
            first_angle,
            angle_step,
            max_range: None,
            ranges: (0..beams).map(range).collect(),
        }
    };
    (0..count).map(scan).collect()
}

fn settings() -> LaserMapperSettings {
    LaserMapperSettings { particles: 4, ..LaserMapperSettings::default() }
}

/// With these scans pushed.
fn pushed(settings: LaserMapperSettings, scans: &[LaserScan]) -> LaserMapper {
    let mut mapper = LaserMapper::new(settings).unwrap();
    scans.iter().for_each(|scan| drop(mapper.push(scan)));
    mapper
}

/// All that a mapper says, with every particle's whole map.
fn state(mapper: &LaserMapper) -> (Vec<(f64, Pose2)>, u32, f64, Option<u32>, u64) {
    let mut hasher = DefaultHasher::new();
    Map::hash_all(mapper.filter.particles().iter().map(|particle| &particle.map), &mut hasher);
    (mapper.path(), mapper.steps, mapper.resampled_fraction(), mapper.single_lineage_since, hasher.finish())
}

/// For comparisons: with and without, the same scans by wheels that turn by 3° a metre.
#[test]
fn wheels_that_are_not_learnt_stay_as_they_are_assumed() {
    let mut scans = scans(25, 60);
    for (k, scan) in scans.iter_mut().enumerate() {
        scan.odometry.theta = 0.005 * k as f64;
    }
    let [kept, learnt] = [false, true]
        .map(|learn_wheels| pushed(LaserMapperSettings { learn_wheels, ..settings() }, &scans).wheels().drift());
    assert_eq!(kept, 0.0);
    assert!(learnt != 0.0);
}

#[test]
fn scans_that_are_pushed_one_by_one_give_the_replay_of_their_log() {
    let mut scans = scans(12, 60);
    // The robot stands before it drives, in between, and at the end.
    scans.insert(6, scans[5].clone());
    scans.insert(0, scans[0].clone());
    scans.push(scans[13].clone());
    let log = Arc::new(scans);
    for settings in [settings(), LaserMapperSettings { min_travel: 0.25, particles: 1, ..settings() }] {
        let mut replay = Replay::new(settings, Arc::clone(&log)).unwrap();
        let mut mapper = LaserMapper::new(settings.for_scans(&log)).unwrap();
        let mut reports = Vec::new();
        for scan in &*log {
            reports.extend(mapper.push(scan).report().map(|report| (report.step, report.ess, report.log_evidence)));
        }
        assert_eq!((replay.len(), replay.step_count() as usize), (reports.len(), reports.len()));
        let replayed = replay.by_ref().map(|report| (report.step, report.ess, report.log_evidence));
        assert_eq!(replayed.collect::<Vec<_>>(), reports);
        assert_eq!(state(replay.mapper()), state(&mapper));
        assert_eq!((replay.len(), replay.next().is_none()), (0, true));
    }
}

#[test]
fn a_robot_that_stands_still_looks_once_and_its_path_goes_on() {
    let mut scans = scans(3, 60);
    let still = scans[1].clone();
    let again = |k: u32| LaserScan { time: still.time + 0.01 * f64::from(k), ..still.clone() };
    scans.splice(2..2, (1..=5).map(again));
    let mut replay = Replay::new(settings(), Arc::new(scans)).unwrap();
    // Between two steps, every scan up to the next one that is taken has its place.
    assert_eq!((replay.mapper().path().len(), replay.scans()), (1, 1));
    replay.next();
    assert_eq!((replay.mapper().path().len(), replay.scans()), (7, 7));
    replay.by_ref().for_each(drop);
    let path = replay.mapper().path();
    assert_eq!((replay.mapper().steps(), path.len()), (2, 8));
    assert_eq!(path[1].1, path[6].1);
}

#[test]
fn the_map_is_the_room_and_the_path_is_as_long_as_the_robot_drove() {
    let scans = scans(21, 181);
    let mapper = |seed| pushed(LaserMapperSettings { particles: 30, seed, ..settings() }, &scans);
    for seed in 2..=10 {
        // Half a cell, where the wheels are off by 0.2 m.
        let Pose2 { x, y, theta } = mapper(seed).pose();
        assert!((x - 2.0).abs() < 0.025 && y.abs() < 0.025 && theta.abs() < 0.01, "seed {seed}: {x} {y} {theta}");
    }
    let mapper = mapper(1);
    let log_odds = |x, y| {
        let (i, j) = mapper.map().cell_of(x, y);
        mapper.map().log_odds(i, j)
    };
    assert!(log_odds(4.01, 0.0) > 0.5 && log_odds(3.5, 0.0) < -0.5 && log_odds(3.0, 2.01) > 0.5);
    assert_eq!(log_odds(4.5, 0.0), 0.0, "nobody looked behind the wall");
}

/// After 10 cm the prior is narrower than the cells by which a lattice looks: a mapper that took that for a scan which tells nothing
/// believed its wheels, and one particle alone was 14 cm off after 2 m.
#[test]
fn after_a_short_motion_every_scan_is_matched() {
    for seed in 1..=5 {
        let mut mapper = LaserMapper::new(LaserMapperSettings { particles: 4, seed, ..settings() }).unwrap();
        for report in scans(21, 181).iter().filter_map(|scan| mapper.push(scan).report()) {
            assert_eq!(report.matched(), 4, "seed {seed}, step {}", report.step);
        }
        assert!((mapper.pose().x - 2.0).abs() < 0.025, "seed {seed}: {:?}", mapper.pose());
    }
}

/// Nothing is in range: what a closer look finds is nothing, too.
#[test]
fn a_scan_that_met_nothing_is_not_matched() {
    let mut scans = scans(11, 181);
    scans.iter_mut().for_each(|scan| scan.ranges.fill(f32::INFINITY));
    let mut mapper = LaserMapper::new(settings()).unwrap();
    let matched: usize =
        scans.iter().filter_map(|scan| mapper.push(scan).report()).map(|report| report.matched()).sum();
    assert_eq!((matched, mapper.steps()), (0, 10));
}

#[test]
fn the_pose_is_the_end_of_the_path() {
    let mut mapper = LaserMapper::new(LaserMapperSettings { min_travel: 0.3, ..settings() }).unwrap();
    assert_eq!((mapper.pose(), mapper.path().len()), (Pose2::default(), 0));
    for scan in scans(9, 60) {
        drop(mapper.push(&scan));
        assert_eq!(mapper.path().last(), Some(&(scan.time, mapper.pose())));
    }
    assert_eq!(mapper.steps(), 2);
}

/// What the particles drew from in a step, with their scores.
fn mixture(mapper: &LaserMapper, report: &Report<()>) -> Vec<(Pose2, Matrix3<f64>, f64)> {
    let scores = mapper.filter.weights().tempered(MODELS.selection_temper);
    let drawn_from = report.traces.iter().map(|trace| match trace {
        ProposalTrace::Matched { mode, covariance, .. } => (*mode, *covariance),
        ProposalTrace::Motion => panic!("every scan is matched here"),
    });
    drawn_from.zip(scores.as_slice()).map(|((mode, covariance), score)| (mode, covariance, *score)).collect()
}

/// By the mean of the mixture, and Huygens and Steiner: the covariance about the mean, and what lies between the mean and the pose. Of a single particle
/// it is that of the fit about the mode.
#[test]
fn the_covariance_of_the_pose_is_the_second_moment_of_what_was_drawn_from_about_it() {
    for particles in [1, 4] {
        let settings = LaserMapperSettings { particles, policy: ResamplePolicy::Never, ..settings() };
        let mut mapper = LaserMapper::new(settings).unwrap();
        assert_eq!(mapper.pose_with_covariance().covariance, Matrix3::zeros());
        for scan in &scans(9, 60) {
            let Some(report) = mapper.push(scan).report() else { continue };
            let now = mapper.pose_with_covariance();
            let mixture = mixture(&mapper, &report);
            let offset = |pose: &Pose2| pose.minus(&now.pose);
            let mean: Vector3<f64> = mixture.iter().map(|(mode, _, score)| offset(mode) * *score).sum();
            let within = mixture.iter().map(|(mode, covariance, score)| {
                let d = offset(mode) - mean;
                (covariance + d * d.transpose()) * *score
            });
            let expected: Matrix3<f64> = within.sum::<Matrix3<f64>>() + mean * mean.transpose();
            assert!((now.covariance - expected).norm() < 1e-12, "{} {expected}", now.covariance);
            assert!(now.stds().iter().all(|std| *std > 1e-3), "{now:?}");
        }
    }
}

/// All particles are copies of one, with a heading at the cut of the angle: each was drawn from a tenth of a radian beside it.
#[test]
fn particles_that_are_copies_of_one_leave_what_it_was_drawn_from_open() {
    let settings = LaserMapperSettings { particles: 2, ..settings() };
    let start = Pose2::new(1.0, 2.0, core::f64::consts::PI);
    let filter = filter(&settings, 60, Map::new(settings.grid())).start(start).build().unwrap();
    let covariance = Matrix3::from_diagonal(&[4e-4, 1e-4, 1e-4].into());
    let still = Displacement { mean: Pose2::default(), covariance: Matrix3::zeros() };
    let mut report = filter.clone().step(&still, &Scan::default());
    let beside = Pose2::new(1.0, 2.0, core::f64::consts::PI + 0.1);
    report.paths = filter.particles().iter().map(|particle| particle.path.clone()).collect();
    report.traces = [start, beside].map(|mode| ProposalTrace::Matched { mode, covariance, log_integral: 0.0 }).into();
    report.ancestors = Some(vec![1, 1]);
    let resampled = Spreads::of(&report, &still).now(&filter, None, &Wheels::default());
    let turned = Matrix3::from_diagonal(&[0.0, 0.0, 0.01].into());
    assert!((resampled.covariance - covariance - turned).norm() < 1e-15, "{}", resampled.covariance);
}

/// By J C Jᵀ + Q: a metre ahead, an error of the heading lies to the side.
#[test]
fn a_robot_that_has_moved_on_is_as_uncertain_as_odometry_leaves_it() {
    let settings = LaserMapperSettings { min_travel: 1.5, ..settings() };
    let mut scans = scans(2, 60);
    let mut mapper = pushed(settings, &scans[..1]);
    scans[1].odometry = Pose2::new(1.0, 0.0, 0.0);
    let covariance = Matrix3::from_diagonal(&[1e-4, 1e-4, 4e-4].into());
    mapper.spreads = Spreads::about(&Pose2::default(), &covariance, 4);
    drop(mapper.push(&scans[1]));
    let noise = mapper.wheels.displacement(&scans[1].odometry).covariance;
    let moved = Matrix3::new(1e-4, 0.0, 0.0, 0.0, 5e-4, 4e-4, 0.0, 4e-4, 4e-4);
    let now = mapper.pose_with_covariance();
    assert!((now.covariance - moved - noise).norm() < 1e-15 && now.pose == scans[1].odometry, "{now:?}");
}

#[test]
fn a_scan_that_is_passed_over_is_moved_by_raw_odometry_from_the_one_before_that_was_taken() {
    let scans = scans(9, 60);
    let path = pushed(LaserMapperSettings { min_travel: 0.3, ..settings() }, &scans).path();
    // By 0.11 m a scan, every third is taken.
    for (k, ((time, pose), scan)) in path.iter().zip(&scans).enumerate() {
        let taken = k - k % 3;
        let moved = path[taken].1.between(pose).minus(&scans[taken].odometry.between(&scan.odometry));
        assert!(*time == scan.time && moved.norm() < 1e-12, "scan {k}: {moved}");
    }
}

#[test]
fn the_frame_of_the_odometry_makes_no_difference() {
    let plain = pushed(settings(), &scans(6, 60));
    let frame = Pose2::new(30.0, -20.0, 2.0);
    let mut moved = scans(6, 60);
    moved.iter_mut().for_each(|scan| scan.odometry = frame.compose(&scan.odometry));
    let moved = pushed(settings(), &moved);
    for ((_, a), (_, b)) in plain.path().iter().zip(moved.path()) {
        assert!(a.minus(&b).norm() < 1e-6, "{a:?}, {b:?}");
    }
}

#[test]
fn a_scan_whose_pose_is_no_place_changes_nothing() {
    let good = scans(5, 60);
    let sound = pushed(settings(), &good);
    for absurd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        for spoil in [
            |scan: &mut LaserScan, absurd| scan.odometry.x = absurd,
            |scan: &mut LaserScan, absurd| scan.robot_from_laser.y = absurd,
            // Large is no fault of an angle or a time; the square of 1e300 is infinite.
            |scan: &mut LaserScan, absurd: f64| scan.first_angle = absurd * absurd,
            |scan: &mut LaserScan, absurd: f64| scan.time = absurd * absurd,
        ] {
            let mut bad = good[2].clone();
            spoil(&mut bad, absurd);
            let mut mixed = good.clone();
            // First of all, in between and at the end.
            for at in [5, 3, 0] {
                mixed.insert(at, bad.clone());
            }
            assert_eq!(state(&pushed(settings(), &mixed)), state(&sound), "{bad:?}");
            let online = settings().for_scans(&mixed);
            let mut replay = Replay::new(online, Arc::new(mixed)).unwrap();
            assert_eq!(replay.by_ref().count(), 4);
            assert_eq!(replay.mapper().path().len(), 5);
        }
    }
}

#[test]
fn a_clone_goes_its_own_way() {
    let scans = scans(8, 60);
    let mut mapper = pushed(settings(), &scans[..4]);
    let (mut other, before) = (mapper.clone(), state(&mapper));
    scans[4..].iter().for_each(|scan| drop(other.push(scan)));
    assert_eq!(state(&mapper), before);
    scans[4..].iter().for_each(|scan| drop(mapper.push(scan)));
    assert_eq!(state(&mapper), state(&other));
}

#[test]
fn an_executor_stays_when_the_first_scan_comes() {
    let mapper = LaserMapper::new(settings()).unwrap().with_executor(Executor::Serial);
    let after = scans(1, 60).iter().fold(mapper.clone(), |mut mapper, scan| {
        drop(mapper.push(scan));
        mapper
    });
    for mapper in [mapper, after] {
        let shown = format!("{:?}", mapper.filter);
        assert!(shown.contains("executor: Serial"), "{shown}");
    }
}

#[test]
fn what_a_log_tells_of_its_laser_fills_in_what_is_not_set() {
    let mut scans = scans(5, 60);
    scans[2].ranges = vec![80.0];
    let of_log = settings().for_scans(&scans);
    assert_eq!((of_log.no_return, of_log.beams), (Some(0.97 * 80.0), Some(60)));
    let set = LaserMapperSettings { no_return: Some(7.0), beams: Some(9), ..settings() };
    assert_eq!(set.for_scans(&scans), set);
    assert_eq!(settings().for_scans(&[]), LaserMapperSettings { no_return: Some(0.0), ..settings() });
}

#[test]
fn a_mapper_that_is_told_nothing_of_its_laser_goes_by_the_scans_themselves() {
    let mut scans = scans(6, 361);
    let told = LaserMapperSettings { no_return: Some(3.9), beams: Some(361), ..settings() };
    let told = pushed(told, &scans);
    scans.iter_mut().for_each(|scan| scan.max_range = Some(3.9));
    assert_eq!(state(&told), state(&pushed(settings(), &scans)));
    let other = LaserMapperSettings { beams: Some(180), ..settings() };
    assert_ne!(state(&told), state(&pushed(other, &scans)));
}

#[test]
fn a_setting_out_of_its_range_is_refused_by_its_name() {
    let refused = |settings| LaserMapper::new(settings).unwrap_err().field();
    assert_eq!(refused(LaserMapperSettings { particles: 0, ..settings() }), "particles");
    assert_eq!(refused(LaserMapperSettings { cell_size: f64::NAN, ..settings() }), "cell_size");
    assert_eq!(refused(LaserMapperSettings { max_range: 1e9, ..settings() }), "max_range");
    assert_eq!(refused(LaserMapperSettings { min_travel: -1.0, ..settings() }), "min_travel");
    assert_eq!(refused(LaserMapperSettings { no_return: Some(-1.0), ..settings() }), "no_return");
    let policy = crate::resampling::ResamplePolicy::EssBelow(2.0);
    assert_eq!(refused(LaserMapperSettings { policy, ..settings() }), "policy");
    assert!(Replay::new(LaserMapperSettings { particles: 5000, ..settings() }, Arc::new(scans(1, 60))).is_err());
}

#[test]
fn an_empty_log_is_no_steps() {
    let mut replay = Replay::new(settings(), Arc::new(Vec::new())).unwrap();
    assert_eq!((replay.step_count(), replay.len(), replay.next().is_none()), (0, 0, true));
    assert_eq!(replay.mapper().path(), []);
}
