//! Laws of the figure of the doors: what its caption says can be seen where it opens, and over many seeds.

use crate::common::figure;
use fastslam_widgets::figure::Figure;

const TAG: &str = "fastslam-doors";

fn value(figure: &Figure, name: &str) -> f64 {
    figure.readouts().into_iter().find(|readout| readout.name == name).and_then(|readout| readout.value).unwrap()
}

#[test]
fn it_opens_at_the_end_where_the_particles_are_right_and_the_kalman_filter_is_sure_and_wrong() {
    let figure = figure(TAG, "");
    assert_eq!(figure.model().step(), figure.model().step_count());
    assert_eq!(["fastslam_right", "ekf_right", "alive"].map(|name| value(&figure, name)), [1.0, 0.0, 1.0]);
    assert!(value(&figure, "ekf_std") < 0.1);
    let rows = figure.model().series().rows;
    let most = rows.iter().map(|row| row[2]).fold(0.0, f64::max);
    assert!(most >= 6.0, "{most} explanations at once");
    assert!(rows[58][2] >= 4.0, "{} of them until the sign", rows[58][2]);
}

/// The caption calls the particles right where the Kalman filter is not: so it is far more often than not.
#[test]
fn what_it_opens_with_is_no_accident_of_its_seed() {
    let ends: Vec<[f64; 2]> = (1..=40)
        .map(|seed| figure(TAG, &format!("seed={seed}")))
        .map(|figure| ["fastslam_right", "ekf_right"].map(|name| value(&figure, name)))
        .collect();
    let count = |which: usize| ends.iter().filter(|right| right[which] == 1.0).count();
    assert!(count(0) >= 36 && count(1) <= 16, "{} and {} of 40 are right", count(0), count(1));
}

#[test]
fn who_is_at_the_end_stays_there_when_the_end_moves() {
    let mut figure = figure(TAG, "");
    for change in [("seed", "8"), ("ride", "1"), ("end", "1"), ("end", "17"), ("seed", "35")] {
        figure.set(change.0, change.1).unwrap();
        figure.model_mut().settle();
        assert_eq!(figure.model().step(), figure.model().step_count(), "{change:?}");
    }
    figure.model_mut().seek(50);
    figure.model_mut().seek(u32::MAX);
    assert!(!figure.query().contains("step"), "{}", figure.query());
}

#[test]
fn whoever_drags_the_ride_sees_what_a_link_to_it_shows() {
    let mut dragged = figure(TAG, "");
    for (name, value) in [("ride", "1"), ("end", "9"), ("ride", "6.5"), ("range", "0.2"), ("ride", "2")] {
        dragged.set(name, value).unwrap();
        dragged.model_mut().settle();
        let linked = figure(TAG, &dragged.query());
        assert_eq!(dragged.model().series(), linked.model().series(), "{name} = {value}");
        assert_eq!(dragged.scene(800.0, 500.0), linked.scene(800.0, 500.0), "{name} = {value}");
    }
}

#[test]
fn doors_and_the_end_of_the_ride_are_dragged_along_their_walls() {
    let mut figure = figure(TAG, "");
    let at = |figure: &Figure, name: &str| {
        figure.scene(800.0, 500.0).handles.into_iter().find(|handle| handle.name == name).unwrap().at
    };
    for (name, readout) in [("door-5", "door-5"), ("end", "end")] {
        let [x, y] = at(&figure, name);
        figure.drag(name, x + 40.0, y, 800.0);
        figure.model_mut().settle();
        assert!((at(&figure, name)[0] - x - 40.0).abs() < 5.0, "{name} follows the pointer");
        let before: f64 = figure.model().value(readout).unwrap().parse().unwrap();
        figure.nudge(name, -1.0, 0.0);
        assert_eq!(figure.model().value(readout).unwrap(), (before - 0.25).to_string());
    }
}

#[test]
fn a_seventh_door_is_a_landmark_like_the_others() {
    let figure = figure(TAG, "door-7=1.5&step=43");
    assert_eq!(figure.scene(800.0, 500.0).handles.len(), 8, "seven doors and the end of the ride");
}

/// Where it opens all is over: it offers to be watched from the ride on, when several explanations are still to come.
#[test]
fn what_led_to_where_it_opens_can_be_watched() {
    let mut figure = figure(TAG, "");
    let (from, words) = figure.model().watch().unwrap();
    assert!(!words.is_empty());
    figure.model_mut().seek(from + 6);
    figure.model_mut().settle();
    assert!(value(&figure, "alive") >= 4.0 && from < figure.model().step_count(), "from step {from}");
}
