//! Weights of a population: log-scale, normalised, immutable.

use crate::ops;
#[cfg(feature = "serde")]
use crate::save::{self, RestoreError};

/// Normalised importance weights w̃ of M particles, kept as logarithms.
#[derive(Clone, PartialEq, Debug)]
pub struct Weights {
    log_weights: Vec<f64>,
    weights: Vec<f64>,
}

impl Weights {
    /// M equal weights.
    pub fn uniform(count: usize) -> Self {
        let weight = 1.0 / count as f64;
        Self { log_weights: vec![ops::ln(weight); count], weights: vec![weight; count] }
    }

    /// The weights after each has been multiplied by exp(increment), with the log of their sum before normalising \[nats\]:
    /// the filter's estimate of ln p(z_t | z₁..ₜ₋₁).
    ///
    /// Increments that are not numbers count as −∞. Where some are +∞, so is the sum, and their particles share the weight in
    /// proportion to their old weights. Where no particle has any weight left, the sum is −∞ and the old weights stay: a
    /// population that explains nothing is no reason to lose it.
    pub fn reweighted(&self, log_increments: &[f64]) -> (Self, f64) {
        assert_eq!(log_increments.len(), self.log_weights.len(), "one increment for each weight");
        let product = |(log_weight, increment): (&f64, &f64)| {
            let sum = log_weight + increment;
            if sum.is_nan() { f64::NEG_INFINITY } else { sum } // also of −∞ and +∞: what has no weight gets none back
        };
        let unnormalized: Vec<f64> = self.log_weights.iter().zip(log_increments).map(product).collect();
        let log_evidence = ops::log_sum_exp(&unnormalized);
        if log_evidence == f64::NEG_INFINITY {
            return (self.clone(), log_evidence);
        }
        if log_evidence == f64::INFINITY {
            let share = |w: &f64| if *w == f64::INFINITY { 0.0 } else { f64::NEG_INFINITY };
            return (self.reweighted(&unnormalized.iter().map(share).collect::<Vec<_>>()).0, log_evidence);
        }
        let log_weights: Vec<f64> = unnormalized.iter().map(|w| w - log_evidence).collect();
        let weights = log_weights.iter().map(|w| ops::exp(*w)).collect();
        (Self { log_weights, weights }, log_evidence)
    }

    /// Weights of copies of these slots, each as heavy as its original before they are normalised.
    pub fn copied(&self, slots: &[u32]) -> Self {
        let log_weights: Vec<f64> = slots.iter().map(|slot| self.log_weights[*slot as usize]).collect();
        Self::uniform(slots.len()).reweighted(&log_weights).0
    }

    /// w^τ, normalised: flatter than the weights for a `temper` τ below 1, and to the bit the weights themselves for 1.
    pub fn tempered(&self, temper: f64) -> Self {
        if temper == 1.0 {
            return self.clone();
        }
        let log_powers: Vec<f64> = self.log_weights.iter().map(|log_weight| temper * log_weight).collect();
        Self::uniform(log_powers.len()).reweighted(&log_powers).0
    }

    /// Weights of copies of the slots `ancestors`, which were drawn by their scores: w / score, normalised, with the log of the mean that was
    /// divided by \[nats\]. In the mean over the draws of an unbiased scheme that mean is 1. Where scores are the weights, copies weigh the same, and
    /// the log is 0, to the bit.
    pub fn selected(&self, scores: &Self, ancestors: &[u32]) -> (Self, f64) {
        let log_ratio = |slot: &u32| self.log_weights[*slot as usize] - scores.log_weights[*slot as usize];
        if ancestors.iter().all(|slot| log_ratio(slot) == 0.0) {
            return (Self::uniform(ancestors.len()), 0.0);
        }
        Self::uniform(ancestors.len()).reweighted(&ancestors.iter().map(log_ratio).collect::<Vec<_>>())
    }

    /// w̃, which sum to one.
    pub fn as_slice(&self) -> &[f64] {
        &self.weights
    }

    /// N_eff = 1 / Σ w̃², between 1 and M (Kong, Liu, Wong 1994): M to the last bit where all weights are equal.
    ///
    /// ```
    /// let uniform = fastslam::weights::Weights::uniform(2);
    /// let (weights, _) = uniform.reweighted(&[2.753451476665_f64.ln(), 0.863168987665_f64.ln()]);
    /// assert!((weights.as_slice()[0] - 0.761332714843).abs() < 1e-9);
    /// assert!((weights.ess() - 1.5708708376).abs() < 1e-9);
    /// ```
    pub fn ess(&self) -> f64 {
        if self.weights.iter().all(|w| *w == self.weights[0]) {
            return self.weights.len() as f64; // what rounding in the sum would miss
        }
        1.0 / self.weights.iter().map(|w| w * w).sum::<f64>()
    }

    /// Slot of the largest weight, the lowest of equals.
    pub fn heaviest(&self) -> usize {
        let log_weights = &self.log_weights; // which tell apart what exp rounds to 0
        (1..log_weights.len()).fold(0, |top, slot| if log_weights[slot] > log_weights[top] { slot } else { top })
    }
}

/// Weights in plain numbers. Both forms: 1 / M and exp(ln(1 / M)) may differ in the last bit.
#[cfg(feature = "serde")]
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub(crate) struct SavedWeights {
    /// None for −∞, which not every format can write.
    log_weights: Vec<Option<f64>>,
    weights: Vec<f64>,
}

#[cfg(feature = "serde")]
impl Weights {
    pub(crate) fn save(&self) -> SavedWeights {
        let log_weight = |log_weight: &f64| log_weight.is_finite().then_some(*log_weight);
        SavedWeights { log_weights: self.log_weights.iter().map(log_weight).collect(), weights: self.weights.clone() }
    }

    pub(crate) fn restore(SavedWeights { log_weights, weights }: SavedWeights) -> Result<Self, RestoreError> {
        /// Far more than rounding does to the sum of a billion weights.
        const SLACK: f64 = 1e-6;
        save::count("weights", log_weights.len(), weights.len())?;
        save::finite("weights", log_weights.iter().copied().flatten().chain(weights.iter().copied()))?;
        let log_weights: Vec<f64> = log_weights.into_iter().map(|w| w.unwrap_or(f64::NEG_INFINITY)).collect();
        let alike = |(w, log_w): (&f64, &f64)| *w >= 0.0 && (ops::exp(*log_w) - w).abs() < SLACK;
        save::holds(weights.iter().zip(&log_weights).all(alike), "weights", "what their logarithms are of")?;
        save::holds((weights.iter().sum::<f64>() - 1.0).abs() < SLACK, "weights", "of sum 1")?;
        Ok(Self { log_weights, weights })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_one_over_hundreds_of_orders_of_magnitude() {
        let (weights, log_evidence) = Weights::uniform(3).reweighted(&[-1000.0, -1001.0, -3000.0]);
        assert!((weights.as_slice().iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert!(weights.as_slice()[0] > 0.7 && (-1001.0..-1000.0).contains(&log_evidence));
        assert_eq!(weights.heaviest(), 0);
    }

    #[test]
    fn equal_weights_are_worth_exactly_their_number() {
        for count in 1..200 {
            let (weights, _) = Weights::uniform(count).reweighted(&vec![-1.234; count]);
            assert_eq!(weights.ess(), count as f64);
        }
    }

    #[test]
    fn a_population_that_explains_nothing_keeps_its_weights() {
        let before = Weights::uniform(4);
        for increments in [[f64::NEG_INFINITY; 4], [f64::NAN; 4]] {
            assert_eq!(before.reweighted(&increments).0, before);
        }
    }

    #[test]
    fn particles_that_are_infinitely_likely_share_the_weight_as_they_did() {
        const INFINITY: f64 = f64::INFINITY;
        let log = |weights: [f64; 4]| weights.map(ops::ln);
        let (before, _) = Weights::uniform(4).reweighted(&log([0.1, 0.2, 0.3, 0.4]));
        let (after, log_evidence) = before.reweighted(&[INFINITY, 0.0, INFINITY, f64::NAN]);
        assert_eq!(log_evidence, INFINITY);
        // Four sums and logarithms of numbers about 1: a few of the last bits.
        for (weight, expected) in after.as_slice().iter().zip([0.25, 0.0, 0.75, 0.0]) {
            assert!((weight - expected).abs() < 1e-15, "{after:?}");
        }
        // Slots 1 and 3 have lost everything, and nothing brings it back.
        let (later, log_evidence) = after.reweighted(&[0.0, INFINITY, 0.0, INFINITY]);
        assert!(log_evidence.abs() < 1e-15 && (later.as_slice()[2] - 0.75).abs() < 1e-15, "{later:?}");
        let nobody = [f64::NEG_INFINITY, INFINITY, f64::NAN, INFINITY];
        assert_eq!(after.reweighted(&nobody), (after.clone(), f64::NEG_INFINITY));
    }

    #[test]
    fn copies_keep_what_they_were_not_drawn_by() {
        let (weights, _) = Weights::uniform(3).reweighted(&[0.5_f64, 0.2, 0.3].map(ops::ln));
        let (copies, log_mean) = weights.selected(&weights.tempered(1.0), &[0, 2, 2]);
        assert_eq!((copies, log_mean), (Weights::uniform(3), 0.0));
        // By their square roots: each copy keeps its square root, and of 0.5, 0.3 and 0.3 there are three.
        let roots = [0.5_f64, 0.2, 0.3].map(f64::sqrt);
        let sum: f64 = roots.iter().sum();
        let (copies, log_mean) = weights.selected(&weights.tempered(0.5), &[0, 2, 2]);
        let kept = [roots[0], roots[2], roots[2]];
        let total: f64 = kept.iter().sum();
        assert!((ops::exp(log_mean) - sum * total / 3.0).abs() < 1e-14, "{log_mean}");
        for (weight, kept) in copies.as_slice().iter().zip(kept) {
            assert!((weight - kept / total).abs() < 1e-15, "{copies:?}");
        }
    }

    #[test]
    fn copies_are_as_heavy_as_their_originals() {
        let (weights, _) = Weights::uniform(3).reweighted(&[0.5_f64, 0.2, 0.3].map(ops::ln));
        let copied = weights.copied(&[0, 2, 2]);
        for (weight, expected) in copied.as_slice().iter().zip([0.5 / 1.1, 0.3 / 1.1, 0.3 / 1.1]) {
            assert!((weight - expected).abs() < 1e-15, "{copied:?}");
        }
    }

    #[test]
    fn the_heaviest_is_found_among_weights_that_round_to_nothing() {
        let (weights, _) = Weights::uniform(4).reweighted(&[-2000.0, -1000.0, 0.0, -1000.0]);
        assert_eq!((weights.as_slice()[1], weights.heaviest()), (0.0, 2));
        let (light, _) = weights.reweighted(&[0.0, 0.0, f64::NEG_INFINITY, 0.0]);
        assert_eq!(light.heaviest(), 1);
    }
}
