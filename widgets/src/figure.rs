//! A figure as its users hold it: a model, and pixels of it. The browser's shell, the command line and the tests all go through
//! here.

use crate::{
    comma,
    export::{Entries, Export},
    model::{FigureError, Files, Model, Readout},
    paint::{Canvas, Theme},
    param, query, registry,
    scene::{Handle, Point, Rect, Scene},
    view::{Shown, Shows, View},
};
use serde::Serialize;

/// One figure on a page.
pub struct Figure {
    tag: &'static str,
    shown: Box<dyn Shown>,
    canvas: Canvas,
    /// Of the scene painted last, and that scene's width \[css px\].
    handles: (Vec<Handle>, f64),
    decimal_comma: bool,
}

/// A [`Handle`] where it lies on the page.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct PlacedHandle {
    /// [`Handle::name`].
    pub name: &'static str,
    /// [`Handle::title`].
    pub title: String,
    /// From the figure's left edge \[css px\].
    pub x: f64,
    /// From the figure's upper edge \[css px\].
    pub y: f64,
    /// [`Handle::axes`].
    pub axes: &'static [&'static str],
    /// [`Handle::value`].
    pub value: f64,
    /// [`Handle::text`].
    pub text: String,
    /// [`Handle::hover`].
    pub hover: Option<Rect>,
}

impl Figure {
    /// The figure of a tag, of which nothing was asked yet.
    ///
    /// # Errors
    /// For a tag that the registry does not have.
    pub fn new(tag: &str) -> Result<Self, FigureError> {
        let entry = registry::find(tag).ok_or_else(|| {
            let tags: Vec<&str> = registry::FIGURES.iter().map(|f| f.tag).collect();
            FigureError::new("tag", param::quoted(tag), format!("one of {}", tags.join(", ")))
        })?;
        Ok(Self::showing(entry.tag, (entry.make)()))
    }

    /// One that the registry does not have.
    pub fn of<V: View>(tag: &'static str) -> Self {
        Self::showing(tag, Box::new(Shows::<V>::default()))
    }

    fn showing(tag: &'static str, shown: Box<dyn Shown>) -> Self {
        Self { tag, shown, canvas: Canvas::default(), handles: (Vec::new(), 1.0), decimal_comma: false }
    }

    /// What the figure is about.
    pub fn model(&self) -> &dyn Model {
        self.shown.model()
    }

    /// The same, to be acted upon.
    pub fn model_mut(&mut self) -> &mut dyn Model {
        self.shown.model_mut()
    }

    /// Current values by name, in the order of the parameters.
    pub fn values(&self) -> Entries<String> {
        Entries(self.model().values())
    }

    /// Gives a parameter a new value.
    ///
    /// # Errors
    /// For a name or a value that is refused; the figure is as it was.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), FigureError> {
        self.model_mut().configure(&[(name.into(), value.into())]).pop().map_or(Ok(()), Err)
    }

    /// Writes numbers with a decimal comma, in the picture and in words.
    pub fn set_decimal_comma(&mut self, on: bool) {
        self.decimal_comma = on;
    }

    /// [`Model::readouts`], in the figure's way of writing numbers.
    pub fn readouts(&self) -> Vec<Readout> {
        let readouts = self.model().readouts().into_iter();
        readouts.map(|readout| Readout { text: self.written(readout.text), ..readout }).collect()
    }

    /// [`Model::describe`], in the figure's way of writing numbers.
    pub fn describe(&self) -> String {
        self.written(self.model().describe())
    }

    /// Names of the parts of its picture that can be shown by themselves.
    pub fn panels(&self) -> &'static [&'static str] {
        self.shown.panels()
    }

    /// Shows some parts of the picture, by their names apart by spaces; `all` or nothing for the whole.
    ///
    /// # Errors
    /// For a name that no part of it has; the error has those that there are.
    pub fn show(&mut self, panels: &str) -> Result<(), FigureError> {
        self.shown.show(panels)
    }

    /// Height \[css px\] that the figure wants at this width \[css px\].
    pub fn height(&self, width: f64) -> f64 {
        self.shown.height(width)
    }

    /// What is to be seen at this size \[css px\], in the figure's way of writing numbers.
    pub fn scene(&self, width: f64, height: f64) -> Scene {
        let mut scene = self.shown.scene(width, height);
        if self.decimal_comma {
            comma::in_scene(&mut scene);
        }
        scene
    }

    fn written(&self, text: String) -> String {
        if self.decimal_comma { comma::in_text(&text) } else { text }
    }

    /// Paints the figure: size in device px, device px per css px, and colours. Sizes no screen has are clamped.
    pub fn paint(&mut self, width_px: u32, height_px: u32, dpr: f64, theme: Theme) {
        let dpr = if dpr.is_finite() { dpr.clamp(0.25, 16.0) } else { 1.0 };
        let side = |px: u32| f64::from(px.max(1)) / dpr;
        let scene = self.scene(side(width_px), side(height_px));
        self.canvas.paint(&scene, width_px, height_px, theme);
        self.handles = (scene.handles, scene.width);
    }

    /// What was painted last.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }

    /// A click at a point of a figure of this width \[css px\]. True if it changed something.
    pub fn pick(&mut self, x: f64, y: f64, width: f64) -> bool {
        let scene = self.shown.scene(width, self.height(width));
        let target = scene.hit(in_scene([x, y], scene.width / width));
        target.into_iter().for_each(|target| self.shown.pick(target));
        target.is_some()
    }

    /// What can be moved in the picture painted last, where it lies in a figure of this width \[css px\].
    pub fn handles(&self, width: f64) -> Vec<PlacedHandle> {
        let (handles, scene_width) = &self.handles;
        let scale = width / scene_width;
        let placed = |handle: &Handle| {
            let Handle { name, title, at, axes, value, text, hover } = handle.clone();
            let [x, y] = at.map(|c| c * scale);
            let hover = hover.map(|r| Rect::new(r.x * scale, r.y * scale, r.w * scale, r.h * scale));
            PlacedHandle { name, title, x, y, axes, value, text, hover }
        };
        handles.iter().map(placed).collect()
    }

    /// Moves a handle to a point of a figure of this width \[css px\].
    pub fn drag(&mut self, handle: &str, x: f64, y: f64, width: f64) {
        let scene_width = self.shown.scene_width(width);
        let to = in_scene([x, y], scene_width / width);
        if to.iter().all(|c| c.is_finite()) {
            self.shown.drag(handle, to, scene_width);
        }
    }

    /// Moves a handle right and up, in steps of its parameters.
    pub fn nudge(&mut self, handle: &str, right: f64, up: f64) {
        if right.is_finite() && up.is_finite() {
            self.shown.nudge(handle, [right, up]);
        }
    }

    /// Magnifies the picture about a point of a figure of this width \[css px\]; about its middle, where that is no point.
    pub fn zoom(&mut self, factor: f64, x: f64, y: f64, width: f64) {
        let scale = self.scene_px(width);
        let at = Some(in_scene([x, y], scale)).filter(|at| at.iter().all(|c| c.is_finite()));
        if factor.is_finite() && factor > 0.0 {
            self.shown.zoom(factor, at, width * scale);
        }
    }

    /// Moves the picture right and down in a figure of this width \[css px\].
    pub fn pan(&mut self, right: f64, down: f64, width: f64) {
        let scale = self.scene_px(width);
        let by = in_scene([right, down], scale);
        if by.iter().all(|c| c.is_finite()) {
            self.shown.pan(by, width * scale);
        }
    }

    /// Shows the whole again.
    pub fn fit(&mut self) {
        self.shown.fit();
    }

    /// Takes a reader's file instead of the one before.
    ///
    /// # Errors
    /// For a file that cannot be read, and for a figure that has no use for any; it is as it was.
    pub fn open(&mut self, file: &[u8]) -> Result<(), FigureError> {
        let none = FigureError { parameter: "file".into(), message: "this figure has no use for a file".into() };
        self.model_mut().files_mut().ok_or(none)?.open(file)
    }

    /// Whether what was set can be computed at all.
    ///
    /// # Errors
    /// The parameter that stands in the way, and its range.
    pub fn ready(&self) -> Result<(), FigureError> {
        self.model().files().map_or(Ok(()), Files::ready)
    }

    /// A file of this name made of the state shown, if there is such a one.
    pub fn file(&self, name: &str) -> Option<Vec<u8>> {
        self.model().files()?.file(name)
    }

    /// Px of the scene painted last in a css px of a figure of this width.
    fn scene_px(&self, width: f64) -> f64 {
        self.handles.1 / width
    }

    /// The link that makes this figure again: `name=value&…`.
    pub fn query(&self) -> String {
        query::write(self.model())
    }

    /// Makes the figure what a link says. Returns what was refused; the rest is applied.
    pub fn load(&mut self, query: &str) -> Vec<FigureError> {
        query::read(self.model_mut(), query)
    }

    /// Measured data of every step so far.
    pub fn export(&self) -> Export {
        Export::new(self.tag, self.model())
    }
}

/// A point of a figure in its scene: a very narrow figure is a wider scene made smaller.
fn in_scene(point: Point, scale: f64) -> Point {
    point.map(|c| c * scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Declared;
    use crate::panels::Panels;
    use crate::recipe::{Param, Recipe};
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

    impl Model for OnePoint {
        fn readouts(&self) -> Vec<Readout> {
            vec![Readout::new("x", "x", f64::NAN, "NaN", "m", "")]
        }
        fn describe(&self) -> String {
            "A point.".into()
        }
    }

    #[derive(Default)]
    struct OnePointView;

    impl View for OnePointView {
        type Model = OnePoint;
        type Layout = Rect;
        fn layout(width: f64, _: &Panels) -> Rect {
            Rect::new(0.0, 0.0, width, 0.5 * width)
        }
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
        (Figure::showing("fastslam-point", Box::new(shown)), told)
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
    fn a_figure_without_files_takes_none_and_one_without_navigation_stays_where_it_is() {
        let (mut figure, told) = point();
        assert_eq!(figure.open(b"x").unwrap_err().parameter, "file");
        assert_eq!((figure.ready(), figure.file("map.pgm")), (Ok(()), None));
        let before = figure.scene(400.0, 200.0);
        figure.zoom(2.0, 9.0, 9.0, 400.0);
        figure.pan(9.0, 9.0, 400.0);
        figure.fit();
        assert_eq!((figure.scene(400.0, 200.0), told.borrow().len()), (before, 0));
    }
}
