//! Links that readers and teachers have made: each opens in every later build with the same numbers, or says what has changed since (see
//! `Declared::CHANGES` of the figures). `golden/links.txt` has a
//! link a line, and behind a tab the readouts at the step that it names, as they were when the line was written. Lines are added,
//! never changed and never removed: other courses point here.

use fastslam_widgets::{
    figure::Figure,
    model::FigureError,
    registry::{self, FIGURES},
};
use figures::{LOG, TINY_LOG};

const LINKS: &str = include_str!("../../golden/links.txt");

/// The figure that a link makes, and what it says of the link.
fn open(link: &str) -> (Figure, Vec<FigureError>) {
    let (tag, query) = link.split_once('?').expect("a link has a ?");
    let mut figure = registry::figure(tag).expect("a tag of the registry");
    // A link without a word is of the first version, as the page reads it (`linkedQuery` in elements/link.ts).
    let said = figure.load(if query.is_empty() { "v=1" } else { query });
    if tag == LOG {
        let asked = figure.values().0.iter().find(|(name, _)| *name == "step").map(|(_, step)| step.parse().unwrap());
        figure.open(TINY_LOG).expect("the tiny log is a log");
        figure.model_mut().seek(asked.unwrap_or(u32::MAX));
    }
    figure.model_mut().settle();
    (figure, said)
}

/// Names and numbers, in as many digits as tell their bits.
fn numbers(figure: &Figure) -> Vec<String> {
    let readouts = figure.model().readouts().into_iter();
    readouts
        .map(|readout| format!("{}={}", readout.name, readout.value.map_or("–".into(), |x| x.to_string())))
        .collect()
}

/// A test for each figure, so that they run side by side: of every sixth of its links.
fn keep_their_numbers(tag: &str) {
    every_one_keeps_its_numbers(tag, 6);
}

fn every_one_keeps_its_numbers(tag: &str, every: usize) {
    let mut changed = Vec::new();
    let links: Vec<_> = LINKS.lines().map(|line| line.split_once('\t').expect("a link and its numbers")).collect();
    let of_tag: Vec<_> = links.iter().filter(|(link, _)| link.split('?').next() == Some(tag)).collect();
    let count = of_tag.len();
    for (link, kept) in of_tag.into_iter().step_by(every) {
        let (figure, said) = open(link);
        let now = numbers(&figure);
        let other: Vec<&str> = kept.split('\t').filter(|number| !now.iter().any(|n| n == number)).collect();
        let refused = said.iter().any(|error| error.parameter != "v");
        if refused || (said.is_empty() && !other.is_empty()) {
            changed.push(format!("{link}: says {said:?}; no longer {other:?}"));
        }
    }
    assert!(changed.is_empty(), "{} of them:\n{}", changed.len(), changed.join("\n"));
    assert!(count > 20, "{count} links: have some been lost?");
}

#[test]
#[ignore = "breadth: all kept links"]
fn all_links_keep_their_numbers() {
    std::thread::scope(|scope| {
        for entry in FIGURES {
            scope.spawn(|| every_one_keeps_its_numbers(entry.tag, 1));
        }
    });
}

#[test]
fn links_to_the_lap_keep_their_numbers() {
    keep_their_numbers("fastslam-lap");
}

#[test]
fn links_to_the_smoother_keep_their_numbers() {
    keep_their_numbers("fastslam-smoothing");
}

#[test]
fn links_to_the_conditioning_keep_their_numbers() {
    keep_their_numbers("fastslam-conditioning");
}

#[test]
fn links_to_the_proposal_keep_their_numbers() {
    keep_their_numbers("fastslam-proposal");
}

#[test]
fn links_to_the_worked_example_keep_their_numbers() {
    keep_their_numbers("fastslam-worked-example");
}

#[test]
fn links_to_the_resampling_keep_their_numbers() {
    keep_their_numbers("fastslam-resampling");
}

#[test]
fn links_to_the_doors_keep_their_numbers() {
    keep_their_numbers("fastslam-doors");
}

#[test]
fn links_to_the_log_keep_their_numbers() {
    keep_their_numbers(LOG);
}

#[test]
fn links_to_the_universes_keep_their_numbers() {
    keep_their_numbers("fastslam-universes");
}

#[test]
fn links_to_the_sampled_map_keep_their_numbers() {
    keep_their_numbers("fastslam-joint");
}

#[test]
fn links_to_the_pose_graph_keep_their_numbers() {
    keep_their_numbers("fastslam-graph");
}

#[test]
fn links_to_em_mapping_keep_their_numbers() {
    keep_their_numbers("fastslam-em");
}
