//! Laws of the figure of the smoother, by its public face.

use crate::common::{assert_drawn_inside, assert_texts_fit, figure, scene, state};
use fastslam_widgets::figure::Figure;

const TAG: &str = "fastslam-smoothing";

fn readout(figure: &Figure, name: &str) -> f64 {
    let readouts = figure.model().readouts();
    readouts.iter().find(|readout| readout.name == name).and_then(|readout| readout.value).unwrap_or(f64::NAN)
}

/// The claim of the caption, at the state that the figure opens in.
#[test]
fn as_it_opens_the_record_has_one_pose_where_the_sweeps_have_many() {
    let figure = figure(TAG, "");
    assert!(readout(&figure, "coalescence") > 30.0);
    assert_eq!((readout(&figure, "distinct_before"), readout(&figure, "first_before")), (1.0, 1.0));
    assert!(readout(&figure, "distinct_after") > 8.0 && readout(&figure, "first_after") > 8.0);
    assert!(readout(&figure, "early_after") < 0.75 * readout(&figure, "early_before"));
    // Half of 62 steps, and the half that the first step does not ask for.
    assert_eq!(readout(&figure, "cost"), 31.5);
    assert!(readout(&figure, "spread") > 0.05);
}

#[test]
fn fewer_sweeps_are_shown_without_running_anything_again_and_are_those_of_fewer() {
    let mut shown = figure(TAG, "particles=5&step=4");
    for step in [0, 2, 3] {
        shown.model_mut().seek(step);
        assert_eq!(shown.model().pending(), 0, "{step}");
        assert_eq!(shown.model().step(), step);
        assert_eq!(state(&shown), state(&figure(TAG, &format!("particles=5&step={step}"))));
    }
    assert!(readout(&figure(TAG, "particles=5&step=0"), "distinct_after").is_nan());
}

/// The picture before stays until there is another with a sweep: never half a run of what was asked for.
#[test]
fn a_run_is_shown_from_its_first_sweep_on_and_gets_finer() {
    let mut shown = figure(TAG, "particles=5&step=4");
    shown.set("particles", "6").unwrap();
    let before = readout(&shown, "early_before");
    while shown.model().answer() == 0 {
        assert_eq!(readout(&shown, "early_before"), before);
        shown.model_mut().work();
    }
    assert_eq!(readout(&shown, "sweeps"), 1.0);
    shown.model_mut().settle();
    assert_eq!(state(&shown), state(&figure(TAG, "particles=6&step=4")));
    // What was taken back before it had come to anything leaves all as it was.
    shown.set("particles", "7").unwrap();
    shown.set("particles", "6").unwrap();
    assert_eq!(shown.model().pending(), 0);
}

#[test]
fn the_handle_stands_at_the_step_and_is_dragged_and_nudged_to_whole_ones() {
    let mut shown = figure(TAG, "particles=5&step=1&at=10");
    let at = |figure: &Figure| scene(figure, 800.0).handles[0].at;
    let [x, y] = at(&shown);
    shown.drag("at", x + 100.0, y, 800.0);
    assert!((at(&shown)[0] - x - 100.0).abs() < 4.0, "{:?}", shown.query());
    let now = shown.query();
    shown.nudge("at", -0.1, 0.0);
    assert_ne!(shown.query(), now);
    shown.drag("at", 1e9, y, 800.0);
    assert!(shown.query().contains("at=62"), "{:?}", shown.query());
    shown.drag("at", f64::NAN, y, 800.0);
    shown.drag("at", -1e9, y, 800.0);
    assert!(shown.query().contains("at=1&"), "{:?}", shown.query());
}

/// Challenges are reached where they say, and not beside it.
#[test]
fn goals_are_reached_and_missed() {
    let done = |name: &str, query: &str| {
        let chip = figure(TAG, query).chips().into_iter().find(|chip| chip.name == name).unwrap();
        (chip.done, chip.said)
    };
    let step = readout(&figure(TAG, "step=0"), "coalescence");
    assert!(done("one", &format!("at={step}&step=0")).0 && !done("one", &format!("at={}&step=0", step + 1.0)).0);
    assert!(!done("five", "particles=4&step=5").0);
    let fives: Vec<bool> = [8, 16, 24, 32, 40].map(|m| done("five", &format!("particles={m}&step=5")).0).into();
    assert!(fives.contains(&true), "{fives:?}");
    assert!(done("stick", "particles=2").0 && !done("stick", "particles=10").0, "{:?}", done("stick", "particles=2"));
}

#[test]
fn nothing_is_cut_or_covered_at_any_size_and_at_the_ends_of_every_range() {
    for query in [
        "",
        "particles=2&odometry=3&sensor=2&at=62",
        "particles=40&odometry=0.25&sensor=0.25&step=1&at=1",
        "step=0&at=61",
    ] {
        let shown = figure(TAG, query);
        for width in [300.0, 340.0, 380.0, 559.0, 560.0, 640.0, 800.0, 1112.0, 1300.0] {
            let (scene, which) = (scene(&shown, width), format!("{query} at {width}"));
            assert_texts_fit(&scene, &which);
            assert_drawn_inside(&scene, &which);
        }
    }
}
