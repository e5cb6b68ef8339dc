//! The characters that figures write: the font must have each, or a question mark is drawn in its place. Those of the golden pictures are
//! looked up in every run of the tests, where the pictures are painted; those of all other states are breadth.

use fastslam_widgets::{
    font::has,
    model::{Kind, ParamSpec},
    registry::{self, FIGURES},
    scene::{Mark, Scene},
};
use figures::{PICTURES, SETUPS, TINY_LOG};
use std::collections::BTreeSet;

const LOG: &str = "fastslam-log";

/// What a picture writes and the font does not have.
pub fn missing(scene: &Scene) -> String {
    let texts = scene.marks.iter().filter_map(|mark| if let Mark::Text(text) = mark { Some(text) } else { None });
    texts.flat_map(|text| text.text.chars().filter(|character| !has(*character))).collect()
}

/// Links to a figure's states: those of the goldens, and every parameter by itself at each of its ends and choices.
fn links(tag: &str) -> Vec<String> {
    let kept = PICTURES.iter().map(|picture| (picture.tag, picture.query)).chain(SETUPS.iter().copied());
    let mut links: Vec<String> = kept.filter(|(of, _)| *of == tag).map(|(_, query)| query.to_string()).collect();
    for spec in registry::figure(tag).unwrap().model().params() {
        // A log is mapped anew for each link: by few universes in large cells.
        let quick =
            if tag == LOG && !["universes", "cell"].contains(&spec.name) { "universes=4&cell=0.2&" } else { "" };
        links.extend(values(&spec).into_iter().map(|value| format!("{quick}{}={value}", spec.name)));
    }
    links
}

fn values(spec: &ParamSpec) -> Vec<String> {
    let ends = [spec.min, spec.max];
    let mut values: Vec<String> = spec.choices.iter().map(|choice| choice.value.to_string()).collect();
    match spec.kind {
        Kind::Number => values.extend(ends.map(|x| x.to_string())),
        Kind::Integer => values.extend(ends.map(|x| x.floor().to_string())),
        Kind::Flag | Kind::Toggle => values.extend(["on", "off"].map(String::from)),
        // A text has no ends.
        Kind::Choice | Kind::Text => {}
    }
    values
}

/// All characters a figure writes, in code point order.
fn written(tag: &str) -> BTreeSet<char> {
    let mut written = BTreeSet::new();
    // Without a log, it writes what it waits for.
    let files = if tag == LOG { vec![None, Some(TINY_LOG)] } else { vec![None] };
    for (link, file) in links(tag).into_iter().flat_map(|link| files.iter().map(move |file| (link.clone(), *file))) {
        let mut figure = registry::figure(tag).unwrap();
        if let Some(file) = file {
            figure.open(file).unwrap();
        }
        figure.load(&link); // what is refused, since it does not go with the rest, changes nothing
        let last = figure.model().step_count();
        for step in (0..=last).step_by(9).chain([last]) {
            figure.model_mut().seek(step);
            figure.model_mut().settle();
            for width in [240.0, 300.0, 340.0, 380.0, 480.0, 640.0, 800.0, 1280.0] {
                for mark in figure.scene(width, figure.height(width)).marks {
                    if let Mark::Text(text) = mark {
                        written.extend(text.text.chars());
                    }
                }
            }
        }
    }
    written
}

#[test]
#[ignore = "breadth: every parameter of every figure at its ends and choices, at eight widths"]
fn the_font_has_every_character_that_a_figure_writes() {
    let assert_has_all = |tag| {
        let missing: String = written(tag).into_iter().filter(|&character| !has(character)).collect();
        assert_eq!(missing, "", "{tag}");
    };
    // A thread each: all together they take minutes.
    std::thread::scope(|scope| {
        for entry in FIGURES {
            scope.spawn(|| assert_has_all(entry.tag));
        }
    });
}
