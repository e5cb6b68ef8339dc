//! A Gaussian over poses, in the tangent plane of its mean.

use super::Pose2;
use crate::{ops, random::Stream};
use nalgebra::{Cholesky, Const, Matrix3, Vector3};

/// N(mean, Σ) over (x, y, θ) \[m, m, rad\]: differences from the mean are taken with the angle wrapped.
#[derive(Clone, Debug)]
pub struct Gaussian3 {
    mean: Pose2,
    /// Of Σ in the order (θ, x, y).
    cholesky: Cholesky<f64, Const<3>>,
    log_normalizer: f64,
}

impl Gaussian3 {
    /// The Gaussian with this mean and 3 × 3 covariance; `None` where the covariance is not positive definite.
    pub fn new(mean: Pose2, covariance: Matrix3<f64>) -> Option<Self> {
        let s = covariance;
        let heading_first = Matrix3::new(s.m33, s.m31, s.m32, s.m13, s.m11, s.m12, s.m23, s.m21, s.m22);
        let cholesky = Cholesky::new(heading_first)?;
        let l = cholesky.l_dirty();
        let log_sqrt_det = ops::ln(l[(0, 0)] * l[(1, 1)] * l[(2, 2)]);
        if !log_sqrt_det.is_finite() {
            return None;
        }
        Some(Self { mean, cholesky, log_normalizer: -1.5 * ops::LN_TAU - log_sqrt_det })
    }

    /// Mean pose.
    pub fn mean(&self) -> &Pose2 {
        &self.mean
    }

    /// Σ (3 × 3, \[m, m, rad\]).
    pub fn covariance(&self) -> Matrix3<f64> {
        let l = self.cholesky.l();
        let s = l * l.transpose(); // heading first
        Matrix3::new(s.m22, s.m23, s.m21, s.m32, s.m33, s.m31, s.m12, s.m13, s.m11)
    }

    /// ln N(pose; mean, Σ) \[nats\].
    pub fn log_density(&self, pose: &Pose2) -> f64 {
        // Forward substitution with the lower factor: ‖L⁻¹d‖² is the squared Mahalanobis distance.
        let (d, l) = (pose.minus(&self.mean), self.cholesky.l_dirty());
        let a = d.z / l[(0, 0)];
        let b = (d.x - l[(1, 0)] * a) / l[(1, 1)];
        let c = (d.y - l[(2, 0)] * a - l[(2, 1)] * b) / l[(2, 2)];
        self.log_normalizer - 0.5 * (a * a + b * b + c * c)
    }

    /// mean + L ε for standard normals or lattice points ε, with Σ = L Lᵀ.
    ///
    /// The first ε is the heading in its standard deviations, and takes the position along as the covariance has it; the other
    /// two move the position for a given heading.
    pub fn at(&self, epsilon: [f64; 3]) -> Pose2 {
        let (l, [a, b, c]) = (self.cholesky.l_dirty(), epsilon);
        let theta = l[(0, 0)] * a;
        let x = l[(1, 0)] * a + l[(1, 1)] * b;
        let y = l[(2, 0)] * a + l[(2, 1)] * b + l[(2, 2)] * c;
        self.mean.plus(&Vector3::new(x, y, theta))
    }

    /// One draw; takes six `u64`s.
    pub fn sample(&self, stream: &mut Stream) -> Pose2 {
        self.at(stream.normals())
    }
}

/// mean + L ε for three standard normals ε, with Σ = L Lᵀ, where Σ (3 × 3, \[m, m, rad\]) may be singular: along directions without
/// variance nothing moves. Takes six `u64`s.
///
/// The Cholesky factor column by column; a pivot that is nothing against its variance, as rounding leaves it, counts as zero
/// with its whole column.
pub fn sample_semidefinite(mean: &Pose2, covariance: &Matrix3<f64>, stream: &mut Stream) -> Pose2 {
    let mut l = *covariance;
    for k in 0..3 {
        for j in 0..k {
            for i in k..3 {
                l[(i, k)] -= l[(i, j)] * l[(k, j)];
            }
        }
        let pivot = l[(k, k)];
        let root = if pivot > 1e-12 * covariance[(k, k)] { pivot.sqrt() } else { 0.0 };
        for i in k..3 {
            l[(i, k)] = if root > 0.0 { l[(i, k)] / root } else { 0.0 };
        }
    }
    let [a, b, c]: [f64; 3] = stream.normals();
    let delta =
        Vector3::new(l[(0, 0)] * a, l[(1, 0)] * a + l[(1, 1)] * b, l[(2, 0)] * a + l[(2, 1)] * b + l[(2, 2)] * c);
    mean.plus(&delta)
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

    /// Unit lattice directions have the outer-product sum Σ: exact, no sampling.
    #[test]
    fn the_factor_has_the_covariance() {
        let sigma = Matrix3::new(0.5, 0.1, 0.03, 0.1, 0.4, -0.05, 0.03, -0.05, 0.2);
        let gaussian = Gaussian3::new(Pose2::default(), sigma).unwrap();
        let columns =
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| gaussian.at(e).minus(&Pose2::default()));
        let sum: Matrix3<f64> = columns.iter().map(|c| c * c.transpose()).sum();
        assert!((sum - sigma).norm() < 1e-14, "{sum}");
    }

    #[test]
    fn a_singular_covariance_moves_nothing_where_it_has_no_variance() {
        let along = Vector3::new(0.3, 0.4, 0.0);
        for slot in 0..100 {
            let mut stream = Stream::at(1, crate::random::Purpose::TRIAL, 0, slot);
            let still = sample_semidefinite(&Pose2::new(1.0, 2.0, 3.0), &Matrix3::zeros(), &mut stream);
            assert_eq!(still, Pose2::new(1.0, 2.0, 3.0));
            let pose = sample_semidefinite(&Pose2::default(), &(along * along.transpose()), &mut stream);
            assert!((pose.x * 0.4 - pose.y * 0.3).abs() < 1e-12 && pose.theta == 0.0 && pose.x != 0.0, "{pose:?}");
        }
    }

    /// α = 0.001 two-sided for each of nine numbers (Bonferroni), n = 20 000.
    #[test]
    fn draws_of_a_definite_covariance_have_it() {
        let sigma = Matrix3::new(0.5, 0.1, 0.03, 0.1, 0.4, -0.05, 0.03, -0.05, 0.2);
        let n = 20_000_u32;
        let mut second = Matrix3::zeros();
        for slot in 0..n {
            let mut stream = Stream::at(2, crate::random::Purpose::TRIAL, 0, slot);
            let d = sample_semidefinite(&Pose2::default(), &sigma, &mut stream).minus(&Pose2::default());
            second += d * d.transpose() / f64::from(n);
        }
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            // Var(dᵢ dⱼ) = Σᵢᵢ Σⱼⱼ + Σᵢⱼ² for a Gaussian.
            let std = ((sigma[(i, i)] * sigma[(j, j)] + sigma[(i, j)] * sigma[(i, j)]) / f64::from(n)).sqrt();
            assert!((second[(i, j)] - sigma[(i, j)]).abs() < 3.9 * std, "({i}, {j})");
        }
    }

    #[test]
    fn a_covariance_that_is_not_positive_definite_is_refused() {
        assert!(Gaussian3::new(Pose2::default(), Matrix3::zeros()).is_none());
        assert!(Gaussian3::new(Pose2::default(), Matrix3::from_element(f64::NAN)).is_none());
    }
}
