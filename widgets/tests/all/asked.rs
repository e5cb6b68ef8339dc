//! Which of all that a figure is asked holds: the author's word, a link's, a reader's hand.

use crate::common::figure;
use fastslam_widgets::{
    action::{Action, Beginning, Size, Touch},
    figure::Figure,
    model::FigureError,
    paint::Theme,
};

const WIDTH: f64 = 800.0;

fn set(name: &str, value: Option<&str>) -> Action {
    Action::Set { name: name.into(), value: value.map(Into::into), hand: false }
}

fn value(figure: &Figure, name: &str) -> String {
    figure.model().value(name).unwrap()
}

fn size(font_scale: f64, height: f64) -> Action {
    Action::Size(Size { room: WIDTH, height, font_scale, css: WIDTH, px: [800, 450], theme: Theme::Light })
}

/// Refusals, without those that say that nothing is wrong.
fn refused(said: Vec<FigureError>) -> Vec<(String, String)> {
    said.into_iter().filter(|error| !error.message.is_empty()).map(|error| (error.parameter, error.message)).collect()
}

fn begun(author: &str, beginning: Beginning) -> (Figure, Vec<(String, String)>) {
    let mut figure = figure("fastslam-proposal", "");
    figure.act(&Action::Author(author.into()));
    let said = refused(figure.act(&Action::Begin(beginning)));
    (figure, said)
}

#[test]
fn a_link_stands_over_what_the_author_gave_and_that_over_the_default() {
    let author = "v=latest&samples=64&seed=5";
    let given = Beginning { settings: "seed=5&samples=64".into(), ..Default::default() };
    let (figure, said) = begun(author, given);
    assert_eq!((value(&figure, "samples"), value(&figure, "seed"), said), ("64".into(), "5".into(), vec![]));
    let link = Beginning { query: Some("v=9&seed=7".into()), linked: true, ..Default::default() };
    let (mut figure, _) = begun(author, link);
    let usual = figure.params().into_iter().find(|spec| spec.name == "samples").unwrap().default;
    assert_eq!(
        (value(&figure, "samples"), value(&figure, "seed")),
        (usual.clone(), "7".into()),
        "a link is a whole state"
    );
    let (begun, _) = begun("", Beginning { settings: "samples=64&seed=5&samples".into(), ..Default::default() });
    assert_eq!(
        (value(&begun, "samples"), value(&begun, "seed")),
        (usual.clone(), "5".into()),
        "taken away before it began"
    );
    // What is set later stands over it; taken away again it is at the default.
    figure.act(&set("samples", Some("16")));
    assert_eq!(value(&figure, "samples"), "16");
    figure.act(&set("samples", None));
    assert_eq!(value(&figure, "samples"), usual);
    assert_eq!(figure.act(&set("nobody-knows-it", None)), [], "and one that nobody knows is taken away in silence");
}

#[test]
fn what_is_locked_keeps_the_author_s_value_whatever_a_link_or_a_hand_says() {
    let mut figure = figure("fastslam-proposal", "");
    figure.act(&Action::Lock("seed samples".into()));
    figure.act(&Action::Author("v=latest&samples=64".into()));
    let beginning = Beginning { query: Some("v=9&seed=7&samples=16".into()), linked: true, ..Default::default() };
    let said = refused(figure.act(&Action::Begin(beginning)));
    assert_eq!((value(&figure, "samples").as_str(), value(&figure, "seed").as_str()), ("64", "17"));
    let locked: Vec<_> = said.iter().filter(|(parameter, _)| parameter == "locked").map(|(_, name)| &**name).collect();
    assert_eq!(locked.len(), 2, "{said:?}");
    assert!(locked.contains(&"seed") && locked.contains(&"samples"));
    // The page itself may change it: a lock is for readers.
    figure.act(&set("seed", Some("3")));
    assert_eq!(value(&figure, "seed"), "3");
}

#[test]
fn a_locked_handle_is_put_back_and_said_to_be_fixed() {
    let mut figure = figure("fastslam-proposal", "");
    figure.act(&size(1.0, f64::INFINITY));
    figure.frame(false);
    let handle = figure.handles(WIDTH).remove(0);
    let drag = |by: f64| Action::Touch(Touch::Drag(handle.name.into(), [handle.x + by, handle.y]));
    let before = figure.query();
    figure.act(&Action::Lock("all".into()));
    let said = refused(figure.act(&drag(30.0)));
    assert!(!said.is_empty() && said.iter().all(|(parameter, _)| parameter == "locked"), "{said:?}");
    assert_eq!(figure.query(), before);
    assert!(!figure.frame(false).changed, "a move that changes nothing is none");
    figure.act(&Action::Lock(String::new()));
    assert_eq!(figure.act(&drag(30.0)), []);
    assert_ne!(figure.query(), before);
    figure.model_mut().settle();
    assert!(!figure.frame(true).changed, "a look ahead leaves it to be told");
    assert!(figure.frame(false).changed);
    assert!(!figure.frame(false).changed, "it is told once");
}

#[test]
fn where_a_pointer_only_passes_over_all_goes_back_when_it_leaves_unless_something_is_chosen() {
    let mut figure = figure("fastslam-proposal", "");
    figure.act(&size(1.0, f64::INFINITY));
    figure.frame(false);
    let handle = figure.handles(WIDTH).remove(0);
    let follow = |by: f64| Action::Touch(Touch::Follow(handle.name.into(), [handle.x + by, handle.y]));
    let before = figure.query();
    for by in [20.0, 40.0] {
        figure.act(&follow(by));
        assert_ne!(figure.query(), before);
    }
    figure.act(&Action::Leave);
    assert_eq!(figure.query(), before);
    figure.act(&follow(20.0));
    figure.act(&Action::Touch(Touch::Drag(handle.name.into(), [handle.x + 25.0, handle.y])));
    let chosen = figure.query();
    figure.act(&Action::Leave);
    assert_eq!(figure.query(), chosen);
}

#[test]
fn a_step_beyond_the_last_is_the_last_and_what_is_no_number_the_first() {
    let mut figure = figure("fastslam-doors", "");
    for (asked, expected) in [(f64::INFINITY, figure.state().last), (-3.0, 0), (2.5, 3), (f64::NAN, 0), (4.4, 4)] {
        figure.act(&Action::Seek(asked));
        figure.model_mut().settle();
        assert_eq!((figure.state().target, figure.state().step), (expected, expected), "{asked}");
    }
    let telling = figure.model().telling();
    figure.act(&Action::Tell);
    assert_eq!(figure.state().target, telling.min(figure.state().last));
}

#[test]
fn a_picture_that_would_be_too_high_is_shown_as_large_as_it_fits() {
    let mut figure = figure("fastslam-proposal", "");
    figure.act(&size(1.0, f64::INFINITY));
    let free = figure.frame(false).layout.unwrap();
    assert_eq!((free.scale, free.width, free.height), (1.0, None, figure.height(WIDTH).round()));
    figure.act(&size(1.0, 0.7 * free.height));
    let fitting = figure.frame(false).layout.unwrap();
    assert_eq!(fitting.natural, free.height);
    assert!(fitting.height <= 0.7 * free.height && fitting.width.is_some() && fitting.scale >= 0.6, "{fitting:?}");
    // A projector's letters grow with its screen, and what would be too small to read is scrolled.
    figure.act(&size(1.5, 2000.0));
    let large = figure.frame(false).layout.unwrap();
    assert!(large.scale > 1.0, "{large:?}");
    figure.act(&size(1.0, 10.0));
    let scrolled = figure.frame(false).layout.unwrap();
    assert_eq!((scrolled.width, scrolled.scale), (None, 1.0));
}

#[test]
fn what_is_taken_away_is_at_the_default_of_its_version_also_where_that_has_changed_twice_since() {
    for (version, seed, range) in [(1, "3", "0.02"), (8, "9", "0.1"), (13, "17", "0.02")] {
        let mut lap = figure("fastslam-lap", "");
        lap.act(&Action::Author(format!("v={version}")));
        lap.act(&Action::Begin(Beginning { settings: "seed=5&range-std=0.2".into(), ..Default::default() }));
        for (name, default) in [("seed", seed), ("range-std", range)] {
            lap.act(&set(name, None));
            assert_eq!(value(&lap, name), default, "{name} of version {version}");
        }
    }
}
