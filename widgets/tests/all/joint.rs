//! Laws of the figure of the sampled map, by its public face.

use crate::common::{figure, scene, state};
use fastslam_widgets::figure::Figure;

const TAG: &str = "fastslam-joint";

fn readout(figure: &Figure, name: &str) -> f64 {
    let readouts = figure.model().readouts();
    readouts.iter().find(|readout| readout.name == name).and_then(|readout| readout.value).unwrap()
}

/// The claim of the caption, at the state that the figure opens in.
#[test]
fn as_it_opens_the_sampled_map_has_run_out_of_particles_and_the_computed_one_has_not() {
    let figure = figure(TAG, "");
    assert!(readout(&figure, "ess_sampled") < 2.0 && readout(&figure, "left_sampled") < 20.0);
    assert!(readout(&figure, "ess_computed") > 500.0 && readout(&figure, "left_computed") > 500.0);
    assert!(readout(&figure, "removed") > 99.9);
    // Exercise 2 of the chapter, to its two decimals.
    assert_eq!((100.0 * readout(&figure, "rho")).round(), 279.0);
}

#[test]
fn another_number_of_landmarks_is_looked_at_without_running_anything_again() {
    let mut shown = figure(TAG, "particles=50");
    for landmarks in ["1", "7", "24"] {
        shown.set("landmarks", landmarks).unwrap();
        assert_eq!(shown.model().pending(), 0, "{landmarks}");
        assert_eq!(state(&shown), state(&figure(TAG, &format!("particles=50&landmarks={landmarks}"))));
    }
}

/// Until a reader has guessed or waived it, nothing is told that the answer could be read from; what is told then is of the line.
#[test]
fn what_the_sampled_map_comes_to_is_hidden_until_it_is_guessed() {
    let mut shown = figure(TAG, "odometry=0&particles=200");
    let seen = ["ess_sampled", "predicted_sampled", "rho", "left_sampled", "spread_sampled", "removed"];
    let known = |figure: &Figure| {
        let readouts = figure.model().readouts();
        seen.map(|name| readouts.iter().find(|readout| readout.name == name).unwrap().value.is_some())
    };
    let discs = |figure: &Figure| scene(figure, 800.0).marks.len();
    assert_eq!(known(&shown), [true; 6]);
    let (all, told) = (discs(&shown), shown.model().describe());
    shown.set("predict", "on").unwrap();
    assert_eq!(known(&shown), [false; 6]);
    assert!(discs(&shown) < all && shown.model().series().rows.is_empty());
    let asked = shown.model().describe();
    assert!(asked.contains("200 particles") && !told.contains(&asked), "{asked}");
    // 200 particles last for ln 200 / ln 2.79 = 5.2 landmarks.
    shown.drag("guess", scene(&shown, 800.0).handles[0].at[0] - 1e9, 0.0, 800.0);
    assert!(shown.query().as_str().contains("guess=1"), "{:?}", shown.query());
    (0..4).for_each(|_| shown.nudge("guess", 1.0, 0.0));
    assert_eq!(known(&shown), [false; 6]);
    shown.set("run", "on").unwrap();
    assert_eq!(known(&shown), [true; 6]);
    let outcome = shown.model().prediction().unwrap();
    assert!(outcome.shown && outcome.result == Some(6.0) && outcome.guess == Some(5.0), "{outcome:?}");
    assert!(
        shown
            .model()
            .describe()
            .starts_with("200 particles with sampled maps are worth less than one from 6 landmarks on")
    );
    // Another number of particles is another question.
    shown.set("particles", "100").unwrap();
    shown.model_mut().settle();
    assert!(known(&shown) == [false; 6] && shown.model().prediction().unwrap().guess.is_none());
    // And one that 24 landmarks do not answer.
    let mut blunt = figure(TAG, "sensor=5&particles=20000&predict=on&run=on");
    assert_eq!(blunt.model().prediction().unwrap().result, None);
    assert!(blunt.model_mut().describe().contains("after all 24 landmarks"), "{}", blunt.model().describe());
}

/// The picture before stays until there is another: never half a run of what was asked for.
#[test]
fn a_run_is_shown_from_its_first_repeat_on_and_gets_finer() {
    let mut shown = figure(TAG, "particles=50");
    assert!(figure(TAG, "particles=50").model().answer() == 0 || shown.model().pending() == 0);
    shown.set("particles", "60").unwrap();
    let before = readout(&shown, "ess_computed");
    while shown.model().answer() == 0 {
        assert_eq!(readout(&shown, "ess_computed"), before);
        shown.model_mut().work();
    }
    assert_eq!(readout(&shown, "repeats"), 1.0);
    assert!(shown.model().pending() > 0);
    shown.model_mut().settle();
    assert_eq!(state(&shown), state(&figure(TAG, "particles=60")));
    // What was taken back before it had come to anything leaves all as it was.
    shown.set("particles", "70").unwrap();
    shown.set("particles", "60").unwrap();
    assert_eq!(shown.model().pending(), 0);
}

#[test]
fn the_handle_stands_at_the_number_of_landmarks_and_is_dragged_and_nudged_to_whole_ones() {
    let mut shown = figure(TAG, "particles=50&landmarks=6");
    let at = |figure: &Figure| scene(figure, 800.0).handles[0].at;
    let [x, y] = at(&shown);
    shown.drag("landmarks", x + 250.0, y, 800.0);
    let moved = readout(&shown, "ess_sampled");
    assert!(shown.query().as_str().contains("landmarks=14"), "{:?}", shown.query());
    assert!((at(&shown)[0] - x - 250.0).abs() < 20.0);
    shown.nudge("landmarks", -0.1, 0.0);
    assert!(shown.query().as_str().contains("landmarks=13") && moved.is_finite());
    shown.drag("landmarks", -1e9, y, 800.0);
    assert!(shown.query().as_str().contains("landmarks=1&"), "{:?}", shown.query());
}
