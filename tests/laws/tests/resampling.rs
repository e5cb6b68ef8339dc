//! Laws of selection, for every scheme.

use fastslam::random::{Purpose, Stream};
use fastslam::resampling::Scheme;
use fastslam::weights::Weights;
use proptest::prelude::*;

const SCHEMES: [Scheme; 4] = [Scheme::Systematic, Scheme::Stratified, Scheme::Multinomial, Scheme::Residual];

fn weights(log_weights: &[f64]) -> Weights {
    Weights::uniform(log_weights.len()).reweighted(log_weights).0
}

fn counts(scheme: Scheme, weights: &Weights, n: usize, trial: u32) -> Vec<u32> {
    let mut counts = vec![0; weights.as_slice().len()];
    let mut stream = Stream::at(1, Purpose::Trial, trial, 0);
    scheme.ancestors(weights, n, &mut stream).iter().for_each(|slot| counts[*slot as usize] += 1);
    counts
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn ancestors_are_sorted_in_range_and_as_many_as_asked_for(
        log_weights in prop::collection::vec(-800.0..0.0_f64, 1..80), n in 0_usize..200, seed: u64,
    ) {
        let weights = weights(&log_weights);
        for scheme in SCHEMES {
            let ancestors = scheme.ancestors(&weights, n, &mut Stream::at(seed, Purpose::Resampling, 3, 0));
            prop_assert_eq!(ancestors.len(), n);
            prop_assert!(ancestors.is_sorted());
            prop_assert!(ancestors.iter().all(|slot| (*slot as usize) < log_weights.len()));
            prop_assert!(ancestors.iter().all(|slot| weights.as_slice()[*slot as usize] > 0.0), "{scheme}");
        }
    }

    #[test]
    fn systematic_offspring_are_the_expected_number_rounded_down_or_up(
        log_weights in prop::collection::vec(-6.0..0.0_f64, 1..60), n in 1_usize..120, trial: u32,
    ) {
        let weights = weights(&log_weights);
        for (count, w) in counts(Scheme::Systematic, &weights, n, trial).iter().zip(weights.as_slice()) {
            let expected = w * n as f64;
            // 1e-9: the sum of the weights is one but for rounding.
            prop_assert!((expected - 1e-9).floor() <= f64::from(*count) && f64::from(*count) <= (expected + 1e-9).ceil());
        }
    }

    #[test]
    fn residual_offspring_are_at_least_the_expected_number_rounded_down(
        log_weights in prop::collection::vec(-6.0..0.0_f64, 1..60), n in 1_usize..120, trial: u32,
    ) {
        let weights = weights(&log_weights);
        for (count, w) in counts(Scheme::Residual, &weights, n, trial).iter().zip(weights.as_slice()) {
            prop_assert!(f64::from(*count) >= (w * n as f64 - 1e-9).floor());
        }
    }
}

/// α = 0.001 two-sided for each slot and scheme, Bonferroni over 4 × 6: z = 4.1; n = 20 000 resamplings of 10.
#[test]
fn expected_offspring_is_n_times_weight() {
    let weights = weights(&[0.0, -0.3, -1.0, -2.0, -3.5, -9.0]);
    let (trials, n) = (20_000, 10);
    for scheme in SCHEMES {
        let mut sums = [0.0; 6];
        let mut squares = [0.0; 6];
        for trial in 0..trials {
            for (slot, count) in counts(scheme, &weights, n, trial).into_iter().enumerate() {
                sums[slot] += f64::from(count);
                squares[slot] += f64::from(count) * f64::from(count);
            }
        }
        for slot in 0..6 {
            let mean = sums[slot] / f64::from(trials);
            let variance = squares[slot] / f64::from(trials) - mean * mean;
            let expected = weights.as_slice()[slot] * n as f64;
            // At least a Poisson's worth of doubt, for the slot that is hardly ever drawn.
            let bound = 4.1 * (variance.max(expected / n as f64) / f64::from(trials)).sqrt();
            assert!((mean - expected).abs() < bound, "{scheme} slot {slot}: {mean} for {expected} ± {bound}");
        }
    }
}
