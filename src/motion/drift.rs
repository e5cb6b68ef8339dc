//! The drift of odometry: what a robot turns by beyond what its wheels report, in proportion to what it drove and turned.
//!
//! A tyre that is worn, a steering that is not quite straight or an axle that is measured badly errs in the same direction at every step. No noise
//! describes that: noise adds up as the root of the way, a drift as the way itself. It is a constant of the robot, and is learnt from its motion.
//!
//! References: Roy and Thrun, *Online self-calibration for mobile robots*, ICRA 1999; Bishop, *Pattern recognition and machine learning* (2006), §3.3,
//! for the conjugate regression.

use nalgebra::{SMatrix, SVector};

/// The Gaussian posterior of a drift b with N coefficients: Bayesian linear regression of the heading's error on what causes it.
///
/// Over a stretch the heading errs by e = bᵀ c + ε, ε ~ N(0, v), for the causes c, such as metres driven and radians turned. With the
/// conjugate prior b ~ N(0, diag(s²)) the posterior is N(Λ⁻¹ η, Λ⁻¹), Λ = diag(s⁻²) + Σ c cᵀ / v and η = Σ c e / v. These sums are all that is kept,
/// and where v grows with the way they are the same however a stretch is cut.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Drift<const N: usize> {
    /// Λ.
    information: SMatrix<f64, N, N>,
    /// η.
    weighted: SVector<f64, N>,
}

impl<const N: usize> Drift<N> {
    /// The prior: each coefficient 0 with its standard deviation \[rad per unit of its cause\], above 0.
    pub fn new(stds: [f64; N]) -> Self {
        Self {
            information: SMatrix::from_diagonal(&SVector::from(stds.map(|std| 1.0 / (std * std)))),
            weighted: SVector::zeros(),
        }
    }

    /// The mean of b \[rad per unit of each cause\].
    pub fn coefficients(&self) -> [f64; N] {
        let (l, d) = self.factors();
        let y = forward(&l, self.weighted.into());
        let mut b: [f64; N] = core::array::from_fn(|k| y[k] / d[k]);
        for k in (0..N).rev() {
            for j in k + 1..N {
                b[k] -= l[(j, k)] * b[j];
            }
        }
        b
    }

    /// bᵀ c: the mean of the heading's error \[rad\] for these causes.
    pub fn mean(&self, causes: [f64; N]) -> f64 {
        let b = self.coefficients();
        (1..N).fold(b[0] * causes[0], |sum, k| sum + b[k] * causes[k])
    }

    /// cᵀ Λ⁻¹ c: the variance of that mean \[rad²\], as far as b is not known.
    pub fn variance(&self, causes: [f64; N]) -> f64 {
        let (l, d) = self.factors();
        let y = forward(&l, causes);
        (1..N).fold(y[0] * y[0] / d[0], |sum, k| sum + y[k] * y[k] / d[k])
    }

    /// Learns from an error of the heading \[rad\] over a stretch with these causes, where noise has this variance \[rad²\], above 0.
    pub fn learn(&mut self, causes: [f64; N], error: f64, variance: f64) {
        self.learn_and_forget(causes, error, variance, 1.0);
    }

    /// [`Self::learn`] with exponential forgetting: what was known before is scaled by `kept`, 0 to 1.
    pub(crate) fn learn_and_forget(&mut self, causes: [f64; N], error: f64, variance: f64, kept: f64) {
        let (information, weighted) = (self.information, self.weighted);
        self.information = SMatrix::from_fn(|i, j| kept * information[(i, j)] + causes[i] * causes[j] / variance);
        self.weighted = SVector::from_fn(|i, _| kept * weighted[i] + causes[i] * error / variance);
    }

    /// Λ = L D Lᵀ, L with ones on its diagonal.
    fn factors(&self) -> (SMatrix<f64, N, N>, [f64; N]) {
        let (mut l, mut d) = (SMatrix::identity(), [0.0; N]);
        for k in 0..N {
            d[k] = (0..k).fold(self.information[(k, k)], |rest, j| rest - l[(k, j)] * l[(k, j)] * d[j]);
            for i in k + 1..N {
                let rest = (0..k).fold(self.information[(i, k)], |rest, j| rest - l[(i, j)] * l[(k, j)] * d[j]);
                l[(i, k)] = rest / d[k];
            }
        }
        (l, d)
    }
}

#[cfg(feature = "serde")]
impl Drift<1> {
    /// Λ and η.
    pub(crate) fn sums(&self) -> [f64; 2] {
        [self.information[0], self.weighted[0]]
    }

    /// Of these sums.
    pub(crate) fn of_sums([information, weighted]: [f64; 2]) -> Self {
        Self { information: SMatrix::from([[information]]), weighted: SVector::from([weighted]) }
    }
}

/// L⁻¹ c.
fn forward<const N: usize>(l: &SMatrix<f64, N, N>, mut c: [f64; N]) -> [f64; N] {
    for k in 0..N {
        for j in 0..k {
            c[k] -= l[(k, j)] * c[j];
        }
    }
    c
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Stream};
    use nalgebra::{Matrix3, Vector3};

    /// Against the inverse of Λ as nalgebra has it, for three coefficients; and the truth lies within three deviations of each.
    #[test]
    fn the_posterior_is_that_of_linear_regression() {
        let truth = Vector3::new(0.02, -0.05, 0.01);
        let (mut drift, variance) = (Drift::new([0.05, 0.1, 0.2]), 4e-4_f64);
        let (mut lambda, mut weighted) = (Matrix3::from_diagonal(&Vector3::new(400.0, 100.0, 25.0)), Vector3::zeros());
        for step in 0..200 {
            let mut stream = Stream::at(1, Purpose::TRIAL, step, 0);
            let [a, b, c] = stream.normals();
            let [noise] = Stream::at(1, Purpose::TRIAL, step, 1).normals();
            let causes = Vector3::new(a, b, a + 0.3 * c);
            let error = truth.dot(&causes) + variance.sqrt() * noise;
            drift.learn(causes.into(), error, variance);
            lambda += causes * causes.transpose() / variance;
            weighted += causes * error / variance;
        }
        let covariance = lambda.try_inverse().unwrap();
        let (mean, ask) = (covariance * weighted, Vector3::new(0.4, -1.0, 2.0));
        for k in 0..3 {
            assert!((drift.coefficients()[k] - mean[k]).abs() < 1e-9, "{k}");
            assert!((mean[k] - truth[k]).abs() < 3.0 * covariance[(k, k)].sqrt(), "{k}");
        }
        assert!((drift.mean(ask.into()) - mean.dot(&ask)).abs() < 1e-9);
        let variance = ask.dot(&(covariance * ask));
        assert!((drift.variance(ask.into()) / variance - 1.0).abs() < 1e-9);
    }

    /// A stretch whose noise grows with the way, at once and in ten parts of it.
    #[test]
    fn the_posterior_is_the_same_however_a_stretch_is_cut() {
        let [mut whole, mut parts] = [Drift::new([0.05, 0.05]); 2];
        for (way, turn, error) in [(2.0, 0.3, 0.07), (1.0, -0.8, -0.01), (3.0, 0.1, 0.12)] {
            whole.learn([way, turn], error, 0.01 * way);
            for _ in 0..10 {
                parts.learn([0.1 * way, 0.1 * turn], 0.1 * error, 0.001 * way);
            }
        }
        for causes in [[1.0, 0.0], [0.0, 1.0], [2.0, -1.0]] {
            assert!((whole.mean(causes) - parts.mean(causes)).abs() < 1e-12);
            assert!((whole.variance(causes) / parts.variance(causes) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn what_nothing_is_known_of_is_nothing_with_the_deviation_of_the_prior() {
        let drift = Drift::new([0.05, 0.2]);
        assert_eq!(drift.coefficients(), [0.0, 0.0]);
        assert!((drift.variance([3.0, 0.0]) - 0.0225).abs() < 1e-15);
        assert!((drift.variance([3.0, 1.0]) - 0.0625).abs() < 1e-15);
    }
}
