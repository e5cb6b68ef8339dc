//! Laws of every figure in the registry, by its public face.

use crate::common::{assert_drawn_inside, assert_texts_fit, scene, state};
use fastslam_widgets::{
    model::Kind,
    paint::Theme,
    registry::{self, FIGURES},
    scene::{Handle, Rect, Role, Scene},
};

#[test]
fn every_parameter_refuses_what_is_out_of_range_and_stays_as_it_was() {
    for entry in FIGURES {
        let mut figure = registry::figure(entry.tag).unwrap();
        figure.model_mut().seek(3);
        figure.model_mut().settle();
        let before = state(&figure);
        for spec in figure.model().params() {
            let mut bad = vec!["nonsense".to_string(), "NaN".into(), "1e999".into(), "💥\n".repeat(50)];
            if matches!(spec.kind, Kind::Integer | Kind::Number) {
                bad.extend([(spec.min - 1.0).to_string(), (spec.max + 1.0).to_string(), String::new()]);
            }
            for value in bad {
                let error = figure.set(spec.name, &value).unwrap_err();
                assert_eq!(error.parameter, spec.name);
                assert!(error.message.contains(spec.name) && error.message.contains("must be"), "{error}");
                assert_eq!(error.message.lines().count(), 1, "{error}");
            }
        }
        let known = figure.model().params()[0].name;
        assert!(figure.set("colour", "red").unwrap_err().message.contains(known));
        assert_eq!(state(&figure), before);
        assert_eq!(figure.model().pending(), 0);
    }
}

#[test]
fn every_default_and_every_choice_is_accepted() {
    for entry in FIGURES {
        let mut figure = registry::figure(entry.tag).unwrap();
        for spec in figure.model().params() {
            assert_eq!(figure.model().value(spec.name).as_ref(), Some(&spec.default), "{}", spec.name);
            for value in spec.choices.iter().map(|c| c.value.as_str()).chain([spec.default.as_str()]) {
                figure.set(spec.name, value).unwrap();
                assert_eq!(figure.model().value(spec.name).as_deref(), Some(value), "{}", spec.name);
            }
        }
        assert_eq!(figure.query(), registry::figure(entry.tag).unwrap().query());
    }
}

/// What is pasted into a thousand pages keeps its meaning: these numbers never change.
#[test]
fn a_code_that_says_no_version_is_of_that_of_the_day_on_which_codes_began_to() {
    let said = [
        ("fastslam-conditioning", 2),
        ("fastslam-graph", 2),
        ("fastslam-lap", 8),
        ("fastslam-log", 3),
        ("fastslam-proposal", 3),
        ("fastslam-resampling", 3),
        ("fastslam-smoothing", 3),
        ("fastslam-universes", 2),
    ];
    for entry in FIGURES {
        let expected = said.iter().find(|(tag, _)| *tag == entry.tag).map_or(1, |(_, version)| *version);
        assert_eq!(registry::figure(entry.tag).unwrap().model().unsaid(), expected, "{}", entry.tag);
    }
}

/// As links do, but in silence.
#[test]
fn a_code_of_any_version_makes_the_figure_that_the_link_of_that_version_makes() {
    for entry in FIGURES {
        let mut figure = registry::figure(entry.tag).unwrap();
        let newest = figure.model().changes().len() + 1;
        for version in 1..=newest {
            let code = format!("v={version}");
            figure.load(&code);
            let (linked, mut by_code) = (figure.query(), registry::figure(entry.tag).unwrap());
            let meant = by_code.meant(&code).unwrap();
            assert_eq!(by_code.model_mut().load(&meant), [], "{} {code}", entry.tag);
            assert_eq!(by_code.query(), linked, "{} {code}", entry.tag);
        }
        let [unsaid, said] = ["", &format!("v={}", figure.model().unsaid())].map(|code| figure.meant(code).unwrap());
        assert_eq!(unsaid, said);
        assert_eq!(figure.meant("v=latest").unwrap(), []);
        assert!(figure.meant("v=0").unwrap_err().message.contains("latest"));
    }
}

/// The Python wheel makes a keyword argument of every parameter: `samples=64`.
#[test]
fn no_parameter_has_a_name_that_python_keeps_for_itself() {
    const KEYWORDS: &str = "and as assert async await break class continue def del elif else except finally for from \
                            global if import in is lambda nonlocal not or pass raise return try while with yield";
    for entry in FIGURES {
        for spec in registry::figure(entry.tag).unwrap().model().params() {
            assert!(!KEYWORDS.split(' ').any(|word| word == spec.name), "{} of {}", spec.name, entry.tag);
        }
    }
}

/// A page asks before the first bit of work is done, and between any two.
#[test]
fn every_figure_can_be_asked_and_drawn_while_it_is_still_at_work() {
    for entry in FIGURES {
        let mut figure = registry::figure(entry.tag).unwrap();
        figure.model_mut().seek(u32::MAX);
        for _ in 0..20 {
            let model = figure.model();
            assert!(!model.readouts().is_empty() && !model.describe().is_empty(), "{}", entry.tag);
            let columns = model.series().columns.len();
            assert!(model.series().rows.iter().all(|row| row.len() == columns), "{}", entry.tag);
            scene(&figure, 700.0);
            if figure.model().pending() == 0 {
                break;
            }
            figure.model_mut().work();
        }
    }
}

#[test]
fn the_first_pixel_is_paper_because_the_page_takes_its_colour() {
    for entry in FIGURES {
        for (width, dpr) in [(340, 1.0), (1000, 2.0)] {
            let mut figure = registry::figure(entry.tag).unwrap();
            figure.paint(width, width, dpr, Theme::Dark);
            assert_eq!(figure.canvas().pixels()[..3], Theme::Dark.color(Role::Paper), "{} at {width}", entry.tag);
        }
    }
}

#[test]
fn handles_have_names_of_their_own_and_lie_in_the_picture_with_words() {
    for entry in FIGURES {
        let figure = registry::figure(entry.tag).unwrap();
        for width in [240.0, 340.0, 800.0] {
            let Scene { width, height, handles, .. } = scene(&figure, width);
            let picture = Rect::new(0.0, 0.0, width, height);
            for (k, Handle { name, title, at, axes, value, text, hover }) in handles.iter().enumerate() {
                assert!(handles[..k].iter().all(|other| other.name != *name), "{name}");
                assert!(picture.contains(*at) && hover.is_none_or(|area| picture.encloses(&area)), "{name} at {at:?}");
                assert!(!title.is_empty() && !text.is_empty() && value.is_finite(), "{name}");
                // What a page tells of each direction is the parameter's.
                let known = figure.model().params();
                assert!(matches!(axes.len(), 1 | 2), "{name}");
                assert!(axes.iter().all(|axis| known.iter().any(|spec| spec.name == *axis)), "{name} moves {axes:?}");
            }
        }
    }
}

#[test]
fn no_drag_and_no_nudge_makes_it_panic_or_leaves_a_range() {
    for entry in FIGURES {
        let mut figure = registry::figure(entry.tag).unwrap();
        let names: Vec<&str> = scene(&figure, 800.0).handles.iter().map(|h| h.name).chain(["no-such-handle"]).collect();
        for name in names {
            for [x, y] in [[-1e300, 1e300], [0.0, 0.0], [1e9, -1e9], [f64::NAN, 1.0], [400.0, 200.0]] {
                for width in [100.0, 800.0] {
                    figure.drag(name, x, y, width);
                    figure.nudge(name, x, y);
                    let values = figure.values().0;
                    for (spec, (name, value)) in figure.model().params().iter().zip(values) {
                        assert!(spec.check(&value).is_ok(), "{name} = {value}");
                    }
                }
            }
        }
    }
}

#[test]
fn every_panel_can_be_shown_alone_and_whole() {
    for entry in FIGURES {
        let mut figure = registry::figure(entry.tag).unwrap();
        figure.model_mut().seek(12);
        figure.model_mut().settle();
        for panel in entry.panels {
            figure.show(panel).unwrap();
            for width in [240.0, 340.0, 800.0, 1280.0] {
                let scene = scene(&figure, width);
                let which = format!("{} {panel} at {width}", entry.tag);
                assert_texts_fit(&scene, &which);
                assert_drawn_inside(&scene, &which);
                assert!(!scene.marks.is_empty() && figure.height(width) <= scene.height, "{which}");
                let picture = Rect::new(0.0, 0.0, scene.width, scene.height);
                assert!(scene.regions.iter().all(|region| picture.encloses(&region.area)), "{which}");
                assert!(scene.handles.iter().all(|handle| picture.contains(handle.at)), "{which}");
            }
        }
        figure.show("all").unwrap();
        assert_eq!(figure.height(800.0), (entry.height)(800.0));
        let error = figure.show("weather").unwrap_err();
        assert!(error.message.contains("show = \"weather\": must be all"), "{error}");
        assert!(entry.panels.iter().all(|panel| error.message.contains(panel)), "{error}");
        assert!(!figure.query().contains("show"), "what is shown is for the page to say");
    }
}

/// Where nothing moves, the first step shows nothing of what the figure is about: empty charts, and universes that have not parted.
#[test]
fn every_figure_with_a_timeline_has_a_step_that_tells_and_pasted_codes_of_before_open_where_they_did() {
    for entry in FIGURES {
        let mut figure = registry::figure(entry.tag).unwrap();
        figure.model_mut().settle();
        let (opening, last) = (figure.model().step(), figure.model().step_count());
        let step = figure.telling("v=latest").min(last);
        assert_eq!(step > 0, last > 0, "{}: step {step} of {last}", entry.tag);
        let (unsaid, first) = (figure.telling(""), figure.telling("v=1"));
        if opening > 0 {
            assert_eq!(opening, step, "{} opens elsewhere", entry.tag);
        } else if last > 0 {
            assert_eq!([unsaid, first], [0, 0], "{}: a code of before opened at the first step", entry.tag);
            let (before, at_rest) = (figure.describe(), scene(&figure, 800.0));
            figure.model_mut().seek(step);
            figure.model_mut().settle();
            assert!(figure.describe() != before && scene(&figure, 800.0) != at_rest, "{}", entry.tag);
            let (from, words) = figure.model().watch().expect("what plays has an end to be watched");
            assert!(from < last && !words.is_empty(), "{}: from {from} of {last}", entry.tag);
        }
    }
}
