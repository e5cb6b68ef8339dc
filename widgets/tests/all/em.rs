//! Laws of the figure of EM mapping, by its public face.

use crate::common::{figure, scene, state};
use fastslam_widgets::{figure::Figure, scene::Mark};

const TAG: &str = "fastslam-em";

fn readout(figure: &Figure, name: &str) -> Option<f64> {
    figure.model().readouts().into_iter().find(|readout| readout.name == name).and_then(|readout| readout.value)
}

fn number(figure: &Figure, name: &str) -> f64 {
    readout(figure, name).unwrap_or_else(|| panic!("no {name}"))
}

/// The claims of the caption, at the state that the figure opens in and at its chip.
#[test]
fn as_it_opens_the_map_is_right_and_the_particles_hold_both_answers_and_a_folding_guess_ends_lower() {
    let right = figure(TAG, "");
    assert_eq!((number(&right, "doors"), number(&right, "again_em").round()), (3.0, 0.0));
    assert!((number(&right, "put_down") - 3.9).abs() < 0.1);
    assert!((5.0..95.0).contains(&number(&right, "again")));
    assert!(number(&right, "log_posterior") > number(&right, "best") - 0.1, "none of the others ends above it");
    let fold = figure(TAG, "mark-3=5.2");
    assert_eq!((number(&fold, "doors"), number(&fold, "again_em").round()), (2.0, 100.0));
    assert!(number(&fold, "log_posterior") < number(&right, "log_posterior") - 5.0);
    assert!(fold.describe().contains("nothing changes any more"), "{}", fold.describe());
    assert_eq!(number(&fold, "again"), number(&right, "again"), "the particles make no guess");
}

/// Where the path is in several places at once, of the columns after the robot was carried, and what is told of it.
fn undecided(query: &str) -> (usize, String) {
    let shown = figure(TAG, query);
    let cells = scene(&shown, 800.0).marks.into_iter().find_map(|mark| match mark {
        Mark::Raster { cells, .. } => Some(cells),
        _ => None,
    });
    let cells = cells.unwrap();
    let runs = |step: usize| {
        let dark = |cell: usize| cells.shades[cell * cells.columns + step] > 25;
        let rows = cells.shades.len() / cells.columns;
        (0..rows).filter(|cell| dark(*cell) && (*cell == 0 || !dark(*cell - 1))).count()
    };
    ((80..cells.columns).filter(|step| runs(*step) > 1).count(), shown.model().narrate())
}

/// *Looking back sharpens*: each reading of the future takes some of the doubt away, and the map does not hang on what is looked at.
#[test]
fn the_more_future_the_fewer_moments_have_the_robot_in_several_places() {
    let found = ["future=0", "future=10", "future=40", ""].map(undecided);
    let counts = found.each_ref().map(|(count, _)| *count);
    assert!(counts[0] >= 20 && counts.windows(2).all(|two| two[0] >= two[1]) && counts[3] == 0, "{counts:?}");
    assert!(found[0].1.contains("63 % for the old ones") && found[3].1.contains("put down at 3.9 m"), "{found:?}");
    let [now, all] = ["future=0&particles=50", "particles=50"].map(|query| figure(TAG, query));
    for name in ["log_posterior", "put_down", "again_em", "entropy", "doors"] {
        assert_eq!(number(&now, name), number(&all, name), "{name}");
    }
}

/// The chips of the caption: wheels twice as bad make EM mapping sure of what the particles are not, and a blank map finds all doors.
#[test]
fn bad_wheels_fold_the_same_guess_and_a_blank_map_is_enough_on_this_log() {
    let wheels = figure(TAG, "odometry=0.1");
    assert_eq!(number(&wheels, "again_em").round(), 100.0);
    assert!((5.0..95.0).contains(&number(&wheels, "again")));
    let blank = figure(TAG, "trust=0");
    assert_eq!((number(&blank, "doors"), number(&blank, "again_em").round()), (3.0, 0.0));
}

/// Ten steps an iteration: four of the forward pass, four of the backward one, their product, the map.
#[test]
fn passes_fill_from_their_ends_and_only_then_there_is_a_product_and_a_map() {
    // Of the particles nothing is asked here: a few are quicker.
    let mut figure = figure(TAG, "particles=50");
    let mut told = |step: u32| {
        figure.set("step", &step.to_string()).unwrap();
        (figure.describe(), readout(&figure, "entropy"), number(&figure, "iteration"))
    };
    assert!(told(0).0.starts_with("The first guess"));
    for (step, what) in [(1, "forward"), (4, "forward"), (5, "backward"), (8, "backward"), (14, "forward")] {
        let (describe, entropy, iteration) = told(step);
        assert!(describe.contains(what), "{step}: {describe}");
        assert_eq!((entropy, iteration), (None, f64::from(step / 10)), "{step}");
    }
    assert!(told(9).1.unwrap() > told(199).1.unwrap(), "what is known of the path grows");
    assert_eq!([9, 10].map(|step| told(step).2), [0.0, 1.0]);
    // Who asks for the end stays there.
    let mut shown = crate::common::figure(TAG, "");
    shown.set("iterations", "5").unwrap();
    assert_eq!((shown.model().step(), number(&shown, "iteration")), (50, 5.0));
}

#[test]
fn what_never_falls_never_falls_in_what_is_saved() {
    for query in [
        "particles=50",
        "particles=50&mark-3=5.2",
        "particles=50&trust=0&iterations=60",
        "particles=50&sensor=45&odometry=0.3",
        "particles=50&sensor=0&odometry=0.01",
    ] {
        let rows = figure(TAG, query).model().series().rows;
        assert!(rows.windows(2).all(|two| two[1][1] >= two[0][1] - 1e-9), "{query}");
    }
}

#[test]
fn a_mark_is_dragged_and_nudged_along_the_corridor_and_moves_nothing_else() {
    let mut shown = figure(TAG, "particles=50");
    let at = |figure: &Figure, name: &str| scene(figure, 800.0).handles.iter().find(|h| h.name == name).unwrap().at;
    let ([x, y], again) = (at(&shown, "mark-3"), number(&shown, "again"));
    shown.drag("mark-3", x, at(&shown, "mark-2")[1], 800.0);
    assert!(shown.query().as_str().contains("mark-3=5.2"), "{:?}", shown.query());
    assert_eq!((number(&shown, "doors"), number(&shown, "again"), shown.model().pending()), (2.0, again, 0));
    shown.nudge("mark-3", 0.0, 1.0);
    assert!(shown.query().as_str().contains("mark-3=5.3"), "{:?}", shown.query());
    shown.nudge("mark-3", 0.0, -0.1);
    shown.drag("mark-3", x, -1e9, 800.0);
    assert!(shown.query().as_str().contains("mark-3=10"), "{:?}", shown.query());
    shown.drag("mark-3", x, f64::NAN, 800.0);
    shown.drag("mark-3", x, y, 800.0);
    assert_eq!(state(&shown), state(&figure(TAG, "particles=50")));
}

/// The particles and the other guesses come after EM mapping, which is there at once.
#[test]
fn what_comes_later_only_adds_to_what_is_shown() {
    let mut shown = figure(TAG, "particles=50");
    shown.set("seed", "3").unwrap();
    let (value, pending) = (number(&shown, "log_posterior"), shown.model().pending());
    assert!(pending == 157 + 20 && shown.model().answer() > 0 && readout(&shown, "again").is_none());
    shown.model_mut().settle();
    assert!(shown.model().pending() == 0 && readout(&shown, "again").is_some());
    assert_eq!(number(&shown, "log_posterior"), value);
    assert_eq!(state(&shown), state(&figure(TAG, "particles=50&seed=3")));
}
