//! Laws of the figure of resampling, by its public face: what a page can do to it.

mod hands;

use crate::common::{assert_drawn_inside, assert_texts_fit, figure, scene, state};
use fastslam_lab::experiment::resampling::RIGHT_WITHIN;
use fastslam_widgets::{
    decimal::fixed,
    figure::Figure,
    model::{Model, Parameters},
    panels::Panels,
    registry,
    resampling::{Layout, Parts, ResamplingModel, ResamplingView},
    scene::{Mark, Point, Rect, Role, Scene, Text},
    view::{Layout as _, View},
};

fn resampling(query: &str) -> Figure {
    figure("fastslam-resampling", query)
}

fn value(figure: &Figure, name: &str) -> f64 {
    figure.model().readouts().into_iter().find(|r| r.name == name).unwrap().value.unwrap()
}

/// Where the parts stand at this width, in the loop of ambiguity or not.
fn parts(width: f64, wings: bool) -> Parts {
    Layout::new(width).courses[usize::from(wings)].clone()
}

fn texts(scene: &Scene) -> Vec<&Text> {
    scene.marks.iter().filter_map(|m| if let Mark::Text(t) = m { Some(t) } else { None }).collect()
}

/// Lines of a role in an area.
fn strands(scene: &Scene, role: Role, area: &Rect) -> Vec<Vec<Point>> {
    let of = |mark: &Mark| match mark {
        Mark::Lines { lines, role: r, .. } if *r == role => lines.clone(),
        _ => Vec::new(),
    };
    let inside = |line: &Vec<Point>| line.iter().all(|[x, y]| area.encloses(&Rect::new(*x, *y, 0.0, 0.0)));
    scene.marks.iter().flat_map(of).filter(inside).collect()
}

const POLICIES: [&str; 3] = ["never", "always", "selective"];

/// The colour of a policy.
fn role(policy: &str) -> Role {
    Role::Variant(POLICIES.iter().position(|name| *name == policy).unwrap() as u8)
}

#[test]
fn a_step_back_shows_the_same_bits_as_the_way_forward() {
    for query in ["particles=5&seed=9", "wings=on&particles=12"] {
        let mut figure = resampling(query);
        let mut at = |step| {
            figure.model_mut().seek(step);
            figure.model_mut().settle();
            state(&figure)
        };
        let forward: Vec<_> = (0..=9).map(&mut at).collect();
        for step in [8, 5, 0, 9, 3, 3] {
            assert_eq!(at(step), forward[step as usize], "{query}, step {step}");
        }
    }
}

#[test]
fn the_tree_has_every_edge_once_and_the_living_ones_are_those_still_needed() {
    for query in
        ["step=23", "particles=31&step=17&scheme=multinomial", "wings=on&step=90", "wings=on&particles=4&step=104"]
    {
        let mut figure = resampling(query);
        let m: f64 = figure.model().value("particles").unwrap().parse().unwrap();
        for (policy, width) in POLICIES.into_iter().zip([380.0, 1000.0, 728.0]) {
            figure.set("policy", policy).unwrap();
            let scene = scene(&figure, width);
            let area = &parts(width, query.contains("wings")).charts[3];
            let step = area.w / f64::from(figure.model().step_count());
            let edges = |role| {
                let lines = strands(&scene, role, area);
                let length = |line: &Vec<Point>| (line[line.len() - 1][0] - line[0][0]) / step;
                lines.iter().map(length).sum::<f64>()
            };
            let dead = scene.marks.iter().find_map(|mark| match mark {
                Mark::Lines { role: role @ Role::Level(_), .. } => Some(*role),
                _ => None,
            });
            let (living, dead) = (edges(role(policy)), edges(dead.unwrap()));
            let all = m * f64::from(figure.model().step());
            assert!((living + dead - all).abs() < 1e-6, "{query} {policy}: {living} + {dead} of {all}");
            let needed = value(&figure, &format!("{policy}_tree")) - value(&figure, &format!("{policy}_lineage"));
            assert!((living - needed).abs() < 1e-6, "{query} {policy}: {living} of {needed}");
        }
    }
}

#[test]
fn the_common_ancestor_is_ringed_and_its_step_told_where_there_is_one() {
    for query in ["step=2", "step=40", "particles=64&step=12", "wings=on&step=40"] {
        let mut model = ResamplingModel::default();
        let link: Vec<(String, String)> =
            query.split('&').filter_map(|p| p.split_once('=')).map(|(n, v)| (n.into(), v.into())).collect();
        assert_eq!(model.configure(&link), []);
        model.settle();
        for (policy, name) in POLICIES.into_iter().enumerate() {
            assert_eq!(model.configure(&[("policy".into(), name.into())]), []);
            let scene = ResamplingView.scene(&model, &Panels::default(), 1000.0, 0.0);
            let axis = parts(1000.0, query.contains("wings")).axis;
            let coalescence = model.now(policy).report.descent.coalescence();
            let told = texts(&scene).into_iter().find(|t| axis.encloses(&t.area) && t.role == Role::Ink);
            assert_eq!(told.map(|t| t.text.clone()), coalescence.map(|step| format!("step {step}")), "{query}");
        }
    }
}

#[test]
fn at_threshold_nothing_the_third_filter_is_the_first() {
    for course in ["", "wings=on&"] {
        let figure = resampling(&format!("{course}threshold=0&step=30"));
        for name in ["ess", "lineage", "error_best", "tree"] {
            let [never, .., selective] = POLICIES.map(|policy| value(&figure, &format!("{policy}_{name}")).to_bits());
            assert_eq!(never, selective, "{course} {name}");
        }
    }
}

#[test]
fn what_the_cursor_reads_stands_beside_the_charts_once() {
    for query in ["step=70", "step=70&cursor=31&policy=never", "wings=on&step=101&policy=always"] {
        let figure = resampling(query);
        for width in [352.0, 728.0, 1112.0] {
            let scene = scene(&figure, width);
            let parts = parts(width, query.contains("wings"));
            for policy in POLICIES {
                let read = |name: &str| value(&figure, &format!("{policy}_{name}"));
                let metres = |x: f64| fixed(x, if x < 10.0 { 2 } else { 1 });
                for (area, number) in [
                    (parts.values[0], fixed(read("ess"), 1)),
                    (parts.values[2], fixed(read("lineage"), 0)),
                    (parts.values[3], metres(read("error_best"))),
                ] {
                    let beside = |t: &&Text| t.area.x >= area.x && t.area.y > area.y - 20.0 && t.area.y < area.bottom();
                    let said: Vec<_> =
                        texts(&scene).into_iter().filter(beside).filter(|t| t.role == role(policy)).collect();
                    let written = said.iter().filter(|t| t.text.split(' ').next_back() == Some(&number)).count();
                    assert!(written >= 1, "{query} at {width}: {policy} {number} of {said:?}");
                }
            }
        }
        let again = figure.readouts().into_iter().filter(|readout| !readout.drawn).map(|readout| readout.name);
        assert_eq!(again.collect::<Vec<_>>(), ["never_tree", "always_tree", "selective_tree"]);
    }
}

#[test]
fn what_is_read_at_a_step_does_not_depend_on_how_far_time_went() {
    for query in ["particles=6", "wings=on"] {
        let numbers = |rest: &str| {
            let readouts = resampling(&format!("{query}&{rest}")).model().readouts();
            readouts.into_iter().map(|r| (r.name, r.value.map(f64::to_bits))).collect::<Vec<_>>()
        };
        assert_eq!(numbers("step=70&cursor=41"), numbers("step=41"), "{query}");
    }
}

#[test]
fn a_link_brings_back_the_whole_state() {
    let query = "v=4&wings=on&particles=7&seed=77&threshold=0.25&odometry=0.5&range=1.5&scheme=residual&policy=never&back=4&step=80&cursor=66";
    let mut figure = resampling(query);
    assert_eq!(figure.query(), query);
    assert_eq!(state(&figure), state(&resampling(&format!("?{}", figure.query()))));
    assert_eq!(figure.load("v=4&cursor=3&step=9"), []);
    figure.model_mut().settle();
    assert_eq!(figure.query(), "v=4&step=9&cursor=3");
    for (name, value) in
        [("particles", "5"), ("back", "2"), ("wings", "on"), ("step", "100"), ("cursor", "now"), ("wings", "off")]
    {
        figure.set(name, value).unwrap();
        figure.model_mut().settle();
        assert_eq!(state(&figure), state(&resampling(&figure.query())), "{name}={value}");
    }
}

#[test]
fn a_bad_link_is_told_of_and_the_rest_of_it_applied() {
    let mut figure = registry::figure("fastslam-resampling").unwrap();
    let refused = figure.load("v=4&particles=65&step=91&cursor=-2&scheme=magic&tempo=3&back=0&seed=4&policy=neff");
    let messages: Vec<String> = refused.into_iter().map(|e| e.message).collect();
    assert_eq!(figure.query(), "v=4&seed=4");
    for part in [
        "particles = \"65\": must be a whole number from 4 to 64",
        "step = \"91\": must be a whole number from 0 to 90",
        "cursor = \"-2\"",
        "scheme = \"magic\": must be one of usual, systematic, stratified, multinomial, residual",
        "back = \"0\": must be a whole number from 1 to 60 steps",
        "policy = \"neff\": must be one of never, always, selective",
        "tempo",
    ] {
        assert!(messages.iter().any(|m| m.contains(part)), "{part}: {messages:?}");
    }
    assert_eq!(messages.len(), 7);
}

#[test]
fn a_shorter_course_keeps_the_step_in_its_range_and_a_new_setup_is_simulated_up_to_it() {
    let mut figure = resampling("wings=on&particles=4&step=104&cursor=100");
    figure.set("wings", "off").unwrap();
    assert_eq!((figure.model().step(), figure.model().pending()), (0, 90));
    let mut worked = || {
        figure.model_mut().work();
        (figure.model().step(), figure.model().pending())
    };
    assert_eq!([worked(), worked(), worked()], [(0, 90), (0, 90), (1, 89)], "a step is made filter by filter");
    figure.model_mut().settle();
    assert_eq!(state(&figure), state(&resampling("particles=4&step=90")));
    figure.set("back", "3").unwrap();
    assert_eq!(figure.model().pending(), 0, "what changes no number is not simulated");
}

#[test]
fn the_right_wing_is_told_where_there_are_two_and_lost_in_words() {
    let mut lost = 0;
    for seed in 1..=6 {
        let figure = resampling(&format!("wings=on&seed={seed}&step=100"));
        for width in [380.0, 1000.0] {
            let scene = scene(&figure, width);
            for (tab, policy) in parts(width, true).tabs.iter().zip(POLICIES) {
                let right = value(&figure, &format!("{policy}_right"));
                let said = texts(&scene).into_iter().find(|t| tab.encloses(&t.area) && t.text.contains("right"));
                let Text { text: said, role, .. } = said.unwrap();
                assert_eq!(*role == Role::Extinct, right == 0.0, "{said}");
                assert!(said == "right wing lost" || said.contains(&format!("{right} of 16")), "{said}");
                lost += u32::from(said == "right wing lost");
            }
        }
    }
    assert!(lost > 0, "a course on which something is lost");
    let before = resampling("wings=on&step=20");
    assert!(texts(&scene(&before, 1000.0)).iter().any(|t| t.text == "not lost yet"));
    assert!(before.model().readouts().iter().filter(|r| r.name.ends_with("_right")).all(|r| r.value.is_none()));
    let lap = resampling("step=5");
    assert!(lap.model().readouts().iter().all(|r| !r.name.ends_with("_right")));
    assert_eq!(["never_resampled", "always_resampled"].map(|name| value(&lap, name)), [0.0, 5.0]);
}

#[test]
fn a_job_can_be_cut_anywhere_and_counts_what_the_figure_shows() {
    let setting = "particles=8&threshold=0.4";
    let whole = registry::count("wings", setting, 3..9).unwrap();
    let pieces =
        [registry::count("wings", setting, 3..4).unwrap(), registry::count("wings", setting, 4..9).unwrap()].concat();
    assert_eq!(whole, pieces);
    assert!(registry::count("wings", setting, 5..5).unwrap().is_empty());
    // The same as in the figure, whatever its view and its seed.
    assert_eq!(
        whole,
        registry::count("wings", &format!("?wings=off&seed=3&{setting}&step=5&cursor=now"), 3..9).unwrap()
    );
    for row in whole {
        let mut model = ResamplingModel::default();
        let link = [("wings", "on"), ("particles", "8"), ("threshold", "0.4"), ("seed", &row[0].to_string())];
        assert_eq!(model.configure(&link.map(|(n, v)| (n.into(), v.into()))), []);
        let evidence = model.run().evidence_at().unwrap();
        for (name, step) in [("alive", evidence - 1), ("settled", model.step_count())] {
            model.seek(step);
            model.settle();
            for (policy, columns) in [[1, 2], [3, 4], [5, 6]].iter().enumerate() {
                let report = &model.now(policy).report;
                let (column, yes) = match name {
                    "alive" => (columns[0], report.right.unwrap() > 0),
                    _ => (columns[1], report.error_best < RIGHT_WITHIN),
                };
                assert_eq!(row[column] == 1.0, yes, "seed {} {name} {policy}", row[0]);
            }
        }
    }
}

#[test]
fn a_job_refuses_what_it_does_not_know() {
    assert!(registry::count("weather", "", 0..1).unwrap_err().message.contains("one of laps, wings"));
    for (setting, part) in [("particles=99", "from 4 to 64"), ("tempo=3", "tempo"), ("scheme=", "systematic")] {
        let message = registry::count("wings", setting, 0..1).unwrap_err().message;
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn texts_fit_their_boxes_and_the_figure_and_cover_no_other() {
    for query in [
        "",
        "step=3",
        "particles=64&step=25&scheme=stratified&back=60&threshold=0.85",
        "wings=on&particles=64&step=104&odometry=2&range=4",
        "wings=on&step=96&cursor=63",
        "step=90&odometry=2&range=4&particles=4",
        "step=40&threshold=0.123456&policy=never",
        "wings=on&step=85&threshold=1&policy=always",
    ] {
        let figure = resampling(query);
        for width in
            [240.0, 320.0, 340.0, 352.0, 380.0, 460.0, 559.0, 560.0, 588.0, 728.0, 804.0, 930.0, 941.0, 1112.0, 1280.0]
        {
            let scene = scene(&figure, width);
            let inked = assert_texts_fit(&scene, &format!("{query} at {width}"));
            let layout = Layout::new(scene.width);
            let last = inked.iter().map(Rect::bottom).fold(0.0, f64::max);
            assert!(last <= layout.legend.bottom() + 1e-9, "{query} at {width}: the legend left its place");
        }
    }
}

#[test]
fn every_line_has_its_name_at_the_widths_that_pages_have() {
    for query in ["step=88&odometry=2&range=4", "wings=on&step=101&policy=always"] {
        let figure = resampling(query);
        for width in [320.0, 322.0, 352.0, 588.0, 616.0, 693.0, 728.0, 804.0, 1112.0] {
            let scene = scene(&figure, width);
            for name in ["threshold", "resampled", "10 back: ", "weighted mean ", "lives on", "died out"] {
                assert!(texts(&scene).iter().any(|t| t.text.starts_with(name)), "{query} at {width}: {name}");
            }
        }
    }
}

#[test]
fn nothing_is_drawn_outside_of_the_figure() {
    for query in ["wings=on&particles=20&step=104&odometry=2&range=4", "step=90&odometry=2&range=4&particles=4"] {
        for width in [240.0, 380.0, 1000.0] {
            assert_drawn_inside(&scene(&resampling(query), width), &format!("{query} at {width}"));
        }
    }
}

#[test]
fn the_height_depends_on_the_width_only() {
    let (a, b) = (resampling("particles=4"), resampling("wings=on&particles=64&step=12"));
    for width in [100.0, 340.0, 640.0, 1280.0] {
        assert_eq!(a.height(width), b.height(width));
        assert!(a.height(width) > 0.4 * width);
    }
}

#[test]
fn no_size_makes_it_panic() {
    let mut figure = resampling("wings=on&particles=9&step=70");
    for (width, height, dpr) in [(0, 0, 1.0), (1, 1, f64::NAN), (3, 4000, 0.0), (4000, 3, 1e300), (300, 200, -1.0)] {
        figure.paint(width, height, dpr, Default::default());
        assert!(figure.canvas().pixels().chunks_exact(4).all(|p| p[3] == 255));
    }
    for width in [f64::NAN, f64::INFINITY, 0.0, -5.0, 1e-300, 1e300] {
        figure.drag("cursor", 1.0, 1.0, width);
        figure.height(width);
    }
}

#[test]
fn data_has_a_row_for_every_step_so_far() {
    let figure = resampling("particles=4&step=6&back=2");
    let export = figure.export();
    let (header, rows) = (export.header(), export.rows());
    assert_eq!((rows.len(), header.len()), (7, 31));
    let known =
        |row: &Vec<Option<f64>>| header.iter().zip(row).all(|(name, x)| x.is_some() != name.ends_with("_right"));
    assert!(rows.iter().all(known), "{rows:?}");
    let resampled = header.iter().position(|name| *name == "always_resampled").unwrap();
    let resampled: f64 = rows.iter().filter_map(|row| row[resampled]).sum();
    assert_eq!(resampled, 6.0);
}
