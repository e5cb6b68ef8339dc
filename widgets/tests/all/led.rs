//! A reader is led: a figure has one or two knobs in first sight, and a line over its picture that says what happens now.

use crate::common::figure;
use crate::words::lines;
use fastslam_widgets::{
    figure::Figure,
    registry::{self, FIGURES},
};

/// Controls of first sight that no figure has more of; the knobs on a picture, what plays it, its chips and its menu come to them.
const KNOBS: usize = 6;

/// As long as fits two lines over a picture beside its controls, at the size of a page.
const LINE: usize = 130;

/// A log says all that was left out of it, however much that is.
const LOG: &str = "fastslam-log";

/// A figure in the states that its chips and its opening lead to.
fn states(tag: &'static str) -> impl Iterator<Item = (String, Figure)> {
    let chips = registry::figure(tag).unwrap().chips();
    let queries: Vec<String> = chips.into_iter().map(|chip| chip.query).chain([String::new()]).collect();
    queries.into_iter().map(move |query| (format!("{tag}?{query}"), figure(tag, &query)))
}

#[test]
fn first_sight_has_a_few_controls_and_nothing_that_does_nothing() {
    for tag in FIGURES.iter().map(|entry| entry.tag) {
        let figure = registry::figure(tag).unwrap();
        let specs = figure.params();
        let knobs: Vec<&str> = specs.iter().filter(|spec| spec.sight && spec.applies).map(|spec| spec.name).collect();
        assert!((1..=KNOBS).contains(&knobs.len()), "{tag}: {knobs:?}");
        assert!(specs.iter().all(|spec| !(spec.sight && spec.folded)), "{tag}: in sight, and folded away");
    }
}

#[test]
fn what_depends_on_another_choice_is_offered_with_it() {
    let offered = |tag: &str, query: &str, name: &str| {
        let specs = figure(tag, query).params();
        specs.iter().find(|spec| spec.name == name).unwrap().applies
    };
    for (tag, name, with, without) in [
        ("fastslam-lap", "threshold", "", "policy=never"),
        ("fastslam-log", "threshold", "", "policy=always"),
        ("fastslam-proposal", "guess", "predict=on", ""),
        ("fastslam-proposal", "run", "predict=on", ""),
        ("fastslam-universes", "guess-floor", "predict=on", ""),
    ] {
        assert!(offered(tag, with, name), "{tag}?{with}: {name} is wanted");
        assert!(!offered(tag, without, name), "{tag}?{without}: {name} does nothing");
    }
}

#[test]
fn in_every_state_one_line_says_what_happens_now() {
    for tag in FIGURES.iter().map(|entry| entry.tag).filter(|tag| *tag != LOG) {
        for (state, mut figure) in states(tag) {
            let last = figure.model().step_count();
            for step in [0, last / 3, 2 * last / 3, last] {
                figure.model_mut().seek(step);
                figure.model_mut().settle();
                for catalogue in [String::new(), lines("de")] {
                    figure.set_words(&catalogue);
                    let told = figure.told();
                    let length = told.chars().count();
                    assert!((20..=LINE).contains(&length), "{state} step {step}: {length} letters: {told}");
                }
            }
        }
    }
}
