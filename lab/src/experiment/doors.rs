//! Six identical doors: what it is worth that every particle decides for itself which one it sees.
//!
//! A robot maps a corridor of doors that look alike and of one sign at its end. Then it is carried back with its eyes closed, and
//! told where to with a standard deviation of more than the distance of two doors. It drives to the sign again. Until it gets there,
//! an explanation that is off by a door foretells every sighting as well as the truth does.
//!
//! Everything but the association is linear and Gaussian: the sensor reports offsets, the heading is known, and the true place after
//! the ride is drawn from the very Gaussian that both filters are told. With the right associations EKF-SLAM would be the Kalman
//! filter, and exact. Where it goes wrong it has decided wrongly.

use crate::baseline::EkfSlam;
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use fastslam::error::{Range, SettingError};
use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Correspondence, Gate, Landmarks};
use fastslam::motion::Motion;
use fastslam::nalgebra::{Matrix2, Matrix2x3, Matrix3, Vector2};
use fastslam::proposal::{FromMotion, Marginal};
use fastslam::random::Stream;
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;
use fastslam::sensor::{Feature, LandmarkSensor, Prediction};

/// Number of doors.
pub const DOORS: u32 = 6;

/// From one door to the next \[m\]; the first is so far from the start.
pub const SPACING: f64 = 3.0;

/// Where the sign hangs \[m\]: two thirds of the way to where a seventh door would be, so that no explanation has a door there.
pub const SIGN: f64 = SPACING * (DOORS as f64 + 2.0 / 3.0);

/// Standard deviation of where the ride ends, as both filters are told \[m\].
pub const RIDE_STD: f64 = 4.0;

/// Where the ride is to end \[m\]: the middle of the corridor.
const RIDE_END: f64 = 9.0;

/// Where it may truly end \[m\]: in the corridor, with at least one door before the sign. Other draws are drawn again; one in twenty.
const RIDE_RANGE: core::ops::Range<f64> = 1.0..17.0;

/// One step of the robot \[m\], with the standard deviation of its odometry \[m\].
const STEP: Shift = Shift { by: 0.5, std: 0.005 };

/// How far from the sign the drive ends \[m\].
const BEYOND: f64 = 0.5;

/// All landmarks are on one wall \[m\].
const WALL: f64 = 1.0;

/// A filter that ends so near the truth \[m\] is right: the next explanation is a whole spacing away.
const RIGHT_WITHIN: f64 = 1.0;

/// An explanation with less than this share of the weight is given up.
const HELD: f64 = 0.01;

/// What a reader can set.
#[derive(Clone, PartialEq, Debug)]
pub struct DoorsSetup {
    /// Number of particles M, 1 to 100 000.
    pub particles: usize,
    /// When to resample.
    pub policy: ResamplePolicy,
}

impl Default for DoorsSetup {
    fn default() -> Self {
        Self { particles: 100, policy: ResamplePolicy::EssBelow(0.5) }
    }
}

impl DoorsSetup {
    fn validate(&self) -> Result<(), SettingError> {
        Range::whole(1, 100_000).check("particles", self.particles as f64)?;
        self.policy.validate()
    }
}

/// What one seed came to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct DoorsOutcome {
    /// How many doors the particles take the first door after the ride for, those with 1 % of the weight or more.
    pub first: u32,
    /// How many explanations are left when the sign comes in sight, before it is taken into account.
    pub last: u32,
    /// Whether the best particle ends where the robot is.
    pub fastslam_right: bool,
    /// Whether EKF-SLAM does, on the same log.
    pub ekf_right: bool,
}

/// Both filters on the drive of each of these seeds.
///
/// # Errors
/// Where a setting is out of its range.
pub fn outcomes(setup: &DoorsSetup, seeds: core::ops::Range<u64>) -> Result<Vec<DoorsOutcome>, SettingError> {
    setup.validate()?;
    seeds.map(|seed| outcome(setup, seed)).collect()
}

fn outcome(setup: &DoorsSetup, seed: u64) -> Result<DoorsOutcome, SettingError> {
    let log = Log::new(seed);
    let (particles, ekf) = (run_particles(setup, seed, &log)?, run_ekf(&log));
    let right = |pose: &Pose2| (pose.x - log.truth[log.truth.len() - 1]).abs() < RIGHT_WITHIN;
    let [first, last] = particles.held;
    Ok(DoorsOutcome { first, last, fastslam_right: right(&particles.best), ekf_right: right(ekf.pose()) })
}

struct ParticleRun {
    /// Explanations held after the first door that follows the ride, and at the step before the sign.
    held: [u32; 2],
    best: Pose2,
}

fn run_particles(setup: &DoorsSetup, seed: u64, log: &Log) -> Result<ParticleRun, SettingError> {
    let map = Landmarks::<_>::new(Offset, correspondence());
    let proposal = FromMotion { motion: Corridor, likelihood: Marginal };
    let mut filter = Rbpf::builder(map, proposal)
        .particles(setup.particles)
        .seed(seed)
        .policy(setup.policy)
        .executor(Executor::Serial)
        .build()?;
    let mut held = [0; 2];
    for (k, (control, features)) in log.controls.iter().zip(&log.sightings).enumerate() {
        filter.step(control, features);
        let now = [log.first_door, log.sign - 1].map(|step| step == k);
        if now.contains(&true) {
            let places: Vec<f64> = filter.particles().iter().map(|p| p.world_from_robot.x).collect();
            let count = explanations(&places, filter.weights().as_slice(), log.truth[k + 1]);
            held = [0, 1].map(|which| if now[which] { count } else { held[which] });
        }
    }
    Ok(ParticleRun { held, best: filter.particles()[filter.best()].world_from_robot })
}

fn run_ekf(log: &Log) -> EkfSlam<Corridor, Offset> {
    let mut ekf = EkfSlam::new(Corridor, Offset, correspondence(), Pose2::default());
    for (control, features) in log.controls.iter().zip(&log.sightings) {
        ekf.step(control, features);
    }
    ekf
}

fn correspondence() -> Correspondence {
    Correspondence::Unknown(Gate::default())
}

/// Of so many doors forwards or backwards from the truth, how many hold their share of the weight.
fn explanations(places: &[f64], weights: &[f64], truth: f64) -> u32 {
    let most = DOORS as i32;
    let mut shares = [0.0; 2 * DOORS as usize + 1];
    for (x, weight) in places.iter().zip(weights) {
        let off = ((x - truth) / SPACING).round() as i32;
        if (-most..=most).contains(&off) {
            shares[(off + most) as usize] += weight;
        }
    }
    shares.iter().filter(|share| **share >= HELD).count() as u32
}

/// A drive, and the places on the corridor that it truly led to.
struct Log {
    /// x of steps 0 to T \[m\].
    truth: Vec<f64>,
    /// The k-th leads from step k to k + 1.
    controls: Vec<Shift>,
    /// What was seen at steps 1 to T.
    sightings: Vec<Vec<Feature>>,
    /// Index of the sightings in which the first door after the ride is.
    first_door: usize,
    /// Index of the sightings in which the sign is, the second time.
    sign: usize,
}

impl Log {
    fn new(seed: u64) -> Self {
        let mut log = Self { truth: vec![0.0], controls: vec![], sightings: vec![], first_door: 0, sign: 0 };
        log.drive_to_the_sign(seed);
        let ride = Shift { by: RIDE_END - log.here(), std: RIDE_STD };
        let ends = (0..).map(|attempt| {
            let mut stream = Stream::at(seed, WORLD_ODOMETRY, 0, attempt);
            RIDE_END + RIDE_STD * stream.normal()
        });
        let end = { ends }.find(|x| RIDE_RANGE.contains(x)).expect("most draws are in range");
        log.push(ride, end, vec![]);
        let ridden = log.controls.len();
        log.drive_to_the_sign(seed);
        let seen = |z: fn(&Feature) -> bool| (ridden..).zip(&log.sightings[ridden..]).find(|(_, s)| s.iter().any(z));
        log.first_door = seen(|_| true).map_or(0, |(k, _)| k);
        log.sign = seen(|feature| feature.signature == Some(DOORS)).map_or(0, |(k, _)| k);
        log
    }

    fn here(&self) -> f64 {
        self.truth[self.truth.len() - 1]
    }

    fn push(&mut self, control: Shift, to: f64, features: Vec<Feature>) {
        self.truth.push(to);
        self.controls.push(control);
        self.sightings.push(features);
    }

    fn drive_to_the_sign(&mut self, seed: u64) {
        while self.here() < SIGN + BEYOND {
            let step = self.truth.len() as u32;
            let to = self.here() + STEP.by + STEP.std * Stream::at(seed, WORLD_ODOMETRY, step, 0).normal();
            let at = Pose2::new(to, 0.0, 0.0);
            let landmarks = (0..DOORS).map(|door| SPACING * f64::from(door + 1)).chain([SIGN]);
            let landmarks = (0..).zip(landmarks.map(|x| Vector2::new(x, WALL)));
            let see = |(name, landmark)| {
                let noise = Vector2::from(Stream::at(seed, WORLD_SENSOR, step, name).normals::<2>());
                // The name is for this module's own counts: association by likelihood never reads it.
                Feature { z: Offset.predict(&at, &landmark).z + noise * Offset::STD, signature: Some(name) }
            };
            let features = landmarks.filter(|(_, m)| Offset.sees(&at, m, 0.0)).map(see).collect();
            self.push(STEP, to, features);
        }
    }
}

/// A drive along the corridor.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Shift {
    /// \[m\]
    by: f64,
    /// Its standard deviation \[m\].
    std: f64,
}

/// A robot on rails: x is all that moves, and all that is uncertain.
#[derive(Clone, Copy, Debug)]
struct Corridor;

impl Motion for Corridor {
    type Control = Shift;

    fn apply(&self, from: &Pose2, u: &Shift) -> Pose2 {
        Pose2::new(from.x + u.by, from.y, from.theta)
    }

    fn sample(&self, from: &Pose2, u: &Shift, stream: &mut Stream) -> Pose2 {
        Pose2::new(from.x + u.by + u.std * stream.normal(), from.y, from.theta)
    }

    fn covariance(&self, _: &Pose2, u: &Shift) -> Matrix3<f64> {
        Matrix3::new(u.std * u.std, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    }
}

/// z = m − (x, y) + noise: linear, so that nothing but the association can go wrong.
#[derive(Clone, Copy, Debug)]
struct Offset;

impl Offset {
    /// \[m\], along each axis.
    const STD: f64 = 0.1;

    /// How far along the corridor it sees \[m\]: never two landmarks at once.
    const REACH: f64 = 0.75;
}

impl LandmarkSensor for Offset {
    fn predict(&self, at: &Pose2, landmark: &Vector2<f64>) -> Prediction {
        Prediction {
            z: landmark - Vector2::new(at.x, at.y),
            h_x: Matrix2x3::new(-1.0, 0.0, 0.0, 0.0, -1.0, 0.0),
            h_m: Matrix2::identity(),
        }
    }

    fn residual(&self, z: &Vector2<f64>, predicted: &Vector2<f64>) -> Vector2<f64> {
        z - predicted
    }

    fn locate(&self, at: &Pose2, z: &Vector2<f64>) -> Vector2<f64> {
        z + Vector2::new(at.x, at.y)
    }

    fn noise(&self) -> Matrix2<f64> {
        Matrix2::identity() * (Self::STD * Self::STD)
    }

    fn sees(&self, at: &Pose2, landmark: &Vector2<f64>, margin: f64) -> bool {
        (landmark.x - at.x).abs() + margin < Self::REACH
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::policy_counts::Fraction;

    #[test]
    fn who_is_off_by_a_door_foretells_every_sighting_before_the_sign() {
        for seed in 1..50 {
            let log = Log::new(seed);
            assert!(log.first_door < log.sign);
            for k in log.first_door..log.sign {
                for feature in &log.sightings[k] {
                    let place = log.truth[k + 1] + feature.z.x;
                    let door = (place / SPACING).round();
                    assert!((place - SPACING * door).abs() < 5.0 * Offset::STD && (1.0..=6.0).contains(&door));
                }
            }
            for feature in &log.sightings[log.sign] {
                let nearest = ((log.truth[log.sign + 1] + feature.z.x) / SPACING + 0.5).fract() - 0.5;
                assert!((nearest * SPACING).abs() > 5.0 * Offset::STD, "the sign is where no door would be");
            }
        }
    }

    /// It decides at the first door, and all that follows only makes it surer: right or wrong, it ends a whole number of doors from the
    /// truth, certain to centimetres.
    #[test]
    fn the_kalman_filter_is_certain_whether_it_is_right_or_wrong() {
        let mut wrong = 0;
        for seed in 1..30 {
            let log = Log::new(seed);
            let ekf = run_ekf(&log);
            let off = (ekf.pose().x - log.here()) / SPACING;
            assert!((off - off.round()).abs() * SPACING < 0.5, "seed {seed}: {off} doors off");
            assert!(ekf.pose_covariance().m11.sqrt() < 0.1, "seed {seed}");
            wrong += u32::from(off.round() != 0.0);
        }
        assert!(wrong > 0);
    }

    #[test]
    fn particles_hold_several_doors_at_once_and_are_right_where_the_kalman_filter_is_not() {
        let setup = DoorsSetup { particles: 400, ..DoorsSetup::default() };
        let outcomes = outcomes(&setup, 1..41).unwrap();
        assert!(outcomes.iter().filter(|o| o.first >= 4).count() > 30, "{outcomes:?}");
        let fastslam = Fraction::of(outcomes.iter().map(|o| o.fastslam_right)).wilson();
        let ekf = Fraction::of(outcomes.iter().map(|o| o.ekf_right)).wilson();
        assert!(fastslam[0] > ekf[1], "{fastslam:?} against {ekf:?}");
    }

    #[test]
    fn an_explanation_counts_by_its_weight() {
        let places = [9.0, 9.1, 12.0, 15.2, 100.0, -100.0];
        assert_eq!(explanations(&places, &[0.5, 0.3, 0.15, 0.005, 0.025, 0.02], 9.0), 2);
    }

    #[test]
    fn settings_out_of_range_are_named() {
        let none = DoorsSetup { particles: 0, ..DoorsSetup::default() };
        assert_eq!(outcomes(&none, 1..2).unwrap_err().field(), "particles");
        let policy = DoorsSetup { policy: ResamplePolicy::EssBelow(1.5), ..DoorsSetup::default() };
        assert_eq!(outcomes(&policy, 1..2).unwrap_err().field(), "policy");
    }
}
