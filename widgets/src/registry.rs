//! All figures: a row each. Tests, tools, the page and its generated files iterate over this list.

use crate::{
    figure::Figure,
    job::{Job, Rows},
    model::{Declared, FigureError},
    numerals::Names,
    panels::Panels,
    query,
    view::{Layout, View},
};
use core::ops::Range;

/// Where a page finds a figure. Each has a program of its own, made by the feature of its name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Program {
    /// Also in that of all figures that run on the page itself: feature `page`.
    Page,
    /// In its own alone, which runs in a worker, and only where a reader asks for it.
    Own,
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
    pub(crate) make: fn(&'static str) -> Figure,
}

impl Entry {
    /// The row of a figure: its title, its height and all else follow from what it is.
    #[allow(dead_code)] // the program of files has no figure
    const fn of<V: View>(tag: &'static str, program: Program, count: Option<&'static Job>) -> Self {
        let height = |width| V::height(width, &Panels::default());
        let (title, panels, make) = (<V::Model as Declared>::TITLE, V::Layout::PANELS, Figure::of::<V>);
        Self { tag, title, program, count, panels, height, make }
    }
}

/// A row for each figure: its name, which is that of its feature and of its element, and what it is.
macro_rules! figures {
    ($($name:literal: $figure:ident::$view:ident, $program:ident, $count:expr;)*) => {
        /// Every kind there is in this build.
        pub const FIGURES: &[Entry] = &[$(
            #[cfg(feature = $name)]
            Entry::of::<crate::$figure::$view>(concat!("fastslam-", $name), Program::$program, $count),
        )*];
    };
}

figures! {
    "lap": lap::LapView, Page, Some(&crate::lap::LAPS);
    "conditioning": conditioning::ConditioningView, Page, None;
    "proposal": proposal::ProposalView, Page, None;
    "worked-example": worked_example::WorkedExampleView, Page, None;
    "log": log::LogView, Own, None;
    "resampling": resampling::ResamplingView, Page, Some(&crate::resampling::WINGS);
    "joint": joint::JointView, Page, None;
    "universes": universes::UniversesView, Page, None;
    "doors": doors::DoorsView, Page, Some(&crate::doors::DOORS);
    "em": em::EmView, Page, None;
    "smoothing": smoothing::SmoothingView, Page, None;
    "graph": graph::GraphView, Page, Some(&crate::graph::GRAPHS);
}

/// The small figures of the chapter, all of one kind. They are no elements of their own for other pages, and so not among [`FIGURES`].
pub const VIGNETTES: &[Entry] = &[
    #[cfg(feature = "vignettes")]
    Entry::of::<crate::vignette::Vignette>("fastslam-vignette", Program::Page, None),
];

/// The figure of a tag.
pub fn find(tag: &str) -> Option<&'static Entry> {
    FIGURES.iter().chain(VIGNETTES).find(|f| f.tag == tag)
}

/// What FastSLAM's versions are called; `2.0` there is a name and no number.
pub const VERSIONS: Names = Names { names: &["1.0", "2.0"], after: &["FastSLAM ", "of ", "but ", "von "] };

/// A figure, of which nothing was asked yet.
///
/// # Errors
/// For a tag that there is not.
pub fn figure(tag: &str) -> Result<Figure, FigureError> {
    let entry = find(tag).ok_or_else(|| {
        let tags: Vec<&str> = FIGURES.iter().map(|f| f.tag).collect();
        FigureError::not_among("tag", tag, &tags)
    })?;
    Ok((entry.make)(entry.tag).with_names(&VERSIONS))
}

/// A row for each of these seeds of the experiment of this name.
///
/// # Errors
/// For an unknown name, or a setting that is refused.
pub fn count(name: &str, setting: &str, seeds: Range<u64>) -> Result<Rows, FigureError> {
    let jobs = || FIGURES.iter().filter_map(|figure| figure.count);
    let job = jobs().find(|job| job.name == name).ok_or_else(|| {
        let names: Vec<&str> = jobs().map(|job| job.name).collect();
        FigureError::not_among("job", name, &names)
    })?;
    (job.run)(&query::pairs(setting), seeds)
}
