//! All figures by tag. Tests and tools iterate over this list.

#[cfg(feature = "conditioning")]
use crate::conditioning::{ConditioningModel, ConditioningView};
#[cfg(feature = "lap")]
use crate::lap::{LapModel, LapView};
#[cfg(feature = "log")]
use crate::log::{LogModel, LogView};
#[cfg(feature = "proposal")]
use crate::proposal::{ProposalModel, ProposalView};
#[cfg(feature = "resampling")]
use crate::resampling::{ResamplingModel, ResamplingView};
use crate::view::{Shown, Shows};
#[cfg(feature = "worked-example")]
use crate::worked_example::{WorkedExampleModel, WorkedExampleView};

/// A kind of figure.
pub struct Entry {
    /// Its custom element.
    pub tag: &'static str,
    /// Its title for readers.
    pub title: &'static str,
    /// A new one, of which nothing was asked yet.
    pub(crate) make: fn() -> Box<dyn Shown>,
}

/// Every kind there is in this build.
pub const FIGURES: &[Entry] = &[
    #[cfg(feature = "lap")]
    Entry { tag: "fastslam-lap", title: LapModel::TITLE, make: || Box::new(Shows::<LapView>::default()) },
    #[cfg(feature = "conditioning")]
    Entry {
        tag: "fastslam-conditioning",
        title: ConditioningModel::TITLE,
        make: || Box::new(Shows::<ConditioningView>::default()),
    },
    #[cfg(feature = "proposal")]
    Entry {
        tag: "fastslam-proposal",
        title: ProposalModel::TITLE,
        make: || Box::new(Shows::<ProposalView>::default()),
    },
    #[cfg(feature = "worked-example")]
    Entry {
        tag: "fastslam-worked-example",
        title: WorkedExampleModel::TITLE,
        make: || Box::new(Shows::<WorkedExampleView>::default()),
    },
    #[cfg(feature = "log")]
    Entry { tag: "fastslam-log", title: LogModel::TITLE, make: || Box::new(Shows::<LogView>::default()) },
    #[cfg(feature = "resampling")]
    Entry {
        tag: "fastslam-resampling",
        title: ResamplingModel::TITLE,
        make: || Box::new(Shows::<ResamplingView>::default()),
    },
];

/// The figure of a tag.
pub fn find(tag: &str) -> Option<&'static Entry> {
    FIGURES.iter().find(|f| f.tag == tag)
}
