//! The figures in the browser: the only code that knows of JavaScript. Every method is one line; what it does is in
//! [`crate::figure`] and [`crate::model`].

use crate::{
    challenge::Chip,
    figure::{self, PlacedHandle},
    job,
    model::{FigureError, Readout},
    paint::Theme,
    registry,
    scene::{Rect, Room},
    unread,
    words::Language,
};
use core::{
    cell::RefCell,
    ops::{Deref, DerefMut},
};
use fastslam::geometry::Pose2;
use fastslam_lab::experiment::{ErrorSummary, policy_counts::Fraction};
use fastslam_log::{BagOptions, BagReader, LogError, write_json_lines, write_path};
use js_sys::{Array, Error, JSON, Object};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

/// As fast as the one of the standard library, and 2.4 KB less.
#[global_allocator]
static ALLOCATOR: rlsf::SmallGlobalTlsf = rlsf::SmallGlobalTlsf::new();

thread_local! {
    /// What the last panic said. The instance is dead after it, but its memory can still be read.
    static LAST_PANIC: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Runs once, when the module is loaded: a panic goes to the console and stays to be asked for.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|info| {
        let message = info.to_string();
        web_sys::console::error_1(&JsValue::from_str(&message));
        LAST_PANIC.set(Some(message));
    }));
}

/// What the last panic said, if there was one.
#[wasm_bindgen]
pub fn last_panic() -> Option<String> {
    LAST_PANIC.with_borrow(Clone::clone)
}

/// Tags of all figures.
#[wasm_bindgen]
pub fn tags() -> Vec<String> {
    registry::FIGURES.iter().map(|f| f.tag.into()).collect()
}

/// The compiled program, for another instance in a worker: it is not fetched again.
#[wasm_bindgen]
pub fn program() -> JsValue {
    wasm_bindgen::module()
}

/// An experiment over the seeds from `from` to before `to`, in the setting of a link: an array of arrays of numbers, one for each
/// seed. Takes as long as it takes: for workers.
#[wasm_bindgen]
pub fn job(name: &str, query: &str, from: u32, to: u32) -> Result<Array, Error> {
    job::run(name, query, from.into()..to.into()).map(|rows| plain(&rows)).map_err(thrown)
}

/// The 95 % confidence interval of a share: its ends, from 0 to 1.
#[wasm_bindgen]
pub fn interval(successes: u32, total: u32) -> Vec<f64> {
    Fraction { successes, total }.wilson().to_vec()
}

/// Of errors: their median, the ends of its 95 % confidence interval, the 90th percentile and the worst.
#[wasm_bindgen]
pub fn spread(errors: &[f64]) -> Vec<f64> {
    let ErrorSummary { median, median_interval: [low, high], p90, worst } = ErrorSummary::of(errors);
    vec![median, low, high, p90, worst]
}

/// What only some programs have. All export the same, so that one glue serves them all: of what another program has, the compiler is told
/// here that nothing ever comes this far, and leaves out all that would be done with it.
struct Held<T, const HERE: bool>(T);

impl<T, const HERE: bool> Held<T, HERE> {
    fn given(self) -> T {
        here::<HERE>();
        self.0
    }
}

impl<T, const HERE: bool> Deref for Held<T, HERE> {
    type Target = T;

    fn deref(&self) -> &T {
        here::<HERE>();
        &self.0
    }
}

impl<T, const HERE: bool> DerefMut for Held<T, HERE> {
    fn deref_mut(&mut self) -> &mut T {
        here::<HERE>();
        &mut self.0
    }
}

/// Nothing comes this far in a program that has it not.
fn here<const HERE: bool>() {
    assert!(HERE);
}

const BAGS: bool = cfg!(feature = "bags");

/// A reader of ROS bags: what it makes of one is a log that the figure of logs opens.
#[wasm_bindgen]
pub struct Bag {
    reader: Held<BagReader, BAGS>,
    language: Language,
}

#[wasm_bindgen]
impl Bag {
    /// For a bag of which nothing has been read, with the topics that were chosen, and the catalogue of the language in which it is told
    /// what is wrong with it, as `Figure.set_words` takes it.
    #[wasm_bindgen(constructor)]
    pub fn new(scan_topic: Option<String>, odometry_topic: Option<String>, catalogue: &str) -> Bag {
        here::<BAGS>();
        let options = BagOptions { scan_topic, odometry_topic, lenient: true, ..BagOptions::default() };
        Bag { reader: Held(BagReader::new(options)), language: Language::learnt(catalogue) }
    }

    /// The next bytes; throws a `FigureError` if they cannot be read.
    pub fn push(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let _spoken = self.language.spoken();
        self.reader.push(bytes).map_err(|error| thrown(bad_bag(&error)))
    }

    /// What is to be chosen, once all is read: `scan` or `odometry`, and the topics that have it; nothing where all is clear.
    pub fn choice(&self) -> Vec<String> {
        self.reader.choice().map_or(Vec::new(), |(what, topics)| [vec![what.to_owned()], topics].concat())
    }

    /// The log, as JSON lines; throws a `FigureError` that says what is missing.
    pub fn finish(self) -> Result<Vec<u8>, Error> {
        let _spoken = self.language.spoken();
        let log = self.reader.given().finish().map_err(|error| thrown(bad_bag(&error)))?;
        Ok(write_json_lines(&unread::in_words(log)).into_bytes())
    }
}

/// Poses, each as its time \[s\], x \[m\], y \[m\] and heading \[rad\], as a `nav_msgs/Path` in an MCAP file: what `fastslam log --path-mcap`
/// writes. Throws a `FigureError` if it cannot be written.
#[wasm_bindgen]
pub fn path_mcap(poses: &[f64]) -> Result<Vec<u8>, Error> {
    here::<BAGS>();
    let (poses, _) = poses.as_chunks();
    let path: Vec<_> = poses.iter().map(|&[time, x, y, theta]| (time, Pose2 { x, y, theta })).collect();
    let refused = |message| thrown(FigureError { parameter: "file".into(), message });
    write_path(&path).map_err(refused)
}

fn bad_bag(error: &LogError) -> FigureError {
    FigureError { parameter: "file".into(), message: unread::problem(&error.problem) }
}

/// One figure on a page; to be freed when it leaves the page.
#[wasm_bindgen]
pub struct Figure {
    figure: Held<figure::Figure, { !registry::FIGURES.is_empty() }>,
    readouts: RefCell<Told<Readout>>,
    chips: RefCell<Told<Chip>>,
    handles: RefCell<Told<PlacedHandle>>,
    rooms: RefCell<Told<Room>>,
}

/// What was told last, and the same as JavaScript has it: it is asked for at every frame, and most frames change nothing of it.
struct Told<T> {
    last: Vec<T>,
    array: Array,
}

impl<T: PartialEq + Serialize> Told<T> {
    fn tell(&mut self, now: Vec<T>) -> Array {
        if self.last != now {
            *self = Self { array: plain(&now), last: now };
        }
        self.array.clone()
    }
}

impl Figure {
    fn showing(figure: figure::Figure) -> Self {
        fn nothing<T>() -> RefCell<Told<T>> {
            RefCell::new(Told { last: Vec::new(), array: Array::new() })
        }
        Self { figure: Held(figure), readouts: nothing(), chips: nothing(), handles: nothing(), rooms: nothing() }
    }
}

#[wasm_bindgen]
impl Figure {
    /// The figure of a tag, of which nothing was asked yet.
    #[wasm_bindgen(constructor)]
    pub fn new(tag: &str) -> Result<Figure, Error> {
        figure::Figure::new(tag).map(Self::showing).map_err(thrown)
    }

    /// Title for readers.
    pub fn title(&self) -> String {
        self.figure.model().title().into()
    }

    /// All parameters: an array of `ParamSpec`.
    pub fn params(&self) -> Array {
        plain(&self.figure.params())
    }

    /// Current values by name.
    pub fn values(&self) -> Object {
        plain(&self.figure.values())
    }

    /// Gives a parameter a new value; throws a `FigureError` if it is refused.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), Error> {
        #[cfg(feature = "trouble")]
        crate::trouble::die_if_asked(name, value);
        self.figure.set(name, value).map_err(thrown)
    }

    /// Number of the last step.
    pub fn step_count(&self) -> u32 {
        self.figure.model().step_count()
    }

    /// The step shown.
    pub fn step(&self) -> u32 {
        self.figure.model().step()
    }

    /// Asks for a step; beyond the last means the last.
    pub fn seek(&mut self, step: u32) {
        self.figure.model_mut().seek(step);
    }

    /// The step that tells most, for a pasted code of this version: `v=…`.
    pub fn telling(&self, code: &str) -> u32 {
        self.figure.telling(code)
    }

    /// The step from which the rest is to be watched; none where there is nothing to be watched.
    pub fn watch_from(&self) -> Option<u32> {
        self.figure.model().watch().map(|(step, _)| step)
    }

    /// What asks for that, in words.
    pub fn watch(&self) -> String {
        self.figure.watch()
    }

    /// Steps of simulation still to do before what was asked for is shown.
    pub fn pending(&self) -> u32 {
        self.figure.model().pending()
    }

    /// Whether they only add to what is shown.
    pub fn refines(&self) -> bool {
        self.figure.model().refines()
    }

    /// Does one of them.
    pub fn work(&mut self) {
        self.figure.model_mut().work();
    }

    /// Speaks the language of a catalogue: a line for each message, `section.key=text`. English where that is empty.
    pub fn set_words(&mut self, catalogue: &str) {
        self.figure.set_words(catalogue);
    }

    /// Writes numbers with a decimal comma, in the picture and in words.
    pub fn set_decimal_comma(&mut self, on: bool) {
        self.figure.set_decimal_comma(on);
    }

    /// Lights a symbol wherever the picture writes it; an empty one puts it out.
    pub fn light(&mut self, symbol: &str) {
        self.figure.light(symbol);
    }

    /// The numbers of the state shown: an array of `Readout`.
    pub fn readouts(&self) -> Array {
        self.readouts.borrow_mut().tell(self.figure.readouts())
    }

    /// States that are worth trying, and how it stands with them: an array of `Chip`.
    pub fn chips(&self) -> Array {
        self.chips.borrow_mut().tell(self.figure.chips())
    }

    /// One or two sentences that tell what is shown now.
    pub fn describe(&self) -> String {
        self.figure.describe()
    }

    /// What comes of the reader's prediction: an `Outcome`, or null where none is asked for.
    pub fn prediction(&self) -> JsValue {
        plain(&self.figure.model().prediction())
    }

    /// How fast the step shown is played, of the usual speed.
    pub fn pace(&self) -> f64 {
        self.figure.model().pace()
    }

    /// The lines of its algorithm that led to what is shown: an array of `TraceLine`.
    pub fn trace(&self) -> Array {
        plain(&self.figure.trace())
    }

    /// Names of the parts of its picture that can be shown by themselves.
    pub fn panels(&self) -> Vec<String> {
        self.figure.panels().iter().map(|name| name.to_string()).collect()
    }

    /// Shows some of them, apart by spaces, or `all`; throws a `FigureError` for a name that none has.
    pub fn show(&mut self, names: &str) -> Result<(), Error> {
        self.figure.show(names).map_err(thrown)
    }

    /// Height \[css px\] that the figure wants at this width \[css px\].
    pub fn height(&self, width_css: f64) -> f64 {
        self.figure.height(width_css)
    }

    /// Paints: size \[device px\], device px per css px, and "light", "dark", "contrast-light" or "contrast-dark".
    pub fn paint(&mut self, width_px: u32, height_px: u32, dpr: f64, theme: &str) {
        self.figure.paint(width_px, height_px, dpr, Theme::named(theme));
    }

    /// Address of the pixels in the module's memory: RGBA, row by row. Any call may move them, and the memory.
    pub fn pixels(&self) -> u32 {
        self.figure.canvas().pixels().as_ptr() as u32
    }

    /// The part of the picture that tells most, in a figure of this width \[css px\]: x, y, width and height.
    pub fn gist(&self, width_css: f64) -> Vec<f64> {
        let Rect { x, y, w, h } = self.figure.gist(width_css);
        vec![x, y, w, h]
    }

    /// Gives a parameter a new value by a reader's hand: what was set before is compared with it.
    pub fn set_by_hand(&mut self, name: &str, value: &str) -> Result<(), Error> {
        self.figure.set_by_hand(name, value).map_err(thrown)
    }

    /// Whether the setting before is compared with that of now.
    pub fn compare(&mut self, on: bool) {
        self.figure.compare(on);
    }

    /// What is different from the setting before, at the same step; empty where nothing is.
    pub fn difference(&self) -> String {
        self.figure.difference()
    }

    /// What stands below the picture: the difference in numbers, or what is shown.
    pub fn told(&self) -> String {
        self.figure.told()
    }

    /// A parameter whose control shows another value than was set: `name=value`, or nothing.
    pub fn instead(&self) -> String {
        self.figure.model().instead().map_or(String::new(), |(name, value)| [name, "=", &value].concat())
    }

    /// The name of the readout that matters first.
    pub fn main_readout(&self) -> String {
        self.figure.model().compared().first().map_or(String::new(), |name| (*name).into())
    }

    /// A click at a point of a figure of this width \[css px\]. True if it changed something.
    pub fn pick(&mut self, x_css: f64, y_css: f64, width_css: f64) -> bool {
        self.figure.pick(x_css, y_css, width_css)
    }

    /// What can be moved in the picture painted last: an array of `PlacedHandle`, in a figure of this width \[css px\].
    pub fn handles(&self, width_css: f64) -> Array {
        self.handles.borrow_mut().tell(self.figure.handles(width_css))
    }

    /// Where controls stand in the picture painted last: an array of `Room`, in a figure of this width \[css px\].
    pub fn rooms(&self, width_css: f64) -> Array {
        self.rooms.borrow_mut().tell(self.figure.rooms(width_css))
    }

    /// Moves a handle to a point of a figure of this width \[css px\].
    pub fn drag(&mut self, handle: &str, x_css: f64, y_css: f64, width_css: f64) {
        self.figure.drag(handle, x_css, y_css, width_css);
    }

    /// Moves a handle right and up, in steps of its parameters.
    pub fn nudge(&mut self, handle: &str, right: f64, up: f64) {
        self.figure.nudge(handle, right, up);
    }

    /// Puts a tool into the reader's hand; an empty name puts it away.
    pub fn take(&mut self, tool: &str) {
        self.figure.take(tool);
    }

    /// Uses the tool by a key; throws a `FigureError` where there is no more room for what it does.
    pub fn press(&mut self, key: &str, right: f64, up: f64) -> Result<(), Error> {
        self.figure.press(key, right, up).map_err(thrown)
    }

    /// Uses the tool along a line in a figure of this width \[css px\], x and y of each point; throws as `press` does.
    pub fn stroke(&mut self, line: &[f64], width_css: f64) -> Result<(), Error> {
        self.figure.stroke(line, width_css).map_err(thrown)
    }

    /// Takes a reader's file; throws a `FigureError` if it cannot be read.
    pub fn open(&mut self, file: &[u8]) -> Result<(), Error> {
        self.figure.open(file).map_err(thrown)
    }

    /// Throws a `FigureError` if what was set cannot be computed.
    pub fn ready(&self) -> Result<(), Error> {
        self.figure.ready().map_err(thrown)
    }

    /// A file of this name made of the state shown, if there is such a one.
    pub fn file(&self, name: &str) -> Option<Vec<u8>> {
        self.figure.file(name)
    }

    /// Magnifies the picture about a point of a figure of this width \[css px\], or about its middle where that is NaN.
    pub fn zoom(&mut self, factor: f64, x_css: f64, y_css: f64, width_css: f64) {
        self.figure.zoom(factor, x_css, y_css, width_css);
    }

    /// Moves the picture right and down in a figure of this width \[css px\].
    pub fn pan(&mut self, right_css: f64, down_css: f64, width_css: f64) {
        self.figure.pan(right_css, down_css, width_css);
    }

    /// Shows the whole again.
    pub fn fit(&mut self) {
        self.figure.fit();
    }

    /// The link that makes this figure again.
    pub fn query(&self) -> String {
        self.figure.query()
    }

    /// Makes the figure what a link says; returns a line for everything that was refused.
    pub fn load(&mut self, query: &str) -> Vec<String> {
        self.figure.load(query).into_iter().map(|error| error.message).collect()
    }

    /// What a pasted code, as a query, means without saying so: names and values in turn; throws a `FigureError` for a bad version.
    pub fn meant(&self, code: &str) -> Result<Vec<String>, Error> {
        let pairs = self.figure.meant(code).map_err(thrown)?;
        Ok(pairs.into_iter().flat_map(|(name, value)| [name, value]).collect())
    }

    /// Measured data of every step so far, as CSV. JavaScript writes the numbers: with the fewest digits that read back as the
    /// same bits.
    pub fn csv(&self) -> String {
        let export = self.figure.export();
        let rows: Array = plain(&export.rows()); // an array in an array is joined by commas, and null to nothing
        format!("{}\n{}\n", export.header().join(","), rows.join("\n"))
    }

    /// The same as JSON.
    pub fn json(&self) -> String {
        JSON::stringify(&plain(&self.figure.export())).map_or_else(|_| String::new(), String::from)
    }
}

/// Data as plain objects and arrays. Not for what is called every frame: those are numbers.
fn plain<T: JsCast>(data: &impl Serialize) -> T {
    // Fails for keys that are no texts only.
    data.serialize(&Serializer::json_compatible()).unwrap_or_default().unchecked_into()
}

/// A JavaScript Error with the parameter as a property.
fn thrown(error: FigureError) -> Error {
    #[derive(Serialize)]
    struct Properties {
        name: &'static str,
        parameter: String,
    }
    let thrown = Error::new(&error.message);
    let properties: Object = plain(&Properties { name: "FigureError", parameter: error.parameter });
    Object::assign(&thrown, &properties).unchecked_into()
}
