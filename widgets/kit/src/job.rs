//! Long computations without a picture: experiments over many seeds, for panels and tables that run them beside the page.
//!
//! A job is a pure function of a figure's link and a range of seeds. It can be cut into pieces, stopped between them, and put
//! together again in the order of the seeds.

use crate::{
    model::{FigureError, Group, ParamSpec},
    recipe::{self, Recipe},
};
use core::ops::Range;

/// Names and values of parameters, as a figure's link has them.
pub type Setting = [(String, String)];

/// Numbers, a row for each seed.
pub type Rows = Vec<Vec<f64>>;

/// An experiment.
pub struct Job {
    /// Its name.
    pub name: &'static str,
    /// What the numbers of a row are.
    pub columns: &'static [&'static str],
    /// A row for each seed, in a setting written as a figure's link.
    pub run: fn(&Setting, Range<u64>) -> Result<Rows, FigureError>,
    /// What readers can have counted of it below the figure.
    pub counted: Option<Counted>,
}

/// In how many runs something holds, for each of what is compared. What is said are keys among the words of the elements.
#[derive(serde::Serialize)]
pub struct Counted {
    /// What it is about.
    pub title: &'static str,
    /// Names of the parameters that the count depends on, apart by spaces; it has seeds of its own.
    pub settings: &'static str,
    /// What is compared: its name, the column that is 1 where it holds, and the one that says how often it should, if there is one.
    pub rows: &'static [(&'static str, &'static str, Option<&'static str>)],
}

/// The recipe of a setting. What that says about the view makes no numbers, and may be of another setup.
///
/// # Errors
/// For a parameter that is not among these, or a value that is refused.
pub fn recipe<R: Recipe>(setting: &Setting) -> Result<R, FigureError> {
    let numbers = numbers(setting, &recipe::specs(&R::default()));
    let (recipe, refused) = recipe::with(&R::default(), &numbers);
    refused.into_iter().next().map_or(Ok(recipe), Err)
}

/// What a setting says, but for the view.
fn numbers(setting: &Setting, specs: &[ParamSpec]) -> Vec<(String, String)> {
    let shown = |name: &str| specs.iter().any(|spec| spec.name == name && spec.group == Group::View);
    setting.iter().filter(|(name, _)| !shown(name)).cloned().collect()
}
