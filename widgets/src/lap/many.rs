//! The lap over many seeds: what a cell of the chapter's table is made of.

use super::recipe::Recipe;
use crate::told::refused;
use crate::{
    job::{self, Job, Rows, Setting},
    model::FigureError,
};
use core::ops::Range;
use fastslam_lab::experiment::{lap::LapSetup, table::rms_best};

/// How far from the truth each lap ends.
pub static LAPS: Job = Job { name: "laps", columns: &["seed", "rms_best"], run, counted: None };

/// The setting is that of the figure's link; what it says about the seed and the view makes no difference.
fn run(setting: &Setting, seeds: Range<u64>) -> Result<Rows, FigureError> {
    let recipe: Recipe = job::recipe(setting)?;
    let row = |seed| Ok(vec![seed as f64, rms_best(&LapSetup { seed, ..recipe.setup.clone() }).map_err(refused)?]);
    seeds.map(row).collect()
}
