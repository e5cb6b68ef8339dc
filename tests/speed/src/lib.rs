//! Work that is timed both natively (`benches/`, criterion) and in a browser (`npm run bench`): the same code, and the same
//! numbers in it.

use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::{Blocks, Correspondence, Gate, Landmark, Landmarks};
use fastslam::motion::{Odometry, OdometryModel};
use fastslam::proposal::FromMeasurement;
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};
use nalgebra::{Matrix2, Vector2};

#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::*;

/// Sees half a circle, eight metres far.
pub const SENSOR: RangeBearing =
    RangeBearing { range_std: 0.1, bearing_std: 0.03, max_range: 8.0, field_of_view: core::f64::consts::PI };
const MOTION: OdometryModel = OdometryModel { alphas: [0.01, 0.002, 0.008, 0.002] };
const STEP: Odometry = Odometry { rot1: 0.05, trans: 0.2, rot2: 0.05 };

/// Landmarks a metre apart in rows of six, the first of them ahead.
pub fn field(count: u32) -> impl Iterator<Item = Landmark> {
    let at = |k| Vector2::new(1.5 + f64::from(k / 6), f64::from(k % 6) - 2.5);
    (0..count).map(move |k| Landmark {
        mean: at(k),
        covariance: Matrix2::identity() * 0.01,
        existence_count: 1,
        apart: 0,
    })
}

/// Sightings of the six nearest, all at their places to a few centimetres.
pub fn six() -> Vec<Feature> {
    let pose = STEP.apply(&Pose2::default());
    let see = |(signature, landmark): (u32, Landmark)| {
        let z = SENSOR.predict(&pose, &(landmark.mean + Vector2::new(0.03, -0.02))).z;
        Feature { z, signature: Some(signature) }
    };
    (0..).zip(field(6)).map(see).collect()
}

/// FastSLAM 2.0 with a thousand particles in a map of 24 landmarks, serially.
#[derive(Clone)]
#[cfg_attr(target_arch = "wasm32", wasm_bindgen)]
pub struct Thousand {
    filter: Rbpf<Landmarks<RangeBearing, Blocks>, FromMeasurement<OdometryModel>>,
    features: Vec<Feature>,
}

#[cfg_attr(target_arch = "wasm32", wasm_bindgen)]
impl Thousand {
    /// At the start, with known or unknown correspondence.
    #[cfg_attr(target_arch = "wasm32", wasm_bindgen(constructor))]
    pub fn new(known: bool) -> Self {
        let correspondence = if known { Correspondence::Known } else { Correspondence::Unknown(Gate::default()) };
        let map = Landmarks::new(SENSOR, correspondence).with(field(24));
        let filter = Rbpf::builder(map, FromMeasurement { motion: MOTION })
            .particles(1000)
            .seed(1)
            .policy(ResamplePolicy::Never)
            .executor(Executor::Serial)
            .build()
            .expect("there are particles");
        Self { filter, features: six() }
    }

    /// The same again: its copies share their blocks with it, and every one of them is written to in the next step, as after a
    /// resampling.
    pub fn again(&self) -> Self {
        self.clone()
    }

    /// One step with six sightings.
    pub fn step(&mut self) {
        self.filter.step(&STEP, &self.features);
    }
}
