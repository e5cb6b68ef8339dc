//! What a scan says of the path of a particle that looked first.
//!
//! A particle that draws its pose from q ∝ p(z | x, m) p(x | x′, u) pays the normaliser of q (Doucet, Godsill and Andrieu 2000, *On
//! sequential Monte Carlo sampling methods for Bayesian filtering*, §II-D: the optimal importance function),
//!
//! η(m) = ∫ p(z | x, m) p(x | x′, u) dx,
//!
//! whatever pose was drawn. Split the map into what was seen for the first time within the [lag](crate::map::grid::GridModel::lag), and the
//! rest, the old map: p_old := p(z | x, old map) and, by definition, p_new := p(z | x, m) / p_old. Where a scan meets new ground only, η(m)
//! depends on the last poses relative to each other, and on nothing before: move the path with its map rigidly, and it stays what it
//! is. All particles whose last steps fit have the same η(m) there in truth; what is computed differs by where the raster happens to lie, and
//! resampling by it is a lottery, which spends the diversity that the closing of a loop will need. η(m_new) = ∫ p_new p(x | x′, u) dx is
//! what new ground says of a path, and η(m) / η(m_new) what is left when that is taken away.

use super::fit::differences;
use crate::error::SettingError;
use crate::geometry::{Gaussian3, Pose2};
use crate::map::ConditionalMap;
use crate::matching::{Likelihood, Score};
use crate::ops;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// The log weight increment of [`FromScan`](super::FromScan) \[nats\], before [`full_weight`](super::FromScanSettings::full_weight).
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::EnumString, strum::VariantNames, strum::VariantArray,
)]
#[strum(serialize_all = "kebab-case", parse_err_ty = SettingError, parse_err_fn = unknown_weight)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum IncrementalWeight {
    /// ln η(m), by the integral of the fit: Rao–Blackwell's weight of the optimal proposal. With a score that is a likelihood, the product over
    /// the steps is the evidence.
    Marginal,
    /// ln η(m) − ln η(m_new) = −ln E_q\[1 / p_old\]: ground that the old map does not know says the same of all particles, to the bit. Where all
    /// ground is known, it is [`Self::Marginal`].
    NewGroundFree,
    /// ln p_old at the pose that was drawn. A heuristic: on known ground it counts the scan twice, as the pose was drawn by it and pays for it
    /// again.
    OldMapAtDraw,
}

impl IncrementalWeight {
    /// The log weight increment of a pose that was drawn from p(x | x′, u) \[nats\]: ln p(z | x, m), the importance weight of such a draw,
    /// for [`Self::Marginal`]; ln p_old for the others, as all that new ground says of the draw is left out.
    pub(super) fn of_motion<M: ConditionalMap<Association = ()>>(
        self,
        score: &impl Score<M>,
        map: &M,
        drawn: &Pose2,
        observation: &M::Observation,
    ) -> f64 {
        match self {
            Self::Marginal => score.log_likelihood(map, drawn, observation).0,
            Self::NewGroundFree | Self::OldMapAtDraw => score.log_old(map, drawn, observation),
        }
    }
}

/// What [`FromMotion`](super::FromMotion) pays for a scan by a choice of [`IncrementalWeight`]: ln p(z | x, m) with
/// [`IncrementalWeight::Marginal`], which is FastSLAM 1.0, and ln p_old with the others.
#[derive(Clone, Copy, Debug)]
pub struct ScanAtDraw<L> {
    /// How well a scan fits a map.
    pub score: L,
    /// What is paid.
    pub weight: IncrementalWeight,
}

impl<M: ConditionalMap<Association = ()>, L: Score<M>> Likelihood<M> for ScanAtDraw<L> {
    fn log_likelihood(&self, map: &M, world_from_robot: &Pose2, observation: &M::Observation) -> (f64, ()) {
        (self.weight.of_motion(&self.score, map, world_from_robot, observation), ())
    }

    fn validate(&self) -> Result<(), SettingError> {
        self.score.validate()
    }
}

fn unknown_weight(given: &str) -> SettingError {
    SettingError::unknown_word("weight", given, <IncrementalWeight as strum::VariantNames>::VARIANTS)
}

/// ln E_q\[1 / p_old\] \[nats\] for a Gaussian q = N(μ, P⁻¹): thirteen values of ln p_old are asked for.
///
/// In the coordinates in which the prior is N(0, I), ln p_old is the parabola l + gᵀ y − ½ yᵀ A y around μ through the values there and at twelve
/// points one standard deviation of the prior away, and the mean is that of a Gaussian,
///
/// ln E_q\[1 / p_old\] = −l + ½ (ln |P| − ln |P − A| + gᵀ (P − A)⁻¹ g).
///
/// P − A is the information of p_new p(x | x′, u), which holds that of the prior: no eigenvalue counts for less than its 1. So points within q alone
/// would not do: where all ground is known the integrand q / p_old is the prior, however much narrower q is. Exact for Gaussians; and where the
/// old map says the same of all thirteen poses, −l to the bit.
pub(super) fn log_mean_inverse(q: &Gaussian3, prior: &Gaussian3, log_old: impl Fn(&Pose2) -> f64) -> f64 {
    let center = log_old(q.mean());
    let Some(axes) = axes(prior) else { return -center };
    let (gradient, information) = differences(center, 1.0, |u, side| log_old(&q.mean().plus(&(axes * u * side))));
    if gradient == Vector3::zeros() && information == Matrix3::zeros() {
        return -center;
    }
    let Some(precision) = q.covariance().try_inverse() else { return -center };
    let precision = axes.transpose() * precision * axes;
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(precision - information);
    let along = eigenvectors.transpose() * gradient;
    let new = |k: usize| eigenvalues[k].max(1.0);
    let sum: f64 = (0..3).map(|k| along[k] * along[k] / new(k) - ops::ln(new(k))).sum();
    0.5 * (ops::ln(precision.determinant()) + sum) - center
}

/// L with Σ = L Lᵀ, made in the frame of the mean: it turns with the world.
fn axes(gaussian: &Gaussian3) -> Option<Matrix3<f64>> {
    let (sin, cos) = ops::sin_cos(gaussian.mean().theta);
    let frame = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let covariance = frame.transpose() * gaussian.covariance() * frame;
    Some(frame * covariance.cholesky()?.l())
}

/// ln Σ ωᵢ exp(aᵢ) of weights ωᵢ ∝ exp(bᵢ); exactly a where all aᵢ are a.
pub(super) fn log_mixture(a: &[f64], b: &[f64]) -> f64 {
    let log_sum = ops::log_sum_exp(b);
    let most = a.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let less: f64 = a.iter().zip(b).map(|(a, b)| ops::exp(b - log_sum) * (ops::exp(a - most) - 1.0)).sum();
    most + ops::ln(1.0 + less)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mixture_of_equals_is_each_of_them_to_the_bit() {
        for a in [-1.1, -300.7, 0.0] {
            assert_eq!(log_mixture(&[a; 3], &[0.3, -4.1, 1.7]), a);
        }
        let mixed = log_mixture(&[-1.0, -3.0], &[ops::ln(0.25), ops::ln(0.75)]);
        assert!((mixed - ops::ln(0.25 * ops::exp(-1.0) + 0.75 * ops::exp(-3.0))).abs() < 1e-15);
    }
}
