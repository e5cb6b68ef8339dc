//! Which landmark a sighting is of. Every particle decides for itself, and lives or dies by it.

use super::{Innovation, Landmarks, Store};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::ops;
use crate::sensor::{Feature, LandmarkSensor, Prediction};
use nalgebra::Matrix3;

/// How sightings are told apart.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Correspondence {
    /// By the signature that each feature brings; a feature without one is passed over.
    Known,
    /// By maximum likelihood.
    Unknown(Gate),
}

/// Settings of the maximum-likelihood association.
///
/// A feature goes to the landmark of the largest π_j = N(ν_j; 0, S_j) among those with ν_jᵀ S_j⁻¹ ν_j within the gate, if
/// that exceeds p₀; else it is a new landmark, at the price p₀ (PR tables 13.2 and 13.3).
///
/// No landmark is given two features of one step. The rule: features choose in the order in which the sensor reports them, and
/// a landmark that was chosen is not to be had again in this step; who comes later takes the next best, or founds a new one.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gate {
    /// Largest νᵀ S⁻¹ ν: a quantile of χ² with two degrees of freedom.
    pub mahalanobis_squared: f64,
    /// ln p₀: log-density of a sighting \[nats, per unit of z\] below which a new landmark explains it better.
    pub log_new: f64,
    /// Whether landmarks that should have been seen and were not lose existence count, and are struck off without any.
    pub removal: bool,
    /// With `removal`: how many misses one sighting pays for, 1 or more. A sensor that sees a landmark in its view with the
    /// probability p strikes off what is there where this is below (1 − p) / p, and should be told clearly more.
    pub sighting_worth: u32,
    /// With `removal`: the most existence count that a landmark may have, so that what has gone away (a parked robot) is struck off after
    /// as many misses, however long it stood. At least `sighting_worth`.
    pub most_count: u32,
    /// Largest Δᵀ (Σ_a + Σ_b)⁻¹ Δ of two landmarks of one map that are taken for one, Δ the difference of their means: a quantile
    /// of χ² with two degrees of freedom. 0: none are. See [`Landmarks`](super::Landmarks#landmarks-that-coincide).
    pub merge_squared: f64,
}

impl Default for Gate {
    /// χ²₂,₀.₉₉ = −2 ln 0.01; p₀ = 10⁻³ per metre and radian; no removal, where a sighting would pay for one miss and counts be
    /// without a bound; no merging.
    fn default() -> Self {
        Self {
            mahalanobis_squared: -2.0 * ops::ln(0.01),
            log_new: ops::ln(1e-3),
            removal: false,
            sighting_worth: 1,
            most_count: i32::MAX as u32,
            merge_squared: 0.0,
        }
    }
}

/// Most misses that a sighting can pay for.
const WORTH: u32 = 1000;

impl Gate {
    /// Whether all settings are in range.
    ///
    /// # Errors
    /// Where a gate is not a number of 0 or more, ln p₀ is not finite, a sighting is worth nothing, or the most that may be counted is
    /// less than what one is worth.
    pub fn validate(&self) -> Result<(), SettingError> {
        Range::at_least(0.0, "").check("gate.mahalanobis_squared", self.mahalanobis_squared)?;
        Range::finite("nats").check("gate.log_new", self.log_new)?;
        Range::whole(1, WORTH).check("gate.sighting_worth", f64::from(self.sighting_worth))?;
        Range::whole(self.sighting_worth, i32::MAX as u32).check("gate.most_count", f64::from(self.most_count))?;
        Range::at_least(0.0, "").check("gate.merge_squared", self.merge_squared).map(drop)
    }

    /// What a landmark's existence count is after a sighting that has just raised it by one, or to one.
    pub fn counted(&self, count: i32) -> i32 {
        if !self.removal {
            return count;
        }
        count.saturating_add(self.sighting_worth as i32 - 1).min(self.most_count as i32)
    }
}

/// What a feature is taken to be.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Association {
    /// The landmark of this index, seen before.
    Matched(u32),
    /// A landmark seen for the first time, to get this index.
    New(u32),
    /// Not to be used: no signature, or a second feature of a landmark in one step.
    Ignored,
}

/// A decision with its likelihood.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Decision {
    /// What was decided.
    pub association: Association,
    /// What was seen against what was expected, where the landmark is in the map and the sighting can say anything: see
    /// [`Innovation::is_regular`].
    pub innovation: Option<Innovation>,
    /// ln p(z) under the decision \[nats\].
    pub log_likelihood: f64,
}

impl Correspondence {
    /// Decides what one feature is, after `taken` was decided for the features before it. Indices up to `len` are in use;
    /// `innovation` is what the feature says of the landmark of an index, `None` where there is none, or where it surely lies
    /// beyond the gate that is asked for.
    ///
    /// A sighting that can say nothing (S has no inverse) says nothing: by its signature it is of its landmark and changes neither
    /// pose, landmark nor weight; without one it is of no landmark in the map, since there is no likelihood to choose by.
    pub fn decide(
        &self,
        feature: &Feature,
        taken: &[Association],
        len: u32,
        innovation: impl Fn(u32, Option<f64>) -> Option<Innovation>,
    ) -> Decision {
        let free =
            |index: u32| !taken.contains(&Association::Matched(index)) && !taken.contains(&Association::New(index));
        match self {
            Self::Known => match feature.signature.filter(|index| free(*index)) {
                Some(index) => match innovation(index, None) {
                    Some(innovation) if innovation.is_regular() => matched(index, innovation),
                    Some(_) => {
                        Decision { association: Association::Matched(index), innovation: None, log_likelihood: 0.0 }
                    }
                    None => Decision { association: Association::New(index), innovation: None, log_likelihood: 0.0 },
                },
                None => Decision { association: Association::Ignored, innovation: None, log_likelihood: 0.0 },
            },
            Self::Unknown(gate) => {
                let mut best: Option<Decision> = None;
                for index in 0..len {
                    let innovation = innovation(index, Some(gate.mahalanobis_squared)).filter(Innovation::is_regular);
                    let Some(innovation) = innovation else { continue };
                    let within = innovation.mahalanobis_squared < gate.mahalanobis_squared;
                    let to_beat = best.map_or(gate.log_new, |best| best.log_likelihood);
                    if within && innovation.log_likelihood > to_beat && free(index) {
                        best = Some(matched(index, innovation));
                    }
                }
                best.unwrap_or_else(|| {
                    let founded = taken.iter().filter(|other| matches!(other, Association::New(_))).count() as u32;
                    Decision {
                        association: Association::New(len + founded),
                        innovation: None,
                        log_likelihood: gate.log_new,
                    }
                })
            }
        }
    }
}

impl<Z: LandmarkSensor, S: Store> Landmarks<Z, S> {
    /// Decides what one feature is, for a pose of this mean and covariance P (3 × 3; zeros for a pose that is sure), after
    /// `taken` was decided for the features before it.
    pub fn associate(&self, pose: &Pose2, p: &Matrix3<f64>, feature: &Feature, taken: &[Association]) -> Decision {
        self.correspondence
            .decide(feature, taken, self.store.len(), |index, gate| self.innovation(pose, p, feature, index, gate))
    }

    /// What a feature says of the landmark of an index, for such a pose; `None` where there is none, or where it surely lies beyond the gate.
    pub(crate) fn innovation(
        &self,
        pose: &Pose2,
        p: &Matrix3<f64>,
        feature: &Feature,
        index: u32,
        gate: Option<f64>,
    ) -> Option<Innovation> {
        let landmark = self.get(index)?;
        let spread = landmark.covariance + p.fixed_view::<2, 2>(0, 0);
        let least = || self.sensor.least_mahalanobis_squared(pose, &landmark.mean, &spread, &feature.z);
        let beyond = gate.is_some_and(|gate| least() >= gate);
        (!beyond).then(|| {
            let of_pose = |prediction: &Prediction| prediction.h_x * p * prediction.h_x.transpose();
            landmark.innovation_with(&self.sensor, pose, &feature.z, of_pose)
        })
    }
}

fn matched(index: u32, innovation: Innovation) -> Decision {
    Decision {
        association: Association::Matched(index),
        log_likelihood: innovation.log_likelihood,
        innovation: Some(innovation),
    }
}
