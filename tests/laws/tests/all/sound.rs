//! Laws of input that cannot be true: numbers that are none, ranges that no sensor measures, controls that no robot drives. Whatever comes,
//! every number of a filter stays one.

use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Balanced, Blocks, Correspondence, Gate, Landmark, Landmarks, Store};
use fastslam::motion::{Floored, Motion, Velocity, VelocityModel};
use fastslam::nalgebra::Vector2;
use fastslam::particle::Particle;
use fastslam::proposal::{FromMeasurement, FromMotion, FromWindow, Marginal, Proposal, Windowed};
use fastslam::rbpf::Rbpf;
use fastslam::sensor::{Feature, RangeBearing};
use fastslam::smoothing::{Settings, Smoother};
use fastslam_lab::baseline::EkfSlam;
use fastslam_lab::experiment::landmarks::Course;

const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.05, bearing_std: 0.01, max_range: 6.0, field_of_view: core::f64::consts::PI };
const MOTION: VelocityModel = VelocityModel { speed_std: 0.0, turn_rate_std: 0.0, alphas: [0.04, 0.0, 0.01, 0.04] };

/// What no sensor of ranges and bearings measures.
fn impossible() -> Vec<Feature> {
    let feature = |range: f64, bearing: f64, signature| Feature { z: Vector2::new(range, bearing), signature };
    let ranges = [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, -2.0, 1e300, f64::MAX];
    let bearings = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let of_ranges = ranges.into_iter().map(|range| feature(range, 0.1, Some(3)));
    let of_bearings = bearings.into_iter().map(|bearing| feature(2.0, bearing, None));
    of_ranges
        .chain(of_bearings)
        .chain([feature(f64::NAN, f64::NAN, Some(0)), feature(3.0, 0.2, Some(u32::MAX))])
        .collect()
}

/// Controls without a meaning.
fn undrivable() -> Vec<Velocity> {
    let control = |speed, turn_rate, duration| Velocity { speed, turn_rate, duration };
    let mut all = vec![control(1e300, 0.0, 1.0), control(1.0, 0.0, f64::MAX), control(1e9, 0.1, 1e9)];
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        all.extend([control(bad, 0.0, 0.5), control(1.0, bad, 0.5), control(1.0, 0.1, bad)]);
    }
    all
}

type Step = (Velocity, Vec<Feature>);

/// A part of the course *eight*; signatures with wide gaps.
fn clean() -> Vec<Step> {
    let log = Course::Eight.simulate(4);
    let spread = |feature: Feature| Feature { signature: feature.signature.map(|s| s * 123_456_789), ..feature };
    let sightings = log.sightings.into_iter().map(|features| features.into_iter().map(spread).collect());
    log.controls.into_iter().zip(sightings).skip(17).take(45).collect()
}

/// The same with every kind of impossible feature between the others, some in each step and once all; and how many there are in each step.
fn spoiled(drive: &[Step]) -> (Vec<Step>, Vec<u32>) {
    let all = impossible();
    let spoil = |(k, (control, features)): (usize, &Step)| {
        let mut features = features.clone();
        let added = if k % 9 == 4 { all.len() } else { 1 + k % 2 };
        for (j, bad) in all.iter().cycle().skip(k).take(added).enumerate() {
            features.insert((j * 2 + k) % (features.len() + 1), *bad);
        }
        ((*control, features), added as u32)
    };
    drive.iter().enumerate().map(spoil).unzip()
}

fn correspondences() -> [Correspondence; 2] {
    [Correspondence::Known, Correspondence::Unknown(Gate { removal: true, merge_squared: 4.0, ..Gate::default() })]
}

fn is_finite(pose: &Pose2) -> bool {
    [pose.x, pose.y, pose.theta].iter().all(|x| x.is_finite())
}

fn landmark_numbers(landmarks: impl Iterator<Item = (u32, Landmark)>) -> Vec<f64> {
    landmarks.flat_map(|(_, m)| [m.mean.x, m.mean.y, m.covariance.m11, m.covariance.m12, m.covariance.m22]).collect()
}

/// The bits of every number of a filter on the way; for each step how many features it ignored, and whether it refused the control.
type Run = (Vec<u64>, Vec<u32>, Vec<bool>);

/// A run in which every number is finite.
fn run<Z, S, P>(map: Landmarks<Z, S>, proposal: P, drive: &[Step]) -> Run
where
    Z: fastslam::sensor::LandmarkSensor,
    S: Store,
    P: Proposal<Landmarks<Z, S>, Control = Velocity>,
{
    let mut filter = Rbpf::builder(map, proposal).particles(7).seed(2).build().unwrap();
    let (mut bits, mut ignored, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    for (control, features) in drive {
        let report = filter.step(control, features);
        ignored.push(report.ignored);
        refused.push(report.refused_control);
        let mut numbers: Vec<f64> = report.weights.iter().chain(&report.log_increments).copied().collect();
        numbers.extend([report.ess, report.log_evidence]);
        for Particle { world_from_robot: pose, map, .. } in filter.particles() {
            numbers.extend([pose.x, pose.y, pose.theta]);
            numbers.extend(landmark_numbers(map.iter().map(|(index, landmark)| (index, *landmark))));
        }
        assert!(numbers.iter().all(|x| x.is_finite()), "step {}: {numbers:?}", report.step);
        bits.extend(numbers.into_iter().map(f64::to_bits));
    }
    (bits, ignored, refused)
}

fn for_each_filter<S: Store>(correspondence: Correspondence, check: impl Fn(&dyn Fn(&[Step]) -> Run)) {
    let map = || Landmarks::<_, S>::new(SENSOR, correspondence);
    check(&|drive| run(map(), FromMotion { motion: MOTION, likelihood: Marginal }, drive));
    check(&|drive| run(map(), FromMeasurement { motion: MOTION }, drive));
}

/// To the bit, for each proposal, correspondence and store.
#[test]
fn what_cannot_be_measured_is_ignored_and_counted() {
    let drive = clean();
    let (bad, counts) = spoiled(&drive);
    for correspondence in correspondences() {
        let check = |run: &dyn Fn(&[Step]) -> Run| {
            let (expected, found) = (run(&drive), run(&bad));
            assert!(expected.0 == found.0, "{correspondence:?}");
            assert_eq!((&found.1, expected.1.iter().sum::<u32>()), (&counts, 0));
            assert!(!expected.2.contains(&true) && !found.2.contains(&true));
        };
        for_each_filter::<Blocks>(correspondence, check);
        for_each_filter::<Balanced>(correspondence, check);
    }
    // A plain vector has a place for each index below the largest: without signatures there are no gaps.
    let unknown = correspondences()[1];
    for_each_filter::<Vec<Option<Landmark>>>(unknown, |run| assert!(run(&drive).0 == run(&bad).0));
}

#[test]
fn a_control_that_cannot_be_driven_is_standing_still_and_told() {
    let mut still = clean();
    let mut wild = still.clone();
    for (k, bad) in undrivable().into_iter().enumerate() {
        assert!(!MOTION.can_drive(&bad), "{bad:?}");
        let at = 3 * k + 2;
        still[at].0 = Velocity { speed: 0.0, turn_rate: 0.0, duration: 0.0 };
        wild[at].0 = bad;
    }
    for correspondence in correspondences() {
        for_each_filter::<Blocks>(correspondence, |run| {
            let (expected, found) = (run(&still), run(&wild));
            assert!(expected.0 == found.0, "{correspondence:?}");
            let is_wild = |k: usize| k % 3 == 2 && k / 3 < undrivable().len();
            assert!(!expected.2.contains(&true) && (0..found.2.len()).all(|k| found.2[k] == is_wild(k)));
        });
    }
}

/// Bad features and bad controls in one drive: the proposal that draws late, and the joint filter.
#[test]
fn the_late_proposal_and_the_joint_filter_stay_finite_and_as_they_were() {
    let mut drive = clean();
    let (mut bad, counts) = spoiled(&drive);
    for (k, control) in undrivable().into_iter().enumerate() {
        drive[3 * k + 2].0 = Velocity { speed: 0.0, turn_rate: 0.0, duration: 0.0 };
        bad[3 * k + 2].0 = control;
    }
    for correspondence in correspondences() {
        let late = |drive: &[Step], counts: &[u32]| {
            let map = <Windowed<_, _>>::new(Landmarks::new(SENSOR, correspondence));
            let proposal = FromWindow { motion: MOTION, drawn: 2, ahead: 2 };
            let mut filter = Rbpf::builder(map, proposal).particles(4).seed(2).build().unwrap();
            let mut all = Vec::new();
            for (k, (control, features)) in drive.iter().enumerate() {
                let report = filter.step(control, features);
                assert_eq!(report.ignored, counts.get(k).copied().unwrap_or(0));
                all.extend(report.weights);
                for Particle { world_from_robot: pose, map, .. } in filter.particles() {
                    assert!(map.path().iter().chain([pose]).all(is_finite), "step {k}");
                    all.extend([pose.x, pose.y, pose.theta]);
                    all.extend(landmark_numbers(map.landmarks().iter().map(|(index, m)| (index, *m))));
                }
            }
            all
        };
        let joint = |drive: &[Step]| {
            let mut filter = EkfSlam::new(MOTION, SENSOR, correspondence, Pose2::default());
            let mut all = Vec::new();
            for (control, features) in drive {
                all.push(filter.step(control, features).log_evidence);
                all.extend([filter.pose().x, filter.pose().y, filter.pose().theta]);
            }
            all.extend(filter.covariance().iter());
            all
        };
        for (expected, found) in [(late(&drive, &[]), late(&bad, &counts)), (joint(&drive), joint(&bad))] {
            assert!(found.iter().all(|x| x.is_finite()), "{correspondence:?}");
            assert!(expected.iter().map(|x| x.to_bits()).eq(found.iter().map(|x| x.to_bits())), "{correspondence:?}");
        }
    }
}

/// A sweep along the wheels' own path.
#[test]
fn a_smoother_ignores_what_cannot_be_measured() {
    let drive = clean();
    let (bad, _) = spoiled(&drive);
    let motion = Floored { motion: MOTION, floor_stds: [0.02, 0.02, 0.01] };
    let mut path = vec![Pose2::default()];
    drive.iter().for_each(|(control, _)| path.push(control.apply(&path[path.len() - 1])));
    for correspondence in correspondences() {
        let swept = |drive: &[Step]| {
            let (controls, observations): (Vec<Velocity>, Vec<Vec<Feature>>) = drive.iter().cloned().unzip();
            let map = <Landmarks<_>>::new(SENSOR, correspondence);
            let settings = Settings { particles: 5, ..Settings::default() };
            let proposal = FromMeasurement { motion };
            let smoother = Smoother::new(settings, map, proposal, Pose2::default(), controls, observations).unwrap();
            smoother.sweep(0, &path).unwrap()
        };
        let (expected, found) = (swept(&drive), swept(&bad));
        assert!(found.path.iter().all(is_finite) && found.path == expected.path && found.map == expected.map);
    }
}
