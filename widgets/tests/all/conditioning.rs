//! Laws of the figure of the graphical model, by its public face: what a page can do to it.

use crate::common::{assert_drawn_inside, assert_texts_fit, figure, scene, state};
use fastslam_widgets::{
    conditioning::Layout,
    figure::Figure,
    registry,
    scene::{Mark, Role, Scene, Shading},
    view::Layout as _,
};

/// In the state that a link of today names.
fn conditioning(query: &str) -> Figure {
    let query = query.trim_start_matches("?").trim_start_matches("v=2&");
    figure("fastslam-conditioning", &format!("v=2&{query}"))
}

fn value(figure: &Figure, name: &str) -> f64 {
    figure.model().readouts().into_iter().find(|r| r.name == name).unwrap().value.unwrap()
}

/// Arcs in the graph: curves as strong as a |ρ|. The samples of the legend are straight.
fn arcs(scene: &Scene) -> usize {
    let strong = |mark: &Mark| match mark {
        Mark::Lines { lines, role: Role::Level(_), .. } => lines.iter().filter(|line| line.len() > 2).count(),
        _ => 0,
    };
    scene.marks.iter().map(strong).sum()
}

/// Shades of the matrix, row by row: the largest raster.
fn shades(scene: &Scene) -> Vec<u8> {
    let rasters = scene.marks.iter().filter_map(|mark| match mark {
        Mark::Raster { cells, shading: Shading::Correlation, .. } => Some(cells.shades.clone()),
        _ => None,
    });
    rasters.max_by_key(Vec::len).unwrap()
}

#[test]
fn given_the_path_every_entry_outside_the_blocks_is_exactly_zero_and_every_arc_gone() {
    for n in [3, 7, 13, 24] {
        for rest in
            ["", "odometry=0.05", "odometry=3&range-std=0.01", "poses=12&step=5", "poses=2&step=2&range-std=0.5"]
        {
            let mut figure = conditioning(&format!("landmarks={n}&{rest}"));
            let seen = value(&figure, "seen") as usize;
            let free = scene(&figure, 800.0);
            assert_eq!(value(&figure, "off_block"), (4 * seen * (seen - 1)) as f64, "{n} {rest}");
            assert_eq!(arcs(&free), seen * (seen - 1) / 2, "{n} {rest}");
            let coupled = |scene: &Scene| {
                let off = |k: &usize| k / (2 * n) / 2 != k % (2 * n) / 2;
                let all = shades(scene);
                assert_eq!(all.len(), 4 * n * n);
                (0..all.len()).filter(off).filter(|&k| all[k] > 0).count()
            };
            assert_eq!(coupled(&free), 4 * seen * (seen - 1), "{n} {rest}");

            figure.set("condition", "on").unwrap();
            let given = scene(&figure, 800.0);
            for name in ["off_block", "largest", "mean", "rho"] {
                let known = figure.model().readouts().into_iter().find(|r| r.name == name).unwrap().value;
                assert!(known.is_none_or(|x| x == 0.0), "{n} {rest}: {name} is {known:?}");
            }
            assert_eq!((arcs(&given), coupled(&given)), (0, 0), "{n} {rest}");
            assert!(figure.model().describe().contains("0 of"), "{}", figure.model().describe());
        }
    }
}

#[test]
fn the_toggle_changes_what_is_known_and_back_again() {
    let mut figure = conditioning("");
    let (before, free) = (state(&figure), value(&figure, "largest_std"));
    figure.set("condition", "on").unwrap();
    assert!(value(&figure, "largest_std") < 0.5 * free);
    figure.set("condition", "off").unwrap();
    assert_eq!(state(&figure), before);
}

#[test]
fn the_counts_of_one_sighting_are_those_of_an_ekf_and_of_a_particle() {
    for n in 3..=24 {
        let figure = conditioning(&format!("landmarks={n}"));
        assert_eq!(value(&figure, "ekf"), f64::from((2 * n + 3) * (2 * n + 3)));
        assert_eq!(value(&figure, "fastslam"), 4.0);
    }
}

#[test]
fn landmarks_are_coupled_the_more_the_worse_the_odometry_is() {
    let means = [0.0, 0.25, 0.5, 1.0, 2.0, 3.0].map(|x| value(&conditioning(&format!("odometry={x}")), "mean"));
    assert!(means.windows(2).all(|pair| pair[0] < pair[1]), "{means:?}");
    assert!(means[0] < 1e-4, "{means:?}");
}

#[test]
fn hardly_any_noise_of_the_wheels_couples_as_many_entries_as_much_and_none_couples_none() {
    let usual = value(&conditioning(""), "off_block");
    assert!(usual > 0.0);
    assert_eq!(value(&conditioning("odometry=0.05"), "off_block"), usual);
    let exact = conditioning("odometry=0");
    let largest = exact.model().readouts().into_iter().find(|r| r.name == "largest").unwrap().text;
    assert_eq!((value(&exact, "off_block"), largest.as_str()), (0.0, "0"));
    assert!(exact.model().describe().contains("Wheels without error"), "{}", exact.model().describe());
}

#[test]
fn the_first_entry_is_of_two_landmarks_that_no_pose_saw_both() {
    let figure = conditioning("");
    assert!(figure.describe().ends_with("m1.y and m4.y: ρ = −0.39, though no pose saw both."));
}

#[test]
fn to_point_at_an_entry_is_to_set_its_row_and_column() {
    for (n, width) in [(3, 240.0), (7, 340.0), (12, 640.0), (24, 1280.0)] {
        let mut figure = conditioning(&format!("landmarks={n}"));
        let scene_width = scene(&figure, width).width;
        let area = Layout::new(scene_width).matrix;
        let cell = area.w / f64::from(2 * n);
        for (row, column) in (0..2 * n).flat_map(|row| (0..2 * n).map(move |column| (row, column))) {
            let at = |k: i32| (f64::from(k) + 0.5) * cell;
            let to = [area.x + at(column), area.y + at(row)].map(|c| c * width / scene_width);
            figure.drag("entry", to[0], to[1], width);
            let entry = ["row", "column"].map(|name| figure.model().value(name).unwrap());
            assert_eq!(entry, [row + 1, column + 1].map(|k| k.to_string()), "{n} at {width}");
            // The handle is where the pointer is, and stays inside of the area that follows it.
            let handle = &scene(&figure, width).handles[0];
            let [x, y] = handle.at;
            assert!((x - area.x - at(column)).abs() < 1e-9 && (y - area.y - at(row)).abs() < 1e-9);
            assert_eq!(handle.hover, Some(area));
        }
        figure.drag("entry", -50.0, 1e9, width);
        assert_eq!(
            [figure.model().value("row"), figure.model().value("column")],
            [Some((2 * n).to_string()), Some("1".into())]
        );
    }
}

#[test]
fn arrow_keys_move_the_entry_by_one_and_coarsely_by_ten_and_stop_at_the_edge() {
    let mut figure = conditioning("row=5&column=5");
    let mut to = |right, up| {
        figure.nudge("entry", right, up);
        ["row", "column"].map(|name| figure.model().value(name).unwrap().parse::<u32>().unwrap())
    };
    assert_eq!(to(1.0, 0.0), [5, 6]);
    assert_eq!(to(0.0, 1.0), [4, 6]);
    assert_eq!(to(-0.1, -0.1), [5, 5], "there is nothing between two entries");
    assert_eq!(to(0.0, -10.0), [14, 5]);
    assert_eq!(to(-10.0, 10.0), [4, 1]);
    assert_eq!(to(0.0, 0.0), [4, 1]);
}

#[test]
fn an_entry_is_named_with_its_value_in_the_picture_and_for_the_screen_reader() {
    let figure = conditioning("row=6&column=9");
    let handle = scene(&figure, 800.0).handles.remove(0);
    let rho = value(&figure, "rho");
    assert_eq!((handle.name, handle.value.to_bits()), ("entry", rho.to_bits()));
    assert_eq!(handle.text, format!("m3.y and m5.x: ρ = {}", format!("{rho:.2}").replace('-', "−")));
    assert!(figure.describe().contains(&handle.text));
    // Both landmarks are ringed and the arc between them is drawn once more.
    let accents = |query: &str| {
        let marks = scene(&conditioning(query), 800.0).marks;
        let count =
            |mark: &Mark| if let Mark::Lines { lines, role: Role::Accent, .. } = mark { lines.len() } else { 0 };
        marks.iter().map(count).sum::<usize>()
    };
    assert_eq!(["row=6&column=9", "row=6&column=9&condition=on", "row=6&column=5"].map(accents), [3, 2, 1]);
    let unseen = conditioning("step=1&row=2&column=13");
    assert!(scene(&unseen, 800.0).handles[0].text.ends_with("not seen yet"));
    assert_eq!(unseen.model().readouts().iter().find(|r| r.name == "rho").unwrap().value, None);
}

#[test]
fn a_link_brings_back_the_whole_state() {
    let query = "v=2&odometry=0.5&range-std=0.2&landmarks=9&poses=12&condition=on&step=11&row=18&column=17";
    let mut figure = conditioning(query);
    assert_eq!(figure.query(), query);
    assert_eq!(state(&figure), state(&conditioning(&format!("?{}", figure.query()))));
    assert_eq!(figure.load("landmarks=4"), []);
    assert_eq!(figure.query(), "v=2&landmarks=4");
    // Whatever was set in whatever order, the link says it.
    for (name, value) in [("poses", "3"), ("row", "8"), ("landmarks", "3"), ("poses", "12"), ("step", "0")] {
        figure.set(name, value).unwrap();
        assert_eq!(state(&figure), state(&conditioning(&figure.query())), "{name}={value}");
    }
}

#[test]
fn a_bad_link_is_told_of_and_the_rest_of_it_applied() {
    let mut figure = registry::figure("fastslam-conditioning").unwrap();
    let refused = figure.load("landmarks=99&poses=4&step=9&row=0&column=15&condition=perhaps&tempo=3");
    let messages: Vec<String> = refused.into_iter().map(|e| e.message).collect();
    assert_eq!(figure.query(), "v=2&poses=4&step=4");
    for part in [
        "landmarks = \"99\": must be a whole number from 3 to 24",
        "step = \"9\": must be a whole number from 0 to 4",
        "row = \"0\": must be a whole number from 1 to 14",
        "column = \"15\"",
        "condition = \"perhaps\": must be on or off",
        "tempo",
    ] {
        assert!(messages.iter().any(|m| m.contains(part)), "{part}: {messages:?}");
    }
    assert_eq!(messages.len(), 6);
}

#[test]
fn fewer_landmarks_or_poses_keep_the_step_and_the_entry_in_their_ranges() {
    let mut figure = conditioning("landmarks=24&poses=12&step=12&row=48&column=30");
    figure.set("landmarks", "5").unwrap();
    figure.set("poses", "3").unwrap();
    assert_eq!(figure.query(), "v=2&landmarks=5&poses=3&step=3&row=10&column=10");
    figure.model_mut().seek(u32::MAX);
    assert_eq!((figure.model().step(), figure.model().step_count()), (3, 3));
}

#[test]
fn a_step_back_shows_the_same_bits_as_the_way_forward() {
    let mut figure = conditioning("landmarks=10&step=0");
    let mut at = |step| {
        figure.model_mut().seek(step);
        state(&figure)
    };
    let forward: Vec<_> = (0..=8).map(&mut at).collect();
    for step in [7, 3, 3, 8, 0, 5] {
        assert_eq!(at(step), forward[step as usize], "step {step}");
    }
    let coupled: Vec<usize> = forward.iter().map(|(.., scene)| arcs(scene)).collect();
    assert!(coupled.windows(2).all(|pair| pair[0] <= pair[1]) && coupled[0] == 0 && coupled[8] == 45, "{coupled:?}");
}

#[test]
fn texts_fit_their_boxes_and_the_figure_and_cover_no_other() {
    for n in 3..=24 {
        for rest in ["", "condition=on&odometry=3", "poses=12&step=7&row=6&column=6"] {
            let figure = conditioning(&format!("landmarks={n}&{rest}"));
            for width in [240.0, 300.0, 320.0, 340.0, 380.0, 500.0, 719.0, 720.0, 800.0, 1280.0] {
                let scene = scene(&figure, width);
                let which = format!("{n} {rest} at {width}");
                let inked = assert_texts_fit(&scene, &which);
                let below = inked.iter().filter(|ink| Layout::new(scene.width).legend.overlaps(ink));
                assert!(below.count() >= 6, "{which}: the legend left its place");
            }
        }
    }
}

#[test]
fn nothing_is_drawn_outside_of_the_figure() {
    for query in ["odometry=3", "landmarks=24&poses=12&odometry=3&range-std=0.5&row=48&column=48", "row=1&column=14"] {
        for width in [240.0, 380.0, 1000.0] {
            assert_drawn_inside(&scene(&conditioning(query), width), &format!("{query} at {width}"));
        }
    }
}

#[test]
fn the_height_depends_on_the_width_only() {
    let (a, b) = (conditioning("landmarks=3&poses=2&step=0"), conditioning("landmarks=24&condition=on"));
    for width in [100.0, 340.0, 640.0, 1280.0] {
        assert_eq!(a.height(width), b.height(width));
        assert!(a.height(width) > 0.4 * width);
    }
}

#[test]
fn no_size_makes_it_panic() {
    for query in ["", "landmarks=24&poses=12&step=12&condition=on", "landmarks=3&poses=2&step=0"] {
        let mut figure = conditioning(query);
        for (width, height, dpr) in [(0, 0, 1.0), (1, 1, f64::NAN), (3, 4000, 0.0), (4000, 3, 1e300), (300, 200, -1.0)]
        {
            figure.paint(width, height, dpr, Default::default());
            assert!(figure.canvas().pixels().chunks_exact(4).all(|p| p[3] == 255));
        }
        for width in [f64::NAN, f64::INFINITY, 0.0, -5.0, 1e-300, 1e300] {
            figure.drag("entry", 1.0, 1.0, width);
            figure.height(width);
        }
    }
}

#[test]
fn data_has_a_row_for_every_pose_driven() {
    let figure = conditioning("step=6&condition=on");
    let export = figure.export();
    let (header, rows) = (export.header(), export.rows());
    assert_eq!(rows.len(), 7);
    assert!(rows[1..].iter().all(|row| row.len() == header.len() && row.iter().all(Option::is_some)), "{rows:?}");
    assert!(rows.iter().all(|row| row[6] == Some(0.0)), "given the path nothing is coupled");
    assert_eq!(serde_json::to_value(export).unwrap()["query"], "v=2&condition=on&step=6");
}
