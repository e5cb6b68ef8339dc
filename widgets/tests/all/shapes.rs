//! The shapes that TypeScript has of what crosses the boundary, held to ours.

use fastslam_widgets::{
    action::{Action, Own, Size},
    lap, log,
    paint::Theme,
    registry,
};
use serde_json::{Value, json};
use std::collections::BTreeSet;

#[test]
fn a_figure_s_own_verbs_come_over_as_they_are() {
    let verbs =
        [lap::Verb::Take("wall"), lap::Verb::Press("move", [1.0, 0.0]), lap::Verb::Stroke(&[1.0, 2.0, 3.0, 4.0])];
    let looks = [
        log::Verb::Zoom(2.0, None),
        log::Verb::Zoom(2.0, Some([3.0, 4.0])),
        log::Verb::Pan([1.0, 2.0]),
        log::Verb::Fit,
    ];
    for verb in verbs {
        let own = Own::from(verb);
        assert_eq!((lap::Verb::of(&own), log::Verb::of(&own)), (Some(verb), None));
    }
    for look in looks {
        let own = Own::from(look);
        assert_eq!((lap::Verb::of(&own), log::Verb::of(&own)), (None, Some(look)));
    }
    let short = Own { name: "press".into(), at: vec![1.0], ..Own::default() };
    assert_eq!(lap::Verb::of(&short), None);
}

/// What stands between two texts of a source, as often as they do.
fn between<'a>(source: &'a str, before: &str, after: char) -> BTreeSet<&'a str> {
    source.split(before).skip(1).filter_map(|rest| rest.split_once(after)).map(|(found, _)| found).collect()
}

/// The texts that a `match` of ours knows.
fn arms<'a>(source: &'a str, before: &str) -> BTreeSet<&'a str> {
    let lines = source.lines().map(str::trim).filter(|line| line.starts_with(before));
    let sides = lines.filter_map(|line| line.split_once(" => ")).map(|(side, _)| side);
    sides.flat_map(|side| side.split('"').skip(1).step_by(2)).collect()
}

/// Names of the fields that a type of TypeScript has at its top, or of one of its lines.
fn fields(source: &str) -> BTreeSet<String> {
    let (mut depth, mut names, mut word) = (0, BTreeSet::new(), String::new());
    for line in source.lines().filter(|line| !line.trim_start().starts_with(['/', '*'])) {
        for c in line.chars() {
            match c {
                '{' | '(' | '[' => depth += 1,
                '}' | ')' | ']' => depth -= 1,
                ':' if depth == 0 && !word.is_empty() => {
                    names.insert(word.trim_end_matches('?').trim_start_matches("readonly ").into());
                }
                _ => (),
            }
            if c.is_alphanumeric() || c == '?' { word.push(c) } else { word.clear() }
        }
    }
    names
}

/// What stands between the first of these braces and the one that closes it.
fn body<'a>(source: &'a str, head: &str) -> &'a str {
    let rest = source.split_once(head).unwrap_or_else(|| panic!("no {head}")).1;
    let from = rest.find('{').unwrap() + 1;
    let mut depth = 1;
    let end = rest[from..].find(|c| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        depth == 0
    });
    &rest[from..from + end.unwrap()]
}

fn keys(value: &Value) -> BTreeSet<String> {
    value.as_object().unwrap_or_else(|| panic!("{value}")).keys().cloned().collect()
}

const ACTIONS: &str = include_str!("../../elements/action.ts");
/// What is asked, as the kit reads it.
const ASKED: &str = include_str!("../../kit/src/action.rs");
const SHAPES: &str = include_str!("../../elements/shell.ts");

#[test]
fn typescript_has_the_same_actions_with_the_same_fields() {
    let (_, actions) = ACTIONS.split_once("export type Action =").unwrap();
    let mut told = between(actions, "{ do: '", '\'');
    told.insert("link"); // beside `begin`
    assert_eq!(told, arms(ASKED, "\""));
    let (_, own) = ACTIONS.split_once("export type Own =").unwrap();
    let verbs = [include_str!("../../src/lap/verb.rs"), include_str!("../../src/log/verb.rs")]
        .map(|source| arms(source, "(\""));
    assert_eq!(between(own, "{ name: '", '\''), &verbs[0] | &verbs[1]);
    let mut told = fields(body(ACTIONS, "interface Message "));
    told.insert("do".into());
    assert_eq!(told, fields(body(ASKED, "pub struct Message ")));
}

#[test]
fn typescript_has_the_fields_of_what_is_told() {
    // In a state in which there is one of each: a trace, something to watch, and a place in the page.
    let mut figure = registry::figure("fastslam-doors").unwrap();
    let (height, theme) = (f64::INFINITY, Theme::Light);
    figure.act(&Action::Size(Size { room: 800.0, height, font_scale: 1.0, css: 800.0, px: [80, 45], theme }));
    figure.act(&Action::Trace);
    figure.model_mut().settle();
    let state = json!(figure.state());
    let mut told = keys(&state);
    told.insert("unfit".into());
    assert_eq!(fields(body(SHAPES, "export interface ProgramState ")), told);
    let frame = json!(figure.frame(false));
    assert_eq!(fields(body(SHAPES, "export interface ProgramFrame ")), keys(&frame));
    let mut layout = keys(&frame["layout"]);
    layout.insert("width".into());
    assert_eq!(fields(body(SHAPES, "export interface Layout ")), layout);
    let mut news = keys(&frame["news"]);
    news.extend(["handles".into(), "rooms".into()]);
    assert_eq!(fields(body(SHAPES, "export interface Told ")), news);
    for (title, first) in [("ParamSpec", "specs"), ("Chip", "chips")] {
        assert_eq!(
            fields(body(SHAPES, &format!("export interface {title} "))),
            keys(&frame["news"][first][0]),
            "{title}"
        );
    }
    let again = json!(figure.frame(false));
    assert_eq!(again["news"], json!({}), "nothing has changed");
    assert_eq!(again.get("trace"), None, "it is told once");
}

/// A figure speaks its language because there is one way to its model, which speaks it: no file of the boundary goes another one.
#[test]
fn the_page_has_no_way_to_a_model_that_does_not_speak() {
    let files = [
        include_str!("../../src/shell.rs"),
        include_str!("../../kit/src/figure/asked.rs"),
        include_str!("../../kit/src/figure/fit.rs"),
    ];
    for way in [".model()", ".model_mut()", ".mute"] {
        assert!(files.iter().all(|file| !file.contains(way)), "{way}");
    }
    let figure = include_str!("../../kit/src/figure.rs");
    assert_eq!(figure.matches("mute").count(), 2, "the doors of tests and tools");
    assert!(!figure.contains("self.model()") && !figure.contains("spoken()"));
}
