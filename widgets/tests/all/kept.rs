//! Who goes back to a setting that was shown before has it at once, as it was: in every figure that takes its time.

use crate::common::{figure, state};

/// Of each a quick setting, and a slider with the values to go through.
const FIGURES: [(&str, &str, &str, [&str; 2]); 6] = [
    ("fastslam-lap", "universes=4&step=30", "odometry", ["1", "1.2"]),
    ("fastslam-resampling", "particles=4&step=20", "odometry", ["1", "1.2"]),
    ("fastslam-joint", "particles=50", "sensor", ["1", "1.2"]),
    ("fastslam-em", "", "odometry", ["0.05", "0.07"]),
    ("fastslam-smoothing", "particles=2", "odometry", ["1", "1.2"]),
    ("fastslam-graph", "", "odometry", ["0.5", "0.6"]),
];

#[test]
fn a_setting_that_was_shown_before_takes_no_time() {
    for (tag, query, name, [one, other]) in FIGURES {
        let mut shown = figure(tag, query);
        shown.set(name, one).unwrap();
        shown.model_mut().settle();
        let before = state(&shown);
        shown.set(name, other).unwrap();
        assert!(shown.model().pending() > 0, "{tag}: another setting has to be computed");
        shown.model_mut().settle();
        let between = state(&shown);
        assert_ne!(before, between, "{tag}");
        for (value, expected) in [(one, &before), (other, &between), (one, &before)] {
            shown.set(name, value).unwrap();
            assert_eq!((shown.model().pending(), &state(&shown)), (0, expected), "{tag}: back at {value}");
        }
    }
}

/// A drag passes settings by that come to nothing: none of them pushes out what was seen.
#[test]
fn what_was_passed_by_is_not_kept_in_place_of_what_was_seen() {
    for (tag, query, name, [one, other]) in FIGURES {
        let mut shown = figure(tag, query);
        shown.set(name, one).unwrap();
        shown.model_mut().settle();
        let before = state(&shown);
        for tenth in 1..=8 {
            let (from, to): (f64, f64) = (one.parse().unwrap(), other.parse().unwrap());
            shown.set(name, &(from + 0.1 * f64::from(tenth) * (to - from)).to_string()).unwrap();
        }
        shown.set(name, one).unwrap();
        assert_eq!((shown.model().pending(), &state(&shown)), (0, &before), "{tag}");
    }
}

/// Steps that a lap put aside has thinned out are computed again, to the same bits.
#[test]
fn a_lap_that_was_put_aside_goes_to_every_step() {
    let mut shown = figure("fastslam-lap", "universes=16&step=60");
    let at = |shown: &mut fastslam_widgets::figure::Figure, step: u32| {
        shown.model_mut().seek(step);
        shown.model_mut().settle();
        state(shown)
    };
    let steps = [60, 37, 1, 61];
    let before = steps.map(|step| at(&mut shown, step));
    for value in ["1.2", "1"] {
        shown.set("odometry", value).unwrap();
        shown.model_mut().settle();
    }
    assert_eq!(steps.map(|step| at(&mut shown, step)), before);
}
