//! A figure as its users hold it: a model, and pixels of it. The browser's shell, the command line and the tests all go through
//! here.

use crate::{
    action::Own,
    challenge::Chip,
    comparison::Comparison,
    export::{Entries, Export},
    frame::{self, PlacedHandle},
    model::{FigureError, Files, Model, ParamSpec, Readout, TraceLine},
    numerals::{self, Names},
    paint::{Canvas, Theme},
    query,
    scene::{Handle, Point, Rect, Room, Scene},
    symbol,
    view::{Shown, Shows, View},
    words::kit,
};
use voice::Voice;

mod asked;
mod compared;
mod fit;
mod voice;

/// One figure on a page.
pub struct Figure {
    tag: &'static str,
    voice: Voice,
    canvas: Canvas,
    painted: Painted,
    names: &'static Names,
    decimal_comma: bool,
    lit: String,
    comparison: Comparison,
    asked: asked::Asked,
    told: frame::Told,
}

/// What the scene painted last had besides its pixels.
#[derive(Default)]
struct Painted {
    handles: Vec<Handle>,
    rooms: Vec<Room>,
    /// \[css px\]
    width: f64,
}

impl Figure {
    /// The figure of a view, of which nothing was asked yet; its tag names it in what it exports.
    pub fn of<V: View>(tag: &'static str) -> Self {
        Self::showing(tag, Box::new(Shows::<V>::default()))
    }

    /// The same with names that keep their point where numbers have a comma.
    pub fn with_names(self, names: &'static Names) -> Self {
        Self { names, ..self }
    }

    fn showing(tag: &'static str, shown: Box<dyn Shown>) -> Self {
        Self {
            tag,
            voice: Voice::of(shown),
            canvas: Canvas::default(),
            painted: Painted::default(),
            names: &Names::NONE,
            decimal_comma: false,
            lit: String::new(),
            comparison: Comparison::default(),
            asked: asked::Asked::default(),
            told: frame::Told::default(),
        }
    }

    /// What the figure is about, in English: for tests and tools. On the page a figure is asked by [`Figure::act`].
    pub fn model(&self) -> &dyn Model {
        self.voice.mute().model()
    }

    /// The same, to be acted upon.
    pub fn model_mut(&mut self) -> &mut dyn Model {
        self.voice.mute_mut().model_mut()
    }

    fn ask<T>(&self, ask: impl FnOnce(&dyn Model) -> T) -> T {
        self.voice.ask(|shown| ask(shown.model()))
    }

    fn tell<T>(&mut self, tell: impl FnOnce(&mut dyn Model) -> T) -> T {
        self.voice.tell(|shown| tell(shown.model_mut()))
    }

    /// Current values by name, in the order of the parameters.
    pub fn values(&self) -> Entries<String> {
        Entries(self.ask(|model| model.values()))
    }

    /// Speaks the language of a catalogue ([`crate::words::Language::learnt`]), or if that is empty, English.
    pub fn set_words(&mut self, catalogue: &str) {
        self.voice.learn(catalogue);
    }

    /// [`crate::model::Parameters::params`], in the figure's language.
    pub fn params(&self) -> Vec<ParamSpec> {
        self.ask(|model| model.params())
    }

    /// Gives a parameter a new value.
    ///
    /// # Errors
    /// For a name or a value that is refused; the figure is as it was.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), FigureError> {
        self.tell(|model| model.configure(&[(name.into(), value.into())])).pop().map_or(Ok(()), Err)
    }

    /// Writes numbers with a decimal comma, in the picture and in words.
    pub fn set_decimal_comma(&mut self, on: bool) {
        self.decimal_comma = on;
    }

    /// Lights a symbol wherever the picture writes it: `S`, `H_m`, `w_~`. An empty one puts it out.
    pub fn light(&mut self, symbol: &str) {
        self.lit = symbol.into();
    }

    /// [`Tells::readouts`](crate::model::Tells::readouts), in the figure's language and way of writing numbers.
    pub fn readouts(&self) -> Vec<Readout> {
        let readouts = self.ask(|model| model.readouts()).into_iter();
        readouts.map(|readout| Readout { text: self.written(readout.text), ..readout }).collect()
    }

    /// [`crate::model::Parameters::chips`], in the figure's language and way of writing numbers.
    pub fn chips(&self) -> Vec<Chip> {
        let chips = self.ask(|model| model.chips()).into_iter();
        chips.map(|chip| Chip { goal: self.written(chip.goal), said: self.written(chip.said), ..chip }).collect()
    }

    /// [`Tells::describe`](crate::model::Tells::describe), in the figure's language and way of writing numbers.
    pub fn describe(&self) -> String {
        self.written(self.ask(|model| model.describe()))
    }

    /// [`Tells::trace`](crate::model::Tells::trace), in the figure's language.
    pub fn trace(&self) -> Vec<TraceLine> {
        self.ask(|model| model.trace())
    }

    /// Names of the parts of its picture that can be shown by themselves.
    pub fn panels(&self) -> &'static [&'static str] {
        self.voice.ask(|shown| shown.panels())
    }

    /// Shows some parts of the picture, by their names apart by spaces; `all` or nothing for the whole.
    ///
    /// # Errors
    /// For a name that no part of it has; the error has those that there are.
    pub fn show(&mut self, panels: &str) -> Result<(), FigureError> {
        self.voice.tell(|shown| shown.show(panels))
    }

    /// Height \[css px\] that the figure wants at this width \[css px\].
    pub fn height(&self, width: f64) -> f64 {
        self.voice.ask(|shown| shown.height(width))
    }

    /// What is to be seen at this size \[css px\], in the figure's language and way of writing numbers.
    pub fn scene(&self, width: f64, height: f64) -> Scene {
        let mut scene = self.voice.ask(|shown| shown.scene(width, height));
        numerals::in_scene(&mut scene, self.comma());
        scene
    }

    fn written(&self, text: String) -> String {
        numerals::in_text(&text, self.comma())
    }

    /// Where numbers have a decimal comma, the names that have none.
    fn comma(&self) -> Option<&'static Names> {
        self.decimal_comma.then_some(self.names)
    }

    /// Paints the figure: size in device px, device px per css px, and colours. Sizes no screen has are clamped.
    pub fn paint(&mut self, width_px: u32, height_px: u32, dpr: f64, theme: Theme) {
        let dpr = if dpr.is_finite() { dpr.clamp(0.25, 16.0) } else { 1.0 };
        let side = |px: u32| f64::from(px.max(1)) / dpr;
        let mut scene = self.scene(side(width_px), side(height_px));
        symbol::light(&mut scene, &self.lit);
        self.canvas.paint(&scene, width_px, height_px, theme);
        self.painted = Painted { handles: scene.handles, rooms: scene.rooms, width: scene.width };
    }

    /// Gives a parameter a new value by a reader's hand.
    ///
    /// # Errors
    /// See [`Figure::set`].
    pub fn set_by_hand(&mut self, name: &str, value: &str) -> Result<(), FigureError> {
        let before = self.about_to_leave(name);
        let done = self.set(name, value);
        self.left(name, before);
        done
    }

    /// The part of the picture that tells most where there is no room for the whole, in a figure of this width \[css px\].
    pub fn gist(&self, width: f64) -> Rect {
        self.voice.ask(|shown| shown.gist(width))
    }

    /// What was painted last.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }

    /// A click at a point of a figure of this width \[css px\]. True if it changed something.
    pub fn pick(&mut self, x: f64, y: f64, width: f64) -> bool {
        let height = self.height(width);
        self.voice.tell(|shown| {
            let scene = shown.scene(width, height);
            let target = scene.hit(in_scene([x, y], scene.width / width));
            target.into_iter().for_each(|target| shown.pick(target));
            target.is_some()
        })
    }

    /// What can be moved in the picture painted last, where it lies in a figure of this width \[css px\].
    pub fn handles(&self, width: f64) -> Vec<PlacedHandle> {
        let scale = width / self.painted.width;
        let placed = |handle: &Handle| {
            let Handle { name, title, at, axes, value, text, hover } = handle.clone();
            let [x, y] = at.map(|c| c * scale);
            let hover = hover.map(|area| area.scaled(scale));
            PlacedHandle { name, title, x, y, axes, value, text, hover }
        };
        self.painted.handles.iter().map(placed).collect()
    }

    /// Where controls stand in the picture painted last, in a figure of this width \[css px\].
    pub fn rooms(&self, width: f64) -> Vec<Room> {
        let scale = width / self.painted.width;
        self.painted.rooms.iter().map(|room| Room { area: room.area.scaled(scale), ..*room }).collect()
    }

    /// Moves a handle to a point of a figure of this width \[css px\].
    pub fn drag(&mut self, handle: &str, x: f64, y: f64, width: f64) {
        let scene_width = self.scene_width(width);
        let to = in_scene([x, y], scene_width / width);
        if to.iter().all(|c| c.is_finite()) {
            let before = self.about_to_leave(handle);
            self.voice.tell(|shown| shown.drag(handle, to, scene_width));
            self.left(handle, before);
        }
    }

    /// Moves a handle right and up, in steps of its parameters.
    pub fn nudge(&mut self, handle: &str, right: f64, up: f64) {
        if right.is_finite() && up.is_finite() {
            let before = self.about_to_leave(handle);
            self.voice.tell(|shown| shown.nudge(handle, [right, up]));
            self.left(handle, before);
        }
    }

    /// Does in a figure of this width \[css px\] what only its kind can do.
    ///
    /// # Errors
    /// Where there is no room for all of it; what there was room for is done.
    pub fn own(&mut self, own: &Own, width: f64) -> Result<(), FigureError> {
        self.own_at(own, width, 1.0)
    }

    /// The same on a page that shows it at a scale.
    fn own_at(&mut self, own: &Own, width: f64, scale: f64) -> Result<(), FigureError> {
        let scene_width = self.scene_width(width);
        self.voice.tell(|shown| shown.own(own, scene_width, scene_width / (width * scale)))
    }

    fn scene_width(&self, width: f64) -> f64 {
        self.voice.ask(|shown| shown.scene_width(width))
    }

    /// Takes a reader's file instead of the one before.
    ///
    /// # Errors
    /// For a file that cannot be read, and for a figure that has no use for any; it is as it was.
    pub fn open(&mut self, file: &[u8]) -> Result<(), FigureError> {
        self.with_files(|files| files.open(file))
    }

    /// Takes what another program of ours has read of a reader's file.
    ///
    /// # Errors
    /// For what cannot be used, and for a figure that has no use for any file; it is as it was.
    pub fn take(&mut self, read: &[u8]) -> Result<(), FigureError> {
        self.with_files(|files| files.take(read))
    }

    fn with_files(&mut self, act: impl FnOnce(&mut dyn Files) -> Result<(), FigureError>) -> Result<(), FigureError> {
        self.tell(|model| {
            let none = FigureError { parameter: "file".into(), message: kit::no_file().into() };
            act(model.files_mut().ok_or(none)?)
        })
    }

    /// Whether what was set can be computed at all.
    ///
    /// # Errors
    /// The parameter that stands in the way, and its range.
    pub fn ready(&self) -> Result<(), FigureError> {
        self.ask(|model| model.files().map_or(Ok(()), Files::ready))
    }

    /// A file of this name made of the state shown, if there is such a one.
    pub fn file(&self, name: &str) -> Option<Vec<u8>> {
        self.ask(|model| model.files()?.file(name))
    }

    /// The link that makes this figure again: `name=value&…`.
    pub fn query(&self) -> String {
        self.ask(query::write)
    }

    /// Makes the figure what a link says. Returns what was refused; the rest is applied.
    pub fn load(&mut self, query: &str) -> Vec<FigureError> {
        self.comparison = Comparison { off: self.comparison.off, ..Comparison::default() };
        self.haunt();
        self.tell(|model| query::read(model, query))
    }

    /// [`Model::telling`] for whom a pasted code of this version opens the figure; 0 for one of a version that opened at its first step.
    pub fn telling(&self, code: &str) -> u32 {
        self.ask(|model| if query::opens_telling(model, code) { model.telling() } else { 0 })
    }

    /// What a pasted code means without saying so, by names and values: the defaults of its version, `v=…`, where these are others now.
    ///
    /// # Errors
    /// For a version that there is not.
    pub fn meant(&self, code: &str) -> Result<Vec<(String, String)>, FigureError> {
        self.ask(|model| query::meant(model, code))
    }

    /// Whether there is simulation to do before what was asked for is shown.
    pub fn pending(&self) -> bool {
        self.ask(|model| model.pending()) > 0
    }

    /// Does a step of it.
    pub fn work(&mut self) {
        self.tell(|model| model.work());
    }

    /// [`Model::shares`].
    pub fn shares(&self) -> bool {
        self.ask(|model| model.shares())
    }

    /// [`Model::part`].
    pub fn part(&self, part: usize) -> Vec<f64> {
        self.ask(|model| model.part(part))
    }

    /// [`Model::work_with`].
    pub fn work_with(&mut self, parts: [&[f64]; 2]) {
        self.tell(|model| model.work_with(parts));
    }

    /// Measured data of every step so far.
    pub fn export(&self) -> Export {
        self.ask(|model| Export::new(self.tag, model))
    }
}

/// A point of a figure in its scene: a very narrow figure is a wider scene made smaller.
fn in_scene(point: Point, scale: f64) -> Point {
    point.map(|c| c * scale)
}

#[cfg(test)]
mod tests;
