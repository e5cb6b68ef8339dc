//! What every figure tells of itself before anything is asked of it, as JSON. The build makes names, types and manifests from it.
//!
//! `cargo run -p fastslam-widgets --example figures`

use fastslam_widgets::{
    challenge::Chip,
    job::{Counted, Job},
    model::{Kind, ParamSpec, Readout},
    paint::Theme,
    registry::{self, FIGURES, Program},
};
use serde::Serialize;

/// The buttons of every prediction.
const PREDICTING: [&str; 2] = ["predict", "run"];

/// \[css px\]
const WIDTH: f64 = 832.0;

#[derive(Serialize)]
struct Told {
    tag: &'static str,
    title: &'static str,
    /// The newest, and that of a code which says none.
    version: usize,
    unsaid: usize,
    describe: String,
    params: Vec<ParamSpec>,
    readouts: Vec<Readout>,
    chips: Vec<Chip>,
    /// What a reader is asked to predict, by the name that a judged guess has.
    prediction: Option<&'static str>,
    /// Whether something in the picture can be grasped.
    handles: bool,
    panels: &'static [&'static str],
    /// Whether a script can run it at several seeds, on the page.
    compared: bool,
    /// What readers can have counted over many seeds.
    counted: Option<Count>,
}

/// A count, and how its job has it.
#[derive(Serialize)]
struct Count {
    job: &'static str,
    columns: &'static [&'static str],
    #[serde(flatten)]
    counted: &'static Counted,
}

/// What the figure asks a reader to predict.
fn asked(tag: &str) -> Option<&'static str> {
    let mut figure = registry::figure(tag).expect("the registry has it");
    figure.set("predict", "on").ok()?;
    if figure.model().prediction().is_none() {
        figure.model_mut().settle();
    }
    figure.model().prediction().map(|outcome| outcome.name)
}

/// Whether something in its picture can be grasped, as it opens or with one of its own buttons pressed.
fn grasped(tag: &str) -> bool {
    let mut figure = registry::figure(tag).expect("the registry has it");
    let buttons = figure
        .params()
        .into_iter()
        .filter(|spec| spec.kind == Kind::Toggle && !PREDICTING.contains(&spec.name))
        .map(|spec| Some(spec.name));
    [None].into_iter().chain(buttons).any(|button| {
        button.into_iter().for_each(|name| figure.set(name, "on").expect("a button can be pressed"));
        figure.paint(WIDTH as u32, figure.height(WIDTH) as u32, 1.0, Theme::default());
        !figure.handles(WIDTH).is_empty()
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let told = |entry: &fastslam_widgets::registry::Entry| {
        let figure = registry::figure(entry.tag).expect("the registry has it");
        Told {
            tag: entry.tag,
            title: entry.title,
            version: figure.model().changes().len() + 1,
            unsaid: figure.model().unsaid(),
            describe: figure.describe(),
            params: figure.params(),
            readouts: figure.readouts(),
            chips: figure.chips(),
            prediction: asked(entry.tag),
            handles: grasped(entry.tag),
            panels: entry.panels,
            compared: entry.program == Program::Page && figure.params().iter().any(|spec| spec.name == "seed"),
            counted: entry.count.and_then(|&Job { name: job, columns, ref counted, .. }| {
                Some(Count { job, columns, counted: counted.as_ref()? })
            }),
        }
    };
    serde_json::to_writer(std::io::stdout(), &FIGURES.iter().map(told).collect::<Vec<_>>())?;
    Ok(())
}
