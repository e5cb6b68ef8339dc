//! The integral of a hill by a sum over a lattice: what a fit through few values is judged by.

use fastslam::geometry::Gaussian3;
use fastslam::geometry::Pose2;
use fastslam::nalgebra::{Matrix3, Vector3};
use fastslam::ops;

/// exp(log_target) over poses, as a dense lattice has it.
#[derive(Clone, Debug)]
pub struct Hill {
    /// ln ∫ exp(log_target) dx \[nats\].
    pub log_integral: f64,
    /// Mean and covariance.
    pub gaussian: Gaussian3,
}

impl Hill {
    /// Half a side of a lattice \[standard deviations\].
    const HALF: f64 = 4.5;

    /// Three lattices of (2 `steps` + 1)³ poses, to ±4.5 standard deviations along each axis: of `around` made twice as wide, then
    /// of what the one before found. A step of less than one standard deviation sums a Gaussian to ten digits.
    ///
    /// `None` where the target is nowhere finite.
    pub fn summed(around: &Gaussian3, steps: u32, log_target: impl Fn(&Pose2) -> f64) -> Option<Self> {
        let mut wide = Gaussian3::new(*around.mean(), around.covariance() * 4.0)?;
        let mut found = None;
        for _ in 0..3 {
            let hill = Self::over(&wide, steps, &log_target)?;
            wide = hill.gaussian.clone();
            found = Some(hill);
        }
        found
    }

    fn over(axes: &Gaussian3, steps: u32, log_target: &impl Fn(&Pose2) -> f64) -> Option<Self> {
        let step = Self::HALF / f64::from(steps);
        let side: Vec<f64> = (0..=2 * steps).map(|k| f64::from(k) * step - Self::HALF).collect();
        let (mut poses, mut values) = (Vec::new(), Vec::new());
        for a in &side {
            for (b, c) in side.iter().flat_map(|b| side.iter().map(move |c| (b, c))) {
                let pose = axes.at([*a, *b, *c]);
                values.push(log_target(&pose));
                poses.push(pose);
            }
        }
        let log_sum = ops::log_sum_exp(&values);
        let (mut mu, mut second) = (Vector3::zeros(), Matrix3::zeros());
        for (pose, value) in poses.iter().zip(&values) {
            let (d, share) = (pose.minus(axes.mean()), ops::exp(value - log_sum));
            mu += d * share;
            second += d * d.transpose() * share;
        }
        // Of one cell of the lattice: stepᵈ √|Σ|, of which the second is in the density at the mean.
        let log_cell = 3.0 * ops::ln(step) - 1.5 * ops::ln(core::f64::consts::TAU) - axes.log_density(axes.mean());
        // A tenth of a millimetre and of a milliradian: a hill narrower than the first lattice's step must not be lost.
        let least = Matrix3::identity() * 1e-8;
        let gaussian = Gaussian3::new(axes.mean().plus(&mu), second - mu * mu.transpose() + least)?;
        Some(Self { log_integral: log_sum + log_cell, gaussian })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gaussian_hill_is_summed_exactly() {
        let sigma = Matrix3::new(0.005, 0.001, 0.0003, 0.001, 0.004, -0.0005, 0.0003, -0.0005, 0.002);
        let hill = Gaussian3::new(Pose2::new(1.0, 2.0, 3.0), sigma).unwrap();
        // Begun beside it and too narrow.
        let around = Gaussian3::new(Pose2::new(1.03, 2.0, 3.0), sigma * 0.5).unwrap();
        let found = Hill::summed(&around, 8, |pose| hill.log_density(pose) - 7.0).unwrap();
        // What lies beyond 4.5 standard deviations is 2e-5 of it.
        assert!((found.log_integral + 7.0).abs() < 1e-4, "{}", found.log_integral);
        assert!(found.gaussian.mean().minus(hill.mean()).norm() < 1e-5);
        assert!((found.gaussian.covariance() - sigma).norm() < 1e-5, "{}", found.gaussian.covariance());
    }
}
