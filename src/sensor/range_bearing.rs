//! A sensor of range and bearing to point landmarks.
//!
//! Reference: Thrun, Burgard, Fox, *Probabilistic Robotics* (2005), §6.6.

use super::{LandmarkSensor, Prediction};
use crate::error::{Range, SettingError};
use crate::geometry::Pose2;
use crate::ops;
use crate::random::Stream;
use core::f64::consts::FRAC_PI_2;
use nalgebra::{Matrix2, Matrix2x3, Vector2};

/// z = (r, φ): distance \[m\], and direction from straight ahead \[rad\].
///
/// With d = m − (x, y), q = dᵀd and r = √q: h = (r, atan2(d_y, d_x) − θ),
/// H_m = \[\[d_x/r, d_y/r\], \[−d_y/q, d_x/q\]\], H_x = \[\[−d_x/r, −d_y/r, 0\], \[d_y/q, −d_x/q, −1\]\].
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RangeBearing {
    /// σ_r \[m\].
    pub range_std: f64,
    /// σ_φ \[rad\].
    pub bearing_std: f64,
    /// Longest range \[m\].
    pub max_range: f64,
    /// Width of the field of view \[rad\], half of it to each side; 2 π for all around.
    pub field_of_view: f64,
}

/// No range is longer than this \[m\]: its square must stay far from the largest number there is.
const FARTHEST: f64 = 1e9;

/// Nearer than this \[m\] a bearing means nothing, and its derivatives grow without bounds.
const NEAREST: f64 = 1e-6;

impl RangeBearing {
    /// The same sensor with both standard deviations multiplied by `scale`.
    pub fn scaled(&self, scale: f64) -> Self {
        Self { range_std: self.range_std * scale, bearing_std: self.bearing_std * scale, ..*self }
    }

    /// What is measured of a landmark, with noise. Takes four `u64`s.
    pub fn measure(&self, world_from_robot: &Pose2, landmark: &Vector2<f64>, stream: &mut Stream) -> Vector2<f64> {
        let ([a, b], exact) = (stream.normals(), self.predict(world_from_robot, landmark).z);
        Vector2::new((exact.x + self.range_std * a).max(0.0), ops::wrap_angle(exact.y + self.bearing_std * b))
    }
}

impl LandmarkSensor for RangeBearing {
    #[inline]
    fn predict(&self, world_from_robot: &Pose2, landmark: &Vector2<f64>) -> Prediction {
        let (dx, dy) = (landmark.x - world_from_robot.x, landmark.y - world_from_robot.y);
        let q = (dx * dx + dy * dy).max(NEAREST * NEAREST);
        let r = q.sqrt();
        Prediction {
            z: Vector2::new(r, ops::wrap_angle(ops::atan2(dy, dx) - world_from_robot.theta)),
            h_x: Matrix2x3::new(-dx / r, -dy / r, 0.0, dy / q, -dx / q, -1.0),
            h_m: Matrix2::new(dx / r, dy / r, -dy / q, dx / q),
        }
    }

    #[inline]
    fn residual(&self, z: &Vector2<f64>, predicted: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(z.x - predicted.x, ops::wrap_angle(z.y - predicted.y))
    }

    /// That of the range alone, which knows no heading: no angle is computed.
    #[inline]
    fn least_mahalanobis_squared(
        &self,
        world_from_robot: &Pose2,
        landmark: &Vector2<f64>,
        spread: &Matrix2<f64>,
        z: &Vector2<f64>,
    ) -> f64 {
        let d = Vector2::new(landmark.x - world_from_robot.x, landmark.y - world_from_robot.y);
        let q = d.norm_squared().max(NEAREST * NEAREST);
        let nu = z.x - q.sqrt();
        nu * nu / (d.dot(&(spread * d)) / q + self.range_std * self.range_std)
    }

    /// A range above 0, of at most 10⁹ m, and a finite bearing. A range beyond [`max_range`](Self::max_range) can be noise.
    fn can_measure(&self, z: &Vector2<f64>) -> bool {
        z.x > 0.0 && z.x <= FARTHEST && z.y.is_finite()
    }

    fn locate(&self, world_from_robot: &Pose2, z: &Vector2<f64>) -> Vector2<f64> {
        // Never right on the robot, where there would be no bearing.
        let r = z.x.max(1e3 * NEAREST);
        let (sin, cos) = ops::sin_cos(world_from_robot.theta + z.y);
        Vector2::new(world_from_robot.x + r * cos, world_from_robot.y + r * sin)
    }

    fn noise(&self) -> Matrix2<f64> {
        Matrix2::new(self.range_std * self.range_std, 0.0, 0.0, self.bearing_std * self.bearing_std)
    }

    fn sees(&self, world_from_robot: &Pose2, landmark: &Vector2<f64>, margin: f64) -> bool {
        let z = self.predict(world_from_robot, landmark).z;
        let all_around = self.field_of_view >= core::f64::consts::TAU;
        // From the landmark to the nearest point that is out of view: on the edge's ray, or the robot itself where that ray leads away.
        let aside = (0.5 * self.field_of_view - z.y.abs()).min(FRAC_PI_2);
        let to_edge = || if aside < 0.0 { f64::NEG_INFINITY } else { z.x * ops::sin(aside) };
        z.x + margin <= self.max_range && (all_around || to_edge() >= margin)
    }

    /// Standard deviations of 0, of a sensor without noise, are in range: what such a sighting cannot say is passed over. See
    /// [`Innovation::is_regular`](crate::map::landmarks::Innovation::is_regular).
    fn validate(&self) -> Result<(), SettingError> {
        Range::at_least(0.0, "m").check("sensor.range_std", self.range_std)?;
        Range::at_least(0.0, "rad").check("sensor.bearing_std", self.bearing_std)?;
        // Infinite is as far as one likes.
        Range::number(0.0, f64::INFINITY, "m").check("sensor.max_range", self.max_range)?;
        Range::at_least(0.0, "rad").check("sensor.field_of_view", self.field_of_view).map(drop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SENSOR: RangeBearing =
        RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 5.0, field_of_view: core::f64::consts::PI };

    /// 200 poses with landmarks near and far all around.
    fn views() -> Vec<(Pose2, Vector2<f64>)> {
        let view = |k| {
            let [x, y, theta, mx, my] = Stream::at(4, crate::random::Purpose::TRIAL, 0, k).normals();
            (Pose2::new(3.0 * x, 3.0 * y, 2.0 * theta), Vector2::new(5.0 * mx, 5.0 * my))
        };
        let near = (Pose2::new(1.0, 2.0, 0.4), Vector2::new(1.8, 2.3));
        (0..200).map(view).chain([near]).collect()
    }

    crate::sensor_laws!(half, SENSOR, views());
    crate::sensor_laws!(all_around, RangeBearing { field_of_view: core::f64::consts::TAU, ..SENSOR }, views());

    #[test]
    fn it_sees_ahead_and_not_behind_nor_beyond_its_range_nor_near_the_edge() {
        let sees = |x: f64, y: f64, margin| SENSOR.sees(&Pose2::default(), &Vector2::new(x, y), margin);
        assert!(sees(4.9, 0.0, 0.0) && !sees(5.1, 0.0, 0.0) && !sees(-1.0, 0.0, 0.0));
        assert!(sees(4.9, 0.0, 0.05) && !sees(4.9, 0.0, 0.2));
        assert!(sees(0.1, 2.0, 0.0) && !sees(0.1, 2.0, 0.5));
        let panorama = RangeBearing { field_of_view: core::f64::consts::TAU, ..SENSOR };
        assert!(panorama.sees(&Pose2::default(), &Vector2::new(-2.0, 0.0), 0.5));
    }
}
