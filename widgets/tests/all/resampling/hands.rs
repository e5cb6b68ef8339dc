//! What hands do to the figure of resampling: the cursor, the threshold, and the choice of a policy.

use super::{POLICIES, parts, resampling, scene, state, texts};
use fastslam_widgets::{figure::Figure, font::Weight, scene::Rect};

/// The step that is read.
fn read(figure: &Figure) -> f64 {
    scene(figure, 800.0).handles[0].value
}

#[test]
fn to_point_at_a_step_is_to_read_it_in_every_chart() {
    let mut figure = resampling("particles=4&step=60");
    let last = figure.model().step_count();
    for width in [240.0, 380.0, 559.0, 560.0, 1280.0] {
        let seen = scene(&figure, width);
        let over = seen.handles[0].hover.unwrap();
        let charts = parts(seen.width, false).charts;
        for chart in charts {
            assert!(over.encloses(&chart), "{width}");
            for step in [0, 1, 17, 59, 60, 75] {
                let x = chart.x + chart.w * f64::from(step) / f64::from(last);
                let at = [x, chart.centre()[1]].map(|c| c * width / seen.width);
                figure.drag("cursor", at[0], at[1], width);
                let (at, word) = (read(&figure), figure.model().value("cursor").unwrap());
                assert_eq!(at, f64::from(step.min(60)), "{width}");
                assert_eq!(word, if step < 60 { step.to_string() } else { "now".into() }, "the newest is followed");
            }
        }
        figure.drag("cursor", -1e9, 0.0, width);
        assert_eq!(read(&figure), 0.0);
    }
}

#[test]
fn the_threshold_is_dragged_up_and_down_by_its_line_and_moved_by_arrow_keys() {
    let mut figure = resampling("particles=4&step=12");
    let share = |figure: &Figure| figure.model().value("threshold").unwrap();
    for (width, wings) in [(240.0, "off"), (380.0, "on"), (728.0, "off"), (1280.0, "on")] {
        figure.set("wings", wings).unwrap();
        figure.model_mut().settle();
        let at = |figure: &Figure| {
            let seen = scene(figure, width);
            let handle = seen.handles.iter().find(|handle| handle.name == "threshold").unwrap();
            (handle.at, handle.value, width / seen.width)
        };
        let chart = parts(scene(&figure, width).width, wings == "on").charts[0];
        for (wanted, found) in [(0.3, "0.3"), (0.96, "0.95"), (1.0, "1"), (-3.0, "0"), (7.0, "1"), (0.5, "0.5")] {
            let ([x, _], _, scale) = at(&figure);
            let y = chart.bottom() - wanted * chart.h;
            figure.drag("threshold", x * scale, y * scale, width);
            assert_eq!(share(&figure), found, "{wanted} at {width}");
            let ([_, y], value, _) = at(&figure);
            assert!((chart.bottom() - y - value * chart.h).abs() < 1e-9, "the handle stays at its line");
        }
        let ([_, y], _, scale) = at(&figure);
        figure.drag("threshold", 1e6, y * scale, width);
        assert_eq!(share(&figure), "0.5", "sideways it does not move");
    }
    let mut by = |right, up| {
        figure.nudge("threshold", right, up);
        share(&figure)
    };
    assert_eq!([by(0.0, 1.0), by(0.0, -2.0), by(1.0, 0.0), by(0.0, 0.1)], ["0.55", "0.45", "0.5", "0.505"]);
    assert_eq!([by(0.0, 100.0), by(0.0, -100.0)], ["1", "0"]);
    // The filters are those of the threshold, and the tree is of the policy as before.
    figure.model_mut().settle();
    figure.compare(false);
    assert_eq!(state(&figure), state(&resampling(&figure.query())));
}

#[test]
fn a_click_on_a_map_or_a_value_chooses_its_policy_and_nothing_but_the_view_changes() {
    for query in ["step=20", "wings=on&step=80&cursor=75"] {
        let mut figure = resampling(query);
        for width in [352.0, 728.0, 1112.0] {
            for policy in [0, 1, 2, 1] {
                let [numbers, rows] = [figure.model().readouts().len(), figure.export().rows().len()];
                let parts = parts(width, query.contains("wings"));
                let [x, y] = parts.tabs[policy].centre();
                assert!(figure.pick(x, y, width), "{query} at {width}");
                assert_eq!(figure.model().value("policy").unwrap(), POLICIES[policy]);
                assert_eq!([figure.model().readouts().len(), figure.export().rows().len()], [numbers, rows]);
                let seen = scene(&figure, width);
                for (k, region) in seen.regions.iter().enumerate() {
                    let apart = seen.regions[..k].iter().all(|other| !other.area.overlaps(&region.area));
                    assert!(apart, "{query} at {width}: {region:?}");
                }
                let strong = |place: &Rect| {
                    texts(&seen).into_iter().any(|t| place.encloses(&t.area) && t.weight == Weight::SemiBold)
                };
                assert!(strong(&parts.tabs[policy]), "its name is written strongly");
                // Its map, and a value of another one.
                if parts.maps.len() == 3 {
                    let [x, y] = parts.maps[(policy + 1) % 3].centre();
                    assert!(figure.pick(x, y, width));
                    assert_eq!(figure.model().value("policy").unwrap(), POLICIES[(policy + 1) % 3]);
                }
                let Rect { x, y, .. } = scene(&figure, width).regions.last().unwrap().area;
                assert!(figure.pick(x + 3.0, y + 3.0, width));
            }
            let [x, y] = parts(width, query.contains("wings")).charts[1].centre();
            assert!(!figure.pick(x, y, width), "the charts are the cursor's");
        }
    }
}

#[test]
fn arrow_keys_move_the_cursor_and_time_takes_it_along() {
    let mut figure = resampling("particles=4&step=30");
    let mut by = |steps| {
        figure.nudge("cursor", steps, 0.0);
        figure.model().value("cursor").unwrap()
    };
    assert_eq!(["29", "30"], [by(-1.0), "30".into()]);
    assert_eq!(by(-10.0), "19");
    assert_eq!(by(0.1), "20", "there is nothing between two steps");
    assert_eq!(by(-100.0), "0");
    assert_eq!(by(1000.0), "now");
    assert_eq!(by(-3.0), "27");
    let handle = scene(&figure, 800.0).handles.remove(0);
    assert_eq!(handle.value, 27.0);
    assert!(handle.text.starts_with("step 27: never N_eff ") && figure.model().describe().starts_with("Step 27 "));
    figure.model_mut().seek(31);
    figure.model_mut().settle();
    assert_eq!((figure.model().value("cursor").unwrap(), read(&figure)), ("now".into(), 31.0));
}
