//! What every figure tells of itself before anything is asked of it, as JSON. The build makes names, types and manifests from it.
//!
//! `cargo run -p fastslam-widgets --example figures`

use fastslam_widgets::{challenge::Chip, figure::Figure, model::ParamSpec, model::Readout, registry::FIGURES};
use serde::Serialize;

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
    panels: &'static [&'static str],
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let told = |entry: &fastslam_widgets::registry::Entry| {
        let figure = Figure::new(entry.tag).expect("the registry has it");
        Told {
            tag: entry.tag,
            title: entry.title,
            version: figure.model().changes().len() + 1,
            unsaid: figure.model().unsaid(),
            describe: figure.describe(),
            params: figure.params(),
            readouts: figure.readouts(),
            chips: figure.chips(),
            panels: entry.panels,
        }
    };
    serde_json::to_writer(std::io::stdout(), &FIGURES.iter().map(told).collect::<Vec<_>>())?;
    Ok(())
}
