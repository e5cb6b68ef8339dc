//! Laws of what figures tell of their algorithms: the lines that ran are lines of the chapter's boxes, and no others are told.

use crate::common::figure;
use fastslam_widgets::{figure::Figure, model::TraceLine};

const CHAPTER: &str = include_str!("../../../www/chapter/04-algorithms.md");

fn trace(figure: &Figure) -> Vec<TraceLine> {
    figure.model().trace()
}

fn keys(lines: &[TraceLine]) -> Vec<&'static str> {
    lines.iter().map(|line| line.key).collect()
}

fn text<'a>(lines: &'a [TraceLine], key: &str) -> &'a str {
    &lines.iter().find(|line| line.key == key).unwrap_or_else(|| panic!("{key} was not run: {lines:?}")).text
}

/// Keys of the lines of the box that names this figure.
fn boxed(id: &str) -> Vec<&'static str> {
    let (_, rest) = CHAPTER.split_once(&format!("figure=\"{id}\"")).unwrap();
    let (body, _) = rest.split_once("\n::::\n").unwrap();
    body.split(":line[").skip(1).map(|line| line.split_once(']').unwrap().0).collect()
}

#[test]
fn what_ran_are_lines_of_the_chapters_boxes_in_their_order() {
    for (tag, id, query) in [
        ("fastslam-lap", "fig-lap", ""),
        ("fastslam-lap", "fig-lap", "proposal=motion"),
        ("fastslam-worked-example", "fig-worked-example", "threshold=1"),
        ("fastslam-resampling", "fig-resampling", "wings=on"),
    ] {
        let (mut figure, lines) = (figure(tag, query), boxed(id));
        for step in 1..=figure.model().step_count().clamp(1, 70) {
            figure.model_mut().seek(step);
            figure.model_mut().settle();
            let mut rest = lines.iter();
            let ran = keys(&trace(&figure));
            assert!(!ran.is_empty(), "{tag}?{query}, step {step}");
            assert!(
                ran.iter().all(|key| rest.any(|line| line == key)),
                "{tag}?{query}, step {step}: {ran:?} of {lines:?}"
            );
        }
    }
}

#[test]
fn nothing_has_run_before_the_first_step() {
    for tag in ["fastslam-lap", "fastslam-resampling"] {
        assert_eq!(trace(&figure(tag, "")), []);
    }
    assert_eq!(trace(&figure("fastslam-resampling", "step=9")), [], "the lap's filter is told by the lap's own figure");
}

#[test]
fn either_the_match_is_trusted_or_the_motion_model_asked() {
    let [mut trusted, mut doubted] = [0, 0];
    // Where the wheels are sure there is least to find, and the guard has most to doubt.
    for matcher in ["subcell", "cell"] {
        let mut figure = figure("fastslam-lap", &format!("universes=4&universe=0&odometry=0&matcher={matcher}"));
        for step in 1..=figure.model().step_count() {
            figure.model_mut().seek(step);
            figure.model_mut().settle();
            let lines = trace(&figure);
            let ran = keys(&lines);
            let drew = ran.contains(&"draw");
            assert_eq!(drew, text(&lines, "doubt").starts_with("trusted"));
            assert_eq!(drew, !ran.contains(&"fallback"));
            assert!(ran.contains(&"pay"), "both branches pay");
            if drew { trusted += 1 } else { doubted += 1 }
        }
    }
    assert!(trusted > 0 && doubted > 0, "both were seen: {trusted} and {doubted}");
}

#[test]
fn a_universe_is_followed_back_to_where_it_was_copied_from() {
    // Copies of one universe have one past, so that the same was run for them.
    let figure = figure("fastslam-lap", "step=1&policy=always&scheme=multinomial");
    let lines = |slot: usize| {
        trace(&crate::common::figure(
            "fastslam-lap",
            &format!("step=1&policy=always&scheme=multinomial&universe={slot}"),
        ))
    };
    let poses: Vec<String> = (0..16).map(|slot| text(&lines(slot), "draw").to_string()).collect();
    let distinct = |of: &[String]| {
        let mut of = of.to_vec();
        of.sort();
        of.dedup();
        of.len()
    };
    let paid: Vec<String> = (0..16).map(|slot| format!("{} {}", poses[slot], text(&lines(slot), "pay"))).collect();
    assert!(distinct(&poses) < 16, "some were copied");
    assert_eq!(distinct(&paid), distinct(&poses));
    assert!(text(&trace(&figure), "resample").starts_with("yes: "));
}

#[test]
fn the_example_tells_what_its_sheet_says() {
    let lines = trace(&figure("fastslam-worked-example", ""));
    assert_eq!(text(&lines, "weigh"), "2.753 / 0.8632");
    assert_eq!([text(&lines, "ess"), text(&lines, "resample")], ["1.6 of 2", "no"]);
}
