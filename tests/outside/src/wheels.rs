//! Motion of a robot with two driven wheels, by what their encoders count.

use fastslam::geometry::Pose2;
use fastslam::motion::Motion;
use fastslam::nalgebra::{Matrix2, Matrix3, Matrix3x2};
use fastslam::ops;
use fastslam::random::Stream;

/// How far each wheel rolled in a step \[m\].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rolled {
    pub left: f64,
    pub right: f64,
}

/// Two wheels on an axle, each with a noise of its own: σ² = (slip · distance)² + jitter².
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Wheels {
    /// From wheel to wheel \[m\].
    pub axle: f64,
    /// Share of the distance that a wheel slips \[–\].
    pub slip: f64,
    /// What an encoder errs even where its wheel stands still \[m\].
    pub jitter: f64,
}

impl Wheels {
    fn stds(&self, u: &Rolled) -> [f64; 2] {
        [u.left, u.right].map(|distance| ops::hypot(self.slip * distance, self.jitter))
    }

    /// What may have been rolled, given what was counted.
    pub fn perturb(&self, u: &Rolled, stream: &mut Stream) -> Rolled {
        let ([left, right], [a, b]) = (self.stds(u), stream.normals());
        Rolled { left: u.left + left * a, right: u.right + right * b }
    }
}

impl Motion for Wheels {
    type Control = Rolled;

    /// Ahead by the mean of both, in the direction half-way between the headings.
    fn apply(&self, from: &Pose2, u: &Rolled) -> Pose2 {
        let (ahead, turn) = (0.5 * (u.left + u.right), (u.right - u.left) / self.axle);
        let (sin, cos) = ops::sin_cos(from.theta + 0.5 * turn);
        Pose2::new(from.x + ahead * cos, from.y + ahead * sin, from.theta + turn)
    }

    fn sample(&self, from: &Pose2, u: &Rolled, stream: &mut Stream) -> Pose2 {
        self.apply(from, &self.perturb(u, stream))
    }

    fn covariance(&self, from: &Pose2, u: &Rolled) -> Matrix3<f64> {
        let (ahead, turn) = (0.5 * (u.left + u.right), (u.right - u.left) / self.axle);
        let (sin, cos) = ops::sin_cos(from.theta + 0.5 * turn);
        let side = 0.5 * ahead / self.axle;
        let v = Matrix3x2::new(
            0.5 * cos + side * sin,
            0.5 * cos - side * sin,
            0.5 * sin - side * cos,
            0.5 * sin + side * cos,
            -1.0 / self.axle,
            1.0 / self.axle,
        );
        let [left, right] = self.stds(u).map(|std| std * std);
        v * Matrix2::new(left, 0.0, 0.0, right) * v.transpose()
    }
}
