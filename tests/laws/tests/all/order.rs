//! Laws of the order in which a sensor lists the features of a step: it decides nothing.

use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Association, Balanced, Blocks, Correspondence, Gate, Landmark, Landmarks, Store};
use fastslam::motion::{Odometry, OdometryModel, Velocity};
use fastslam::nalgebra::{Matrix2, Vector2};
use fastslam::proposal::{FromMeasurement, FromMotion, FromWindow, Marginal, Proposal, Windowed};
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;
use fastslam::sensor::{Feature, LandmarkSensor, Prediction, RangeBearing};
use fastslam_lab::baseline::EkfSlam;
use fastslam_lab::experiment::ErrorSummary;
use fastslam_lab::experiment::landmarks::Course;

/// Indices 0 to n − 1 in an order of chance, a new one for each step.
fn shuffled(n: usize, seed: u64, step: u32) -> Vec<usize> {
    let mut stream = Stream::at(seed, Purpose::TRIAL, step, 0);
    let mut keyed: Vec<(f64, usize)> = (0..n).map(|k| (stream.uniform(), k)).collect();
    keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
    keyed.into_iter().map(|(_, k)| k).collect()
}

fn reordered<T: Copy>(items: &[T], order: &[usize]) -> Vec<T> {
    order.iter().map(|k| items[*k]).collect()
}

/// The course *eight* up to where the first landmarks are met again, with two features of one signature in each fifth step, which only
/// one of the correspondences minds.
fn drive(seed: u64) -> Vec<(Velocity, Vec<Feature>)> {
    let log = Course::Eight.simulate(seed);
    let mut drive: Vec<_> = log.controls.into_iter().zip(log.sightings).skip(17).take(60).collect();
    for (_, features) in drive.iter_mut().step_by(5) {
        if let Some(first) = features.first().copied() {
            features.push(Feature { z: first.z + Vector2::new(0.02, 0.004), ..first });
        }
    }
    drive
}

/// The correspondences: two gates, of which the second takes many features for new landmarks and merges some of them again.
fn correspondences() -> [Correspondence; 3] {
    let gate = Course::Eight.tuning().gate;
    let tight = Gate { mahalanobis_squared: 4.0, log_new: 0.5, merge_squared: 9.0, ..gate };
    [Correspondence::Known, Correspondence::Unknown(gate), Correspondence::Unknown(tight)]
}

fn bits_of(pose: &Pose2, all: &mut Vec<u64>) {
    all.extend([pose.x, pose.y, pose.theta].map(f64::to_bits));
}

fn landmark_bits(landmarks: impl Iterator<Item = (u32, Landmark)>, all: &mut Vec<u64>) {
    for (index, landmark) in landmarks {
        all.extend([u64::from(index), landmark.existence_count as u64, u64::from(landmark.apart)]);
        all.extend(landmark.mean.iter().chain(&landmark.covariance).map(|x| x.to_bits()));
    }
}

/// Every number of a run with the features listed in an order of chance, or as they come; `associated` lists what features were taken for
/// as they came.
fn run<Z, S, P>(
    map: Landmarks<Z, S>,
    proposal: P,
    drive: &[(P::Control, Vec<Feature>)],
    order: Option<u64>,
) -> (Vec<u64>, Vec<Vec<Association>>)
where
    Z: LandmarkSensor,
    S: Store,
    P: Proposal<Landmarks<Z, S>>,
{
    let builder = Rbpf::builder(map, proposal).particles(12).seed(3).policy(ResamplePolicy::EssBelow(0.7));
    let mut filter = builder.build().unwrap();
    let (mut bits, mut associated) = (Vec::new(), Vec::new());
    for (step, (control, features)) in (0..).zip(drive) {
        let order = order.map_or_else(|| (0..features.len()).collect(), |seed| shuffled(features.len(), seed, step));
        let report = filter.step(control, &reordered(features, &order));
        bits.extend(report.weights.iter().chain(&report.log_increments).map(|x| x.to_bits()));
        for particle in filter.particles() {
            bits_of(&particle.world_from_robot, &mut bits);
            landmark_bits(particle.map.iter().map(|(index, landmark)| (index, *landmark)), &mut bits);
        }
        for of_slot in report.associations {
            let mut as_they_came = of_slot.clone();
            order.iter().zip(of_slot).for_each(|(k, association)| as_they_came[*k] = association);
            associated.push(as_they_came);
        }
    }
    (bits, associated)
}

fn order_decides_nothing<S: Store>(correspondence: Correspondence, order: u64) {
    let tuning = Course::Eight.tuning();
    let map = || Landmarks::<_, S>::new(tuning.sensor, correspondence);
    let drive = drive(2);
    let one = || FromMotion { motion: tuning.motion, likelihood: Marginal };
    let two = || FromMeasurement { motion: tuning.motion };
    let same = |a: (Vec<u64>, Vec<Vec<Association>>), b: (Vec<u64>, Vec<Vec<Association>>)| {
        assert!(a.0 == b.0, "{correspondence:?}, order {order}: other bits");
        assert!(a.1 == b.1, "{correspondence:?}, order {order}: other associations");
    };
    same(run(map(), one(), &drive, None), run(map(), one(), &drive, Some(order)));
    same(run(map(), two(), &drive, None), run(map(), two(), &drive, Some(order)));
}

#[test]
fn the_order_of_features_changes_no_bit_of_fastslam() {
    for correspondence in correspondences() {
        for order in 1..4 {
            order_decides_nothing::<Blocks>(correspondence, order);
        }
        order_decides_nothing::<Balanced>(correspondence, 4);
        order_decides_nothing::<Vec<Option<Landmark>>>(correspondence, 5);
    }
}

#[test]
fn the_order_of_features_changes_no_bit_of_the_proposal_that_draws_late() {
    let (tuning, drive) = (Course::Eight.tuning(), drive(2));
    for correspondence in correspondences() {
        let run = |order: Option<u64>| {
            let map = <Windowed<_, _>>::new(Landmarks::new(tuning.sensor, correspondence));
            let proposal = FromWindow { motion: tuning.motion, drawn: 2, ahead: 3 };
            let mut filter = Rbpf::builder(map, proposal).particles(6).seed(3).build().unwrap();
            let mut bits = Vec::new();
            for (step, (control, features)) in (0..).zip(&drive) {
                let n = features.len();
                let order = order.map_or_else(|| (0..n).collect(), |seed| shuffled(n, seed, step));
                let report = filter.step(control, &reordered(features, &order));
                bits.extend(report.log_increments.iter().map(|x| x.to_bits()));
                for particle in filter.particles() {
                    particle.map.path().iter().for_each(|pose| bits_of(pose, &mut bits));
                    landmark_bits(particle.map.landmarks().iter().map(|(k, landmark)| (k, *landmark)), &mut bits);
                }
            }
            bits
        };
        assert!((1..4).all(|order| run(Some(order)) == run(None)), "{correspondence:?}");
    }
}

#[test]
fn the_order_of_features_changes_no_bit_of_the_joint_filter() {
    let (tuning, drive) = (Course::Eight.tuning(), drive(2));
    for correspondence in correspondences() {
        let run = |order: Option<u64>| {
            let mut filter = EkfSlam::new(tuning.motion, tuning.sensor, correspondence, Pose2::default());
            let mut bits = Vec::new();
            for (step, (control, features)) in (0..).zip(&drive) {
                let n = features.len();
                let order = order.map_or_else(|| (0..n).collect(), |seed| shuffled(n, seed, step));
                bits.push(filter.step(control, &reordered(features, &order)).log_evidence.to_bits());
                bits_of(filter.pose(), &mut bits);
                bits.extend(filter.covariance().iter().map(|x| x.to_bits()));
                landmark_bits(filter.iter(), &mut bits);
            }
            bits
        };
        assert!((1..4).all(|order| run(Some(order)) == run(None)), "{correspondence:?}");
    }
}

// Sixty landmarks on a square that is driven twice. At each corner the robot turns on the spot, and its heading is off by some 9°.

const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 8.0, field_of_view: core::f64::consts::TAU };
const WHEELS: OdometryModel = OdometryModel { alphas: [0.01, 0.0, 0.0004, 0.0] };
const SIDE: u32 = 12;

/// The wheels' account of a drive, what is seen after each step, and where the robot truly is.
struct Square {
    controls: Vec<Odometry>,
    sightings: Vec<Vec<Feature>>,
    truth: Vec<Pose2>,
}

fn square(seed: u64) -> Square {
    let mut place = Stream::at(seed, Purpose::TRIAL, 0, 0);
    let mut within = || -2.0 + 16.0 * place.uniform();
    let field: Vec<Vector2<f64>> = (0..60).map(|_| Vector2::new(within(), within())).collect();
    let [still, ahead] = [0.0, 1.0].map(|trans| Odometry { rot1: 0.0, trans, rot2: 0.0 });
    let corner = Odometry { rot1: core::f64::consts::FRAC_PI_2, ..still };
    let side = || [ahead; SIDE as usize].into_iter().chain([corner]);
    let driven = [still; 5].into_iter().chain((0..8).flat_map(|_| side()));
    let (mut log, mut pose) =
        (Square { controls: Vec::new(), sightings: Vec::new(), truth: Vec::new() }, Pose2::default());
    for (step, told) in (1..).zip(driven) {
        // What is told is what the wheels reported; the truth is drawn from it.
        let [a, b] = Stream::at(seed, fastslam_lab::WORLD_ODOMETRY, step, 0).normals();
        let truly =
            Odometry { rot1: told.rot1 * (1.0 + 0.1 * a), trans: told.trans * (1.0 + 0.02 * b), rot2: told.rot2 };
        pose = truly.apply(&pose);
        let seen = (0..).zip(&field).filter(|(_, m)| SENSOR.sees(&pose, m, 0.0)).map(|(k, m)| {
            let mut stream = Stream::at(seed, fastslam_lab::WORLD_SENSOR, step, k);
            Feature { z: SENSOR.measure(&pose, m, &mut stream), signature: None }
        });
        log.sightings.push(seen.collect());
        log.controls.push(told);
        log.truth.push(pose);
    }
    log
}

/// A sensor that reports how much nearer than 50 m a landmark is: its smallest z is that of the farthest landmark.
#[derive(Clone, Copy, Debug)]
struct Nearness(RangeBearing);

const NEAREST: f64 = 50.0;

impl Nearness {
    fn turned(z: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(NEAREST - z.x, z.y)
    }
}

impl LandmarkSensor for Nearness {
    fn predict(&self, at: &Pose2, landmark: &Vector2<f64>) -> Prediction {
        let Prediction { z, mut h_x, mut h_m } = self.0.predict(at, landmark);
        h_x.row_mut(0).neg_mut();
        h_m.row_mut(0).neg_mut();
        Prediction { z: Self::turned(&z), h_x, h_m }
    }

    fn residual(&self, z: &Vector2<f64>, predicted: &Vector2<f64>) -> Vector2<f64> {
        self.0.residual(z, predicted)
    }

    fn least_mahalanobis_squared(&self, at: &Pose2, m: &Vector2<f64>, spread: &Matrix2<f64>, z: &Vector2<f64>) -> f64 {
        self.0.least_mahalanobis_squared(at, m, spread, &Self::turned(z))
    }

    fn locate(&self, at: &Pose2, z: &Vector2<f64>) -> Vector2<f64> {
        self.0.locate(at, &Self::turned(z))
    }

    fn noise(&self) -> Matrix2<f64> {
        self.0.noise()
    }

    fn sees(&self, at: &Pose2, landmark: &Vector2<f64>, margin: f64) -> bool {
        self.0.sees(at, landmark, margin)
    }
}

/// How far from the truth the mean of a hundred particles ends \[m\], by a sensor that reports this.
fn ends<Z: LandmarkSensor>(sensor: Z, seed: u64, report: impl Fn(&[Feature]) -> Vec<Feature>) -> f64 {
    let Square { controls, sightings, truth } = square(seed);
    let map = <Landmarks<_>>::new(sensor, Correspondence::Unknown(Gate::default()));
    let mut filter = Rbpf::builder(map, FromMeasurement { motion: WHEELS }).particles(100).seed(seed).build().unwrap();
    for (control, features) in controls.iter().zip(&sightings) {
        filter.step(control, &report(features));
    }
    filter.estimate().mean.distance(&truth[truth.len() - 1])
}

/// By the sensor whose features come nearest first, and by the one that turns them, over the first so many seeds.
///
/// Not the median alone: of twenty runs two may fail, and of eight none. As long as features chose in the order of the list, seven such worlds in
/// ten were mapped well in any order, and the others went metres astray: p90 3.76 m as listed, 0.16 m nearest first, 3.49 m farthest first.
fn assert_sixty_are_told_apart(seeds: u64) {
    let turned = |features: &[Feature]| -> Vec<Feature> {
        features.iter().map(|f| Feature { z: Nearness::turned(&f.z), ..*f }).collect()
    };
    let p90 = |of: &dyn Fn(u64) -> f64| ErrorSummary::of(&(1..=seeds).map(of).collect::<Vec<f64>>()).p90;
    let nearest_first = p90(&|seed| ends(SENSOR, seed, <[Feature]>::to_vec));
    let farthest_first = p90(&|seed| ends(Nearness(SENSOR), seed, turned));
    assert!(nearest_first <= 0.12 && farthest_first <= 0.12, "{nearest_first} {farthest_first}");
}

#[test]
fn sixty_landmarks_are_told_apart_whether_the_nearest_or_the_farthest_comes_first() {
    assert_sixty_are_told_apart(8);
}

#[test]
#[ignore = "breadth: twenty seeds"]
fn sixty_landmarks_are_told_apart_by_twenty_seeds() {
    assert_sixty_are_told_apart(20);
}
