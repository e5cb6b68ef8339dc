//! All figures by tag. Tests and tools iterate over this list.

#[cfg(feature = "conditioning")]
use crate::conditioning::ConditioningModel;
#[cfg(feature = "lap")]
use crate::lap::LapModel;
#[cfg(feature = "log")]
use crate::log::LogModel;
use crate::model::Model;
#[cfg(feature = "proposal")]
use crate::proposal::ProposalModel;
#[cfg(feature = "resampling")]
use crate::resampling::ResamplingModel;
#[cfg(feature = "worked-example")]
use crate::worked_example::WorkedExampleModel;

/// A kind of figure.
pub struct Entry {
    /// Its custom element.
    pub tag: &'static str,
    /// Its title for readers.
    pub title: &'static str,
    /// A new one, of which nothing was asked yet.
    pub make: fn() -> Box<dyn Model>,
}

/// Every kind there is in this build.
pub const FIGURES: &[Entry] = &[
    #[cfg(feature = "lap")]
    Entry { tag: "fastslam-lap", title: LapModel::TITLE, make: || Box::new(LapModel::default()) },
    #[cfg(feature = "conditioning")]
    Entry {
        tag: "fastslam-conditioning",
        title: ConditioningModel::TITLE,
        make: || Box::new(ConditioningModel::default()),
    },
    #[cfg(feature = "proposal")]
    Entry { tag: "fastslam-proposal", title: ProposalModel::TITLE, make: || Box::new(ProposalModel::default()) },
    #[cfg(feature = "worked-example")]
    Entry {
        tag: "fastslam-worked-example",
        title: WorkedExampleModel::TITLE,
        make: || Box::new(WorkedExampleModel::default()),
    },
    #[cfg(feature = "log")]
    Entry { tag: "fastslam-log", title: LogModel::TITLE, make: || Box::new(LogModel::default()) },
    #[cfg(feature = "resampling")]
    Entry { tag: "fastslam-resampling", title: ResamplingModel::TITLE, make: || Box::new(ResamplingModel::default()) },
];

/// The figure of a tag.
pub fn find(tag: &str) -> Option<&'static Entry> {
    FIGURES.iter().find(|f| f.tag == tag)
}
