//! Sensors: what a measurement looks like in the robot's frame.

mod beam;
mod laser;
mod range_bearing;

pub use beam::{BeamSensor, Scan};
pub(crate) use laser::Beam;
pub use laser::{LaserScan, longest_reading};
pub use range_bearing::RangeBearing;

use crate::error::SettingError;
use crate::geometry::Pose2;
use nalgebra::{Matrix2, Matrix2x3, Vector2};

/// One sighting of one landmark.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Feature {
    /// What was measured; for [`RangeBearing`] (r, φ) \[m, rad\].
    pub z: Vector2<f64>,
    /// Which landmark it is, where the sensor can tell (a bar code): any number below 2³² − 1, which is refused. Gaps cost nothing in a
    /// [`Shared`](crate::map::landmarks::Shared) store; a store that is a plain vector has a place for each number up to the largest.
    pub signature: Option<u32>,
}

/// ẑ = h(x, m) and its derivatives.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Prediction {
    /// ẑ.
    pub z: Vector2<f64>,
    /// H_x = ∂h/∂x (2 × 3).
    pub h_x: Matrix2x3<f64>,
    /// H_m = ∂h/∂m (2 × 2), invertible.
    pub h_m: Matrix2<f64>,
}

/// A sensor that sees landmarks (points of the plane, \[m\]) one by one, each as two numbers: z = h(x, m) + noise.
pub trait LandmarkSensor: Clone + Send + Sync {
    /// h(x, m) with its derivatives.
    fn predict(&self, world_from_robot: &Pose2, landmark: &Vector2<f64>) -> Prediction;

    /// z − ẑ, angles wrapped.
    fn residual(&self, z: &Vector2<f64>, predicted: &Vector2<f64>) -> Vector2<f64>;

    /// A lower bound of νᵀ S⁻¹ ν that costs less than it, for a landmark whose place relative to the robot has the covariance
    /// `spread` (2 × 2, \[m²\]): what lies beyond a gate by it need not be looked at.
    fn least_mahalanobis_squared(
        &self,
        _world_from_robot: &Pose2,
        _landmark: &Vector2<f64>,
        _spread: &Matrix2<f64>,
        _z: &Vector2<f64>,
    ) -> f64 {
        0.0
    }

    /// Whether z can have been measured at all: whatever cannot is ignored and counted ([`Report::ignored`](crate::rbpf::Report::ignored)).
    /// As given here, two finite numbers.
    fn can_measure(&self, z: &Vector2<f64>) -> bool {
        z.iter().all(|number| number.is_finite())
    }

    /// h⁻¹: the landmark that is seen without noise as z.
    fn locate(&self, world_from_robot: &Pose2, z: &Vector2<f64>) -> Vector2<f64>;

    /// Q (2 × 2): covariance of the noise.
    fn noise(&self) -> Matrix2<f64>;

    /// Whether all points up to `margin` \[m\] around the landmark are in range and in view.
    fn sees(&self, world_from_robot: &Pose2, landmark: &Vector2<f64>, margin: f64) -> bool;

    /// Whether all settings are in range: asked once, when a filter is built.
    ///
    /// # Errors
    /// Where one is not. As given here there are none.
    fn validate(&self) -> Result<(), SettingError> {
        Ok(())
    }
}
