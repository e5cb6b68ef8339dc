//! How to resample: weights in, ancestor indices out.

use crate::error::SettingError;
use crate::random::Stream;
use crate::weights::Weights;

/// A resampling scheme. All are unbiased: slot i is expected n · w̃ᵢ offspring. They differ in the variance of that number.
///
/// Reference: Douc, Cappé, Moulines, *Comparison of resampling schemes for particle filtering* (2005).
#[derive(
    Clone, Copy, PartialEq, Eq, Debug, strum::Display, strum::EnumString, strum::VariantNames, strum::VariantArray,
)]
#[strum(serialize_all = "lowercase", parse_err_ty = SettingError, parse_err_fn = unknown_scheme)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Scheme {
    /// One uniform shifts a comb of n teeth: ⌊n w̃⌋ or ⌈n w̃⌉ offspring. The low-variance sampler, PR table 4.4.
    Systematic,
    /// One uniform in each of n equal strata.
    Stratified,
    /// n independent draws: the highest variance.
    Multinomial,
    /// ⌊n w̃⌋ offspring for certain, the rest drawn independently by what was cut off.
    Residual,
}

fn unknown_scheme(given: &str) -> SettingError {
    SettingError::unknown_word("scheme", given, <Scheme as strum::VariantNames>::VARIANTS)
}

impl Scheme {
    /// The ancestors of `n` new particles: slots of the old population, in ascending order.
    pub fn ancestors(&self, weights: &Weights, n: usize, stream: &mut Stream) -> Vec<u32> {
        let w = weights.as_slice();
        match self {
            Self::Systematic => systematic(w, n, stream.uniform()),
            Self::Stratified => invert(w, (0..n).map(|k| (k as f64 + stream.uniform()) / n as f64)),
            Self::Multinomial => expand(&offspring(w, 1.0, n, stream)),
            Self::Residual => {
                let expected: Vec<f64> = w.iter().map(|w| w * n as f64).collect();
                let certain: Vec<usize> = expected.iter().map(|e| e.floor() as usize).collect();
                let rest: Vec<f64> = expected.iter().map(|e| e - e.floor()).collect();
                let missing = n.saturating_sub(certain.iter().sum());
                let drawn = offspring(&rest, rest.iter().sum(), missing, stream);
                let counts: Vec<usize> = certain.iter().zip(drawn).map(|(certain, drawn)| certain + drawn).collect();
                let mut ancestors = expand(&counts);
                ancestors.truncate(n); // rounding up a weight can make one too many certain
                ancestors
            }
        }
    }
}

/// A comb of `n` teeth over the cumulative weights: each tooth picks the slot under it.
///
/// `shift` is a share of the distance between two teeth, from 0 to below 1: one random number.
pub fn systematic(weights: &[f64], n: usize, shift: f64) -> Vec<u32> {
    invert(weights, (0..n).map(|k| (k as f64 + shift) / n as f64))
}

/// Each slot as often as it has offspring.
fn expand(offspring: &[usize]) -> Vec<u32> {
    (0..).zip(offspring).flat_map(|(slot, count)| core::iter::repeat_n(slot, *count)).collect()
}

/// How many of `n` independent draws fall to each slot, by weights of this sum.
fn offspring(weights: &[f64], total: f64, n: usize, stream: &mut Stream) -> Vec<usize> {
    let cumulative: Vec<f64> = weights
        .iter()
        .scan(0.0, |sum, weight| {
            *sum += weight;
            Some(*sum)
        })
        .collect();
    let last = weights.iter().rposition(|w| *w > 0.0).unwrap_or(0);
    let mut counts = vec![0; weights.len()];
    for _ in 0..n {
        let point = stream.uniform() * total;
        counts[cumulative.partition_point(|sum| *sum <= point).min(last)] += 1;
    }
    counts
}

/// For each point, in ascending order, the slot whose piece of the cumulative weights holds it.
///
/// A slot of weight zero is never chosen; rounding in the sum may leave points past its end, which go to the last slot that has
/// weight.
fn invert(weights: &[f64], points: impl Iterator<Item = f64>) -> Vec<u32> {
    let last = weights.iter().rposition(|w| *w > 0.0).unwrap_or(0);
    let (mut slot, mut cumulative) = (0, weights[0]);
    points
        .map(|point| {
            while slot < last && cumulative <= point {
                slot += 1;
                cumulative += weights[slot];
            }
            slot as u32
        })
        .collect()
}
