//! The corridor, the robot on it, and a log of what it did and saw.

use super::{DoorsSetup, RIDE_END, RIDE_RANGE, SIGN};
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use fastslam::geometry::Pose2;
use fastslam::motion::Motion;
use fastslam::nalgebra::{Matrix2, Matrix2x3, Matrix3, Vector2};
use fastslam::random::Stream;
use fastslam::sensor::{Feature, LandmarkSensor, Prediction};

/// One step of the robot \[m\], with the standard deviation of its odometry \[m\].
const STEP: Shift = Shift { by: 0.5, std: 0.005 };

/// How far from the sign the drive ends \[m\].
const BEYOND: f64 = 0.5;

/// All landmarks are on one wall \[m\].
const WALL: f64 = 1.0;

/// A drive, and the places on the corridor that it truly led to.
#[derive(Clone, PartialEq, Debug)]
pub struct Log {
    /// x of steps 0 to T \[m\].
    pub truth: Vec<f64>,
    /// The k-th leads from step k to k + 1.
    pub controls: Vec<Shift>,
    /// What was seen at steps 1 to T. The signatures are names of landmarks, for counts and pictures: association by likelihood never
    /// reads them.
    pub sightings: Vec<Vec<Feature>>,
    /// Index of the control that is the ride.
    pub ride: usize,
    /// Index of the sightings in which the first door after the ride is.
    pub first_door: usize,
    /// Index of the sightings in which the sign is, the second time.
    pub sign: usize,
}

impl Log {
    pub fn new(setup: &DoorsSetup) -> Self {
        let (truth, controls, sightings) = (vec![0.0], vec![], vec![]);
        let mut log = Self { truth, controls, sightings, ride: 0, first_door: 0, sign: 0 };
        log.drive_to_the_sign(setup);
        log.ride = log.controls.len();
        let ride = Shift { by: RIDE_END - log.here(), std: setup.ride_std };
        log.push(ride, setup.end.unwrap_or_else(|| drawn_end(setup)), vec![]);
        let ridden = log.controls.len();
        log.drive_to_the_sign(setup);
        let seen =
            |z: &dyn Fn(&Feature) -> bool| (ridden..).zip(&log.sightings[ridden..]).find(|(_, s)| s.iter().any(z));
        let sign = setup.doors.len() as u32;
        let first_door = seen(&|_| true).map_or(0, |(k, _)| k);
        let sign = seen(&|feature| feature.signature == Some(sign)).map_or(0, |(k, _)| k);
        Self { first_door, sign, ..log }
    }

    /// Where the robot is \[m\].
    pub fn here(&self) -> f64 {
        self.truth[self.truth.len() - 1]
    }

    fn push(&mut self, control: Shift, to: f64, features: Vec<Feature>) {
        self.truth.push(to);
        self.controls.push(control);
        self.sightings.push(features);
    }

    fn drive_to_the_sign(&mut self, setup: &DoorsSetup) {
        let sensor = Offset { std: setup.sensor_std };
        while self.here() < SIGN + BEYOND {
            let step = self.truth.len() as u32;
            let to = self.here() + STEP.by + STEP.std * Stream::at(setup.seed, WORLD_ODOMETRY, step, 0).normal();
            let at = Pose2::new(to, 0.0, 0.0);
            let landmarks = setup.doors.iter().copied().chain([SIGN]);
            let landmarks = (0..).zip(landmarks.map(|x| Vector2::new(x, WALL)));
            let see = |(name, landmark)| {
                let noise = Vector2::from(Stream::at(setup.seed, WORLD_SENSOR, step, name).normals::<2>());
                Feature { z: sensor.predict(&at, &landmark).z + noise * sensor.std, signature: Some(name) }
            };
            let features = landmarks.filter(|(_, m)| sensor.sees(&at, m, 0.0)).map(see).collect();
            self.push(STEP, to, features);
        }
    }
}

/// Where the ride ends \[m\], drawn from the Gaussian that the filters are told, and again where that is out of the corridor.
fn drawn_end(setup: &DoorsSetup) -> f64 {
    let ends = (0..).map(|attempt| {
        let mut stream = Stream::at(setup.seed, WORLD_ODOMETRY, 0, attempt);
        RIDE_END + setup.ride_std * stream.normal()
    });
    { ends }.find(|x| RIDE_RANGE.contains(x)).expect("most draws are in range")
}

/// A drive along the corridor.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shift {
    /// \[m\]
    pub by: f64,
    /// Its standard deviation \[m\].
    pub std: f64,
}

/// A robot on rails: x is all that moves, and all that is uncertain.
#[derive(Clone, Copy, Debug)]
pub struct Corridor;

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
pub struct Offset {
    /// \[m\], along each axis.
    pub std: f64,
}

impl Offset {
    /// How far along the corridor it sees \[m\]: never two doors at once that are further apart than twice that.
    pub const REACH: f64 = 0.75;
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
        Matrix2::identity() * (self.std * self.std)
    }

    fn sees(&self, at: &Pose2, landmark: &Vector2<f64>, margin: f64) -> bool {
        (landmark.x - at.x).abs() + margin < Self::REACH
    }
}
