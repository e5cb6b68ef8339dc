//! A reader at the wheel of the lap, by the figure's public face: what is driven, built and lifted is in the link, and nothing from a
//! link can harm.

use crate::common::{figure, state};
use fastslam_widgets::{figure::Figure, lap::Verb, model::FigureError, registry, scene::Mark};

const WIDTH: f64 = 800.0;

fn lap(query: &str) -> Figure {
    figure("fastslam-lap", &format!("course=apartment&universes=4{query}"))
}

/// Where a place \[m\] is in the figure \[css px\].
fn at(figure: &mut Figure, [x, y]: [f64; 2]) -> [f64; 2] {
    figure.paint(WIDTH as u32, figure.height(WIDTH) as u32, 1.0, fastslam_widgets::paint::Theme::Light);
    let map = figure.rooms(WIDTH).into_iter().find(|room| room.parameter == "drive").unwrap().area;
    let scale = map.w / (44.0 * 0.3);
    [map.x + (x + 0.6) * scale, map.bottom() - (y + 0.6) * scale]
}

fn stroke(figure: &mut Figure, places: &[[f64; 2]]) {
    let line: Vec<f64> = places.iter().flat_map(|place| at(figure, *place)).collect();
    wheel(figure, Verb::Stroke(&line)).unwrap();
    figure.model_mut().settle();
}

fn press(figure: &mut Figure, key: &str, right: f64, up: f64) {
    wheel(figure, Verb::Press(key, [right, up])).unwrap();
    figure.model_mut().settle();
}

fn take(figure: &mut Figure, tool: &str) {
    wheel(figure, Verb::Take(tool)).unwrap();
}

fn wheel(figure: &mut Figure, verb: Verb) -> Result<(), FigureError> {
    figure.own(&verb.into(), WIDTH)
}

fn value(figure: &Figure, name: &str) -> String {
    figure.model().value(name).unwrap()
}

#[test]
fn keys_drive_on_from_the_step_shown_and_the_link_brings_it_back() {
    let mut figure = lap("&step=12");
    take(&mut figure, "wheel");
    for (right, up) in [(0.0, 1.0), (0.0, 1.0), (-1.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, -1.0)] {
        press(&mut figure, "move", right, up);
    }
    assert_eq!((value(&figure, "drive").as_str(), figure.model().step()), ("1.12.M2nl2z", 18));
    assert_eq!(figure.model().step_count(), 18);
    take(&mut figure, "");
    let again = lap(&format!("&{}", figure.query()));
    assert_eq!(state(&figure), state(&again));
    // From an earlier step, what came after it is cut off.
    figure.model_mut().seek(14);
    take(&mut figure, "wheel");
    press(&mut figure, "move", 0.0, -1.0);
    assert_eq!(value(&figure, "drive"), "1.12.M2z");
}

#[test]
fn what_is_driven_on_is_what_a_link_to_it_shows() {
    let mut figure = lap("&step=30");
    take(&mut figure, "wheel");
    for k in 0..12 {
        press(&mut figure, "move", f64::from(k % 3) - 1.0, f64::from(k % 3 % 2));
        take(&mut figure, "");
        let linked = lap(&format!("&{}", figure.query()));
        assert_eq!(state(&figure), state(&linked), "after {} motions", k + 1);
        take(&mut figure, "wheel");
    }
    // And back to the course, as undoing does.
    figure.set("drive", "").unwrap();
    figure.set("step", "30").unwrap();
    take(&mut figure, "");
    figure.model_mut().settle();
    assert_eq!(state(&figure), state(&lap("&step=30")));
}

#[test]
fn a_line_is_driven_along_until_a_wall() {
    let mut figure = lap("&step=10");
    take(&mut figure, "wheel");
    // Along the corridor, into its southern wall.
    stroke(&mut figure, &[[4.5, 4.6], [4.5, 3.0]]);
    let driven = value(&figure, "drive");
    assert_eq!(figure.model().step(), 10, "it stays, so that it is seen to drive");
    let last = figure.model().step_count();
    assert!((13..40).contains(&last), "{driven}");
    figure.model_mut().seek(last);
    figure.model_mut().settle();
    take(&mut figure, "");
    assert!(figure.describe().starts_with("A wall stopped the robot"), "{}", figure.describe());
}

#[test]
fn walls_are_put_up_by_a_line_by_two_points_and_by_keys_and_taken_away() {
    let mut figure = lap("");
    take(&mut figure, "wall");
    stroke(&mut figure, &[[6.0, 3.9], [6.0, 5.4]]);
    assert_eq!(value(&figure, "plan"), "1..1o131o1i");
    stroke(&mut figure, &[[1.0, 1.0]]);
    assert!(figure.describe().starts_with("A wall from (1.0, 1.0)"), "{}", figure.describe());
    stroke(&mut figure, &[[2.0, 1.0]]);
    assert_eq!(value(&figure, "plan"), "1..1o131o1i0a0a0k0a");
    // By keys: from where the cursor is, two to the right.
    press(&mut figure, "set", 0.0, 0.0);
    press(&mut figure, "move", 2.0, 0.0);
    press(&mut figure, "set", 0.0, 0.0);
    assert_eq!(value(&figure, "plan"), "1..1o131o1i0a0a0k0a0k0a0m0a");
    take(&mut figure, "erase");
    stroke(&mut figure, &[[6.05, 4.6]]);
    assert_eq!(value(&figure, "plan"), "1..0a0a0k0a0k0a0m0a");
    stroke(&mut figure, &[[4.2, 2.0]]);
    assert_eq!(value(&figure, "plan"), "1.0c.0a0a0k0a0k0a0m0a");
    // Nothing is near, and an outer wall stays.
    stroke(&mut figure, &[[10.0, 5.0]]);
    stroke(&mut figure, &[[5.0, 0.0]]);
    assert_eq!(value(&figure, "plan"), "1.0c.0a0a0k0a0k0a0m0a");
    press(&mut figure, "clear", 0.0, 0.0);
    assert_eq!(value(&figure, "plan"), "");
}

#[test]
fn a_kidnapped_robot_is_lost_and_the_sentence_says_why() {
    let mut figure = lap("&step=25");
    take(&mut figure, "lift");
    stroke(&mut figure, &[[9.6, 7.6]]);
    assert!(value(&figure, "drive").starts_with("1.25.~96_76_"), "{}", value(&figure, "drive"));
    let said = figure.describe();
    assert!(said.contains("Kidnapped at step 26") && said.contains("resampling can only choose"), "{said}");
    take(&mut figure, "");
    assert!(figure.describe().starts_with("Kidnapped at step 26"), "{}", figure.describe());
    figure.model_mut().seek(25);
    figure.model_mut().settle();
    assert!(!figure.describe().contains("Kidnapped"));
}

#[test]
fn the_truth_is_seen_at_the_wheel_alone() {
    let marks = |figure: &Figure| figure.scene(WIDTH, figure.height(WIDTH)).marks;
    let mut figure = lap("&step=3");
    let before = marks(&figure);
    take(&mut figure, "wall");
    assert!(marks(&figure).len() > before.len());
    take(&mut figure, "");
    assert!(marks(&figure) == before);
    assert!(before.iter().all(|mark| !matches!(mark, Mark::Lines { role: fastslam_widgets::scene::Role::Truth, .. })));
}

#[test]
fn a_link_that_nobody_wrote_is_refused_and_the_figure_lives() {
    for (query, name, says) in [
        ("drive=2.5.M", "drive", "version 1"),
        ("drive=9.0.M", "drive", "version 1"),
        ("drive=hello", "drive", "version 1"),
        ("drive=1.5.%F0%9F%92%A5", "drive", "as the figure writes it"),
        ("drive=1.5.M999", "drive", "400 steps"),
        ("drive=1.91.M", "drive", "inside the outer walls"),
        ("drive=1.5.~130_46_0", "drive", "inside the outer walls"),
        ("drive=1.5.~NaN_46_0", "drive", "as the figure writes it"),
        ("plan=1.00.", "plan", "inside the outer walls"),
        ("plan=1.zz.", "plan", "inside the outer walls"),
        ("plan=1..zzzz0000", "plan", "inside the outer walls"),
        ("plan=%00", "plan", "version 1"),
        ("plan=%3Cscript%3E", "plan", "version 1"),
        (&format!("plan=1..{}", "0".repeat(90_000)), "plan", "as the figure writes it"),
        (&format!("drive=1.0.{}", "M".repeat(90_000)), "drive", "as the figure writes it"),
    ] {
        let mut figure = registry::figure("fastslam-lap").unwrap();
        let refused = figure.load(&format!("course=apartment&universes=3&{query}"));
        let [error] = &refused[..] else { panic!("{query}: {refused:?}") };
        assert_eq!(error.parameter, name);
        assert!(error.message.contains(says) && error.message.len() < 200, "{}", error.message);
        figure.model_mut().seek(2);
        figure.model_mut().settle();
        assert_eq!((value(&figure, "universes").as_str(), figure.model().step()), ("3", 2));
        assert_eq!((value(&figure, "plan"), value(&figure, "drive")), (String::new(), String::new()));
    }
}

#[test]
fn another_course_begins_without_walls_and_drive() {
    let mut figure = lap("&drive=1.5.M&plan=1.0c.");
    figure.set("course", "ring").unwrap();
    assert_eq!((value(&figure, "plan"), value(&figure, "drive")), (String::new(), String::new()));
    // But a link names what belongs together.
    assert_eq!(figure.load("course=ring&universes=4&drive=1.110.M&plan=1.08."), []);
    assert_eq!(value(&figure, "drive"), "1.110.M");
}

#[test]
fn the_longest_plan_fits_into_a_link() {
    let mut figure = lap("&step=0");
    take(&mut figure, "lift");
    for _ in 0..8 {
        press(&mut figure, "set", 0.0, 0.0);
    }
    assert!(wheel(&mut figure, Verb::Press("set", [0.0, 0.0])).unwrap_err().message.contains("8 kidnappings"));
    let query = figure.query();
    take(&mut figure, "wheel");
    for k in 0..392 {
        wheel(&mut figure, Verb::Press("move", [if k % 2 == 0 { 1.0 } else { -1.0 }, 0.0])).unwrap();
    }
    assert!(wheel(&mut figure, Verb::Press("move", [1.0, 0.0])).unwrap_err().message.contains("400 steps"));
    assert!(figure.query().len() > query.len() + 390);
    take(&mut figure, "wall");
    for k in 0..60 {
        let y = 0.1 + 0.1 * f64::from(k);
        stroke_unsettled(&mut figure, &[[1.0, y], [11.0, y]]);
    }
    let full = [at(&mut figure, [1.0, 8.0]), at(&mut figure, [2.0, 8.0])].concat();
    assert!(wheel(&mut figure, Verb::Stroke(&full)).unwrap_err().message.contains("60 new walls"));
    // Whatever else is set, with the figure's other parameters and a page's address of 200 letters.
    let others = "v=13&course=apartment&universes=256&seed=4294967295&odometry=1.95&range-std=0.29&proposal=motion&matcher=cell\
        &policy=always&threshold=0.95&scheme=multinomial&temper=0.05&guard=off&universe=255&step=400&truth=on&raw=on";
    let erased = 2 * 60;
    assert!(figure.query().len() + others.len() + erased + 200 <= 2000, "{}", figure.query().len());
}

/// Where nobody looks, nothing has to be simulated.
fn stroke_unsettled(figure: &mut Figure, places: &[[f64; 2]]) {
    let line: Vec<f64> = places.iter().flat_map(|place| at(figure, *place)).collect();
    wheel(figure, Verb::Stroke(&line)).unwrap();
}
