//! When to resample, as figures of maps let a reader choose it: a word, and a threshold that is kept while another word is chosen.

use crate::recipe::{Field, Menu, Param, Recipe};
use crate::words::policy;
use fastslam::resampling::ResamplePolicy;

/// Threshold where another policy is chosen.
const THRESHOLD: f64 = 0.5;

/// A policy without its threshold.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    /// Where N_eff is below a share of M.
    Below,
    /// At every step.
    Always,
    /// Never.
    Never,
}

impl Kind {
    /// The policy of a threshold.
    fn with(self, threshold: f64) -> ResamplePolicy {
        match self {
            Kind::Below => ResamplePolicy::EssBelow(threshold),
            Kind::Always => ResamplePolicy::Always,
            Kind::Never => ResamplePolicy::Never,
        }
    }

    /// What the policy calls itself, up to its threshold.
    fn word(self) -> &'static str {
        match self {
            Kind::Below => "neff",
            Kind::Always => "always",
            Kind::Never => "never",
        }
    }
}

/// A policy's kind.
fn kind(policy: ResamplePolicy) -> Kind {
    match policy {
        ResamplePolicy::EssBelow(_) => Kind::Below,
        ResamplePolicy::Always => Kind::Always,
        ResamplePolicy::Never => Kind::Never,
    }
}

/// All of them.
fn menu() -> Menu<Kind> {
    let titles = [(Kind::Below, policy::below()), (Kind::Always, policy::always()), (Kind::Never, policy::never())];
    Menu::new(titles.map(|(kind, title)| (kind.word(), title, kind)))
}

/// Its threshold, or the usual one.
pub fn threshold(policy: ResamplePolicy) -> f64 {
    if let ResamplePolicy::EssBelow(fraction) = policy { fraction } else { THRESHOLD }
}

/// A recipe that holds a policy, and a threshold for the case that it is one that has one.
pub trait Chosen: Recipe {
    /// Both.
    fn chosen(&self) -> (ResamplePolicy, f64);

    /// Takes both.
    fn choose(&mut self, policy: ResamplePolicy, threshold: f64);
}

/// The rows of the policy and of its threshold.
pub fn rows<R: Chosen>() -> [Param<R>; 2] {
    let policy = Param::choice(
        "policy",
        policy::resample(),
        menu(),
        Field {
            get: |recipe: &R| kind(recipe.chosen().0),
            set: |recipe, kind| {
                let (_, threshold) = recipe.chosen();
                recipe.choose(kind.with(threshold), threshold);
            },
        },
        policy::resample_help(),
    );
    let threshold = Param::number(
        "threshold",
        policy::threshold(),
        policy::of_m(),
        (0.0, 1.0, 0.05),
        Field {
            get: |recipe: &R| recipe.chosen().1,
            set: |recipe, threshold| {
                let (policy, _) = recipe.chosen();
                recipe.choose(kind(policy).with(threshold), threshold);
            },
        },
        policy::threshold_help(),
    )
    .only_where(|recipe: &R| kind(recipe.chosen().0) == Kind::Below);
    [policy, threshold]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_has_the_word_by_which_its_policy_is_read() {
        for kind in [Kind::Below, Kind::Always, Kind::Never] {
            let said = kind.with(THRESHOLD).to_string();
            assert_eq!(said.split(':').next(), Some(kind.word()));
        }
    }
}
