//! When to resample, as figures of maps let a reader choose it: a word, and a threshold that is kept while another word is chosen.

use crate::model::Choice;
use fastslam::resampling::ResamplePolicy;

/// Threshold where another policy is chosen.
const THRESHOLD: f64 = 0.5;

/// The words.
pub const POLICIES: &[Choice] = &[
    Choice { value: "neff", title: "N_eff below threshold" },
    Choice { value: "always", title: "at every step" },
    Choice { value: "never", title: "never" },
];

/// A policy's word, without its threshold.
pub fn name(policy: ResamplePolicy) -> &'static str {
    match policy {
        ResamplePolicy::Never => "never",
        ResamplePolicy::Always => "always",
        ResamplePolicy::EssBelow(_) => "neff",
    }
}

/// The policy of a word and a threshold.
pub fn of(word: &str, threshold: f64) -> ResamplePolicy {
    match word {
        "never" => ResamplePolicy::Never,
        "always" => ResamplePolicy::Always,
        _ => ResamplePolicy::EssBelow(threshold),
    }
}

/// Its threshold, or the usual one.
pub fn threshold(policy: ResamplePolicy) -> f64 {
    if let ResamplePolicy::EssBelow(fraction) = policy { fraction } else { THRESHOLD }
}
