//! What hands do to the worked example: robots, headings, sightings, the landmark's ellipse and the threshold are dragged.

use super::{example, hostile, scene, text};
use fastslam::ops;
use fastslam_widgets::figure::Figure;

/// Where a handle is in a figure of this width \[css px\].
fn at(figure: &Figure, name: &str, width: f64) -> [f64; 2] {
    scene(figure, width).handles.iter().find(|handle| handle.name == name).expect(name).at
}

/// Moves a handle by so many css px.
fn drag(figure: &mut Figure, name: &str, [right, down]: [f64; 2], width: f64) {
    let [x, y] = at(figure, name, width);
    figure.drag(name, x + right, y + down, width);
}

const HANDLES: [&str; 9] =
    ["robot-1", "heading-1", "sighting-1", "robot-2", "heading-2", "sighting-2", "mean", "sigma", "sigma-yy"];

#[test]
fn what_is_dragged_follows_the_hand_and_the_picture_stays_where_it_is() {
    for width in [352.0, 588.0, 728.0, 804.0, 1112.0] {
        for name in HANDLES {
            let mut figure = example("");
            let others = |figure: &Figure| {
                // What a robot sees moves and turns with it, and the ellipse goes with its middle.
                let moves = |other: &str| {
                    other[other.len() - 2..] == name[name.len() - 2..]
                        || (other.starts_with("sigma") && (name.starts_with("sigma") || name == "mean"))
                };
                let still = HANDLES.into_iter().filter(|other| !moves(other));
                still.map(|other| (other, at(figure, other, width))).collect::<Vec<_>>()
            };
            let (before, start) = (others(&figure), at(&figure, name, width));
            let by = if name == "sigma-yy" { [0.0, 9.0] } else { [-12.0, 9.0] };
            drag(&mut figure, name, by, width);
            let end = at(&figure, name, width);
            let off = [0, 1].map(|k| end[k] - start[k] - by[k]);
            // A lever keeps its length; all else is where the hand is, to the decimals that are written of it.
            if !name.starts_with("heading") {
                assert!(off.iter().all(|d| d.abs() < 2.0), "{name} at {width}: {off:?}");
            }
            assert_ne!(start, end, "{name} at {width}");
            assert_eq!(others(&figure), before, "{name} at {width}: nothing else moves");
        }
    }
}

#[test]
fn what_is_dragged_changes_its_own_numbers_only_and_s_is_seen_to_change() {
    let changed = |name: &str, by: [f64; 2]| {
        let mut figure = example("");
        drag(&mut figure, name, by, 728.0);
        figure.query()
    };
    for (name, parameters) in [
        ("robot-1", vec!["x1", "y1"]),
        ("heading-2", vec!["theta2"]),
        ("sighting-1", vec!["r1", "phi1"]),
        ("sighting-2", vec!["r2", "phi2"]),
        ("mean", vec!["mu-x", "mu-y"]),
        ("sigma", vec!["sigma-xx", "sigma-xy"]),
        ("sigma-yy", vec!["sigma-yy"]),
    ] {
        let query = changed(name, [30.0, 20.0]);
        let names: Vec<&str> = query.split('&').map(|pair| pair.split('=').next().unwrap()).collect();
        assert_eq!(names, parameters, "{query}");
    }
    assert_eq!(
        changed("sigma", [-30.0, 2.0]).split('&').count(),
        1,
        "at the level of the landmark, x and y stay apart"
    );
    let s = |figure: &Figure| figure.export().rows()[0].clone();
    let (before, mut figure) = (s(&example("")), example(""));
    drag(&mut figure, "sigma", [-30.0, 0.0], 728.0);
    assert_ne!(before, s(&figure));
}

#[test]
fn a_drag_out_of_the_picture_ends_at_its_edge_and_the_window_stays() {
    for width in [352.0, 728.0, 804.0] {
        for name in HANDLES {
            for to in [[-500.0, -500.0], [3000.0, 40.0], [400.0, 3000.0], [3000.0, 3000.0], [-500.0, 60.0]] {
                let mut figure = example("");
                figure.drag(name, to[0], to[1], width);
                let query = figure.query();
                let other = if name.ends_with('2') { "robot-1" } else { "robot-2" };
                assert_eq!(
                    at(&figure, other, width),
                    at(&example(""), other, width),
                    "{name} to {to:?} at {width}: {query}"
                );
                // Again at the same place, nothing goes on.
                figure.drag(name, to[0], to[1], width);
                assert_eq!(figure.query(), query, "{name} to {to:?} at {width}");
            }
        }
    }
}

#[test]
fn whatever_hands_do_the_covariance_is_positive_definite() {
    for query in hostile().iter().map(String::as_str).chain(["sigma-xy=0.1", "sigma-xx=0.000001&sigma-yy=100"]) {
        let mut figure = example(query);
        for (name, x, y) in [
            ("sigma", 0.0, 0.0),
            ("sigma", 300.0, 2.0),
            ("sigma-yy", 300.0, 300.0),
            ("sigma", 0.0, 300.0),
            ("sigma-yy", 0.0, 0.0),
        ] {
            figure.drag(name, x, y, 728.0);
            let values: Vec<f64> = ["sigma-xx", "sigma-xy", "sigma-yy"]
                .map(|name| figure.model().value(name).unwrap().parse().unwrap())
                .into();
            assert!(values[1] * values[1] < values[0] * values[2], "{query}, {name}: {values:?}");
            for [right, up] in [[1e9, 1e9], [-1e9, 1e9], [0.1, -1e9]] {
                figure.nudge(name, right, up);
            }
            assert_eq!(example(&figure.query()).query(), figure.query(), "what a hand makes, a link makes again");
        }
    }
}

#[test]
fn arrow_keys_move_each_handle_by_the_steps_of_its_parameters() {
    for (name, [right, up], query) in [
        ("robot-1", [1.0, -1.0], "x1=0.1&y1=-0.1"),
        ("robot-2", [10.0, 0.1], "x2=1&y2=0.01"),
        ("heading-1", [0.0, 1.0], "theta1=0.05"),
        ("sighting-1", [1.0, 0.0], "r1=4.2"),
        ("sighting-2", [0.0, 1.0], "phi2=0.2"),
        ("mean", [-1.0, 0.1], "mu-x=3.9&mu-y=0.01"),
        ("sigma", [-1.0, 0.0], "sigma-xx=0.22"),
        ("sigma", [0.0, -1.0], "sigma-xy=0.01"),
        ("sigma-yy", [0.0, 1.0], "sigma-yy=0.13"),
        ("threshold", [0.0, 6.0], "threshold=0.8"),
    ] {
        let mut figure = example("");
        figure.nudge(name, right, up);
        assert_eq!(figure.query(), query, "{name}");
    }
}

#[test]
fn the_threshold_is_dragged_along_the_bar() {
    for width in [352.0, 588.0, 728.0] {
        let mut figure = example("");
        let start = at(&figure, "threshold", width);
        drag(&mut figure, "threshold", [40.0, 25.0], width);
        assert!((at(&figure, "threshold", width)[0] - start[0] - 40.0).abs() < 2.0);
        figure.drag("threshold", 9999.0, 0.0, width);
        assert_eq!(figure.query(), "threshold=1");
        assert_eq!(text(&figure, "verdict"), "1.57 < 2: resample");
    }
}

#[test]
fn handles_are_as_far_apart_as_a_finger_is_wide_as_the_example_opens() {
    for width in [352.0, 588.0, 728.0, 804.0, 1112.0] {
        let handles = scene(&example(""), width).handles;
        for (k, one) in handles.iter().enumerate() {
            for other in &handles[..k] {
                let apart = ops::hypot(one.at[0] - other.at[0], one.at[1] - other.at[1]);
                assert!(apart >= 40.0, "{} and {} at {width}: {apart}", one.name, other.name);
            }
        }
    }
}
