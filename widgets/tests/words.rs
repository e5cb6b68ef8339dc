//! Figures in other languages: every word is of the language, and nothing else changes.

use fastslam_widgets::{
    figure::Figure,
    model::{ParamSpec, Readout},
    registry::FIGURES,
    scene::Mark,
};
use std::{collections::BTreeMap, fs, path::Path};

const LAP: &str = "fastslam-lap";

/// A catalogue as the page hands it to a figure.
fn lines(language: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("words").join(format!("{language}.json"));
    let sections: BTreeMap<String, BTreeMap<String, String>> =
        serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let line = |section: &str, (key, text): (&String, &String)| format!("{section}.{key}={text}\n");
    sections.iter().flat_map(|(section, messages)| messages.iter().map(move |pair| line(section, pair))).collect()
}

fn figure(tag: &str, language: &str) -> Figure {
    let mut figure = Figure::new(tag).unwrap();
    if language != "en" {
        figure.set_words(&lines(language));
    }
    if tag == LAP {
        assert_eq!(figure.load("course=apartment"), []);
    }
    if tag == "fastslam-log" {
        figure.open(include_bytes!("../../tests/figures/golden/tiny.clf")).unwrap();
        figure.set("cell", "0.2").unwrap();
    }
    figure.model_mut().seek(4);
    figure.model_mut().settle();
    figure
}

/// What is written in the picture, in order.
fn written(figure: &Figure) -> Vec<String> {
    let scene = figure.scene(1000.0, 600.0);
    let text = |mark| if let Mark::Text(text) = mark { Some(text.text) } else { None };
    scene.marks.into_iter().filter_map(text).collect()
}

/// All that it says, in order.
fn said(figure: &Figure) -> Vec<String> {
    let spec = |ParamSpec { title, unit, help, choices, .. }: ParamSpec| {
        [title, unit, help].into_iter().chain(choices.into_iter().map(|c| c.title)).map(String::from).collect()
    };
    let readout = |Readout { title, unit, help, text, .. }: Readout| {
        [title, unit, help].map(String::from).into_iter().chain([text]).collect()
    };
    let specs: Vec<Vec<String>> = figure.params().into_iter().map(spec).collect();
    let readouts: Vec<Vec<String>> = figure.readouts().into_iter().map(readout).collect();
    let handles = figure.scene(1000.0, 600.0).handles.into_iter().flat_map(|handle| [handle.title, handle.text]);
    specs.concat().into_iter().chain(readouts.concat()).chain(handles).chain([figure.describe()]).collect()
}

#[test]
fn the_lap_speaks_german_once_it_has_the_words() {
    let mut lap = figure(LAP, "de");
    assert!(
        lap.describe().starts_with("Schritt 4 von 90, 16 Universen. Groß gezeigt ist Universum "),
        "{}",
        lap.describe()
    );
    let universes = &lap.params()[0];
    assert_eq!((universes.name, universes.title), ("universes", "Universen M"));
    let params = lap.params();
    let policy = params.iter().find(|spec| spec.name == "policy").unwrap();
    assert_eq!((policy.choices[1].value.as_str(), policy.choices[1].title), ("always", "bei jedem Schritt"));
    assert_eq!(lap.readouts()[1].title, "RMS-Fehler, bestes Universum");
    assert!(written(&lap).contains(&"Pfade der anderen".into()), "{:?}", written(&lap));
    assert_eq!(
        lap.set("universes", "0").unwrap_err().message,
        "universes = \"0\": erlaubt ist eine ganze Zahl von 1 bis 256"
    );
    assert!(lap.load("colour=red")[0].message.contains("ist kein Parameter dieser Abbildung"));
}

#[test]
fn a_language_changes_nothing_but_words_and_can_be_changed_back() {
    for entry in FIGURES {
        let (english, mut other) = (figure(entry.tag, "en"), figure(entry.tag, "de"));
        assert_eq!(other.query(), english.query());
        let values = |figure: &Figure| figure.readouts().into_iter().map(|r| (r.name, r.value)).collect::<Vec<_>>();
        assert_eq!(format!("{:?}", values(&other)), format!("{:?}", values(&english)), "{}", entry.tag);
        assert_ne!(other.describe(), english.describe());
        other.set_words("");
        assert_eq!(said(&other), said(&english));
        assert_eq!(written(&other), written(&english));
    }
}

/// Words that are the same in both languages, and what stands for itself.
const SAME: &[&str] = &[
    "FastSLAM",
    "N_eff",
    "RMS",
    "Iteration",
    "Scan",
    "Scans",
    "Pose",
    "nats",
    "Filter",
    "Innovation",
    "multinomial",
    "landmarks",
    "EKF",
    "SLAM",
    "FastSLAM",
    "min",
    "rad",
    "det",
    "exp",
    "eff",
    "πS",
];

#[test]
fn every_word_of_every_figure_is_of_the_language() {
    for entry in FIGURES {
        let (english, german) = (figure(entry.tag, "en"), figure(entry.tag, "de"));
        let pairs =
            said(&english).into_iter().zip(said(&german)).chain(written(&english).into_iter().zip(written(&german)));
        for (english, german) in pairs {
            if english != german {
                continue;
            }
            let words =
                english.split(|c: char| !(c.is_alphabetic() || c == '_')).filter(|word| word.chars().count() > 2);
            let left: Vec<&str> = words.filter(|word| !SAME.contains(word)).collect();
            assert!(left.is_empty() || english.chars().all(|c| c.is_ascii_hexdigit()), "{}: {english}", entry.tag);
        }
    }
}

#[test]
fn what_a_catalogue_lacks_or_garbles_is_said_in_english() {
    let english = figure(LAP, "en").describe();
    for bad in [
        "nonsense",
        "=",
        "lap.shown_best={step",
        "lap.shown_best={nobody}",
        "lap.shown_best={m:one}",
        "lap.errors=",
        "\n\n",
    ] {
        let mut lap = figure(LAP, "en");
        lap.set_words(bad);
        assert_eq!(lap.describe(), english, "{bad}");
    }
    let mut lap = figure(LAP, "en");
    lap.set_words("lap.universes=\ncommon.universes=Welten M\n");
    assert_eq!(lap.params()[0].title, "Welten M");
    assert_eq!(lap.describe(), english);
}

#[test]
fn figures_side_by_side_speak_different_languages() {
    let (english, german) = (figure(LAP, "en"), figure(LAP, "de"));
    for _ in 0..2 {
        assert!(english.describe().starts_with("Step 4 of 90"));
        assert!(german.describe().starts_with("Schritt 4 von 90"));
    }
}
