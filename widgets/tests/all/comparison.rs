//! Laws of the setting before, which is compared with that of now: what a reader changes is told at the same step, and nothing else is.

use crate::common::{figure, scene};
use fastslam_widgets::{
    figure::Figure,
    model::{Group, Kind},
    registry::FIGURES,
    scene::{GHOST, Mark},
};

/// Whether anything is drawn of the setting before.
fn haunted(figure: &Figure) -> bool {
    let drawn = |mark: &Mark| match mark {
        Mark::Lines { role, lines, .. } => *role == GHOST && lines.iter().any(|line| line.len() > 1),
        Mark::Discs { role, centres, .. } => *role == GHOST && !centres.is_empty(),
        _ => false,
    };
    scene(figure, 800.0).marks.iter().any(drawn)
}

fn set(figure: &mut Figure, name: &str, value: &str) {
    figure.set_by_hand(name, value).unwrap();
    figure.model_mut().settle();
}

#[test]
fn the_setting_that_a_control_leaves_is_compared_at_the_same_step_and_at_no_other() {
    let mut lap = figure("fastslam-lap", "v=13&universes=4&step=12");
    assert_eq!((lap.difference().as_str(), haunted(&lap)), ("", false));
    let number = |figure: &Figure, name| figure.readouts().into_iter().find(|r| r.name == name).unwrap().text;
    let before = number(&lap, "rms_best");
    for odometry in ["1.2", "1.7", "1.85"] {
        lap.set_by_hand("odometry", odometry).unwrap();
    }
    lap.model_mut().settle();
    let told = lap.difference();
    assert!(told.starts_with("Step 12: Odometry noise σ 1.5 → 1.85 ×. "), "not with a setting on the way: {told}");
    assert!(told.contains(&format!(" {before} → {} m, ", number(&lap, "rms_best"))), "{told}");
    assert!(haunted(&lap));

    lap.model_mut().seek(13);
    lap.model_mut().settle();
    assert_eq!((lap.difference().as_str(), haunted(&lap)), ("", true), "two steps are not compared, but curves are");
    lap.compare(false);
    assert_eq!((lap.difference().as_str(), haunted(&lap)), ("", false));
    lap.compare(true);
    assert!(haunted(&lap));

    set(&mut lap, "universes", "2");
    assert!(lap.difference().starts_with("Step 13: Universes M 4 → 2. "), "the last one: {}", lap.difference());
    set(&mut lap, "truth", "on");
    assert!(lap.difference().starts_with("Step 13: Universes M 4 → 2. "), "what is only shown changes nothing");
    set(&mut lap, "universes", "4");
    assert_eq!((lap.difference().as_str(), haunted(&lap)), ("", false), "the same again");
    lap.load("v=13&universes=3");
    assert_eq!((lap.difference().as_str(), haunted(&lap)), ("", false), "a link is a page of its own");
    lap.set("universes", "5").unwrap();
    assert_eq!(lap.difference(), "", "the page’s author changes a figure, and not a reader");
}

#[test]
fn whatever_a_reader_sets_is_told_in_every_figure_with_the_numbers_that_matter() {
    for entry in FIGURES.iter().filter(|entry| entry.tag != "fastslam-log") {
        let mut figure = figure(entry.tag, "");
        let names = figure.model().compared();
        assert!((2..=4).contains(&names.len()), "{}", entry.tag);
        let readouts = figure.readouts();
        for name in names {
            let known = readouts.iter().any(|readout| readout.name == name) || name == "selective_right";
            assert!(known, "{}: {name}", entry.tag);
        }
        let specs = figure.model().params();
        // Of a chart of what was run before, nothing can be set but how it is read.
        let slider = specs.iter().find(|s| s.group == Group::Setup && s.kind == Kind::Number);
        let Some(slider) = slider else {
            assert_eq!(entry.tag, "fastslam-universes");
            continue;
        };
        let value = figure.model().value(slider.name).unwrap();
        let other = if value.parse() == Ok(slider.max) { slider.min } else { slider.max };
        set(&mut figure, slider.name, &other.to_string());
        let (told, change) = (figure.difference(), format!("{} {value} → {other}", slider.title));
        assert!(told.contains(&change) && told.matches('→').count() >= 2, "{}: {told}", entry.tag);
        assert!(figure.model().curves().is_empty() || haunted(&figure), "{}", entry.tag);
    }
}

#[test]
fn what_a_number_changes_stands_over_the_picture_and_another_choice_is_explained() {
    let mut figure = figure("fastslam-proposal", "");
    assert_eq!(figure.told(), figure.model().narrate());
    set(&mut figure, "range-std", "0.1");
    assert_eq!(figure.told(), figure.difference());
    set(&mut figure, "landmarks", "pair");
    assert!(figure.difference().starts_with("Landmarks one"), "{}", figure.difference());
    assert_eq!(figure.told(), figure.model().narrate());
}

#[test]
fn nothing_is_told_of_what_a_reader_is_asked_to_predict() {
    let mut figure = figure("fastslam-proposal", "");
    set(&mut figure, "range-std", "0.1");
    assert_ne!(figure.difference(), "");
    for (name, value) in [("predict", "on"), ("range-std", "0.2"), ("run", "on")] {
        set(&mut figure, name, value);
        assert_eq!((figure.difference(), figure.told()), (String::new(), figure.model().narrate()), "{name}");
    }
}

#[test]
fn a_handle_is_a_control_and_what_a_pointer_only_looks_at_is_none() {
    let mut figure = figure("fastslam-proposal", "");
    let width = 800.0;
    figure.paint(800, figure.height(width) as u32, 1.0, Default::default());
    figure.nudge("landmark", 3.0, 0.0);
    figure.model_mut().settle();
    assert!(figure.difference().contains('→'), "{}", figure.difference());
}
