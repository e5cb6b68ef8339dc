//! Laws of the lap's figure, by its public face: what a page can do to it.

use crate::common::{assert_texts_fit, figure, scene, state};
use fastslam_lab::{
    baseline::pose_graph::Repair,
    experiment::{graph::GraphRun, lap::LapSetup, numbers::LapCell, table::rms_best},
};
use fastslam_widgets::{
    figure::Figure,
    lap::{LapModel, LapView, Layout},
    model::{Model, Parameters, Tells},
    panels::Panels,
    registry,
    scene::{Mark, Role, SHARES, Shading},
    view::{Layout as _, View},
};

fn lap(query: &str) -> Figure {
    figure("fastslam-lap", query)
}

#[test]
fn the_core_takes_the_ends_of_every_range() {
    for query in [
        "universes=1",
        "universes=256&odometry=0&range-std=0.01",
        "seed=4294967295&odometry=2&range-std=0.3&threshold=1",
    ] {
        lap(query);
    }
}

#[test]
fn a_step_back_shows_the_same_bits_as_the_way_forward() {
    for query in ["universes=5&seed=9", "universes=200&proposal=motion&matcher=cell", "v=13&policy=always"] {
        let mut figure = lap(query);
        let mut forward = Vec::new();
        for step in 0..=7 {
            figure.model_mut().seek(step);
            figure.model_mut().settle();
            forward.push(state(&figure));
        }
        for step in [6, 5, 0, 7, 3, 4, 1, 1] {
            figure.model_mut().seek(step);
            figure.model_mut().settle();
            assert_eq!(state(&figure), forward[step as usize], "{query}, step {step}");
        }
    }
}

#[test]
fn a_link_brings_back_the_whole_state() {
    let mut figure =
        lap("v=13&universes=9&seed=77&policy=always&scheme=residual&threshold=0.25&step=6&universe=4&truth=on");
    assert_eq!(
        figure.query(),
        "v=13&universes=9&seed=77&policy=always&threshold=0.25&scheme=residual&step=6&universe=4&overlay=off&truth=on"
    );
    let other = lap(&format!("?{}", figure.query()));
    assert_eq!(state(&figure), state(&other));
    // A link is the whole state: what it does not name is the default again.
    assert_eq!(figure.load("v=13&seed=5"), []);
    assert_eq!(figure.query(), "v=13&seed=5");
}

#[test]
fn a_bad_link_is_told_of_and_the_rest_of_it_applied() {
    let mut figure = registry::figure("fastslam-lap").unwrap();
    let messages: Vec<String> = figure
        .load("v=13&universes=999&seed=5&tempo=3&universe=12&proposal=magic&&=&%zz=%")
        .into_iter()
        .map(|e| e.message)
        .collect();
    assert_eq!(figure.query(), "v=13&seed=5&universe=12&overlay=off");
    for part in [
        "tempo",
        "universes = \"999\": must be a whole number from 1 to 256",
        "proposal = \"magic\": must be one of aware, motion",
    ] {
        assert!(messages.iter().any(|m| m.contains(part)), "{part}: {messages:?}");
    }
    // A universe that another setting of the same link does away with.
    let messages = figure.load("v=13&universe=12&universes=8");
    assert_eq!(messages.len(), 1);
    assert!(messages[0].message.contains("from -1 to 7"), "{messages:?}");
    assert_eq!(figure.query(), "v=13&universes=8");
}

#[test]
fn the_course_says_how_many_steps_there_are() {
    let mut figure = lap("universes=2&proposal=motion&matcher=cell&course=ring&step=110");
    assert_eq!((figure.model().step(), figure.model().step_count()), (110, 110));
    // The apartment's lap is shorter: the step asked for becomes its last one.
    figure.set("course", "apartment").unwrap();
    assert_eq!((figure.model().pending(), figure.model().step_count()), (90, 90));
    let messages = figure.load("course=apartment&step=91");
    assert!(messages[0].message.contains("from 0 to 90"), "{messages:?}");
    assert!(figure.load("course=moon")[0].message.contains("must be one of rooms, apartment, ring"));
    let step = |query| lap(query).params().iter().find(|spec| spec.name == "step").unwrap().max;
    assert_eq!([step("course=apartment"), step("course=ring")], [90.0, 110.0]);
}

#[test]
fn a_new_setup_keeps_the_step_and_is_simulated_up_to_it() {
    let mut figure = lap("universes=3&step=5");
    figure.set("seed", "8").unwrap();
    assert_eq!((figure.model().step(), figure.model().pending()), (0, 5));
    figure.model_mut().work();
    assert_eq!((figure.model().step(), figure.model().pending()), (1, 4));
    figure.model_mut().settle();
    assert_eq!(state(&figure), state(&lap("universes=3&seed=8&step=5")));
    // What changes no number is not simulated.
    figure.set("truth", "on").unwrap();
    figure.set("seed", "8").unwrap();
    assert_eq!(figure.model().pending(), 0);
    figure.model_mut().seek(u32::MAX);
    assert_eq!(figure.model().value("step").unwrap(), figure.model().step_count().to_string());
}

#[test]
fn a_click_on_a_tile_chooses_its_universe_and_another_lets_go() {
    let mut figure = lap("universes=12&step=2");
    for width in [200.0, 340.0, 800.0] {
        let scene = scene(&figure, width);
        let region = scene.regions.iter().find(|r| r.target == 7).unwrap();
        let scale = width / scene.width;
        let [x, y] = region.area.centre().map(|c| c * scale);
        assert!(figure.pick(x, y, width));
        assert_eq!(figure.model().value("universe").unwrap(), "7");
        assert!(figure.model().describe().contains("universe 7"));
        assert!(figure.pick(x, y, width));
        assert_eq!(figure.model().value("universe").unwrap(), "best");
        assert!(!figure.pick(-1.0, f64::NAN, width));
    }
    figure.set("universe", "11").unwrap();
    figure.set("universes", "4").unwrap();
    assert_eq!(figure.model().value("universe").unwrap(), "best", "there is no universe 11 any more");
}

#[test]
fn extinction_is_told_in_words_marks_and_data() {
    let mut model = LapModel::default();
    assert_eq!(model.configure(&[("policy".into(), "always".into())]), []);
    model.seek(4);
    model.settle();
    let extinct = model.extinct();
    assert!(!extinct.is_empty() && extinct.len() < 16);
    let told = format!("{} of 16 died out", extinct.len());
    assert!(model.describe().contains(&told), "{}", model.describe());
    let scene = LapView.scene(&model, &Panels::default(), 800.0, 0.0);
    let texts: Vec<&str> =
        scene.marks.iter().filter_map(|m| if let Mark::Text(t) = m { Some(t.text.as_str()) } else { None }).collect();
    assert!(texts.contains(&format!("Resampled: {told}").as_str()), "{texts:?}");
    let copies = texts.iter().filter(|t| t.starts_with("← ")).count();
    assert!(copies > extinct.len(), "a slot whose universe died holds a copy, and the legend shows one");
    let series = model.series();
    let died_out = series.columns.iter().position(|column| column.name == "died_out").unwrap();
    assert_eq!(series.rows.last().unwrap()[died_out], extinct.len() as f64);
}

#[test]
fn texts_fit_their_boxes_and_the_figure_and_cover_no_other() {
    for query in [
        "universes=1&step=1",
        "step=2&truth=on&raw=on",
        "v=13&step=85&truth=on&raw=on",
        "universes=100&seed=4294967295&step=2&policy=always",
    ] {
        let figure = lap(query);
        for width in [240.0, 300.0, 340.0, 380.0, 500.0, 639.0, 640.0, 700.0, 800.0, 1280.0] {
            assert_texts_fit(&scene(&figure, width), &format!("{query} at {width}"));
        }
    }
}

#[test]
fn tiles_are_disjoint_inside_the_figure_and_readable_for_every_number_of_universes() {
    for count in 1..=256 {
        let figure = lap(&format!("universes={count}&proposal=motion&matcher=cell"));
        for width in [240.0, 340.0, 800.0, 1600.0] {
            let scene = scene(&figure, width);
            assert_eq!(scene.regions.len(), count.min(16));
            let mosaic = Layout::new(width).mosaic;
            for (k, region) in scene.regions.iter().enumerate() {
                assert!(mosaic.encloses(&region.area), "{count} at {width}");
                assert!(region.area.w >= 60.0, "{count} at {width}");
                assert!(
                    scene.regions[..k].iter().all(|other| !other.area.overlaps(&region.area)),
                    "{count} at {width}"
                );
            }
        }
    }
}

#[test]
fn the_height_depends_on_the_width_only() {
    let (a, b) = (lap("universes=1"), lap("v=13&universes=256&proposal=motion&step=1&truth=on&raw=on"));
    for width in [100.0, 340.0, 640.0, 1280.0] {
        assert_eq!(a.height(width), b.height(width));
        assert!(a.height(width) > 0.4 * width);
    }
}

#[test]
fn no_size_makes_it_panic() {
    let mut figure = lap("universes=3&step=1&truth=on&raw=on");
    for (width, height, dpr) in [(0, 0, 1.0), (1, 1, f64::NAN), (3, 4000, 0.0), (4000, 3, 1e300), (300, 200, -1.0)] {
        figure.paint(width, height, dpr, Default::default());
        assert!(figure.canvas().pixels().chunks_exact(4).all(|p| p[3] == 255));
    }
    for width in [f64::NAN, f64::INFINITY, 0.0, -5.0, 1e-300, 1e300] {
        figure.pick(1.0, 1.0, width);
        figure.height(width);
    }
}

#[test]
fn data_has_a_row_for_every_step_so_far() {
    let figure = lap("v=13&universes=4&step=6");
    let export = figure.export();
    let (header, rows) = (export.header(), export.rows());
    assert_eq!(rows.len(), 7);
    assert!(rows.iter().all(|row| row.len() == header.len() && row.iter().all(Option::is_some)), "{rows:?}");
    let data = serde_json::to_value(export).unwrap();
    assert_eq!(data["query"], "v=13&universes=4&step=6");
    assert_eq!(data["steps"][6]["step"], 6.0);
    assert_eq!(data["columns"].as_object().unwrap().len(), header.len());
}

/// What the page's button asks for is what the chapter prints.
#[test]
fn a_cell_of_the_lap_table_is_the_job_of_its_link() {
    for cell in LapCell::all().filter(|cell| cell.particles == 4) {
        let link =
            format!("course=apartment&odometry=1&universes=4&proposal={}&matcher={}", cell.proposal, cell.matcher);
        let errors = [1, 2].map(|seed| vec![seed as f64, rms_best(&cell.setup(seed)).unwrap()]);
        assert_eq!(registry::count("laps", &link, 1..3).unwrap(), errors, "{link}");
    }
    let refused = |link| registry::count("laps", link, 1..2).unwrap_err().parameter;
    assert_eq!([refused("universes=257"), refused("universe=0&wings=on")], ["universes", "wings"]);
}

#[test]
fn the_cell_of_the_pose_graph_is_the_job_of_its_link() {
    let errors = [1, 2].map(|seed| {
        let run = GraphRun::of(&LapSetup { seed, ..LapSetup::default() }, Repair::LeastSquares).unwrap();
        vec![seed as f64, run.rms_after]
    });
    assert_eq!(registry::count("graphs", "course=apartment&odometry=1", 1..3).unwrap(), errors);
    // What the figure asks besides makes no difference, and what it cannot mean is refused.
    let link = "course=apartment&odometry=1&seed=9&wrong=on&loops=off&start=matches";
    assert_eq!(registry::count("graphs", link, 2..3).unwrap(), errors[1..]);
    assert_ne!(registry::count("graphs", "course=ring&odometry=1", 1..3).unwrap(), errors);
    assert_eq!(registry::count("graphs", "odometry=3", 1..2).unwrap_err().parameter, "odometry");
}

#[test]
fn links_of_before_open_where_they_opened() {
    // The apartment, with one universe large; then the ring.
    let first = "v=13&seed=5&odometry=1&weight=old-map-at-draw&course=apartment&overlay=off";
    assert_eq!(lap("seed=5").query(), first);
    assert_eq!(lap("v=9&universes=8").query(), "v=13&universes=8&seed=9&odometry=1&range-std=0.1&course=ring");
    assert_eq!(lap("v=13&seed=5").query(), "v=13&seed=5");
    assert_eq!(lap("").model().value("course").unwrap(), "rooms", "nothing was asked");
}

#[test]
fn all_universes_are_shown_at_once_until_one_is_picked_and_again_when_it_is_let_go() {
    let mut model = LapModel::default();
    assert!(model.overlaid());
    model.pick(7);
    assert!(!model.overlaid() && model.selected() == 7);
    model.pick(7);
    assert!(model.overlaid());
    // What the tick says is so: a chosen one takes it away, and the tick lets go of the chosen one.
    let overlay = |model: &LapModel| model.value("overlay").unwrap();
    model.pick(3);
    assert_eq!((overlay(&model).as_str(), model.overlaid()), ("off", false));
    model.configure(&[("overlay".into(), "on".into())]);
    assert!(model.overlaid() && model.value("universe").as_deref() == Some("best"));
    model.configure(&[("universe".into(), "5".into())]);
    assert_eq!((overlay(&model).as_str(), model.selected()), ("off", 5));
    model.configure(&[("universe".into(), "best".into()), ("overlay".into(), "off".into())]);
    assert!(!model.overlaid() && model.value("universe").as_deref() == Some("best"));
    model.pick(2);
    model.pick(2);
    assert!(!model.overlaid(), "as it was before one was chosen");
}

/// What the reader must see when the loop closes: how far the universes are apart, slow motion, who died, and that it goes on.
#[test]
fn the_closing_of_the_loop_is_slow_and_counts_who_dies() {
    let mut model = LapModel::default();
    let mut seen = Vec::new();
    for step in 0..=model.step_count() {
        model.seek(step);
        model.settle();
        assert_eq!(model.pace() < 1.0, (79..=86).contains(&step), "step {step}");
        seen.push((model.spread(), model.died_in_closing(), model.describe()));
    }
    assert!(seen[79].0 > 0.5 && seen[86].0 < 0.1, "{} m and {} m", seen[79].0, seen[86].0);
    assert!(seen[..80].iter().all(|(_, dead, told)| *dead == 0 && !told.contains("loop")));
    assert!(seen.windows(2).all(|pair| pair[0].1 <= pair[1].1), "who is dead stays dead");
    let dead = seen[86].1;
    assert!(dead >= 8 && seen[110].1 == dead, "{dead} of 16");
    assert!(seen[86].2.contains(&format!("The loop closes: {dead} of 16 have died out since.")), "{}", seen[86].2);
    assert!(seen[87].2.contains(&format!("When the loop closed, {dead} of 16 died out.")), "{}", seen[87].2);
    // In the apartment nothing closes.
    let apartment = lap("universes=2&step=70");
    assert_eq!(apartment.model().pace(), 1.0);
}

/// The overlay shows all robots, and those of the universes that died out fade in three steps.
#[test]
fn the_dead_fade_and_the_living_are_all_shown() {
    let mut model = LapModel::default();
    let robots = |model: &LapModel, wanted: Role| {
        let scene = LapView.scene(model, &Panels::named("map", Layout::PANELS).unwrap(), 600.0, 0.0);
        let of_role = |mark: &Mark| matches!(mark, Mark::Polygons { role, .. } if *role == wanted);
        scene.marks.iter().filter(|mark| of_role(mark)).count()
    };
    let faded = [255, 150, 80].map(Role::Fading);
    // The first step after the closing that resamples.
    let closed = (84..90).find(|step| {
        model.seek(*step);
        model.settle();
        !model.extinct().is_empty()
    });
    let (closed, dead) = (closed.unwrap(), model.extinct().len());
    // One more is in the legend.
    assert_eq!(robots(&model, Role::Path), 16 + 1);
    for (age, role) in faded.into_iter().enumerate() {
        model.seek(closed + age as u32);
        model.settle();
        assert_eq!(robots(&model, role), dead, "{age} steps later");
    }
}

/// Sixteen buildings that nobody chooses among are sixteen in the picture of all: by weight it was the one that the last scans fit.
#[test]
fn where_nothing_resamples_a_picture_of_all_universes_is_of_all_of_them() {
    let figure = lap("v=13&seed=3&odometry=1&proposal=motion&policy=never&course=apartment&step=80");
    let scene = scene(&figure, 800.0);
    let map = scene.marks.iter().find_map(|mark| match mark {
        Mark::Raster { cells, shading: Shading::Share, .. } => Some(&cells.shades),
        _ => None,
    });
    let walls: Vec<u8> = map.unwrap().iter().copied().filter(|shade| *shade > SHARES).collect();
    let in_all = walls.iter().filter(|shade| **shade == u8::MAX).count();
    assert!(walls.len() > 500 && in_all * 10 < walls.len(), "{in_all} of {}", walls.len());
}
