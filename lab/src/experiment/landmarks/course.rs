//! The simulated courses, and a drive along one with the noise of a seed.

use super::{LandmarkLog, Tuning};
use crate::world::Field;
use crate::{WORLD_ODOMETRY, WORLD_SENSOR};
use core::f64::consts::{PI, TAU};
use fastslam::error::SettingError;
use fastslam::geometry::Pose2;
use fastslam::map::landmarks::Gate;
use fastslam::motion::VelocityModel;
use fastslam::random::Stream;
use fastslam::sensor::{Feature, LandmarkSensor, RangeBearing};

/// The simulated courses.
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::EnumString, strum::VariantNames, strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_course)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "lowercase"))]
pub enum Course {
    /// A figure of eight through twenty-four landmarks, with a sharp sensor and poor odometry.
    Eight,
    /// Eight tags around a circle: the setting of the FastSLAM examples of PythonRobotics, with its landmarks, ranges and
    /// noises.
    Tags,
    /// Two wings that look the same: see [`Field::two_wings`].
    Wings,
}

fn unknown_course(given: &str) -> SettingError {
    SettingError::unknown_word("course", given, <Course as strum::VariantNames>::VARIANTS)
}

impl Course {
    /// The noise of the world, which is also what its filter is told.
    pub fn tuning(self) -> Tuning {
        match self {
            Self::Eight => Tuning {
                motion: VelocityModel { speed_std: 0.0, turn_rate_std: 0.0, alphas: [0.04, 0.0, 0.01, 0.04] },
                sensor: RangeBearing { range_std: 0.05, bearing_std: 0.01, max_range: 6.0, field_of_view: PI },
                gate: Gate { removal: true, ..Gate::default() },
            },
            Self::Tags => Tuning {
                motion: VelocityModel { speed_std: 0.5, turn_rate_std: 10.0 * PI / 180.0, alphas: [0.0; 4] },
                sensor: RangeBearing {
                    range_std: 0.3,
                    bearing_std: 2.0 * PI / 180.0,
                    max_range: 20.0,
                    field_of_view: TAU,
                },
                gate: Gate::default(),
            },
            // A robot that drives well and turns badly: 0.3 % of the way, 5 % of a turn. Twenty turns leave 6 rad of doubt.
            // Were the way as bad, the two maps would fit the hall unequally well, and chance would decide for one of them.
            Self::Wings => Tuning {
                motion: VelocityModel { speed_std: 0.0, turn_rate_std: 0.0, alphas: [1e-5, 0.0, 1e-7, 0.0025] },
                sensor: RangeBearing {
                    range_std: 0.2,
                    bearing_std: 0.04,
                    max_range: 6.0,
                    field_of_view: 2.0 * PI / 3.0,
                },
                gate: Gate::default(),
            },
        }
    }

    /// What wheels report beyond the truth, on average \[m/s, rad/s\]. No filter is told.
    fn bias(self) -> [f64; 2] {
        match self {
            Self::Eight | Self::Wings => [0.0, 0.0],
            Self::Tags => [0.0, 0.01],
        }
    }

    /// The world's noise of the sensor as a share of what the filter is told.
    ///
    /// In the wings the filter is told five times the noise there is. Each wing was mapped in one drive; told the truth, a
    /// filter takes the twenty numbers by which the two maps happen to differ for evidence of several nats, and chance decides
    /// between the wings. Told five times as much, it takes them for a twenty-fifth of that: the explanations stay equal.
    fn sharper(self) -> f64 {
        match self {
            Self::Eight | Self::Tags => 1.0,
            Self::Wings => 0.2,
        }
    }

    /// The drive with the noise of a seed; the truth is always the same.
    pub fn simulate(self, seed: u64) -> LandmarkLog {
        self.simulate_with(&self.tuning(), seed)
    }

    /// The drive with another noise than the course's own.
    pub fn simulate_with(self, tuning: &Tuning, seed: u64) -> LandmarkLog {
        let field = match self {
            Self::Eight => Field::figure_of_eight(),
            Self::Tags => Field::eight_tags(),
            Self::Wings => Field::two_wings(),
        };
        field.simulate(tuning, &tuning.sensor.scaled(self.sharper()), self.bias(), seed)
    }
}

impl Field {
    /// The drive with the noise of a seed: what wheels report by the motion of this tuning and beyond it by a bias \[m/s, rad/s\], and what
    /// this sensor measures of all that is in view of the tuning's.
    pub fn simulate(
        self,
        tuning: &Tuning,
        sensor: &RangeBearing,
        [speed_bias, turn_rate_bias]: [f64; 2],
        seed: u64,
    ) -> LandmarkLog {
        let mut log = LandmarkLog {
            truth: vec![Pose2::default()],
            odometry: vec![Pose2::default()],
            landmarks: self.landmarks,
            ..LandmarkLog::default()
        };
        for (step, driven) in (1..).zip(&self.controls) {
            let truth = driven.apply(&log.truth[log.truth.len() - 1]);
            let mut reported = tuning.motion.perturb(driven, &mut Stream::at(seed, WORLD_ODOMETRY, step, 0));
            reported.speed += speed_bias;
            reported.turn_rate += turn_rate_bias;
            log.odometry.push(reported.apply(&log.odometry[log.odometry.len() - 1]));
            log.truth.push(truth);
            log.controls.push(reported);
            let visible = (0..).zip(&log.landmarks).filter(|(_, m)| tuning.sensor.sees(&truth, m, 0.0));
            let see = |(signature, landmark)| {
                let mut stream = Stream::at(seed, WORLD_SENSOR, step, signature);
                Feature { z: sensor.measure(&truth, landmark, &mut stream), signature: Some(signature) }
            };
            log.sightings.push(visible.map(see).collect());
        }
        log
    }
}
