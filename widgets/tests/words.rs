//! Figures in other languages: every word is of the language, and nothing else changes.

use fastslam_widgets::{
    figure::Figure,
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
    let policy = &lap.params()[6];
    assert_eq!((policy.choices[1].value.as_str(), policy.choices[1].title), ("always", "bei jedem Schritt"));
    assert_eq!(lap.readouts()[1].title, "RMS-Fehler, bestes Universum");
    assert!(written(&lap).contains(&"Schritt 4 von 90".into()), "{:?}", written(&lap));
    assert_eq!(
        lap.set("universes", "0").unwrap_err().message,
        "universes = \"0\": erlaubt ist eine ganze Zahl von 1 bis 256"
    );
    assert!(lap.load("colour=red")[0].message.contains("ist kein Parameter dieser Abbildung"));
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
