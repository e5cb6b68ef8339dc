//! A motion that is known as a Gaussian over where the robot got to, seen from where it was.

use super::Motion;
use crate::geometry::{Pose2, sample_semidefinite};
use crate::ops;
use crate::random::Stream;
use nalgebra::Matrix3;

/// Where a robot got to, as a normal distribution in the frame of where it was.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Displacement {
    /// Mean \[m, m, rad\].
    pub mean: Pose2,
    /// Covariance (3 × 3, \[m, m, rad\]).
    pub covariance: Matrix3<f64>,
}

impl Displacement {
    /// The displacement where the heading errs besides, by N(turn, variance) \[rad, rad²\], evenly along the way: half of the error is there from the
    /// start of the motion, so that it moves the position too.
    pub fn turned(&self, turn: f64, variance: f64) -> Self {
        let half = Pose2::new(0.0, 0.0, 0.5 * turn);
        let mean = half.compose(&self.mean).compose(&half);
        let aside = [-0.5 * mean.y, 0.5 * mean.x, 1.0];
        Self { mean, covariance: self.covariance + Matrix3::from_fn(|i, j| variance * aside[i] * aside[j]) }
    }
}

/// The motion model of a [`Displacement`]: x_t = x_{t−1} ⊕ d, d ~ N(mean, covariance).
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Displaced;

impl Motion for Displaced {
    type Control = Displacement;

    fn apply(&self, from: &Pose2, d: &Displacement) -> Pose2 {
        from.compose(&d.mean)
    }

    fn sample(&self, from: &Pose2, d: &Displacement, stream: &mut Stream) -> Pose2 {
        from.compose(&sample_semidefinite(&d.mean, &d.covariance, stream))
    }

    fn covariance(&self, from: &Pose2, d: &Displacement) -> Matrix3<f64> {
        let (sin, cos) = ops::sin_cos(from.theta);
        let turn = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        turn * d.covariance * turn.transpose()
    }
}
