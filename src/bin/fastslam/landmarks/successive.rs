//! Whether successive looks at landmarks without names agree with the noises that were told: no filter and no map is asked.
//!
//! A filter that chooses the landmark of each measurement by itself chooses what agrees, and founds a landmark of what does not. So its innovations
//! do not show noises that were told too small. Two looks in a row do: what is seen in both is one rigid figure, moved by what the robot drove.

use fastslam::geometry::Pose2;
use fastslam::motion::Motion;
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};
use fastslam_lab::experiment::landmarks::LandmarkLog;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

/// Most steps between two looks that are compared.
const STEPS: usize = 5;

/// How many times farther than its match any other feature must lie from what was predicted.
const FARTHER: f64 = 3.0;

/// Looks before and after two that are compared in which no two features may lie where one is taken to be.
const AROUND: usize = 10;

/// Least share of the features of a look that are met again in the next, over all looks. Two neighbours of which each is found in one look of four are found
/// together in none of the looks around only one time in four, so that most matches are right; of what is found less often they may be wrong.
const MET: f64 = 0.25;

/// Ratio of variances that is not worth a word: deviations by a factor of √2, as for innovations.
const WORTH: f64 = 2.0;

/// Standard deviations of a fair coin's count: a chance of 10⁻⁵, as for innovations.
const SURE: f64 = 4.26;

/// By how many times successive looks differ more than the noises of sensor and odometry allow, as a ratio of standard deviations, where they surely do by
/// more than √2; else 1.
///
/// It is √ median(νᵀ S⁻¹ ν / median χ²) over pairs of looks: half of them may be spoilt by what moves or is mistaken for another. Where told noises are
/// right, it is 1, or less where the sensor repeats its errors from look to look.
pub fn excess<D: Motion>(log: &LandmarkLog<D::Control>, motion: &D, sensor: &RangeBearing) -> f64 {
    let looks = Looks { log, motion, sensor };
    let seen: Vec<usize> = (0..log.sightings.len()).filter(|k| !log.sightings[*k].is_empty()).collect();
    let (mut ratios, mut met, mut all) = (Vec::new(), 0, 0);
    // Each look is in one pair, so that the errors of pairs are independent.
    for pair in seen.chunks_exact(2).filter(|pair| pair[1] - pair[0] <= STEPS) {
        let matches = looks.matches(pair[0], pair[1]);
        all += log.sightings[pair[0]].len();
        met += matches.len();
        ratios.extend(looks.ratio(pair[0], pair[1], &matches));
    }
    ratios.sort_unstable_by(f64::total_cmp);
    let count = ratios.len() as f64;
    let beyond = ratios.iter().filter(|ratio| **ratio > WORTH).count() as f64;
    let is_sure = met as f64 >= MET * all as f64 && 2.0 * beyond > count + SURE * count.sqrt();
    if is_sure { ratios[ratios.len() / 2].sqrt() } else { 1.0 }
}

struct Looks<'a, D: Motion> {
    log: &'a LandmarkLog<D::Control>,
    motion: &'a D,
    sensor: &'a RangeBearing,
}

impl<D: Motion> Looks<'_, D> {
    fn features(&self, look: usize) -> &[Feature] {
        &self.log.sightings[look]
    }

    /// The pose of one look as seen from another, by odometry.
    fn motion(&self, from: usize, to: usize) -> Pose2 {
        self.log.odometry[from + 1].between(&self.log.odometry[to + 1])
    }

    /// Where features of a look lie as seen from another.
    fn seen_from(&self, from: usize, look: usize) -> Vec<Vector2<f64>> {
        let pose = self.motion(from, look);
        self.features(look).iter().map(|feature| self.sensor.locate(&pose, &feature.z)).collect()
    }

    /// Features of two looks, by their places in both, that must be of one landmark.
    fn matches(&self, first: usize, second: usize) -> Vec<[usize; 2]> {
        let [before, after] = [first, second].map(|look| self.seen_from(second, look));
        let around: Vec<Vec<Vector2<f64>>> = (first.saturating_sub(AROUND)..=second + AROUND)
            .filter(|look| *look < self.log.sightings.len())
            .map(|look| self.seen_from(second, look))
            .collect();
        let is_alone = |at: Vector2<f64>, far: f64| {
            around.iter().all(|look| look.iter().filter(|other| (*other - at).norm() <= far).count() < 2)
        };
        let nearest = |to: &Vector2<f64>| {
            let off = |k: &usize| (after[*k] - to).norm();
            (0..after.len()).min_by(|a, b| off(a).total_cmp(&off(b))).map(|k| (k, off(&k)))
        };
        let met = before.iter().enumerate().filter_map(|(k, at)| {
            let (to, off) = nearest(at)?;
            is_alone((at + after[to]) / 2.0, FARTHER * off).then_some([k, to])
        });
        met.collect()
    }

    /// νᵀ S⁻¹ ν of all matches by the median of χ² with as many degrees of freedom.
    ///
    /// Feature i of the second look differs by νᵢ from what the first and the odometry predict of it, with the covariance Wᵢ⁻¹ of both measurements; and
    /// all by H of one error of the odometry, of covariance Q. So S = diag(Wᵢ⁻¹) + H Q Hᵀ, and by Woodbury νᵀ S⁻¹ ν = Σ νᵢᵀ Wᵢ νᵢ − bᵀ (1 + Q A)⁻¹ Q b
    /// with A = Σ Hᵢᵀ Wᵢ Hᵢ and b = Σ Hᵢᵀ Wᵢ νᵢ.
    fn ratio(&self, first: usize, second: usize, matches: &[[usize; 2]]) -> Option<f64> {
        let (start, noise) = (Pose2::default(), self.sensor.noise());
        let (mut pose, mut q) = (start, Matrix3::zeros());
        for control in &self.log.controls[first + 1..=second] {
            let drive = self.motion.drive(control);
            let to = drive.apply(&pose);
            let g = Matrix3::new(1.0, 0.0, pose.y - to.y, 0.0, 1.0, to.x - pose.x, 0.0, 0.0, 1.0);
            q = g * q * g.transpose() + drive.covariance(&pose);
            pose = to;
        }
        let (mut squared, mut a, mut b) = (0.0, Matrix3::zeros(), Vector3::zeros());
        for [before, after] in matches {
            let [z, seen] = [self.features(first)[*before].z, self.features(second)[*after].z];
            let at = self.sensor.locate(&start, &z);
            let (from, to) = (self.sensor.predict(&start, &at), self.sensor.predict(&pose, &at));
            let j: Matrix2<f64> = to.h_m * from.h_m.try_inverse()?;
            let w = (noise + j * noise * j.transpose()).try_inverse()?;
            let nu = self.sensor.residual(&seen, &to.z);
            squared += nu.dot(&(w * nu));
            a += to.h_x.transpose() * w * to.h_x;
            b += to.h_x.transpose() * (w * nu);
        }
        squared -= b.dot(&((Matrix3::identity() + q * a).try_inverse()? * (q * b)));
        let freedom = 2.0 * matches.len() as f64;
        (freedom > 0.0 && squared.is_finite()).then(|| squared / median_of_chi2(freedom))
    }
}

/// Median of χ² with so many degrees of freedom, by Wilson and Hilferty (1931).
fn median_of_chi2(freedom: f64) -> f64 {
    let root = 1.0 - 2.0 / (9.0 * freedom);
    freedom * root * root * root
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastslam::motion::{Velocity, VelocityModel};
    use fastslam::ops;
    use fastslam::random::{Purpose, Stream};
    use fastslam_lab::experiment::{camera, car, landmarks::Course};
    use std::f64::consts::TAU;

    const SENSOR: RangeBearing =
        RangeBearing { range_std: 0.05, bearing_std: 0.01, max_range: 6.0, field_of_view: TAU };
    const MOTION: VelocityModel = VelocityModel { speed_std: 0.02, turn_rate_std: 0.02, alphas: [0.0; 4] };

    /// A number from −`half` to `half`.
    fn within(half: f64, stream: &mut Stream) -> f64 {
        half * (2.0 * stream.uniform() - 1.0)
    }

    /// Worlds of landmarks, each with how often one in reach is found. Posts stand 0.2 m apart, and are so seldom found together that each seems to be one.
    fn worlds(seed: u64) -> [(&'static str, Vec<Vector2<f64>>, f64); 6] {
        let mut stream = Stream::at(seed, Purpose::TRIAL, 0, 1);
        let mut place = || Vector2::new(within(12.0, &mut stream), within(12.0, &mut stream));
        let scattered: Vec<_> = (0..60).map(|_| place()).collect();
        let pairs = |apart: f64| -> Vec<_> {
            scattered[..15].iter().flat_map(|at| [*at, at + Vector2::new(0.6 * apart, 0.8 * apart)]).collect()
        };
        let ring = (0..32).map(|k| {
            let (radius, angle) = (if k % 2 == 0 { 6.0 } else { 10.0 }, TAU * f64::from(k) / 32.0);
            Vector2::new(radius * ops::cos(angle), radius * ops::sin(angle))
        });
        let corridor = (0..32).map(|k| Vector2::new(f64::from(k) - 16.0, if k % 2 == 0 { 1.2 } else { -1.2 }));
        [
            ("sparse", scattered[..12].to_vec(), 0.9),
            ("dense", scattered.clone(), 0.9),
            ("pairs", pairs(1.0), 0.9),
            ("ring", ring.collect(), 0.9),
            ("corridor", corridor.collect(), 0.9),
            ("posts", pairs(0.2), 0.3),
        ]
    }

    /// Ten minutes among landmarks, with the noises of [`MOTION`] and [`SENSOR`].
    fn drive(seed: u64, landmarks: &[Vector2<f64>], found: f64) -> LandmarkLog {
        let mut log = LandmarkLog::default();
        let (mut truth, mut odometry) = (Pose2::default(), Pose2::default());
        log.odometry.push(odometry);
        for step in 0..1000_u32 {
            let mut stream = Stream::at(seed, Purpose::TRIAL, step, 2);
            let [a, b] = stream.normals();
            // It turns about where it leaves the field.
            let off = ops::wrap_angle(ops::atan2(-truth.y, -truth.x) - truth.theta);
            let is_far = ops::hypot(truth.x, truth.y) > 10.0 && off.abs() > 0.5;
            let turn_rate = if is_far { 0.6 } else { 0.3 * ops::sin(0.11 * f64::from(step)) };
            let driven = Velocity { speed: 0.4, turn_rate, duration: 0.6 };
            let reported = Velocity {
                speed: driven.speed + MOTION.speed_std * a,
                turn_rate: driven.turn_rate + MOTION.turn_rate_std * b,
                ..driven
            };
            truth = driven.apply(&truth);
            odometry = reported.apply(&odometry);
            let seen = landmarks.iter().filter_map(|at| {
                let (dx, dy) = (at.x - truth.x, at.y - truth.y);
                let ([a, b], is_found) = (stream.normals(), stream.uniform() < found);
                let range = ops::hypot(dx, dy) + SENSOR.range_std * a;
                let bearing = ops::wrap_angle(ops::atan2(dy, dx) - truth.theta + SENSOR.bearing_std * b);
                (is_found && range > 0.3 && range < SENSOR.max_range)
                    .then(|| Feature { z: Vector2::new(range, bearing), signature: None })
            });
            log.sightings.push(seen.collect());
            log.controls.push(reported);
            log.odometry.push(odometry);
        }
        log
    }

    fn told(log: &LandmarkLog, range: f64, bearing: f64) -> f64 {
        let sensor =
            RangeBearing { range_std: SENSOR.range_std * range, bearing_std: SENSOR.bearing_std * bearing, ..SENSOR };
        excess(log, &MOTION, &sensor)
    }

    #[test]
    fn noises_that_are_told_right_are_not_told_too_small_in_any_world() {
        for seed in 1..=12 {
            for (world, landmarks, found) in worlds(seed) {
                let log = drive(seed, &landmarks, found);
                for [range, bearing] in [[1.0; 2], [3.0; 2], [1.0, 3.0], [0.8; 2]] {
                    assert_eq!(told(&log, range, bearing), 1.0, "{world} {seed}: told {range} {bearing}");
                }
            }
        }
    }

    #[test]
    fn noises_that_are_told_three_or_five_times_too_small_are_found_so() {
        for seed in 1..=12 {
            for (world, landmarks, found) in worlds(seed).into_iter().filter(|(.., found)| *found > 0.5) {
                let log = drive(seed, &landmarks, found);
                for times in [3.0, 5.0] {
                    let excess = told(&log, 1.0 / times, 1.0 / times);
                    assert!((0.6 * times..1.1 * times).contains(&excess), "{world} {seed}: {excess} of {times}");
                }
                assert!(told(&log, 0.2, 1.0) > 1.4, "{world} {seed}: ranges");
                // Where few are seen at a time, the odometry's own doubt explains bearings.
                assert!(world == "sparse" || told(&log, 1.0, 0.2) > 1.4, "{world} {seed}: bearings");
            }
        }
    }

    /// As those of the laboratory are told; the camera repeats its errors, and sees robots that drive on.
    #[test]
    fn of_the_simulated_robots_nothing_is_told() {
        for seed in 1..=12 {
            for course in [Course::Eight, Course::Tags, Course::Wings] {
                let tuning = course.tuning();
                assert_eq!(excess(&course.simulate(seed), &tuning.motion, &tuning.sensor), 1.0, "{course} {seed}");
            }
            let (camera, car) = (camera::tuning(), car::tuning());
            assert_eq!(excess(&camera::simulate(seed), &camera.motion, &camera.sensor), 1.0, "camera {seed}");
            assert_eq!(excess(&car::simulate(seed), &car.motion, &car.sensor), 1.0, "car {seed}");
        }
    }

    /// The medians of χ² with 1, 2, 4 and 20 degrees of freedom, from tables.
    #[test]
    fn the_median_of_chi_squared_is_that_of_tables() {
        for (freedom, median) in [(1.0, 0.4549), (2.0, 1.3863), (4.0, 3.3567), (20.0, 19.3374)] {
            assert!((median_of_chi2(freedom) / median - 1.0).abs() < 0.04, "{freedom}");
        }
    }
}
