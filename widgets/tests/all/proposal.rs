//! Laws of the proposals' figure, by its public face: what a page can do to it.

use crate::common::{assert_texts_fit, figure, scene, state};
use fastslam_widgets::{
    decimal::fixed,
    figure::Figure,
    panels::Panels,
    proposal::{Layout, ProposalView},
    scene::{Mark, Rect, Role},
    view::{Layout as _, View},
};

const TAG: &str = "fastslam-proposal";

/// In the state that a link of today names.
fn proposal(query: &str) -> Figure {
    figure(TAG, &format!("v=3&{}", query.trim_start_matches("v=3").trim_start_matches('&')))
}

/// The number between two parts of what is said of a figure.
fn said(figure: &Figure, before: &str, after: &str) -> String {
    let told = figure.model().describe();
    let (_, rest) = told.split_once(before).unwrap_or_else(|| panic!("{before}: {told}"));
    rest.split_once(after).unwrap_or_else(|| panic!("{after}: {told}")).0.to_string()
}

/// How many samples of 1.0 one of 2.0 is worth.
fn ratio(figure: &Figure) -> String {
    said(figure, "is worth ", " of 1.0")
}

/// Where a handle is in a figure of this width \[css px\].
fn handle(figure: &Figure, name: &str, width: f64) -> [f64; 2] {
    let scene = scene(figure, width);
    let at = scene.handles.iter().find(|h| h.name == name).unwrap().at;
    at.map(|x| x * width / scene.width)
}

const STATES: [&str; 6] = [
    "",
    "landmarks=pair",
    "predict=on&guess=30",
    "samples=4096&range-std=0.005&bearing-std=0.01&odometry=2&predict=on&guess=29.55&run=on&landmarks=pair",
    "samples=1&range-std=0.5&bearing-std=0.3&odometry=0.25&landmark-x=-0.1&landmark-y=0.75&landmarks=pair",
    "landmark-x=2.8&landmark-y=-0.75&seed=4294967295&odometry=2&predict=on&run=on",
];

#[test]
fn dragging_is_setting_in_any_panel_and_at_any_width() {
    for width in [200.0, 340.0, 800.0, 1200.0] {
        for (name, value) in [
            ("landmark", "landmark-x=1.9&landmark-y=0.4"),
            ("range-std", "range-std=0.005"),
            ("range-std", "range-std=0.123"),
            ("range-std", "range-std=0.5"),
            ("bearing-std", "bearing-std=0.01"),
            ("bearing-std", "bearing-std=0.3"),
            ("odometry", "odometry=0.25"),
            ("odometry", "odometry=1.73"),
            ("odometry", "odometry=2"),
        ] {
            for show in ["all", "motion", "aware"] {
                let [mut figure, mut aim] = ["", value].map(|query| proposal(&format!("samples=50&{query}")));
                for figure in [&mut figure, &mut aim] {
                    figure.show(show).unwrap();
                    figure.compare(false); // the step before the drag is not in the aim
                }
                let [x, y] = handle(&aim, name, width);
                figure.drag(name, x, y, width);
                figure.model_mut().settle();
                assert_eq!(state(&figure), state(&aim), "{value} at {width}, {show}");
            }
        }
        let mut figure = proposal("predict=on");
        let [x, y] = handle(&proposal("predict=on&guess=6.5"), "guess", width);
        figure.drag("guess", x, y, width);
        assert_eq!(figure.query(), "v=3&predict=on&guess=6.5", "at {width}");
    }
}

#[test]
fn a_landmark_dragged_out_of_its_panel_stays_at_the_edge() {
    let mut figure = proposal("");
    figure.drag("landmark", 1e6, -1e6, 800.0);
    let specs = figure.model().params();
    for name in ["landmark-x", "landmark-y"] {
        let max = specs.iter().find(|s| s.name == name).unwrap().max;
        assert_eq!(
            figure.model().value(name).unwrap().parse::<f64>().unwrap(),
            (100.0 * max).round() / 100.0,
            "{name}"
        );
    }
}

#[test]
fn a_noise_is_dragged_by_every_small_step_and_beyond_its_range_stays_at_the_end() {
    for (name, [min, max]) in [("range-std", [0.005, 0.5]), ("bearing-std", [0.01, 0.3]), ("odometry", [0.25, 2.0])] {
        let mut figure = proposal("samples=1");
        let value = |figure: &Figure| figure.model().value(name).unwrap().parse::<f64>().unwrap();
        let (from, start) = (handle(&figure, name, 692.0), value(&figure));
        // Away from the middle is to the right and up.
        let mut last = start;
        for k in 1..=20 {
            let way = f64::from(k);
            figure.drag(name, from[0] + way, from[1] - way, 692.0);
            let now = value(&figure);
            assert!(last < now && now < last + 0.1 * (max - min), "{name}: {last}, {now}");
            last = now;
        }
        figure.drag(name, from[0] + 1e4, from[1] - 1e4, 692.0);
        assert_eq!(value(&figure), max);
        figure.drag(name, from[0] - 1e4, from[1] + 1e4, 692.0);
        assert_eq!(value(&figure), min);
    }
}

#[test]
fn noises_are_moved_by_keys_to_the_right_or_up_for_more() {
    let mut figure = proposal("samples=1");
    for (name, steps, value) in [
        ("range-std", [1.0, 0.0], "0.055"),
        ("range-std", [0.0, 10.0], "0.105"),
        ("range-std", [-0.1, 0.0], "0.1045"),
        ("bearing-std", [0.0, 1.0], "0.06"),
        ("bearing-std", [0.0, -10.0], "0.01"),
        ("odometry", [1.0, 0.0], "1.05"),
        ("odometry", [10.0, 0.0], "1.55"),
        ("odometry", [-0.1, 0.0], "1.545"),
    ] {
        figure.nudge(name, steps[0], steps[1]);
        assert_eq!(figure.model().value(name).unwrap(), value, "{name} by {steps:?}");
    }
}

#[test]
fn what_the_panels_show_of_the_world_is_the_same_whatever_was_drawn_and_seen() {
    // The robot stays where it is in its panel, and so does the scale: only the wheels' noise moves them.
    let seen = |query: &str| {
        let scene = scene(&proposal(query), 692.0);
        let bar = scene.marks.iter().find_map(|mark| match mark {
            Mark::Lines { lines, role: Role::Ink, .. } if lines[0].len() == 4 => Some(lines.clone()),
            _ => None,
        });
        bar.unwrap()
    };
    for query in ["seed=5", "samples=1", "range-std=0.5", "bearing-std=0.3", "landmarks=pair", "landmark-x=0.4"] {
        assert_eq!(seen(query), seen(""), "{query}");
    }
    assert_ne!(seen("odometry=2"), seen(""));
}

#[test]
fn handles_are_as_far_apart_as_fingers_need_where_the_figure_opens() {
    for query in ["", "landmarks=pair", "predict=on"] {
        for (width, apart) in [(692.0, 44.0), (600.0, 44.0), (352.0, 44.0), (300.0, 28.0)] {
            let handles = scene(&proposal(query), width).handles;
            for (k, a) in handles.iter().enumerate() {
                for b in &handles[..k] {
                    let [dx, dy] = [0, 1].map(|i| a.at[i] - b.at[i]);
                    assert!((dx * dx + dy * dy).sqrt() >= apart, "{} and {} at {width}", a.name, b.name);
                }
            }
        }
    }
}

#[test]
fn arrow_keys_move_by_a_step_coarsely_by_ten_and_finely_by_a_tenth() {
    let mut figure = proposal("landmark-x=1&landmark-y=0.1");
    for (right, up, x, y) in [
        (1.0, 0.0, "1.05", "0.1"),
        (0.0, -1.0, "1.05", "0.05"),
        (-10.0, 0.0, "0.55", "0.05"),
        (0.0, 0.1, "0.55", "0.055"),
    ] {
        figure.nudge("landmark", right, up);
        let value = |name| figure.model().value(name).unwrap();
        assert_eq!((value("landmark-x").as_str(), value("landmark-y").as_str()), (x, y));
    }
    let mut figure = proposal("predict=on&guess=4");
    for (right, up, guess) in [(1.0, 0.0, "4.1"), (0.0, 10.0, "5.1"), (-0.1, 0.0, "5.09"), (-1000.0, 0.0, "1")] {
        figure.nudge("guess", right, up);
        assert_eq!(figure.model().value("guess").unwrap(), guess);
    }
}

#[test]
fn a_link_brings_back_the_whole_state() {
    for query in STATES {
        let figure = proposal(query);
        assert_eq!(state(&figure), state(&proposal(&figure.query())), "{query}");
    }
    // In whatever order: the run is of the guess that the link names.
    assert_eq!(proposal("run=on&guess=7&predict=on").query(), "v=3&predict=on&guess=7&run=on");
    let mut figure = proposal(STATES[3]);
    assert_eq!(figure.load("seed=5"), []);
    assert_eq!(figure.query(), "v=3&seed=5");
}

#[test]
fn a_sharper_sensor_makes_one_sample_of_2_0_worth_more_and_a_blunt_one_hardly_more_than_one() {
    let worth = |query: &str| ratio(&proposal(query)).parse::<f64>().unwrap();
    assert!(worth("range-std=0.005") > worth(""));
    assert!(worth("range-std=0.5") < 2.0);
    let usual = proposal("").model().describe();
    for query in ["bearing-std=0.3", "odometry=2", "samples=4096"] {
        assert_ne!(proposal(query).model().describe(), usual, "{query}");
    }
}

#[test]
fn the_guess_is_asked_for_then_run_and_another_guess_starts_anew() {
    let mut figure = proposal("");
    assert!(scene(&figure, 800.0).handles.iter().all(|h| h.name != "guess"));
    figure.set("predict", "on").unwrap();
    figure.model_mut().settle();
    assert!(figure.model().describe().contains("There is no guess yet"));
    figure.drag("guess", 400.0, 0.0, 800.0);
    figure.model_mut().settle();
    assert!(figure.model().describe().contains("it has not been run"));
    let guess = figure.model().value("guess").unwrap();
    figure.set("run", "on").unwrap();
    figure.model_mut().settle();
    // What is run is what a reader gets who halves the noise: the same numbers, and the same samples.
    let half = proposal("range-std=0.025");
    assert_eq!(said(&figure, "the ratio is ", ";"), ratio(&half));
    assert_eq!(figure.model().series(), half.model().series());
    assert!(figure.model().describe().contains(&format!("the guess was {guess}: ")), "{}", figure.model().describe());
    figure.set("guess", &guess).unwrap();
    assert_eq!(figure.model().value("run").unwrap(), "on", "the same guess is no other try");
    figure.nudge("guess", 1.0, 0.0);
    figure.model_mut().settle();
    assert_eq!(figure.model().value("run").unwrap(), "off");
    assert!(figure.model().describe().contains("it has not been run"));
    // Who was not asked is asked, instead of being shown.
    figure.set("predict", "off").unwrap();
    figure.set("run", "on").unwrap();
    let value = |figure: &Figure, name| figure.model().value(name).unwrap();
    assert_eq!(["predict", "guess", "run"].map(|name| value(&figure, name)), ["on", "none", "off"]);
    // Who does not want to guess says so, and that is told apart.
    figure.set("run", "on").unwrap();
    figure.model_mut().settle();
    let outcome = figure.model().prediction().unwrap();
    assert!(outcome.waived && outcome.guess.is_none() && outcome.result.is_some(), "{outcome:?}");
    figure.set("predict", "off").unwrap();
    assert_eq!(value(&figure, "run"), "off");
}

#[test]
fn what_changes_no_sample_draws_none() {
    let mut figure = proposal("");
    let before = figure.model().series();
    figure.set("seed", &figure.model().value("seed").unwrap()).unwrap();
    assert_eq!(figure.model().pending(), 0);
    figure.set("predict", "on").unwrap();
    figure.model_mut().settle();
    assert_eq!(figure.model().series(), before);
    figure.set("seed", "1").unwrap();
    assert_eq!(figure.model().pending(), 1);
    figure.model_mut().settle();
    assert_ne!(figure.model().series(), before);
}

#[test]
fn what_is_lost_is_told_in_words() {
    let model = |query: &str| {
        let figure = proposal(query);
        let texts = scene(&figure, 800.0).marks;
        let words = texts.iter().filter_map(|m| if let Mark::Text(t) = m { Some(t.text.clone()) } else { None });
        (figure.model().describe(), words.collect::<Vec<_>>().join("\n"))
    };
    let (told, drawn) = model("landmarks=pair");
    assert!(told.contains("The hypothesis A is lost") && drawn.contains("2.0 has lost A"), "{told}\n{drawn}");
    let pair = proposal("landmarks=pair");
    assert!(said(&pair, "The motion prior has ", " %").parse::<f64>().unwrap() > 5.0, "{told}");
    assert_eq!(said(&pair, "samples there, the measurement-aware proposal ", " %"), "0", "{told}");
    let (told, drawn) = model("");
    assert!(!told.contains("lost") && !drawn.contains("lost"));
    assert!(drawn.contains("% of the posterior covered"));
}

#[test]
fn data_has_a_row_for_every_sample_and_what_is_said_follows_from_it() {
    let figure = proposal("samples=300");
    let export = figure.export();
    let (header, rows) = (export.header(), export.rows());
    assert_eq!(rows.len(), 300);
    assert!(rows.iter().all(|row| row.len() == header.len() && row.iter().all(Option::is_some)));
    let column = |name: &str| {
        let k = header.iter().position(|h| *h == name).unwrap();
        rows.iter().map(|row| row[k].unwrap()).collect::<Vec<f64>>()
    };
    let [motion, aware] = ["motion", "aware"].map(|proposal| {
        let squares: f64 = column(&format!("{proposal}_weight")).iter().map(|w| w * w).sum();
        let inside = column(&format!("{proposal}_inside")).iter().sum::<f64>() / 3.0;
        (1.0 / squares, fixed(1.0 / squares, 0), fixed(inside, 0))
    });
    assert_eq!(ratio(&figure), fixed(aware.0 / motion.0, 1));
    assert_eq!(said(&figure, "(N_eff ", ")"), format!("{} and {} of 300", aware.1, motion.1));
    assert_eq!(said(&figure, "); ", " of them"), format!("{} % and {} %", aware.2, motion.2));
}

#[test]
fn texts_fit_their_boxes_and_the_figure_and_cover_no_other() {
    for query in STATES {
        let figure = proposal(query);
        for width in [240.0, 300.0, 340.0, 380.0, 399.0, 400.0, 500.0, 639.0, 640.0, 700.0, 800.0, 1100.0, 1280.0] {
            assert_texts_fit(&scene(&figure, width), &format!("{query} at {width}"));
        }
    }
}

#[test]
fn samples_outlines_and_densities_stay_in_their_panels() {
    for query in STATES {
        let figure = proposal(query);
        for width in [300.0, 800.0] {
            let layout = Layout::new(width);
            let panels = layout.panels.map(|panel| panel.view);
            let below = panels.iter().map(Rect::bottom).fold(0.0, f64::max);
            let inside = |points: &[[f64; 2]]| {
                let grown = [panels[0], panels[1], layout.world[1]].map(|p| p.inset(-0.01));
                // To the right of the world, or above it, are the ratio and the legend.
                let free = |p: &[f64; 2]| p[1] > below && (p[0] > layout.world[1].right() || p[1] < layout.world[0].y);
                points.iter().all(|p| free(p) || grown.iter().any(|panel| panel.contains(*p)))
            };
            for mark in scene(&figure, width).marks {
                let fits = match &mark {
                    Mark::Lines { lines, .. } => lines.iter().all(|line| inside(line)),
                    Mark::Polygons { polygons, .. } => polygons.iter().all(|polygon| inside(polygon)),
                    Mark::Discs { centres, .. } => inside(centres),
                    Mark::Raster { area, .. } => area.y > below || panels.iter().any(|panel| panel.encloses(area)),
                    _ => true,
                };
                assert!(fits, "{query} at {width}: {mark:?}");
            }
        }
    }
}

#[test]
fn the_height_depends_on_the_width_only() {
    for width in [100.0, 340.0, 640.0, 1280.0] {
        for query in STATES {
            assert_eq!(proposal(query).height(width), ProposalView::height(width, &Panels::default()));
        }
    }
}

#[test]
fn no_size_makes_it_panic() {
    let mut figure = proposal(STATES[3]);
    for (width, height, dpr) in [(0, 0, 1.0), (1, 1, f64::NAN), (3, 4000, 0.0), (4000, 3, 1e300), (300, 200, -1.0)] {
        figure.paint(width, height, dpr, Default::default());
        assert!(figure.canvas().pixels().chunks_exact(4).all(|p| p[3] == 255));
    }
    for width in [f64::NAN, f64::INFINITY, 0.0, -5.0, 1e-300, 1e300] {
        figure.pick(1.0, 1.0, width);
        figure.drag("landmark", 1.0, 1.0, width);
        figure.height(width);
    }
}
