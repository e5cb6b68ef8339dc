//! Accounts of a lap that are told at different times, against the best particle's path.

use super::{Group, Number, Recipe, VALID};
use crate::experiment::ErrorSummary;
use crate::experiment::lap::{Course, LapSetup};
use crate::experiment::looking_back::{Accounts, LATER};

/// Seeds of what is measured.
const SEEDS: u32 = 20;

/// A recipe a course.
pub fn recipes() -> Vec<Recipe> {
    let of = |course: Course, name: &'static str| {
        let run = move |seed| Accounts::of(&LapSetup { course, seed, ..LapSetup::default() }).expect(VALID);
        Recipe::new(name, SEEDS, move |runs| measured(&Group(name.into()), course, &runs.over(run)).into())
    };
    vec![of(Course::Apartment, "lookback.lap"), of(Course::Ring, "lookback.ring")]
}

fn measured(group: &Group, course: Course, found: &[Accounts]) -> Vec<Number> {
    let median = |key, what: &str, f: fn(&Accounts) -> f64| {
        let values: Vec<f64> = found.iter().map(f).collect();
        let made = format!(
            "Median over seeds 1 to {} of the RMS position error of {what}: fastslam-lab lap --course {course} --seed N",
            found.len()
        );
        group.number(key, ErrorSummary::of(&values).median, "m", made)
    };
    let nearer = found.iter().filter(|accounts| accounts.went.rms < accounts.best.rms).count() as f64;
    let steps = course.steps() as f64;
    vec![
        group.number("runs", found.len() as f64, "", "Seeds of the accounts of the past, from 1 on"),
        median("went", "the particles' mean at each step, as it went", |accounts| accounts.went.rms),
        median("later", &format!("the mean of their ancestors {LATER} steps before"), |accounts| accounts.later.rms),
        median("record", "the mean of all ancestors at the end, step by step", |accounts| accounts.record.rms),
        median("best", "the best particle's path", |accounts| accounts.best.rms),
        group.number(
            "nearer",
            nearer,
            "",
            "Seeds at which the mean as it went errs less than the best particle's path",
        ),
        group.number(
            "cost",
            0.5 * (steps + 1.0),
            "",
            "Updates of a map in a sweep over the grids of the lap, for each in a run of the filter",
        ),
    ]
}
