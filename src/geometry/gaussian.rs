//! A Gaussian over poses, in the tangent plane of its mean.

use super::Pose2;
use crate::{ops, random::Stream};
use nalgebra::{Cholesky, Const, Matrix3, Vector3};

/// N(mean, Σ) over (x, y, θ) \[m, m, rad\]: differences from the mean are taken with the angle wrapped.
#[derive(Clone, Debug)]
pub struct Gaussian3 {
    mean: Pose2,
    cholesky: Cholesky<f64, Const<3>>,
    log_normalizer: f64,
}

impl Gaussian3 {
    /// The Gaussian with this mean and 3 × 3 covariance; `None` where the covariance is not positive definite.
    pub fn new(mean: Pose2, covariance: Matrix3<f64>) -> Option<Self> {
        let cholesky = Cholesky::new(covariance)?;
        let l = cholesky.l_dirty();
        let log_sqrt_det = ops::ln(l[(0, 0)] * l[(1, 1)] * l[(2, 2)]);
        if !log_sqrt_det.is_finite() {
            return None;
        }
        Some(Self { mean, cholesky, log_normalizer: -1.5 * ops::ln(core::f64::consts::TAU) - log_sqrt_det })
    }

    /// Mean pose.
    pub fn mean(&self) -> &Pose2 {
        &self.mean
    }

    /// ln N(pose; mean, Σ) \[nats\].
    pub fn log_density(&self, pose: &Pose2) -> f64 {
        // Forward substitution with the lower factor: ‖L⁻¹d‖² is the squared Mahalanobis distance.
        let (d, l) = (pose.minus(&self.mean), self.cholesky.l_dirty());
        let a = d.x / l[(0, 0)];
        let b = (d.y - l[(1, 0)] * a) / l[(1, 1)];
        let c = (d.z - l[(2, 0)] * a - l[(2, 1)] * b) / l[(2, 2)];
        self.log_normalizer - 0.5 * (a * a + b * b + c * c)
    }

    /// mean + L ε for standard normals or lattice points ε, with Σ = L Lᵀ.
    pub fn at(&self, epsilon: [f64; 3]) -> Pose2 {
        let (l, [a, b, c]) = (self.cholesky.l_dirty(), epsilon);
        self.mean.plus(&Vector3::new(
            l[(0, 0)] * a,
            l[(1, 0)] * a + l[(1, 1)] * b,
            l[(2, 0)] * a + l[(2, 1)] * b + l[(2, 2)] * c,
        ))
    }

    /// One draw; takes six `u64`s.
    pub fn sample(&self, stream: &mut Stream) -> Pose2 {
        self.at(stream.normals())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn log_density_is_the_textbook_formula() {
        let sigma = Matrix3::new(0.5, 0.1, 0.0, 0.1, 0.4, -0.05, 0.0, -0.05, 0.2);
        let (mean, pose) = (Pose2::new(1.0, 2.0, 3.0), Pose2::new(1.3, 1.8, -3.0));
        let d = Vector3::new(0.3, -0.2, core::f64::consts::TAU - 6.0);
        let quadratic = (d.transpose() * sigma.try_inverse().unwrap() * d)[0];
        let expected = -0.5 * quadratic - 0.5 * ops::ln((core::f64::consts::TAU * sigma).determinant());
        assert!((Gaussian3::new(mean, sigma).unwrap().log_density(&pose) - expected).abs() < 1e-12);
    }

    #[test]
    fn a_covariance_that_is_not_positive_definite_is_refused() {
        assert!(Gaussian3::new(Pose2::default(), Matrix3::zeros()).is_none());
        assert!(Gaussian3::new(Pose2::default(), Matrix3::from_element(f64::NAN)).is_none());
    }
}
