//! No text of a picture is cut, in any state that a chip leads to, in any language, however wide.
//!
//! This has caught a slide of 900 × 560 whose counts ended in dots: of its widths none had been among those looked at.

use crate::common::{figure, scene, texts};
use crate::words::lines;
use fastslam_widgets::registry::{self, FIGURES};

/// Of phones, columns, the chapter, laptops and projectors \[css px\]: whoever fits a picture into a frame looks for the width at which it
/// can be shown largest, so that any of them comes up.
fn widths() -> impl Iterator<Item = f64> {
    [320, 352, 380, 460, 520].into_iter().chain((540..=900).step_by(20)).chain([1000, 1120, 1280, 1366]).map(f64::from)
}

/// What is wrong with the texts of a figure in the state of a chip, at all widths and in all languages.
fn wrong(tag: &str, chip: &str, query: &str) -> Vec<String> {
    let mut figure = figure(tag, query);
    let mut all = Vec::new();
    for language in ["en", "de"] {
        figure.set_words(&if language == "en" { String::new() } else { lines(language) });
        figure.set_decimal_comma(language == "de");
        for width in widths() {
            let (_, wrong) = texts(&scene(&figure, width));
            all.extend(wrong.into_iter().map(|wrong| format!("{tag} {chip} {language} {width}: {wrong}")));
        }
    }
    all
}

#[test]
fn no_text_of_a_picture_is_cut_in_the_state_of_any_chip() {
    let all: Vec<String> = std::thread::scope(|scope| {
        let of_figure = |tag: &'static str| {
            let chips = registry::figure(tag).unwrap().chips();
            let states = chips.iter().map(|chip| (chip.name, chip.query.as_str())).chain([("opening", "")]);
            states.flat_map(|(chip, query)| wrong(tag, chip, query)).collect::<Vec<_>>()
        };
        let threads: Vec<_> = FIGURES.iter().map(|entry| scope.spawn(move || of_figure(entry.tag))).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    assert!(all.is_empty(), "{} texts:\n{}", all.len(), all.join("\n"));
}
