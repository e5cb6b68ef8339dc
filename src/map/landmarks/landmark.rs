//! One landmark: an extended Kalman filter of dimension two.

use crate::geometry::Pose2;
use crate::ops;
use crate::sensor::{LandmarkSensor, Prediction};
use nalgebra::{Matrix2, Matrix3, Vector2};

/// p(m | path, sightings) = N(mean, covariance).
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "super::saved::SavedLandmark", into = "super::saved::SavedLandmark")
)]
pub struct Landmark {
    /// μ \[m\].
    pub mean: Vector2<f64>,
    /// Σ \[m²\].
    pub covariance: Matrix2<f64>,
    /// Sightings less the times it should have been seen and was not; struck off below 0. Each sighting counts as
    /// [`sighting_worth`](super::Gate::sighting_worth).
    pub existence_count: i32,
    /// Which landmarks near this one are surely others, because one look saw both: bit k stands for all indices that are k modulo
    /// 32. Kept where landmarks are merged; else 0.
    pub apart: u32,
}

/// What a sighting says against what was expected.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Innovation {
    /// ẑ and its derivatives.
    pub prediction: Prediction,
    /// ν = z − ẑ.
    pub residual: Vector2<f64>,
    /// Q_j = H_m Σ H_mᵀ + Q (2 × 2): covariance of ν if the pose is sure.
    pub given_pose: Matrix2<f64>,
    /// S (2 × 2): covariance of ν; Q_j, or Q_j + H_x P H_xᵀ.
    pub covariance: Matrix2<f64>,
    /// S⁻¹.
    pub inverse: Matrix2<f64>,
    /// νᵀ S⁻¹ ν.
    pub mahalanobis_squared: f64,
}

impl Innovation {
    fn new(prediction: Prediction, residual: Vector2<f64>, given_pose: Matrix2<f64>, covariance: Matrix2<f64>) -> Self {
        let inverse = inverse(&covariance);
        let mahalanobis_squared = residual.dot(&(inverse * residual));
        Self { prediction, residual, given_pose, covariance, inverse, mahalanobis_squared }
    }

    /// The same with the noise of the pose in it: S + H_x P H_xᵀ for a pose of covariance P (3 × 3).
    pub fn with_pose(&self, pose_covariance: &Matrix3<f64>) -> Self {
        let h_x = &self.prediction.h_x;
        let covariance = symmetric(self.given_pose + h_x * pose_covariance * h_x.transpose());
        Self::new(self.prediction, self.residual, self.given_pose, covariance)
    }

    /// ln N(ν; 0, S) \[nats\].
    pub fn log_likelihood(&self) -> f64 {
        -0.5 * (self.mahalanobis_squared + ops::ln(self.determinant())) - ops::LN_TAU
    }

    /// det S.
    pub fn determinant(&self) -> f64 {
        determinant(&self.covariance)
    }

    /// Whether S has an inverse. It has none where a sighting without noise is of what is known without any, and what rounding
    /// leaves of such an S, 10⁻¹² and less of the product of its variances, is no better. Then the sighting can say nothing.
    #[inline]
    pub fn is_regular(&self) -> bool {
        self.determinant() > 1e-12 * self.covariance.m11 * self.covariance.m22
    }
}

impl Landmark {
    /// The first sighting: μ = h⁻¹(x, z), Σ = H_m⁻¹ Q H_m⁻ᵀ.
    pub fn first<Z: LandmarkSensor>(sensor: &Z, world_from_robot: &Pose2, z: &Vector2<f64>) -> Self {
        let mean = sensor.locate(world_from_robot, z);
        let inverse = inverse(&sensor.predict(world_from_robot, &mean).h_m);
        Self {
            mean,
            covariance: symmetric(inverse * sensor.noise() * inverse.transpose()),
            existence_count: 1,
            apart: 0,
        }
    }

    /// ν = z − h(x, μ), S = H_m Σ H_mᵀ + Q: exp([`Innovation::log_likelihood`]) is the marginal ∫ p(z | x, m) p(m | path) dm of a sighting.
    #[inline]
    pub fn innovation<Z: LandmarkSensor>(&self, sensor: &Z, world_from_robot: &Pose2, z: &Vector2<f64>) -> Innovation {
        self.innovation_with(sensor, world_from_robot, z, |_| Matrix2::zeros())
    }

    /// The same with more noise (2 × 2) than the landmark's and the sensor's: of a pose of covariance P, H_x P H_xᵀ.
    #[inline]
    pub fn innovation_with<Z: LandmarkSensor>(
        &self,
        sensor: &Z,
        world_from_robot: &Pose2,
        z: &Vector2<f64>,
        more: impl Fn(&Prediction) -> Matrix2<f64>,
    ) -> Innovation {
        let prediction = sensor.predict(world_from_robot, &self.mean);
        let h = &prediction.h_m;
        let given_pose = symmetric(h * self.covariance * h.transpose() + sensor.noise());
        let covariance = symmetric(given_pose + more(&prediction));
        Innovation::new(prediction, sensor.residual(z, &prediction.z), given_pose, covariance)
    }

    /// K = Σ H_mᵀ S⁻¹, μ ← μ + K ν, Σ ← (I − K H_m) Σ (I − K H_m)ᵀ + K Q Kᵀ: Joseph's form, a sum of two terms that
    /// stay positive whatever K is. Where S has no inverse nothing is learnt.
    pub fn update<Z: LandmarkSensor>(&mut self, sensor: &Z, world_from_robot: &Pose2, z: &Vector2<f64>) {
        let innovation = self.innovation(sensor, world_from_robot, z);
        self.take_in(sensor, &innovation);
    }

    /// [`Self::update`] with an innovation that was computed already. Returns whether it is regular.
    pub(super) fn take_in<Z: LandmarkSensor>(&mut self, sensor: &Z, innovation: &Innovation) -> bool {
        if !innovation.is_regular() {
            return false;
        }
        let gain = self.gain(innovation);
        let keep = Matrix2::identity() - gain * innovation.prediction.h_m;
        self.mean += gain * innovation.residual;
        self.covariance =
            symmetric(keep * self.covariance * keep.transpose() + gain * sensor.noise() * gain.transpose());
        self.existence_count = self.existence_count.saturating_add(1);
        true
    }

    /// Δᵀ (Σ_a + Σ_b)⁻¹ Δ with Δ = μ_a − μ_b: how far apart two landmarks are in deviations, squared. Without a number (0/0) where
    /// both are known without any noise and stand in one place.
    pub fn distance_squared(&self, other: &Self) -> f64 {
        let delta = self.mean - other.mean;
        delta.dot(&(inverse(&(self.covariance + other.covariance)) * delta))
    }

    /// Two estimates of one landmark, of different sightings: the product of both Gaussians, Σ⁻¹ = Σ_a⁻¹ + Σ_b⁻¹ and
    /// Σ⁻¹ μ = Σ_a⁻¹ μ_a + Σ_b⁻¹ μ_b. Given the path sightings are independent, so nothing is counted twice. Counts add up.
    ///
    /// Written as a Kalman update of the one by the other, in Joseph's form: it inverts Σ_a + Σ_b alone.
    pub fn merged(&self, other: &Self) -> Self {
        let gain = self.covariance * inverse(&(self.covariance + other.covariance));
        let keep = Matrix2::identity() - gain;
        Self {
            mean: self.mean + gain * (other.mean - self.mean),
            covariance: symmetric(
                keep * self.covariance * keep.transpose() + gain * other.covariance * gain.transpose(),
            ),
            existence_count: self.existence_count.saturating_add(other.existence_count),
            apart: self.apart | other.apart,
        }
    }

    /// Whether one look saw this landmark and the one of this index, or one that shares its bit.
    pub(super) fn is_apart_from(&self, index: u32) -> bool {
        self.apart >> (index % u32::BITS) & 1 == 1
    }

    /// K = Σ H_mᵀ S⁻¹ (2 × 2): how far the mean follows a residual.
    #[inline]
    pub fn gain(&self, innovation: &Innovation) -> Matrix2<f64> {
        self.covariance * innovation.prediction.h_m.transpose() * innovation.inverse
    }

    /// √ of the larger eigenvalue of Σ \[m\].
    pub fn largest_std(&self) -> f64 {
        let s = &self.covariance;
        let (half_sum, half_difference) = (0.5 * (s.m11 + s.m22), 0.5 * (s.m11 - s.m22));
        (half_sum + (half_difference * half_difference + s.m12 * s.m12).sqrt()).sqrt()
    }
}

#[inline]
fn determinant(m: &Matrix2<f64>) -> f64 {
    m.m11 * m.m22 - m.m12 * m.m21
}

#[inline]
fn inverse(m: &Matrix2<f64>) -> Matrix2<f64> {
    Matrix2::new(m.m22, -m.m12, -m.m21, m.m11) / determinant(m)
}

/// Both off-diagonals their mean: the last bits of a product of symmetric matrices need not agree.
fn symmetric(m: Matrix2<f64>) -> Matrix2<f64> {
    let off = 0.5 * (m.m12 + m.m21);
    Matrix2::new(m.m11, off, off, m.m22)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::RangeBearing;

    const SENSOR: RangeBearing =
        RangeBearing { range_std: 0.2, bearing_std: 0.05, max_range: 10.0, field_of_view: core::f64::consts::TAU };

    /// The worked example of the chapter.
    #[test]
    fn the_worked_example_is_met_to_the_last_digit_shown() {
        let landmark = Landmark {
            mean: Vector2::new(4.0, 0.0),
            covariance: Matrix2::new(0.21, 0.0, 0.0, 0.12),
            existence_count: 1,
            apart: 0,
        };
        for (z, weight) in [([4.1, 0.05], 2.753_451_476_665), ([4.3, 0.15], 0.863_168_987_665)] {
            let innovation = landmark.innovation(&SENSOR, &Pose2::default(), &Vector2::from(z));
            assert!((innovation.covariance - Matrix2::new(0.25, 0.0, 0.0, 0.01)).norm() < 1e-15);
            assert!((innovation.determinant() - 0.0025).abs() < 1e-15);
            // Of the range what the map lacks, of the bearing 4 m of it.
            assert!((landmark.gain(&innovation) - Matrix2::new(0.84, 0.0, 0.0, 3.0)).norm() < 1e-14);
            assert!((ops::exp(innovation.log_likelihood()) - weight).abs() < 1e-9);
        }
    }

    #[test]
    fn many_sightings_from_one_pose_are_their_mean() {
        let pose = Pose2::new(1.0, -2.0, 0.5);
        let z = Vector2::new(3.0, 0.3);
        let mut landmark = Landmark::first(&SENSOR, &pose, &z);
        let first = landmark.covariance;
        for _ in 1..100 {
            landmark.update(&SENSOR, &pose, &z);
        }
        assert!((landmark.covariance * 100.0 - first).norm() < 1e-12);
        assert!((landmark.mean - SENSOR.locate(&pose, &z)).norm() < 1e-12);
        assert_eq!(landmark.existence_count, 100);
    }

    #[test]
    fn ranges_along_one_ray_are_averaged() {
        let pose = Pose2::new(1.0, -2.0, 0.5);
        let seen = |range| Vector2::new(range, 0.3);
        let mut landmark = Landmark::first(&SENSOR, &pose, &seen(3.1));
        for range in [2.8, 3.0, 3.3, 2.8] {
            landmark.update(&SENSOR, &pose, &seen(range));
        }
        assert!((landmark.mean - SENSOR.locate(&pose, &seen(3.0))).norm() < 1e-12, "{landmark:?}");
    }

    #[test]
    fn the_largest_deviation_is_that_of_the_longer_axis() {
        let covariance = Matrix2::new(2.5, 1.5, 1.5, 2.5);
        let landmark = Landmark { mean: Vector2::zeros(), covariance, existence_count: 1, apart: 0 };
        assert!((landmark.largest_std() - 2.0).abs() < 1e-15);
    }

    #[test]
    fn a_landmark_under_the_robot_stays_finite() {
        let mut landmark = Landmark::first(&SENSOR, &Pose2::default(), &Vector2::new(0.0, 0.0));
        for _ in 0..9 {
            landmark.update(&SENSOR, &Pose2::default(), &Vector2::new(0.0, 1.0));
            assert!(landmark.mean.iter().chain(&landmark.covariance).all(|x| x.is_finite()), "{landmark:?}");
        }
    }
}
