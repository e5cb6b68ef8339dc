//! All figures: a row each. Tests, tools, the page and its generated files iterate over this list.

#[cfg(feature = "log")]
use crate::log::LogView;
#[cfg(feature = "page")]
use crate::{
    conditioning::ConditioningView,
    doors::{DOORS, DoorsView},
    em::EmView,
    graph::{GRAPHS, GraphView},
    joint::JointView,
    lap::{LAPS, LapView},
    proposal::ProposalView,
    resampling::{ResamplingView, WINGS},
    smoothing::SmoothingView,
    universes::UniversesView,
    worked_example::WorkedExampleView,
};
use crate::{
    job::Job,
    model::Declared,
    panels::Panels,
    view::{Shown, Shows, View},
};

/// The program that has a figure, and the feature of this crate that makes it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Program {
    /// `page`: of all figures that run on the page itself.
    Page,
    /// `log`: maps recorded logs, in a worker, and only where a reader asks for it.
    Log,
}

/// A kind of figure.
pub struct Entry {
    /// Its custom element.
    pub tag: &'static str,
    /// Its title for readers.
    pub title: &'static str,
    /// What it is compiled with.
    pub program: Program,
    /// An experiment over many seeds that goes with it, if there is one.
    pub count: Option<&'static Job>,
    /// Parts of its picture that can be shown by themselves.
    pub panels: &'static [&'static str],
    /// Height \[css px\] that its whole picture wants at a width \[css px\].
    pub height: fn(f64) -> f64,
    /// A new one, of which nothing was asked yet.
    pub(crate) make: fn() -> Box<dyn Shown>,
}

impl Entry {
    /// The row of a figure: its title, its height and all else follow from what it is.
    const fn of<V: View>(tag: &'static str, program: Program, count: Option<&'static Job>) -> Self {
        let make = || Box::new(Shows::<V>::default()) as Box<dyn Shown>;
        let height = |width| V::height(width, &Panels::default());
        Self { tag, title: <V::Model as Declared>::TITLE, program, count, panels: V::PANELS, height, make }
    }
}

/// Every kind there is in this build.
pub const FIGURES: &[Entry] = &[
    #[cfg(feature = "page")]
    Entry::of::<LapView>("fastslam-lap", Program::Page, Some(&LAPS)),
    #[cfg(feature = "page")]
    Entry::of::<ConditioningView>("fastslam-conditioning", Program::Page, None),
    #[cfg(feature = "page")]
    Entry::of::<ProposalView>("fastslam-proposal", Program::Page, None),
    #[cfg(feature = "page")]
    Entry::of::<WorkedExampleView>("fastslam-worked-example", Program::Page, None),
    #[cfg(feature = "log")]
    Entry::of::<LogView>("fastslam-log", Program::Log, None),
    #[cfg(feature = "page")]
    Entry::of::<ResamplingView>("fastslam-resampling", Program::Page, Some(&WINGS)),
    #[cfg(feature = "page")]
    Entry::of::<JointView>("fastslam-joint", Program::Page, None),
    #[cfg(feature = "page")]
    Entry::of::<UniversesView>("fastslam-universes", Program::Page, None),
    #[cfg(feature = "page")]
    Entry::of::<DoorsView>("fastslam-doors", Program::Page, Some(&DOORS)),
    #[cfg(feature = "page")]
    Entry::of::<EmView>("fastslam-em", Program::Page, None),
    #[cfg(feature = "page")]
    Entry::of::<SmoothingView>("fastslam-smoothing", Program::Page, None),
    #[cfg(feature = "page")]
    Entry::of::<GraphView>("fastslam-graph", Program::Page, Some(&GRAPHS)),
];

/// The figure of a tag.
pub fn find(tag: &str) -> Option<&'static Entry> {
    FIGURES.iter().find(|f| f.tag == tag)
}
