//! Lengths, angles and noises have their unit wherever a reader meets one: beside a slider, in a readout, in a refusal, in a sentence, in the
//! picture.
//!
//! This has caught a goal that told an odometry noise of 0.05 without saying that it is a factor.

use crate::common::{figure, scene};
use crate::words::lines;
use fastslam_widgets::{
    figure::Figure,
    model::Kind,
    registry::{self, FIGURES},
    scene::{Mark, Scene},
};

const LANGUAGES: [&str; 2] = ["en", "de"];

/// Numbers with decimals that are of nothing: shares of one, correlations, effective numbers, and factors by which a map loses samples.
const PURE: &[&str] = &["temper", "rho", "largest", "mean", "normalized1", "normalized2", "verdict", "doors"];

/// What a noise may be in.
const UNITS: &[&str] = &["m", "cm", "mm", "rad", "×", "%"];

/// Widths at which pictures use their short and their long words \[css px\].
const WIDTHS: [f64; 4] = [352.0, 600.0, 832.0, 1366.0];

fn speak(figure: &mut Figure, language: &str) {
    figure.set_words(&if language == "en" { String::new() } else { lines(language) });
    figure.set_decimal_comma(language == "de");
}

/// The first name of a noise in a text that is followed by a number without a unit.
fn bare_noise(text: &str) -> Option<&str> {
    let of_number = |c: char| c.is_ascii_digit() || ".,–−".contains(c);
    for name in ["σ", "noise", "rauschen"] {
        for (at, _) in text.match_indices(name) {
            // After an index, a word between, or nothing.
            let rest = text[at + name.len()..].trim_start_matches(['_', 'r', 'φ', ' ', '\u{a0}', '=', ':']);
            let rest = ["of ", "von ", "is ", "ist "].iter().fold(rest, |rest, word| rest.trim_start_matches(word));
            if !rest.starts_with(|c: char| c.is_ascii_digit()) {
                continue;
            }
            let unit = rest.trim_start_matches(of_number).trim_start_matches([' ', '\u{a0}']);
            let unit = unit.split(|c: char| !c.is_alphabetic() && !"×%".contains(c)).next().unwrap_or_default();
            if !UNITS.contains(&unit) {
                return Some(&text[at..]);
            }
        }
    }
    None
}

#[test]
fn a_noise_without_unit_is_found_and_one_with_unit_is_not() {
    for bare in ["σ 0.05", "range noise σ_r = 0,3", "bei Odometrierauschen 0,05", "noise of 0.1, then"] {
        assert!(bare_noise(bare).is_some(), "{bare}");
    }
    for whole in ["σ 5 cm", "range noise 0.1 m?", "σ_r", "Odometrierauschen 0,05 ×", "noise, its 90 %", "2 σ"] {
        assert_eq!(bare_noise(whole), None, "{whole}");
    }
}

#[test]
fn every_parameter_and_readout_that_is_measured_has_a_unit_and_a_refusal_says_it() {
    for entry in FIGURES {
        let mut figure = registry::figure(entry.tag).unwrap();
        figure.model_mut().settle();
        for language in LANGUAGES {
            speak(&mut figure, language);
            for spec in figure.params() {
                // In whole steps goes what is counted.
                if !matches!(spec.kind, Kind::Number) || spec.step.fract() == 0.0 {
                    continue;
                }
                let which = format!("{} {} {language}", entry.tag, spec.name);
                assert_eq!(spec.unit.is_empty(), PURE.contains(&spec.name), "{which}: {:?}", spec.unit);
                let refused = figure.set(spec.name, &(spec.max + 1.0).to_string()).unwrap_err().message;
                assert!(refused.ends_with(spec.unit), "{which}: {refused}");
            }
            for readout in figure.readouts() {
                // A number out of so many is one of a count, as an effective number of particles is.
                let counted =
                    readout.name.ends_with("ess") || [" of ", " von "].iter().any(|of| readout.text.contains(of));
                if readout.text.contains(['.', ',']) && !counted && readout.unit.is_empty() {
                    assert!(
                        PURE.contains(&readout.name),
                        "{} {} {language}: {:?}",
                        entry.tag,
                        readout.name,
                        readout.text
                    );
                }
            }
        }
    }
}

/// All that a figure says in this state, but for its controls.
fn said(figure: &Figure) -> Vec<String> {
    let mut all = vec![figure.describe()];
    all.extend(figure.chips().into_iter().flat_map(|chip| [chip.title.to_string(), chip.goal, chip.said]));
    for width in WIDTHS {
        let Scene { marks, handles, .. } = scene(figure, width);
        all.extend(
            marks.into_iter().filter_map(|mark| if let Mark::Text(text) = mark { Some(text.text) } else { None }),
        );
        all.extend(handles.into_iter().map(|handle| format!("{} {}", handle.title, handle.text)));
    }
    all
}

#[test]
fn no_noise_is_told_without_its_unit_in_the_state_of_any_chip() {
    let of_figure = |tag: &'static str| {
        let chips = registry::figure(tag).unwrap().chips();
        let states = chips.iter().map(|chip| (chip.name, chip.query.as_str())).chain([("opening", "")]);
        let mut wrong = Vec::new();
        for (chip, query) in states {
            let mut figure = figure(tag, query);
            for language in LANGUAGES {
                speak(&mut figure, language);
                let said = said(&figure);
                let bare = said.iter().filter(|text| bare_noise(text).is_some());
                wrong.extend(bare.map(|text| format!("{tag} {chip} {language}: {text}")));
            }
        }
        wrong
    };
    let all: Vec<String> = std::thread::scope(|scope| {
        let threads: Vec<_> = FIGURES.iter().map(|entry| scope.spawn(move || of_figure(entry.tag))).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    assert!(all.is_empty(), "{} texts:\n{}", all.len(), all.join("\n"));
}
