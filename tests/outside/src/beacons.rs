//! A receiver of radio beacons: how strong each is, and from where it comes.

use fastslam::geometry::Pose2;
use fastslam::nalgebra::{Matrix2, Matrix2x3, Vector2};
use fastslam::ops;
use fastslam::sensor::{LandmarkSensor, Prediction};

/// z = (−ln r, φ): the strength of a signal falls with the distance, its direction is counted from straight ahead \[nats, rad\].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Receiver {
    /// \[nats\]
    pub strength_std: f64,
    /// \[rad\]
    pub direction_std: f64,
    /// How far a beacon is heard \[m\].
    pub reach: f64,
}

impl LandmarkSensor for Receiver {
    fn predict(&self, at: &Pose2, landmark: &Vector2<f64>) -> Prediction {
        let (dx, dy) = (landmark.x - at.x, landmark.y - at.y);
        let q = (dx * dx + dy * dy).max(1e-12);
        Prediction {
            z: Vector2::new(-0.5 * ops::ln(q), ops::wrap_angle(ops::atan2(dy, dx) - at.theta)),
            h_x: Matrix2x3::new(dx / q, dy / q, 0.0, dy / q, -dx / q, -1.0),
            h_m: Matrix2::new(-dx / q, -dy / q, -dy / q, dx / q),
        }
    }

    fn residual(&self, z: &Vector2<f64>, predicted: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(z.x - predicted.x, ops::wrap_angle(z.y - predicted.y))
    }

    fn locate(&self, at: &Pose2, z: &Vector2<f64>) -> Vector2<f64> {
        let (r, (sin, cos)) = (ops::exp(-z.x), ops::sin_cos(at.theta + z.y));
        Vector2::new(at.x + r * cos, at.y + r * sin)
    }

    fn noise(&self) -> Matrix2<f64> {
        Matrix2::new(self.strength_std * self.strength_std, 0.0, 0.0, self.direction_std * self.direction_std)
    }

    fn sees(&self, at: &Pose2, landmark: &Vector2<f64>, margin: f64) -> bool {
        ops::hypot(landmark.x - at.x, landmark.y - at.y) + margin <= self.reach
    }
}
