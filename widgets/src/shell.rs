//! The figures in the browser: the only code that knows of JavaScript. An action goes in, a frame comes out, and the pixels with it; what
//! that does is in [`crate::figure`].

use crate::{
    action::{Action, Message},
    figure,
    model::FigureError,
    registry, unread,
    words::Language,
};
use core::{
    cell::RefCell,
    ops::{Deref, DerefMut},
};
use fastslam::{geometry::Pose2, map::grid::MapImage};
use fastslam_lab::experiment::{ErrorSummary, Fraction};
use fastslam_log::{BagOptions, BagReader, parse, write_path, write_tum};
use js_sys::{Array, Error, Object, Reflect};
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

/// The compiled program, for another instance in a worker: it is not fetched again.
#[wasm_bindgen]
pub fn program() -> JsValue {
    wasm_bindgen::module()
}

/// An experiment over the seeds from `from` to before `to`, in the setting of a link: an array of arrays of numbers, one for each
/// seed. Takes as long as it takes: for workers.
#[wasm_bindgen]
pub fn job(name: &str, query: &str, from: u32, to: u32) -> Result<Array, Error> {
    registry::count(name, query, from.into()..to.into()).map(|rows| plain(&rows)).map_err(thrown)
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

/// First in a thing that only some programs have: in the others nothing of it is ever dropped either.
struct Here<const HERE: bool>;

impl<const HERE: bool> Drop for Here<HERE> {
    fn drop(&mut self) {
        here::<HERE>();
    }
}

const FILES: bool = cfg!(feature = "files");
const FIGURES: bool = !registry::FIGURES.is_empty();

/// A reader of ROS bags: what it makes of one is a log that the figure of logs opens.
#[wasm_bindgen]
pub struct Bag {
    _here: Here<FILES>,
    reader: Held<BagReader, FILES>,
    language: Language,
}

#[wasm_bindgen]
impl Bag {
    /// For a bag of which nothing has been read, with the topics that were chosen, and the catalogue of the language in which it is told
    /// what is wrong with it, as `Figure.set_words` takes it.
    #[wasm_bindgen(constructor)]
    pub fn new(scan_topic: Option<String>, odometry_topic: Option<String>, catalogue: &str) -> Bag {
        here::<FILES>();
        let options = BagOptions { scan_topic, odometry_topic, lenient: true, ..BagOptions::default() };
        Bag { _here: Here, reader: Held(BagReader::new(options)), language: Language::learnt(catalogue) }
    }

    /// The next bytes; throws a `FigureError` if they cannot be read.
    pub fn push(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let _spoken = self.language.spoken();
        self.reader.push(bytes).map_err(|error| thrown(unread::error(&error)))
    }

    /// What is to be chosen, once all is read: `scan` or `odometry`, and the topics that have it; nothing where all is clear.
    pub fn choice(&self) -> Vec<String> {
        self.reader.choice().map_or(Vec::new(), |(what, topics)| [vec![what.to_owned()], topics].concat())
    }

    /// The log, as bytes that `Figure.take` takes; throws a `FigureError` that says what is missing.
    pub fn finish(self) -> Result<Vec<u8>, Error> {
        let _spoken = self.language.spoken();
        let log = self.reader.given().finish().map_err(|error| thrown(unread::error(&error)))?;
        Ok(unread::in_words(log).to_bytes())
    }
}

/// A log of text with scans as JSON lines, as bytes that `Figure.take` takes. What is said of it is in the language of this catalogue. Throws a
/// `FigureError` if it cannot be read.
#[wasm_bindgen]
pub fn read_text(file: &[u8], catalogue: &str) -> Result<Vec<u8>, Error> {
    here::<FILES>();
    let language = Language::learnt(catalogue);
    let _spoken = language.spoken();
    let log = unread::text(file, parse).map_err(thrown)?;
    Ok(unread::in_words(log).to_bytes())
}

/// Poses, each as its time \[s\], x \[m\], y \[m\] and heading \[rad\], as a `nav_msgs/Path` in an MCAP file: what `fastslam log --path-mcap`
/// writes. Throws a `FigureError` if it cannot be written.
#[wasm_bindgen]
pub fn path_mcap(poses: &[f64]) -> Result<Vec<u8>, Error> {
    here::<FILES>();
    write_path(&path(poses)).map_err(|why| thrown(unread::refused(why)))
}

/// The same poses as the benchmarks of TUM write them: what `fastslam log --trajectory` writes.
#[wasm_bindgen]
pub fn path_tum(poses: &[f64]) -> String {
    here::<FILES>();
    write_tum(&path(poses))
}

fn path(poses: &[f64]) -> Vec<(f64, Pose2)> {
    poses.as_chunks().0.iter().map(|&[time, x, y, theta]| (time, Pose2 { x, y, theta })).collect()
}

/// What ROS has to know of a map's picture, whose file is called `image`: the side of its cells \[m\], and where in the world frame its lower
/// left corner is \[m\].
#[wasm_bindgen]
pub fn map_yaml(image: &str, cell_size: f64, x: f64, y: f64) -> String {
    here::<FILES>();
    MapImage { width: 0, height: 0, origin: [x, y], cell_size, grey: Vec::new() }.yaml(image)
}

/// One figure on a page; to be freed when it leaves the page.
#[wasm_bindgen]
pub struct Figure {
    _here: Here<FIGURES>,
    figure: Held<figure::Figure, FIGURES>,
}

#[wasm_bindgen]
impl Figure {
    /// The figure of a tag, of which nothing was asked yet.
    #[wasm_bindgen(constructor)]
    pub fn new(tag: &str) -> Result<Figure, Error> {
        registry::figure(tag).map(|figure| Self { _here: Here, figure: Held(figure) }).map_err(thrown)
    }

    /// Does what is asked, an `Action`, and returns what is refused of it: an array of `Refusal`.
    pub fn act(&mut self, action: &Object) -> Result<Array, Error> {
        let action = Action::try_from(message(action)).map_err(Error::new)?;
        #[cfg(feature = "trouble")]
        crate::trouble::die_if_asked(&action);
        Ok(plain(&self.figure.act(&action)))
    }

    /// What is set, and how far it is computed: a `State`.
    pub fn state(&self) -> Object {
        plain(&self.figure.state())
    }

    /// Paints, and tells what there is to know: a `ProgramFrame`. What is told once is not told by a look ahead.
    pub fn frame(&mut self, ahead: bool) -> Object {
        plain(&self.figure.frame(ahead))
    }

    /// Address of the pixels in the module's memory: RGBA, row by row. Any call may move them, and the memory.
    pub fn pixels(&self) -> u32 {
        self.figure.canvas().pixels().as_ptr() as u32
    }

    /// Whether there is simulation still to do before what was asked for is shown.
    pub fn pending(&self) -> bool {
        self.figure.pending()
    }

    /// Does a step of it.
    pub fn work(&mut self) {
        self.figure.work();
    }

    /// Whether that is so much that another program is worth asking for a part of each step.
    pub fn shares(&self) -> bool {
        self.figure.shares()
    }

    /// Part 0 or 1 of what the next step is made of: the same in every program that is at this step of this link.
    pub fn part(&self, part: usize) -> Vec<f64> {
        self.figure.part(part)
    }

    /// Does a step of which both parts are known.
    pub fn work_with(&mut self, first: &[f64], second: &[f64]) {
        self.figure.work_with([first, second]);
    }

    /// Takes a reader's file; throws a `FigureError` if it cannot be read.
    pub fn open(&mut self, file: &[u8]) -> Result<(), Error> {
        self.figure.open(file).map_err(thrown)
    }

    /// Takes what `Bag.finish` or `read_text` of another program has made of a reader's file; throws a `FigureError` if it cannot be used.
    pub fn take(&mut self, read: &[u8]) -> Result<(), Error> {
        self.figure.take(read).map_err(thrown)
    }

    /// A file of this name made of the state shown, if there is such a one.
    pub fn file(&self, name: &str) -> Option<Vec<u8>> {
        self.figure.file(name)
    }

    /// Measured data of every step so far: an `Export`.
    pub fn export(&self) -> Object {
        plain(&self.figure.export())
    }
}

/// What the page asks, field by field: what serde-wasm-bindgen has to say of an object of another shape is five kilobytes of every program,
/// and TypeScript lets none of them come this far.
fn message(action: &Object) -> Message {
    let field = |name: &str| Reflect::get(action, &name.into()).unwrap_or_default();
    let text = |name| field(name).as_string();
    let at = field("at").dyn_into::<Array>().unwrap_or_default();
    Message {
        r#do: text("do").unwrap_or_default(),
        name: text("name").unwrap_or_default(),
        value: text("value"),
        on: field("on").is_truthy(),
        at: at.iter().map(|x| x.as_f64().unwrap_or(f64::NAN)).collect(),
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
