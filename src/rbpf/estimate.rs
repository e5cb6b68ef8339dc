//! Where the robot is, in three numbers and their covariance.

use super::Rbpf;
use crate::geometry::Pose2;
use crate::map::ConditionalMap;
use crate::ops;
use crate::proposal::Proposal;
use nalgebra::{Matrix3, Vector3};

/// The first two moments of a population's present poses, and its best particle.
#[derive(Clone, PartialEq, Debug)]
pub struct Estimate {
    /// x̄ = (Σ w̃ x, Σ w̃ y, atan2(Σ w̃ sin θ, Σ w̃ cos θ)) \[m, m, rad\]: for the heading the circular mean (Mardia and Jupp 2000,
    /// §2.2). Where the headings are balanced around the circle it is no one's direction.
    pub mean: Pose2,
    /// Σ w̃ d dᵀ (3 × 3, \[m, m, rad\]), with d = x ⊖ x̄ in the world's frame, the heading wrapped to (−π, π\]: the covariance in the
    /// tangent plane of the mean. It is that of the particles as they stand, without the n / (n − 1) of a sample's.
    pub covariance: Matrix3<f64>,
    /// Slot of the best particle: [`Rbpf::best`]. Its pose need not be near the mean where the population holds several
    /// explanations.
    pub best: usize,
}

impl<M: ConditionalMap, P: Proposal<M>> Rbpf<M, P> {
    /// Where the robot is by the present poses and weights. Of use where they are of one cluster; the mean of two lies between them.
    pub fn estimate(&self) -> Estimate {
        let poses = || self.particles.iter().map(|p| p.world_from_robot).zip(self.weights.as_slice().iter().copied());
        let (mean, covariance) = moments(poses);
        Estimate { mean, covariance, best: self.best() }
    }
}

/// Weighted mean and covariance of poses, by weights that sum to one.
pub(crate) fn moments<I: Iterator<Item = (Pose2, f64)>>(poses: impl Fn() -> I) -> (Pose2, Matrix3<f64>) {
    let (mut x, mut y, mut sine, mut cosine) = (0.0, 0.0, 0.0, 0.0);
    for (pose, weight) in poses() {
        let (sin, cos) = ops::sin_cos(pose.theta);
        x += weight * pose.x;
        y += weight * pose.y;
        sine += weight * sin;
        cosine += weight * cos;
    }
    let mean = Pose2::new(x, y, ops::atan2(sine, cosine));
    let outer = |(pose, weight): (Pose2, f64)| {
        let d: Vector3<f64> = pose.minus(&mean);
        d * d.transpose() * weight
    };
    (mean, poses().map(outer).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    /// By hand: x̄ = 1 and ȳ = ½; headings ±0.1 from π with weights ¼ + ¼ and ½ at π itself have their mean at π, across the cut of
    /// the angle. Deviations (−1, ½, ·), (1, ½, ·), (0, −½, 0), so Var x = ½, Var y = ¼, Var θ = ½ · 0.01, Cov(x, θ) = ½ · 0.1.
    #[test]
    fn the_moments_of_three_poses_are_those_found_by_hand() {
        let poses = [
            (Pose2::new(0.0, 1.0, PI - 0.1), 0.25),
            (Pose2::new(2.0, 1.0, PI + 0.1), 0.25),
            (Pose2::new(1.0, 0.0, PI), 0.5),
        ];
        let (mean, covariance) = moments(|| poses.into_iter());
        assert!(mean.minus(&Pose2::new(1.0, 0.5, PI)).norm() < 1e-15, "{mean:?}");
        let expected = Matrix3::new(0.5, 0.0, 0.05, 0.0, 0.25, 0.0, 0.05, 0.0, 0.005);
        assert!((covariance - expected).norm() < 1e-15, "{covariance}");
    }
}
