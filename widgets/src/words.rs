//! What the variants of the filter's enums are called on controls. Their words in links are their own.

use fastslam::{matching::Matcher, resampling::Scheme};
use fastslam_lab::experiment::ProposalKind;

/// A proposal's name for readers.
pub fn proposal(kind: ProposalKind) -> &'static str {
    match kind {
        ProposalKind::Improved => "measurement-aware",
        ProposalKind::Motion => "motion model only (FastSLAM 1.0)",
    }
}

/// A matcher's name for readers.
pub fn matcher(matcher: Matcher) -> &'static str {
    match matcher {
        Matcher::SubCell => "sub-cell (a Gaussian per cell)",
        Matcher::Cell => "cell (occupancy)",
    }
}

/// A scheme's name for readers.
pub fn scheme(scheme: Scheme) -> &'static str {
    match scheme {
        Scheme::Systematic => "systematic",
        Scheme::Stratified => "stratified",
        Scheme::Multinomial => "multinomial",
        Scheme::Residual => "residual",
    }
}
