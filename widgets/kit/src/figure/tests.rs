use super::*;
use crate::model::{Declared, Tells};
use crate::panels::Panels;
use crate::recipe::{Param, Recipe};
use crate::view::Layout;
use std::{cell::RefCell, rc::Rc};

/// A point in a scene that is never narrower than 300 px. What it is told is written down.
#[derive(Default)]
struct OnePoint {
    told: Rc<RefCell<Vec<String>>>,
}

/// Nothing can be set about it.
#[derive(Clone, PartialEq, Default)]
struct Nothing;

impl Recipe for Nothing {
    fn table() -> Vec<Param<Self>> {
        Vec::new()
    }
}

impl Declared for OnePoint {
    type Recipe = Nothing;
    const TITLE: &'static str = "A point";
    fn recipe(&self) -> &Nothing {
        &Nothing
    }
    fn adopt(&mut self, _: Nothing) -> Result<(), FigureError> {
        Ok(())
    }
}

impl Tells for OnePoint {
    fn readouts(&self) -> Vec<Readout> {
        vec![Readout::new("x", "x", f64::NAN, "NaN", "m", "")]
    }
    fn describe(&self) -> String {
        "A point.".into()
    }
}

impl Model for OnePoint {}

impl Layout for Rect {
    fn laid_out(width: f64, _: &Panels) -> Rect {
        Rect::new(0.0, 0.0, width, 0.5 * width)
    }
    fn height(&self) -> f64 {
        self.h
    }
}

#[derive(Default)]
struct OnePointView;

impl View for OnePointView {
    type Model = OnePoint;
    type Layout = Rect;
    fn draw(&self, _: &OnePoint, _: &Rect, scene: &mut Scene) {
        let hover = Some(Rect::new(30.0, 60.0, 90.0, 30.0));
        let (name, title, text) = ("point", "The point".into(), "3 m east".into());
        scene.handles.push(Handle { name, title, at: [150.0, 75.0], axes: &[], value: 3.0, text, hover });
    }
    fn drag(&self, model: &mut OnePoint, layout: &Rect, handle: &str, to: Point) {
        model.told.borrow_mut().push(format!("{handle} to {to:?} of {}", layout.w));
    }
    fn nudge(&self, model: &mut OnePoint, handle: &str, steps: [f64; 2]) {
        model.told.borrow_mut().push(format!("{handle} by {steps:?}"));
    }
}

fn point() -> (Figure, Rc<RefCell<Vec<String>>>) {
    let shown = Shows::<OnePointView>::default();
    let told = shown.model.told.clone();
    (Figure::showing("point", Box::new(shown)), told)
}

#[test]
fn handles_lie_where_the_picture_has_them_also_where_it_was_made_smaller() {
    let (mut figure, _) = point();
    assert_eq!(figure.handles(300.0), []);
    figure.paint(600, 300, 2.0, Theme::Light);
    let handle = &figure.handles(300.0)[0];
    assert_eq!((handle.name, handle.x, handle.y), ("point", 150.0, 75.0));
    assert_eq!(handle.hover, Some(Rect::new(30.0, 60.0, 90.0, 30.0)));
    figure.paint(100, 50, 1.0, Theme::Light);
    let handle = &figure.handles(100.0)[0];
    assert_eq!((handle.x, handle.y, handle.hover), (50.0, 25.0, Some(Rect::new(10.0, 20.0, 30.0, 10.0))));
}

#[test]
fn a_handle_is_dragged_in_the_scene_s_own_px_and_never_to_what_is_no_number() {
    let (mut figure, told) = point();
    figure.drag("point", 60.0, 20.0, 600.0);
    figure.drag("point", 60.0, 20.0, 100.0);
    figure.nudge("point", -1.0, 10.0);
    for bad in [f64::NAN, f64::INFINITY] {
        figure.drag("point", bad, 1.0, 300.0);
        figure.nudge("point", 0.0, bad);
    }
    figure.drag("point", 1.0, 1.0, 0.0);
    assert_eq!(
        *told.borrow(),
        ["point to [60.0, 20.0] of 600", "point to [180.0, 60.0] of 300", "point by [-1.0, 10.0]"]
    );
}

#[test]
fn a_figure_without_a_timeline_has_no_steps_and_nothing_pending() {
    let (mut figure, _) = point();
    figure.model_mut().seek(7);
    figure.model_mut().settle();
    assert_eq!((figure.model().step(), figure.model().step_count(), figure.model().pending()), (0, 0, 0));
}

#[test]
fn a_readout_that_is_no_number_is_a_dash() {
    let readout = &point().0.readouts()[0];
    assert_eq!((readout.value, readout.text.as_str()), (None, "–"));
}

#[test]
fn a_figure_without_files_takes_none_and_what_only_others_can_do_leaves_it_as_it_is() {
    let (mut figure, told) = point();
    assert_eq!(figure.open(b"x").unwrap_err().parameter, "file");
    assert_eq!((figure.ready(), figure.file("map.pgm")), (Ok(()), None));
    let before = figure.scene(400.0, 200.0);
    let own = Own { name: "take".into(), with: "wheel".into(), at: vec![1.0] };
    assert_eq!(figure.own(&own, 400.0), Ok(()));
    assert_eq!((figure.scene(400.0, 200.0), told.borrow().len()), (before, 0));
}
