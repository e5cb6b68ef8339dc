//! Laws of the worked example, by its public face.

mod hands;

use crate::common::{figure, scene};
use fastslam_widgets::{
    figure::Figure,
    font,
    scene::{Mark, Rect},
};

fn example(query: &str) -> Figure {
    figure("fastslam-worked-example", query)
}

fn number(figure: &Figure, name: &str) -> f64 {
    figure.model().readouts().iter().find(|r| r.name == name).and_then(|r| r.value).unwrap()
}

fn text(figure: &Figure, name: &str) -> String {
    figure.model().readouts().into_iter().find(|r| r.name == name).unwrap().text
}

/// The ends of all ranges, one at a time and together, and numbers far from each other.
fn hostile() -> Vec<String> {
    let figure = example("");
    let specs: Vec<_> =
        figure.model().params().into_iter().filter(|s| !["all-steps", "row"].contains(&s.name)).collect();
    let at_end = |end: fn(f64, f64) -> f64| {
        let pair = |s: &fastslam_widgets::model::ParamSpec| {
            (s.name != "sigma-xy").then(|| format!("{}={}", s.name, end(s.min, s.max)))
        };
        specs.iter().filter_map(pair).collect::<Vec<_>>().join("&")
    };
    let singly =
        specs.iter().filter(|s| s.name != "sigma-xy").flat_map(|s| [s.min, s.max].map(|x| format!("{}={x}", s.name)));
    let more = [
        "x1=4&x2=4&y2=0.000000001",
        "sigma-xx=100&sigma-yy=100&sigma-xy=99.99999999999",
        "sigma-xx=0.000001&sigma-yy=100&sigma-xy=-0.0099999&x1=3.9999",
        "r1=0&r2=0&range-std=0.001&bearing-std=0.001",
        "x1=-99.123456&y1=-12.5&theta1=-3.1415926&x2=4.000001&y2=0.000001&sigma-xx=0.0000321&sigma-xy=-0.0000123456&bearing-std=0.00123",
    ];
    singly.chain([at_end(f64::min), at_end(f64::max)]).chain(more.map(String::from)).collect()
}

#[test]
fn the_worked_example_is_met_to_the_last_digit_shown() {
    let figure = example("");
    for (name, value) in [
        ("w1", 2.753_451_476_665),
        ("w2", 0.863_168_987_665),
        ("normalized1", 0.761_332_714_843),
        ("normalized2", 0.238_667_285_157),
        ("ess", 1.570_870_837_6),
        ("log_w1", 1.012_855_2),
        ("verdict", 0.0),
    ] {
        let tolerance = if name == "log_w1" { 1e-6 } else { 1e-9 };
        assert!((number(&figure, name) - value).abs() < tolerance, "{name}: {}", number(&figure, name));
    }
    let texts = ["w1", "normalized1", "ess", "verdict"].map(|name| text(&figure, name));
    assert_eq!(texts, ["2.753451", "0.7613327", "1.570871 of 2", "1.57 > 1: do not resample"]);
    assert!(
        figure.model().describe().contains("2.753") && figure.model().describe().contains("1.57 > 1: do not resample")
    );
}

#[test]
fn every_number_of_the_chain_is_exported() {
    let figure = example("");
    let data = serde_json::to_value(figure.export()).unwrap();
    for (slot, distance) in [0.29, 2.61].into_iter().enumerate() {
        let row = &data["steps"][slot];
        for (name, value) in [
            ("particle", slot as f64 + 1.0),
            ("expected_r_m", 4.0),
            ("h_phiy", 0.25),
            ("s_rr", 0.25),
            ("s_phiphi", 0.01),
            ("s_inverse_phiphi", 100.0),
            ("s_determinant", 0.0025),
            ("mahalanobis_squared", distance),
            ("k_xr", 0.84),
            ("k_yphi", 3.0),
            ("after_xx_m2", 0.0336),
            ("after_yy_m2", 0.03),
            ("resampled", 0.0),
        ] {
            assert!((row[name].as_f64().unwrap() - value).abs() < 1e-12, "{name}: {}", row[name]);
        }
        assert_eq!(row.as_object().unwrap().len(), data["columns"].as_object().unwrap().len());
    }
}

#[test]
fn equal_accounts_weigh_the_same_and_a_threshold_above_n_eff_resamples() {
    assert_eq!(number(&example("r2=4.1&phi2=0.05"), "ess"), 2.0);
    let figure = example("threshold=0.79");
    assert_eq!((number(&figure, "verdict"), text(&figure, "verdict").as_str()), (1.0, "1.57 < 1.58: resample"));
    // As many decimals as it takes to see which is larger.
    assert_eq!(text(&example("threshold=0.7854"), "verdict"), "1.5709 > 1.5708: do not resample");
    assert_eq!(text(&example("r2=4.1&phi2=0.05&threshold=1"), "verdict"), "2.00 ≥ 2: do not resample");
}

#[test]
fn a_covariance_that_is_none_is_refused_with_the_parameter_and_its_range() {
    let mut figure = example("sigma-xy=0.1");
    for (name, value, range) in [
        ("sigma-xy", "0.2", "between -0.1587 and 0.1587 m²"),
        ("sigma-xy", "-0.1588", "between -0.1587 and 0.1587 m²"),
        ("sigma-xx", "0.05", "more than 0.08333 m²"),
        ("sigma-yy", "0.01", "more than 0.04762 m²"),
    ] {
        let error = figure.set(name, value).unwrap_err();
        assert_eq!(error.parameter, name);
        assert!(error.message.contains(&format!("{name} = \"{value}\"")) && error.message.contains(range), "{error}");
        assert!(error.message.contains("positive definite"), "{error}");
        assert_eq!(figure.query(), "sigma-xy=0.1");
    }
    // Together they may change as one of them may not alone, whatever their order; and what is refused takes nothing else along.
    assert_eq!(figure.load("sigma-xy=-0.5&sigma-xx=1&sigma-yy=1"), []);
    let refused = figure.load("sigma-xy=0.7&r1=5&sigma-xx=0.5");
    assert_eq!(refused.iter().map(|e| e.parameter.as_str()).collect::<Vec<_>>(), ["sigma-xx", "sigma-xy"]);
    assert_eq!(figure.query(), "r1=5");
}

#[test]
fn a_link_brings_back_every_number() {
    let figure = example("");
    let specs: Vec<_> =
        figure.model().params().into_iter().filter(|s| !["all-steps", "row"].contains(&s.name)).collect();
    assert!(specs.iter().all(|s| !s.slider && s.default.parse::<f64>().is_ok()));
    let query: Vec<String> =
        specs.iter().enumerate().map(|(k, s)| format!("{}={}", s.name, 0.05 + 0.01 * k as f64)).collect();
    let query = query.join("&").replace("sigma-xy=0.18", "sigma-xy=0.123456789012345");
    let figure = example(&query);
    assert_eq!(example(&figure.query()).export().rows(), figure.export().rows());
    assert!(figure.query().contains("sigma-xy=0.123456789012345"), "{}", figure.query());
}

#[test]
fn no_input_gives_what_is_no_number() {
    for query in hostile() {
        let figure = example(&query);
        for readout in figure.model().readouts() {
            assert!(readout.value.is_some_and(f64::is_finite), "{query}: {readout:?}");
        }
        assert!(figure.export().rows().iter().flatten().all(Option::is_some), "{query}");
        for mark in scene(&figure, 400.0).marks {
            if let Mark::Text(text) = mark {
                assert!(!["NaN", "inf", "1e15"].iter().any(|bad| text.text.contains(bad)), "{query}: {text:?}");
            }
        }
    }
}

#[test]
fn texts_fit_the_figure_have_their_letters_and_cover_no_other() {
    let all_steps = hostile().into_iter().map(|query| query + "&all-steps=on");
    for query in hostile().into_iter().chain(all_steps).chain(["".into(), "threshold=0".into(), "threshold=1".into()]) {
        let figure = example(&query);
        for width in [240.0, 330.0, 340.0, 380.0, 519.0, 520.0, 699.0, 700.0, 800.0, 980.0] {
            let scene = scene(&figure, width);
            let bounds = Rect::new(0.0, 0.0, scene.width, scene.height);
            let mut inked: Vec<(Rect, &str)> = Vec::new();
            for mark in &scene.marks {
                let Mark::Text(text) = mark else { continue };
                assert!(bounds.encloses(&text.area), "{query} at {width}: {text:?}");
                assert!(!text.text.ends_with('…'), "{query} at {width}: {text:?} was shortened");
                assert!(text.text.chars().all(font::has), "{text:?}");
                let [x, y] = text.origin();
                // An accent's ink is the upper part of its box.
                let low = if ["^", "~"].contains(&text.text.as_str()) { 0.25 * text.size } else { 0.0 };
                let ink = Rect::new(x, y - 0.7 * text.size, text.width() - 1e-6, 0.7 * text.size - low);
                let touches =
                    |(other, words): &&(Rect, &str)| ink.overlaps(other) && !(low > 0.0 && words.ends_with(['z', 'w']));
                let other = inked.iter().find(touches);
                assert_eq!(other, None, "{query} at {width}: {:?} at {ink:?}", text.text);
                inked.push((ink, &text.text));
            }
        }
    }
}

#[test]
fn the_drawing_lies_in_its_frame() {
    for query in hostile().iter().map(String::as_str).chain(["", "x2=9&y2=-7&sigma-xy=0.1"]) {
        for width in [340.0, 980.0] {
            let scene = scene(&example(query), width);
            // All marks up to the frame that closes the drawing.
            let end = scene.marks.iter().position(|m| matches!(m, Mark::Frame { .. })).unwrap();
            let Mark::Frame { area, .. } = scene.marks[end] else { unreachable!() };
            for mark in &scene.marks[..end] {
                if let Mark::Lines { lines: points, .. } | Mark::Polygons { polygons: points, .. } = mark {
                    assert!(
                        points.iter().flatten().all(|p| area.encloses(&Rect::new(p[0], p[1], 0.0, 0.0))),
                        "{query} at {width}: {mark:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_height_depends_on_the_width_and_on_the_steps_shown_only() {
    for width in [100.0, 340.0, 519.0, 700.0, 1280.0] {
        let height = example("").height(width);
        assert!(hostile().iter().all(|query| example(query).height(width) == height));
        // But for the steps that a reader folds out.
        let all = example("all-steps=on").height(width);
        assert!(
            all > 1.3 * height
                && hostile().iter().all(|query| example(&(query.clone() + "&all-steps=on")).height(width) == all)
        );
    }
}

#[test]
fn every_step_takes_the_place_of_the_five_and_what_an_author_shows_stays() {
    let height = |query: &str, show: &str| {
        let mut figure = example(query);
        figure.show(show).unwrap();
        figure.height(728.0)
    };
    assert_eq!(height("", "steps"), height("all-steps=on", "steps"), "an author who asked for the chain has it");
    assert_eq!(height("all-steps=on", "five"), height("", "steps"));
    assert_eq!(height("all-steps=on", "plot"), height("", "plot"));
    assert!(height("", "five") < height("", "steps"));
    assert!(height("", "") < height("all-steps=on", ""));
}

/// Thick lines and discs that light something.
fn lit(figure: &Figure) -> usize {
    use fastslam_widgets::scene::Role;
    let count = |mark: &Mark| match mark {
        Mark::Lines { lines, width, role: Role::Accent, .. } if *width > 2.0 => lines.len(),
        Mark::Discs { centres, radius, role: Role::Accent } if *radius > 10.0 => centres.len(),
        _ => 0,
    };
    scene(figure, 800.0).marks.iter().map(count).sum()
}

#[test]
fn pointing_at_a_step_lights_what_enters_it_by_pointer_and_keys_and_changes_no_number() {
    let mut shown = example("");
    assert_eq!(lit(&shown), 0, "nothing is pointed at");
    let told = shown.model().narrate();
    let rows = |figure: &Figure| {
        let handle = scene(figure, 800.0).handles.into_iter().find(|handle| handle.name == "row").unwrap();
        (handle.hover.unwrap(), handle.text)
    };
    let area = rows(&shown).0;
    // S is the second of five rows.
    shown.drag("row", 500.0, area.y + 0.3 * area.h, 800.0);
    assert_eq!(shown.model().narrate(), "Covariance of ν: made of Σ, Q, x, μ.");
    assert_eq!(rows(&shown).1, shown.model().narrate(), "what is read out");
    // The ellipse of Σ, the noise at both sightings, of which the edge cuts one in two, μ, and both robots.
    assert_eq!(lit(&shown), 1 + 3 + 1 + 2);
    shown.nudge("row", 0.0, -1.0);
    assert!(shown.model().narrate().starts_with("Squared distance: made of ν, S"), "{}", shown.model().narrate());
    assert_eq!(lit(&shown), 2, "two rows");
    for _ in 0..9 {
        shown.nudge("row", 0.0, -1.0);
    }
    assert!(shown.model().narrate().starts_with("Landmark after"));
    assert_eq!(shown.readouts(), example("").readouts());
    for _ in 0..9 {
        shown.nudge("row", 0.0, 1.0);
    }
    assert_eq!((shown.model().narrate(), lit(&shown), shown.query()), (told, 0, example("").query()));
    // With every step in sight, what is named is what stands above.
    assert_eq!(example("all-steps=on&row=5").model().narrate(), "Covariance of ν: made of Σ, Q, H.");
}
