//! When to resample, as figures of maps let a reader choose it: a word, and a threshold that is kept while another word is chosen.

use crate::recipe::Menu;
use fastslam::resampling::ResamplePolicy;

/// Threshold where another policy is chosen.
const THRESHOLD: f64 = 0.5;

/// A policy without its threshold.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Where N_eff is below a share of M.
    Below,
    /// At every step.
    Always,
    /// Never.
    Never,
}

impl Kind {
    /// The policy of a threshold.
    pub fn with(self, threshold: f64) -> ResamplePolicy {
        match self {
            Kind::Below => ResamplePolicy::EssBelow(threshold),
            Kind::Always => ResamplePolicy::Always,
            Kind::Never => ResamplePolicy::Never,
        }
    }

    /// What the policy calls itself, up to its threshold.
    fn word(self) -> String {
        self.with(THRESHOLD).to_string().split(':').take(1).collect()
    }
}

/// A policy's kind.
pub fn kind(policy: ResamplePolicy) -> Kind {
    match policy {
        ResamplePolicy::EssBelow(_) => Kind::Below,
        ResamplePolicy::Always => Kind::Always,
        ResamplePolicy::Never => Kind::Never,
    }
}

/// All of them.
pub fn menu() -> Menu<Kind> {
    let titles = [(Kind::Below, "N_eff below threshold"), (Kind::Always, "at every step"), (Kind::Never, "never")];
    Menu::new(titles.map(|(kind, title)| (kind.word(), title, kind)))
}

/// Its threshold, or the usual one.
pub fn threshold(policy: ResamplePolicy) -> f64 {
    if let ResamplePolicy::EssBelow(fraction) = policy { fraction } else { THRESHOLD }
}
