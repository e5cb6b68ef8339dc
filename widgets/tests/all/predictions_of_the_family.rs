//! Predictions of the figures of graph, EM mapping and smoothing: nothing leaks before a guess, what comes is what would have come without
//! one, and another question takes the answer away.

use crate::common::{assert_drawn_inside, assert_texts_fit, figure, scene, state};
use fastslam_widgets::figure::Figure;

struct Asked {
    tag: &'static str,
    /// Small ones, and what of them the answer could be read from.
    query: &'static str,
    hidden: &'static [&'static str],
    /// The readout that is asked for, at the last step.
    answer: &'static str,
    /// A guess, and the one that an arrow key makes of it.
    guess: &'static str,
    nudged: &'static str,
    /// What makes another question, and what does not.
    other: [&'static str; 2],
    same: [&'static str; 2],
}

const ALL: [Asked; 3] = [
    Asked {
        tag: "fastslam-smoothing",
        query: "particles=4",
        hidden: &["distinct_after", "first_after", "early_after", "spread"],
        answer: "first_after",
        guess: "7",
        nudged: "8",
        other: ["seed", "2"],
        same: ["at", "30"],
    },
    Asked {
        tag: "fastslam-graph",
        query: "wrong=on&universes=2",
        hidden: &[],
        answer: "rms",
        guess: "0.5",
        nudged: "0.55",
        other: ["repair", "robust"],
        same: ["truth", "off"],
    },
    Asked {
        tag: "fastslam-em",
        query: "mark-3=5.2&particles=50",
        hidden: &["entropy", "put_down", "again_em"],
        answer: "put_down",
        guess: "4.2",
        nudged: "4.3",
        other: ["mark-3", "6.4"],
        same: ["guess", "4"],
    },
];

/// At the last step, and nobody is asked.
fn at_end(tag: &str, query: &str) -> Figure {
    let mut figure = figure(tag, query);
    figure.model_mut().seek(u32::MAX);
    figure.model_mut().settle();
    figure
}

fn value(figure: &Figure, name: &str) -> Option<f64> {
    figure.model().readouts().into_iter().find(|readout| readout.name == name).unwrap().value
}

fn set(figure: &mut Figure, name: &str, value: &str) {
    figure.set(name, value).unwrap();
    figure.model_mut().settle();
}

fn parameter(figure: &Figure, name: &str) -> String {
    figure.values().0.into_iter().find(|(other, _)| *other == name).unwrap().1
}

fn rows(figure: &Figure) -> Vec<Vec<f64>> {
    figure.model().series().rows
}

/// Whoever is asked sees the same, whatever step a link or a scrub asks for, and whatever has been computed by then.
#[test]
fn while_a_reader_is_asked_nothing_of_the_answer_is_shown_told_or_written() {
    for Asked { tag, query, hidden, answer, .. } in ALL {
        let open = at_end(tag, query);
        let result = value(&open, answer).unwrap();
        let mut asked = figure(tag, &format!("{query}&predict=on"));
        let begun = (scene(&asked, 800.0), asked.describe());
        for name in hidden {
            assert!(value(&open, name).is_some() && value(&asked, name).is_none(), "{tag}: {name}");
        }
        // A count may be any other number's too; a length is not.
        let told = asked.model().readouts().into_iter().filter_map(|readout| readout.value);
        let written = rows(&asked).into_iter().flatten().chain(told).any(|x| x == result);
        assert!(!written || result.fract() == 0.0, "{tag}");
        let known = |figure: &Figure| rows(figure).iter().flatten().filter(|x| x.is_finite()).count();
        assert!(known(&asked) < known(&open), "{tag}: {}", known(&asked));
        assert!(
            asked.model().curves().concat().len() < open.model().curves().concat().len(),
            "{tag}: a pin would keep the curve"
        );
        assert_eq!(asked.model().step_count(), 0, "{tag}: nothing to play");
        let outcome = asked.model().prediction().unwrap();
        assert_eq!((outcome.guess, outcome.result, outcome.shown, outcome.waived), (None, None, false, false));
        asked.model_mut().seek(5);
        asked.model_mut().settle();
        assert_eq!((scene(&asked, 800.0), asked.describe()), begun, "{tag}");
        assert!(asked.describe().contains("Place your guess"), "{tag}: {}", asked.describe());
        // The pinned run of the same settings is kept back too.
        let curves = open.model().curves();
        let marks = scene(&asked, 800.0).marks.len();
        asked.model_mut().haunt(curves.clone());
        let haunted = scene(&asked, 800.0).marks.len();
        // A smoother's record is no secret, and of its own legend a mark and a word.
        assert!(haunted <= marks + 4, "{tag}: {marks} {haunted}");
    }
}

#[test]
fn a_guess_is_placed_moved_and_judged_and_goes_with_its_question() {
    for Asked { tag, query, answer, guess, nudged, other, same, .. } in ALL {
        let last = at_end(tag, query);
        let result = value(&last, answer).unwrap();
        let mut asked = figure(tag, &format!("{query}&predict=on"));
        set(&mut asked, "guess", guess);
        assert_eq!(asked.model().prediction().unwrap().result, None, "{tag}");
        asked.nudge("guess", 0.0, 1.0);
        assert_eq!(parameter(&asked, "guess"), nudged, "{tag}");
        set(&mut asked, "run", "on");
        let outcome = asked.model().prediction().unwrap();
        assert_eq!((outcome.result, outcome.waived), (Some(result), false), "{tag}");
        assert_eq!(asked.model().step(), asked.model().step_count(), "{tag}: who has guessed sees the end");
        assert_eq!(value(&asked, answer), value(&last, answer), "{tag}");
        assert!(asked.describe().contains("the guess"), "{tag}: {}", asked.describe());
        let link = asked.query();
        assert_eq!(state(&figure(tag, &link)), state(&asked), "{tag}: {link}");
        // What is looked at is no other question; another guess is another try.
        set(&mut asked, same[0], same[1]);
        let tried = asked.model().prediction().unwrap();
        assert_eq!(tried.result.is_some(), same[0] != "guess", "{tag}");
        set(&mut asked, "run", "on");
        set(&mut asked, other[0], other[1]);
        assert_eq!(["predict", "guess", "run"].map(|name| parameter(&asked, name)), ["on", "none", "off"], "{tag}");
        set(&mut asked, "run", "on");
        let outcome = asked.model().prediction().unwrap();
        assert!(outcome.waived && outcome.result.is_some() && outcome.result != Some(result), "{tag}: {outcome:?}");
        assert!(asked.describe().contains("no guess was made"), "{tag}: {}", asked.describe());
        assert!(last.model().prediction().is_none());
    }
}

/// Along the whole of its chart, and back to where the pointer is.
#[test]
fn a_guess_is_dragged_to_where_the_pointer_is() {
    for Asked { tag, query, .. } in ALL {
        let mut asked = figure(tag, &format!("{query}&predict=on"));
        for width in [340.0, 700.0, 1100.0] {
            let grip =
                |figure: &Figure| scene(figure, width).handles.iter().find(|handle| handle.name == "guess").unwrap().at;
            let [x, y] = grip(&asked);
            asked.drag("guess", x, y + 9.0, width);
            let [_, now] = grip(&asked);
            assert!((now - y - 9.0).abs() < 3.5, "{tag} at {width}: {y} {now}");
            asked.drag("guess", x, -1e9, width);
            let high: f64 = parameter(&asked, "guess").parse().unwrap();
            asked.drag("guess", x, f64::NAN, width);
            asked.drag("guess", x, 1e9, width);
            let low: f64 = parameter(&asked, "guess").parse().unwrap();
            assert!(low < high, "{tag}: {low} {high}");
            asked.set("guess", "none").unwrap();
        }
    }
}

#[test]
fn words_of_guesses_fit_at_every_width() {
    for Asked { tag, query, guess, .. } in ALL {
        for asked in [
            "predict=on".to_string(),
            format!("predict=on&guess={guess}"),
            format!("predict=on&guess={guess}&run=on"),
            "predict=on&run=on".into(),
        ] {
            let figure = figure(tag, &format!("{query}&{asked}"));
            for width in (300..1200).step_by(60).map(f64::from) {
                let (scene, which) = (scene(&figure, width), format!("{tag}?{asked} at {width}"));
                assert_drawn_inside(&scene, &which);
                assert_texts_fit(&scene, &which);
            }
        }
    }
}
