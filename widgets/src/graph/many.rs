//! The graph over many seeds: what its cell of the chapter's lap table is made of.

use super::recipe::Recipe;
use crate::{
    job::{self, Job, Rows, Setting},
    model::FigureError,
    told::refused,
};
use core::ops::Range;
use fastslam_lab::experiment::{
    graph::{GraphRun, GraphRunError, GraphSetup},
    lap::LapSetup,
};

/// How far from the truth the path of each log is at the optimum.
pub static GRAPHS: Job = Job { name: "graphs", columns: &["seed", "rms_path"], run, counted: None };

/// The setting is that of the figure's link. What it says about the seed, the start, the edges that are asked for and the view makes no
/// difference: a row is what `fastslam-lab table --method graph` makes of a log.
fn run(setting: &Setting, seeds: Range<u64>) -> Result<Rows, FigureError> {
    let recipe: Recipe = job::recipe(setting)?;
    let GraphSetup { lap, repair, .. } = recipe.setup();
    let row = |seed| {
        let run = GraphRun::of(&LapSetup { seed, ..lap.clone() }, repair);
        let run = run.map_err(|error| match error {
            GraphRunError::Setting(error) => refused(error),
            GraphRunError::Graph(error) => FigureError { parameter: "seed".into(), message: error.to_string() },
        })?;
        Ok(vec![seed as f64, run.rms_after])
    };
    seeds.map(row).collect()
}
