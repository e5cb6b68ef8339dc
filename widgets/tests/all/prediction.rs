//! Laws of predictions, by the figures' public face: nothing leaks before a guess, and nothing outlives its question.

use crate::common::{figure, scene, state};
use fastslam_widgets::{decimal::fixed, figure::Figure, paint::Theme, registry};

/// In the state that a link of today names.
fn proposal(query: &str) -> Figure {
    figure("fastslam-proposal", &format!("v=3&{}", query.trim_start_matches('&')))
}

fn resampling(query: &str) -> Figure {
    figure("fastslam-resampling", query)
}

fn rows(figure: &Figure) -> String {
    format!("{:?}", figure.model().series().rows)
}

fn value(figure: &Figure, name: &str) -> f64 {
    figure.model().readouts().into_iter().find(|r| r.name == name).unwrap().value.unwrap()
}

#[test]
fn before_a_guess_is_judged_nothing_tells_the_result() {
    for query in ["", "range-std=0.1&seed=7", "landmarks=pair&odometry=2", "samples=1"] {
        let all = |query: &str| {
            let mut figure = proposal(query);
            let (told, readouts) = (figure.model().describe(), figure.model().readouts());
            figure.paint(800, 500, 1.0, Theme::Light);
            let pixels = figure.canvas().pixels().to_vec();
            (told, readouts, figure.model().series(), figure.model().trace(), scene(&figure, 800.0), pixels)
        };
        let usual = all(query);
        for asked in ["predict=on", "predict=on&guess=3"] {
            let (_, readouts, series, trace, ..) = all(&format!("{query}&{asked}"));
            assert_eq!(
                (readouts, series, trace),
                (usual.1.clone(), usual.2.clone(), usual.3.clone()),
                "{query} {asked}"
            );
        }
        // Once it is, all of them tell another thing than before.
        let judged = all(&format!("{query}&predict=on&guess=3&run=on"));
        assert!(judged.1 != usual.1 && judged.2 != usual.2 && judged.5 != usual.5, "{query}");
        let result = proposal(&format!("{query}&predict=on&run=on")).model().prediction().unwrap().result.unwrap();
        for asked in ["predict=on", "predict=on&guess=3"] {
            let told = proposal(&format!("{query}&{asked}"));
            assert_eq!(told.model().prediction().unwrap().result, None);
            let number = fixed(result, 1);
            let at_setting = fixed(told.model().readouts()[4].value.unwrap(), 1);
            assert!(number == at_setting || !all(&format!("{query}&{asked}")).0.contains(&number), "{query} {asked}");
        }
    }
}

#[test]
fn a_change_of_what_is_asked_about_takes_guess_and_result_away() {
    for (name, value) in
        [("range-std", "0.08"), ("seed", "4"), ("samples", "77"), ("landmarks", "pair"), ("odometry", "2")]
    {
        let mut figure = proposal("predict=on&guess=3&run=on");
        figure.set(name, value).unwrap();
        figure.model_mut().settle();
        assert_eq!(state(&figure), state(&proposal(&format!("{name}={value}&predict=on"))), "{name}");
    }
    for handle in ["landmark", "range-std", "bearing-std"] {
        let mut figure = proposal("predict=on&guess=3&run=on");
        figure.nudge(handle, 1.0, 1.0);
        figure.model_mut().settle();
        let value = |name| figure.model().value(name).unwrap();
        assert_eq!(["predict", "guess", "run"].map(value), ["on", "none", "off"], "{handle}");
    }
    // The same value again changes nothing.
    let mut figure = proposal("predict=on&guess=3&run=on");
    figure.set("range-std", "0.05").unwrap();
    assert_eq!(figure.query(), "v=3&predict=on&guess=3&run=on");
}

#[test]
fn guess_and_result_are_written_with_the_data() {
    let columns = |query| proposal(query).export().header().into_iter().skip(13).collect::<Vec<_>>();
    assert_eq!(columns("samples=5"), [""; 0]);
    assert_eq!(columns("samples=5&predict=on"), ["guess", "waived", "result"]);
    let row = |query| proposal(query).export().rows()[4][13..].to_vec();
    assert_eq!(row("samples=5&predict=on"), [None, Some(0.0), None]);
    assert_eq!(row("samples=5&predict=on&guess=3"), [Some(3.0), Some(0.0), None]);
    let [guess, waived, result] = row("samples=5&predict=on&guess=3&run=on")[..] else { panic!() };
    assert!(guess == Some(3.0) && waived == Some(0.0) && result.is_some());
    assert_eq!(row("samples=5&predict=on&run=on")[1], Some(1.0));
}

#[test]
fn a_link_of_before_has_the_guess_that_was_there_before_readers_placed_one() {
    for (before, now) in [
        ("predict=on&seed=4", "predict=on&seed=4&guess=2"),
        ("predict=on&guess=5.5", "predict=on&guess=5.5"),
        ("seed=4", "seed=4"),
        ("run=on&seed=4", "predict=on&guess=2&run=on&seed=4"),
    ] {
        let mut figure = registry::figure("fastslam-proposal").unwrap();
        let said = figure.load(before);
        figure.model_mut().settle();
        assert_eq!(state(&figure), state(&proposal(now)), "{before}");
        // Its samples have moved, which is told.
        assert_eq!(said.len(), usize::from(before.contains("run=on")), "{before}: {said:?}");
    }
}

#[test]
fn before_a_prediction_is_judged_nothing_of_the_run_is_shown_or_told() {
    for query in ["", "wings=on&seed=5", "particles=4&policy=always&odometry=2"] {
        // As if nobody had ever run it, even where it ran before.
        let mut asked = resampling(&format!("step=60&{query}"));
        asked.set("predict", "on").unwrap();
        asked.model_mut().settle();
        let start = resampling(query);
        assert_eq!((asked.model().step(), asked.model().step_count(), asked.model().pending()), (0, 0, 0), "{query}");
        // As text: what there is none of is not a number.
        assert_eq!(rows(&asked), rows(&start), "{query}");
        assert_eq!(asked.model().trace(), start.model().trace(), "{query}");
        assert_eq!(asked.model().readouts()[..15], start.model().readouts()[..], "{query}");
        assert!(asked.model().describe().ends_with(&start.model().describe()), "{query}");
        let never_ran = resampling(&format!("{query}&predict=on"));
        assert_eq!(state(&asked), state(&never_ran), "{query}");
        // Nor does anything that a reader can do besides.
        for (name, value) in [("step", "50"), ("cursor", "20")] {
            assert!(asked.set(name, value).is_err(), "{query} {name}");
        }
        asked.model_mut().seek(50);
        asked.drag("cursor", 400.0, 200.0, 800.0);
        asked.set("guess", "30").unwrap();
        asked.model_mut().settle();
        assert_eq!(rows(&asked), rows(&start), "{query}");
        assert_eq!(asked.model().prediction().unwrap().result, None, "{query}");
    }
}

#[test]
fn a_guess_is_placed_on_the_axis_of_time_and_stands_beside_the_step_at_which_one_ancestor_is_left() {
    let mut figure = resampling("policy=always&predict=on");
    let [x, y] = scene(&figure, 800.0).handles.iter().find(|handle| handle.name == "guess").unwrap().at;
    figure.drag("guess", x - 100.0, y, 800.0);
    let guess: f64 = figure.model().value("guess").unwrap().parse().unwrap();
    figure.nudge("guess", 0.1, 0.0);
    assert_eq!(figure.model().value("guess").unwrap(), (guess + 1.0).to_string());
    figure.set("run", "on").unwrap();
    figure.model_mut().settle();
    assert_eq!(figure.model().step(), figure.model().step_count(), "the whole run is shown");
    let result = figure.model().prediction().unwrap().result.unwrap();
    let column = figure.export().header().iter().position(|name| *name == "always_lineage").unwrap();
    let lineage: Vec<f64> = figure.model().series().rows.iter().map(|row| row[column]).collect();
    assert_eq!(lineage.iter().position(|n| *n == 1.0), Some(result as usize));
    assert_eq!(value(&figure, "one_left"), result);
    assert!(figure.model().describe().starts_with(&format!("One ancestor is left from step {result} on")));
    // Looking back takes nothing away; another run, or another policy, asks anew.
    figure.set("step", "5").unwrap();
    figure.model_mut().settle();
    assert_eq!(figure.model().prediction().unwrap().result, Some(result));
    let link = figure.query();
    assert_eq!(resampling(&link).model().prediction(), figure.model().prediction());
    for (name, value) in [("policy", "never"), ("seed", "9"), ("wings", "on"), ("threshold", "0.2")] {
        let mut figure = resampling(&link);
        figure.set(name, value).unwrap();
        figure.model_mut().settle();
        let value = |name| figure.model().value(name).unwrap();
        assert_eq!(["predict", "guess", "run"].map(value), ["on", "none", "off"], "{name}");
    }
}

#[test]
fn one_ancestor_that_never_comes_is_told_too() {
    let figure = resampling("policy=never&predict=on&guess=40&run=on");
    assert_eq!(figure.model().prediction().unwrap().result, None);
    assert!(figure.model().describe().starts_with("More than one ancestor is left at the end; the guess was step 40."));
}
