//! What the variants of the filter's enums are called on controls. Their words in links are their own.

use crate::words::names;
use fastslam::{matching::Matcher, resampling::Scheme};
use fastslam_lab::experiment::{
    ProposalKind,
    lap::{Course, ScanWeight},
};

/// A proposal's name for readers.
pub fn proposal(kind: ProposalKind) -> &'static str {
    match kind {
        ProposalKind::Improved => names::aware(),
        ProposalKind::Motion => names::motion(),
    }
}

/// A matcher's name for readers.
pub fn matcher(matcher: Matcher) -> &'static str {
    match matcher {
        Matcher::SubCell => names::sub_cell(),
        Matcher::Cell => names::cell(),
    }
}

/// The name for readers of what is paid for a scan.
pub fn weight(weight: ScanWeight) -> &'static str {
    match weight {
        ScanWeight::Usual => names::usual_weight(),
        ScanWeight::Marginal => names::marginal(),
        ScanWeight::NewGroundFree => names::without_new_ground(),
        ScanWeight::OldMapAtDraw => names::old_map_at_draw(),
    }
}

/// A course's name for readers.
pub fn course(course: Course) -> &'static str {
    match course {
        Course::Apartment => names::apartment(),
        Course::Ring => names::ring(),
        Course::Rooms => names::rooms(),
    }
}

/// A scheme's name for readers.
pub fn scheme(scheme: Scheme) -> &'static str {
    match scheme {
        Scheme::Systematic => names::systematic(),
        Scheme::Stratified => names::stratified(),
        Scheme::Multinomial => names::multinomial(),
        Scheme::Residual => names::residual(),
    }
}
