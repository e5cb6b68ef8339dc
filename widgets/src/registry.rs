//! All figures by tag. Tests and tools iterate over this list.

use crate::{
    conditioning::ConditioningModel, lap::LapModel, log::LogModel, model::Model, proposal::ProposalModel,
    resampling::ResamplingModel, worked_example::WorkedExampleModel,
};

/// A kind of figure.
pub struct Entry {
    /// Its custom element.
    pub tag: &'static str,
    /// Its title for readers.
    pub title: &'static str,
    /// A new one, of which nothing was asked yet.
    pub make: fn() -> Box<dyn Model>,
}

/// Every kind there is.
pub const FIGURES: &[Entry] = &[
    Entry { tag: "fastslam-lap", title: LapModel::TITLE, make: || Box::new(LapModel::default()) },
    Entry {
        tag: "fastslam-conditioning",
        title: ConditioningModel::TITLE,
        make: || Box::new(ConditioningModel::default()),
    },
    Entry { tag: "fastslam-proposal", title: ProposalModel::TITLE, make: || Box::new(ProposalModel::default()) },
    Entry {
        tag: "fastslam-worked-example",
        title: WorkedExampleModel::TITLE,
        make: || Box::new(WorkedExampleModel::default()),
    },
    Entry { tag: "fastslam-log", title: LogModel::TITLE, make: || Box::new(LogModel::default()) },
    Entry { tag: "fastslam-resampling", title: ResamplingModel::TITLE, make: || Box::new(ResamplingModel::default()) },
];

/// The figure of a tag.
pub fn find(tag: &str) -> Option<&'static Entry> {
    FIGURES.iter().find(|f| f.tag == tag)
}
